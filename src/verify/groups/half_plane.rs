//! Contacts on a homogeneous half-plane without friction.

use crate::verify::Case;
use crate::verify::check::{Within, off, worst};
use crate::verify::contact::{A0, Contact, HALF_PLANE, number};
use slipzone_api::reference::cylinder::Cylinder;
use slipzone_api::reference::power::Power;
use slipzone_api::reference::rounded_flat::RoundedFlat;
use slipzone_api::reference::wedge::Wedge;
use slipzone_api::reference::{abel, flat_punch};
use std::f64::consts::PI;

/// Points of the contact, none of them on a kink.
const X: [f64; 6] = [0.03, 0.2, 0.45, 0.7, 0.93, 0.999];

/// The solver's tolerance here.
const TIGHT: f64 = 3e-11;

fn within() -> Within {
    Within::new(1e-10, "three times the solver's own tolerance, 3e-11")
}

/// A punch whose force and pressure are known.
fn known(
    name: &'static str,
    punch: &'static str,
    source: &'static str,
    force: f64,
    pressure: impl Fn(f64) -> f64 + Send + Sync + 'static,
) -> Case {
    Case::new(name, move |sheet| {
        let solution = Contact::flat(HALF_PLANE).under(punch).at(&X).to(TIGHT).solve()?;
        sheet.relative(&format!("{name}: force"), number(&solution, "load.force")?, force, within(), source);
        let exact = X.map(&pressure);
        let error = off(&solution.profile.pressure, &exact);
        sheet.error(&format!("{name}: pressure, worst of 6 points over the largest"), error, within(), source);
        Ok(())
    })
}

pub(super) fn cases() -> Vec<Case> {
    let (half_width, compliance) = (1.0, A0);
    let wedge = Wedge { slope: 0.05, half_width, compliance };
    let power = |exponent: f64| Power { coefficient: 0.05, exponent, half_width, compliance };
    let rounded = RoundedFlat { flat: 0.375, radius: 5.0, half_width, compliance };
    let round = Cylinder { radius: 10.0, half_width, compliance };
    // g' of a wedge of slope 0.1 whose tip has the radius 4: kink at 0.4.
    let blunt = abel::force(|x| (x / 4.0).min(0.1), &[0.4], 1.0, A0);
    // dP/db of a profile follows from its force at nearby widths; of this one from Abel's integral itself,
    // dP/db = (2 b/A0) int_0^b g''(r)/sqrt(b^2 - r^2) dr.
    let blunt_rate = |b: f64| 2.0 * b / (4.0 * A0) * if b > 0.4 { (0.4 / b).asin() } else { PI / 2.0 };
    let mut all = vec![
        flat(),
        known("wedge", "type = \"wedge\"\nslope = 0.05", "Johnson (1985) sec. 5.2", wedge.force(), move |x| {
            wedge.pressure(x)
        }),
        known("cylinder", "type = \"cylinder\"\nradius = 10.0", "Johnson (1985) sec. 4.2", round.force(), move |x| {
            round.pressure(x)
        }),
        known(
            "rounded flat punch",
            "type = \"rounded-flat\"\nhalf_width = 0.375\nradius = 5.0",
            "Schubert (1942)",
            rounded.force(),
            move |x| rounded.pressure(x),
        ),
        known(
            "rounded wedge",
            "type = \"rounded-wedge\"\nslope = 0.1\nradius = 4.0",
            "Abel's integrals, Shtaerman (1949)",
            blunt,
            move |x| abel::pressure(blunt_rate, &[0.4], 1.0, x),
        ),
        // P = (pi/A0) (c2 b^2 + (3/2) c4 b^4)
        known(
            "polynomial punch",
            "type = \"polynomial\"\ncoefficients = [0.05, 0.02]",
            "Abel's integrals, Shtaerman (1949)",
            PI / A0 * (0.05 + 1.5 * 0.02),
            // A cylinder and a fourth power, and pressures add.
            |x| {
                let root = ((1.0 - x) * (1.0 + x)).sqrt();
                root / A0 * (2.0 * 0.05 + 4.0 * 0.02 * (0.5 + x * x))
            },
        ),
        cylinder_in_numbers(),
    ];
    for (name, punch, exponent) in [
        ("power 1.5", "type = \"power\"\ncoefficient = 0.05\nexponent = 1.5", 1.5),
        ("power 3", "type = \"power\"\ncoefficient = 0.05\nexponent = 3.0", 3.0),
        ("power 7.5", "type = \"power\"\ncoefficient = 0.05\nexponent = 7.5", 7.5),
    ] {
        let power = power(exponent);
        all.push(known(name, punch, "Abel's integrals, Shtaerman (1949)", power.force(), move |x| power.pressure(x)));
    }
    all.extend([0.3, 5.0, 1e3].map(depth));
    all
}

