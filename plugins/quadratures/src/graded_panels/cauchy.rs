//! The Cauchy part in the angle.

use super::basis::Basis;
use super::legendre::{Factor, Gauss};
use super::mesh::Mesh;
use super::pieces::{Piece, Pieces};
use slipzone_api::Parity;
use std::f64::consts::PI;

/// Distance of a pole from the middle of a piece, in half-lengths, from which on a piece is summed by Gauss.
///
/// `2.85^-(2 q - m)` is then left, at most 2e-14 of the piece's share. Seen from the contact's end, every panel
/// but the first begins at 5/3: panels well outside the target's own must not be split into poles, whose
/// difference loses digits like `theta/target`.
const FAR: f64 = 1.6;

/// `row[j]` = `factor` times what the `j`-th unknown contributes to `sin(target)/pi PV int f(r)/(x - r) dr`.
///
/// With the mirror image the kernel is `cot(theta - target) - cot(theta + target)` for an even density and the
/// same with `1/sin` for an odd one. Both are `1/(theta - target) - 1/(theta + target) -+ 1/(theta + target - pi)`
/// (minus for even, plus for odd) and a rest without poles nearer than `pi/2`. Near a pole, product integration
/// of each pole and Gauss for the rest; elsewhere Gauss for the whole.
///
/// Where the angle is a power of `u`, poles in `u` are all around the origin. One next to the panel is integrated; what
/// the others leave is summed on parts of the panel that shrink towards them.
pub(super) fn row_into(
    target: f64,
    factor: f64,
    basis: Basis,
    (mesh, pieces, gauss): (&Mesh, &Pieces, &Gauss),
    summand: &mut [f64],
    row: &mut [f64],
) {
    let q = gauss.z.len();
    let even = basis.parity == Parity::Even;
    let whole = if even { even_whole } else { odd_whole };
    let rest = if even { even_rest } else { odd_rest };
    let angle = mesh.angle(target);
    let image = mesh.place_of(PI - angle);
    // What is integrated, and what is summed: in `u` the last of them lies beside the real line, but where that is the
    // angle.
    let is_angle = mesh.root == 1;
    let poles = [(target, 1.0), (image, -basis.parity.mirror()), (-target, -1.0)];
    let (products, sums) = poles.split_at(if is_angle { 3 } else { 2 });
    let (across, along) = (PI / f64::from(mesh.root)).sin_cos();
    let is_near =
        |piece: &Piece| !is_angle && piece.local(target * along).hypot(target * across / piece.half_length) <= FAR;
    let (mut moments, mut product) = (Vec::new(), vec![0.0; q]);
    let width = mesh.degree + 1;
    let (mut beside, mut values) = (vec![0.0; row.len()], vec![0.0; width]);
    for (panel, (piece, (out, at))) in
        pieces.list.iter().zip(summand.chunks_mut(q).zip(pieces.at.chunks(q))).enumerate()
    {
        let far = products.iter().all(|(pole, _)| piece.local(*pole).abs() > FAR) && !is_near(piece);
        if far {
            for ((out, w), u) in out.iter_mut().zip(&gauss.w).zip(at) {
                *out = w * piece.half_length * mesh.slope(*u) * whole(mesh.angle(*u), angle);
            }
            continue;
        }
        let smooth = |u: f64| {
            let (theta, slope) = (mesh.angle(u), mesh.slope(u));
            let of_powers: f64 = products.iter().map(|(pole, residue)| residue * mesh.rest_of_pole(u, *pole)).sum();
            let of_sums: f64 = sums.iter().map(|(_, residue)| residue * slope / (theta + angle)).sum();
            slope * rest(theta, angle) + of_powers + of_sums
        };
        if is_near(piece) {
            out.fill(0.0);
            for part in parts_of(*piece, is_near) {
                for (z, w) in gauss.z.iter().zip(&gauss.w) {
                    let u = part.lower + part.half_length * (1.0 + z);
                    let weight =
                        factor * w * part.half_length * smooth(u) * basis.measure_at(mesh, u, mesh.angle(u).sin()) / PI;
                    let offset = ((u - mesh.breaks[panel]) / mesh.half_length(panel)).clamp(0.0, 2.0);
                    mesh.basis_into(offset, &mut values);
                    for value in &mut values {
                        *value *= weight;
                    }
                    basis.add_into(panel * mesh.degree, &values, &mut beside);
                }
            }
        } else {
            for ((out, w), u) in out.iter_mut().zip(&gauss.w).zip(at) {
                *out = w * piece.half_length * smooth(*u);
            }
        }
        for (pole, residue) in products {
            let at = piece.local(*pole);
            if at.abs() <= FAR {
                gauss.product_weights_into(Factor::Pole, at, &mut moments, &mut product);
                for (out, product) in out.iter_mut().zip(&product) {
                    *out += residue * product;
                }
            } else {
                for ((out, w), z) in out.iter_mut().zip(&gauss.w).zip(&gauss.z) {
                    *out += residue * w / (z - at);
                }
            }
        }
    }
    for (out, measure) in summand.iter_mut().zip(&pieces.measure) {
        *out *= factor * measure / PI;
    }
    pieces.gather_into(summand, mesh, basis, row);
    row.iter_mut().zip(beside).for_each(|(out, beside)| *out += beside);
}

