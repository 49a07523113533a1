//! What must hold of every scene. A failing case is printed with its shrunk scene and its seed.

use crate::sketch::Sketch;
use proptest::prelude::*;
use slipzone::engine::{Solution, Status};
use std::f64::consts::PI;

/// Layers under a flat punch that the default methods solve quickly.
fn flats() -> impl Strategy<Value = Sketch> {
    (1.0..20.0_f64, -2.0..2.0_f64, 0.0..0.45_f64).prop_map(|(h, log_ratio, nu)| Sketch::flat(h, log_ratio.exp(), nu))
}

/// The same layers under either punch.
fn sketches() -> impl Strategy<Value = Sketch> {
    (flats(), any::<bool>()).prop_map(|(sketch, flat)| if flat { sketch } else { sketch.cylinder() })
}

/// Chebyshev abscissae, at which `int p dx = pi/n sum p sqrt(b^2 - x^2)` for either kind of edge.
fn chebyshev(n: u32) -> Vec<f64> {
    (1..=n).map(|i| -(PI * (f64::from(i) - 0.5) / f64::from(n)).cos()).collect()
}

fn pressures(solution: &Solution) -> Vec<f64> {
    solution.profile.pressure.iter().map(|p| p.expect("inside the contact")).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn pressure_pushes_is_symmetric_and_carries_the_force(sketch in sketches()) {
        let x = chebyshev(200);
        let solution = sketch.with(&format!("[output]\nx = {x:?}")).solve();
        prop_assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let p = pressures(&solution);
        prop_assert!(p.iter().all(|p| *p >= 0.0));
        for (left, right) in p.iter().zip(p.iter().rev()) {
            // The abscissae themselves are symmetric only to rounding, and the edge field amplifies that.
            prop_assert!((left / right - 1.0).abs() < 1e-9, "{} against {}", left, right);
        }
        let carried: f64 = p.iter().zip(&x).map(|(p, x)| p * (1.0 - x * x).sqrt()).sum::<f64>() * PI / 200.0;
        let force = solution.load.force.expect("a number");
        // Gauss sums of a density with gap log gap beside its square root err like n^-2, times a gradient; next to
        // that the pressure's own error, 1e-8, is nothing.
        prop_assert!((carried / force - 1.0).abs() < 1e-5, "{} of {}", carried, force);
    }

    #[test]
    fn friction_holds_within_coulombs_limit(sketch in flats(), eta in 0.05..0.6_f64) {
        let solution = sketch.rubbing(eta).solve();
        let stick = solution.stick.as_ref().expect("friction");
        let limit = 1.0 + 1e-3;
        if solution.status == Status::Converged {
            let shear = solution.profile.shear.as_ref().expect("friction");
            for (p, q) in solution.profile.pressure.iter().zip(shear) {
                if let (Some(p), Some(q)) = (p, q) {
                    prop_assert!(q.abs() <= eta * p * limit, "|q| = {} above {}", q.abs(), eta * p);
                }
            }
            let (ratio, gap) = (stick.ratio.expect("a number"), stick.one_minus_ratio.expect("a number"));
            prop_assert!(ratio > 0.0 && gap > 0.0 && (ratio + gap - 1.0).abs() < 1e-15);
        } else {
            prop_assert!(solution.reason.is_some());
        }
    }

    #[test]
    fn more_friction_sticks_more(h in 2.0..20.0_f64, log_ratio in -2.0..2.0_f64, eta in 0.1..0.5_f64) {
        let solve = |eta: f64| Sketch::flat(h, log_ratio.exp(), 0.3).rubbing(eta).solve();
        let (less, more) = (solve(eta), solve(1.2 * eta));
        // A bound says nothing of what lies beyond it.
        prop_assume!((less.status, more.status) == (Status::Converged, Status::Converged));
        let ratio = |solution: Solution| solution.stick.expect("friction").ratio.expect("a number");
        prop_assert!(ratio(more) > ratio(less));
    }
}
