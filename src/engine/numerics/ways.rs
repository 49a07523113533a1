//! Nodes for integrals over the half-width of a growing contact.

use slipzone_api::Shelf;
use slipzone_api::double_exponential::{self, Node};
use std::sync::{Arc, OnceLock};

/// Sets of nodes.
const WAYS: usize = 6;
/// By how much in `ln b'` each reaches farther than the one before.
const FARTHER: f64 = 1.5;
/// Power of the variable of Gauss and Legendre that is the part of the way: square roots at its beginning become
/// powers, and a logarithm beside one goes with the sixth.
const GATHERED: i32 = 4;

/// Points kept of each kind.
const KEPT: usize = 1 << 16;

static GATHERED_WAYS: Shelf<usize, Way> = Shelf::new(KEPT, Vec::len);
static CROWDED_WAYS: Shelf<usize, Way> = Shelf::new(KEPT, Vec::len);
static GRIDS: Shelf<usize, Vec<Node>> = Shelf::new(KEPT, Vec::len);
static ROUGH_GRIDS: Shelf<usize, Vec<Node>> = Shelf::new(KEPT, Vec::len);

/// Parts of a way, and their weights.
type Way = Vec<[f64; 2]>;

/// Nodes for ways of every length, more of them for longer ones; made when first asked for.
pub(crate) struct Ways {
    /// How many they are, and where they are kept.
    nodes: [usize; WAYS],
    kept: &'static Shelf<usize, Way>,
    make: fn(usize) -> Way,
    made: [OnceLock<Arc<Way>>; WAYS],
}

impl Ways {
    /// Where what is integrated begins like a power.
    pub(crate) fn gathered(nodes: usize) -> Self {
        Self::new(std::array::from_fn(|i| nodes * (5 + i) / 3), &GATHERED_WAYS, gathered)
    }

    /// Where something may happen just before the way begins.
    pub(crate) fn crowded(nodes: usize) -> Self {
        Self::new(std::array::from_fn(|i| nodes * (2 + i) / 2), &CROWDED_WAYS, crowded)
    }

    fn new(nodes: [usize; WAYS], kept: &'static Shelf<usize, Way>, make: fn(usize) -> Way) -> Self {
        Self { nodes, kept, make, made: [const { OnceLock::new() }; WAYS] }
    }

    /// Shows `each` how far along a way its nodes lie, and their weights: in as many equal parts as keep each within
    /// `longest`.
    pub(crate) fn along(&self, whole: f64, longest: f64, mut each: impl FnMut(f64, f64)) {
        let parts = (whole / longest).ceil().max(1.0);
        let length = whole / parts;
        let mut part = 0.0;
        while part < parts {
            for [along, weight] in self.for_length(length) {
                each(length * (part + along), length * weight);
            }
            part += 1.0;
        }
    }

    /// The nodes for a way so long.
    fn for_length(&self, length: f64) -> &[[f64; 2]] {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most WAYS
        let i = ((length / FARTHER) as usize).min(WAYS - 1);
        self.made[i].get_or_init(|| self.kept.get(self.nodes[i], || (self.make)(self.nodes[i])))
    }
}

/// A double-exponential grid of unit length.
pub(crate) fn grid(nodes: usize) -> Arc<Vec<Node>> {
    GRIDS.get(nodes, || double_exponential::nodes(1.0, nodes))
}

/// One that ends sooner, at a hundred-thousandth of its length.
pub(crate) fn rough_grid(nodes: usize) -> Arc<Vec<Node>> {
    const END: f64 = 2.0;
    ROUGH_GRIDS.get(nodes, || double_exponential::nodes_up_to(1.0, nodes, END))
}

/// Gauss and Legendre.
fn gathered(nodes: usize) -> Way {
    let rule = bilby::GaussLegendre::new(nodes).expect("nodes").rule().clone();
    let each = rule.nodes.iter().zip(&rule.weights).map(|(node, weight)| {
        let at = 0.5 * (1.0 + node);
        [at.powi(GATHERED), 0.5 * weight * f64::from(GATHERED) * at.powi(GATHERED - 1)]
    });
    each.collect()
}

/// A double-exponential grid: it tells what happens at any distance.
fn crowded(nodes: usize) -> Way {
    double_exponential::nodes(1.0, nodes).iter().map(|node| [node.from_lower, node.weight]).collect()
}
