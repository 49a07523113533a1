//! Whole contacts by different methods: nothing is shared but the scene.

use crate::engine::foreign::BREACH;
use crate::engine::{Solution, Status};
use crate::scene::example::least;
use crate::verify::Case;
use crate::verify::check::{Sheet, Within, off, worst};
use crate::verify::contact::{Contact, claimed, layer, members, number, numbers};
use slipzone_api::Family;

/// Where tractions are compared, in half-widths.
const AT: [f64; 7] = [0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 0.95];

/// Name, contact, and the tolerance that every method is to meet.
fn contacts() -> [(&'static str, Contact, f64); 6] {
    [
        ("flat, homogeneous", Contact::flat(layer(5.0, 1.0, 0.3)), 1e-9),
        ("flat with friction, homogeneous", Contact::flat(layer(5.0, 1.0, 0.3)).rubbing(0.3), 1e-7),
        ("flat, mu1/mu3 = 8", Contact::flat(layer(5.0, 8.0, 0.3)), 1e-6),
        ("flat with friction, mu1/mu3 = 1/8", Contact::flat(layer(5.0, 0.125, 0.3)).rubbing(0.3), 1e-3),
        ("cylinder, homogeneous, h = b", Contact::flat(layer(1.0, 1.0, 0.45)).cylinder(), 1e-9),
        ("cylinder, mu1/mu3 = 1/8", Contact::flat(layer(5.0, 0.125, 0.3)).cylinder(), 3e-6),
    ]
}

pub(super) fn cases() -> Vec<Case> {
    let by_family = |family: Family| {
        let usual = match family {
            Family::Flexibility => "compliance",
            Family::Kernel => "split",
            _ => "de-sinc",
        };
        members(family).filter(move |info| info.name != usual).map(move |info| {
            let table = least(info, None);
            Case::new(info.name, move |sheet| {
                against(sheet, family, (info.name, &table), usual);
                Ok(())
            })
        })
    };
    [Family::Flexibility, Family::Kernel, Family::Quadrature].into_iter().flat_map(by_family).collect()
}

/// How far tractions within the contact are apart: pressures over what they are or their mean, shears over the largest.
fn tractions_apart(found: &Solution, expected: &Solution) -> Vec<(&'static str, f64)> {
    let mean = expected.pressure.mean.unwrap_or_default();
    let pairs = found.profile.pressure.iter().zip(expected.profile.pressure.iter().flatten());
    let pressure = worst(pairs.map(|(p, known)| (p.unwrap_or(f64::NAN) - known) / known.abs().max(mean)));
    let shears = found.profile.shear.as_ref().zip(expected.profile.shear.as_ref());
    let shear = shears.map(|(q, known)| off(q, &known.iter().copied().flatten().collect::<Vec<_>>()));
    [("profile.pressure", pressure)].into_iter().chain(shear.map(|shear| ("profile.shear", shear))).collect()
}

/// A method against the usual one of its family: a contact that fails leaves the others to be compared.
fn against(sheet: &mut Sheet, family: Family, (method, table): (&str, &str), usual: &str) {
    let mut compared = 0;
    for (what, contact, tolerance) in contacts() {
        let compare = |sheet: &mut Sheet| {
            let contact = contact.clone().at(&AT);
            let own = contact.clone().to(tolerance.min(1e-9)).solve()?;
            let other = contact.by(family, table).to(tolerance);
            // Of its kernels jumps and logarithms are not told apart, which no other quadrature sums.
            let by_panels = |other: Contact| other.by(Family::Quadrature, "{ type = \"graded-panels\" }");
            let other = if method == "octaves" { by_panels(other) } else { other }.attempt()?;
            let is_limit = !other.reason.as_ref().is_some_and(|reason| reason.contains(BREACH));
            if other.status == Status::Refused && is_limit {
                // A limit of the method, which says so.
                return Ok(false);
            }
            if other.status != Status::Converged {
                return Err(other.reason.unwrap_or_default());
            }
            for (path, value) in numbers(&own) {
                let error = claimed(&own, path) + claimed(&other, path);
                let within = Within::new(2.0 * error + 1e-14, "twice what both claim of their errors");
                let name = format!("{what}: {path} by {usual} and by {method}");
                sheet.relative(&name, number(&other, path)?, value, within, &format!("by {usual}"));
            }
            for (path, apart) in tractions_apart(&other, &own) {
                let error = claimed(&own, path) + claimed(&other, path);
                let within = Within::new(
                    tolerance.max(3.0 * error),
                    "three times what both claim of their errors, or the tolerance",
                );
                sheet.error(
                    &format!("{what}: {path} by {usual} and by {method}"),
                    apart,
                    within,
                    &format!("by {usual}"),
                );
            }
            Ok(true)
        };
        match compare(sheet) {
            Ok(given) => compared += usize::from(given),
            Err(why) => sheet.no_number(&format!("{what} by {method}"), why),
        }
    }
    sheet.compared(&format!("{method} against {usual}: contacts"), compared, 1);
}
