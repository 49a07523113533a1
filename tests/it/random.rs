//! Random scenes over the whole region that is served, each against another quadrature at a finer resolution.
//!
//! `SLIPZONE_CASES=2000 cargo test --release --test it random -- --nocapture` is the long run; `SLIPZONE_SEED`, which
//! each test prints, has it again.

use crate::sketch::{Sketch, numbers, shear_apart};
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};
use slipzone::api::reference::partial_slip;
use slipzone::engine::Status;
use std::cell::Cell;
use std::time::SystemTime;

/// Layers from thin to thick, from soft skins to stiff ones; either punch; friction or none.
fn sketches() -> impl Strategy<Value = Sketch> {
    let log = |least: f64, most: f64| (least.ln()..most.ln()).prop_map(f64::exp);
    let friction = proptest::option::weighted(0.6, log(0.02, 1.5));
    (log(0.05, 1e4), log(1e-4, 1e4), 0.0..0.5_f64, any::<bool>(), friction).prop_map(|(h, ratio, nu, flat, eta)| {
        let sketch = Sketch::flat(h, ratio, nu);
        match (flat, eta) {
            (false, _) => sketch.cylinder(),
            (true, Some(eta)) => sketch.rubbing(eta),
            (true, None) => sketch,
        }
    })
}

/// Gradings and bases of every kind, stacks of them too; Poisson's ratio at the surface as given.
///
/// Left out is what is known to be out of reach: volume fractions of an exponent that is no whole number.
fn any_layer() -> impl Strategy<Value = String> {
    let log = |least: f64, most: f64| (least.ln()..most.ln()).prop_map(f64::exp);
    let grading = |thickness: f64, kind: usize, [m, a, b]: [f64; 3], nu: f64| match kind {
        0 => format!("{{ type = \"homogeneous\", modulus = {m:?} }}"),
        1 => format!("{{ type = \"exponential\", surface = {m:?}, base = {:?} }}", m * a),
        2 => format!("{{ type = \"linear\", surface = {m:?}, base = {:?} }}", m * a),
        3 => format!(
            "{{ type = \"power-law\", surface = {m:?}, length = {:?}, exponent = {:?} }}",
            thickness * (0.2 + b),
            a.ln()
        ),
        4 | 5 => format!(
            "{{ type = \"{}\", above = {m:?}, below = {:?}, centre = {:?}, width = {:?} }}",
            if kind == 4 { "sigmoid" } else { "error-function" },
            m * a,
            b * thickness,
            thickness * (0.15 + 0.5 * b)
        ),
        6 => format!(
            "{{ type = \"formula\", modulus = \"m*(1 + a*(y/h)^2)\", poisson = \"p + (0.25 - p)*y/h\", \
             parameters = {{ m = {m:?}, a = {a:?}, p = {nu:?} }} }}"
        ),
        7 => format!("{{ type = \"formula\", modulus = \"{m:?}*(1 + abs(y/h - {b:?}))\" }}"),
        8 => {
            let rows: Vec<String> = (0..6)
                .map(|i| f64::from(i) / 5.0)
                .map(|y| format!("[{:?}, {:?}]", y * thickness, m * (1.0 + (a - 1.0) * y * (b + (1.0 - b) * y))))
                .collect();
            format!("{{ type = \"table\", points = [{}] }}", rows.join(", "))
        }
        _ => format!(
            "{{ type = \"volume-fraction\", surface = {{ modulus = {m:?}, poisson = {nu:?} }}, \
             base = {{ modulus = {:?}, poisson = 0.25 }}, exponent = {}, rule = \"{}\" }}",
            m * a,
            if b < 0.5 { 1.0 } else { 2.0 },
            if b * 8.0 % 1.0 < 0.5 { "mixture" } else { "mori-tanaka" }
        ),
    };
    let part = (0..10_usize, [log(0.2, 5.0), log(0.1, 10.0), log(0.1, 0.9)]);
    let parts = proptest::collection::vec((part, log(0.2, 1.0)), 1..4);
    let base = (0..4_usize, log(0.05, 20.0), 0.0..0.45_f64);
    (log(0.3, 100.0), 0.0..0.5_f64, parts, base, any::<[bool; 2]>()).prop_map(
        move |(h, nu, parts, (base, shear, poisson), [stress, young])| {
            let total: f64 = parts.iter().map(|(_, share)| share).sum();
            let (moduli, plane) = (if young { "young" } else { "shear" }, if stress { "stress" } else { "strain" });
            let one: Vec<String> = parts
                .iter()
                .map(|((kind, numbers), share)| (h * share / total, *kind, *numbers))
                .map(|(h, kind, numbers)| format!("{{ thickness = {h:?}, grading = {} }}", grading(h, kind, numbers, nu)))
                .collect();
            let grading = match (&parts[..], base) {
                // Without a base: the exponential alone.
                (_, 3) => format!("{{ type = \"exponential\", surface = 1.0, gradient = {:?} }}", h.recip()),
                ([((kind, numbers), _)], _) => grading(h, *kind, *numbers, nu),
                _ => format!("{{ type = \"stack\", layers = [{}] }}", one.join(", ")),
            };
            let base = match base {
                0 => format!("thickness = {h:?}"),
                1 => format!("thickness = {h:?}\nbase = {{ type = \"frictionless\" }}"),
                2 => {
                    let datum = if poisson < 0.2 { format!("\ndatum = {:?}", h * shear) } else { String::new() };
                    format!(
                        "thickness = {h:?}\nbase = {{ type = \"half-plane\", shear = {shear:?}, poisson = {poisson:?} }}{datum}"
                    )
                }
                _ => "base = { type = \"infinite\" }".into(),
            };
            format!("{base}\npoisson = {nu:?}\nmoduli = \"{moduli}\"\nplane = \"{plane}\"\ngrading = {grading}")
        },
    )
}

