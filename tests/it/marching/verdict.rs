//! The program against the march.

use super::edge::stick_ratio;
use super::scenes::{Case, POINTS, TEN};
use slipzone::engine::{Status, solve};

/// Solves the scene both ways.
fn compare(case: &Case, cells: usize, steps: usize) {
    let solution = solve(&case.scene("[output]\nx = [0.25, 0.5, 0.75]"));
    assert_eq!(solution.status, Status::Converged, "{case:?}: {:?}", solution.reason);
    let end = case.march(cells, steps);
    let shear = solution.profile.shear.as_ref().expect("friction");
    let force = end.force() / solution.load.force.expect("a number") - 1.0;
    let ratio = stick_ratio(&end, case.eta) - solution.stick.as_ref().and_then(|s| s.ratio).expect("a ratio");
    println!("{case:?}: P {force:.1e} a/b {ratio:.1e}");
    assert!(force.abs() < 2e-6, "{case:?}: P is {force:.1e} apart, a smooth integral over the cells");
    // What the march is known for on half-planes, with room for slip zones of a few dozen cells.
    assert!(ratio.abs() < 1e-4, "{case:?}: a/b is {ratio:.1e} apart");
    for ((x, q), p) in POINTS.into_iter().zip(shear).zip(&solution.profile.pressure) {
        let (q, p) = (q.expect("inside"), p.expect("inside"));
        let errors = [(end.shear(x) - q) / end.largest(), end.pressure(x) / p - 1.0];
        println!("    x = {x}: q {q} against {}, {:.1e}; p {:.1e}", end.shear(x), errors[0], errors[1]);
        assert!(errors[0].abs() < 1e-4, "{case:?}: q = {q} against {} at x = {x}", end.shear(x));
        // The march's own: with 384 nodes in place of 96 the rounded flat's comes to within 6e-8.
        assert!(errors[1].abs() < 5e-6, "{case:?}: p = {p} against {} at x = {x}", end.pressure(x));
    }
}

#[test]
fn three_scenes() {
    for case in [TEN[1], TEN[6], TEN[9]] {
        compare(&case, 384, 768);
    }
}

#[test]
#[ignore = "a minute"]
fn ten_scenes() {
    for case in &TEN {
        compare(case, 768, 1536);
    }
}

/// The march against itself: what it says, by how much that changes with cells and steps, and the stick zone of a
/// flat punch on the same layer.
#[test]
#[ignore = "prints the ten scenes, a few minutes"]
fn table() {
    for case in &TEN {
        let stick = case.flat().solve().stick.and_then(|stick| stick.ratio).expect("a ratio");
        println!("{case:?}: flat a/b {stick:.6}");
        for (cells, steps) in [(192, 768), (384, 768), (384, 1536), (768, 1536)] {
            let end = case.march(cells, steps);
            let (q, p) = (POINTS.map(|x| end.shear(x)), POINTS.map(|x| end.pressure(x)));
            let (ratio, force) = (stick_ratio(&end, case.eta), end.force());
            println!("  {cells}/{steps}: a/b {ratio:.6} q {q:.7?} p {p:.7?} P {force:.7} top {:.4}", end.largest());
        }
    }
}
