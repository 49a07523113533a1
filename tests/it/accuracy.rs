//! The error estimate against the truth: references of a program that shares no code with this one.

use crate::sketch::Sketch;
use serde_json::Value;
use slipzone::engine::{Solution, Status};

/// Two digits finer than the default, and about as many digits as the references have.
const TIGHT: &str = "[solver]\ntolerance = 1e-10";

/// A file of references: its text, whose digits say how well each number is known, and its cases.
struct References {
    text: &'static str,
    cases: Vec<Value>,
}

impl References {
    fn read(text: &'static str) -> Self {
        let file: Value = serde_json::from_str(text).expect("valid JSON");
        Self { text, cases: file["cases"].as_array().expect("a list").clone() }
    }

    /// Half a unit of the last digit printed.
    fn half_a_unit(&self, reference: f64) -> f64 {
        let shortest = format!("{reference}");
        let at = self.text.find(&shortest).unwrap_or_else(|| panic!("{shortest} is printed in the file"));
        // The last digits may be zeros, which a number forgets.
        let printed = self.text[at..].split(|c: char| !(c.is_ascii_digit() || c == '.')).next().expect("a number");
        let decimals = printed.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        0.5 * 10.0_f64.powi(-i32::try_from(decimals).expect("a few digits"))
    }

    /// The scene of a case: a flat punch without friction, by default methods.
    fn plain(case: &Value) -> Sketch {
        let number = |key: &str| case[key].as_f64().expect("a number");
        Sketch::flat(number("h_over_b"), number("mu1_over_mu3"), number("nu"))
    }

    /// The same, to two digits more.
    fn flat(case: &Value) -> Sketch {
        Self::plain(case).with(TIGHT)
    }

    /// Numbers of a solution beside their references; what is `null` there is left out.
    fn compare(&self, name: &str, solution: &Solution, numbers: &[(&str, Option<f64>, &Value)]) -> Vec<Compared> {
        let compared = numbers.iter().filter_map(|(path, got, reference)| {
            let reference = reference.as_f64()?;
            let got = got.unwrap_or_else(|| panic!("{name}: {path} is missing"));
            Some(Compared {
                what: format!("{name}: {path}"),
                error: (got / reference - 1.0).abs(),
                estimate: solution.error.each[*path],
                digits: self.half_a_unit(reference) / reference.abs(),
            })
        });
        compared.collect()
    }

    /// A flat punch, a cylinder and the stick zones of one layer, beside the numbers of its case.
    fn all_of(&self, name: &str, flat: &Sketch, case: &Value) -> Vec<Compared> {
        let solution = converged(flat);
        // On a half-plane there is none, and the file has none.
        assert_eq!(solution.load.indentation.is_some(), case["flat"]["delta"].is_number(), "{name}");
        let numbers = [
            ("edge.ratio", solution.edge.ratio, &case["flat"]["edge"]),
            ("load.indentation", solution.load.indentation, &case["flat"]["delta"]),
            ("pressure.centre", solution.pressure.centre, &case["flat"]["p0"]),
        ];
        let mut all = self.compare(name, &solution, &numbers);
        let round = converged(&flat.clone().cylinder());
        let numbers = [
            ("load.force", round.load.force, &case["cylinder"]["P"]),
            ("pressure.centre", round.pressure.centre, &case["cylinder"]["p0"]),
        ];
        all.extend(self.compare(&format!("{name}, cylinder"), &round, &numbers));
        for (eta, ratio) in case["stick"].as_object().expect("a table").iter().filter(|(_, ratio)| !ratio.is_null()) {
            let solution = converged(&flat.clone().rubbing(eta.parse().expect("a number")));
            let got = solution.stick.as_ref().and_then(|s| s.ratio);
            all.extend(self.compare(&format!("{name}, eta = {eta}"), &solution, &[("stick.ratio", got, ratio)]));
        }
        all
    }
}

fn converged(sketch: &Sketch) -> Solution {
    let solution = sketch.solve();
    assert_eq!(solution.status, Status::Converged, "{sketch:?}: {:?}", solution.reason);
    solution
}

/// A number of a solution beside its reference.
struct Compared {
    what: String,
    /// Relative error against the reference.
    error: f64,
    /// Relative error that the solution claims.
    estimate: f64,
    /// What the digits printed in the reference leave open, relative.
    digits: f64,
}

/// Every error within three times what is claimed for it, or what the reference itself leaves open.
fn assert_honest(all: &[Compared]) {
    for c in all {
        println!("{:60} error {:.1e} estimate {:.1e} digits {:.1e}", c.what, c.error, c.estimate, c.digits);
    }
    for c in all {
        let Compared { what, error, estimate, digits } = c;
        assert!(
            *error <= 3.0 * estimate.max(*digits),
            "{what}: error {error:.2e}, estimate {estimate:.2e}, digits {digits:.2e}"
        );
    }
}

#[test]
fn layers_of_moderate_thickness() {
    let references = References::read(include_str!("../data/layer_cases.json"));
    let mut all = Vec::new();
    for case in &references.cases {
        let flat = References::flat(case);
        let name = format!("h/b = {}, mu1/mu3 = {}, nu = {}", case["h_over_b"], case["mu1_over_mu3"], case["nu"]);
        all.extend(references.all_of(&name, &flat, case));
    }
    assert!(all.len() > 80, "the whole file is compared, {} entries", all.len());
    assert_honest(&all);
    let mut factors: Vec<f64> = all.iter().map(|c| c.estimate / c.error.max(c.digits)).collect();
    factors.sort_by(f64::total_cmp);
    let median = factors[factors.len() / 2];
    println!("median estimate/error = {median:.1}");
    assert!(median < 1000.0, "estimates are {median:.0} times too large in the median");
}

/// What the kernels prove of their rounding grows with the width of the contact, more than the rounding does: at
/// a twentieth of the half-width it is above 1e-10, and the solution says so.
#[test]
fn layers_down_to_a_twentieth_of_the_half_width() {
    let references = References::read(include_str!("../data/thin_layers.json"));
    let mut all = Vec::new();
    for case in &references.cases {
        let name = format!("h/b = {}, mu1/mu3 = {}, nu = {}", case["h_over_b"], case["mu1_over_mu3"], case["nu"]);
        // The default tolerance, and one whose truth is better than its bound: ten digits.
        for (solution, error) in [(converged(&References::plain(case)), 1e-8), (References::flat(case).solve(), 1e-10)]
        {
            let numbers = [
                ("edge.ratio", solution.edge.ratio, &case["edge"]),
                ("pressure.centre", solution.pressure.centre, &case["p0"]),
            ];
            for compared in references.compare(&name, &solution, &numbers) {
                assert!(compared.error < error, "{}: error {:.1e}", compared.what, compared.error);
                all.push(compared);
            }
        }
    }
    assert_eq!(all.len(), 16, "the whole file is compared");
    assert_honest(&all);
}

/// Contacts twenty and thirty times as wide as the layer is thick meet the default tolerance: the kernels
/// were once asked for no more than it took to miss it by the factor `1 + b/h` in their share.
#[test]
fn wide_contacts_meet_the_default_tolerance() {
    for h in [0.05, 0.03] {
        for ratio in [0.125, 1.0, 8.0] {
            converged(&Sketch::flat(h, ratio, 0.3));
        }
    }
}