/// A piece in halves of halves, none of which is near.
fn parts_of(piece: Piece, is_near: impl Fn(&Piece) -> bool) -> Vec<Piece> {
    let (mut stack, mut parts) = (vec![piece], Vec::new());
    while let Some(part) = stack.pop() {
        let half_length = 0.5 * part.half_length;
        if is_near(&part) && half_length > 0.0 {
            let lower = part.lower + part.half_length;
            stack.extend([Piece { lower, half_length }, Piece { half_length, ..part }]);
        } else {
            parts.push(part);
        }
    }
    parts
}

/// `cot(a - b) - cot(a + b)`.
fn even_whole(a: f64, b: f64) -> f64 {
    (2.0 * b).sin() / ((a - b).sin() * (a + b).sin())
}

/// `1/sin(a - b) - 1/sin(a + b)`.
fn odd_whole(a: f64, b: f64) -> f64 {
    2.0 * a.cos() * b.sin() / ((a - b).sin() * (a + b).sin())
}

/// `cot(a - b) - cot(a + b)` without its three poles, for `a` and `b` in `[0, pi/2]`.
fn even_rest(a: f64, b: f64) -> f64 {
    let (difference, sum) = (a - b, a + b);
    // cot has the period pi: whichever pole is nearer is taken out by the series, the other added.
    let rest_of_sum = if sum < 0.5 * PI { cot_rest(sum) - 1.0 / (sum - PI) } else { cot_rest(sum - PI) - 1.0 / sum };
    cot_rest(difference) - rest_of_sum
}

/// `1/sin(a - b) - 1/sin(a + b)` without its three poles, for `a` and `b` in `[0, pi/2]`.
fn odd_rest(a: f64, b: f64) -> f64 {
    let (difference, sum) = (a - b, a + b);
    let rest_of_sum = if sum < 0.5 * PI { csc_rest(sum) + 1.0 / (sum - PI) } else { csc_rest(PI - sum) - 1.0 / sum };
    csc_rest(difference) - rest_of_sum
}

/// Below this the series, whose first term left out is then below `1e-17`; above, subtraction loses one digit.
const SERIES: f64 = 0.1;

/// `cot(z) - 1/z`.
fn cot_rest(z: f64) -> f64 {
    if z.abs() > SERIES {
        return 1.0 / z.tan() - 1.0 / z;
    }
    let s = z * z;
    -z * (1.0 / 3.0 + s * (1.0 / 45.0 + s * (2.0 / 945.0 + s * (1.0 / 4725.0 + s * (2.0 / 93555.0)))))
}

/// `1/sin(z) - 1/z`.
fn csc_rest(z: f64) -> f64 {
    if z.abs() > SERIES {
        return 1.0 / z.sin() - 1.0 / z;
    }
    let s = z * z;
    let tail = 31.0 / 15120.0 + s * (127.0 / 604_800.0 + s * (73.0 / 3_421_440.0));
    z * (1.0 / 6.0 + s * (7.0 / 360.0 + s * tail))
}
