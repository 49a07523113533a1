//! The orders of the surface series under a law that is smooth at the surface.

use super::solved;
use crate::integration::fused;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::SurfaceFlexibility;

/// Degrees that are computed side by side.
const LANES: usize = 4;

/// `H0`, `H1`, ... as Taylor polynomials of matrices, one coefficient fewer from order to order.
pub(super) struct Orders {
    vv: Rows,
    uu: Rows,
    uv: Rows,
}

/// One entry: a row of coefficients for each order, some degrees at a time.
struct Rows {
    blocks: Vec<Block>,
    /// Blocks of a row, an empty one at the end: a derivative asks for it.
    length: usize,
}

/// Some coefficients, and what stands in their places when the row is multiplied by 1, `y`, `y^2`, `y^3`.
type Block = [[f64; LANES]; LANES];

impl Orders {
    /// Those up to the `terms`-th: from the entries of `H0` that vary not at all, from its coupling, whose coefficients
    /// that are left out are zero, and from the logarithmic gradient to `terms` coefficients.
    pub(super) fn new(first: SurfaceFlexibility, coupling: &[f64], gradient: &[f64], terms: usize) -> Self {
        let rows = || Rows::new(terms + 1, terms + 1);
        let mut orders = Self { vv: rows(), uu: rows(), uv: rows() };
        orders.vv.set(0, 0, first.vv);
        orders.uu.set(0, 0, first.uu);
        for (degree, c) in coupling.iter().take(terms + 1).enumerate() {
            orders.uv.set(0, degree, *c);
        }
        let mut grade = Rows::new(1, terms + 1);
        for (degree, w) in gradient.iter().take(terms).enumerate() {
            grade.set(0, degree, *w);
        }
        Arch::new().dispatch(Rise { orders: &mut orders, grade: &grade, terms });
        orders
    }

    /// An order at the surface.
    pub(super) fn at_surface(&self, order: usize) -> SurfaceFlexibility {
        let at = |rows: &Rows| rows.row(order)[0][0][0];
        SurfaceFlexibility { vv: at(&self.vv), uu: at(&self.uu), uv: at(&self.uv) }
    }

    /// The right side of the equation for an order, over one block of degrees.
    #[inline(always)]
    fn right<S: Simd>(&self, order: usize, block: usize, grade: &Rows) -> [[f64; LANES]; 3] {
        let before = [&self.vv, &self.uu, &self.uv].map(|rows| rows.row(order - 1));
        let grade = &grade.row(0)[..=block];
        let [mut vv, mut uu, mut uv] = before.map(|row| {
            let mut sum = derivative(row, block);
            for (w, right) in grade.iter().zip(row[..=block].iter().rev()) {
                for (w, right) in w[0].iter().zip(right) {
                    subtract::<S>(&mut sum, *w, right);
                }
            }
            sum
        });
        // 2 Hj e e^T Hk-j, of the off-diagonal entry one triangle: both orders of each pair are summed.
        let mut products = [[0.0; LANES]; 3];
        let [by_vv, by_uu, by_uv] = &mut products;
        for left in 1..order {
            let factors = self.uu.row(left)[..=block].iter().zip(&self.uv.row(left)[..=block]);
            let (uu, uv) = (&self.uu.row(order - left)[..=block], &self.uv.row(order - left)[..=block]);
            for ((left_uu, left_uv), (right_uu, right_uv)) in factors.zip(uu.iter().rev().zip(uv.iter().rev())) {
                for power in 0..LANES {
                    subtract::<S>(by_uu, left_uu[0][power], &right_uu[power]);
                    subtract::<S>(by_uv, left_uu[0][power], &right_uv[power]);
                    subtract::<S>(by_vv, left_uv[0][power], &right_uv[power]);
                }
            }
        }
        for (sum, once) in [&mut vv, &mut uu, &mut uv].into_iter().zip(products) {
            *sum = std::array::from_fn(|i| sum[i] + 2.0 * once[i]);
        }
        [vv, uu, uv]
    }
}

/// All orders, in the vectors that the machine has.
struct Rise<'a> {
    orders: &'a mut Orders,
    grade: &'a Rows,
    terms: usize,
}

impl WithSimd for Rise<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { orders, grade, terms } = self;
        for order in 1..=terms {
            let count = terms + 1 - order;
            for block in 0..count.div_ceil(LANES) {
                let [vv, uu, uv] = orders.right::<S>(order, block, grade);
                // What lies beyond the degrees that the order before determines stays zero.
                for i in 0..LANES.min(count - LANES * block) {
                    let own = solved(SurfaceFlexibility { vv: vv[i], uu: uu[i], uv: uv[i] });
                    let degree = LANES * block + i;
                    orders.vv.set(order, degree, own.vv);
                    orders.uu.set(order, degree, own.uu);
                    orders.uv.set(order, degree, own.uv);
                }
            }
        }
    }
}

impl Rows {
    /// Zeros.
    fn new(count: usize, degrees: usize) -> Self {
        let length = degrees.div_ceil(LANES) + 1;
        Self { blocks: vec![Block::default(); count * length], length }
    }

    #[inline(always)]
    fn row(&self, order: usize) -> &[Block] {
        &self.blocks[order * self.length..][..self.length]
    }

    #[inline(always)]
    fn set(&mut self, order: usize, degree: usize, value: f64) {
        let row = &mut self.blocks[order * self.length..][..self.length];
        for (power, raised) in (degree..degree + LANES).enumerate() {
            row[raised / LANES][power][raised % LANES] = value;
        }
    }
}

/// A block of a row's derivative.
#[inline(always)]
fn derivative(row: &[Block], block: usize) -> [f64; LANES] {
    let ([_, higher @ ..], [next, ..]) = (row[block][0], row[block + 1][0]);
    let [a, b, c] = higher;
    let low = (LANES * block) as f64;
    [(low + 1.0) * a, (low + 2.0) * b, (low + 3.0) * c, (low + 4.0) * next]
}

/// `sum -= factor terms`.
#[inline(always)]
fn subtract<S: Simd>(sum: &mut [f64; LANES], factor: f64, terms: &[f64; LANES]) {
    *sum = std::array::from_fn(|i| fused::<S>(-factor, terms[i], sum[i]));
}
