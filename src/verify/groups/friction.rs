//! Goodman friction on a homogeneous half-plane.

use crate::engine::Status;
use crate::verify::Case;
use crate::verify::check::{Within, off, worst};
use crate::verify::contact::{A0, BETA, Contact, HALF_PLANE, claimed, number};
use slipzone_api::reference::cylinder::Cylinder;
use slipzone_api::reference::goodman_shear::Goodman;
use slipzone_api::reference::partial_slip::{self, Stick, friction};
use slipzone_api::reference::power::Power;
use slipzone_api::reference::rounded_flat::RoundedFlat;
use slipzone_api::reference::wedge::Wedge;

const X: [f64; 6] = [0.03, 0.2, 0.45, 0.7, 0.93, 0.999];
const ETA: f64 = 0.3;
const SPENCE: &str = "eta/beta = K(k)/K'(k), k = a/b: Spence (1968)";
const STACK: &str = "a stack of flat punches in elliptic integrals, docs/theory.md section 4";

fn within() -> Within {
    Within::new(1e-10, "three times the solver's own tolerance, 3e-11")
}

pub(super) fn cases() -> Vec<Case> {
    let compliance = A0;
    let mut all: Vec<Case> = [(0.3, 0.2374), (0.3, 0.5), (0.0, 0.3), (0.0, 0.6), (0.45, 0.1), (0.4, 0.05)]
        .map(|(nu, eta)| stick(nu, eta))
        .into();
    all.push(flat_shear());
    all.push(shear("cylinder", "type = \"cylinder\"\nradius = 10.0", &[], move |b| {
        Cylinder { radius: 10.0, half_width: b, compliance }.force_rate()
    }));
    all.push(shear("wedge", "type = \"wedge\"\nslope = 0.05", &[], move |b| {
        Wedge { slope: 0.05, half_width: b, compliance }.force_rate()
    }));
    all.push(shear("power 2.7", "type = \"power\"\ncoefficient = 0.05\nexponent = 2.7", &[], move |b| {
        Power { coefficient: 0.05, exponent: 2.7, half_width: b, compliance }.force_rate()
    }));
    all.push(shear("rounded flat", "type = \"rounded-flat\"\nhalf_width = 0.375\nradius = 5.0", &[0.375], move |b| {
        RoundedFlat { flat: 0.375, radius: 5.0, half_width: b, compliance }.force_rate()
    }));
    all.extend([0.2374, 0.5].map(frozen));
    all.push(uncoupled());
    all.push(sliding());
    all
}

/// The stick zone found belongs to the friction given: the quotient of elliptic integrals is evaluated at the zone that
/// the solver found.
fn stick(nu: f64, eta: f64) -> Case {
    Case::new(format!("stick zone, nu = {nu}, eta = {eta}"), move |sheet| {
        let layer = HALF_PLANE.replace("0.3", &format!("{nu:?}"));
        let solution = Contact::flat(layer).rubbing(eta).solve()?;
        let beta = (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu);
        let ratio = number(&solution, "stick.ratio")?;
        let zone = Stick { ratio, one_minus_ratio: number(&solution, "stick.one_minus_ratio")? };
        let name = |what: &str| format!("flat punch, nu = {nu}, eta = {eta}: {what}");
        let reason = "three times the solver's own tolerance, 1e-10, times d log eta/d log a or d log(b - a) < 1";
        sheet.relative(&name("eta of the a/b found"), friction(zone, beta), eta, Within::new(3e-10, reason), SPENCE);
        let exact = partial_slip::stick(eta, beta);
        for (what, path, found, exact) in [
            ("a/b", "stick.ratio", zone.ratio, exact.ratio),
            ("1 - a/b", "stick.one_minus_ratio", zone.one_minus_ratio, exact.one_minus_ratio),
        ] {
            let reason = "three times what is claimed, or 1e-12: the closed form's own rounding";
            let within = Within::new(3.0 * claimed(&solution, path).max(1e-12), reason);
            sheet.relative(&name(what), found, exact, within, SPENCE);
        }
        let sum = zone.ratio + zone.one_minus_ratio;
        sheet.relative(&name("a/b and 1 - a/b"), sum, 1.0, Within::new(1e-15, "rounding of the sum"), "arithmetic");
        Ok(())
    })
}

fn goodman() -> Goodman {
    Goodman { eta: ETA, beta: BETA }
}

fn flat_shear() -> Case {
    Case::new("shear under a flat punch", |sheet| {
        let solution = Contact::flat(HALF_PLANE).rubbing(ETA).at(&X).to(3e-11).solve()?;
        let shear = solution.profile.shear.as_ref().ok_or("there is no shear")?;
        let exact = X.map(|x| goodman().flat(1.0, 1.0, x));
        sheet.error("flat punch: shear, worst of 6 points over the largest", off(shear, &exact), within(), STACK);
        Ok(())
    })
}

