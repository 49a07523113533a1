//! What cannot be right is refused or flagged, and what is coarse is said to be.

use crate::engine::Slip;
use crate::scene::parse;
use crate::verify::Case;
use crate::verify::check::{Sheet, Within};
use crate::verify::contact::{Contact, HALF_PLANE, claimed, layer, number};
use crate::verify::layers::respond;
use slipzone_api::Family;

pub(super) fn cases() -> Vec<Case> {
    let mut all = vec![lift_off(), overturned(), reversed(), refusals(), too_fine(), bad_numbers()];
    let coarse = [
        (Family::Quadrature, "{ type = \"de-sinc\", n = 8 }"),
        (Family::Quadrature, "{ type = \"de-sinc\", n = 12 }"),
        (Family::Quadrature, "{ type = \"graded-panels\", nodes = 4, panels = 3 }"),
        (Family::Quadrature, "{ type = \"gauss-chebyshev\", n = 12 }"),
        (Family::Kernel, "{ type = \"truncated\", cutoff = 2.0 }"),
        (Family::Kernel, "{ type = \"truncated\", cutoff = 20.0 }"),
    ];
    all.extend(coarse.map(|(family, table)| claims(family, table)));
    all
}

/// A status against what it should be.
fn status(sheet: &mut Sheet, name: &str, contact: &Contact, expected: &str, source: &str) -> Result<String, String> {
    let solution = contact.attempt()?;
    let found = format!("{:?}", solution.status);
    let reason = format!("a status is right or wrong; it says: {}", solution.reason.clone().unwrap_or_default());
    sheet.same(name, &found, expected, &reason, source);
    Ok(solution.reason.unwrap_or_default())
}

/// A stiff skin on a soft layer lifts off in the middle.
fn lift_off() -> Case {
    Case::new("pressure that pulls", |sheet| {
        let source = "docs/theory.md section 1: 0.091, -0.178, -0.659";
        for (ratio, centre, expected) in
            [(1e2, 0.091, "Converged"), (1e3, -0.178, "AssumptionViolated"), (1e4, -0.659, "AssumptionViolated")]
        {
            let contact = Contact::flat(layer(5.0, ratio, 0.3)).to(1e-8);
            status(sheet, &format!("skin {ratio:e} times as stiff as the base: status"), &contact, expected, source)?;
            let found = contact.attempt()?.pressure.centre.ok_or("there is no pressure")?;
            let within = Within::new(5e-4, "half a unit of the third digit printed");
            let name = format!("skin {ratio:e} times as stiff as the base: p(0) b/P");
            sheet.absolute(&name, found, centre, within, source);
        }
        Ok(())
    })
}

/// The only root sticks where more friction is needed than there is; the second one a hair from full stick.
fn overturned() -> Case {
    Case::new("stick zones that do not hold", |sheet| {
        for (h, ratio, nu, eta) in [(0.5, 1.0, 0.3, 0.05), (1.0, 8.0, 0.45, 0.3)] {
            let contact = Contact::flat(layer(h, ratio, nu)).rubbing(eta).to(1e-8);
            let name = |what: &str| format!("h/b = {h}, mu1/mu3 = {ratio}, nu = {nu}, eta = {eta}: {what}");
            let source = "docs/theory.md section 1";
            let told = status(sheet, &name("status"), &contact, "AssumptionViolated", source)?;
            let told = if told.contains("eta p at x = ") { "what and where" } else { &told };
            sheet.same(&name("reason"), told, "what and where", "it says what fails and where", source);
        }
        Ok(())
    })
}

/// A reversed shear inside the stick zone is no failure by itself.
fn reversed() -> Case {
    Case::new("reversed shear", |sheet| {
        let source = "docs/theory.md section 1";
        let within = || Within::new(5e-7, "half a unit of the last digit printed");
        for (h, nu, eta, expected, slip) in
            [(0.5, 0.3, 0.1, 0.961_589, Slip::Inward), (1.0, 0.49, 0.3, 0.677_286, Slip::Outward)]
        {
            let solution = Contact::flat(layer(h, 1.0, nu)).rubbing(eta).to(1e-8).solve()?;
            let name = |what: &str| format!("h/b = {h}, nu = {nu}, eta = {eta}: {what}");
            sheet.absolute(&name("a/b"), number(&solution, "stick.ratio")?, expected, within(), source);
            let found = solution.stick.as_ref().and_then(|stick| stick.slip);
            let found = found.map_or_else(|| "None".into(), |slip| format!("{slip:?}"));
            sheet.same(&name("slip"), &found, &format!("{slip:?}"), "a direction is right or wrong", source);
        }
        Ok(())
    })
}