fn flat() -> Case {
    Case::new("flat punch", |sheet| {
        let source = "Sadowsky (1928), p = P/(pi sqrt(b^2 - x^2))";
        for nu in [-0.5, 0.0, 0.3, 0.5] {
            let layer = HALF_PLANE.replace("0.3", &format!("{nu:?}"));
            let solution = Contact::flat(layer).at(&X).to(TIGHT).solve()?;
            let name = |what: &str| format!("flat punch, nu = {nu}: {what}");
            sheet.relative(&name("edge factor 1/pi"), number(&solution, "edge.ratio")?, 1.0 / PI, within(), source);
            let intensity = solution.edge.stress_intensity.ok_or("there is no stress intensity")?;
            let expected = flat_punch::stress_intensity(1.0, 1.0);
            sheet.relative(&name("stress intensity"), intensity, expected, within(), source);
            let errors = X
                .iter()
                .zip(&solution.profile.pressure)
                .map(|(x, p)| p.unwrap_or(f64::NAN) / flat_punch::pressure(1.0, 1.0, 1.0 - x) - 1.0);
            sheet.error(&name("pressure, worst of 6 points"), worst(errors), within(), source);
        }
        Ok(())
    })
}

/// Elastic constants from first principles: no constant of the program is on the expected side.
fn cylinder_in_numbers() -> Case {
    Case::new("cylinder, elastic constants", |sheet| {
        // mu, nu, plane, kappa
        let solids: [(f64, f64, &str, f64); 4] = [
            (1.0, 0.3, "strain", 3.0 - 4.0 * 0.3),
            (2.0, -0.25, "strain", 3.0 + 4.0 * 0.25),
            (1.0, 0.3, "stress", 2.7 / 1.3),
            (0.5, 0.5, "stress", 2.5 / 1.5),
        ];
        for (mu, nu, plane, kappa) in solids {
            let layer = format!(
                "poisson = {nu:?}\nplane = \"{plane}\"\nbase = {{ type = \"infinite\" }}\n\
                 grading = {{ type = \"homogeneous\", modulus = {mu:?} }}"
            );
            let solution = Contact::flat(layer).cylinder().to(TIGHT).solve()?;
            let expected = PI / 2.0 / ((kappa + 1.0) / (4.0 * mu));
            let name = format!("cylinder, plane {plane}, mu = {mu}, nu = {nu}: P = pi b^2/(2 A0 R)");
            let source = "Johnson (1985) sec. 4.2; kappa = 3 - 4 nu or (3 - nu)/(1 + nu)";
            sheet.relative(&name, number(&solution, "load.force")?, expected, within(), source);
        }
        Ok(())
    })
}

/// The middle of a flat punch sinks against a datum at depth `d` below it by
/// `(A0/pi) int (1 - exp(-s d) (1 + 2 s d/(kappa + 1))) J0(s)/s ds`, wherever the solid is cut.
fn depth(datum: f64) -> Case {
    Case::new(format!("datum at {datum}"), move |sheet| {
        // 2/(kappa + 1) = 1/(2 A0)
        let exact = A0 / PI * (datum.asinh() - datum / datum.hypot(1.0) / (2.0 * A0));
        let infinite = format!("datum = {datum:?}\n{HALF_PLANE}");
        let cut = |h: f64| {
            format!(
                "thickness = {h:?}\npoisson = 0.3\ndatum = {datum:?}\ngrading = {{ type = \"homogeneous\", modulus = 1.0 }}\n\
                 base = {{ type = \"half-plane\", shear = 1.0, poisson = 0.3 }}"
            )
        };
        for (name, layer) in [("in one piece", infinite), ("cut at 1", cut(1.0)), ("cut at 5", cut(5.0))] {
            let solution = Contact::flat(layer).solve()?;
            sheet.relative(
                &format!("flat punch, half-plane {name}: indentation against a datum at {datum}"),
                number(&solution, "load.indentation")?,
                exact,
                Within::new(3e-10, "three times the solver's own tolerance, 1e-10"),
                "(A0/pi) (asinh d - 2/(kappa + 1) d/sqrt(1 + d^2)), docs/theory.md section 7",
            );
        }
        Ok(())
    })
}
