//! No more is computed than a scene asks for.

use crate::sketch::{Sketch, numbers};
use serde::{Deserialize, Serialize};
use slipzone::api::{Component, KernelRequest, KernelStrategy, KernelTable, LayerResponse, Refusal};
use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::{Asked, Scene};
use slipzone_kernels::Split;
use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

thread_local! {
    /// Kernels that were tabulated.
    static TABULATED: RefCell<BTreeSet<Component>> = const { RefCell::new(BTreeSet::new()) };
}

/// `split`, which writes down what it is asked for.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Witness(Split);

#[typetag::serde(name = "witness")]
impl KernelStrategy for Witness {
    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        TABULATED.with_borrow_mut(|tabulated| tabulated.extend(request.components));
        self.0.tabulate(response, request)
    }

    fn refined(&self, level: u32) -> Box<dyn KernelStrategy> {
        assert!(level < 20, "split knows its own error");
        Box::new(self.clone())
    }

    fn is_pinned(&self) -> bool {
        self.0.is_pinned()
    }
}

thread_local! {
    /// How often a reach was refused.
    static REFUSED: Cell<usize> = const { Cell::new(0) };
}

/// `split` up to a contact as wide as the layer is thick.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Short(Split);

#[typetag::serde(name = "short")]
impl KernelStrategy for Short {
    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        if request.reach > 1.0 {
            REFUSED.set(REFUSED.get() + 1);
            return Err(Refusal::Limit { why: "this kernel is short".into(), remedy: "press less" });
        }
        self.0.tabulate(response, request)
    }

    fn refined(&self, _: u32) -> Box<dyn KernelStrategy> {
        Box::new(self.clone())
    }

    fn is_pinned(&self) -> bool {
        self.0.is_pinned()
    }
}

/// Each resolution asked for it again, until that had used up the budget: then nothing told of the other methods.
#[test]
fn what_kernels_cannot_serve_is_not_asked_for_again() {
    let on = "thickness = 1.0\npoisson = 0.3\ndatum = 9.0\nbase = { type = \"half-plane\", shear = 0.1, poisson = 0.25 }\n\
              grading = { type = \"homogeneous\", modulus = 1.0 }";
    let mut scene = Sketch::on(on).cylinder().loaded("force = 1.0").scene();
    scene.solver.kernel = Some(Box::new(Short::default()));
    REFUSED.set(0);
    let solution = solve(&scene);
    assert_eq!(solution.status, Status::Refused);
    assert!(solution.reason.is_some_and(|why| why.contains("this kernel is short")));
    assert!((1..=2).contains(&REFUSED.get()), "refused {} times", REFUSED.get());
}

/// A scene solved, and the kernels that it took.
fn witnessed(scene: &Scene) -> (Solution, Vec<Component>) {
    let mut scene = scene.clone();
    scene.solver.kernel = Some(Box::new(Witness::default()));
    TABULATED.take();
    let solution = solve(&scene);
    (solution, TABULATED.take().into_iter().collect())
}

fn asking(sketch: &Sketch, names: &[&str]) -> Scene {
    sketch.clone().with(&format!("[output]\nquantities = {names:?}")).scene()
}

