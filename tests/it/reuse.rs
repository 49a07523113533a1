//! What a second load on a known layer costs: no flexibility, no memory.

use crate::sketch::{Sketch, numbers, pressure_apart, shear_apart};
use slipzone::api::{Friction, Positive};
use slipzone::engine::{Solution, Solver, Status};
use slipzone::scene::{Load, Scene};

fn positive(value: f64) -> Positive {
    Positive::new(value).expect("positive")
}

/// Allocations made by finding the numbers for the solver's present load.
fn allocations(solver: &mut Solver) -> u64 {
    allocation_counter::measure(|| solver.find().expect("a solution")).count_total
}

#[test]
fn a_second_load_allocates_nothing_and_asks_the_layer_nothing() {
    let flat = Sketch::flat(5.0, 0.125, 0.3);
    let loads: [(&str, Sketch, Load, Load); 4] = [
        ("flat", flat.clone(), Load::Force(positive(1.0)), Load::Force(positive(2.5))),
        ("rubbing", flat.clone().rubbing(0.3), Load::Force(positive(1.0)), Load::Force(positive(2.5))),
        ("cylinder", flat.clone().cylinder(), Load::HalfWidth(positive(1.0)), Load::HalfWidth(positive(0.9))),
        ("by force", flat.cylinder(), Load::Force(positive(3.0)), Load::Force(positive(2.5))),
    ];
    for (name, sketch, first, second) in loads {
        let mut solver = Solver::new(&sketch.scene()).expect("a bonded layer");
        solver.press(first);
        let fresh = allocations(&mut solver);
        assert!(fresh > 0, "{name}: the counter counts");
        let before = solver.solve().plan;
        solver.press(second);
        let again = allocations(&mut solver);
        let after = solver.solve();
        assert_eq!(again, 0, "{name}: {fresh} allocations at first");
        assert_eq!(after.status, Status::Converged, "{name}: {:?}", after.reason);
        assert_eq!(after.plan.flexibility_evaluations, before.flexibility_evaluations, "{name}");
    }
}

#[test]
fn another_friction_coefficient_uses_the_curve_that_is_known() {
    let sketch = Sketch::flat(5.0, 0.125, 0.3);
    let mut solver = Solver::new(&sketch.clone().rubbing(0.3).scene()).expect("a bonded layer");
    let first = solver.solve().plan.factorisations;
    solver.rub(Friction::goodman(positive(0.1)));
    let second = solver.solve();
    let further = second.plan.factorisations - first;
    // The scan takes four systems at least, and the pressure three.
    assert!(further + 7 <= first, "{further} systems after {first}: the curve was scanned again");
    let alone = sketch.rubbing(0.1).solve();
    let ratio =
        |solution: &slipzone::engine::Solution| solution.stick.as_ref().expect("friction").ratio.expect("a ratio");
    assert_eq!(ratio(&second).to_bits(), ratio(&alone).to_bits(), "reuse changes no bit");
}

/// Half of the pressure asks for more of the curve than the others do, and twice of it for finer kernels than there
/// are: with those all that the coarser ones told is solved again.
#[test]
fn no_bit_depends_on_the_friction_coefficients_before() {
    for (tolerance, others) in [("1e-3", [0.5, 0.35].as_slice()), ("1e-8", &[2.0])] {
        let sketch = Sketch::flat(5.0, 0.125, 0.3).with(&format!("[solver]\ntolerance = {tolerance}\n"));
        let mut solver = Solver::new(&sketch.clone().rubbing(0.3).scene()).expect("a bonded layer");
        solver.solve();
        for eta in others {
            solver.rub(Friction::goodman(positive(*eta)));
            let bits = |solution: &Solution| {
                let stick = solution.stick.clone().expect("friction");
                [stick.ratio, stick.one_minus_ratio].map(|number| number.expect("a number").to_bits())
            };
            let alone = sketch.clone().rubbing(*eta).solve();
            assert_eq!(bits(&solver.solve()), bits(&alone), "eta = {eta} at {tolerance}");
        }
    }
}

#[test]
fn another_force_on_a_flat_punch_solves_nothing() {
    let sketch = Sketch::flat(5.0, 0.125, 0.3).rubbing(0.3);
    let mut solver = Solver::new(&sketch.scene()).expect("a bonded layer");
    let first = solver.solve();
    solver.press(Load::Force(positive(2.5)));
    let second = solver.solve();
    assert_eq!(second.plan.factorisations, first.plan.factorisations, "all tractions grow with the force");
    let alone = sketch.loaded("force = 2.5").solve();
    let shear = |solution: &slipzone::engine::Solution| solution.profile.shear.clone().expect("friction");
    for (again, alone) in shear(&second).into_iter().zip(shear(&alone)) {
        let (again, alone) = (again.unwrap_or(0.0), alone.unwrap_or(0.0));
        // A shear that is known to the tolerance is not solved for again.
        assert!((again - alone).abs() <= 1e-8 * alone.abs(), "{again} against {alone}");
    }
}

