//! Depths counted from a datum, which sinks as well.

use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::parse;

fn solved(text: &str) -> Solution {
    slipzone::link_plugins();
    solve(&parse("datum.toml", &format!("format = 1\n{text}")).expect("a scene"))
}

fn half_plane(nu: f64, datum: f64) -> String {
    format!(
        "layer = {{ poisson = {nu:?}, base = {{ type = \"infinite\" }}, datum = {datum:?}, \
         grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n"
    )
}

/// `2 s/pi [b asinh(d/b) + beta d asinh(b/d)]` under a wedge of slope `s` on a half-plane: flat punches in closed form,
/// stacked at the rate `dP/db = 2 s/A0`.
fn depth_of_wedge(nu: f64, datum: f64, b: f64) -> f64 {
    let beta = (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu);
    0.2 / std::f64::consts::PI * (b * (datum / b).asinh() + beta * datum * (b / datum).asinh())
}

/// However shallow the datum, and to the tolerance: it varies with the half-width as nothing else of the half-plane
/// does.
#[test]
fn a_wedge_over_a_shallow_datum_sinks_as_the_closed_form_says() {
    for (nu, datum, tolerance) in
        [(0.3, 0.22, 1e-8), (0.3, 0.15, 1e-6), (0.0, 0.02, 1e-4), (0.45, 1e-3, 1e-8), (0.3, 30.0, 1e-10)]
    {
        let text = half_plane(nu, datum)
            + &format!(
                "punch = {{ type = \"wedge\", slope = 0.1 }}\nload = {{ half_width = 1.0 }}\nsolver = {{ tolerance = {tolerance:?} }}\n"
            );
        let solution = solved(&text);
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let (depth, exact) = (solution.load.indentation.expect("a datum"), depth_of_wedge(nu, datum, 1.0));
        let error = (depth / exact - 1.0).abs();
        println!("nu {nu} datum {datum}: {error:.1e} at {tolerance:.0e}");
        assert!(error < 0.1 * f64::min(tolerance, 1e-6), "{depth} for {exact} at {datum}");
    }
}

/// Where the law begins with a broken power of the depth, so does what depends on the half-width: depths of flat
/// punches told by polynomials were off by up to 23 estimates. By panels of another solver, on three meshes.
#[test]
fn depths_on_a_law_that_begins_with_a_broken_power_are_as_sure_as_they_say() {
    let depth = 0.005_606_214_902_907;
    let told = |load: &str, tolerance: f64| {
        let text = format!(
            "layer = {{ thickness = 1.0, poisson = 0.3, datum = 5.52, base = {{ type = \"half-plane\", shear = 0.703, poisson = 0.2 }}, \
             grading = {{ type = \"formula\", modulus = \"1+7.96*y^0.5\" }} }}\n\
             punch = {{ type = \"power\", coefficient = 0.02, exponent = 1.5 }}\nload = {{ {load} }}\n\
             solver = {{ tolerance = {tolerance:?} }}\noutput = {{ quantities = [\"load\"] }}\n"
        );
        let solution = solved(&text);
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        solution
    };
    for tolerance in [1e-5, 1e-6, 1e-8] {
        let solution = told("force = 0.00929", tolerance);
        let error = (solution.load.indentation.expect("a datum") / depth - 1.0).abs();
        assert!(error < solution.error.each["load.indentation"].max(1e-12), "{error:e} at {tolerance:e}");
    }
    let path = told("path = { force = [0.0007742, 0.00929, 0.01548] }", 1e-4).path.expect("a curve");
    let error = (path.indentation.expect("depths")[1].expect("a datum") / depth - 1.0).abs();
    assert!(error < path.error.expect("an error"), "{error:e} on the way");
}

/// Deep below a wedge that is wider than the datum is deep, what sinks grows like a logarithm.
#[test]
fn a_wedge_is_pressed_in_however_wide_it_gets() {
    for b in [0.3, 3.0, 900.0] {
        let depth = depth_of_wedge(0.3, 1.0, b);
        let text = half_plane(0.3, 1.0)
            + &format!("punch = {{ type = \"wedge\", slope = 0.1 }}\nload = {{ indentation = {depth:?} }}\n");
        let solution = solved(&text);
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let found = solution.load.half_width.expect("a contact");
        assert!((found / b - 1.0).abs() < 1e-8, "{found} for {b}");
    }
}

