//! Limits: vanishing gradients, equal substrates, thick layers, units.

use crate::verify::Case;
use crate::verify::check::{Sheet, Within};
use crate::verify::contact::{A0, BETA, Contact, HALF_PLANE, layer, number, numbers};
use slipzone_api::Family;
use slipzone_api::reference::partial_slip::stick;
use std::f64::consts::PI;

pub(super) fn cases() -> Vec<Case> {
    let mut all = vec![
        thick_flat(),
        thick_cylinder(),
        thick_stick(),
        thick_graded(0.125),
        thick_graded(8.0),
        thick_coating(),
        endless(),
        slight(),
        sliding_slight(),
    ];
    all.extend(["closed-form", "compliance"].map(vanishing));
    all.extend([0.05, 0.7, 3.0, 100.0].map(own_substrate));
    all.extend([(1e-6, 1e9), (25.4, 6895.0), (1e40, 1e-40)].map(|(length, stress)| units(length, stress)));
    all
}

/// The order observed between deviations, the thickness growing by `factor` each time: that farthest from what is
/// expected.
fn order(sheet: &mut Sheet, name: &str, deviations: &[f64], factor: f64, expected: f64, slack: (f64, &str)) {
    let orders = deviations.windows(2).map(|pair| (pair[0] / pair[1]).abs().ln() / factor.ln());
    let off = |order: &f64| if order.is_nan() { f64::INFINITY } else { (order - expected).abs() };
    let found = orders.max_by(|one, other| off(one).total_cmp(&off(other))).unwrap_or(f64::NAN);
    let source = "docs/theory.md section 4: frictionless like (b/h)^2, the stick ratio like b/h";
    sheet.absolute(&format!("{name}: order in b/h"), found, expected, Within::new(slack.0, slack.1), source);
}

const THICK: [f64; 6] = [20.0, 40.0, 80.0, 160.0, 320.0, 640.0];

fn each(thick: &[f64], of: impl Fn(f64) -> Result<f64, String>, limit: f64) -> Result<Vec<f64>, String> {
    thick.iter().map(|h| Ok(of(*h)? - limit)).collect()
}

fn thick_flat() -> Case {
    Case::new("thick layer, flat punch", |sheet| {
        let edge = |h: f64| number(&Contact::flat(layer(h, 1.0, 0.3)).solve()?, "edge.ratio");
        let deviations = each(&THICK, edge, 1.0 / PI)?;
        let name = "thick homogeneous layer, flat punch: edge factor";
        order(sheet, name, &deviations, 2.0, 2.0, (0.05, "next order b/h, and 1e-10 of the solver in 1e-6"));
        let very = edge(1e4)?;
        let allowed = 1.1 * (deviations[0] * (THICK[0] / 1e4).powi(2)).abs() * PI + 1e-12;
        let within = Within::new(allowed, "the deviation at h = 20 b, scaled by (b/h)^2, and rounding");
        sheet.relative("layer of 1e4 b, flat punch: edge factor", very, 1.0 / PI, within, "half-plane");
        Ok(())
    })
}

fn thick_cylinder() -> Case {
    Case::new("thick layer, cylinder", |sheet| {
        let force = |h: f64| number(&Contact::flat(layer(h, 1.0, 0.3)).cylinder().solve()?, "load.force");
        let deviations = each(&THICK, force, PI / (2.0 * A0))?;
        let name = "thick homogeneous layer, cylinder: force";
        order(sheet, name, &deviations, 2.0, 2.0, (0.05, "next order b/h, and 1e-10 of the solver in 1e-6"));
        Ok(())
    })
}

fn thick_stick() -> Case {
    Case::new("thick layer, stick zone", |sheet| {
        let ratio = |h: f64| number(&Contact::flat(layer(h, 1.0, 0.3)).rubbing(0.3).solve()?, "stick.ratio");
        let deviations = each(&THICK[2..], ratio, stick(0.3, BETA).ratio)?;
        let name = "thick homogeneous layer, flat punch: stick ratio";
        order(sheet, name, &deviations, 2.0, 1.0, (0.05, "next order b/h"));
        Ok(())
    })
}

fn thick_graded(ratio: f64) -> Case {
    Case::new(format!("thick graded layer, mu1/mu3 = {ratio}"), move |sheet| {
        let edge = |h: f64| number(&Contact::flat(layer(h, ratio, 0.3)).solve()?, "edge.ratio");
        let deviations = each(&THICK[3..], edge, 1.0 / PI)?;
        let name = format!("thick graded layer, mu1/mu3 = {ratio}: edge factor");
        // The surface gradient gamma b is ln(ratio) b/h.
        order(sheet, &name, &deviations, 2.0, 1.0, (0.1, "next order (b/h) log(b/h)"));
        Ok(())
    })
}

