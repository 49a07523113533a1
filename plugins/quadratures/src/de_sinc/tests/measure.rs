use super::*;
use std::f64::consts::PI;

fn graded() -> Made<impl Fn(f64) -> Parts + Send + Sync> {
    Made { parts: |t: f64| Parts { smooth: -0.6 * t / (1.0 + t * t), sign: 0.8 / (4.0 + t * t), log: 0.6 * t / (4.0 + t * t) }, length: 1.3 }
}

#[test]
#[ignore]
fn table() {
    let k = graded();
    let mut fine = rule_of(1.0, Parity::Even, Edge::Sharp, Resolution { n: 160, u_max: 4.8 });
    let fu = flat_punch(&mut fine, Some(&k));
    let (fe, p0) = (fine.edge_factor(&fu), pressure(&fine, &fu, 0.0, 1.0));
    let mut fine2 = rule_of(1.0, Parity::Even, Edge::Sharp, Resolution { n: 120, u_max: 4.6 });
    let fu2 = flat_punch(&mut fine2, Some(&k));
    println!("ref {fe} {p0} {:e}", fine2.edge_factor(&fu2)/fe - 1.0);
    for n in [6, 8, 11, 16, 22, 32, 64] {
        for u in [2.0, 2.2, 2.4, 2.6, 2.8, 3.0, 3.2, 3.4] {
            let mut r = rule_of(1.0, Parity::Even, Edge::Sharp, Resolution { n, u_max: u });
            let h = flat_punch(&mut r, None);
            let eh = r.edge_factor(&h) * PI - 1.0;
            let g = flat_punch(&mut r, Some(&k));
            let e = |gap: f64| pressure(&r, &g, 1.0 - gap, gap) / pressure(&fine, &fu, 1.0 - gap, gap) - 1.0;
            println!("{n:3} {u:.1} half {eh:9.1e} p(0) {:9.1e} | edge {:9.1e} p0 {:9.1e} p(.37) {:9.1e} gap 1e-2 {:9.1e} 1e-6 {:9.1e} 1e-12 {:9.1e}",
                pressure(&r, &h, 0.0, 1.0) * PI - 1.0,
                r.edge_factor(&g) / fe - 1.0, pressure(&r, &g, 0.0, 1.0) / p0 - 1.0, e(0.63), e(1e-2), e(1e-6), e(1e-12));
        }
    }
}

/// Stick zone under a flat punch of unit half-width and force on a half-plane: unknowns and eta/beta.
pub(super) fn stick(a: f64, one_minus: f64, resolution: Resolution) -> (DeSincRule, Vec<f64>, f64) {
    let mut rule = rule_of(a, Parity::Odd, Edge::Continued, resolution);
    let n = rule.unknowns();
    let rows = operator(&mut rule, None);
    let scale = rule.row_scale().unwrap().to_vec();
    let edge = rule.edge_condition().unwrap().to_vec();
    let mut matrix = Vec::new();
    let mut right = Vec::new();
    let root = (one_minus * (1.0 + a)).sqrt();
    for ((row, s), at) in rows.chunks(n).zip(&scale).zip(rule.collocation()) {
        let b = ((one_minus + at.gap) * (1.0 + at.x)).sqrt();
        let slip = -((b + root).powi(2) / (at.gap * (a + at.x))).ln() / (PI * PI * b);
        matrix.extend_from_slice(row);
        matrix.push(s * slip);
        right.push(-s / (PI * b));
    }
    matrix.extend_from_slice(&edge);
    matrix.push(0.0);
    right.push(0.0);
    let x = solve(&matrix, &right);
    let eta = x[n];
    (rule, x[..n].to_vec(), eta)
}

