//! The error estimate against the truth: references of a program that shares no code with this one.

use crate::sketch::Sketch;
use serde_json::Value;
use slipzone::engine::Solution;

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

impl Compared {
    fn new(what: &str, path: &str, solution: &Solution, got: Option<f64>, reference: &Value) -> Option<Self> {
        let reference = reference.as_f64()?;
        let got = got.unwrap_or_else(|| panic!("{what}: {path} is missing: {:?}", solution.reason));
        // The shortest text that reads back is what the file holds; its last digit is the unit.
        let text = format!("{reference}");
        let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let unit = 10.0_f64.powi(-i32::try_from(decimals).expect("a few digits"));
        Some(Self {
            what: format!("{what}: {path}"),
            error: (got / reference - 1.0).abs(),
            estimate: solution.error.each[path],
            digits: unit / reference.abs(),
        })
    }
}

/// Every entry of `layer_cases.json`, solved with further lines in the scene.
fn layer_cases(rest: &str) -> Vec<Compared> {
    let cases: Value = serde_json::from_str(include_str!("../data/layer_cases.json")).expect("valid JSON");
    let mut all = Vec::new();
    for case in cases["cases"].as_array().expect("a list") {
        let number = |key: &str| case[key].as_f64().expect("a number");
        let (h, ratio, nu) = (number("h_over_b"), number("mu1_over_mu3"), number("nu"));
        let name = format!("h/b = {h}, mu1/mu3 = {ratio}, nu = {nu}");
        let flat = Sketch::flat(h, ratio, nu).with(rest);
        let solution = flat.solve();
        let compare = |path, got, value| Compared::new(&name, path, &solution, got, value);
        all.extend(compare("edge.ratio", solution.edge.ratio, &case["flat"]["edge"]));
        all.extend(compare("load.indentation", solution.load.indentation, &case["flat"]["delta"]));
        all.extend(compare("pressure.centre", solution.pressure.centre, &case["flat"]["p0"]));
        let cylinder = flat.clone().cylinder().solve();
        let round = format!("{name}, cylinder");
        let compare = |path, got, value| Compared::new(&round, path, &cylinder, got, value);
        all.extend(compare("load.force", cylinder.load.force, &case["cylinder"]["P"]));
        all.extend(compare("pressure.centre", cylinder.pressure.centre, &case["cylinder"]["p0"]));
        for (eta, ratio) in case["stick"].as_object().expect("a table") {
            if ratio.is_null() {
                continue;
            }
            let solution = flat.clone().rubbing(eta.parse().expect("a number")).solve();
            let name = format!("{name}, eta = {eta}");
            let got = solution.stick.as_ref().and_then(|s| s.ratio);
            all.extend(Compared::new(&name, "stick.ratio", &solution, got, ratio));
        }
    }
    all
}

#[test]
fn estimates_are_honest_and_useful() {
    let all = layer_cases("");
    assert!(all.len() > 80, "the whole file is compared, {} entries", all.len());
    for c in &all {
        println!("{:60} error {:.1e} estimate {:.1e} digits {:.1e}", c.what, c.error, c.estimate, c.digits);
    }
    for c in &all {
        assert!(
            c.error <= 3.0 * c.estimate.max(c.digits),
            "{}: error {:.2e}, estimate {:.2e}",
            c.what,
            c.error,
            c.estimate
        );
        assert!(c.error <= 1e-4, "{}: the default tolerance is 1e-4, the error {:.2e}", c.what, c.error);
    }
    let mut factors: Vec<f64> = all.iter().map(|c| c.estimate / c.error.max(c.digits)).collect();
    factors.sort_by(f64::total_cmp);
    let median = factors[factors.len() / 2];
    println!("median estimate/error = {median:.1}");
    assert!(median < 1000.0, "estimates are {median:.0} times too large in the median");
}