fn thick_coating() -> Case {
    Case::new("thick coating", |sheet| {
        let deviation = |h: f64| -> Result<[f64; 2], String> {
            let coating = format!(
                "thickness = {h:?}\npoisson = 0.3\nbase = {{ type = \"half-plane\", shear = 3.0, poisson = 0.2 }}\n\
                 grading = {{ type = \"homogeneous\", modulus = 1.0 }}"
            );
            let solution = Contact::flat(coating).to(1e-12).solve()?;
            Ok([number(&solution, "pressure.centre")? * PI - 1.0, number(&solution, "edge.ratio")? * PI - 1.0])
        };
        let all = [deviation(10.0)?, deviation(100.0)?, deviation(1000.0)?];
        for (i, what) in ["pressure in the middle", "edge factor"].into_iter().enumerate() {
            let deviations = all.map(|both| both[i]);
            let name = format!("thick coating of a half-plane: {what}");
            order(sheet, &name, &deviations, 10.0, 2.0, (0.05, "next order b/h, and 1e-12 of the solver in 1e-7"));
        }
        Ok(())
    })
}

/// A half-plane that stiffens exponentially is a thick layer that does.
fn endless() -> Case {
    Case::new("infinite exponential", |sheet| {
        let infinite = |gradient: f64| {
            format!(
                "poisson = 0.3\nbase = {{ type = \"infinite\" }}\n\
                 grading = {{ type = \"exponential\", surface = 1.0, gradient = {gradient:?} }}"
            )
        };
        let thick =
            "thickness = 60.0\npoisson = 0.3\ngrading = { type = \"exponential\", surface = 1.0, gradient = 1.0 }";
        let contacts = |layer: &str| {
            let flat = Contact::flat(layer).to(1e-11);
            [("flat", flat.clone()), ("flat, friction", flat.clone().rubbing(0.3)), ("cylinder", flat.cylinder())]
        };
        for ((contact, one), (_, other)) in contacts(&infinite(1.0)).into_iter().zip(contacts(thick)) {
            let (one, other) = (one.solve()?, other.solve()?);
            for (path, expected) in numbers(&other) {
                let why = "the solver's own tolerance, 1e-11, of both; exp(-60) of the surface is felt at the base";
                let name = format!("infinite exponential as a layer of 60 of its lengths, {contact}: {path}");
                sheet.relative(&name, number(&one, path)?, expected, Within::new(2e-11, why), "the layer");
            }
        }
        let deviation = |gradient: f64| -> Result<f64, String> {
            Ok(number(&Contact::flat(infinite(gradient)).to(1e-11).solve()?, "edge.ratio")? * PI - 1.0)
        };
        let name = "infinite exponential, gradient -> 0: edge factor";
        let deviations = [deviation(1e-2)?, deviation(1e-3)?, deviation(1e-4)?];
        // gamma plays the part of 1/h.
        order(sheet, name, &deviations, 10.0, 1.0, (0.15, "next order gamma b log(gamma b)"));
        let name = "infinite exponential, gradient -> 0: edge factor, the smallest two";
        order(sheet, name, &deviations[1..], 10.0, 1.0, (0.1, "next order gamma b log(gamma b)"));
        Ok(())
    })
}

/// `gamma -> 0` from both sides: no jump and no kink.
fn vanishing(flexibility: &'static str) -> Case {
    Case::new(format!("vanishing gradient by {flexibility}"), move |sheet| {
        let table = format!("{{ type = \"{flexibility}\" }}");
        let at = |excess: f64| -> Result<Vec<(&'static str, f64)>, String> {
            let graded = layer(5.0, 1.0 / (1.0 + excess), 0.3);
            let pinned = "{ type = \"de-sinc\", n = 45 }";
            let contact =
                Contact::flat(graded).rubbing(0.3).by(Family::Flexibility, &table).by(Family::Quadrature, pinned);
            // The grid decides the accuracy, the same for all; its estimate of 1 - a/b is 2e-10.
            Ok(numbers(&contact.to(1e-9).solve()?))
        };
        let homogeneous = at(0.0)?;
        for excess in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
            let (above, below) = (at(excess)?, at(-excess)?);
            for (((path, middle), (_, above)), (_, below)) in homogeneous.iter().zip(&above).zip(&below) {
                let name = format!("mu3/mu1 = 1 +- {excess:e} by {flexibility}: {path}");
                let why = "derivatives with respect to ln(mu3/mu1) are of order one; 1e-12 is rounding";
                let within = Within::new(2.0 * excess + 1e-12, why);
                sheet.relative(&name, *above, *middle, within, "homogeneous");
                let bend = (above + below - 2.0 * middle) / middle;
                let within = Within::new(2.0 * excess * excess + 2e-12, "so are second ones");
                sheet.error(&format!("{name}, no kink"), bend, within, "homogeneous");
            }
        }
        Ok(())
    })
}