/// Such layers under either punch, with friction or without.
fn any_sketches() -> impl Strategy<Value = Sketch> {
    let friction = proptest::option::weighted(0.5, 0.05..0.8_f64);
    (any_layer(), any::<bool>(), friction).prop_map(|(layer, flat, eta)| {
        let sketch = Sketch::on(layer);
        match (flat, eta) {
            (false, _) => sketch.cylinder(),
            (true, Some(eta)) => sketch.rubbing(eta),
            (true, _) => sketch,
        }
    })
}

/// Shapes whose contacts grow, about as steep as the cylinder of radius 1 at the half-width 1 where they are.
const PUNCHES: [&str; 6] = [
    "type = \"cylinder\"\nradius = 1.0",
    "type = \"wedge\"\nslope = 0.5",
    "type = \"power\"\ncoefficient = 0.5\nexponent = 2.6",
    "type = \"rounded-flat\"\nhalf_width = 0.45\nradius = 1.0",
    "type = \"rounded-wedge\"\nslope = 0.5\nradius = 1.0",
    "type = \"polynomial\"\ncoefficients = [0.3, 0.1]",
];

/// Layers under a growing contact with friction.
fn growing() -> impl Strategy<Value = Sketch> {
    let log = |least: f64, most: f64| (least.ln()..most.ln()).prop_map(f64::exp);
    (log(0.5, 100.0), log(0.02, 50.0), 0.0..0.45_f64, log(0.05, 0.8))
        .prop_map(|(h, ratio, nu, eta)| Sketch::flat(h, ratio, nu).cylinder().rubbing(eta))
}

/// Cases unless `SLIPZONE_CASES` asks for others, and the seed of those.
const CASES: u32 = 24;
const SEED: u64 = 3;

/// What a traction may be off by in any case: a few hundred roundings of the largest.
const ROUNDING: f64 = 1e-13;
/// Ten times the default tolerance: both tractions meet where the stick zone ends.
const SLACK: f64 = 1e-7;

/// Checks scenes that are always the same, unless `SLIPZONE_CASES` asks for a number of others, and that so large a
/// share of them converges: of a solver that gives up nothing else would be held. What fails is shrunk.
fn hold<S: Strategy>(scenes: &S, share: f64, check: impl Fn(S::Value) -> Result<Status, TestCaseError>) {
    let asked = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let (cases, seed) = (asked("SLIPZONE_CASES"), asked("SLIPZONE_SEED"));
    let other = cases.and_then(|_| SystemTime::UNIX_EPOCH.elapsed().ok()?.as_secs().into());
    let seed = seed.or(other).unwrap_or(SEED);
    let cases = cases.and_then(|cases| cases.try_into().ok()).unwrap_or(CASES);
    let config = ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let converged = Cell::new(0_u32);
    let outcome = TestRunner::new(config).run(scenes, |scene| {
        if check(scene)? == Status::Converged {
            converged.set(converged.get() + 1);
        }
        Ok(())
    });
    println!("SLIPZONE_CASES={cases} SLIPZONE_SEED={seed}: {} converged", converged.get());
    outcome.unwrap_or_else(|why| panic!("{why}"));
    // Of few cases anything may be so.
    let least = if cases < CASES { 0.0 } else { share * f64::from(cases) };
    assert!(f64::from(converged.get()) >= least, "{} of {cases} converged, {least} at least should", converged.get());
}