fn sketches() -> [(&'static str, Sketch); 6] {
    let layer = Sketch::flat(3.0, 0.25, 0.3).rubbing(0.3);
    let datum = "thickness = 4.0\npoisson = 0.3\ndatum = 9.0\nbase = { type = \"half-plane\", shear = 2.0, poisson = 0.25 }\n\
                 grading = { type = \"homogeneous\", modulus = 1.0 }";
    [
        ("flat", layer.clone()),
        ("cylinder", layer.clone().cylinder()),
        ("by force", layer.clone().cylinder().loaded("force = 1.0")),
        ("by depth", layer.clone().cylinder().loaded("indentation = 0.5")),
        (
            "linear",
            layer.cylinder().with("[friction]\ntype = \"goodman\"\ncoefficient = 0.3\nstrain = \"linear\"").dry(),
        ),
        ("datum", Sketch::on(datum).rubbing(0.4)),
    ]
}

impl Sketch {
    /// Without the friction of its own.
    fn dry(self) -> Self {
        Self { eta: None, ..self }
    }
}

/// A layer makes of a strain `C|x|` a shear that is not smooth in the middle of the contact: tight tolerances take panels
/// that end there. What they tell is what `de-sinc` does, at a fifth of the time.
#[test]
fn a_linear_strain_takes_panels_where_that_pays() {
    let friction = "[friction]\ntype = \"goodman\"\ncoefficient = 0.3\nstrain = \"linear\"";
    let solved =
        |sketch: Sketch, solver: &str| sketch.cylinder().with(&format!("{friction}\n[solver]\n{solver}")).solve();
    let layer = || Sketch::flat(0.5, 0.125, 0.3);
    let tight = solved(layer(), "tolerance = 1e-7");
    let pinned = solved(layer(), "tolerance = 1e-7\nquadrature = { type = \"de-sinc\" }");
    let loose = solved(layer(), "tolerance = 1e-4");
    let plain = solved(Sketch::half_plane(0.3), "tolerance = 1e-7");
    let chosen = [&tight, &pinned, &loose, &plain].map(|solution| {
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        solution.plan.quadrature
    });
    assert_eq!(chosen, ["graded-panels", "de-sinc", "de-sinc", "de-sinc"]);
    let dry = solved(layer(), "tolerance = 1e-7\n[output]\nquantities = [\"load\"]");
    assert_eq!(dry.plan.quadrature, "de-sinc", "no shear is solved");
    for (path, exact) in numbers(&pinned) {
        let found = tight.number(path).expect("the same numbers");
        assert!((found - exact).abs() <= 2e-7 * exact.abs(), "{path}: {found:e} and {exact:e}");
    }
}

/// Every name alone, and the group that it belongs to: its numbers are those of the full answer, all others are `null`.
#[test]
fn what_is_asked_for_is_all_there_is_and_agrees() {
    let numbers: Vec<&str> = Asked::NAMES.into_iter().filter(|name| name.contains('.')).collect();
    for (name, sketch) in sketches() {
        let full = sketch.solve();
        assert_eq!(full.status, Status::Converged, "{name}: {:?}", full.reason);
        for asked in Asked::NAMES {
            let scene = asking(&sketch, &[asked]);
            let solution = solve(&scene);
            assert_eq!(solution.status, Status::Converged, "{name}, {asked}: {:?}", solution.reason);
            for path in &numbers {
                let (found, exact) = (solution.number(path), full.number(path));
                if !scene.output.asks(path) {
                    assert_eq!(found, None, "{name}: {path} beside {asked}");
                    assert!(!solution.error.each.contains_key(*path), "{name}: {path} beside {asked}");
                    continue;
                }
                assert_eq!(found.is_some(), exact.is_some(), "{name}: {path}");
                let (Some(found), Some(exact)) = (found, exact) else { continue };
                // Both are good to the default tolerance.
                let difference = if exact == 0.0 { found } else { found / exact - 1.0 };
                assert!(difference.abs() <= 2e-8, "{name}, {asked}: {path} = {found}, not {exact}");
                assert!(solution.error.each.contains_key(*path), "{name}: {path} has no error");
            }
            let profile = asked == "profile";
            assert_eq!(!solution.profile.x.is_empty(), profile, "{name}, {asked}");
            assert_eq!(solution.profile.shear.is_some(), profile, "{name}, {asked}");
        }
    }
}

#[test]
fn what_is_not_asked_for_is_not_computed() {
    use Component::{Coupling, Depth, NormalSlope, ShearStrain};
    let flat = Sketch::flat(3.0, 0.25, 0.3).rubbing(0.3);
    let cases: [(&[&str], &[Component]); 5] = [
        (&["edge"], &[NormalSlope]),
        (&["load.force", "pressure"], &[NormalSlope]),
        (&["load"], &[NormalSlope, Depth]),
        (&["stick.ratio"], &[NormalSlope, ShearStrain, Coupling]),
        (&["profile"], &[NormalSlope, ShearStrain, Coupling]),
    ];
    for (name, sketch) in [("flat", flat.clone()), ("cylinder", flat.clone().cylinder().loaded("force = 0.5"))] {
        let (full, all) = witnessed(&sketch.scene());
        assert_eq!(all, [NormalSlope, ShearStrain, Coupling, Depth], "{name}");
        for (asked, kernels) in cases {
            let (solution, tabulated) = witnessed(&asking(&sketch, asked));
            assert_eq!(tabulated, kernels, "{name}: {asked:?}");
            if !kernels.contains(&Coupling) {
                let (count, before) = (solution.plan.factorisations, full.plan.factorisations);
                // Neither a search for the stick zone, nor a stack of flat punches: one system for each resolution and
                // guess of the size.
                assert!(2 * count < before && count <= 40, "{name}: {count} systems for {asked:?}, {before} for all");
                assert!(solution.plan.reasons.iter().any(|reason| reason.starts_with("frictionless")), "{asked:?}");
            }
            let is_deep = kernels.contains(&Depth);
            let says = solution.plan.reasons.iter().any(|reason| reason.starts_with("no kernel of the depth"));
            assert_eq!(says, !is_deep, "{name}: {asked:?}");
        }
        let by_depth = sketch.clone().loaded("indentation = 0.1");
        let (solution, tabulated) = witnessed(&asking(&by_depth, &["edge"]));
        assert_eq!(
            (tabulated, solution.load.indentation),
            (vec![NormalSlope, Depth], None),
            "{name}: the load is a depth"
        );
    }
    // Beside a half-plane there are no kernels, so that a depth takes the only one.
    let datum = "base = { type = \"infinite\" }\npoisson = 0.3\ndatum = 5.0\ngrading = { type = \"homogeneous\", modulus = 1.0 }";
    assert_eq!(witnessed(&Sketch::on(datum).scene()).1, [Depth]);
    assert_eq!(witnessed(&asking(&Sketch::on(datum), &["edge"])).1, []);
}

/// A number that is hard to get and that nobody asks for does not keep the others from being good.
#[test]
fn what_is_not_asked_for_drives_no_refinement() {
    let sketch = Sketch::flat(3.0, 0.25, 0.49).rubbing(0.3);
    let all = sketch.solve();
    let one = solve(&asking(&sketch, &["edge.ratio"]));
    assert!(one.plan.unknowns <= all.plan.unknowns, "{} unknowns, {} for all", one.plan.unknowns, all.plan.unknowns);
    // What is given needs nothing but the resolutions that a judgement takes.
    let given = solve(&asking(&sketch, &["load.force"]));
    assert_eq!((given.load.force, given.error.estimate), (Some(1.0), Some(0.0)));
}

#[test]
fn a_loading_curve_has_the_columns_asked_for() {
    let sketch = Sketch::flat(3.0, 0.25, 0.3).cylinder().rubbing(0.3).loaded("until = { force = 0.5, points = 5 }");
    let full = sketch.solve().path.expect("a curve");
    let sizes = solve(&asking(&sketch, &["edge"])).path.expect("a curve");
    assert_eq!((&sizes.indentation, &sizes.stick_ratio, &sizes.stick_half_width), (&None, &None, &None));
    assert_eq!(sizes.status, Status::Converged, "{:?}", sizes.note);
    let stick = solve(&asking(&sketch, &["stick.ratio", "load.indentation"])).path.expect("a curve");
    assert!(stick.stick_half_width.is_none() && stick.indentation.is_some());
    let columns = [
        (&full.force, &sizes.force),
        (&full.half_width, &sizes.half_width),
        (full.stick_ratio.as_ref().expect("friction"), stick.stick_ratio.as_ref().expect("asked for")),
        (full.indentation.as_ref().expect("a base"), stick.indentation.as_ref().expect("asked for")),
    ];
    for (one, other) in columns {
        for (one, other) in one.iter().zip(other) {
            let (one, other) = (one.expect("a number"), other.expect("a number"));
            // Both are good to the default tolerance.
            assert!((one / other - 1.0).abs() <= 2e-8, "{one} and {other}");
        }
    }
}

/// The result says what was not looked at.
#[test]
fn a_result_claims_nothing_of_a_shear_that_was_not_solved() {
    // Fails the conditions of friction (docs/theory.md, "Direction of slip" has more of its kind).
    let sketch = Sketch::flat(1.0, 1.0, 0.3).rubbing(0.02);
    let solution = solve(&asking(&sketch, &["pressure"]));
    assert!(
        solution.assumptions.iter().any(|what| what.ends_with("the shear is not asked for")),
        "{:?}",
        solution.assumptions
    );
    assert!(solution.stick.is_none() && solution.profile.shear.is_none());
    let without = solve(&asking(&Sketch::flat(1.0, 1.0, 0.3), &["stick"]));
    assert_eq!((without.status, without.stick.is_none()), (Status::Converged, true));
}

/// Asking for everything by name is asking for everything.
#[test]
fn all_groups_are_the_full_answer_bit_for_bit() {
    for (name, sketch) in sketches() {
        let full = sketch.solve();
        let named = solve(&asking(&sketch, &["load", "pressure", "edge", "stick", "profile"]));
        for path in Asked::NAMES.into_iter().filter(|name| name.contains('.')) {
            assert_eq!(full.number(path).map(f64::to_bits), named.number(path).map(f64::to_bits), "{name}: {path}");
        }
        assert_eq!(full.error.each, named.error.each, "{name}");
        assert_eq!(full.profile.pressure, named.profile.pressure, "{name}");
    }
}
