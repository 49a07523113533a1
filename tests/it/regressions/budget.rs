//! Work and its bound, loading curves, and what is refused.

use super::{within_three_estimates, written};
use crate::sketch::Sketch;
use slipzone::api::Positive;
use slipzone::engine::{BUDGET, Solver, Status, solve, solve_within};
use slipzone::scene::{Load, LoadPath};

/// `check` and `explain` said nothing of what `solve` refuses whatever the numbers.
#[test]
fn what_solving_refuses_is_known_before() {
    let thin = "solver = { model = \"thin\" }";
    let layer = "thickness = 5.0, poisson = 0.3";
    let exponential = format!("{layer}, grading = {{ type = \"exponential\", surface = 1.0, base = 8.0 }}");
    let homogeneous = format!("{layer}, grading = {{ type = \"homogeneous\", modulus = 1.0 }}");
    let soft = format!("{exponential}, base = {{ type = \"half-plane\", shear = 2.0, poisson = 0.3 }}");
    let incompressible = exponential.replace("0.3", "0.5");
    let cylinder = "punch = { type = \"cylinder\", radius = 900.0 }\nload = { half_width = 30.0 }";
    let flat = "punch = { type = \"flat\", half_width = 1.0 }\nload = { force = 1.0 }";
    let narrow = "punch = { type = \"cylinder\", radius = 10.0 }\nload = { half_width = 1.0 }";
    let path = "punch = { type = \"cylinder\", radius = 900.0 }\nload = { until = { half_width = 30.0, points = 3 } }";
    let dry = "output = { quantities = [\"load.force\"] }";
    let moments = "solver = { kernel = { type = \"moments\" } }";
    let transfer = "solver = { flexibility = { type = \"transfer-matrix\" } }";
    for (layer, contact, rest, word) in [
        (&exponential, flat, thin, "corners"),
        (&exponential, cylinder, thin, "profile"),
        (&soft, cylinder, &format!("{thin}\n{dry}"), "rigid base"),
        (&exponential, path, &format!("{thin}\n{dry}"), "loading curve"),
        (&exponential, narrow, &format!("{thin}\n{dry}"), "four thicknesses"),
        (&exponential, flat, moments, "homogeneous layer"),
        (&homogeneous, flat, transfer, "double depth exponents"),
        (&incompressible, flat, transfer, "incompressible"),
    ] {
        let text = format!("format = 1\nlayer = {{ {layer} }}\n{contact}\n{rest}");
        let scene = slipzone::scene::parse("refused", &text).unwrap();
        let solution = slipzone::engine::solve(&scene);
        assert_eq!(solution.status, Status::Refused, "{text}");
        let known = slipzone::engine::refusal(&scene).map(|refusal| refusal.to_string());
        assert_eq!(known.as_deref(), solution.reason.as_deref(), "{text}");
        assert!(known.unwrap().contains(word), "{text}");
    }
    let served = format!("format = 1\nlayer = {{ {exponential} }}\n{cylinder}\n{thin}\n{dry}");
    let served = slipzone::scene::parse("served", &served).unwrap();
    assert_eq!(slipzone::engine::refusal(&served), None);
    assert_ne!(slipzone::engine::solve(&served).status, Status::Refused);
}

/// Found by random scenes: what a growing contact on a thin layer could take had no bound, minutes at a time. It ends
/// with what it has and says so, or is refused, within the budget.
#[test]
fn work_has_a_bound() {
    use slipzone::engine::solve_within;
    let budget = 20_000_000;
    let cases = [
        ("type = \"wedge\"\nslope = 0.01", "indentation = 0.01"),
        (
            "type = \"table\"\npoints = [[0.0, 0.0], [0.7, 0.14], [1.3, 0.43], [2.0, 0.84], [2.7, 1.36], [3.3, 1.96]]",
            "force = 3.0",
        ),
    ];
    for (punch, load) in cases {
        let text = format!(
            "format = 1\nlayer = {{ thickness = 0.01, poisson = 0.3, grading = {{ type = \"linear\", surface = 0.7, base = 200.0 }} }}\n\
             friction = {{ type = \"goodman\", coefficient = 0.7 }}\n[punch]\n{punch}\n[load]\n{load}"
        );
        let solution = solve_within(&slipzone::scene::parse("bound", &text).unwrap(), budget);
        let reason = solution.reason.unwrap_or_default();
        assert!(matches!(solution.status, Status::NotConverged | Status::Refused), "{:?}: {reason}", solution.status);
        assert!(reason.contains("budget, 2e7"), "{reason}");
        // What was read of the tables for the last systems is counted behind them.
        assert!(solution.plan.work < 3 * budget, "{}", solution.plan.work);
    }
}