#[test]
#[ignore]
fn stick_table() {
    use slipzone_api::reference::partial_slip::{Stick, friction};
    for one in [0.999, 0.5, 1e-2, 1e-6, 1e-12] {
        let zone = Stick::from_one_minus_ratio(one);
        let exact = friction(zone, 1.0);
        for n in [6, 8, 11, 16, 22, 32, 45, 64, 128] {
            let mut line = format!("1-k {one:e} n {n:3} ");
            for u in [resolution::reach(n, Edge::Continued)] {
                let (rule, q, eta) = stick(zone.ratio, one, Resolution { n, u_max: u });
                let (fr, fq, fe) = stick(zone.ratio, one, Resolution { n: 300, u_max: 4.2 });
                let v = |r: &DeSincRule, q: &[f64], e: f64, g: f64| { let g = g * one; r.value(Density { unknowns: q, carrier: e / (PI * (one * (1.0 + zone.ratio)).sqrt()) }, Station { x: zone.ratio - g, gap: g }) };
                let d = |g: f64| v(&rule, &q, eta, g) / v(&fr, &fq, fe, g) - 1.0;
                line += &format!(" | {u:.1} {:9.1e} q {:9.1e} {:9.1e} {:9.1e}", eta / exact - 1.0, d(0.1 * zone.ratio), d(1e-5), d(1e-10));
            }
            println!("{line}");
        }
    }
}

/// Parabola pressed so that it touches over [-1, 1]; curvature as unknown scale: p, force.
fn parabola(resolution: Resolution, kernel: Option<&dyn KernelTable>) -> (DeSincRule, Vec<f64>) {
    let mut rule = rule_of(1.0, Parity::Even, Edge::Smooth, resolution);
    let n = rule.unknowns();
    let mut matrix = operator(&mut rule, kernel.map(|k| (k, Component::NormalSlope)));
    matrix.extend_from_slice(rule.edge_condition().unwrap());
    let mut right: Vec<f64> = rule.collocation().iter().zip(rule.row_scale().unwrap()).map(|(v, s)| s * v.x * (1.0 + v.x * v.x)).collect();
    right.push(0.0);
    let x = solve(&matrix, &right);
    assert_eq!(x.len(), n);
    (rule, x)
}

#[test]
#[ignore]
fn smooth_table() {
    let k = graded();
    let (fine, fu) = parabola(Resolution { n: 200, u_max: 4.4 }, Some(&k));
    let force = |r: &DeSincRule, u: &[f64]| { let mut row = vec![0.0; u.len()]; r.resultant_into(&mut row); rule::dot(&row, u) };
    for n in [6, 8, 11, 16, 22, 32, 45, 64] {
        for u in [2.6, 2.9, 3.2, 3.5, 3.8, 4.1, 4.4, resolution::reach(n, Edge::Smooth)] {
            let (r, x) = parabola(Resolution { n, u_max: u }, Some(&k));
            let (h, y) = parabola(Resolution { n, u_max: u }, None);
            let e = |g: f64| pressure(&r, &x, 1.0 - g, g) / pressure(&fine, &fu, 1.0 - g, g) - 1.0;
            // x (1 + x^2) = sqrt(1-x^2) U: T1 + (T3 + 3 T1)/4 -> (7/4) U0 + U2/4 
            let exact = |t: f64| 1.75 + 0.25 * (4.0 * t * t - 1.0);
            let g = 1e-8;
            println!("{n:3} {u:.2} half force {:9.1e} p(.5) {:9.1e} p(1e-8) {:9.1e} | force {:9.1e} p0 {:9.1e} gap .63 {:9.1e} 1e-2 {:9.1e} 1e-6 {:9.1e} 1e-12 {:9.1e}",
                force(&h, &y) / PI - 1.0, pressure(&h, &y, 0.5, 0.5) / exact(0.5) / 0.75_f64.sqrt() - 1.0, pressure(&h, &y, 1.0-g, g) / exact(1.0-g) / (g * (2.0-g)).sqrt() - 1.0,
                force(&r, &x) / force(&fine, &fu) - 1.0, e(1.0), e(0.63), e(1e-2), e(1e-6), e(1e-12));
        }
    }
}

#[test]
#[ignore]
fn noise() {
    let (rule, q, eta) = stick(0.5, 0.5, Resolution { n: 32, u_max: 3.9 });
    let grid = resolution::grid(Resolution { n: 32, u_max: 3.9 }, true, Edge::Continued);
    let carrier = eta / (PI * 0.75_f64.sqrt());
    for (f, u) in q.iter().zip(&grid.nodes[1..]) {
        println!("{:.3} w {:.2} F {f:.6e} f {:.12e} y {:.6e}", u.u, u.w, f / u.sech, (f / u.sech - carrier * u.x) / u.sech);
    }
    let _ = rule;
}
