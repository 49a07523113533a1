//! Tables of another program, solved as a user would: by the methods that the solver chooses.

use crate::engine::Solution;
use crate::verify::Case;
use crate::verify::check::{Sheet, Within, worst};
use crate::verify::contact::{Contact, claimed, layer};
use crate::verify::references::{cases as entries, half_a_unit, list, number};
use serde_json::Value;

const LAYERS: &str = include_str!("../../../tests/data/layer_cases.json");
const THIN: &str = include_str!("../../../tests/data/thin_layers.json");
const OTHERS: &str = include_str!("../../../tests/data/other_layers.json");
const OUTWARD: &str = include_str!("../../../tests/data/outward_slip.json");
const SHEAR: &str = include_str!("../../../tests/data/cylinder_shear.json");

/// The layers of `other_layers.json`, in its order.
const OTHER_LAYERS: [&str; 6] = [
    "thickness = 5.0\npoisson = 0.3\ngrading = { type = \"power-law\", surface = 1.0, length = 2.0, exponent = 2.0 }",
    "thickness = 2.0\npoisson = 0.3\nbase = { type = \"half-plane\", shear = 2.0, poisson = 0.25 }\n\
     grading = { type = \"exponential\", surface = 1.0, base = 4.0 }",
    "thickness = 1.5\npoisson = 0.3\nbase = { type = \"half-plane\", shear = 5.0, poisson = 0.2 }\n\
     grading = { type = \"homogeneous\", modulus = 1.0 }",
    // A third, to the last bit.
    "thickness = 3.0\npoisson = 0.2\nbase = { type = \"frictionless\" }\n\
     grading = { type = \"exponential\", surface = 1.0, base = 0.3333333333333333 }",
    "thickness = 5.0\npoisson = 0.3\nplane = \"stress\"\n\
     grading = { type = \"exponential\", surface = 1.0, base = 0.125 }",
    "poisson = 0.3\ngrading = { type = \"stack\", layers = [\
     { thickness = 0.5, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
     { thickness = 1.0, poisson = 0.25, grading = { type = \"homogeneous\", modulus = 3.0 } }, \
     { thickness = 0.8, poisson = 0.35, grading = { type = \"homogeneous\", modulus = 0.5 } }] }",
];

pub(super) fn cases() -> Vec<Case> {
    let mut all = entries("layer_cases.json", LAYERS, |case, _| {
        let name = heading(&case);
        Case::new(format!("layer_cases.json: {name}"), move |sheet| {
            Table { name: name.clone(), text: LAYERS, source: "tests/data/layer_cases.json" }.all_of(
                sheet,
                &own_layer(&case)?,
                &case,
            )
        })
    });
    all.extend(entries("other_layers.json", OTHERS, |case, i| {
        let name = case["layer"].as_str().unwrap_or("an entry without a name").to_owned();
        Case::new(format!("other_layers.json: {name}"), move |sheet| {
            let layer = OTHER_LAYERS.get(i).ok_or("a layer that this program does not know")?;
            Table { name: name.clone(), text: OTHERS, source: "tests/data/other_layers.json" }
                .all_of(sheet, layer, &case)
        })
    }));
    all.extend(entries("thin_layers.json", THIN, thin));
    all.extend(entries("outward_slip.json", OUTWARD, outward));
    all.extend(entries("cylinder_shear.json", SHEAR, shear));
    all
}

fn heading(case: &Value) -> String {
    format!("h/b = {}, mu1/mu3 = {}, nu = {}", case["h_over_b"], case["mu1_over_mu3"], case["nu"])
}

fn own_layer(case: &Value) -> Result<String, String> {
    Ok(layer(number(case, "h_over_b")?, number(case, "mu1_over_mu3")?, number(case, "nu")?))
}

/// An entry of a table.
struct Table {
    name: String,
    text: &'static str,
    source: &'static str,
}

impl Table {
    /// A number beside its reference, which is `null` where there is none: its error, and whether what is claimed of it
    /// covers it.
    fn compare(
        &self,
        sheet: &mut Sheet,
        what: &str,
        solution: &Solution,
        path: &str,
        found: Option<f64>,
        reference: &Value,
    ) -> Result<(), String> {
        let Some(reference) = reference.as_f64() else { return Ok(()) };
        let found = found.ok_or_else(|| format!("{}{what}: {path} is missing", self.name))?;
        let (digits, claimed) = (half_a_unit(self.text, reference)?, claimed(solution, path));
        let name = format!("{}{what}: {path}", self.name);
        let why = "the solver's own tolerance, 1e-10, and a unit of the last digit printed";
        sheet.relative(&name, found, reference, Within::new(1e-10 + 2.0 * digits, why), self.source);
        let error = (found / reference - 1.0).abs();
        let why = "a unit of the last digit printed: the reference is no better known";
        let within = Within::new(2.0 * digits, why);
        sheet.at_most(&format!("{name}, error within what is claimed"), error, claimed, within, "the claimed error");
        Ok(())
    }

    /// A flat punch, a cylinder and the stick zones of one layer, beside the numbers of its entry.
    fn all_of(&self, sheet: &mut Sheet, layer: &str, case: &Value) -> Result<(), String> {
        let flat = Contact::flat(layer).by_plan();
        let solution = flat.solve()?;
        for (path, found, key) in [
            ("edge.ratio", solution.edge.ratio, "edge"),
            ("load.indentation", solution.load.indentation, "delta"),
            ("pressure.centre", solution.pressure.centre, "p0"),
        ] {
            self.compare(sheet, ", flat", &solution, path, found, &case["flat"][key])?;
        }
        let round = flat.clone().cylinder().solve()?;
        for (path, found, key) in
            [("load.force", round.load.force, "P"), ("pressure.centre", round.pressure.centre, "p0")]
        {
            self.compare(sheet, ", cylinder", &round, path, found, &case["cylinder"][key])?;
        }
        let stick = case["stick"].as_object().ok_or("the table has no stick ratios")?;
        for (eta, ratio) in stick.iter().filter(|(_, ratio)| !ratio.is_null()) {
            let coefficient = eta.parse().map_err(|_| format!("{eta} is no friction coefficient"))?;
            let solution = flat.clone().rubbing(coefficient).solve()?;
            let found = solution.stick.as_ref().and_then(|stick| stick.ratio);
            self.compare(sheet, &format!(", eta = {eta}"), &solution, "stick.ratio", found, ratio)?;
        }
        Ok(())
    }
}

fn thin(case: Value, _: usize) -> Case {
    let name = heading(&case);
    Case::new(format!("thin_layers.json: {name}"), move |sheet| {
        // What the kernels prove of their rounding grows with b/h; the default tolerance is met.
        let solution = Contact::flat(own_layer(&case)?).by_plan().to(1e-8).solve()?;
        let table = Table { name: name.clone(), text: THIN, source: "tests/data/thin_layers.json" };
        table.compare(sheet, ", thin", &solution, "edge.ratio", solution.edge.ratio, &case["edge"])?;
        table.compare(sheet, ", thin", &solution, "pressure.centre", solution.pressure.centre, &case["p0"])
    })
}

fn outward(case: Value, _: usize) -> Case {
    let name = format!("{}, eta = {}", heading(&case), case["eta"]);
    Case::new(format!("outward_slip.json: {name}"), move |sheet| {
        let flat = Contact::flat(own_layer(&case)?).by_plan();
        let solution = flat.rubbing(number(&case, "eta")?).at(&[0.5, 0.99]).solve()?;
        let stick = solution.stick.as_ref().ok_or("there is no stick zone")?;
        let table = Table { name: name.clone(), text: OUTWARD, source: "tests/data/outward_slip.json" };
        table.compare(sheet, ", outward slip", &solution, "stick.ratio", stick.ratio, &case["stick"])?;
        let slip = stick.slip.map_or("none".into(), |slip| format!("{slip:?}").to_lowercase());
        let reason = "the direction is found, not assumed";
        sheet.same(&format!("{name}: direction of slip"), &slip, "outward", reason, table.source);
        let edge = solution.profile.shear.as_ref().and_then(|q| *q.last()?).unwrap_or(f64::NAN);
        let within = Within::new(0.0, "the sign alone");
        sheet.at_most(&format!("{name}: q beside the right edge"), edge, 0.0, within, "q = -eta p");
        Ok(())
    })
}

fn shear(case: Value, _: usize) -> Case {
    let name = format!("{}, eta = {}", heading(&case), case["eta"]);
    Case::new(format!("cylinder_shear.json: {name}"), move |sheet| {
        let (x, q) = (list(&case, "x_over_b")?, list(&case, "q")?);
        let contact = Contact::flat(own_layer(&case)?).cylinder().rubbing(number(&case, "eta")?);
        let solution = contact.by_plan().at(&x).to(1e-8).solve()?;
        let found = solution.stick.as_ref().and_then(|stick| stick.ratio);
        let table = Table { name: name.clone(), text: SHEAR, source: "tests/data/cylinder_shear.json" };
        let reference = number(&case, "stick")?;
        let within = Within::new(
            1e-8 + 2.0 * half_a_unit(SHEAR, reference)?,
            "the solver's own tolerance, 1e-8, and a unit of the last digit printed",
        );
        let name = |what: &str| format!("{name}, growing cylinder: {what}");
        sheet.relative(&name("a/b"), found.unwrap_or(f64::NAN), reference, within, table.source);
        let shear = solution.profile.shear.as_ref().ok_or("there is no shear")?;
        let errors: Vec<f64> = shear.iter().zip(&q).map(|(found, q)| found.unwrap_or(f64::NAN) / q - 1.0).collect();
        let within = Within::new(1e-6, "what the table trusts its own numbers to");
        sheet.error(&name(&format!("shear, worst of {} points", errors.len())), worst(errors), within, table.source);
        Ok(())
    })
}