/// A contact that grew under more friction than its budget was worth lost its pressure, too, though that takes a
/// fiftieth of the work.
#[test]
fn where_the_shear_takes_too_much_the_pressure_is_told() {
    let cylinder = |h: f64, base: f64, tolerance: f64| {
        let grading = format!("grading = {{ type = \"linear\", surface = 1.0, base = {base:?} }}");
        let sketch = Sketch::on(format!("thickness = {h:?}\npoisson = 0.45\n{grading}")).cylinder();
        sketch.with(&format!("[solver]\ntolerance = {tolerance:e}"))
    };
    // Resolutions enough to tell numbers, if only that of these no digit is sure: as little of the pressure as of the
    // stick zone.
    for (unsure, budget) in [(cylinder(0.04, 100.0, 1e-4), BUDGET / 5), (cylinder(0.05, 50.0, 1e-6), BUDGET / 10)] {
        let reason = solve_within(&unsure.rubbing(0.3).scene(), budget).reason.unwrap_or_default();
        assert!(reason.starts_with("the shear is not solved: "), "{reason}");
    }
    let cylinder = cylinder(0.05, 50.0, 1e-5);
    let rubbing = cylinder.clone().rubbing(0.3);
    let budget = BUDGET / 20;
    let told = solve_within(&rubbing.scene(), budget);
    let reason = told.reason.clone().unwrap_or_default();
    assert_eq!(told.status, Status::NotConverged, "{reason}");
    assert!(reason.contains("the shear is not solved: ") && reason.contains("budget, 1e9"), "{reason}");
    let dry = cylinder.solve();
    for path in ["load.force", "load.indentation", "pressure.centre"] {
        let apart = (told.number(path).unwrap() / dry.number(path).unwrap() - 1.0).abs();
        assert!(apart <= 1e-12 && told.error.each[path] <= 1e-5, "{path}: {apart:e}");
    }
    assert!(told.profile.pressure.iter().any(Option::is_some));
    assert!(told.stick.is_none() && told.profile.shear.is_none());
    assert!(told.plan.work > dry.plan.work + budget / 4, "{} of {budget}", told.plan.work);
    assert!(told.scene.friction.is_some() && told.assumptions.iter().any(|line| line.starts_with("Goodman")));

    let path = rubbing.clone().loaded("until = { half_width = 1.0, points = 3 }");
    let curve = solve_within(&path.scene(), budget).path.expect("a loading curve");
    assert_eq!((curve.status, curve.points()), (Status::NotConverged, 3));
    assert!(curve.note.as_ref().is_some_and(|note| note.contains("the shear is not solved")));
    // The same where a curve is asked for and no solution.
    let mut solver = Solver::new(&rubbing.scene()).expect("a scene");
    solver.limit(budget);
    let loads = LoadPath::until(Load::HalfWidth(Positive::new(1.0).unwrap()), 3).expect("loads");
    assert_eq!(solver.curve(&loads), curve);

    // Another load is solved with friction again.
    let mut solver = Solver::new(&rubbing.scene()).expect("a scene");
    solver.limit(budget);
    assert!(solver.solve().stick.is_none());
    solver.press(Load::HalfWidth(Positive::new(0.01).unwrap()));
    let narrow = solver.solve();
    assert_eq!(narrow.status, Status::Converged, "{:?}", narrow.reason);
    assert!(narrow.stick.is_some());
    // As it is with another friction, and another budget.
    solver.press(Load::HalfWidth(Positive::new(1.0).unwrap()));
    assert!(solver.solve().stick.is_none());
    solver.limit(budget / 2);
    let Some(friction) = rubbing.clone().rubbing(0.4).scene().friction else { unreachable!() };
    solver.rub(friction);
    let reason = solver.solve().reason.unwrap_or_default();
    assert!(reason.contains("budget, 5e8"), "{reason}");

    // Who asks for nothing else is told nothing else.
    let alone = solve_within(&rubbing.with("[output]\nquantities = [\"stick\"]").scene(), budget);
    assert!(alone.load.force.is_none() && alone.reason.is_some_and(|reason| !reason.contains("not told")));
}