/// Above a base that gives way what sinks grows, shrinks and grows again. The load grew from nothing: it is the first.
#[test]
fn the_first_contact_that_sinks_so_far_is_met() {
    let cylinder = "layer = { thickness = 1.0, poisson = 0.3, base = { type = \"half-plane\", shear = 0.3, poisson = 0.3 }, \
        datum = 0.1, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
        punch = { type = \"cylinder\", radius = 10.0 }\n";
    let power = "layer = { thickness = 0.85, poisson = 0.1, grading = { type = \"linear\", surface = 1.56, base = 0.725 }, \
        base = { type = \"half-plane\", young = 0.124, poisson = 0.5 }, datum = 0.745 }\n\
        punch = { type = \"power\", coefficient = 0.1, exponent = 1.378 }\n";
    for (layer, widths) in [(cylinder, [0.3, 0.43, 0.65]), (power, [0.5, 0.6, 0.66])] {
        let depths = widths.map(|b| {
            let solution = solved(&format!("{layer}load = {{ half_width = {b:?} }}\n"));
            solution.load.indentation.expect("a datum")
        });
        assert!(depths.is_sorted(), "on the first rise: {depths:?}");
        // Beyond it sinks less, and as far again, under pressures that are ones.
        let [less, more] = [1.0, 3.0].map(|b| solved(&format!("{layer}load = {{ half_width = {b:?} }}\n")));
        assert!([&less, &more].iter().all(|wider| wider.status == Status::Converged));
        let depth = |wider: &Solution| wider.load.indentation.expect("a datum");
        assert!(depth(&less) < depths[2] && depth(&more) > depths[2], "{layer}");
        for (depth, b) in depths.iter().zip(widths) {
            let solution = solved(&format!("{layer}load = {{ indentation = {depth:?} }}\n"));
            assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
            let found = solution.load.half_width.expect("a contact");
            assert!((found / b - 1.0).abs() < 1e-6, "{found} for {b}");
            assert!(
                solution.assumptions.iter().any(|said| said.contains("the narrowest")),
                "{:?}",
                solution.assumptions
            );
        }
        // Whatever comes after it on a path.
        for last in [depths[2], 1.2 * depths[2]] {
            let [one, two, _] = depths;
            let text = format!("{layer}load = {{ path = {{ indentation = [{one:?}, {two:?}, {last:?}] }} }}\n");
            let path = solved(&text).path.expect("a path");
            let found = path.half_width[1].expect("a contact");
            assert!((found / widths[1] - 1.0).abs() < 1e-6, "{found} for {} before {last}", widths[1]);
        }
    }
}

/// The same where it is no base that gives way but a soft sublayer above a rigid one: of the contacts that sink so far,
/// or bear so much, a wider one, which pulls, was met and flagged.
#[test]
fn the_first_contact_is_met_above_a_soft_sublayer() {
    let layer = "layer = { poisson = 0.3, grading = { type = \"stack\", layers = [\
        { thickness = 0.15, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
        { thickness = 0.85, grading = { type = \"homogeneous\", modulus = 0.01 } }] } }\n";
    for punch in ["type = \"wedge\", slope = 0.02", "type = \"rounded-wedge\", slope = 0.02, radius = 1.0"] {
        for b in [0.018, 0.033, 0.045] {
            let with = |load: String| solved(&format!("{layer}punch = {{ {punch} }}\nload = {{ {load} }}\n"));
            let known = with(format!("half_width = {b:?}"));
            assert_eq!(known.status, Status::Converged, "{:?}", known.reason);
            let depth = known.load.indentation.expect("a rigid base");
            let force = known.load.force.expect("a force");
            for load in [format!("indentation = {depth:?}"), format!("force = {force:?}")] {
                let solution = with(load.clone());
                assert_eq!(solution.status, Status::Converged, "{punch}, {load}: {:?}", solution.reason);
                let found = solution.load.half_width.expect("a contact");
                assert!((found / b - 1.0).abs() < 1e-6, "{punch}, {load}: {found} for {b}");
            }
        }
    }
}

/// Close to the greatest depth the contact is met, though one not much wider has risen above its datum.
#[test]
fn close_to_the_greatest_depth_the_contact_is_met() {
    let layer = "layer = { thickness = 2.93, poisson = 0.3, datum = 0.468, base = { type = \"half-plane\", shear = 0.109, poisson = 0.3 }, \
        grading = { type = \"homogeneous\", modulus = 1.0 } }\npunch = { type = \"power\", coefficient = 0.05, exponent = 8.0 }\n";
    let depth =
        |b: f64| solved(&format!("{layer}load = {{ half_width = {b:?} }}\n")).load.indentation.expect("a datum");
    let depths = [0.85, 0.9, 0.93].map(depth);
    assert!(depths.is_sorted() && depth(1.2) < 0.0, "{depths:?}");
    for (b, depth) in [0.85, 0.9, 0.93].into_iter().zip(depths) {
        let solution = solved(&format!("{layer}load = {{ indentation = {depth:?} }}\n"));
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        assert!((solution.load.half_width.expect("a contact") / b - 1.0).abs() < 1e-5, "{:?} for {b}", solution.load);
    }
}

/// A plate on a soft base bends under the punch, which lifts off before it sinks as far as is asked for: told was an
/// error of 1 alone.
#[test]
fn a_punch_that_lifts_off_before_it_sinks_so_far_is_told() {
    let solution = solved(
        "layer = { thickness = 1.0, poisson = 0.365, datum = 0.628, base = { type = \"half-plane\", young = 1.74, poisson = 0.07 }, \
         grading = { type = \"homogeneous\", modulus = 127.6 } }\n\
         punch = { type = \"rounded-wedge\", slope = 0.01, radius = 2.57 }\n\
         load = { indentation = 0.0072 }\nsolver = { tolerance = 1e-4 }\n",
    );
    assert_eq!(solution.status, Status::NotConverged, "{:?}", solution.reason);
    assert!(solution.reason.as_ref().is_some_and(|reason| reason.contains("lifts off")), "{:?}", solution.reason);
}

/// What is stacked sinks as what is smooth: within its kinks a punch is the cylinder. Members that told the pressure
/// told little of the depth, which changes over the distance to the datum: 8 % were missed at 1e-5.
#[test]
fn a_stack_sinks_as_the_smooth_contact_of_the_same_shape() {
    let cylinder = "type = \"cylinder\", radius = 10.0";
    let kinked = "type = \"formula\", height = \"0.05*x^2 + 0.02*max(0, abs(x) - 0.4)^2\"";
    for datum in [1e-3, 0.01, 0.1] {
        for tolerance in [1e-3, 1e-5, 1e-7] {
            let [smooth, stacked] = [cylinder, kinked].map(|punch| {
                let text = format!(
                    "layer = {{ thickness = 1.0, poisson = 0.4999, plane = \"stress\", datum = {datum:?}, \
                     base = {{ type = \"half-plane\", shear = 3.0, poisson = 0.0 }}, \
                     grading = {{ type = \"exponential\", surface = 1.0, base = 0.05 }} }}\npunch = {{ {punch} }}\n\
                     load = {{ half_width = 0.4 }}\nsolver = {{ tolerance = {tolerance:?} }}\noutput = {{ quantities = [\"load\"] }}\n"
                );
                let solution = solved(&text);
                assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
                (solution.load.indentation.expect("a datum"), solution.error.each["load.indentation"])
            });
            let apart = (stacked.0 / smooth.0 - 1.0).abs();
            println!("datum {datum} at {tolerance:.0e}: {apart:.1e}, told {:.1e} and {:.1e}", smooth.1, stacked.1);
            assert!(apart < smooth.1 + stacked.1, "{} for {} at {datum}, {tolerance:e}", stacked.0, smooth.0);
        }
    }
}

/// A narrow rise between two steps of the walk, from 2.01 to 2.30 millionths and back while the contact grows from 0.19
/// to 0.27; a wide contact that sinks as far is met long after. Also just below the top, where a coarse resolution has
/// none.
#[test]
fn a_rise_between_two_steps_is_met() {
    let layer = "layer = { thickness = 1.0, poisson = 0.5, datum = 0.1038468622186015, \
        base = { type = \"half-plane\", young = 3.0770735667457987, poisson = 0.5 }, \
        grading = { type = \"exponential\", surface = 1.0, base = 0.2243258454688775 } }\n\
        punch = { type = \"power\", coefficient = 1.0, exponent = 6.0 }\n";
    let depth =
        |b: f64| solved(&format!("{layer}load = {{ half_width = {b:?} }}\n")).load.indentation.expect("a datum");
    assert!(depth(0.275) < depth(0.22) && depth(0.35) > depth(0.22));
    for b in [0.15, 0.19, 0.2, 0.21, 0.2195] {
        let solution = solved(&format!("{layer}load = {{ indentation = {:?} }}\n", depth(b)));
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        assert!((solution.load.half_width.expect("a contact") / b - 1.0).abs() < 1e-5, "{:?} for {b}", solution.load);
    }
}

/// Far above its datum a punch `|x|^n` on a half-plane sinks by `A0 P/pi [ln(2 d/b) + 1/n - 1/(2 - 2 nu)]`: flat
/// punches in closed form, stacked at a rate like `b^(n-1)`. As many nodes summed the pressure under steep punches as
/// under flat ones, at each resolution: for `n = 32` the depth was off by 1e-9, and sure to 2e-13.
#[test]
fn a_steep_punch_far_above_its_datum_sinks_as_the_closed_form_says() {
    let (nu, datum) = (0.3, 1e6);
    for n in [2.0, 16.0, 32.0, 36.0] {
        let text = half_plane(nu, datum)
            + &format!(
                "punch = {{ type = \"power\", coefficient = 0.01, exponent = {n:?} }}\nload = {{ half_width = 1.0 }}\n\
                 solver = {{ tolerance = 1e-11 }}\n"
            );
        let solution = solved(&text);
        assert_eq!(solution.status, Status::Converged, "{n}: {:?}", solution.reason);
        let told = |number: Option<f64>| number.expect("a datum and a load");
        let (depth, force) = (told(solution.load.indentation), told(solution.load.force));
        let exact = (1.0 - nu) * force / std::f64::consts::PI * ((2.0 * datum).ln() + 1.0 / n - 1.0 / (2.0 - 2.0 * nu));
        let (off, claimed) = ((depth / exact - 1.0).abs(), solution.error.each["load.indentation"]);
        assert!(off < claimed, "{n}: {depth} for {exact}, {off:.1e} off and {claimed:.1e} claimed");
    }
}

/// A stiff coating bends, and a datum in it sinks more than a narrow punch does; not more than a wide one.
#[test]
fn a_punch_that_sinks_less_than_its_datum_at_first_is_pressed_in_later() {
    let layer = "layer = { thickness = 1.0, poisson = 0.0, datum = 0.048, base = { type = \"half-plane\", young = 0.6, poisson = 0.0 }, \
        grading = { type = \"stack\", layers = [ { thickness = 0.1, grading = { type = \"homogeneous\", modulus = 10.0 } }, \
        { thickness = 0.9, grading = { type = \"homogeneous\", modulus = 0.1 } } ] } }\n\
        punch = { type = \"power\", coefficient = 1.0, exponent = 6.0 }\n";
    let depth =
        |b: f64| solved(&format!("{layer}load = {{ half_width = {b:?} }}\n")).load.indentation.expect("a datum");
    assert!(depth(0.0625) < 0.0);
    let solution = solved(&format!("{layer}load = {{ indentation = {:?} }}\n", depth(0.88)));
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    assert!((solution.load.half_width.expect("a contact") / 0.88 - 1.0).abs() < 1e-6, "{:?}", solution.load);
}

/// Just below the most that it sinks the depth hardly grows with the half-width: what the kernels are off by moved the
/// contact by ten times what was claimed.
#[test]
fn next_to_the_deepest_a_contact_is_as_sure_as_the_depth_lets_it_be() {
    let text = "layer = { thickness = 1.0, poisson = 0.48, datum = 0.3, base = { type = \"half-plane\", shear = 8e4, poisson = 0.3 }, \
        grading = { type = \"exponential\", surface = 3e4, base = 6e4 } }\n\
        punch = { type = \"cylinder\", radius = 100.0 }\nload = { indentation = 0.00098979 }\n";
    let solution = solved(text);
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    // At a tolerance of 1e-11.
    let apart = (solution.load.force.expect("a force") / 5_171.795_916_757 - 1.0).abs();
    let claimed = solution.error.each["load.force"];
    assert!(apart < 3.0 * claimed, "{apart:e}, {claimed:e} claimed");
}
