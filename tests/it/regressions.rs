//! Scenes that once went wrong.

use crate::sketch::{Sketch, pressure_apart, shear_apart};
use slipzone::api::reference::power::Power;
use slipzone::engine::{BUDGET, Solution, Solver, Status, solve, solve_within};

/// The shear reported was that of the narrowest stick zone looked for, 16 times `eta p` here, and the bound
/// on `a` was claimed to be good to 1e-13.
#[test]
fn a_stick_zone_too_narrow_to_be_found_is_a_bound_amid_full_sliding() {
    let eta = 1e-3; // a/b = 4 exp(-pi beta/(2 eta)) = 1e-194
    for solver in ["", "[solver]\nquadrature = { type = \"gauss-chebyshev\", n = 40 }"] {
        let scene = Sketch::half_plane(0.3).rubbing(eta).with(solver).with("[output]\nx = [-0.6, 0.3, 0.9]");
        let solution = scene.solve();
        assert_eq!(solution.status, Status::NotConverged, "{:?}", solution.reason);
        let shear = solution.profile.shear.unwrap();
        for ((q, p), side) in shear.iter().zip(&solution.profile.pressure).zip([-1.0, 1.0, 1.0]) {
            let ratio = q.unwrap() / (side * eta * p.unwrap());
            assert!((ratio - 1.0).abs() < 1e-14, "|q| = {ratio} eta p: a product and a quotient");
        }
        let error = &solution.error;
        assert!(error.each["stick.ratio"] >= 1.0 && error.each["stick.half_width"] >= 1.0, "{:?}", error.each);
        assert!(error.estimate.unwrap() >= 1.0);
    }
}

/// Four nodes cannot tell where the slip zone begins; the bound was passed off as a number.
#[test]
fn a_bound_from_a_pinned_resolution_has_the_error_of_a_bound() {
    let pinned = "[solver]\nquadrature = { type = \"gauss-chebyshev\", n = 4 }";
    let solution = Sketch::flat(5.0, 0.125, 0.3).rubbing(0.3).with(pinned).solve();
    assert_eq!(solution.status, Status::NotConverged);
    let stick = solution.stick.unwrap();
    let (ratio, one_minus_ratio) = (stick.ratio.unwrap(), stick.one_minus_ratio.unwrap());
    assert_eq!(solution.error.each["stick.one_minus_ratio"].to_bits(), 1.0_f64.to_bits());
    // The true a is somewhere between the bound and b.
    assert_eq!(solution.error.each["stick.ratio"].to_bits(), (one_minus_ratio / ratio).to_bits());
}

/// The twin of a cut-off far too small was too small itself, and the error underestimated by 5 to 280.
#[test]
fn a_pinned_cutoff_far_too_small_is_judged_honestly() {
    for (h, cutoff) in [(2.0, 0.13), (10.0, 0.22), (70.0, 0.3), (400.0, 0.12), (2.0, 1.0), (10.0, 5.0)] {
        for ratio in [1.0, 0.2, 5.0] {
            let scene = Sketch::flat(h, ratio, -0.1);
            let pinned = format!("[solver]\nkernel = {{ type = \"truncated\", cutoff = {cutoff:?} }}");
            let (coarse, fine) =
                (scene.clone().with(&pinned).solve(), scene.with("[solver]\ntolerance = 1e-6").solve());
            let numbers = [
                ("edge.ratio", coarse.edge.ratio, fine.edge.ratio),
                ("pressure.centre", coarse.pressure.centre, fine.pressure.centre),
                ("load.indentation", coarse.load.indentation, fine.load.indentation),
            ];
            for (name, coarse_value, fine_value) in numbers {
                let (found, exact) = (coarse_value.unwrap(), fine_value.unwrap());
                let error = ((found - exact) / found).abs();
                let allowed = coarse.error.each[name] + 2.0 * fine.error.each[name];
                assert!(error <= allowed, "h = {h}, S = {cutoff}, mu1/mu3 = {ratio}: {name} {error:e} > {allowed:e}");
            }
        }
    }
}

/// The search for the width stepped over it to where 16 nodes bear no load, and gave up.
#[test]
fn a_wide_contact_is_found_from_its_indentation() {
    let sketch = Sketch::flat(1.0, 1.0, 0.3).cylinder();
    let by_width = sketch.clone().loaded("half_width = 8.0").solve();
    let depth = by_width.load.indentation.unwrap();
    let by_depth = sketch.loaded(&format!("indentation = {depth:?}")).solve();
    assert_eq!((by_width.status, by_depth.status), (Status::Converged, Status::Converged), "{:?}", by_depth.reason);
    let found = by_depth.load.half_width.unwrap();
    let allowed = by_depth.error.each["load.half_width"] + by_width.error.each["load.indentation"];
    assert!((found / 8.0 - 1.0).abs() < 3.0 * allowed + 1e-12, "{found}: both claim {allowed:.1e}, and rounding");
}

/// At 6 nodes the force over the width of a contact on a thin layer jumps; the search took the jump for a root, and
/// its slope of 5e5 let every finer resolution agree: `converged` with a half-width 13 % off.
#[test]
fn a_jump_of_a_coarse_resolution_is_no_contact_size() {
    let sketch = Sketch::flat(0.07, 0.1, 0.0).cylinder();
    let force = sketch.solve().load.force.unwrap();
    for (tolerance, digits) in [(1e-3, 3e-3), (1e-4, 3e-4), (1e-6, 3e-6)] {
        let by_force = sketch.clone().loaded(&format!("force = {force:?}"));
        let solution = by_force.with(&format!("[solver]\ntolerance = {tolerance:?}")).solve();
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let half_width = solution.load.half_width.unwrap();
        assert!((half_width - 1.0).abs() <= digits, "half-width {half_width} at tolerance {tolerance}");
    }
}

/// At 6 and 8 nodes a contact on a thin incompressible layer bears no load, which ended the solve.
#[test]
fn resolutions_too_coarse_for_a_thin_layer_are_passed_over() {
    let sketch = Sketch::flat(1.0, 1e-3, 0.5).cylinder().with("[solver]\ntolerance = 1e-6");
    let force = sketch.solve().load.force.unwrap();
    let solution = sketch.loaded(&format!("force = {force:?}")).solve();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    let half_width = solution.load.half_width.unwrap();
    assert!((half_width - 1.0).abs() <= 3e-6, "half-width {half_width}");
}

/// The difference between two resolutions was small by chance; the ratio was off by 4 tolerances.
#[test]
fn a_stick_ratio_is_not_believed_by_one_lucky_difference() {
    use slipzone::api::reference::partial_slip;
    let eta = 0.068_878_268_545_401_76;
    let stick = Sketch::half_plane(0.3).rubbing(eta).solve().stick.unwrap();
    let exact = partial_slip::stick(eta, 2.0 / 7.0).ratio;
    let error = (stick.ratio.unwrap() / exact - 1.0).abs();
    assert!(error <= 3e-8, "error {error:e} at the default tolerance of 1e-8");
}

/// Two large differences had a small ratio by chance, before the nodes told the layer: the edge was off by four
/// tolerances.
#[test]
fn large_differences_are_not_believed_to_shrink_fast() {
    let sketch = Sketch::flat(0.050_255_705_150_585_39, 0.360_159_049_102_546_54, 0.362_840_191_953_070_16);
    let edge = |tolerance: &str| sketch.clone().with(&format!("[solver]\ntolerance = {tolerance}")).solve().edge.ratio;
    let error = (edge("5e-4").unwrap() / edge("1e-8").unwrap() - 1.0).abs();
    assert!(error <= 5e-4, "error {error:e} at a tolerance of 5e-4");
}

/// The shear within a stick zone that ends 3e-12 short of the edge is a difference of numbers as large as that at its end:
/// its noise had the zone refined to 513 unknowns.
#[test]
fn noise_of_the_shear_beside_a_crowded_edge_does_not_cost_resolutions() {
    let sketch = Sketch::flat(137.952_570_553_333_23, 0.387, 0.411_208_707_690_638_9).rubbing(1.351_623_164_871_539);
    let solution = sketch.solve();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    assert!(solution.plan.unknowns < 100, "{} unknowns", solution.plan.unknowns);
}

/// A root predicted just inside the widest stick zone and lying just outside it was none of the known cases.
#[test]
fn just_beyond_the_widest_stick_zone_everything_sticks() {
    let ratio = 0.805_497_261_671_614_2;
    let solution = Sketch::flat(0.411_900_538_398_086_55, ratio, 0.427_123_904_932_582_34).rubbing(0.8).solve();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    let stick = solution.stick.unwrap();
    assert_eq!((stick.ratio, stick.one_minus_ratio, stick.slip), (Some(1.0), Some(0.0), None));
}

/// Stick zones on a half-plane that were off by 16, 10 and 7 tolerances: two small differences in a row while the
/// shear still moved by 3e-3, one stick grid for two resolutions, and a ratio that shrinks more slowly than the shear.
#[test]
fn stick_zones_are_as_good_as_their_resolutions() {
    use slipzone::api::reference::partial_slip;
    let scenes = [
        (0.241_014_520_625_625_98, 0.325_874_022_992_474_2, 2.69e-8),
        (0.242_987_390_350_219_3, 0.870_685_151_473_373_3, 6.41e-6),
        (0.025_245_197_837_413_5, 0.101_033_283_528_372_6, 1.22e-12),
    ];
    for (nu, eta, tolerance) in scenes {
        let beta = (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu);
        let solution =
            Sketch::half_plane(nu).rubbing(eta).with(&format!("[solver]\ntolerance = {tolerance:e}")).solve();
        let (stick, exact) = (solution.stick.unwrap(), partial_slip::stick(eta, beta));
        let error = |found: Option<f64>, exact: f64| (found.unwrap() / exact - 1.0).abs() / tolerance;
        let worst = error(stick.ratio, exact.ratio).max(error(stick.one_minus_ratio, exact.one_minus_ratio));
        assert!(worst <= 3.0, "{worst} tolerances off at nu = {nu}, eta = {eta}, {tolerance:e}");
    }
}

/// A kink close to the contact's edge was a singularity beside an integral: the force lost digits, its slope more, and the
/// pressure in the middle was off by 1.7e-7 with an error of 3e-12 claimed, by 5e-4 beside the kink.
#[test]
fn the_pressure_beside_a_kink_is_as_good_as_elsewhere() {
    use slipzone::api::reference::{cylinder::Cylinder, rounded_flat::RoundedFlat};
    let (nu, radius, kink) = (0.3, 5.0, 0.5);
    let (half_width, compliance) = (1.0, 1.0 - nu);
    let round = Cylinder { radius, half_width, compliance };
    let flank = RoundedFlat { flat: kink, radius, half_width, compliance };
    let at = [0.0, 0.3, 0.499, 0.499_999_95, 0.500_000_05, 0.501, 0.9];
    for (tolerance, digits) in [(1e-6, 1e-6), (1e-10, 1e-9)] {
        let text = format!(
            "format = 1\nlayer = {{ base = {{ type = \"infinite\" }}, poisson = {nu}, \
             grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"rounded-wedge\", slope = 0.1, radius = {radius:?} }}\n\
             load = {{ half_width = 1.0 }}\nsolver = {{ tolerance = {tolerance:?} }}\noutput = {{ x = {at:?} }}"
        );
        let solution = slipzone::engine::solve(&slipzone::scene::parse("kink", &text).unwrap());
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let peak = round.pressure(0.0) - flank.pressure(0.0);
        assert!((solution.pressure.centre.unwrap() / peak - 1.0).abs() < tolerance);
        for (x, p) in at.iter().zip(&solution.profile.pressure) {
            let error = (p.unwrap() - (round.pressure(*x) - flank.pressure(*x))) / peak;
            assert!(error.abs() < digits, "{error:e} at x = {x}, tolerance {tolerance}");
        }
    }
}