/// A coating of its substrate's material.
fn own_substrate(h: f64) -> Case {
    Case::new(format!("coating of its substrate's material, h = {h}"), move |sheet| {
        let coating = format!(
            "thickness = {h:?}\npoisson = 0.3\nbase = {{ type = \"half-plane\", shear = 1.0, poisson = 0.3 }}\n\
             grading = {{ type = \"homogeneous\", modulus = 1.0 }}"
        );
        let tolerance = if h < 0.1 { 1e-9 } else { 1e-11 };
        let why = "the solver's own tolerance; the kernels, which should be zeros, have a rounding that grows with b/h";
        let within = || Within::new(tolerance + 1e-11 * (1.0 + 1.0 / h), why);
        let flat = Contact::flat(&*coating).rubbing(0.3).to(tolerance).solve()?;
        let exact = stick(0.3, BETA);
        let name = |what: &str| format!("coating of its substrate's material, h = {h}: {what}");
        let expected = [
            ("pressure.centre", 1.0 / PI),
            ("edge.ratio", 1.0 / PI),
            ("stick.ratio", exact.ratio),
            ("stick.one_minus_ratio", exact.one_minus_ratio),
        ];
        for (path, expected) in expected {
            sheet.relative(&name(path), number(&flat, path)?, expected, within(), "half-plane");
        }
        let round = Contact::flat(coating).cylinder().to(tolerance).solve()?;
        for (path, expected) in [("load.force", PI / (2.0 * A0)), ("pressure.centre", 1.0 / A0)] {
            sheet.relative(
                &name(&format!("cylinder, {path}")),
                number(&round, path)?,
                expected,
                within(),
                "half-plane",
            );
        }
        Ok(())
    })
}

/// On a coated half-plane, too: to first order in what differs.
fn slight() -> Case {
    Case::new("nearly its substrate's material", |sheet| {
        let ratio = |excess: f64| -> Result<f64, String> {
            let coating = format!(
                "thickness = 1.0\npoisson = 0.3\nbase = {{ type = \"half-plane\", shear = {:?}, poisson = 0.3 }}\n\
                 grading = {{ type = \"homogeneous\", modulus = 1.0 }}",
                1.0 + excess
            );
            number(&Contact::flat(coating).solve()?, "edge.ratio")
        };
        let (less, more, none) = (ratio(-1e-4)?, ratio(1e-4)?, ratio(0.0)?);
        let within = Within::new(1e-8, "the square of the difference, 1e-8");
        let name = "substrate stiffer and softer by 1e-4: edge factor in the mean";
        sheet.relative(name, f64::midpoint(less, more), none, within, "half-plane");
        let effect = -(more - none).abs() / none;
        let within = Within::new(0.0, "what a substrate stiffer by 1e-4 does is of its order");
        sheet.at_most("substrate stiffer by 1e-4: it is felt, negative", effect, -1e-6, within, "physics");
        Ok(())
    })
}

/// Friction on a layer that slides on its base is continuous in the gradient.
fn sliding_slight() -> Case {
    Case::new("sliding layer, vanishing gradient", |sheet| {
        let ratio = |base: f64| -> Result<f64, String> {
            let sliding = format!("base = {{ type = \"frictionless\" }}\n{}", layer(3.0, 1.0 / base, 0.3));
            number(&Contact::flat(sliding).rubbing(0.3).to(1e-9).solve()?, "stick.ratio")
        };
        let middle = f64::midpoint(ratio(1.0 - 1e-5)?, ratio(1.0 + 1e-5)?);
        let within =
            Within::new(3e-9, "the solver's own tolerance, 1e-9, of three solutions; the square of 1e-5 is less");
        sheet.relative("sliding layer, gamma -> 0: stick ratio", ratio(1.0)?, middle, within, "homogeneous");
        Ok(())
    })
}

/// Force, modulus and length scaled: dimensional analysis.
fn units(length: f64, stress: f64) -> Case {
    Case::new(format!("lengths by {length:e}, stresses by {stress:e}"), move |sheet| {
        let scaled = |length: f64, stress: f64| {
            let grading = format!("{{ type = \"exponential\", surface = {stress:?}, base = {:?} }}", 8.0 * stress);
            let layer = format!("thickness = {:?}\npoisson = 0.3\ngrading = {grading}", 5.0 * length);
            let punch = format!("type = \"cylinder\"\nradius = {:?}", 10.0 * length);
            let contact = Contact::flat(layer).under(punch).rubbing(0.3).to(1e-8);
            contact.loaded(format!("force = {:?}", 0.1 * stress * length)).solve()
        };
        let (plain, other) = (scaled(1.0, 1.0)?, scaled(length, stress)?);
        for (path, value) in numbers(&plain) {
            let unit = match path {
                "load.force" => length * stress,
                "load.half_width" | "load.indentation" => length,
                "pressure.centre" => stress,
                _ => 1.0,
            };
            let why = "rounding of the scaled inputs, amplified by the root for the width of the contact";
            let name = format!("lengths by {length:e}, stresses by {stress:e}: {path}");
            let within = Within::new(1e-10, why);
            sheet.relative(&name, number(&other, path)? / unit, value, within, "dimensional analysis");
        }
        // A load scaled alone scales a flat punch's answer: the problem is linear.
        let flat =
            |force: f64| Contact::flat(HALF_PLANE.replace("0.3", "0.1")).loaded(format!("force = {force:?}")).solve();
        let name = format!("flat punch, force by {stress:e}: pressure in the middle");
        let (one, more) = (number(&flat(1.0)?, "pressure.centre")?, number(&flat(stress)?, "pressure.centre")?);
        sheet.relative(&name, more / stress, one, Within::new(1e-14, "rounding"), "linearity");
        Ok(())
    })
}