/// Limits of a method are named, not passed over.
fn refusals() -> Case {
    Case::new("refusals", |sheet| {
        let published = "{ type = \"transfer-matrix\" }";
        for (name, layer, s) in [
            ("overflows", layer(5.0, 8.0, 0.3), 1e3),
            ("long waves", layer(5.0, 8.0, 0.3), 1e-9),
            ("gamma = 0", layer(5.0, 1.0, 0.3), 1.0),
            ("kappa = 1", layer(5.0, 8.0, 0.5), 1.0),
        ] {
            let told = match respond(&layer, published).map(|response| response.surface(s)) {
                Ok(Ok(_)) => "taken",
                Ok(Err(_)) | Err(_) => "refused",
            };
            let source = "docs/theory.md section 2: where the published route loses its digits";
            sheet.same(&format!("transfer matrix, {name}"), told, "refused", "no digit is left", source);
        }
        let depth = Contact::flat(HALF_PLANE).loaded("indentation = 0.01");
        let source = "an indentation on a half-plane without a datum is undefined";
        let told = match depth.scene() {
            Err(_) => "refused".to_owned(),
            Ok(_) => format!("{:?}", depth.attempt()?.status).to_lowercase(),
        };
        sheet.same("indentation of a half-plane without a datum", &told, "refused", "it has no value", source);
        Ok(())
    })
}

/// A tolerance below what double precision gives is not claimed to be met.
fn too_fine() -> Case {
    Case::new("too fine a tolerance", |sheet| {
        let contact = Contact::flat(layer(5.0, 8.0, 0.3)).to(1e-14);
        let source = "rounding of the systems is above it";
        status(sheet, "tolerance of 1e-14: status", &contact, "NotConverged", source)?;
        Ok(())
    })
}

/// A scene with a number that is none is no scene.
fn bad_numbers() -> Case {
    Case::new("bad numbers", |sheet| {
        for bad in ["poisson = nan", "poisson = 0.51", "thickness = -1.0", "thickness = inf", "thickness = 0.0"] {
            let key = bad.split(' ').next().unwrap_or_default();
            let lines = ["thickness = 1.0", "poisson = 0.3"].map(|line| if line.starts_with(key) { bad } else { line });
            let text = format!(
                "format = 1\n[layer]\n{}\n{}\ngrading = {{ type = \"homogeneous\", modulus = 1.0 }}\n\
                 [punch]\ntype = \"flat\"\nhalf_width = 1.0\n[load]\nforce = 1.0\n",
                lines[0], lines[1]
            );
            let told = match parse("check", &text) {
                Err(error) if (3..=4).contains(&error.line) => "refused, with its line",
                Err(_) => "refused",
                Ok(_) => "taken",
            };
            sheet.same(bad, told, "refused, with its line", "the line of the number is told", "docs/formats.md");
        }
        Ok(())
    })
}

/// At a resolution far too coarse the claimed errors cover the true ones.
fn claims(family: Family, table: &'static str) -> Case {
    Case::new(format!("claims of {table}"), move |sheet| {
        for (ratio, eta) in [(1.0, None), (8.0, None), (0.125, Some(0.3))] {
            let contact = Contact::flat(layer(2.0, ratio, 0.3));
            let contact = eta.map_or(contact.clone(), |eta| contact.rubbing(eta));
            let (coarse, fine) = (contact.clone().by(family, table).to(1e-8).attempt()?, contact.to(1e-9).solve()?);
            for path in ["edge.ratio", "pressure.centre", "load.indentation"] {
                let (found, exact) = (number(&coarse, path)?, number(&fine, path)?);
                let friction = if eta.is_some() { ", friction" } else { "" };
                let name = format!("{table}, mu1/mu3 = {ratio}{friction}: error of {path} within what is claimed");
                let why = "1e-9 that the finer solution was asked for";
                let within = Within::new(2e-9, why);
                sheet.at_most(&name, (found / exact - 1.0).abs(), claimed(&coarse, path), within, "the claimed error");
            }
        }
        Ok(())
    })
}
