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
    for n in [6, 8, 11, 16, 22, 32, 45, 64, 90] {
        for u in [2.6, 2.8, 3.0, 3.2, 3.4, 3.6, 3.8, 4.0, 4.2, 4.4, 4.6] {
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