/// A scene solved to that many digits against another quadrature at a finer tolerance.
fn judged(sketch: &Sketch, digits: f64) -> Result<Status, TestCaseError> {
    let tolerance = 10.0_f64.powf(-digits);
    let solution = sketch.clone().with(&format!("[solver]\ntolerance = {tolerance:e}")).solve();
    prop_assert_ne!(solution.status, Status::Refused, "{:?}\n{}", solution.reason, sketch.text());
    // Finer by far, but no finer than that: thin layers under friction take it minutes at 1e-13.
    let finer = (tolerance / 30.0).max(1e-12);
    let judge = format!("[solver]\ntolerance = {finer:e}\nquadrature = {{ type = \"graded-panels\" }}");
    let reference = sketch.clone().with(&judge).solve();
    let converged = solution.status == Status::Converged;
    let scale = |path: &str| solution.error.each[path].max(if converged { 0.0 } else { tolerance });
    for ((path, found), (_, exact)) in numbers(&solution).into_iter().zip(numbers(&reference)) {
        // A stick zone that fails the conditions of friction is no number to rely on.
        let void = solution.status == Status::AssumptionViolated && path.starts_with("stick");
        if exact == 0.0 || void {
            continue;
        }
        let error = (found / exact - 1.0).abs();
        let allowed = if converged { tolerance } else { scale(path) };
        // What the judge does not know itself.
        let blurred = reference.error.each[path];
        prop_assert!(
            error <= 3.0 * allowed + blurred,
            "{}: error {:.1e}, tolerance {:.1e}, estimate {:.1e}, judge's {:.1e}; {:?} {:?}\n{}",
            path,
            error,
            tolerance,
            solution.error.each[path],
            blurred,
            solution.status,
            solution.reason,
            sketch.text()
        );
    }
    Ok(solution.status)
}

/// Friction from 0.15 to 5 times what sticks to half of the contact: the exact zone is a ratio of elliptic integrals.
#[test]
fn stick_zones_on_half_planes_are_exact() {
    hold(&(0.0..0.49_f64, 0.15_f64.ln()..5.0_f64.ln(), 3.0..11.5_f64), 0.9, |(nu, log, digits)| {
        let beta = (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu);
        let (eta, tolerance) = (beta * log.exp(), 10.0_f64.powf(-digits));
        let solution =
            Sketch::half_plane(nu).rubbing(eta).with(&format!("[solver]\ntolerance = {tolerance:e}")).solve();
        let (stick, exact) = (solution.stick.expect("friction"), partial_slip::stick(eta, beta));
        let numbers = [
            ("stick.ratio", stick.ratio, exact.ratio),
            ("stick.one_minus_ratio", stick.one_minus_ratio, exact.one_minus_ratio),
        ];
        for (path, found, exact) in numbers {
            let error = (found.expect("a stick zone") / exact - 1.0).abs();
            let converged = solution.status == Status::Converged;
            let allowed = if converged { tolerance } else { solution.error.each[path] };
            prop_assert!(error <= 3.0 * allowed, "{}: error {:.1e}, allowed {:.1e}", path, error, allowed);
        }
        Ok(solution.status)
    });
}

#[test]
fn errors_stay_within_three_tolerances() {
    hold(&(sketches(), 3.0..12.0_f64), 0.7, |(sketch, digits)| judged(&sketch, digits));
}

/// The default tolerance asks for 8 digits; stacks take the judge seconds beyond 11.
#[test]
fn errors_on_any_layer_stay_within_three_tolerances() {
    hold(&(any_sketches(), 3.0..9.0_f64), 0.8, |(sketch, digits)| judged(&sketch, digits));
}