/// Below a tolerance that double precision allows, however often it is asked for.
#[test]
fn a_shear_as_good_as_it_gets_is_not_refined_again() {
    let sketch = Sketch::flat(5.0, 0.125, 0.3).rubbing(0.3).with("[solver]\ntolerance = 1e-12");
    let mut solver = Solver::new(&sketch.scene()).expect("a bonded layer");
    let first = solver.solve();
    assert!(first.error.each["profile.shear"] > 1e-12, "{:?}", first.error.each);
    solver.press(Load::Force(positive(2.5)));
    let second = solver.solve();
    assert_eq!(second.plan.factorisations, first.plan.factorisations, "all tractions grow with the force");
    let shear = |solution: &Solution| solution.error.each["profile.shear"].to_bits();
    assert_eq!(shear(&second), shear(&first), "nor is more claimed");
}

#[test]
fn a_layer_serves_another_punch() {
    let flat = Sketch::flat(5.0, 0.125, 0.3);
    let mut solver = Solver::new(&flat.scene()).expect("a bonded layer");
    let evaluations = solver.solve().plan.flexibility_evaluations;
    let mut round = Solver::on(solver.into_layer(), &flat.clone().cylinder().scene()).expect("the same layer");
    assert_eq!(round.solve().plan.flexibility_evaluations, evaluations);
    let other = Sketch::flat(5.0, 8.0, 0.3).scene();
    assert!(Solver::on(round.into_layer(), &other).is_err(), "another layer's tables are of no use");
}

/// Half-widths over thickness at which memory is looked at; the first is judged, while the process has no tables yet
/// if this test runs alone.
const WIDTHS: [f64; 4] = [0.2, 0.05, 1.0, 5.0];

#[test]
fn a_solve_takes_little_memory() {
    let peaks = WIDTHS.map(|width| {
        let scene = Sketch::flat(1.0 / width, 8.0, 0.3).rubbing(0.3).with("[solver]\ntolerance = 1e-10").scene();
        let mut status = None;
        let peak = allocation_counter::measure(|| status = Some(slipzone::engine::solve(&scene).status)).bytes_max;
        println!("b/h = {width}: {peak} bytes at most at once, {status:?}");
        peak
    });
    assert!(peaks[0] > 10_000, "{} bytes: the counter counts", peaks[0]);
    // Tables of nodes that the process keeps included (docs/performance.md).
    assert!(peaks[0] < 2_000_000, "{} bytes for h/b = 5 at 1e-10", peaks[0]);
}

/// Rows of a fine grid are found again where all of them would be many: held, they took 820 MB here.
#[test]
fn the_thinnest_layers_take_no_memory_without_end() {
    let scene = Sketch::flat(1.0 / 2500.0, 0.25, 0.3).scene();
    let mut unknowns = 0;
    let peak = allocation_counter::measure(|| unknowns = slipzone::engine::solve(&scene).plan.unknowns).bytes_max;
    println!("b/h = 2500: {peak} bytes at most at once, {unknowns} unknowns");
    assert!(peak < 150_000_000, "{peak} bytes for {unknowns} unknowns");
}

/// Punches that grow with the load, each pressed to a half-width of 1.
const GROWING: [&str; 4] = [
    "type = \"cylinder\"\nradius = 1.0",
    "type = \"wedge\"\nslope = 0.05",
    "type = \"power\"\ncoefficient = 0.05\nexponent = 4.0",
    "type = \"rounded-flat\"\nhalf_width = 0.2\nradius = 1.0",
];