/// Half-widths tell how far beyond a corner they are by few digits, while the force goes with a root of that: the pressure in the middle was off by
/// 1e-8 with a corner 1e-4 short of the edge and by 1e-2 with one 1e-13 short of it, 1e-11 claimed; the tighter the tolerance the worse.
#[test]
fn a_corner_just_inside_the_edge_of_the_contact_is_felt_as_it_is() {
    let (compliance, slope, curvature) = (0.7, 0.02, 0.1);
    let per_slope = 2.0 * slope / (std::f64::consts::PI * compliance);
    for (tolerance, digits) in [(1e-6_f64, 1e-9_f64), (1e-9, 1e-11), (1e-11, 3e-12)] {
        for inside in [1e-3_f64, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13] {
            let corner = 1.0 - inside;
            let shoulder = (1.0 - corner) * (1.0 + corner);
            let near = 1.0 - (20.0 * inside).max(1e-7);
            let at = [0.0, 0.3, 0.7, near];
            let text = format!(
                "format = 1\nlayer = {{ base = {{ type = \"infinite\" }}, poisson = 0.3, \
                 grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
                 punch = {{ type = \"formula\", height = \"0.05*x^2 + {slope:?}*max(0, abs(x) - {corner:?})\" }}\n\
                 load = {{ half_width = 1.0 }}\nsolver = {{ tolerance = {tolerance:?} }}\noutput = {{ x = {at:?} }}"
            );
            let solution = slipzone::engine::solve(&slipzone::scene::parse("corner", &text).unwrap());
            let what = format!("a corner {inside:e} inside at a tolerance of {tolerance:e}");
            assert_eq!(solution.status, Status::Converged, "{what}: {:?}", solution.reason);
            let force =
                std::f64::consts::PI * curvature / (2.0 * compliance) + 2.0 * slope / compliance * shoulder.sqrt();
            let off = solution.load.force.unwrap() / force - 1.0;
            assert!(off.abs() < 0.1 * digits.max(1e-10), "{what}: the force is off by {off:e}");
            let centre = curvature / compliance + per_slope * shoulder.sqrt().atanh();
            let off = solution.pressure.centre.unwrap() / centre - 1.0;
            assert!(off.abs() < digits, "{what}: the pressure in the middle is off by {off:e}");
            for (x, p) in at.iter().zip(&solution.profile.pressure) {
                let beside = per_slope * (shoulder / ((corner - x) * (corner + x))).sqrt().asinh();
                let exact = curvature / compliance * ((1.0 - x) * (1.0 + x)).sqrt() + beside;
                let off = (p.unwrap() - exact) / centre;
                assert!(off.abs() < digits, "{what}: {off:e} at x = {x}");
            }
        }
    }
}

/// So does the slope of a rounded edge: at a millionth of the face the pressure was off by 3.5e-9.
#[test]
fn a_contact_hardly_wider_than_its_face_is_as_good_as_others() {
    use slipzone::api::reference::rounded_flat::RoundedFlat;
    for wider in [1e-2_f64, 1e-4, 1e-6] {
        let half_width = 0.5 * (1.0 + wider);
        let text = format!(
            "format = 1\nlayer = {{ base = {{ type = \"infinite\" }}, poisson = 0.3, \
             grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"rounded-flat\", half_width = 0.5, radius = 5.0 }}\n\
             load = {{ half_width = {half_width:?} }}\nsolver = {{ tolerance = 1e-11 }}"
        );
        let solution = slipzone::engine::solve(&slipzone::scene::parse("face", &text).unwrap());
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        // p(0) = int dP/(pi b'), dP/db' = 2 b' psi/(A0 R), and psi = (2 e)^(1/2) (1 - 5 e/12 + 43 e^2/160) with b' = c (1 + e):
        // differences in closed forms lose what is looked for.
        let beyond = half_width / 0.5 - 1.0;
        let of = |a: f64, b: f64, c: f64| a + beyond * (b + beyond * c);
        let scale = (2.0 * beyond).sqrt() * beyond * 2.0 * 0.5 / (0.7 * 5.0);
        let centre = scale / std::f64::consts::PI * of(2.0 / 3.0, -1.0 / 6.0, 43.0 / 560.0);
        let off = solution.pressure.centre.unwrap() / centre - 1.0;
        // The next term.
        let allowed = 1e-12 + beyond.powi(3);
        assert!(off.abs() < allowed, "{wider:e} wider: the pressure is off by {off:e}");
        let closed = RoundedFlat { flat: 0.5, radius: 5.0, half_width, compliance: 0.7 };
        let off = solution.load.force.unwrap() / closed.force() - 1.0;
        assert!(off.abs() < 1e-12 + 1e-15 / beyond, "{wider:e} wider: the force is off by {off:e}");
    }
}

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
        (&exponential, flat, moments, "homogeneous surface"),
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

/// Two branches of a formula meet between two numbers: the face was not seen, and the contact had no force.
#[test]
fn a_face_that_ends_between_two_numbers_is_one() {
    let contact = |height: &str| {
        let text = format!(
            "format = 1\nlayer = {{ thickness = 5.0, poisson = 0.3, \
             grading = {{ type = \"exponential\", surface = 1.0, base = 8.0 }} }}\n\
             punch = {{ type = \"formula\", height = \"{height}\" }}\nload = {{ half_width = 6.0 }}"
        );
        slipzone::engine::solve(&slipzone::scene::parse("face", &text).unwrap())
    };
    let [below, level] = ["max(0.05*x^2, 1)", "max(0.05*x^2 - 1, 0)"].map(contact);
    for solution in [&below, &level] {
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    }
    for [found, exact] in [[&below, &level].map(|s| s.load.force), [&below, &level].map(|s| s.pressure.centre)] {
        assert!((found.unwrap() / exact.unwrap() - 1.0).abs() < 1e-8, "{found:?}, {exact:?}");
    }
}

/// A stick zone that two resolutions could only bound ended the solve before three could tell how good the pressure was: its error was 1, and that
/// was the reason told.
#[test]
fn a_bound_of_the_stick_zone_is_told_of_a_pressure_that_is_known() {
    let text = "format = 1\nlayer = { thickness = 5.0, poisson = 0.3, \
                grading = { type = \"exponential\", surface = 1.0, base = 8.0 } }\n\
                punch = { type = \"cylinder\", radius = 10.0 }\nload = { half_width = 1.0 }\n\
                friction = { type = \"goodman\", coefficient = 3.0 }\n\
                solver = { tolerance = 1e-10, quadrature = { type = \"gauss-chebyshev\" } }";
    let solution = slipzone::engine::solve(&slipzone::scene::parse("bound", text).unwrap());
    assert_eq!(solution.status, Status::NotConverged);
    let reason = solution.reason.unwrap();
    assert!(reason.contains("sticks to within"), "{reason}");
    let error = solution.error.each["load.force"];
    assert!(error < 1e-4, "{error:e} with three resolutions");
    // A tenth of the radius.
    let exact = 0.1 * Sketch::flat(5.0, 0.125, 0.3).cylinder().solve().load.force.unwrap();
    assert!((solution.load.force.unwrap() / exact - 1.0).abs() < error);
}

/// The tip of a wedge had a finite pressure, another one at each resolution.
#[test]
fn the_pressure_under_a_sharp_tip_is_unbounded() {
    for friction in ["", "friction = { type = \"goodman\", coefficient = 0.3 }\n"] {
        let text = format!(
            "format = 1\n{friction}layer = {{ thickness = 5.0, poisson = 0.3, \
             grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"wedge\", slope = 0.1 }}\nload = {{ half_width = 1.0 }}\noutput = {{ x = [0.0, 1e-9] }}"
        );
        let solution = slipzone::engine::solve(&slipzone::scene::parse("tip", &text).unwrap());
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        assert_eq!(solution.profile.pressure[0], None);
        assert!(solution.profile.pressure[1].is_some());
        assert!(solution.profile.shear.is_none_or(|shear| shear[0] == Some(0.0)));
    }
}

/// Where in its growth a contact first defies the search moves with the resolution: all 14 were solved, for half a minute.
#[test]
fn a_history_that_cannot_be_told_is_not_refined_for_ever() {
    let solution = Sketch::flat(4.4, 1.0, 0.5).cylinder().rubbing(0.1).with("[solver]\ntolerance = 1e-4").solve();
    assert_eq!(solution.status, Status::AssumptionViolated, "{:?}", solution.reason);
    assert!(solution.plan.unknowns < 60, "{} unknowns", solution.plan.unknowns);
}

/// Beside its face a rounded punch had no node of the guess, and the load was refused.
#[test]
fn a_load_that_hardly_exceeds_the_face_is_borne() {
    let scene = |load: &str| {
        let text = format!(
            "format = 1\nlayer = {{ thickness = 4.6, poisson = 0.3, \
             grading = {{ type = \"exponential\", surface = 1.0, base = 0.233 }} }}\n\
             punch = {{ type = \"rounded-flat\", half_width = 0.999, radius = 1.3 }}\n\
             friction = {{ type = \"goodman\", coefficient = 0.3 }}\nload = {{ {load} }}"
        );
        slipzone::engine::solve(&slipzone::scene::parse("face", &text).unwrap())
    };
    for wide in [1.0, 0.999_001] {
        let by_width = scene(&format!("half_width = {wide:?}"));
        assert_eq!(by_width.status, Status::Converged, "{:?}", by_width.reason);
        let (force, depth) = (by_width.load.force.unwrap(), by_width.load.indentation.unwrap());
        for load in [format!("force = {force:?}"), format!("indentation = {depth:?}")] {
            let found = scene(&load);
            assert_eq!(found.status, Status::Converged, "{load}: {:?}", found.reason);
            assert!((found.load.half_width.unwrap() / wide - 1.0).abs() < 1e-8, "{load}");
        }
    }
}

/// The peak under shapes of high powers is a narrow one near the edge: looked for in equal steps of x, it was 38 tolerances
/// too low and claimed to be good. Where the power is no even number, the pressure is stacked by integrals that had too few
/// nodes for so steep a load: it was off by up to 300 tolerances. Against the closed form at 2,000 angles, with a parabola
/// through the highest three: its error is of the fourth order in steps of `1/50` of the peak's width.
#[test]
fn the_peak_under_a_shape_of_a_high_power() {
    use slipzone::api::reference::power::Power;
    let (nu, angles) = (0.3, 2_000);
    let compliance = (4.0 - 4.0 * nu) / 4.0;
    for exponent in [4.0, 9.1, 16.0, 30.7, 36.0, 61.5, 62.0] {
        let exact = Power { coefficient: 0.5, exponent, half_width: 1.0, compliance };
        let at = |i: i32| exact.pressure((std::f64::consts::FRAC_PI_2 * f64::from(i) / f64::from(angles)).sin());
        let values: Vec<f64> = (0..angles).map(at).collect();
        let around = values.windows(3).max_by(|one, other| one[1].total_cmp(&other[1])).unwrap();
        let (slope, bend) = (around[2] - around[0], 2.0 * around[1] - around[0] - around[2]);
        let highest = around[1] + slope * slope / (8.0 * bend);
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
            let text = format!(
                "format = 1\nlayer = {{ poisson = {nu}, base = {{ type = \"infinite\" }}, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
                 punch = {{ type = \"power\", coefficient = 0.5, exponent = {exponent} }}\n\
                 load = {{ half_width = 1.0 }}\nsolver = {{ tolerance = {tolerance:e} }}\n"
            );
            let solution = slipzone::engine::solve(&slipzone::scene::parse("peak", &text).unwrap());
            assert_eq!(solution.status, Status::Converged);
            let peak = solution.pressure.peak.unwrap();
            assert!((peak / highest - 1.0).abs() < tolerance, "x^{exponent} at {tolerance:e}: {peak}, {highest}");
        }
    }
}

/// Converged with 7.5 of its estimates, two tolerances: on a layer of a thirtieth of the half-width coarse resolutions agreed
/// by chance.
#[test]
fn resolutions_that_do_not_see_a_thin_layer_are_not_believed_to_agree() {
    let solved = |tolerance: &str| {
        let text = format!(
            "format = 1\npunch = {{ type = \"power\", coefficient = 0.5, exponent = 7.209107275215471 }}\nload = {{ half_width = 1.0 }}\n\
             output = {{ points = 2 }}\n[solver]\ntolerance = {tolerance}\n[layer]\npoisson = 0.35193137582614115\nplane = \"stress\"\n\
             thickness = 0.03269658385300438\ngrading = {{ type = \"table\", points = [[0.0, 1.0], \
             [0.0065393167706008755, 0.9999664611555973], [0.013078633541201751, 0.9995272226009726], \
             [0.019617950311802624, 0.9996436912546441], [0.026157267082403502, 0.999497032899562], \
             [0.03269658385300438, 0.9995035572275126]] }}\n"
        );
        solve(&slipzone::scene::parse("thin.toml", &text).expect("a scene"))
    };
    let (found, exact) = (solved("1.5149228518118327e-6"), solved("5e-8"));
    within_three_estimates(&found, &exact, &["load.force", "load.indentation", "pressure.centre"]);
}

/// Refused as no number: of a height that is one, near the tip, the mean slope was none.
#[test]
fn a_shape_too_faint_at_its_tip_for_a_number_has_a_force() {
    let scene = "format = 1\nlayer = { thickness = 0.1266, poisson = 0.2426, plane = \"stress\", \
         grading = { type = \"exponential\", surface = 1.0, base = 4.656 } }\n\
         punch = { type = \"power\", coefficient = 0.5, exponent = 54.85368879868397 }\nload = { half_width = 1.0 }\n\
         [solver]\ntolerance = 1.1315717425898631e-3\nmodel = \"full\"\n";
    let found = solve(&slipzone::scene::parse("faint.toml", scene).expect("a scene"));
    assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
    assert!((found.load.force.unwrap() / 68.137 - 1.0).abs() < 2e-3, "{:?}", found.load.force);
}

/// Found by random scenes: what a growing contact on a thin layer could take had no bound, minutes at a time. It ends with what
/// it has and says so, or is refused, within the budget.
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

/// Found by random scenes: four loads on the way to another, without friction, took all flat punches that the contact might
/// be made of, a hundred times the work of the last load.
#[test]
fn a_few_loads_on_the_way_take_little() {
    let scene = Sketch::flat(0.05, 4.0, 0.3).cylinder().with("[solver]\ntolerance = 1e-6");
    let alone = scene.clone().loaded("half_width = 1.0").solve().plan.work;
    let path = scene.loaded("until = { half_width = 1.0, points = 5 }").solve();
    assert_eq!(path.path.unwrap().status, Status::Converged);
    assert!(path.plan.work < 8 * alone, "{} for five loads, {alone} for one", path.plan.work);
}

/// Found by random scenes: a peak and a force that were within the tolerance, but beyond three of their own estimates. The nodes
/// of a stack were too few for a steep shape; the grid of a pressure, and the error asked of its kernel, for a depth that is
/// counted from a near datum. (A depth from 1e-4 b below was off by six tolerances.)
#[test]
fn neither_steep_shapes_nor_near_datums_are_surer_than_they_are() {
    let solved = |text: &str, solver: &str| {
        let text = format!("format = 1\n{text}\n[solver]\n{solver}");
        solve(&slipzone::scene::parse("sure.toml", &text).unwrap())
    };
    let finely = "tolerance = 1e-5\nquadrature = { type = \"graded-panels\" }";
    let narrow_peak = "layer = { thickness = 7535.26424689573, base = { type = \"frictionless\" }, \
         poisson = 0.2649940867268281, grading = { type = \"homogeneous\", modulus = 230660.22273865133 } }\n\
         punch = { type = \"power\", coefficient = 1.503708363594948e-42, exponent = 13.139158014001122 }\n\
         load = { force = 1995.5400460709466 }";
    let near_datum = "layer = { poisson = 0.20343671486093637, base = { type = \"infinite\" }, datum = 0.2621707927690318, \
         grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
         punch = { type = \"flat\", half_width = 5.085275327328602 }\nload = { indentation = 0.001066048662366472 }";
    let nearer_datum = "layer = { thickness = 0.7, poisson = 0.2, base = { type = \"half-plane\", shear = 3.0, poisson = 0.3 }, \
         datum = 1e-4, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
         punch = { type = \"flat\", half_width = 1.0 }\nload = { force = 1.0 }";
    for (text, tolerance, paths) in [
        (narrow_peak, "0.0034233236515418754", &["pressure.peak"][..]),
        (nearer_datum, "1e-3", &["load.indentation"]),
        (near_datum, "9.670022590864149e-5", &["load.force", "pressure.centre"]),
    ] {
        let found = solved(text, &format!("tolerance = {tolerance}"));
        within_three_estimates(&found, &solved(text, finely), paths);
    }
}

/// A stacked shape that turns within a short stretch: the force as a series of 96 coefficients missed 5e-5 at every
/// resolution, which no difference between two of them showed. Without friction and at one half-width, forces and
/// depths under a wedge and under the smooth rest, which is not stacked, add up to those under both.
#[test]
fn what_the_series_of_a_force_misses_is_told() {
    let solved = |height: &str, tolerance: &str| {
        let text = format!(
            "format = 1\n[layer]\nthickness = 5.0\npoisson = 0.3\n\
             grading = {{ type = \"exponential\", surface = 1.0, base = 8.0 }}\n[punch]\ntype = \"formula\"\n\
             height = \"{height}\"\n[load]\nhalf_width = 1.7\n[output]\nquantities = [\"load\"]\n[solver]\ntolerance = {tolerance}"
        );
        solve(&slipzone::scene::parse("turn.toml", &text).unwrap())
    };
    let wedge = "0.05*abs(x)";
    let smooth = "0.1*x^2 + 0.05*(ln(cosh(20*(x-1))) + ln(cosh(20*(x+1))) - 2*ln(cosh(20)))/20";
    let parts = [solved(wedge, "1e-7"), solved(smooth, "1e-6")];
    for tolerance in ["1e-3", "1e-5", "1e-7"] {
        let found = solved(&format!("{wedge} + {smooth}"), tolerance);
        for path in ["load.force", "load.indentation"] {
            let exact: f64 = parts.iter().map(|part| part.number(path).unwrap()).sum();
            let error = (found.number(path).unwrap() / exact - 1.0).abs();
            let claimed = 3.0 * found.error.each[path] + 1e-6;
            assert!(error <= claimed, "{path} at {tolerance} is off by {error:e}, three estimates are {claimed:e}");
        }
        // Refinement that cannot help ends.
        assert!(found.plan.work < 200_000_000, "{:?}", found.plan);
    }
}

/// Found by random scenes: a contact 1e20 times as wide as a stack (whose thickness no check compared) asked for more nodes
/// than can be counted, and a datum 1e-24 deep for more pieces of `graded-panels` than there is memory: both panicked.
#[test]
fn lengths_beyond_compare_do_not_panic() {
    let scenes = [
        "format = 1\nlayer = { poisson = 0.3, grading = { type = \"stack\", layers = [{ thickness = 50.0, \
         grading = { type = \"exponential\", surface = 5e-3, base = 5e-4 } }] } }\n\
         punch = { type = \"flat\", half_width = 2e22 }\nfriction = { type = \"goodman\", coefficient = 0.5 }\nload = { force = 0.01 }",
        "format = 1\nlayer = { thickness = 5.0, poisson = 0.3, datum = 1e-24, grading = { type = \"homogeneous\", modulus = 1.0 }, \
         base = { type = \"half-plane\", shear = 0.7, poisson = 0.3 } }\npunch = { type = \"cylinder\", radius = 1.0 }\n\
         load = { half_width = 1.0 }\nsolver = { tolerance = 1e-3, quadrature = { type = \"graded-panels\" } }",
    ];
    for text in scenes {
        let scene = slipzone::scene::parse("beyond", text).unwrap();
        let solution = slipzone::engine::solve_within(&scene, 10_000_000);
        assert!(solution.status == Status::Converged || solution.reason.is_some());
    }
}

/// Under 2,000 thicknesses a pinned resolution sums its kernels over a grid a hundred times as fine: that counted nothing, and ten
/// seconds of budget took a minute.
#[test]
fn what_a_finer_grid_costs_counts() {
    let text = "format = 1\n[layer]\nthickness = 5.0\npoisson = 0.3\n\
                grading = { type = \"exponential\", surface = 1.0, base = 8.0 }\n\
                [punch]\ntype = \"flat\"\nhalf_width = 1e4\n[load]\nforce = 1.0\n\
                [solver]\nquadrature = { type = \"de-sinc\", n = 100 }\n";
    // Enough for its readings, 8 million at first, and for elimination, but for nothing beside them.
    let budget = 120_000_000;
    let solution = slipzone::engine::solve_within(&slipzone::scene::parse("wide", text).unwrap(), budget);
    let reason = solution.reason.unwrap_or_default();
    assert!(solution.status == Status::Refused && reason.contains("budget, 1e8"), "{:?}: {reason}", solution.status);
}

/// Found by random scenes: each load of a curve tried again what the budget had refused, and a refused system was counted as
/// done (98,280 loads, three minutes, 3,400 times the budget); a stick zone refused between two grids was told on the wrong one,
/// which panicked.
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

/// Found by random scenes: loads told between the flat punches solved were told however many there were (100,000, 200 times the
/// budget).
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

/// Nearly a wedge: most of the pressure in the middle is that of the last bit of the tip, which a grid in the half-width cut off.
/// `|x|^1.05` was 0.9 % off and `|x|^1.0001` 99 %, with 1e-11 claimed.
#[test]
fn the_pressure_under_a_tip_hardly_blunter_than_a_wedge() {
    let scene = |layer: &str, exponent: f64, tolerance: f64| {
        let text = format!(
            "format = 1\nlayer = {{ poisson = 0.3, {layer} }}\nload = {{ half_width = 1.0 }}\n\
             punch = {{ type = \"power\", coefficient = 0.01, exponent = {exponent:?} }}\nsolver = {{ tolerance = {tolerance:?} }}"
        );
        let solution = solve(&slipzone::scene::parse("tip", &text).unwrap());
        assert_eq!(solution.status, Status::Converged, "{exponent}: {:?}", solution.reason);
        solution
    };
    let half_plane = "base = { type = \"infinite\" }, grading = { type = \"homogeneous\", modulus = 1.0 }";
    for exponent in [1.000_000_1, 1.0001, 1.01, 1.05, 1.2, 1.45, 1.55] {
        let exact = Power { coefficient: 0.01, exponent, half_width: 1.0, compliance: 0.7 }.pressure(0.0);
        let error = scene(half_plane, exponent, 1e-8).pressure.centre.unwrap() / exact - 1.0;
        assert!(error.abs() < 1e-9, "{exponent}: {error:e}");
    }
    let layer = "thickness = 2.0, grading = { type = \"exponential\", surface = 1.0, base = 8.0 }";
    for exponent in [1.01, 1.1] {
        let exact = scene(layer, exponent, 1e-9);
        for tolerance in [1e-4, 1e-6] {
            within_three_estimates(&scene(layer, exponent, tolerance), &exact, &["pressure.centre"]);
        }
    }
}

/// A load on the way was told less well than the tolerance by the flat punches of the last one, and that was left so, without a
/// reason.
#[test]
fn a_load_that_the_flat_punches_of_the_last_one_do_not_tell_is_solved_by_itself() {
    let text = "format = 1\nlayer = { thickness = 2.0, poisson = 0.3, grading = { type = \"exponential\", surface = 1.0, \
                base = 0.2 } }\npunch = { type = \"cylinder\", radius = 20.0 }\n\
                friction = { type = \"goodman\", coefficient = 0.1 }\nload = { path = { half_width = [0.45, 1.5] } }";
    let path = solve(&slipzone::scene::parse("path", text).unwrap()).path.unwrap();
    assert!(path.status == Status::Converged && path.note.is_none(), "{:?}: {:?}", path.status, path.note);
    assert!(path.error.unwrap() <= 1e-8, "{:?}", path.error);
}

/// Flat punches between those solved were told by polynomials alone once there were some forty of them, which converges slowly:
/// the indentation under `|x|^3` on a thin layer was off by 4.8 of its estimates, within the tolerance.
#[test]
fn stacked_contacts_are_not_surer_than_they_are() {
    let text = |solver: &str| {
        format!(
            "format = 1\n[layer]\nthickness = 0.1\npoisson = 0.3\n\
             grading = {{ type = \"exponential\", surface = 1.0, base = 8.0 }}\n\
             [punch]\ntype = \"power\"\ncoefficient = 0.1\nexponent = 3.0\n[load]\nforce = 0.1\n\
             [output]\nquantities = [\"load\"]\n[solver]\n{solver}"
        )
    };
    slipzone::link_plugins();
    let solved = |solver: &str| solve(&slipzone::scene::parse("cubic.toml", &text(solver)).unwrap());
    let (found, exact) = (solved(""), solved("tolerance = 1e-10\nquadrature = { type = \"graded-panels\" }"));
    within_three_estimates(&found, &exact, &["load.indentation", "load.half_width"]);
}

/// Stick zones whose coarse resolutions agree by chance were off by 3 to 9 of their estimates, within the tolerance.
#[test]
fn stick_zones_are_not_surer_than_a_few_resolutions_can_tell() {
    for (h, eta) in [(3.0, 0.001), (3.0, 0.003), (1000.0, 0.1)] {
        let sketch = Sketch::flat(h, 0.125, 0.3).rubbing(eta);
        let found = sketch.solve();
        let exact = sketch.with("[solver]\ntolerance = 1e-10\nquadrature = { type = \"graded-panels\" }").solve();
        within_three_estimates(&found, &exact, &["stick.ratio", "stick.one_minus_ratio"]);
    }
}

/// The force over a wedge's flanks was one series from the round tip to the edge, a thousand times as wide: what it
/// left out at the tip put the pressure there off by 2.8e-3 at any tolerance down to 1e-3, with 1e-5 claimed.
#[test]
fn a_tip_is_told_however_narrow_it_is() {
    let layer =
        "[layer]\npoisson = 0.4\nbase = { type = \"infinite\" }\ngrading = { type = \"homogeneous\", modulus = 1.0 }";
    let punch = "[punch]\ntype = \"rounded-wedge\"\nslope = 4e-5\nradius = 5.0";
    let solved = |tolerance: f64| {
        let text =
            format!("format = 1\n[load]\nhalf_width = 0.2\n[solver]\ntolerance = {tolerance:e}\n{layer}\n{punch}");
        solve(&slipzone::scene::parse("tip", &text).unwrap())
    };
    slipzone::link_plugins();
    let exact = solved(1e-9);
    for tolerance in [1e-2, 1e-3, 1e-5] {
        within_three_estimates(&solved(tolerance), &exact, &["pressure.centre", "load.force"]);
    }
}

/// The force beyond a kink was a series that missed the rate at which it begins: at the end of a rounded flat punch's face the
/// pressure was off by 9e-7 of the largest where 1e-7 was asked for, under a rounded wedge by 2e-7 where 1e-8 was.
#[test]
fn the_pressure_at_a_kink_is_as_good_as_elsewhere() {
    let layer = "[layer]\nthickness = 0.7\npoisson = 0.3\n\
                 grading = { type = \"exponential\", surface = 1.0, base = 0.125 }";
    slipzone::link_plugins();
    // The samples are a hundredth of the half-width apart; one is on either kink.
    for punch in [
        "type = \"rounded-flat\"\nhalf_width = 0.2\nradius = 1.0",
        "type = \"rounded-wedge\"\nslope = 0.3\nradius = 1.0",
    ] {
        let pressure = |tolerance: f64| {
            let text = format!(
                "format = 1\n[load]\nhalf_width = 1.0\n[solver]\ntolerance = {tolerance:e}\n{layer}\n[punch]\n{punch}"
            );
            solve(&slipzone::scene::parse("kink", &text).unwrap()).profile.pressure
        };
        let exact = pressure(1e-10);
        let largest = exact.iter().flatten().fold(0.0_f64, |most, p| most.max(*p));
        for tolerance in [1e-6, 1e-7, 1e-8] {
            for (p, truth) in pressure(tolerance).iter().zip(&exact).filter_map(|(p, truth)| Some(((*p)?, (*truth)?))) {
                assert!((p - truth).abs() <= tolerance * largest, "{punch}: {p} at {tolerance:e}, {truth} in truth");
            }
        }
    }
}

/// A contact's tables reached half as far as those of its finer twin, whose cut-off was therefore the same: the charts found a
/// half-width off by 2.6e-8 that claimed 1e-13.
#[test]
fn a_cut_off_is_judged_by_another() {
    let sketch = Sketch::flat(5.0, 0.125, 0.3).cylinder();
    let solved = |solver: &str| sketch.clone().loaded("force = 1.0").with(&format!("[solver]\n{solver}")).solve();
    let exact = solved("tolerance = 1e-10");
    for n in [64, 128] {
        let found =
            solved(&format!("kernel = {{ type = \"truncated\" }}\nquadrature = {{ type = \"de-sinc\", n = {n} }}"));
        let error = (found.number("load.half_width").unwrap() / exact.number("load.half_width").unwrap() - 1.0).abs();
        let claimed = found.error.each["load.half_width"];
        assert!(error <= 3.0 * claimed, "{error:e} beyond {claimed:e}");
        // What it claims is no idle bound either: a cut-off at some hundred waves.
        assert!(claimed < 1e-5, "{claimed:e}");
    }
}

fn within_three_estimates(found: &Solution, exact: &Solution, paths: &[&str]) {
    assert_eq!((found.status, exact.status), (Status::Converged, Status::Converged));
    for path in paths {
        let error = (found.number(path).unwrap() / exact.number(path).unwrap() - 1.0).abs();
        let claimed = 3.0 * (found.error.each[*path] + exact.error.each[*path]);
        assert!(error <= claimed, "{path} is off by {error:e}, three estimates are {claimed:e}");
    }
}

/// A stick zone is known sooner than the shear inside: that was off by 5 to 31 tolerances, and nothing said so.
#[test]
fn the_shear_is_as_good_all_along_as_the_stick_zone() {
    for (h, ratio, eta, tolerance) in [
        (5.13, 1.0 / 23.8, 0.206, 3.3e-8),
        // The grid over the slip zone decides.
        (57.4, 1.0 / 13.1, 0.0945, 3.2e-10),
        (5.0, 0.125, 0.3, 1e-6),
    ] {
        let sketch = Sketch::flat(h, ratio, 0.3).rubbing(eta);
        let solved = |tolerance: f64| sketch.clone().with(&format!("[solver]\ntolerance = {tolerance:e}")).solve();
        let found = solved(tolerance);
        let [apart, claimed] = shear_apart(&found, &solved(1e-2 * tolerance));
        assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
        assert!(
            apart <= 2.0 * claimed && claimed <= tolerance,
            "{apart:e} apart, {claimed:e} claimed of {tolerance:e}"
        );
    }
}

/// Between its nodes a pressure is known later than all its numbers: it was off by up to 14 tolerances, and nothing said so. The shear
/// that it drives was off by 6 to 95 of its estimates.
#[test]
fn tractions_are_known_between_the_nodes() {
    let flat = |h: f64, ratio: f64, nu: f64| Sketch::flat(h, ratio, nu);
    for (sketch, tolerance) in [
        (flat(0.7259, 18.3319, 0.051), 1e-7),
        (flat(0.3556, 0.1959, 0.12), 1e-6),
        (flat(0.9271, 0.4601, 0.387), 1e-5),
        (flat(0.1663, 0.2963, 0.159).cylinder(), 1e-6),
        (flat(0.3353, 6.9146, 0.149).cylinder(), 1e-5),
        (flat(0.6636, 23.2111, 0.449).rubbing(2.3179), 1e-7),
        (flat(0.3475, 1.6133, 0.277).rubbing(0.1282), 1e-5),
        // The shear by itself.
        (flat(24.2395, 0.1378, 0.422).rubbing(0.0651), 1e-8),
        (flat(9.3459, 0.4013, 0.393).rubbing(0.0899), 1e-8),
    ] {
        let solved = |tolerance: f64| sketch.clone().with(&format!("[solver]\ntolerance = {tolerance:e}")).solve();
        let (found, exact) = (solved(tolerance), solved(1e-11));
        assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
        let [apart, claimed] = pressure_apart(&found, &exact);
        assert!(apart <= claimed, "p: {apart:e} apart, {claimed:e} claimed at {tolerance:e}\n{}", sketch.text());
        assert!(claimed <= 4.0 * tolerance, "p: {claimed:e} claimed at {tolerance:e}\n{}", sketch.text());
        if found.profile.shear.is_some() {
            let [apart, claimed] = shear_apart(&found, &exact);
            assert!(
                apart <= 2.0 * claimed,
                "q: {apart:e} apart, {claimed:e} claimed at {tolerance:e}\n{}",
                sketch.text()
            );
        }
    }
}

/// Two resolutions of a shear may agree where both are wrong: the first three were off by 20, 3.5 and 5 estimates.
#[test]
fn a_shear_is_not_believed_for_a_phase_that_suits_it() {
    let grown = Sketch::flat(8.3, 4.02 / 1.82, 0.3).cylinder().rubbing(0.63);
    let flat = Sketch::flat(
        2.691_390_154_230_660_4,
        0.696_023_718_617_888_9 / 2.788_018_264_896_762_4,
        0.127_399_069_977_697_8,
    )
    .rubbing(0.922_472_721_286_488_7);
    // Of two that are solved again on finer grids, one needs the first difference to be that of the resolution before (it was off
    // by 6.7 estimates), the other the bound of the rate (15).
    let led = Sketch::flat(3.369, 0.14, 0.327).rubbing(1.575);
    let hurried = Sketch::flat(1.345, 4.86, 0.41).rubbing(1.415);
    let grown = [(&grown, 1e-6, 4.0), (&grown, 1e-5, 3.0)];
    let flat = [(&flat, 1e-6, 4.0), (&led, 1e-8, 3.0), (&hurried, 1e-7, 3.0)];
    for (sketch, tolerance, most) in grown.into_iter().chain(flat) {
        let solved = |tolerance: f64| sketch.clone().with(&format!("[solver]\ntolerance = {tolerance:e}")).solve();
        let found = solved(tolerance);
        let [apart, claimed] = shear_apart(&found, &solved(1e-3 * tolerance));
        assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
        assert!(apart <= most * claimed, "{apart:e} apart, {claimed:e} claimed at {tolerance:e}");
    }
}

/// Where the stick zone ends just short of the contact's edge its shear was told as the difference of numbers as large as that at
/// its end: known to a few 1e-4 only.
#[test]
fn the_shear_beside_a_crowded_edge_is_as_good_as_any() {
    for sketch in [
        Sketch::half_plane(0.3).rubbing(2.492_628_111_094_76), // 1 - a/b = 1e-11
        Sketch::flat(3.5, 2.0, 0.47).rubbing(0.21),            // 4e-9
        Sketch::flat(5.0, 0.125, 0.3).rubbing(0.8),            // 1e-4
    ] {
        let solution = sketch.solve();
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let exact = sketch.with("[solver]\ntolerance = 1e-11").solve();
        assert!(exact.number("stick.one_minus_ratio").expect("a number") < 2e-4);
        let [apart, claimed] = shear_apart(&solution, &exact);
        assert!(claimed <= 1e-8 && apart <= 2.0 * claimed, "{apart:e} apart, {claimed:e} claimed");
    }
}

/// It took finer grids than the pressure: as fine as that it was off by 1e-3 of its largest value.
#[test]
fn a_crowded_stick_zone_takes_no_more_unknowns_than_the_pressure() {
    let sketch = Sketch::flat(5.0, 0.125, 0.3).rubbing(0.8); // 1 - a/b = 1e-4
    let exact = sketch.clone().with("[solver]\ntolerance = 1e-10").solve();
    let pinned = sketch.with("[solver]\nquadrature = { type = \"de-sinc\", n = 32 }").solve();
    let [apart, claimed] = shear_apart(&pinned, &exact);
    assert!(apart < 1e-6, "{apart:e} apart");
    // Twelve points ever nearer to the end; four of the traces had it 30 times too small.
    assert!(apart < 2.0 * claimed, "{apart:e} apart, {claimed:e} claimed");
}

/// A zone that failed its checks was looked for anew and told as roughly as a search tells it: the slip zone was off by 125
/// tolerances.
#[test]
fn a_zone_looked_for_anew_is_as_good_as_any() {
    let sketch = Sketch::flat(0.141, 1.0 / 15.7, 0.3).rubbing(0.0184);
    let solved = |tolerance: f64| sketch.clone().with(&format!("[solver]\ntolerance = {tolerance:e}")).solve();
    let (found, exact) = (solved(2.8e-10), solved(1e-11));
    assert_eq!(found.status, Status::AssumptionViolated, "{:?}", found.reason);
    let rest = |solution: &Solution| solution.number("stick.one_minus_ratio").expect("a number");
    let error = (rest(&found) / rest(&exact) - 1.0).abs();
    assert!(error <= 2.8e-10, "{error:e}");
}

/// A scene of its `layer`, `punch` and further tables.
fn written(layer: &str, punch: &str, load: &str, rest: &str) -> Solution {
    let text = format!(
        "format = 1\nlayer = {{ {layer} }}\npunch = {{ {punch} }}\nload = {{ {load} }}\n{rest}\n[output]\nx = [0.5]\n"
    );
    solve(&slipzone::scene::parse(punch, &text).unwrap_or_else(|why| panic!("{why}")))
}

/// Beside a kink over a hard layer that is thin the force seemed to grow like a root, because the integrals that give
/// it took no note of how thin: half of the pressure was missing at the kink at 1e-4, and the middle off by 19 of its
/// estimates at 1e-8.
#[test]
fn a_kink_over_a_thin_layer_is_told() {
    let layer = "poisson = 0.3, grading = { type = \"stack\", layers = [\
        { thickness = 0.1, grading = { type = \"homogeneous\", modulus = 3.0 } }, \
        { thickness = 1.4, grading = { type = \"homogeneous\", modulus = 0.3 } }] }";
    let punch = "type = \"rounded-wedge\", slope = 0.1, radius = 5.0";
    for tolerance in [1e-3, 1e-4, 1e-8] {
        let solution = written(layer, punch, "half_width = 1.0", &format!("solver = {{ tolerance = {tolerance:e} }}"));
        // By graded panels, and by this quadrature at 1e-11.
        let (centre, kink) = (0.094_333_457_347_7, 0.067_854_958_4);
        let error = (solution.pressure.centre.unwrap() / centre - 1.0).abs();
        assert!(error < solution.error.each["pressure.centre"], "p(0) is off by {error:e} at {tolerance:e}");
        let error = solution.profile.pressure[0].unwrap() / kink - 1.0;
        assert!(error.abs() < tolerance, "p at the kink is off by {error:e} at {tolerance:e}");
    }
}

/// The coarsest resolution found too narrow a contact; what the next one expected of the stick zones beyond it was that
/// of a polynomial far from its points, and the scene was refused.
#[test]
fn a_contact_wider_than_it_looked_at_first_has_its_stick_zone() {
    let layer = |thickness: f64, law: &str, nu: f64| {
        format!(
            "thickness = {thickness:?}, poisson = {nu:?}, \
             grading = {{ type = \"{law}\", surface = 1.0, base = 24.0 }}"
        )
    };
    let rubbed = |layer: &str, load: &str, tolerance: f64| {
        let rest =
            format!("friction = {{ type = \"goodman\", coefficient = 0.4 }}\nsolver = {{ tolerance = {tolerance:e} }}");
        written(layer, "type = \"cylinder\", radius = 50.0", load, &rest)
    };
    for (layer, force, tolerance) in [
        (layer(0.25, "linear", 0.0), 0.3, 1e-3),
        (layer(0.25, "linear", 0.0), 0.8, 1e-3),
        (layer(0.25, "linear", 0.3), 2.609_664_728_526_815_3, 1e-4),
        (layer(0.1, "exponential", 0.3), 0.7, 1e-3),
    ] {
        let found = rubbed(&layer, &format!("force = {force:?}"), tolerance);
        assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
        let again = rubbed(&layer, &format!("half_width = {:?}", found.load.half_width.unwrap()), tolerance);
        let [one, other] = [&found, &again].map(|solution| solution.stick.as_ref().unwrap().ratio.unwrap());
        assert!((one / other - 1.0).abs() < tolerance, "{one} and {other}");
    }
}

/// A shape that is hollow farther out, one that ends, and a hard layer whose wide contacts pull: the size searched for
/// was that far out.
#[test]
fn a_size_is_looked_for_where_the_shape_rises() {
    let layer = "thickness = 5.0, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 }";
    let bends = "thickness = 10.0, poisson = 0.5, grading = { type = \"homogeneous\", modulus = 5.0 }, \
        base = { type = \"half-plane\", shear = 0.05, poisson = 0.2 }, datum = 110.0";
    let mut scenes = vec![
        (layer, "type = \"polynomial\", coefficients = [0.05, -0.001]"),
        (bends, "type = \"rounded-wedge\", slope = 0.0044, radius = 113.0"),
    ];
    if cfg!(feature = "formula") {
        scenes.push((layer, "type = \"formula\", height = \"R - sqrt(R^2 - x^2)\", parameters = { R = 1.2 }"));
    }
    for (layer, punch) in scenes {
        let rest = "solver = { tolerance = 1e-5 }";
        let known = written(layer, punch, "half_width = 1.0", rest);
        assert_eq!(known.status, Status::Converged, "{punch}: {:?}", known.reason);
        let loads = [("force", known.load.force), ("indentation", known.load.indentation)];
        for (kind, load) in loads {
            let found = written(layer, punch, &format!("{kind} = {:?}", load.unwrap()), rest);
            assert_eq!(found.status, Status::Converged, "{punch} by {kind}: {:?}", found.reason);
            let error = found.load.half_width.unwrap() - 1.0;
            assert!(error.abs() < 3e-5, "{punch} by {kind}: b is off by {error:e}");
        }
    }
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

/// Rounding of a Poisson's ratio that is the same in both materials was taken for a grading too fast, the nearer to 1/2 the more.
#[test]
fn two_materials_that_are_next_to_incompressible_mix() {
    let solved = |grading: &str| {
        let layer = format!("thickness = 5.0, poisson = 0.499999, grading = {{ {grading} }}");
        written(&layer, "type = \"cylinder\", radius = 10.0", "half_width = 1.0", "")
    };
    let material = |modulus: f64| format!("{{ modulus = {modulus:?}, poisson = 0.499999 }}");
    let mixed = format!(
        "type = \"volume-fraction\", surface = {}, base = {}, exponent = 1.0, rule = \"mixture\"",
        material(1.0),
        material(0.25)
    );
    let [mixed, linear] = [mixed.as_str(), "type = \"linear\", surface = 1.0, base = 0.25"].map(solved);
    assert_eq!(mixed.status, Status::Converged, "{:?}", mixed.reason);
    let [one, other] = [mixed, linear].map(|solution| solution.load.force.unwrap());
    assert!((one / other - 1.0).abs() < 1e-8, "{one} and {other}");
}

/// A series in `s` for the force beyond a kink feigned a rate that goes with `1/s`: tractions just at a kink without a corner were
/// off by 18 tolerances, and by 200 estimates at 1e-10.
#[test]
fn tractions_just_at_a_kink_are_those_beside_it() {
    let layer = "[layer]\nthickness = 0.7\npoisson = 0.3\n\
                 grading = { type = \"exponential\", surface = 1.0, base = 8.0 }";
    slipzone::link_plugins();
    for (punch, kink) in [
        ("type = \"rounded-wedge\"\nslope = 0.1\nradius = 1.0", 0.1),
        ("type = \"formula\"\nheight = \"0.05*x^2 + 0.05*max(abs(x) - 0.5, 0)^2\"", 0.5),
    ] {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let x = [kink * (1.0 - 1e-9), kink, kink * (1.0 + 1e-9)];
            let text = format!(
                "format = 1\nload = {{ half_width = 1.0 }}\nsolver = {{ tolerance = {tolerance:e} }}\n\
                 friction = {{ type = \"goodman\", coefficient = 0.3 }}\noutput = {{ x = {x:?} }}\n{layer}\n[punch]\n{punch}"
            );
            let found = solve(&slipzone::scene::parse("kink", &text).unwrap());
            let shear: Vec<f64> = found.profile.shear.unwrap().into_iter().flatten().collect();
            let pressure: Vec<f64> = found.profile.pressure.into_iter().flatten().collect();
            for traction in [shear, pressure] {
                let between = f64::midpoint(traction[0], traction[2]);
                let off = (traction[1] / between - 1.0).abs();
                assert!(off < 0.1 * tolerance + 1e-11, "{punch}: {off:e} at {tolerance:e}");
            }
        }
    }
}

/// Where the pressure in the middle is a twenty-thousandth of the mean, an error of the kernels that is small beside the mean was
/// taken to be as small beside that: 1e-2 off with 6e-4 claimed.
#[test]
fn a_pressure_faint_in_the_middle_is_as_sure_as_told() {
    slipzone::link_plugins();
    let text = |tolerance: f64| {
        format!(
            "format = 1\nload = {{ indentation = 0.0009 }}\nsolver = {{ tolerance = {tolerance:e} }}\n\
             punch = {{ type = \"flat\", half_width = 0.3266 }}\n\
             [layer]\npoisson = 0.1374\nplane = \"stress\"\nthickness = 1.59\n\
             grading = {{ type = \"sigmoid\", above = 100.0, below = 1.0, centre = 0.1926, width = 0.3387 }}"
        )
    };
    // By kernels as fine as there are, and three quadratures.
    let exact = 6.380_313_268e-7;
    for tolerance in [1e-2, 3e-3, 1e-3, 1e-4, 1e-6, 1e-8] {
        let found = solve(&slipzone::scene::parse("faint", &text(tolerance)).unwrap());
        let error = (found.pressure.centre.unwrap() / exact - 1.0).abs();
        let claimed = found.error.each["pressure.centre"];
        assert!(error <= 3.0 * claimed, "off by {error:e}, {claimed:e} claimed, at {tolerance:e}");
        // Its kernels are known to 1e-12 of the mean at best.
        assert_eq!(found.status == Status::Converged, tolerance > 1e-7, "{:?}", found.reason);
    }
}

/// A peak between two of 24 samples was passed by: the number told was up to 80 times too small, and every resolution agreed on it.
#[test]
fn the_largest_pressure_is_found_however_narrow_its_peak() {
    for face in [0.9, 0.999, 0.999_999] {
        // By superposition, the pressure of a half-plane.
        let beyond = |part: f64| face + (1.0 - face) * part;
        let points: Vec<String> = (1..400).map(|i| beyond(f64::from(i) / 400.0).to_string()).collect();
        let scene = format!(
            "format = 1\nlayer = {{ poisson = 0.3, base = {{ type = \"infinite\" }}, \
             grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"rounded-flat\", half_width = {face}, radius = 1.0 }}\nload = {{ half_width = 1.0 }}\n\
             output = {{ x = [{}] }}\n",
            points.join(", ")
        );
        let solution = solve(&slipzone::scene::parse("peak.toml", &scene).expect("a good scene"));
        let told = solution.number("pressure.peak").expect("a peak");
        let seen = solution.profile.pressure.iter().flatten().fold(0.0_f64, |most, p| most.max(*p));
        assert!(told >= seen * (1.0 - 1e-12) && told < seen * (1.0 + 1e-4), "{told} and {seen} with a face of {face}");
    }
}

/// What a stiff skin does beside the edge is as narrow as the skin: 32 samples of the pressure and 48 of the shear passed it by.
#[test]
fn neither_tension_nor_too_much_shear_hides_between_samples() {
    let on_skin = |skin: f64, modulus: f64, below: f64, rest: &str| {
        let scene = format!(
            "format = 1\npunch = {{ type = \"flat\", half_width = 1.0 }}\nload = {{ force = 1.0 }}\n{rest}\
             [layer]\npoisson = 0.3\n[layer.grading]\ntype = \"stack\"\nlayers = [\
             {{ thickness = {skin}, grading = {{ type = \"homogeneous\", modulus = {modulus} }} }}, \
             {{ thickness = {below}, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}]\n"
        );
        solve(&slipzone::scene::parse("skin.toml", &scene).expect("a good scene"))
    };
    let pulls = on_skin(0.02, 11.7152, 2.0, "");
    assert_eq!(pulls.status, Status::AssumptionViolated, "{:?}", pulls.reason);
    assert!(pulls.reason.as_ref().is_some_and(|why| why.contains("negative")), "{:?}", pulls.reason);
    let friction = "friction = { type = \"goodman\", coefficient = 1.0 }\nsolver = { tolerance = 1e-4 }\n";
    let slides = on_skin(0.005, 9.0, 1.0, friction);
    assert_eq!(slides.status, Status::AssumptionViolated, "{:?}", slides.reason);
    assert!(slides.reason.as_ref().is_some_and(|why| why.contains("1.31")), "{:?}", slides.reason);
}

/// No node of the first resolutions sees how a tip is worn: they agreed on the pressure of the parabola beside it, 3 % off and
/// claimed to 1e-10.
#[test]
fn smooth_details_are_seen_however_fast_they_fade() {
    let solved = |slope: &str, load: &str| {
        let scene = format!(
            "format = 1\nlayer = {{ poisson = 0.3, base = {{ type = \"infinite\" }}, \
             grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"formula\", slope = \"{slope}\" }}\nload = {{ half_width = 1.0 }}\n{load}"
        );
        solve(&slipzone::scene::parse("worn.toml", &scene).expect("a good scene"))
    };
    // By quadrature of the half-plane's formula.
    let worn = solved("0.1*x - 0.1*x*exp(-(x/0.05)^4)", "");
    assert_eq!(worn.status, Status::Converged, "{:?}", worn.reason);
    let centre = worn.number("pressure.centre").expect("a pressure");
    assert!((centre / 0.138_733_729_526 - 1.0).abs() < 1e-9, "{centre}");
    let force = worn.number("load.force").expect("a force");
    assert!((force / 0.224_388_523_900 - 1.0).abs() < 1e-9, "{force}");
    for width in [0.03, 0.003, 3e-5] {
        for tolerance in [1e-4, 1e-8] {
            let bump = format!("0.1*x + 0.05*x*exp(-(x/{width})^2)");
            let found = solved(&bump, &format!("solver = {{ tolerance = {tolerance} }}"));
            // The slope a x makes a b/A0 of the pressure in the middle, and a x exp(-(x/w)^2) makes a w/(sqrt(pi) A0) and a share w^2/4 more.
            let plain = solved("0.1*x", "").number("pressure.centre").expect("a pressure");
            let more = found.number("pressure.centre").expect("a pressure") - plain;
            let exact = 0.05 * width * plain / 0.1 / std::f64::consts::PI.sqrt();
            assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
            assert!((more / exact - 1.0).abs() < width * width + 2.0 * tolerance * plain / exact, "{more} for {exact}");
        }
    }
}

/// Close to its tip `1 - exp(-x^2)` is of rounding. A series over the force's share of the height took that for a wave all over the
/// contact: loads on the way to the last were off by up to 40 of their estimates.
#[test]
fn loads_on_the_way_are_right_where_a_formula_loses_digits_at_its_tip() {
    let solved = |height: &str, load: &str| {
        let scene = format!(
            "format = 1\nlayer = {{ thickness = 2.0, poisson = 0.3, \
             grading = {{ type = \"exponential\", surface = 1.0, base = 4.0 }} }}\n\
             punch = {{ type = \"formula\", height = \"{height}\" }}\n{load}"
        );
        solve(&slipzone::scene::parse("tip.toml", &scene).expect("a good scene"))
    };
    let half_widths: Vec<f64> = (0..21).map(|i| 0.4 + 0.02 * f64::from(i)).collect();
    for height in ["0.05*x^2*log(1 + x^2/0.09)", "x^2*(1 - exp(-x^2/0.16))", "x^2*(1 - exp(-x^4/1.6))"] {
        let path = format!("load = {{ path = {{ half_width = {half_widths:?} }} }}\nsolver = {{ tolerance = 1e-8 }}\n");
        let curve = solved(height, &path).path.expect("a curve");
        assert_eq!(curve.status, Status::Converged, "{height}: {:?}", curve.note);
        for i in [0, 6, 7, 8, 9, 10, 15] {
            let load = format!("load = {{ half_width = {} }}\nsolver = {{ tolerance = 1e-11 }}\n", half_widths[i]);
            let exact = solved(height, &load).number("load.force").expect("a force");
            let off = curve.force[i].expect("a force") / exact - 1.0;
            assert!(off.abs() < 1e-8, "{height} at {}: {off:e}", half_widths[i]);
        }
    }
}

/// Goodman's pressure knows nothing of friction: where that contradicts itself on the way to a load the pressure was left as coarse as it was
/// then, a thousandth, and the stick zone of a much narrower contact was told as this one's.
#[test]
fn a_pressure_is_as_good_where_friction_cannot_be_told() {
    let solved = |rest: &str| {
        let scene = format!(
            "format = 1\npunch = {{ type = \"cylinder\", radius = 10.0 }}\nload = {{ force = 0.05 }}\n{rest}\
             [layer]\npoisson = 0.3\n[layer.grading]\ntype = \"stack\"\nlayers = [\
             {{ thickness = 0.01, grading = {{ type = \"homogeneous\", modulus = 9.0 }} }}, \
             {{ thickness = 1.0, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}]\n"
        );
        solve(&slipzone::scene::parse("coating.toml", &scene).expect("a good scene"))
    };
    let smooth = solved("");
    let rubbing = solved("friction = { type = \"goodman\", coefficient = 0.3 }\n");
    assert_eq!(rubbing.status, Status::AssumptionViolated, "{:?}", rubbing.reason);
    let stick = rubbing.stick.as_ref().expect("friction");
    assert_eq!((stick.half_width, stick.ratio, stick.one_minus_ratio), (None, None, None));
    assert!(
        rubbing.error.each.keys().all(|key| !key.contains("stick") && !key.contains("shear")),
        "{:?}",
        rubbing.error
    );
    assert!(rubbing.error.estimate.is_some_and(|error| error < 1e-8), "{:?}", rubbing.error);
    for name in ["load.half_width", "load.indentation", "pressure.centre", "pressure.peak"] {
        let [one, other] = [&smooth, &rubbing].map(|solution| solution.number(name).expect("a number"));
        assert!((one / other - 1.0).abs() < 2e-8, "{name}: {one} and {other}");
    }
}

/// A punch of slope `rise x` with steps by `jump` rounded off over `width`, and its pressure in the middle of a half-plane were they sharp:
/// `A0 p(0) = rise + (2/pi) jump arcosh(1/c)`, summed over the steps.
fn stepped(places: &[f64], width: f64, tolerance: f64) -> (Solution, f64) {
    let (jump, rise) = (0.04, 0.01);
    let steps: Vec<String> =
        places.iter().map(|c| format!("{}*(tanh((x - {c})/{width}) + tanh((x + {c})/{width}))", jump / 2.0)).collect();
    let scene = |slope: &str| {
        let scene = format!(
            "format = 1\nlayer = {{ poisson = 0.3, base = {{ type = \"infinite\" }}, \
             grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"formula\", slope = \"{slope}\" }}\nload = {{ half_width = 1.0 }}\n\
             solver = {{ tolerance = {tolerance} }}\n"
        );
        solve(&slipzone::scene::parse("steps.toml", &scene).expect("a good scene"))
    };
    let plain = scene(&format!("{rise}*x")).number("pressure.centre").expect("a pressure");
    let of_steps = places.iter().map(|c| jump * (1.0 / c).acosh()).sum::<f64>() * 2.0 / std::f64::consts::PI;
    (scene(&format!("{rise}*x + {}", steps.join(" + "))), plain * (1.0 + of_steps / rise))
}

/// Too many details to be stacked were left to grids that saw none of them and agreed: up to a quarter off, claimed to 1e-2. Three were found at
/// coarse tolerances and not at tight ones. And of one the foot was cut off where a piece ends: 1e-6 off whatever the tolerance.
#[test]
fn many_details_are_resolved_or_flagged() {
    for (places, width, tolerance) in [
        (&[0.3, 0.5, 0.7][..], 1e-4, 1e-7),
        (&[0.3, 0.5, 0.7], 1e-5, 1e-4),
        (&[0.751], 1e-5, 1e-6),
        (&[0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85], 1e-4, 1e-2),
    ] {
        let (found, sharp) = stepped(places, width, tolerance);
        assert_eq!(found.status, Status::Converged, "{places:?}: {:?}", found.reason);
        let off = found.number("pressure.centre").expect("a pressure") / sharp - 1.0;
        // Rounding off changes a share of the square of the width.
        assert!(off.abs() < tolerance + 20.0 * width * width, "{places:?} at {tolerance:e}: {off:e}");
    }
}

/// The force beyond a kink like `max(|x| - c, 0)^p`, `p < 3/2`, begins like a low power, which no series tells: what is taken off as feigned was there.
/// The peak is at the kink itself, and the pressure in the middle lacks that force.
#[test]
fn what_is_taken_off_at_a_cusp_is_told() {
    // Pressures in the middle and at the kink by integrals of the half-plane's formula to 30 digits.
    for (power, peak) in [(1.1, 0.265_16), (1.2, 0.183_674), (1.3, 0.155_316), (1.5, 0.130_675_23)] {
        let scene = format!(
            "format = 1\nlayer = {{ poisson = 0.0, base = {{ type = \"infinite\" }}, \
             grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"formula\", height = \"0.05*x^2 + 0.05*max(abs(x) - 0.6, 0)^{power}\" }}\n\
             load = {{ half_width = 1.0 }}\n"
        );
        let found = solve(&slipzone::scene::parse("cusp.toml", &scene).expect("a good scene"));
        let off = (found.number("pressure.peak").expect("a peak") / peak - 1.0).abs();
        let told = found.error.each["pressure.peak"];
        assert!(off <= told.max(1e-5), "{power}: off by {off:e}, told {told:e}");
        assert_eq!(found.status == Status::Converged, power > 1.4, "{power}: {:?}", found.reason);
    }
}

/// Where the kernel of the coupling takes nearly all of what drives the shear, its error is as large beside the rest: zones were off by
/// up to 4,000 of their estimates.
#[test]
fn zones_driven_by_a_small_difference_are_not_surer_than_it_is() {
    let scene = |(thickness, poisson, friction): (f64, f64, f64), solver: &str| {
        let text = format!(
            "format = 1\nload = {{ force = 1.0 }}\npunch = {{ type = \"flat\", half_width = 1.0 }}\n\
             friction = {{ type = \"goodman\", coefficient = {friction:?} }}\nsolver = {{ {solver} }}\n\
             [layer]\nthickness = {thickness:?}\npoisson = {poisson:?}\n\
             base = {{ type = \"half-plane\", shear = 5.0, poisson = 0.0 }}\n\
             grading = {{ type = \"homogeneous\", modulus = 1.0 }}"
        );
        solve(&slipzone::scene::parse("driven", &text).unwrap())
    };
    for layer in [(1000.0, 0.5, 1e-4), (100.0, 0.499, 0.005), (20.0, 0.49, 0.01)] {
        let exact = scene(layer, "tolerance = 1e-11, model = \"full\"");
        for tolerance in ["1e-4", "1e-8"] {
            let found = scene(layer, &format!("tolerance = {tolerance}"));
            assert_eq!(found.status, Status::Converged, "{layer:?}: {:?}", found.reason);
            within_three_estimates(&found, &exact, &["stick.ratio", "stick.one_minus_ratio"]);
        }
    }
}

/// Where everything sticks the coarser of two shears may have been left far from the zone, where it is no number: that passed for
/// agreement. And one whose pressure was less sure than asked for was not refined at all. They were off by 14 and 180 estimates.
#[test]
fn the_shear_of_full_stick_is_no_surer_than_it_is() {
    for (layer, tolerance) in [
        ("thickness = 5.0\ngrading = { type = \"exponential\", surface = 8.0, base = 1.0 }", "1e-6"),
        ("thickness = 1.0\ngrading = { type = \"exponential\", surface = 1.0, base = 700.0 }", "1e-6"),
    ] {
        let scene = |tolerance: &str| {
            let text = format!(
                "format = 1\nload = {{ force = 1.0 }}\npunch = {{ type = \"flat\", half_width = 1.0 }}\n\
                 friction = {{ type = \"goodman\", coefficient = 3.0 }}\nsolver = {{ tolerance = {tolerance} }}\n\
                 output = {{ x = [0.5, 0.9, 0.95, 0.98, 0.99] }}\n[layer]\npoisson = 0.3\n{layer}"
            );
            solve(&slipzone::scene::parse("stuck", &text).unwrap())
        };
        let (found, exact) = (scene(tolerance), scene("1e-10"));
        let shears = [&found, &exact].map(|solution| solution.profile.shear.clone().unwrap());
        let largest = shears[1].iter().flatten().fold(0.0_f64, |most, q| most.max(q.abs()));
        let claimed = found.error.each["profile.shear"];
        for (q, exact) in shears[0].iter().flatten().zip(shears[1].iter().flatten()) {
            let off = (q - exact).abs() / largest;
            assert!(off <= 3.0 * claimed, "{layer}: off by {off:e}, claimed {claimed:e}");
        }
    }
}

/// Sums over the kernel of a layer so thin lost more digits with each finer grid, for want of room, and the last was reported: 9 % off
/// at 1e-8 where 1e-3 was met.
#[test]
fn a_layer_too_thin_for_finer_grids_keeps_what_coarser_ones_found() {
    let scene = |tolerance: &str| {
        let text = format!(
            "format = 1\nlayer = {{ thickness = 0.001, poisson = 0.3, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"flat\", half_width = 2.0 }}\nload = {{ force = 100.0 }}\n\
             solver = {{ tolerance = {tolerance} }}\noutput = {{ quantities = [\"load\", \"pressure\"] }}"
        );
        solve(&slipzone::scene::parse("thin", &text).unwrap())
    };
    let found = scene("1e-8");
    assert_eq!(found.status, Status::NotConverged);
    assert!(found.reason.as_ref().is_some_and(|reason| reason.contains("room")), "{:?}", found.reason);
    assert!(found.error.estimate.unwrap() < 1e-3, "{:?}", found.error.estimate);
    let coarse = scene("1e-3");
    assert_eq!(coarse.status, Status::Converged);
    for path in ["load.indentation", "pressure.centre"] {
        let off = (coarse.number(path).unwrap() / found.number(path).unwrap() - 1.0).abs();
        let claimed = coarse.error.each[path] + found.error.each[path];
        assert!(off <= 3.0 * claimed, "{path}: off by {off:e}, claimed {claimed:e}");
    }
}

/// Under a tip there is no pressure in the middle, and nothing told that the rest was not known: noise passed for a punch that lifts off,
/// with `-inf times the mean`.
#[test]
fn a_pressure_that_is_not_known_is_not_said_to_pull() {
    let text = "format = 1\nlayer = { thickness = 5.0, poisson = 0.3, grading = { type = \"exponential\", surface = 1.0, base = 8.0 } }\n\
                punch = { type = \"wedge\", slope = 0.1 }\nload = { half_width = 1e4 }";
    let quantities = ["", "output = { quantities = [\"edge\"] }"];
    for quantities in quantities {
        let scene = slipzone::scene::parse("tip", &format!("{text}\n{quantities}")).unwrap();
        let mut solver = Solver::new(&scene).unwrap();
        // Resolutions enough to be compared, and to be told of: nothing is learnt from more.
        solver.limit(2_000_000_000);
        let solution = solver.solve();
        assert_eq!(solution.status, Status::NotConverged, "{:?}", solution.reason);
        let reason = solution.reason.unwrap();
        assert!(!reason.contains("inf") && !reason.contains("error 0.0"), "{reason}");
    }
}

/// The kernel that tells depths has an error of its own: pressures and stick zones know nothing of it.
#[test]
fn an_unsure_depth_is_no_unsure_pressure() {
    let text = "format = 1\nload = { force = 1.0 }\npunch = { type = \"flat\", half_width = 1.0 }\n[layer]\npoisson = 0.3\ndatum = 0.4\n\
                base = { type = \"half-plane\", shear = 7.0, poisson = 0.3 }\n\
                grading = { type = \"stack\", layers = [\n\
                { thickness = 1000.0, poisson = 0.0, grading = { type = \"homogeneous\", modulus = 0.33 } },\n\
                { thickness = 2000.0, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 0.4 } } ] }";
    let solution = solve(&slipzone::scene::parse("deep", text).unwrap());
    let error = |path: &str| solution.error.each[path];
    assert!(error("pressure.centre") < 1e-8, "{:?}", solution.error.each);
    assert!(error("load.indentation") > 3.0 * error("pressure.centre"), "{:?}", solution.error.each);
}

/// An estimate that was no number was the reason given, with advice on the sizes of numbers.
#[test]
#[cfg(feature = "formula")]
fn an_error_that_is_no_number_is_all_of_the_number() {
    let text = "format = 1\nlayer = { thickness = 2.0, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
                load = { half_width = 1.0 }\n\
                punch = { type = \"formula\", height = \"R - sqrt(R^2 - x^1e9)\", parameters = { R = 10.0 } }";
    let solution = solve(&slipzone::scene::parse("steep", text).unwrap());
    assert_eq!(solution.status, Status::NotConverged, "{:?}", solution.reason);
    assert!(solution.error.each.values().all(|error| error.is_finite()), "{:?}", solution.error.each);
}

/// What the kernels of a layer are told to, more digits than there are, was refused; so was a contact whose tractions would have taken too
/// much once all resolutions had been tried in vain.
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
             punch = {{ type = \"flat\", half_width = 1.0 }}\nload = {{ force = 1.0 }}\nsolver = {{ tolerance = {tolerance:e} }}"
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

/// The flat punches that a contact is a stack of are told between a few. As many of them on every resolution agree on what all of
/// them miss: forces were off by up to 27 of their estimates, depths by 75, shears by 20.
#[test]
fn what_is_missed_between_flat_punches_is_in_the_errors() {
    let wedge = |h: f64, ratio: f64, nu: f64, eta: f64, tolerance: f64| {
        let text = format!(
            "format = 1\n[layer]\nthickness = {h:?}\npoisson = {nu:?}\ngrading = {{ type = \"exponential\", surface = 1.0, base = \
             {ratio:?} }}\n[punch]\ntype = \"wedge\"\nslope = 1.0\n[friction]\ntype = \"goodman\"\ncoefficient = {eta:?}\n[load]\n\
             half_width = 1.0\n[solver]\ntolerance = {tolerance:e}"
        );
        slipzone::link_plugins();
        let solution = solve(&slipzone::scene::parse("wedge.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}")));
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        solution
    };
    for (h, ratio, nu, eta, tolerance) in [
        (1.622_841_014_468_784, 0.115_960_075_7, 0.112_687_550_373_557_78, 0.128_430_678_538_468_54, 1e-4),
        (0.383_710_767_334_617_5, 0.808_345_811_4, 0.094_698_140_104_087_89, 0.897_991_453_601_399, 1e-8),
        // Off by three estimates where what the series leave is not added to what the differences tell.
        (1.591_396_960_199_756_6, 0.060_049_002_5, 0.335_424_284_991_289_8, 0.226_097_876_956_337_8, 1e-3),
    ] {
        let (found, exact) = (wedge(h, ratio, nu, eta, tolerance), wedge(h, ratio, nu, eta, 1e-3 * tolerance));
        for name in ["load.force", "load.indentation"] {
            let [number, truth] = [&found, &exact].map(|solution| solution.number(name).expect("a number"));
            let (apart, claimed) = ((number / truth - 1.0).abs(), found.error.each[name]);
            assert!(apart <= claimed, "{name}: {apart:e} off, {claimed:e} claimed at {tolerance:e}");
        }
        let [apart, claimed] = shear_apart(&found, &exact);
        assert!(apart <= claimed, "{apart:e} off, {claimed:e} claimed at {tolerance:e}");
    }
}

/// The slope beyond a kink at the very edge of the contact was taken for that before it: twice the force, and 1e-9 claimed.
#[test]
fn a_kink_at_the_edge_of_the_contact_is_not_felt() {
    let layer = "thickness = 5.0, grading = { type = \"exponential\", surface = 1.0, base = 8.0 }";
    for punch in ["0.05*x^2 + 0.1*max(0, abs(x) - 0.7)", "0.05*x^2 + 0.05*max(0, x^2 - 0.49)", "0.05*x^2"] {
        let text = format!(
            "format = 1\nlayer = {{ poisson = 0.3, {layer} }}\npunch = {{ type = \"formula\", height = \"{punch}\" }}\n\
             load = {{ half_width = 0.7 }}"
        );
        let found = solve(&slipzone::scene::parse("kink", &text).unwrap());
        let smooth = text.replace(punch, "0.05*x^2");
        let exact = solve(&slipzone::scene::parse("smooth", &smooth).unwrap());
        within_three_estimates(&found, &exact, &["load.force", "load.indentation", "pressure.centre"]);
    }
}

/// Under a corner the pressure is infinite, and resolutions were compared just there, at 0.3, 0.6 and 0.9 of the contact: no tolerance
/// was ever met.
#[test]
fn a_corner_where_pressures_are_compared_is_passed_over() {
    for (corner, half_width) in [(0.3, 1.0), (0.6, 1.0), (0.9, 1.0), (0.3, 0.5), (1.8, 2.0)] {
        let text = format!(
            "format = 1\nlayer = {{ poisson = 0.3, base = {{ type = \"infinite\" }}, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"formula\", height = \"0.05*x^2 + 0.01*max(0, abs(x) - {corner})\" }}\n\
             load = {{ half_width = {half_width:?} }}"
        );
        let found = solve(&slipzone::scene::parse("corner", &text).unwrap());
        assert_eq!(found.status, Status::Converged, "{corner}: {:?}", found.reason);
        // `(2/A0) int_c^b slope dx/sqrt(b^2 - x^2)`, and that of the parabola.
        let exact = (0.1 * half_width + 0.02 / std::f64::consts::PI * f64::acosh(half_width / corner)) / 0.7;
        let error = (found.pressure.centre.unwrap() / exact - 1.0).abs();
        assert!(error < 1e-8, "{corner}: {error:e}");
    }
}

/// Beyond the last point of a grid the strain goes with the root of the gap, and what is known of the shear is finite: taken for constant, and
/// for vanishing, both were missed by the gap, 1e-6 of the numbers where this grid ends.
#[test]
fn beyond_a_grid_things_go_on_as_they_do() {
    let solved = |layer: &str, grid: &str| {
        let layer = format!("{layer}, poisson = 0.3");
        let rest = format!(
            "friction = {{ type = \"goodman\", coefficient = 0.3 }}\n\
             solver = {{ tolerance = 1e-12, quadrature = {{ type = \"de-sinc\", {grid} }} }}"
        );
        written(&layer, "type = \"flat\", half_width = 1.0", "force = 2.0", &rest)
    };
    for layer in [
        "thickness = 5.0, grading = { type = \"exponential\", surface = 1.0, base = 8.0 }",
        // Its kernels are summed on a finer grid.
        "thickness = 1.0, grading = { type = \"exponential\", surface = 1.0, base = 0.1 }",
    ] {
        let [short, long] = ["n = 32, u_max = 2.4", "n = 90, u_max = 4.2"].map(|grid| solved(layer, grid));
        for (name, bound) in [("edge.stress_intensity", 1e-9), ("stick.one_minus_ratio", 4e-9)] {
            let [short, long] = [&short, &long].map(|solution| solution.number(name).expect("a number"));
            assert!((short / long - 1.0).abs() < bound, "{layer}: {name} = {short}, and {long} on a longer grid");
        }
    }
}

/// Where the slip zone is 7e-11 of the contact, the series of the shear was cut where its slope still changes: it came no closer than 1e-7 with up
/// to 90 unknowns, and at 1e-10 systems of up to 2,048 were solved for it, again and again.
#[test]
fn the_shear_beside_a_narrow_slip_zone_takes_few_unknowns() {
    slipzone::link_plugins();
    let text = |solver: &str| {
        format!(
            "format = 1\nload = {{ force = 2.0 }}\npunch = {{ type = \"flat\", half_width = 1.0 }}\n\
             friction = {{ type = \"goodman\", coefficient = 1.2433264939 }}\n[solver]\n{solver}\n\
             [layer]\nthickness = 0.8443917224\npoisson = 0.3819546963\n\
             grading = {{ type = \"exponential\", surface = 1.0, base = 0.4661024264 }}"
        )
    };
    let solved = |solver: &str| solve(&slipzone::scene::parse("narrow", &text(solver)).unwrap());
    let shear = |found: &Solution| {
        let points = found.profile.shear.as_ref().expect("friction");
        [130, 160, 180, 198].map(|i| points[i].expect("inside"))
    };
    let found = solved("tolerance = 1e-10");
    assert_eq!(found.status, Status::Converged, "{:?}", found.reason);
    assert!(found.error.each["profile.shear"] < 6e-10, "{:?}", found.error.each);
    assert!(found.plan.unknowns <= 91, "{} unknowns", found.plan.unknowns);
    assert!(found.plan.work < 20_000_000, "work {}", found.plan.work);
    for (n, within) in [(72, 1e-8), (128, 1e-9)] {
        let pinned = solved(&format!("tolerance = 1e-12\nquadrature = {{ type = \"de-sinc\", n = {n} }}"));
        for (exact, found) in shear(&found).into_iter().zip(shear(&pinned)) {
            let off = (found / exact - 1.0).abs();
            assert!(off < within, "{off:e} at n = {n}");
        }
    }
}

/// A slope of the friction curve was measured under one flat punch of the stack where the curve jumps from one grid of the slip zone to
/// another, 28 times too steep; it was believed, and moved the stick zones beside it by no more than a part of the way, at each resolution.
/// The error told was 1.2e-3.
#[test]
fn one_slope_measured_across_a_jump_does_not_spoil_the_stack() {
    let text = r#"
        format = 1
        punch = { type = "cylinder", radius = 20.0 }
        friction = { type = "goodman", coefficient = 0.33 }
        load = { force = 200.0 }
        output = { quantities = ["stick"] }
        [layer]
        thickness = 0.0738688826299256
        poisson = 0.3
        moduli = "young"
        base = { type = "half-plane", young = 210000.0, poisson = 0.3 }
        grading = { type = "exponential", surface = 80000.0, base = 210000.0 }
    "#;
    let solution = solve(&slipzone::scene::parse("jump.toml", text).expect("a good scene"));
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    // As friction of 0.32999 and 0.3301 has it in between, which were not hit.
    let ratio = solution.stick.and_then(|stick| stick.ratio).expect("a stick zone");
    assert!((ratio - 0.943_344_037).abs() < 2e-9, "{ratio}");
}