fn shear(
    name: &'static str,
    punch: &'static str,
    kinks: &'static [f64],
    rate: impl Fn(f64) -> f64 + Send + Sync + 'static,
) -> Case {
    Case::new(format!("shear under a {name} punch"), move |sheet| {
        let solution = Contact::flat(HALF_PLANE).under(punch).rubbing(ETA).at(&X).to(3e-11).solve()?;
        let expected = goodman().stick().ratio;
        sheet.relative(&format!("{name}, growing: a/b"), number(&solution, "stick.ratio")?, expected, within(), SPENCE);
        let shear = solution.profile.shear.as_ref().ok_or("there is no shear")?;
        let exact = X.map(|x| goodman().grown(&rate, kinks, 1.0, x));
        let name = format!("{name}, growing: shear, worst of 6 points over the largest");
        sheet.error(&name, off(shear, &exact), within(), STACK);
        Ok(())
    })
}

/// The strain that stays under a cylinder is `C|x|`, `C R = -pi eta/(2 k K(k))`.
fn frozen(eta: f64) -> Case {
    Case::new(format!("frozen strain, eta = {eta}"), move |sheet| {
        let law = Goodman { eta, beta: BETA };
        let source = "C R = -pi eta/(2 k K(k)), docs/theory.md section 4";
        let rate = law.frozen_strain();
        let contact = Contact::flat(HALF_PLANE).cylinder().to(1e-8);
        let grown = contact.clone().rubbing(eta).strained_at(&[0.1, 0.25, 0.4]).solve()?;
        let a = number(&grown, "stick.ratio")?;
        let strain = grown.profile.strain.as_ref().ok_or("there is no strain")?;
        let errors =
            grown.profile.x.iter().zip(strain).filter_map(|(x, strain)| Some(((*strain)? - rate * x) / (rate * a)));
        let errors: Vec<f64> = errors.collect();
        sheet.error(
            &format!("cylinder, eta = {eta}: strain left, worst of {} points over that at a", errors.len()),
            if errors.is_empty() { f64::NAN } else { worst(errors) },
            Within::new(3e-8, "three times the solver's own tolerance, 1e-8: a principal value of the tractions"),
            source,
        );
        let linear = contact.rubbing_linear(eta).at(&X).solve()?;
        let shear = linear.profile.shear.as_ref().ok_or("there is no shear")?;
        let pressed = |half_width| Cylinder { radius: 1.0, half_width, compliance: A0 }.force_rate();
        let exact = X.map(|x| law.grown(pressed, &[], 1.0, x));
        sheet.error(
            &format!(
                "cylinder, eta = {eta}: shear where the strain is taken to be C|x|, worst of 6 points over the largest"
            ),
            off(shear, &exact),
            Within::new(6e-8, "six times the solver's own tolerance, 1e-8, which a shear may be off by"),
            source,
        );
        let found = linear.stick.as_ref().and_then(|stick| stick.strain_rate).ok_or("there is no rate")?;
        sheet.relative(
            &format!("cylinder, eta = {eta}: C R where the strain is taken to be C|x|"),
            found,
            rate,
            Within::new(3e-9, "the height of an extremum, solved to 1e-8, is known to more digits than its place"),
            source,
        );
        Ok(())
    })
}

/// Where `beta = 0` pressure drags the surface nowhere.
fn uncoupled() -> Case {
    Case::new("no coupling", |sheet| {
        let solution = Contact::flat(HALF_PLANE.replace("0.3", "0.5")).rubbing(0.3).at(&X).solve()?;
        let source = "beta = 0: pressure drags the surface nowhere";
        let exact = || Within::new(0.0, "a product with an exact zero");
        sheet.absolute("incompressible: a/b", number(&solution, "stick.ratio")?, 1.0, exact(), source);
        let shear = solution.profile.shear.as_ref().ok_or("there is no shear")?;
        let largest = worst(shear.iter().map(|q| q.unwrap_or(f64::NAN)));
        sheet.error("incompressible: largest shear", largest, exact(), source);
        Ok(())
    })
}

/// With next to no friction all slides, and `q = eta p` everywhere.
fn sliding() -> Case {
    Case::new("full sliding", |sheet| {
        let eta = 1e-3;
        let x = [-0.6, 0.3, 0.9];
        let solution = Contact::flat(HALF_PLANE).rubbing(eta).at(&x).attempt()?;
        let reason = "a/b = 4 exp(-pi beta/(2 eta)) = 1e-194 is below what can be found: a bound, and said so";
        sheet.same(
            "full sliding: status",
            &format!("{:?}", solution.status),
            &format!("{:?}", Status::NotConverged),
            reason,
            SPENCE,
        );
        sheet.at_most(
            "full sliding: the bound on a/b claims no digit",
            -claimed(&solution, "stick.ratio"),
            -1.0,
            Within::new(0.0, "a bound has no digits"),
            "an error of 1 or more",
        );
        let shear = solution.profile.shear.as_ref().ok_or("there is no shear")?;
        let sides = shear.iter().zip(&solution.profile.pressure).zip(x);
        let errors = sides.map(|((q, p), x)| match (q, p) {
            (Some(q), Some(p)) => q / (x.signum() * eta * p) - 1.0,
            _ => f64::NAN,
        });
        let within = Within::new(1e-14, "rounding of a product and a quotient");
        sheet.error("full sliding: q = eta p, worst of 3 points", worst(errors), within, "Coulomb's law");
        Ok(())
    })
}