/// One of them on a layer of that thickness and `mu1/mu3`.
fn growing(h: f64, ratio: f64, punch: &str, tolerance: f64, friction: &str) -> Scene {
    slipzone::link_plugins();
    let text = format!(
        "format = 1\n[layer]\nthickness = {h:?}\npoisson = 0.3\n\
         grading = {{ type = \"exponential\", surface = 1.0, base = {:?} }}\n[punch]\n{punch}\n\
         {friction}[load]\nhalf_width = 1.0\n[solver]\ntolerance = {tolerance:?}\n",
        1.0 / ratio
    );
    slipzone::scene::parse("growing.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

const RUBBING: &str = "[friction]\ntype = \"goodman\"\ncoefficient = 0.3\n";

/// Tolerances by which a shear may be off before finer flat punches are taken for its sake.
const SHEAR: f64 = 6.0;

/// Compares with a contact solved for itself and a hundred times as well.
fn is_as_sure_as_it_says(found: &Solution, exact: &Solution, tolerance: f64, case: &str) {
    assert_eq!(found.status, Status::Converged, "{case}: {:?}", found.reason);
    for (path, error) in found.error.each.iter().filter(|(path, error)| **error > 0.0 && !path.starts_with("profile."))
    {
        let truth = exact.number(path).expect("the same numbers");
        let off = (found.number(path).expect("a number") / truth - 1.0).abs();
        assert!(off <= *error, "{case}: {path} is off by {off:e}, {error:e} was claimed");
    }
    if found.error.each.contains_key("profile.pressure") {
        let [apart, claimed] = pressure_apart(found, exact);
        assert!(apart <= claimed, "{case}: p is off by {apart:e}, {claimed:e} was claimed");
    }
    if found.profile.shear.is_some() && exact.profile.shear.is_some() {
        let [apart, claimed] = shear_apart(found, exact);
        assert!(apart <= (SHEAR * tolerance).min(claimed), "{case}: q is off by {apart:e}, {claimed:e} was claimed");
    }
}

/// Systems on two resolutions, or on three: one, or up to three where the size has to be found.
const FEW: usize = 9;

#[test]
fn another_load_is_as_sure_as_it_says_for_a_few_systems() {
    let tolerance = 1e-7;
    for (h, ratio) in [(5.0, 0.125), (0.7, 8.0)] {
        for (punch, friction) in GROWING.map(|punch| [(punch, RUBBING), (punch, "")]).into_iter().flatten() {
            let mut solver = Solver::new(&growing(h, ratio, punch, tolerance, friction)).expect("a bonded layer");
            let first = solver.solve();
            assert_eq!(first.status, Status::Converged, "{punch}: {:?}", first.reason);
            let times = |path: &str, share: f64| positive(share * first.number(path).expect("a number"));
            let force = Load::Force(times("load.force", 1.0));
            // One of each kind; the next is less of it. The last contact is wider than any before.
            let loads = [
                (Load::HalfWidth(times("load.half_width", 0.6)), true),
                (force, false),
                (Load::Force(times("load.force", 0.7)), true),
                (Load::Indentation(times("load.indentation", 1.0)), false),
                (Load::Indentation(times("load.indentation", 0.8)), true),
                (Load::Force(times("load.force", 1.7)), false),
            ];
            let mut systems = first.plan.factorisations;
            for (load, is_known) in loads {
                let case = format!("h = {h}, {punch:?}, {friction:?}, {load:?}");
                solver.press(load);
                let again = solver.solve();
                let further = again.plan.factorisations.saturating_sub(systems);
                assert!(!is_known || further <= FEW, "{case}: {further} systems");
                systems = again.plan.factorisations;
                let exact = growing(h, ratio, punch, 0.01 * tolerance, friction);
                let mut fresh = Solver::new(&exact).expect("a bonded layer");
                fresh.press(load);
                is_as_sure_as_it_says(&again, &fresh.solve(), tolerance, &case);
            }
        }
    }
}

/// Kernel tables that reached for it would spoil every load after it.
#[test]
fn a_load_that_is_refused_leaves_nothing_behind() {
    let scene = growing(5.0, 0.125, GROWING[0], 1e-8, RUBBING);
    let bits =
        |solution: &Solution| numbers(solution).into_iter().map(|(_, number)| number.to_bits()).collect::<Vec<_>>();
    let alone = slipzone::engine::solve(&scene);
    for refused in [Load::Force(positive(1e80)), Load::Indentation(positive(1e8))] {
        let mut solver = Solver::new(&scene).expect("a bonded layer");
        solver.press(refused);
        assert_eq!(solver.solve().status, Status::Refused, "{refused:?}");
        solver.press(scene.load);
        let again = solver.solve();
        assert_eq!(again.status, Status::Converged, "{refused:?}: {:?}", again.reason);
        assert_eq!(bits(&again), bits(&alone), "{refused:?}");
    }
}

#[test]
fn another_punch_is_as_sure_as_it_says_for_a_few_systems() {
    let tolerance = 1e-7;
    for (h, ratio) in [(5.0, 0.125), (0.7, 8.0)] {
        let mut layer = None;
        for punch in GROWING {
            let scene = growing(h, ratio, punch, tolerance, RUBBING);
            let known = layer.is_some();
            let mut solver = match layer.take() {
                None => Solver::new(&scene),
                Some(layer) => Solver::on(layer, &scene),
            }
            .expect("one layer");
            let found = solver.solve();
            let case = format!("h = {h}, {punch:?}");
            // A steep one's pressure may take more than two resolutions.
            assert!(!known || found.plan.factorisations <= 18, "{case}: {} systems", found.plan.factorisations);
            let exact = growing(h, ratio, punch, 0.01 * tolerance, RUBBING);
            let exact = Solver::new(&exact).expect("a bonded layer").solve();
            is_as_sure_as_it_says(&found, &exact, tolerance, &case);
            layer = Some(solver.into_layer());
        }
    }
}