/// Found by random scenes: four loads on the way to another, without friction, took all flat punches that the contact
/// might be made of, a hundred times the work of the last load.
#[test]
fn a_few_loads_on_the_way_take_little() {
    let scene = Sketch::flat(0.05, 4.0, 0.3).cylinder().with("[solver]\ntolerance = 1e-6");
    let alone = scene.clone().loaded("half_width = 1.0").solve().plan.work;
    let path = scene.loaded("until = { half_width = 1.0, points = 5 }").solve();
    assert_eq!(path.path.unwrap().status, Status::Converged);
    assert!(path.plan.work < 8 * alone, "{} for five loads, {alone} for one", path.plan.work);
}

/// Found by random scenes: a contact 1e20 times as wide as a stack (as no scene has it any more) asked for more nodes
/// than can be counted, and a datum 1e-24 deep for more pieces of `graded-panels` than there is memory: both panicked.
#[test]
fn lengths_beyond_compare_do_not_panic() {
    let scenes = [
        "format = 1\nlayer = { poisson = 0.3, grading = { type = \"stack\", layers = [{ thickness = 50.0, \
         grading = { type = \"exponential\", surface = 5e-3, base = 5e-4 } }] } }\n\
         punch = { type = \"flat\", half_width = 5e10 }\nfriction = { type = \"goodman\", coefficient = 0.5 }\nload = { force = 0.01 }",
        "format = 1\nlayer = { thickness = 5.0, poisson = 0.3, datum = 1e-8, grading = { type = \"homogeneous\", modulus = 1.0 }, \
         base = { type = \"half-plane\", shear = 0.7, poisson = 0.3 } }\npunch = { type = \"cylinder\", radius = 1.0 }\n\
         load = { half_width = 1.0 }\nsolver = { tolerance = 1e-3, quadrature = { type = \"graded-panels\" } }",
    ];
    for text in scenes {
        let scene = slipzone::scene::parse("beyond", text).unwrap();
        let solution = slipzone::engine::solve_within(&scene, 10_000_000);
        assert!(solution.status == Status::Converged || solution.reason.is_some());
    }
}

/// Under 2,000 thicknesses a pinned resolution sums its kernels over a grid a hundred times as fine: that counted
/// nothing beside the readings, and ten seconds of budget took a minute. Panels were cut as often, and ten milliseconds
/// took 13 seconds: cut as each target sees them they take no more than that.
#[test]
fn what_a_finer_grid_costs_counts() {
    let within = |quadrature: &str, budget: u64| {
        let text = format!(
            "format = 1\n[layer]\nthickness = 5.0\npoisson = 0.3\n\
             grading = {{ type = \"exponential\", surface = 1.0, base = 8.0 }}\n\
             [punch]\ntype = \"flat\"\nhalf_width = 1e4\n[load]\nforce = 1.0\n\
             [solver]\nquadrature = {{ type = {quadrature} }}\n"
        );
        slipzone::engine::solve_within(&slipzone::scene::parse("wide", &text).unwrap(), budget)
    };
    // Enough for the readings, 8 million at first, and for elimination, but for nothing beside them.
    let solution = within("\"de-sinc\", n = 100", 120_000_000);
    let reason = solution.reason.unwrap_or_default();
    assert!(solution.status == Status::Refused && reason.contains("budget, 1e8"), "{:?}: {reason}", solution.status);
    let solution = within("\"graded-panels\", nodes = 14", 120_000_000);
    assert!(solution.status != Status::Refused, "{:?}", solution.reason);
}

/// The slip zone beside a stick zone took 21 nodes for each thickness of the layer in it, 2e4 where the layer was a
/// thousandth of the contact: half of all readings, for no digit.
#[test]
fn slip_zones_on_a_thin_coating_take_no_more_nodes_than_the_unknowns_tell() {
    let text = "format = 1\nlayer = { thickness = 1e-3, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 2.0 }, \
                base = { type = \"half-plane\", shear = 1.0, poisson = 0.3 } }\n\
                punch = { type = \"flat\", half_width = 1.0 }\nfriction = { type = \"goodman\", coefficient = 0.2 }\n\
                load = { force = 1.0 }\nsolver = { tolerance = 1e-4 }";
    let solution = solve(&slipzone::scene::parse("coating", text).unwrap());
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    let readings = solution.plan.kernel_evaluations;
    assert!(readings < 80_000_000, "{readings} readings");
    // With 182 unknowns and 21 nodes for each thickness.
    let apart = (solution.stick.unwrap().ratio.unwrap() / 0.399_743_092 - 1.0).abs();
    assert!(apart < solution.error.each["stick.ratio"], "{apart:e}");
}