/// Growing contacts under friction: numbers within three tolerances of those at a much finer one, the stick zone that
/// of the flat punch, the shear within three times what is claimed of it and ten tolerances, and the pressure, whose
/// error between its nodes nobody states, within three tolerances of its largest.
#[test]
fn growing_contacts_keep_what_they_promise() {
    let scenes = (growing(), (0..PUNCHES.len(), 3.0..8.0_f64));
    hold(&scenes, 0.6, |(sketch, (punch, digits))| {
        let solved = |tolerance: f64, punch: &str| {
            let solver = format!("[solver]\ntolerance = {tolerance:e}\n[output]\npoints = 12");
            let text = sketch.clone().with(&solver).text().replace("type = \"cylinder\"\nradius = 1.0", punch);
            slipzone::link_plugins();
            let scene = slipzone::scene::parse("growing.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
            slipzone::engine::solve(&scene)
        };
        let (punch, tolerance) = (PUNCHES[punch], 10.0_f64.powf(-digits));
        let (found, exact) = (solved(tolerance, punch), solved((tolerance / 100.0).max(1e-9), punch));
        prop_assert!(found.status != Status::Converged || found.profile.shear.is_some(), "{:?}", punch);
        if found.status != Status::Converged || exact.status == Status::AssumptionViolated {
            return Ok(found.status);
        }
        for ((path, number), (_, exact)) in numbers(&found).into_iter().zip(numbers(&exact)) {
            let error = if exact == 0.0 { 0.0 } else { (number / exact - 1.0).abs() };
            prop_assert!(error <= 3.0 * tolerance, "{punch}: {path} is off by {error:.1e}, tolerance {tolerance:.1e}");
        }
        let flat = sketch.clone().flat_again().with("[solver]\ntolerance = 1e-9").solve();
        if let Some(flat) = flat.stick.and_then(|stick| stick.ratio) {
            let ratio = found.stick.as_ref().and_then(|stick| stick.ratio).expect("a stick zone");
            let error = (ratio / flat - 1.0).abs();
            prop_assert!(error <= 3.0 * tolerance + 1e-8, "{punch}: a/b = {ratio}, flat {flat}");
        }
        let [apart, claimed] = shear_apart(&found, &exact);
        let allowed = 3.0 * claimed + exact.error.each["profile.shear"] + ROUNDING;
        prop_assert!(
            apart <= allowed.min(10.0 * tolerance),
            "{punch}: the shear is off by {apart:.1e}, claimed {claimed:.1e}, tolerance {tolerance:.1e}"
        );
        let [pressure, truth] = [&found, &exact].map(|solution| solution.profile.pressure.iter().flatten());
        let largest = truth.clone().fold(0.0_f64, |most, p| most.max(*p));
        let apart = pressure.zip(truth).map(|(p, truth)| (p - truth).abs()).fold(0.0, f64::max) / largest;
        prop_assert!(
            apart <= 3.0 * tolerance,
            "{punch}: the pressure is off by {apart:.1e}, tolerance {tolerance:.1e}"
        );
        Ok(found.status)
    });
}

/// Shear stays within `eta p`, and what sticks and what slips are all of the contact.
#[test]
fn friction_holds_within_coulombs_limit() {
    let layers = (1.0..20.0_f64, -2.0..2.0_f64, 0.0..0.45_f64);
    hold(&(layers, 0.05..0.6_f64), 0.8, |((h, log, nu), eta)| {
        let solution = Sketch::flat(h, log.exp(), nu).rubbing(eta).solve();
        if solution.status != Status::Converged {
            prop_assert!(solution.reason.is_some());
            return Ok(solution.status);
        }
        let shear = solution.profile.shear.as_ref().expect("friction");
        for (p, q) in solution.profile.pressure.iter().zip(shear).filter_map(|(p, q)| Some(((*p)?, (*q)?))) {
            prop_assert!(q.abs() <= eta * p * (1.0 + SLACK), "|q| = {} above {}", q.abs(), eta * p);
        }
        let stick = solution.stick.as_ref().expect("friction");
        let (ratio, gap) = (stick.ratio.expect("a number"), stick.one_minus_ratio.expect("a number"));
        prop_assert!(ratio > 0.0 && gap > 0.0 && (ratio + gap - 1.0).abs() < 1e-15, "{} and {}", ratio, gap);
        Ok(solution.status)
    });
}
