//! Models that stand for a solid: the planner's answer is within tolerance of the full model's, and so is every bound.
//!
//! `cargo run --release --example planner` does the same on thousands of scenes, and counts the work saved.

#[path = "../../examples/planner/scenes.rs"]
mod scenes;

use crate::sketch::Sketch;
use scenes::{ALL_BUT_DEPTH, Dice, differences, scene};
use slipzone::api::Positive;
use slipzone::engine::{Layer, Solution, Solver, Status, solve};
use slipzone::scene::{Load, LoadPath, Model, Scene};

fn parsed(text: &str) -> Scene {
    slipzone::link_plugins();
    slipzone::scene::parse("planned.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A homogeneous layer a hundred times as thick as the contact is wide: its edge differs from a half-plane's by 7e-5.
fn thick() -> Sketch {
    Sketch::flat(100.0, 1.0, 0.3)
}

/// That, at a tolerance, all but the indentation asked for.
fn asked(sketch: &Sketch, solver: &str) -> Solution {
    solve(&parsed(&sketch.clone().with(&format!("[solver]\n{solver}\n[output]\n{ALL_BUT_DEPTH}")).text()))
}

#[test]
fn every_bound_holds_and_every_choice_is_within_tolerance() {
    let mut chosen = [0; 3];
    for index in 0..220 {
        let mut dice = Dice(1_000_003 + index);
        let text = scene(&mut dice);
        if text.contains("friction") && !text.contains("\"flat\"") {
            continue; // a second each
        }
        let tolerance = dice.log(1e-6, 3e-2);
        let with =
            |solver: &str, output: &str| solve(&parsed(&format!("{text}[solver]\n{solver}\n[output]\n{output}\n")));
        let models =
            [("half-plane", ALL_BUT_DEPTH), ("corrected-half-plane", "points = 2"), ("homogeneous", "points = 2")];
        for (place, (model, output)) in models.into_iter().enumerate() {
            let full = with("tolerance = 1e-6\nmodel = \"full\"", output);
            if full.status != Status::Converged {
                continue;
            }
            let forced = with(&format!("tolerance = 1e-6\nmodel = \"{model}\""), output);
            // The errors stated hold the bound; 1 says that nothing is claimed.
            for (path, error, stated) in differences(&forced, &full) {
                assert!(
                    error <= stated + 1e-6 || stated >= 1.0,
                    "seed {index}, {model}: {path} is off by {error:e}, not {stated:e}\n{text}"
                );
            }
            // What the corrected half-plane serves is left to it otherwise.
            let forbidden = if model == "homogeneous" { "forbid = [\"corrected-half-plane\"]" } else { "" };
            let planned = with(&format!("tolerance = {tolerance:e}\n{forbidden}"), output);
            assert_eq!(planned.status, Status::Converged, "seed {index}: {:?}\n{text}", planned.reason);
            for (path, error, _) in differences(&planned, &full) {
                assert!(
                    error <= tolerance + 1e-6,
                    "seed {index}, {:?}: {path} is off by {error:e} at {tolerance:e}\n{text}",
                    planned.plan.model
                );
            }
            chosen[place] += usize::from(planned.plan.model.name() == model);
        }
    }
    assert!(chosen.iter().all(|count| *count > 5), "chosen {chosen:?} times: nothing was tested");
}

#[test]
fn a_thick_layer_is_a_half_plane_where_the_tolerance_allows_it() {
    let found = asked(&thick(), "tolerance = 1e-3");
    assert_eq!((found.status, found.plan.model), (Status::Converged, Model::HalfPlane));
    assert_eq!(found.plan.flexibility_evaluations, 0);
    assert!(found.plan.reasons[0].starts_with("half-plane: base and grading"), "{:?}", found.plan.reasons);
    assert!(found.assumptions.iter().any(|what| what.contains("half-plane")), "{:?}", found.assumptions);
    let bound = found.plan.bound.expect("solved");
    let full = asked(&thick(), "tolerance = 1e-8");
    assert_eq!((full.plan.model, full.plan.bound), (Model::Full, Some(0.0)), "1e-8 takes the layer");
    let error = found.edge.ratio.unwrap() / full.edge.ratio.unwrap() - 1.0;
    // c b^2/2 with c = 1.43 for this layer (docs/planner.md).
    assert!((3e-5..1e-4).contains(&error.abs()) && error.abs() < bound && bound < 1e-3, "{error:e}, bound {bound:e}");
    assert!(found.error.each["edge.ratio"] >= bound && found.error.how.contains("bound"), "{:?}", found.error);

    // What the scene in the result says gives the same result.
    let again = solve(&found.scene);
    assert_eq!(again.edge.ratio.map(f64::to_bits), found.edge.ratio.map(f64::to_bits));
    // A half-plane has no indentation.
    assert_eq!(thick().with("[solver]\ntolerance = 1e-3").solve().plan.model, Model::CorrectedHalfPlane);
}

/// Between the half-plane and the layer: two dozen wave numbers, the depth told, errors within what is stated, and no
/// closer to the truth than the next term of the kernels allows.
#[test]
fn a_half_plane_with_its_first_correction_stands_for_a_thick_layer() {
    let at = |tolerance: &str, solver: &str| {
        thick().rubbing(0.3).with(&format!("[solver]\ntolerance = {tolerance}\n{solver}")).solve()
    };
    let found = at("1e-5", "");
    assert_eq!((found.status, found.plan.model), (Status::Converged, Model::CorrectedHalfPlane), "{:?}", found.reason);
    assert_eq!((found.plan.flexibility_evaluations, found.plan.kernel), (24, "moments"));
    assert!(found.plan.reasons[0].starts_with("corrected-half-plane: the grading"), "{:?}", found.plan.reasons);
    let full = at("1e-10", "model = \"full\"");
    for (path, error, stated) in differences(&found, &full) {
        assert!(error <= stated + 1e-9 && stated <= 1e-5, "{path} is off by {error:e}, not {stated:e}");
    }
    let forced = at("1e-10", "model = \"corrected-half-plane\"");
    assert_eq!(forced.status, Status::NotConverged);
    let edge = forced.edge.ratio.unwrap() / full.edge.ratio.unwrap() - 1.0;
    let stated = forced.error.each["edge.ratio"];
    assert!(edge.abs() > 1e-9 && edge.abs() <= stated && stated < 2e-6, "{edge:e}, {stated:e} stated");

    // What the scene in the result says gives the same result; other methods beside the model are refused.
    let again = solve(&found.scene);
    assert_eq!(again.edge.ratio.map(f64::to_bits), found.edge.ratio.map(f64::to_bits), "{:?}", again.reason);
    let named = at("1e-5", "model = \"corrected-half-plane\"\nkernel = { type = \"split\" }");
    assert_eq!(named.status, Status::Refused);
    let forbidden = at("1e-5", "forbid = [\"corrected-half-plane\"]");
    assert_eq!((forbidden.status, forbidden.plan.model), (Status::Converged, Model::Full));
}

/// A soft film between the samples of the planner: with a homogeneous layer in its place the depth was off by a third.
#[test]
fn a_film_in_a_table_is_no_homogeneous_layer() {
    let table = |film: f64| {
        let row = |i: u32| {
            let y = f64::from(i) / 400.0;
            format!("[{y:?}, {:?}]", (-5.0 * film * (-((y - 2.023) / 0.02).powi(2)).exp()).exp())
        };
        let rows: Vec<String> = (0..=2000).map(row).collect();
        let layer =
            format!("thickness = 5.0\npoisson = 0.3\ngrading = {{ type = \"table\", points = [{}] }}", rows.join(", "));
        Sketch::on(layer).with("[solver]\ntolerance = 1e-4").solve().plan.model
    };
    assert_eq!((table(0.0), table(1.0)), (Model::Homogeneous, Model::Full));
}

#[test]
fn a_choice_can_be_forced_and_forbidden() {
    let forbidden = asked(&thick(), "tolerance = 1e-3\nforbid = [\"half-plane\", \"corrected-half-plane\"]");
    assert_eq!((forbidden.status, forbidden.plan.model), (Status::Converged, Model::Full));
    let forced = asked(&thick(), "tolerance = 1e-8\nmodel = \"half-plane\"");
    assert_eq!(forced.status, Status::NotConverged, "{:?}", forced.reason);
    let (stated, bound) = (forced.error.each["edge.ratio"], forced.plan.bound.expect("solved"));
    assert!(stated >= bound && bound > 1e-8, "{stated:e}, {bound:e}");
    assert!(forced.reason.expect("why").contains("exceeds the tolerance"));
    let refused = thick().with("[solver]\nmodel = \"half-plane\"").solve();
    assert_eq!(refused.status, Status::Refused);
    assert!(refused.reason.expect("why").contains("has no indentation"));
    let pinned = asked(&thick(), "tolerance = 1e-3\nflexibility = { type = \"compliance\" }");
    assert_eq!(pinned.plan.model, Model::Full, "who names a method means the layer");
}

/// One layer serves scenes that are solved in full and by a model, in any order, with the bits of each alone.
#[test]
fn models_and_layers_share_a_solver() {
    let scene = |load: f64| {
        let sketch = Sketch::flat(100.0, 1.0, 0.3).cylinder().loaded(&format!("half_width = {load:?}"));
        parsed(&sketch.with(&format!("[solver]\ntolerance = 1e-4\n[output]\n{ALL_BUT_DEPTH}")).text())
    };
    let mut layer = Layer::of(&scene(1.0)).expect("a bonded layer");
    let mut models = Vec::new();
    for load in [0.1, 8.0, 0.2, 8.0] {
        let mut solver = Solver::on(layer, &scene(load)).expect("the same layer");
        let (found, alone) = (solver.solve(), solve(&scene(load)));
        assert_eq!(found.load.force.map(f64::to_bits), alone.load.force.map(f64::to_bits), "b = {load}");
        models.push((found.plan.model, found.plan.flexibility_evaluations));
        layer = solver.into_layer();
    }
    let evaluations = models[1].1;
    assert!(evaluations > 0);
    let expected =
        [(Model::HalfPlane, 0), (Model::Full, evaluations), (Model::HalfPlane, 0), (Model::Full, evaluations)];
    assert_eq!(models, expected, "the tables of the layer outlive the model");

    // A load that the model cannot bear takes the layer.
    let mut solver = Solver::new(&scene(0.1)).expect("a bonded layer");
    assert_eq!(solver.solve().plan.model, Model::HalfPlane);
    solver.press(Load::HalfWidth(Positive::new(8.0).unwrap()));
    let wide = solver.solve();
    assert_eq!((wide.plan.model, wide.status), (Model::Full, Status::Converged));
    assert!(wide.plan.reasons[0].starts_with("full"), "{:?}", wide.plan.reasons);
    let loads = LoadPath::until(Load::HalfWidth(Positive::new(0.1).unwrap()), 5).unwrap();
    assert_eq!(Solver::new(&scene(0.1)).unwrap().curve(&loads).status, Status::Converged);
}

/// Friction of the coupled equations over Goodman's, at the same stick ratio, on half-planes.
#[test]
fn what_goodman_neglects_is_told_as_it_was_measured() {
    let table = include_str!("../data/coupled_half_plane.csv");
    let rows = table.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    for row in rows {
        let row: Vec<f64> = row.split(',').map(|cell| cell.parse().expect("a number")).collect();
        let &[nu, ratio, eta] = row.as_slice() else { panic!("three columns") };
        let neglected = |friction: f64| {
            let found = Sketch::half_plane(nu).rubbing(friction).solve();
            (
                found.stick.and_then(|s| s.ratio).expect("a stick zone"),
                found.plan.coupling_neglected.expect("an estimate"),
            )
        };
        // Goodman's friction for that ratio, by bisection.
        let (mut low, mut high) = (0.1 * eta, eta);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if neglected(middle).0 < ratio { low = middle } else { high = middle }
        }
        let truth = eta / low - 1.0;
        let told = neglected(low).1;
        assert!((told / truth - 1.0).abs() < 0.02, "nu = {nu}, a/b = {ratio}: {told} told, {truth} true");
    }
    let layer = Sketch::flat(5.0, 0.125, 0.3).rubbing(0.3).solve();
    let told = layer.plan.coupling_neglected.expect("an estimate");
    assert!((0.01..0.5).contains(&told), "{told}");
    assert!(
        layer
            .assumptions
            .iter()
            .any(|what| what.starts_with("Goodman: with the effect of q on p, this a/b needs about")
                && what.ends_with("more friction"))
    );
    assert!(!layer.error.each.values().any(|error| *error > 1e-6), "it is no part of the numerical error");
    assert_eq!(Sketch::flat(5.0, 0.125, 0.3).solve().plan.coupling_neglected, None);
}

/// It was left out without a word.
#[test]
fn what_goodman_neglects_is_said_not_to_be_known_where_it_is_not() {
    let linear = |thickness: f64| {
        let grading = "{ type = \"linear\", surface = 1.0, base = 8.0 }";
        Sketch::on(format!("thickness = {thickness}\npoisson = 0.3\ngrading = {grading}"))
            .rubbing(0.3)
            .with("[solver]\ntolerance = 1e-3")
            .solve()
    };
    for (thickness, is_known) in [(0.06, false), (0.5, true)] {
        let found = linear(thickness);
        assert_eq!(
            (found.status, found.plan.coupling_neglected.is_some()),
            (Status::Converged, is_known),
            "{thickness}"
        );
        let said = found.assumptions.iter().filter(|what| what.starts_with("Goodman: what it costs")).count();
        assert_eq!(said, usize::from(!is_known), "{thickness}: {:?}", found.assumptions);
    }
}

/// Wide contacts on thin layers, told in closed form: within the bound of the full model, whatever the load, and chosen
/// where that is good enough.
#[test]
fn thin_layers_are_told_in_closed_form() {
    for index in 0..60 {
        let mut dice = Dice(77_000_000 + index);
        let (b, exponent) = (dice.log(5.0, 60.0), [2.0, 4.0, 6.0, 10.0][(index % 4) as usize]);
        let poisson = [0.0, 0.3, -0.4, 0.42][(index / 4 % 4) as usize];
        let base = ["rigid", "frictionless"][(index % 2) as usize];
        let modulus = dice.log(0.1, 10.0);
        let with = |load: &str, solver: &str| {
            solve(&parsed(&format!(
                "format = 1\nlayer = {{ thickness = 2.0, poisson = {poisson:?}, base = {{ type = \"{base}\" }}, \
                 grading = {{ type = \"exponential\", surface = 3.0, base = {modulus:?} }} }}\n\
                 punch = {{ type = \"power\", coefficient = 0.05, exponent = {exponent:?} }}\nload = {{ {load} }}\n\
                 [solver]\n{solver}\n[output]\nquantities = [\"load\", \"pressure\", \"edge\"]\n"
            )))
        };
        let by_width = format!("half_width = {:?}", 2.0 * b);
        let full = with(&by_width, "tolerance = 1e-7\nmodel = \"full\"");
        assert_eq!(full.status, Status::Converged, "seed {index}: {:?}", full.reason);
        let loads = [
            by_width,
            format!("force = {:?}", full.load.force.unwrap()),
            format!("indentation = {:?}", full.load.indentation.unwrap()),
        ];
        for load in loads {
            let thin = with(&load, "tolerance = 0.5\nmodel = \"thin\"");
            for (path, error, stated) in differences(&thin, &full) {
                assert!(error <= stated + 2e-7, "seed {index}, {load}: {path} is off by {error:e}, not {stated:e}");
            }
            let bound = thin.plan.bound.unwrap();
            let chosen = with(&load, &format!("tolerance = {:e}", (1.01 * bound).clamp(1e-6, 0.5)));
            assert!(bound > 0.5 || chosen.plan.model == Model::Thin, "seed {index}, {load}: {:?}", chosen.plan.reasons);
            let refined = with(&load, &format!("tolerance = {:e}", (0.9 * bound).clamp(1e-6, 0.5)));
            assert!(bound > 0.5 || refined.plan.model == Model::Full, "seed {index}, {load}");
        }
    }
}

/// A tip rounded off over less than a thickness was told by the bend of its shape at the edge: `p(0)` was off by 17
/// tolerances. What the edge does not show is told from the slope, in the middle and wherever the peak may be, and
/// beside the edge.
#[test]
fn thin_layers_feel_details_of_the_shape() {
    let shapes = [
        "height = \"0.05*sqrt(x^2 + 0.01)\"",
        "height = \"0.05*sqrt(x^2 + 1e-6)\"",
        "height = \"ln(cosh(x))\"",
        "slope = \"0.05*tanh(x/0.2)\"",
        // Corners, all but: in the middle of one side, and just inside the edge.
        "slope = \"0.0005*x + 0.02*(tanh((x - 10)/0.1) + tanh((x + 10)/0.1))\"",
        "slope = \"0.0005*x + 0.02*(tanh((x - 39.7)/0.1) + tanh((x + 39.7)/0.1))\"",
        // Waves of its slope all over.
        "height = \"0.001*(x^2/2 + 0.1*cos(3*x))\"",
    ];
    for (index, shape) in shapes.iter().enumerate() {
        let base = ["rigid", "frictionless"][index % 2];
        let with = |load: &str, solver: &str| {
            solve(&parsed(&format!(
                "format = 1\nlayer = {{ thickness = 1.0, poisson = 0.3, base = {{ type = \"{base}\" }}, \
                 grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
                 punch = {{ type = \"formula\", {shape} }}\nload = {{ {load} }}\n\
                 [solver]\n{solver}\n[output]\nquantities = [\"load\", \"pressure\"]\n"
            )))
        };
        let by_width = "half_width = 40.0".to_owned();
        let full = with(&by_width, "tolerance = 1e-5\nmodel = \"full\"");
        assert_eq!(full.status, Status::Converged, "{shape}: {:?}", full.reason);
        let by_force = format!("force = {:?}", full.load.force.unwrap());
        for load in [by_width, by_force] {
            let thin = with(&load, "tolerance = 0.5\nmodel = \"thin\"");
            for (path, error, stated) in differences(&thin, &full) {
                assert!(error <= stated + 2e-5, "{shape}, {load}: {path} is off by {error:e}, not {stated:e}");
            }
        }
    }
}

/// Shapes that change little over a thickness pay nothing for those that do.
#[test]
fn thin_layers_under_ordinary_shapes_have_one_bound() {
    for punch in [
        "type = \"cylinder\", radius = 1000.0",
        "type = \"power\", coefficient = 1e-4, exponent = 4.0",
        "type = \"formula\", height = \"x^2/2000 + 1e-9*x^4\"",
    ] {
        for base in ["rigid", "frictionless"] {
            let thin = solve(&parsed(&format!(
                "format = 1\nlayer = {{ thickness = 1.0, poisson = 0.3, base = {{ type = \"{base}\" }}, \
                 grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\npunch = {{ {punch} }}\n\
                 load = {{ half_width = 40.0 }}\n[solver]\ntolerance = 0.02\n[output]\nquantities = [\"load\", \"pressure\"]\n"
            )));
            let each = &thin.error.each;
            assert_eq!(thin.plan.model, Model::Thin, "{punch}: {:?}", thin.plan.reasons);
            assert_eq!(each["pressure.centre"].to_bits(), each["load.force"].to_bits(), "{punch}, {base}: {each:?}");
            assert_eq!(each["pressure.peak"].to_bits(), each["load.force"].to_bits(), "{punch}, {base}: {each:?}");
        }
    }
}

/// Where nothing else comes to an end: a contact a million thicknesses wide. Twice as wide, a parabola takes eight
/// times the force, but for the shift of its edge.
#[test]
fn a_contact_a_million_thicknesses_wide() {
    let force = |b: f64| {
        let solution = solve(&parsed(&format!(
            "format = 1\nlayer = {{ thickness = 1e-6, poisson = 0.3, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"cylinder\", radius = 10.0 }}\nload = {{ half_width = {b:?} }}\n\
             output = {{ quantities = [\"load\"] }}\n"
        )));
        assert_eq!((solution.status, solution.plan.model), (Status::Converged, Model::Thin));
        solution.load.force.unwrap()
    };
    assert!((force(2.0) / force(1.0) / 8.0 - 1.0).abs() < 1e-6);
    // P = 2 b^3/(3 R W), W = h (kappa - 1)/((kappa + 1) mu1), and three shifts of 0.12 h.
    let exact = 2.0 / (3.0 * 10.0) / (1e-6 * 0.8 / 2.8);
    assert!((force(1.0) / exact - 1.0 - 3.67e-7).abs() < 1e-9, "{}", force(1.0) / exact - 1.0);
}

#[test]
fn what_is_not_thin_is_not_taken_for_it() {
    let wide = "format = 1\nlayer = { thickness = 0.01, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }\n";
    let cases = [
        (
            "punch = { type = \"flat\", half_width = 1.0 }\nload = { force = 1.0 }\noutput = { quantities = [\"load\"] }",
            "corners",
        ),
        ("punch = { type = \"cylinder\", radius = 10.0 }\nload = { half_width = 1.0 }", "profile"),
        (
            "friction = { type = \"goodman\", coefficient = 0.3 }\npunch = { type = \"cylinder\", radius = 10.0 }\n\
             load = { half_width = 1.0 }\noutput = { quantities = [\"stick\"] }",
            "shear",
        ),
        (
            "punch = { type = \"cylinder\", radius = 10.0 }\nload = { half_width = 0.03 }\noutput = { quantities = [\"load\"] }",
            "four thicknesses",
        ),
    ];
    for (rest, word) in cases {
        let solution = solve(&parsed(&format!("{wide}{rest}\nsolver = {{ model = \"thin\" }}\n")));
        assert_eq!(solution.status, Status::Refused, "{rest}");
        assert!(solution.reason.as_ref().is_some_and(|reason| reason.contains(word)), "{rest}: {:?}", solution.reason);
    }
}

/// A curve is solved load by load, and never by another model than the scene's.
#[test]
fn a_thin_model_has_no_curve() {
    let scene = parsed(
        "format = 1\nlayer = { thickness = 0.01, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
         punch = { type = \"cylinder\", radius = 10.0 }\nload = { half_width = 1.0 }\n\
         output = { quantities = [\"load\"] }\nsolver = { model = \"thin\", tolerance = 1e-6 }\n",
    );
    let mut solver = Solver::new(&scene).unwrap();
    let loads = LoadPath::until(scene.load, 3).unwrap();
    assert_eq!(solver.curve(&loads).status, Status::Refused);
    assert!(solver.find().is_err());
    assert_eq!(solver.solve().plan.model, Model::Thin);
}

/// A modulus like a root down to 1e-5 of the thickness is too rough for `split`, which said so and what to ask for
/// instead.
#[test]
fn kernels_too_rough_for_split_are_told_by_octaves() {
    let scene = |gradings: &str, punch: &str, solver: &str| {
        let text = format!(
            "format = 1\nlayer = {{ thickness = 1.0, poisson = 0.3, grading = {gradings} }}\npunch = {punch}\n\
             solver = {{ tolerance = 1e-5{solver} }}\n"
        );
        parsed(&text)
    };
    let flat = "{ type = \"flat\", half_width = 1.0 }\nload = { force = 1.0 }";
    let cylinder = "{ type = \"cylinder\", radius = 10.0 }\nload = { path = { half_width = [0.1, 1.0] } }";
    for grading in [
        "{ type = \"power-law\", surface = 1.0, length = 1e-5, exponent = 0.5 }",
        "{ type = \"formula\", modulus = \"0.04 + sqrt(y/h + 1e-5)\" }",
    ] {
        for punch in [flat, cylinder] {
            let open = solve(&scene(grading, punch, ""));
            assert_eq!(open.status, Status::Converged, "{:?}", open.reason);
            assert_eq!((open.plan.kernel, open.plan.quadrature), ("octaves", "graded-panels"));
            let why = |reason: &std::borrow::Cow<str>| reason.contains("too rough beside t = 0 for `split`");
            assert!(open.plan.reasons.iter().any(why), "{:?}", open.plan.reasons);
            let named =
                ", kernel = { type = \"octaves\" }, quadrature = { type = \"graded-panels\", nodes = 20, panels = 24 }";
            let other = solve(&scene(grading, punch, named));
            for key in ["load.force", "pressure.centre", "load.indentation"] {
                let (one, two) = (open.number(key), other.number(key));
                let Some((one, two)) = one.zip(two) else { continue };
                assert!((one / two - 1.0).abs() < 3e-5, "{key}: {one} and {two}");
            }
        }
        // Who names a method means it.
        let named = solve(&scene(grading, flat, ", kernel = { type = \"split\" }"));
        assert_eq!(named.status, Status::Refused);
        assert!(named.reason.is_some_and(|reason| reason.contains("octaves")));
    }
}

/// What a model makes of a number differs from the full one's by no more than is claimed.
fn claims_hold(model: &Solution, full: &Solution) {
    assert_eq!(full.plan.model, Model::Full);
    let compared = differences(model, full);
    assert!(!compared.is_empty(), "{model:?}");
    for (path, error, stated) in compared {
        assert!(error <= stated + 1e-6, "{path} is off by {error:e}, not {stated:e}: {:?}", model.plan);
    }
}

/// The softer a base the farther it is felt.
#[test]
fn bounds_hold_on_very_soft_bases() {
    let layer = |h: f64| {
        format!(
            "thickness = {h:?}\npoisson = 0.3\ngrading = {{ type = \"homogeneous\", modulus = 1.0 }}\n\
             base = {{ type = \"half-plane\", shear = 1e-3, poisson = 0.3 }}"
        )
    };
    for (h, friction, quantity) in [(1000.0, Some(0.1), "stick.ratio"), (50.0, None, "edge.ratio")] {
        let sketch = Sketch { eta: friction, ..Sketch::on(layer(h)) };
        let solved = |model: &str| {
            let solver = format!("[solver]\ntolerance = 1e-4\nmodel = \"{model}\"");
            sketch.clone().with(&format!("{solver}\n[output]\nquantities = [\"{quantity}\"]")).solve()
        };
        claims_hold(&solved("half-plane"), &solved("full"));
    }
}

/// The force for a depth feels the gradient in another way than that for a half-width.
#[test]
fn bounds_hold_of_loads_by_depth() {
    let text = Sketch::flat(20.0, 0.5, 0.3).cylinder().loaded("indentation = 1e-6").text();
    let text = text.replace("radius = 1.0", "radius = 1000.0");
    let solved = |solver: &str| {
        let asked = "[output]\nquantities = [\"load.half_width\", \"load.force\"]";
        solve(&parsed(&format!("{text}\n[solver]\n{solver}\n{asked}\n")))
    };
    claims_hold(&solved("tolerance = 0.3"), &solved("tolerance = 1e-6\nmodel = \"full\""));
}

/// Where the strain is prescribed, nothing bounds it either.
#[test]
fn no_model_stands_for_a_solid_under_a_prescribed_strain() {
    let text = Sketch::flat(1e5, 1.0, 0.3).cylinder().rubbing(0.3).with("[solver]\nmodel = \"half-plane\"").text();
    let text = text.replace("coefficient", "strain = \"linear\"\ncoefficient");
    let refused = solve(&parsed(&text));
    assert_eq!(refused.status, Status::Refused);
    assert!(refused.reason.is_some_and(|why| why.contains("no bound on the strain left")));
}
