//! Loading curves: the last point is the result of the last load, the others are results of theirs.

// What is said to be the same is the same to the last bit.
#![allow(clippy::float_cmp)]

use crate::sketch::Sketch;
use serde_json::Value;
use slipzone::api::Positive;
use slipzone::api::reference::cylinder::Cylinder;
use slipzone::engine::{Curve, Solution, Solver, Status, solve};
use slipzone::report::json;
use slipzone::scene::{Load, LoadKind, LoadPath, Scene, parse};

fn positive(value: f64) -> Positive {
    Positive::new(value).expect("positive")
}

fn curve(solution: &Solution) -> &Curve {
    solution.path.as_ref().expect("a curve was asked for")
}

/// Numbers of a column that has no gap.
fn full(column: &[Option<f64>]) -> Vec<f64> {
    column.iter().map(|value| value.expect("a number")).collect()
}

fn cylinder() -> Sketch {
    Sketch::flat(5.0, 8.0, 0.3).cylinder()
}

/// A scene whose load is a path, and the same with the last load alone.
fn pairs() -> Vec<(Sketch, Sketch)> {
    let rubbing = Sketch::flat(5.0, 0.125, 0.3).rubbing(0.1);
    let half_plane = Sketch::half_plane(0.3).cylinder();
    [
        (cylinder(), "until = { force = 0.3, points = 7 }", "force = 0.3"),
        (cylinder(), "path = { half_width = [0.01, 0.5, 2.0] }", "half_width = 2.0"),
        (cylinder(), "path = { indentation = [0.05, 0.1] }", "indentation = 0.1"),
        (cylinder(), "path = { force = [0.3] }", "force = 0.3"),
        (rubbing, "until = { force = 2.0, points = 4 }", "force = 2.0"),
        (half_plane, "until = { half_width = 0.5, points = 5 }", "half_width = 0.5"),
    ]
    .into_iter()
    .map(|(sketch, path, last)| (sketch.clone().loaded(path), sketch.loaded(last)))
    .collect()
}

/// No number, no count of work and no word of the result depends on the loads on the way to it, but for all that it
/// took.
#[test]
fn the_result_is_that_of_the_last_load_to_the_last_byte() {
    for (path, last) in pairs() {
        let (mut with_path, alone) = (path.solve(), last.solve());
        assert_eq!(with_path.status, Status::Converged, "{}: {:?}", path.load, with_path.reason);
        let taken = with_path.path.take().expect("a curve was asked for");
        assert_eq!((taken.status, taken.note.as_deref()), (Status::Converged, None), "{}", path.load);
        with_path.scene.path = None;
        assert!(with_path.plan.work >= alone.plan.work, "the way takes work");
        with_path.plan.work = alone.plan.work;
        assert!(json(&with_path) == json(&alone), "{}", path.load);

        let ends = |column: &[Option<f64>]| column.last().copied().flatten();
        assert_eq!(ends(&taken.force), alone.load.force);
        assert_eq!(ends(&taken.half_width), alone.load.half_width);
        assert_eq!(taken.indentation.as_deref().and_then(ends), alone.load.indentation);
        let stick = alone.stick.as_ref();
        assert_eq!(taken.stick_half_width.as_deref().and_then(ends), stick.and_then(|stick| stick.half_width));
        assert_eq!(taken.stick_ratio.as_deref().and_then(ends), stick.and_then(|stick| stick.ratio));
        assert_eq!((taken.indentation.is_none(), taken.stick_ratio.is_none()), (path.h.is_none(), path.eta.is_none()));
    }
}

/// What is read of a result.
#[derive(serde::Deserialize)]
struct Written {
    scene: Scene,
}

