//! Friction under growing contacts by brute force: the loading history in small steps, stick and slip decided cell by
//! cell by Coulomb's law alone.
//!
//! Slow, of few digits, and ignorant of the theorem that makes the program fast (a punch is a stack of flat punches):
//! that is what it is for. First order in the cells, steps of one cell; what it says of `q` is known from closed forms
//! to be good to 2e-5 of the largest `q`, and of `a/b` to 3e-5, at 768 cells.

mod coulomb;
mod dense;
mod edge;
mod march;
mod pressure;
mod scenes;
mod surface;

use march::{End, march};
use scenes::{Case, Shape, TEN};
use slipzone::api::reference::cylinder::Cylinder;
use slipzone::api::reference::goodman_shear::Goodman;
use slipzone::api::reference::rounded_flat::RoundedFlat;
use surface::Surface;

/// Where the shear is compared.
const POINTS: [f64; 3] = [0.25, 0.5, 0.75];

fn marched(case: &Case, cells: usize, steps: usize) -> End {
    march(&Surface::new(&case.sketch()), &case.shape.punch(), case.eta, cells, steps)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |top, value| value.abs().max(top))
}

/// The closed form of `dP/db`, per unit of the compliance.
fn force_rate(shape: Shape, b: f64) -> f64 {
    match shape {
        Shape::Cylinder => Cylinder { radius: 1.0, half_width: b, compliance: 1.0 }.force_rate(),
        Shape::Wedge => 2.0,
        Shape::Quartic => 6.0 * std::f64::consts::PI * b.powi(3),
        Shape::Rounded => RoundedFlat { flat: 0.5, radius: 1.0, half_width: b, compliance: 1.0 }.force_rate(),
    }
}

#[test]
fn experiment() {
    for shape in [Shape::Cylinder, Shape::Wedge, Shape::Quartic, Shape::Rounded] {
        for eta in [0.3, 0.45] {
            let case = Case::half_plane(shape, 0.3, eta);
            let elastic = Surface::new(&case.sketch()).elastic;
            let law = Goodman { eta, beta: elastic.beta() };
            for (cells, steps) in [(384, 96), (384, 192), (384, 384), (384, 768), (384, 1536), (192, 768), (192, 1536)] {
                let now = std::time::Instant::now();
                let end = marched(&case, cells, steps);
                let exact = |x: f64| law.grown(|b| force_rate(shape, b) / elastic.a0(), &[0.5], 1.0, x);
                let errors = POINTS.map(|x| (end.shear(x) - exact(x)) / largest(&end.q));
                println!("{shape:?} {eta} {cells} {steps}: {:.1e} {:.1e} {:.1e} a/b {:.1e} of {:.4} {:?}", errors[0], errors[1], errors[2], edge::stick_ratio(&end, eta) - law.stick().ratio, law.stick().ratio, now.elapsed());
            }
        }
    }
}

#[test]
fn experiment_ten() {
    for case in TEN {
        for (cells, steps) in [(192, 768), (384, 768), (384, 1536), (768, 1536)] {
            let now = std::time::Instant::now();
            let end = marched(&case, cells, steps);
            println!("{case:?} {cells} {steps}: q {:.7?} P {:.6} max q {} a/b {:.6} {:?}", POINTS.map(|x| end.shear(x)), end.force(), largest(&end.q), edge::stick_ratio(&end, case.eta), now.elapsed());
        }
    }
}
