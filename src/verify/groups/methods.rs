//! Whole contacts by different methods: nothing is shared but the scene.

use crate::engine::Status;
use crate::scene::example::least;
use crate::verify::Case;
use crate::verify::check::{Sheet, Within};
use crate::verify::contact::{Contact, claimed, layer, members, number, numbers};
use slipzone_api::Family;

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

/// A method against the usual one of its family: a contact that fails leaves the others to be compared.
fn against(sheet: &mut Sheet, family: Family, (method, table): (&str, &str), usual: &str) {
    let mut compared = 0;
    for (what, contact, tolerance) in contacts() {
        let compare = |sheet: &mut Sheet| {
            let own = contact.clone().to(tolerance.min(1e-9)).solve()?;
            let other = contact.clone().by(family, table).to(tolerance);
            // Of its kernels jumps and logarithms are not told apart, which no other quadrature sums.
            let by_panels = |other: Contact| other.by(Family::Quadrature, "{ type = \"graded-panels\" }");
            let other = if method == "octaves" { by_panels(other) } else { other }.attempt()?;
            if other.status == Status::Refused {
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
            Ok(true)
        };
        match compare(sheet) {
            Ok(given) => compared += usize::from(given),
            Err(why) => sheet.no_number(&format!("{what} by {method}"), why),
        }
    }
    sheet.compared(&format!("{method} against {usual}: contacts"), compared, 1);
}