/// Found by random scenes: each load of a curve tried again what the budget had refused, and a refused system was
/// counted as done (98,280 loads, three minutes, 3,400 times the budget); a stick zone refused between two grids was
/// told on the wrong one, which panicked.
#[test]
fn what_the_budget_refused_is_not_tried_again() {
    let many = "format = 1\npunch = { type = \"flat\", half_width = 1374.0 }\nlayer = { thickness = 1.44, poisson = 0.43, \
                grading = { type = \"error-function\", above = 7.7, below = 4.0, centre = 1.5, width = 0.517 } }\n\
                load = { until = { force = 0.244, points = 2000 } }";
    let between = "format = 1\npunch = { type = \"flat\", half_width = 10.0 }\nload = { until = { force = 0.6 } }\n\
                   friction = { type = \"goodman\", coefficient = 1.8 }\nlayer = { poisson = 0.24, grading = { type = \"stack\", \
                   layers = [{ thickness = 2.0, grading = { type = \"sigmoid\", above = 100.0, below = 0.2, centre = 2.0, \
                   width = 0.2 } }, { thickness = 4.0, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
                   { thickness = 0.5, grading = { type = \"sigmoid\", above = 0.8, below = 2.0, centre = 2.0, width = 0.9 } }] } }";
    let budgets = [1_500_000, 3_000_000, 4_500_000, 6_000_000];
    for (text, budget) in [many, between].into_iter().flat_map(|text| budgets.map(|budget| (text, budget))) {
        let solution = slipzone::engine::solve_within(&slipzone::scene::parse("refused", text).unwrap(), budget);
        // Refused where it ends before anything can be said of an error.
        let reason = solution.reason.expect("why");
        let is_short = solution.status == Status::NotConverged || reason.contains("budget");
        assert!(is_short && solution.status != Status::Converged, "{budget}: {reason}");
        // Once for the last load, twice for those on the way to it.
        assert!(solution.plan.work <= 3 * budget, "{:e} of {budget}", solution.plan.work as f64);
    }
}

/// Found by random scenes: loads told between the flat punches solved were told however many there were (100,000, 200
/// times the budget).
#[test]
fn a_curve_told_from_flat_punches_keeps_to_its_budget_too() {
    let text = "format = 1\npunch = { type = \"cylinder\", radius = 272.0 }\n\
                layer = { thickness = 4.0, poisson = 0.47, grading = { type = \"linear\", surface = 100.0, base = 1.0 } }\n\
                load = { until = { indentation = 0.36, points = 5000 } }";
    let budget = 20_000_000;
    let solution = slipzone::engine::solve_within(&slipzone::scene::parse("curve", text).unwrap(), budget);
    assert_eq!(solution.status, Status::Converged, "the last load by itself: {:?}", solution.reason);
    let path = solution.path.expect("a curve");
    let note = path.note.expect("why some loads have no numbers");
    assert!(path.status == Status::Refused && note.contains("budget, 2e7"), "{:?}: {note}", path.status);
    assert!(solution.plan.work <= 3 * budget, "{:e} of {budget}", solution.plan.work as f64);
}

/// A load on the way was told less well than the tolerance by the flat punches of the last one, and that was left so,
/// without a reason.
#[test]
fn a_load_that_the_flat_punches_of_the_last_one_do_not_tell_is_solved_by_itself() {
    let text = "format = 1\nlayer = { thickness = 2.0, poisson = 0.3, grading = { type = \"exponential\", surface = 1.0, \
                base = 0.2 } }\npunch = { type = \"cylinder\", radius = 20.0 }\n\
                friction = { type = \"goodman\", coefficient = 0.1 }\nload = { path = { half_width = [0.45, 1.5] } }";
    let path = solve(&slipzone::scene::parse("path", text).unwrap()).path.unwrap();
    assert!(path.status == Status::Converged && path.note.is_none(), "{:?}: {:?}", path.status, path.note);
    assert!(path.error.unwrap() <= 1e-8, "{:?}", path.error);
}

/// Of a solid without a base a loading curve had no depths, with a datum neither, not even where they were the load.
#[test]
fn a_loading_curve_has_depths_where_there_is_a_datum() {
    let layer = "poisson = 0.3, base = { type = \"infinite\" }, grading = { type = \"homogeneous\", modulus = 1.0 }";
    let punch = "type = \"cylinder\", radius = 10.0";
    let curve = |datum: &str, path: &str| {
        written(&format!("{layer}{datum}"), punch, &format!("path = {{ {path} }}"), "")
            .path
            .expect("a path")
            .indentation
    };
    assert_eq!(curve(", datum = 12.0", "indentation = [0.2, 0.3]"), Some(vec![Some(0.2), Some(0.3)]));
    assert_eq!(curve("", "half_width = [0.5, 1.0]"), None);
}

/// What the kernels of a layer are told to, more digits than there are, was refused; so was a contact whose tractions
/// would have taken too much once all resolutions had been tried in vain.
#[test]
fn more_digits_than_there_are_get_the_digits_that_there_are() {
    let within = |text: &str, budget: u64| {
        let solution = solve_within(&slipzone::scene::parse("vain", text).unwrap(), budget);
        assert_eq!(solution.status, Status::NotConverged, "{:?}", solution.reason);
        let error = solution.error.estimate.unwrap();
        assert!(error < 1e-8, "{error:e}");
        solution
    };
    let solved = |text: &str| within(text, BUDGET);
    let flat = |tolerance: f64| {
        format!(
            "format = 1\nlayer = {{ thickness = 0.1113, poisson = 0.364, grading = {{ type = \"linear\", surface = 1.0, base = 100.36 }} }}\n\
             punch = {{ type = \"flat\", half_width = 1.0 }}\nload = {{ force = 1.0 }}\n\
             solver = {{ tolerance = {tolerance:e}, kernel = {{ type = \"split\" }} }}"
        )
    };
    let [fine, finest] = [1e-10, 1e-12].map(|tolerance| solved(&flat(tolerance)));
    let apart = (fine.edge.ratio.unwrap() / finest.edge.ratio.unwrap() - 1.0).abs();
    assert!(apart < fine.error.each["edge.ratio"] + finest.error.each["edge.ratio"], "{apart:e}");

    // No number of the shear is claimed to 1e-12: 129 unknowns told no more than 46.
    let rubbed = solved(
        "format = 1\nlayer = { thickness = 5.0, poisson = 0.3, grading = { type = \"exponential\", surface = 1.0, base = 8.0 } }\n\
         punch = { type = \"flat\", half_width = 1.0 }\nfriction = { type = \"goodman\", coefficient = 0.3 }\n\
         load = { force = 1.0 }\nsolver = { tolerance = 1e-12 }",
    );
    assert!(rubbed.plan.unknowns < 65 && rubbed.error.estimate.unwrap() < 1e-11, "{:?}", rubbed.plan);

    let grown = within(
        "format = 1\nlayer = { thickness = 0.7, poisson = 0.382, grading = { type = \"exponential\", surface = 1.0, base = 0.0263 } }\n\
         punch = { type = \"power\", coefficient = 0.1, exponent = 3.0 }\nfriction = { type = \"goodman\", coefficient = 0.4297 }\n\
         load = { force = 0.2148 }\nsolver = { tolerance = 1e-11 }",
        4_000_000_000,
    );
    // It ends where further resolutions have no more digits to tell.
    assert!(grown.plan.work < 2_000_000_000, "{:e}", grown.plan.work as f64);
    assert!(!grown.profile.pressure.is_empty());
}

/// Numbers that were found are told, though no budget is left for the tractions.
#[test]
fn a_budget_spent_on_the_numbers_leaves_the_numbers() {
    let text = "format = 1\nlayer = { thickness = 5.0, poisson = 0.3, grading = { type = \"exponential\", surface = 1.0, base = 8.0 } }\n\
                punch = { type = \"wedge\", slope = 0.1 }\nfriction = { type = \"goodman\", coefficient = 0.3 }\nload = { half_width = 1.0 }\n\
                output = { points = 20001 }";
    let solution = slipzone::engine::solve_within(&slipzone::scene::parse("spent", text).unwrap(), 300_000_000);
    assert_eq!(solution.status, Status::NotConverged);
    let reason = solution.reason.unwrap();
    assert!(reason.contains("tractions") && reason.contains("budget"), "{reason}");
    assert!(solution.profile.x.is_empty() && solution.stick.unwrap().ratio.is_some());
    assert!(solution.error.estimate.unwrap() < 1e-8);
}

/// Under a force it went on to half of its budget, half a minute, though nothing was left but what is not proved of the
/// kernels. Under a half-width it stopped.
#[test]
fn a_force_takes_no_steps_for_what_no_step_mends() {
    let layer = "thickness = 0.33502499835163135, poisson = -0.5, plane = \"stress\", moduli = \"young\", \
                 base = { type = \"half-plane\", shear = 0.8485160417875646, poisson = 0.3494262021022059 }, \
                 grading = { type = \"formula\", modulus = \"M*(1+A*(y/h)^2.5)\", \
                 parameters = { M = 0.07392631456702033, A = 1.0090716263578956 } }";
    let rest = "friction = { type = \"goodman\", coefficient = 0.4089687497441098 }\nsolver = { tolerance = 1e-3 }";
    let found = written(layer, "type = \"cylinder\", radius = 20.0", "force = 0.010328702697592724", rest);
    // 1e10 before.
    assert!(found.plan.work < 1_000_000_000, "{:e} multiplications: {:?}", found.plan.work as f64, found.reason);
    assert!((found.load.half_width.unwrap() - 1.0).abs() < 1e-3, "{:?}", found.load.half_width);
}

/// It was looked for whatever was left of the budget: half a minute at a million points. Then the tractions went with
/// it, though they were known.
#[test]
fn the_strain_left_in_a_stick_zone_counts_as_work() {
    const ENOUGH_FOR_TRACTIONS: u64 = 70_000_000;
    let scene = |strain: bool| {
        let text = format!(
            "format = 1\nlayer = {{ thickness = 2.0, poisson = 0.3, grading = {{ type = \"homogeneous\", modulus = 1.0 }} \
             }}\npunch = {{ type = \"cylinder\", radius = 10.0 }}\nload = {{ half_width = 1.0 }}\n\
             friction = {{ type = \"goodman\", coefficient = 0.3 }}\noutput = {{ points = 2001, strain = {strain} }}"
        );
        slipzone::scene::parse("strain", &text).unwrap_or_else(|why| panic!("{why}"))
    };
    let without = solve_within(&scene(false), ENOUGH_FOR_TRACTIONS);
    assert_eq!(without.status, Status::Converged, "{:?}", without.reason);
    let within = solve_within(&scene(true), ENOUGH_FOR_TRACTIONS);
    assert_eq!(within.status, Status::NotConverged);
    let why = within.reason.as_deref().unwrap_or_default();
    assert!(why.contains("the strain left in the stick zone is not known: ") && why.contains("budget"), "{why}");
    assert!(!why.contains("tractions") && within.profile.strain.is_none());
    assert!(within.profile.shear.is_some() && within.profile.shear == without.profile.shear);
    assert_eq!(within.load.force, without.load.force);
    let whole = solve(&scene(true));
    assert!(whole.status == Status::Converged && whole.profile.strain.is_some(), "{:?}", whole.reason);
}

/// On layers that stiffen steeply from their surface down, stacks of flat punches took grids for `split` that no budget
/// allows, where `octaves` take a hundredth of the work. Other loads take the usual methods again.
#[test]
fn octaves_solve_what_split_has_no_budget_for() {
    let text = "format = 1\nlayer = { thickness = 1.3, poisson = 0.3, grading = { type = \"linear\", surface = 1.0, base = 100.0 } }\n\
                punch = { type = \"rounded-flat\", half_width = 0.5, radius = 50.0 }\nload = { half_width = 1.0 }\n";
    let scene = slipzone::scene::parse("steep", text).unwrap();
    let mut solver = Solver::new(&scene).unwrap();
    solver.limit(2_000_000_000);
    let solution = solver.solve();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    assert_eq!((solution.plan.kernel, solution.plan.quadrature), ("octaves", "graded-panels"));
    let reasons = solution.plan.reasons.join("; ");
    assert!(reasons.contains("tolerance was missed on the grids that `split` takes"), "{reasons}");
    assert!(!solution.profile.x.is_empty());
    let named = format!("{text}solver = {{ quadrature = {{ type = \"graded-panels\" }} }}\n");
    let exact = solve(&slipzone::scene::parse("named", &named).unwrap());
    within_three_estimates(&solution, &exact, &["load.force", "load.indentation", "pressure.centre", "pressure.peak"]);
    solver.press(slipzone::scene::Load::HalfWidth(slipzone::api::Positive::new(0.51).unwrap()));
    solver.limit(BUDGET);
    let narrower = solver.solve();
    assert_eq!((narrower.status, narrower.plan.kernel), (Status::Converged, "split"));
}

/// Under two thousand sublayers, each a twenty-five-hundredth of the half-width thick, `de-sinc` has no room for the
/// unknowns that the tolerance takes; `octaves` take a fifth of a second.
#[test]
fn octaves_solve_stacks_too_fine_for_the_unknowns_of_split() {
    let moduli = ["1.0", "3.0", "7.0", "7.0", "3.0"];
    let sublayer = |i: usize| {
        format!(
            "{{ thickness = 4e-4, grading = {{ type = \"homogeneous\", modulus = {} }} }}",
            moduli[i % moduli.len()]
        )
    };
    let sublayers: Vec<String> = (0..2000).map(sublayer).collect();
    let text = |solver: &str| {
        let stack = sublayers.join(", ");
        let text = format!(
            "format = 1\npunch = {{ type = \"flat\", half_width = 1.0 }}\nload = {{ force = 1.0 }}\n{solver}\n\
             layer = {{ thickness = 0.8, poisson = 0.3, grading = {{ type = \"stack\", layers = [{stack}] }} }}\n"
        );
        slipzone::scene::parse("fine", &text).unwrap()
    };
    let [own, named] = ["", "solver = { kernel = { type = \"split\" }, quadrature = { type = \"de-sinc\" } }"]
        .map(|solver| solve(&text(solver)));
    assert_eq!((own.status, own.plan.kernel), (Status::Converged, "octaves"), "{:?}", own.reason);
    assert_eq!((named.status, named.plan.kernel), (Status::NotConverged, "split"), "what is named is taken");
    let panels = solve(&text("solver = { quadrature = { type = \"graded-panels\" } }"));
    assert_eq!((panels.status, panels.plan.kernel), (Status::Converged, "split"), "{:?}", panels.reason);
    within_three_estimates(&own, &panels, &["edge.ratio", "load.indentation", "pressure.centre"]);
}

/// Other methods are no way round a model that the scene forces.
#[test]
fn octaves_are_not_tried_where_a_forced_model_misses_the_tolerance() {
    let layer = "format = 1\nlayer = { thickness = 5.0, poisson = 0.3, grading = { type = \"linear\", surface = 1.0, base = 4.0 } }\n";
    let flat = "punch = { type = \"flat\", half_width = 1.0 }\nload = { force = 1.0 }\n";
    let forced = format!("{layer}{flat}solver = {{ model = \"homogeneous\" }}\n");
    let forced = solve(&slipzone::scene::parse("forced", &forced).unwrap());
    assert_eq!((forced.status, forced.plan.kernel), (Status::NotConverged, "split"));
}

/// What the kernels prove of themselves is felt by several times as much under a load that hardly tells the contact: it
/// was "not converged" without a word, and took no more digits from a smaller tolerance.
#[test]
fn what_kernels_leave_is_said() {
    let layer = "datum = 2.0, thickness = 0.05, poisson = 0.3, base = { type = \"half-plane\", shear = 1.0, poisson = 0.3 }, \
                 grading = { type = \"exponential\", surface = 10000.0, base = 2.0 }";
    let solved = |load: &str| written(layer, "type = \"cylinder\", radius = 1.0", load, "");
    let exact = solved("half_width = 0.1");
    assert_eq!(exact.status, Status::Converged, "{:?}", exact.reason);
    let found = solved(&format!("force = {:?}", exact.load.force.unwrap()));
    assert!((found.load.half_width.unwrap() / 0.1 - 1.0).abs() < 1e-10);
    let reason = found.reason.unwrap_or_default();
    assert!(reason.contains("proved of the kernels") && reason.contains("larger `tolerance`"), "{reason}");
}