/// A scene read from a result gives that result, the curve included.
#[test]
fn the_scene_of_a_result_reproduces_it() {
    for (path, _) in pairs() {
        // Why each method was chosen goes without saying once the scene names it.
        let result = |scene: &Scene| {
            let mut solution = solve(scene);
            solution.plan.reasons.clear();
            json(&solution)
        };
        let first = result(&path.scene());
        let Written { scene } = serde_json::from_str(&first).expect("a result with a scene");
        assert!(result(&scene) == first, "{}", path.load);
        let text = toml::to_string(&scene).expect("TOML");
        let again = parse("again", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(again.path, scene.path, "{text}");
        assert!(result(&again) == first, "{text}");
    }
    let plain: Value = serde_json::from_str(&json(&cylinder().solve())).expect("JSON");
    assert_eq!(plain.get("path"), None, "nothing is said of a curve that was not asked for");
    assert_eq!(plain["scene"]["load"], serde_json::json!({ "half_width": 1.0 }));
}

/// A curve walked on one solver against each of its loads alone: what both claim of their errors, and no more.
#[test]
fn points_on_the_way_are_results_of_their_loads() {
    let loads = LoadPath::until(Load::Force(positive(0.5)), 6).expect("a path");
    let mut solver = Solver::new(&cylinder().scene()).expect("a bonded layer");
    let walked = solver.curve(&loads);
    let error = walked.error.expect("an estimate");
    assert!(error <= 1e-8, "{error:e}: the default tolerance");
    let depths = walked.indentation.as_deref().expect("a base");
    for (i, load) in loads.loads().enumerate() {
        let alone = cylinder().loaded(&format!("force = {:?}", load.value().get())).solve();
        assert_eq!(walked.force[i], alone.load.force);
        for (path, found, expected) in [
            ("load.half_width", walked.half_width[i], alone.load.half_width),
            ("load.indentation", depths[i], alone.load.indentation),
        ] {
            let off = (found.expect("a number") / expected.expect("a number") - 1.0).abs();
            assert!(off <= error + alone.error.each[path], "{path} of load {i} is off by {off:e}");
        }
    }
    assert_eq!(solver.solve().load.force, Some(0.5), "the solver is left pressed by the last load");
    assert!(solver.solve().path.is_none(), "and by that alone");
}

/// A strain that is prescribed has no history: flat punches tell nothing of its stick zones. (They told another ratio
/// at all loads but the last.)
#[test]
fn stick_zones_of_a_prescribed_strain_are_those_of_their_loads() {
    let sketch = |load: &str| {
        let punch = "[friction]\ntype = \"goodman\"\ncoefficient = 0.3\nstrain = \"linear\"\n";
        let text = Sketch::flat(5.0, 8.0, 0.3).cylinder().loaded(load).with("[solver]\ntolerance = 1e-4").text();
        slipzone::scene::parse("linear.toml", &text.replace("[load]", &format!("{punch}[load]"))).expect("a scene")
    };
    let walked = solve(&sketch("until = { force = 0.1, points = 20 }"));
    let ratios = full(curve(&walked).stick_ratio.as_deref().expect("friction"));
    for (i, ratio) in ratios.into_iter().enumerate() {
        let force = curve(&walked).force[i].expect("given");
        let alone = solve(&sketch(&format!("force = {force:?}"))).stick.and_then(|stick| stick.ratio).expect("a zone");
        assert!((ratio / alone - 1.0).abs() < 3e-4, "{ratio} and {alone} at {force}");
    }
}

#[test]
fn a_cylinder_on_a_half_plane_follows_hertz() {
    let scene = Sketch::half_plane(0.3).cylinder().loaded("path = { force = [1e-6, 0.01, 0.1, 0.2] }");
    let solution = scene.solve();
    let curve = curve(&solution);
    assert_eq!(curve.indentation, None);
    // A0 = (kappa + 1)/(4 mu) with kappa = 3 - 4 nu.
    let exact = |force: f64| Cylinder::pressed(1.0, (4.0 - 4.0 * 0.3) / 4.0, force).half_width;
    for (force, half_width) in full(&curve.force).into_iter().zip(full(&curve.half_width)) {
        let error = (half_width / exact(force) - 1.0).abs();
        assert!(error <= 1e-8, "P = {force}: off by {error:e}, more than the default tolerance");
    }
}

/// More force: wider and deeper, on thin and thick, soft and stiff, nearly incompressible layers.
#[test]
fn a_contact_grows_with_its_load() {
    for (h, ratio, nu) in [(5.0, 8.0, 0.3), (5.0, 0.125, 0.3), (0.2, 1.0, 0.45), (50.0, 0.01, 0.0), (1.0, 100.0, 0.49)]
    {
        let solution =
            Sketch::flat(h, ratio, nu).cylinder().loaded("until = { half_width = 2.0, points = 25 }").solve();
        let curve = curve(&solution);
        assert_eq!(curve.status, Status::Converged, "h = {h}: {:?}", curve.note);
        let columns = [&curve.force, &curve.half_width, curve.indentation.as_ref().expect("a base")];
        for column in columns {
            assert!(full(column).is_sorted_by(|one, next| 0.0 < *one && one < next), "h = {h}: {column:?}");
        }
    }
}

/// A contact that does not grow: depth in proportion to the force, and the same stick zone throughout.
#[test]
fn a_flat_punch_has_a_straight_curve() {
    let solution = Sketch::flat(5.0, 0.125, 0.3).rubbing(0.1).loaded("until = { force = 3.0, points = 9 }").solve();
    let curve = curve(&solution);
    assert!(full(&curve.half_width).iter().all(|half_width| *half_width == 1.0));
    let ratio = solution.stick.as_ref().and_then(|stick| stick.ratio).expect("a stick zone");
    let (depths, ratios) = (curve.indentation.as_ref().expect("a base"), curve.stick_ratio.as_ref().expect("friction"));
    for ((force, depth), stick) in full(&curve.force).into_iter().zip(full(depths)).zip(full(ratios)) {
        // Rounding of a quotient; the zone is found anew to the tolerance.
        let compliance = solution.load.indentation.expect("a base") / 3.0;
        assert!((depth / force / compliance - 1.0).abs() < 1e-14, "P = {force}");
        assert!((stick / ratio - 1.0).abs() <= 1e-8, "P = {force}: a/b = {stick}");
    }
}

/// Its depths were summed anew for each load: 80,000 of them took minutes.
#[test]
fn loads_of_a_flat_punch_cost_no_kernel() {
    let work = |points: u32| {
        let load = format!("until = {{ indentation = 0.1, points = {points} }}");
        let solution = Sketch::flat(5.0, 0.125, 0.3).rubbing(0.1).loaded(&load).solve();
        assert_eq!(curve(&solution).points(), points as usize);
        (solution.plan.kernel_evaluations, solution.plan.work)
    };
    assert_eq!(work(10), work(100));
}

/// A tolerance that no resolution meets.
#[test]
fn a_load_that_fails_is_named() {
    let sketch = cylinder().loaded("path = { force = [0.1, 0.2] }").with("[solver]\ntolerance = 1e-14");
    let solution = sketch.solve();
    let curve = curve(&solution);
    assert_eq!(curve.status, Status::NotConverged);
    let note = curve.note.as_deref().expect("a note");
    assert!(note.starts_with("2 of 2 loads not converged, the first at force = 0.1: "), "{note}");
    assert!(curve.error.is_some_and(|error| error > 1e-14));
    assert_eq!(full(&curve.force), [0.1, 0.2], "the best numbers found are there");
}

/// A load that no contact bears keeps its own number and no other, and the rest of the curve stands.
#[test]
fn a_load_without_numbers_leaves_a_gap() {
    let loads = [0.5, 1e150].map(positive).to_vec();
    let loads = LoadPath::listed(LoadKind::Force, loads).expect("a path");
    let curve = Solver::new(&cylinder().scene()).expect("a bonded layer").curve(&loads);
    assert_eq!(curve.status, Status::Refused);
    assert!(
        curve.note.as_deref().is_some_and(|note| note.starts_with("1 of 2 loads have no numbers")),
        "{:?}",
        curve.note
    );
    assert_eq!(curve.force, [Some(0.5), Some(1e150)]);
    assert!(curve.half_width[0].is_some() && curve.half_width[1].is_none());
}

/// Between the flat punches that the last load is stacked of, narrow zones are told a hundred times worse than wide
/// ones.
#[test]
fn stick_ratios_on_the_way_are_those_of_flat_punches() {
    for (h, ratio, nu, eta, tolerance) in
        [(0.5, 1.0, 0.3, 0.05, 1e-3), (0.2, 1.0, 0.3, 0.03, 1e-7), (0.5, 0.1, 0.3, 0.03, 1e-5)]
    {
        let solver = format!("[solver]\ntolerance = {tolerance}");
        let grown = Sketch::flat(h, ratio, nu).cylinder().rubbing(eta).with(&solver);
        let solution = grown.loaded("path = { half_width = [0.02, 0.12, 0.15, 0.3, 1.0] }").solve();
        let path = curve(&solution);
        assert_eq!((path.status, path.note.as_deref()), (Status::Converged, None));
        for (b, told) in full(&path.half_width).into_iter().zip(full(path.stick_ratio.as_ref().expect("friction"))) {
            let flat = Sketch::flat(h / b, ratio, nu).rubbing(eta).solve();
            let stick = flat.stick.and_then(|stick| stick.ratio).expect("a stick zone");
            assert!((told / stick - 1.0).abs() < 3.0 * tolerance, "h = {h}, b = {b}: {told} and {stick}");
        }
    }
}

/// Under a hard coating on a soft base a punch lifts off in the middle of its way: solved for itself such a load was
/// contradicted, on a curve it was converged.
#[test]
fn a_punch_that_lifts_off_on_the_way_is_told() {
    let scene = |load: &str| {
        let text = format!(
            "format = 1\nload = {{ {load} }}\npunch = {{ type = \"rounded-wedge\", slope = 0.05, radius = 2.0 }}\n\
             [layer]\nthickness = 0.1\npoisson = 0.3\nbase = {{ type = \"half-plane\", shear = 50.0, poisson = 0.3 }}\n\
             grading = {{ type = \"homogeneous\", modulus = 1000.0 }}\n[solver]\ntolerance = 1e-4\n"
        );
        slipzone::engine::solve(&slipzone::scene::parse("lift.toml", &text).expect("a scene"))
    };
    let curve = scene("path = { half_width = [0.1, 0.3, 2.5] }").path.expect("a curve");
    assert_eq!(curve.status, Status::AssumptionViolated, "{:?}", curve.note);
    assert!(curve.note.as_ref().is_some_and(|note| note.contains("lifts off")), "{:?}", curve.note);
    assert_eq!(scene("half_width = 0.3").status, Status::AssumptionViolated);
    let curve = scene("path = { half_width = [0.02, 0.1] }").path.expect("a curve");
    assert_eq!(curve.status, Status::Converged, "{:?}", curve.note);
}
