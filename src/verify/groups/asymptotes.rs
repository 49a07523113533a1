//! The ends of the range: next to no friction and next to no slip, very short and very long waves.

use crate::verify::Case;
use crate::verify::check::{Within, worst};
use crate::verify::contact::{BETA, Contact, HALF_PLANE, number};
use crate::verify::layers::compliance;
use std::f64::consts::PI;

pub(super) fn cases() -> Vec<Case> {
    let mut all: Vec<Case> = [1e-11, 1e-8, 1e-5].map(narrow).into();
    all.extend([1e-11, 1e-8, 1e-5].map(wide));
    all.push(short_waves());
    all
}

/// `a/b = 4 exp(-pi beta/(2 eta))` for little friction.
fn narrow(share: f64) -> Case {
    Case::new(format!("little friction, a/b = {share:e}"), move |sheet| {
        let eta = PI * BETA / (2.0 * (4.0 / share).ln());
        let solution = Contact::flat(HALF_PLANE).rubbing(eta).to(1e-8).solve()?;
        let why = "the solver's own tolerance, 1e-8; the next term is (a/b)^2/4";
        let within = Within::new(1e-8 + share * share, why);
        let name = format!("little friction, eta = {eta:.4}: a/b");
        sheet.relative(
            &name,
            number(&solution, "stick.ratio")?,
            share,
            within,
            "4 exp(-pi beta/(2 eta)), Spence (1968)",
        );
        Ok(())
    })
}

/// `1 - a/b = 8 exp(-pi eta/beta)` for much.
fn wide(share: f64) -> Case {
    Case::new(format!("much friction, 1 - a/b = {share:e}"), move |sheet| {
        let eta = BETA * (8.0 / share).ln() / PI;
        let solution = Contact::flat(HALF_PLANE).rubbing(eta).to(1e-8).solve()?;
        let why = "the solver's own tolerance, 1e-8; the next term is of order 1 - a/b";
        let within = Within::new(1e-8 + share, why);
        let name = format!("much friction, eta = {eta:.4}: 1 - a/b");
        let found = number(&solution, "stick.one_minus_ratio")?;
        sheet.relative(&name, found, share, within, "8 exp(-pi eta/beta), Spence (1968)");
        Ok(())
    })
}

/// `s F -> A0 [[1, -beta], [-beta, 1]]` for any grading: a short wave sees the surface alone.
fn short_waves() -> Case {
    Case::new("short waves", |sheet| {
        let layers = [
            ("exponential", "{ type = \"exponential\", surface = 1.0, base = 8.0 }"),
            ("linear", "{ type = \"linear\", surface = 2.0, base = 1.0 }"),
            ("power law", "{ type = \"power-law\", surface = 1.0, length = 1.0, exponent = 2.0 }"),
            ("error function", "{ type = \"error-function\", above = 1.0, below = 4.0, centre = 1.0, width = 0.5 }"),
            (
                "mixture",
                "{ type = \"volume-fraction\", surface = { modulus = 1.0, poisson = 0.3 }, \
                 base = { modulus = 3.0, poisson = 0.2 }, exponent = 1.0, rule = \"mori-tanaka\" }",
            ),
        ];
        for (name, grading) in layers {
            let response = compliance(&format!("thickness = 3.0\npoisson = 0.3\ngrading = {grading}"))?;
            let s = 1e7;
            let found = response.surface(s).map_err(|refusal| refusal.to_string())?;
            let errors = [found.vv - 1.0, found.uu - 1.0, found.uv + BETA];
            let within = Within::new(1e-6, "gradient over wave number, 1e-7, times factors of order ten");
            sheet.error(&format!("{name}: s F/A0 at s h = 1e7"), worst(errors), within, "1, 1, -beta");
        }
        Ok(())
    })
}
