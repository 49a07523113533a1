//! Sign, logarithmic and smooth parts.

use super::*;

/// Targets for potentials: ends, middle, and places on and off the nodes.
const TARGETS: [f64; 7] = [-0.5, -0.31, 0.0, 0.123, 0.499, 0.499_999_999, 0.5];

fn potential(
    rule: &mut dyn Rule,
    unknowns: &[f64],
    kernel: &dyn KernelTable,
    component: Component,
    c: f64,
) -> Vec<f64> {
    let (mut samples, mut out) = (Vec::new(), vec![0.0; TARGETS.len()]);
    let at = TARGETS.map(|x: f64| Station { x, gap: c - x.abs() });
    rule.sample_potential(unknowns, (kernel, component), &mut samples);
    rule.potential_into(&samples, (kernel, component), &at, &mut out);
    out
}

#[test]
fn potentials_of_jump_and_logarithm() {
    let c = 0.5;
    // Sharp, F = 1: int log|x - r|/sqrt(c^2 - r^2) dr = pi ln(c/2); int sign = pi - 2 acos(x/c). Smooth,
    // F = sin: int sqrt(1 - t^2) log|x - ct| c dt = c pi/2 (ln(c/2) + t^2 - 1/2). Odd, F = cos:
    // int t log|x - ct|/sqrt(1 - t^2) dt = -pi t.
    // Lengths below the half-width cut the panels into pieces.
    for length in [1.0, 0.07] {
        let (jump, logarithm) = (jump(length), logarithm(length));
        for (parity, edge) in [(Parity::Even, Edge::Sharp), (Parity::Even, Edge::Smooth), (Parity::Odd, Edge::Sharp)] {
            let (nodes, panels) = (14, 4);
            let mut rule = rule(c, parity, edge, nodes, panels);
            let unknowns = unknowns(parity, edge, nodes, panels, |a| match (parity, edge) {
                (Parity::Even, Edge::Sharp) => 1.0,
                (Parity::Even, _) => a.sin(),
                (Parity::Odd, _) => a.cos(),
            });
            let by_log = potential(rule.as_mut(), &unknowns, &logarithm, Component::Coupling, c);
            let by_jump = potential(rule.as_mut(), &unknowns, &jump, Component::NormalSlope, c);
            for ((x, by_log), by_jump) in TARGETS.iter().zip(by_log).zip(by_jump) {
                let t: f64 = x / c;
                let root = (1.0 - t * t).max(0.0).sqrt();
                let (log, sign) = match (parity, edge) {
                    (Parity::Even, Edge::Sharp) => (c * (0.5 * c).ln(), c * (1.0 - 2.0 * t.acos() / PI)),
                    (Parity::Even, _) => (0.5 * c * ((0.5 * c).ln() + t * t - 0.5), c * (t * root + t.asin()) / PI),
                    (Parity::Odd, _) => (-c * t, -2.0 * c * root / PI),
                };
                assert_close(by_log, log, 1e-13, &format!("logarithm, {parity:?} {edge:?} at {t}"));
                assert_close(by_jump, sign, 1e-13, &format!("jump, {parity:?} {edge:?} at {t}"));
            }
        }
    }
}

#[test]
fn rows_of_jump_and_logarithm_are_exact() {
    let (c, nodes, panels) = (0.7, 14, 4);
    let mut rule = rule(c, Parity::Even, Edge::Sharp, nodes, panels);
    let unknowns = unknowns(Parity::Even, Edge::Sharp, nodes, panels, |a| (2.0 * a).cos());
    let plain = operator(rule.as_mut(), None);
    let stations = rule.collocation().to_vec();
    let scale = row_scale(rule.as_ref());
    let mut share = |kernel: Made| {
        let rows = operator(rule.as_mut(), Some((&kernel, Component::NormalSlope)));
        let only: Vec<f64> = rows.iter().zip(&plain).map(|(all, plain)| all - plain).collect();
        apply(&only, &unknowns)
    };
    // T_2/sqrt: int T_k sign(x - r)/sqrt = -2 sin(k alpha)/k, int T_k log|x - r|/sqrt = -pi cos(k alpha)/k.
    for (((by_jump, by_log), at), scale) in share(jump(1.0)).iter().zip(share(logarithm(1.0))).zip(&stations).zip(scale)
    {
        let alpha = 2.0 * (0.5 * at.gap / c).sqrt().asin();
        assert_close(*by_jump, -scale * c * (2.0 * alpha).sin() / PI, 1e-13, "jump");
        assert_close(by_log, -scale * c * (2.0 * alpha).cos() / 2.0, 1e-13, "logarithm");
    }
}

/// A smooth part with poles at `+-i length`: `int k(x - r)/sqrt(1 - r^2) dr` with `k = l^2/(l^2 + t^2)` is
/// `pi l Re(1/sqrt(l^2 + ...))`: `Re[pi l/sqrt((l + ix)^2 + 1)]`.
#[test]
fn a_kernel_shorter_than_the_panels_is_resolved() {
    for length in [2.0, 0.3, 0.01] {
        let parts = |t: f64| Parts { smooth: length * length / (length * length + t * t), ..Parts::default() };
        let made = Made { parts, length };
        let mut rule = rule(1.0, Parity::Even, Edge::Sharp, 8, 3);
        let plain = operator(rule.as_mut(), None);
        let rows = operator(rule.as_mut(), Some((&made, Component::Coupling)));
        let only: Vec<f64> = rows.iter().zip(&plain).map(|(all, plain)| all - plain).collect();
        let got = apply(&only, &vec![1.0; rule.unknowns()]);
        for ((got, at), scale) in got.iter().zip(rule.collocation()).zip(row_scale(rule.as_ref())) {
            // sqrt(z), z = (l + ix)^2 + 1 = u + iv: 1/sqrt(z) has the real part sqrt((|z| + u)/2)/|z|.
            let (u, v) = (length * length - at.x * at.x + 1.0, 2.0 * length * at.x);
            let size = u.hypot(v);
            let exact = length * (0.5 * (size + u)).sqrt() / size;
            // Rounding of x beside length: 1e-16/length.
            assert_close(*got, scale * exact, 1e-13 + 1e-15 / length, &format!("length {length}, x = {}", at.x));
        }
    }
}

/// What the rows say at the collocation points, the samples say between the nodes.
#[test]
fn potentials_between_the_nodes_agree_with_the_rows() {
    let length = 0.6;
    let parts = |t: f64| {
        let square = length * length + t * t;
        Parts { smooth: (t / length).cos(), sign: length / square, log: t / square }
    };
    let made = Made { parts, length };
    let (nodes, panels) = (16, 6);
    for (parity, edge) in [(Parity::Even, Edge::Sharp), (Parity::Odd, Edge::Continued), (Parity::Even, Edge::Smooth)] {
        let mut rule = rule(1.0, parity, edge, nodes, panels);
        // gap log gap at the end; odd in x, or even and smooth in the middle.
        let unknowns = unknowns(parity, edge, nodes, panels, |a| {
            let log = (0.5 * a).tan().max(f64::MIN_POSITIVE).ln();
            let odd = a.cos() * a.sin() * (1.0 - a.sin() * a.cos() * log);
            if parity == Parity::Odd { odd } else { a.cos() * odd }
        });
        let cauchy = apply(&operator(rule.as_mut(), None), &unknowns);
        let whole = apply(&operator(rule.as_mut(), Some((&made, Component::NormalSlope))), &unknowns);
        let scale = row_scale(rule.as_ref());
        let stations = rule.collocation().to_vec();
        let (mut samples, mut out) = (Vec::new(), vec![0.0; stations.len()]);
        rule.sample_potential(&unknowns, (&made, Component::NormalSlope), &mut samples);
        rule.potential_into(&samples, (&made, Component::NormalSlope), &stations, &mut out);
        for ((got, scale), (whole, cauchy)) in out.iter().zip(scale).zip(whole.iter().zip(&cauchy)) {
            // Measured: 1e-13; the potential varies no faster than the density.
            assert_close(scale * got, whole - cauchy, 2e-12, &format!("{parity:?} {edge:?}"));
        }
    }
}

#[test]
fn a_stretched_rule_is_a_new_one() {
    let made = Made { parts: |t| Parts { smooth: t / 0.4, sign: 1.0, log: t }, length: 0.4 };
    for (parity, edge) in [(Parity::Even, Edge::Sharp), (Parity::Odd, Edge::Continued), (Parity::Even, Edge::Smooth)] {
        let mut fresh = rule(3.1, parity, edge, 6, 4);
        let mut stretched = rule(0.2, parity, edge, 6, 4);
        let _ = operator(stretched.as_mut(), Some((&made, Component::NormalSlope)));
        stretched.stretch(3.1);
        assert_eq!(fresh.collocation(), stretched.collocation());
        let rows = |rule: &mut dyn Rule| operator(rule, Some((&made, Component::NormalSlope)));
        assert_eq!(rows(fresh.as_mut()), rows(stretched.as_mut()), "{parity:?} {edge:?}");
        let resultant = |rule: &dyn Rule| {
            let mut row = vec![0.0; rule.unknowns()];
            rule.resultant_into(&mut row);
            row
        };
        assert_eq!(resultant(fresh.as_ref()), resultant(stretched.as_ref()));
    }
}

/// The pole that `x = 0` shares with its mirror image fell inside the last piece by rounding, for one length in
/// ten, and `sign(x + r)` was taken to change there.
#[test]
fn the_middle_is_on_one_side_whatever_the_pieces() {
    let c = 1.47;
    let unknowns = unknowns(Parity::Even, Edge::Sharp, 8, 3, |_| 1.0);
    for i in 0..40 {
        // |t| = sign(t) t; (1/pi) int |r|/sqrt(1 - (r/c)^2) dr = 2 c^2/pi.
        let length = 0.08 + 0.01 * f64::from(i);
        let distance = Made { parts: |t| Parts { sign: t, ..Parts::default() }, length };
        let mut rule = rule(c, Parity::Even, Edge::Sharp, 8, 3);
        let got = rule.potential_at_centre(&unknowns, (&distance, Component::Depth));
        assert_close(got, 2.0 * c * c / PI, 1e-13, &format!("length {length}"));
    }
}

/// `|t|^(p - 1)`, down to a distance or, known as a power, to nothing.
#[derive(Clone, Copy)]
struct Power {
    exponent: f64,
    nearest: f64,
    is_known: bool,
}

impl KernelTable for Power {
    fn parts_into(&self, _: Component, distances: &[f64], out: PartsMut) {
        let least = if self.is_known { 0.0 } else { self.nearest };
        out.fill(distances, |t| Parts { smooth: t.abs().max(least).powf(self.exponent - 1.0), ..Parts::default() });
    }

    fn length(&self) -> f64 {
        1.0
    }

    fn nearest(&self) -> Option<f64> {
        Some(self.nearest)
    }

    fn power(&self) -> Option<f64> {
        self.is_known.then_some(self.exponent)
    }

    fn flexibility_evaluations(&self) -> usize {
        0
    }
}

/// A kernel singular like a power of the distance: `int |x - r|^(p-1)/sqrt(1 - r^2) dr` is `B(p/2, 1/2)` in the middle;
/// elsewhere rules of different panels agree.
#[test]
fn a_broken_power_at_the_origin_is_summed() {
    // Gamma(1/4) Gamma(1/2)/Gamma(3/4) and Gamma(3/4) Gamma(1/2)/Gamma(5/4).
    for (p, beta) in [(0.5, 5.244_115_108_584_24), (1.5, 2.396_280_469_471_184)] {
        let power = Power { exponent: p, nearest: 1e-26, is_known: false };
        let at = |nodes: usize, panels: usize| {
            let mut rule = rule(1.0, Parity::Even, Edge::Sharp, nodes, panels);
            let unknowns = unknowns(Parity::Even, Edge::Sharp, nodes, panels, |_| 1.0);
            let centre = rule.potential_at_centre(&unknowns, (&power, Component::Coupling));
            let plain = operator(rule.as_mut(), None);
            let rows = operator(rule.as_mut(), Some((&power, Component::Coupling)));
            let only: Vec<f64> = rows.iter().zip(&plain).map(|(all, plain)| all - plain).collect();
            (centre, apply(&only, &unknowns), rule.collocation().to_vec(), row_scale(rule.as_ref()))
        };
        let (centre, ..) = at(12, 4);
        assert_close(centre, beta / PI, 2e-12, &format!("p = {p}"));
        // Three times the nodes have the middle one of each three in common.
        let ((_, coarse, places, scales), (_, fine, ..)) = (at(6, 4), at(18, 4));
        for (i, (coarse, (place, scale))) in coarse.iter().zip(places.iter().zip(scales)).enumerate() {
            assert_close(*coarse / scale, fine[3 * i + 1] / scale, 3e-9, &format!("p = {p} at {}", place.x));
        }
    }
}

/// The same where densities are told in a root of the angle: the kernel is a power down to nothing, next to the target
/// and at the contact's end.
#[test]
fn a_power_of_the_distance_is_summed_in_a_root_of_the_angle() {
    // Gamma(p/2) Gamma(1/2)/Gamma((p + 1)/2); 12 p is whole but for one.
    for (p, beta, tolerance) in [
        (0.2, 11.323_086_975_215_753, 1e-9),
        (0.35, 6.995_838_320_487_95, 2e-7),
        (0.5, 5.244_115_108_584_24, 1e-9),
        (0.8, 3.679_093_980_405_880_4, 1e-9),
    ] {
        let power = Power { exponent: p, nearest: 1e-3, is_known: true };
        let at = |nodes: usize| {
            let pinned = GradedPanels { nodes: Some(Count(nodes)), panels: Some(Count(3)), ..GradedPanels::default() };
            let quadrature = pinned.under(p).expect("a root of its own");
            let mut rule = quadrature.rule(&Span::symmetric(1.0, Parity::Even, Edge::Sharp)).unwrap();
            let plain = operator(rule.as_mut(), None);
            let rows = operator(rule.as_mut(), Some((&power, Component::Coupling)));
            let only: Vec<f64> = rows.iter().zip(&plain).map(|(all, plain)| all - plain).collect();
            let unknowns = vec![1.0; rule.unknowns()];
            let slopes = apply(&plain, &unknowns);
            let scaled = apply(&only, &unknowns);
            (rule, slopes, scaled)
        };
        let (mut rule, slopes, _) = at(12);
        let unknowns = vec![1.0; rule.unknowns()];
        let centre = rule.potential_at_centre(&unknowns, (&power, Component::Coupling));
        assert_close(centre, beta / PI, 2e-11, &format!("p = {p}"));
        // 1/sqrt(1 - x^2) makes no slope at all.
        for (slope, place) in slopes.into_iter().zip(rule.collocation()) {
            assert_close(slope, 0.0, 1e-12, &format!("slope, p = {p} at {}", place.x));
        }
        // Three times the nodes have the middle one of each three in common.
        let ((rule, _, coarse), (_, _, fine)) = (at(6), at(18));
        for (i, (place, scale)) in rule.collocation().iter().zip(row_scale(rule.as_ref())).enumerate() {
            // As large as it grows towards the end; what beside it is rounded is the slope's part.
            let size = scale * place.gap.powf((p - 0.5).min(0.0));
            let what = format!("p = {p} at a gap of {:e}", place.gap);
            assert_close(coarse[i], fine[3 * i + 1], tolerance * size + 1e-14, &what);
        }
    }
}

/// A jump and a logarithm, as of a kernel that tells them where the law begins with a broken power all the same:
/// against `1/sqrt(1 - r^2)` the one is `2 asin(x)/pi`, the other `-log 2`.
#[test]
fn jumps_and_logarithms_are_integrated_in_a_root_of_the_angle() {
    for p in [0.2, 0.5, 0.8] {
        let pinned = GradedPanels { nodes: Some(Count(12)), panels: Some(Count(4)), ..GradedPanels::default() };
        let quadrature = pinned.under(p).expect("a root of its own");
        let mut rule = quadrature.rule(&Span::symmetric(1.0, Parity::Even, Edge::Sharp)).unwrap();
        let unknowns = vec![1.0; rule.unknowns()];
        let plain = apply(&operator(rule.as_mut(), None), &unknowns);
        for (table, component) in [(jump(1.0), Component::NormalSlope), (logarithm(1.0), Component::Coupling)] {
            let all = apply(&operator(rule.as_mut(), Some((&table, component))), &unknowns);
            let places = rule.collocation().iter().zip(row_scale(rule.as_ref()));
            for ((all, plain), (place, scale)) in all.iter().zip(&plain).zip(places) {
                let expected =
                    if component.is_odd() { 1.0 - 4.0 / PI * (0.5 * place.gap).sqrt().asin() } else { -2.0_f64.ln() };
                let what = format!("p = {p}, {component:?} at a gap of {:e}", place.gap);
                assert_close(all - plain, scale * expected, 1e-12, &what);
            }
            // And sampled at the contact's end itself, where all that is left of the logarithm is one of `u`.
            let mut samples = Vec::new();
            rule.sample_potential(&unknowns, (&table, component), &mut samples);
            let expected = if component.is_odd() { 1.0 } else { -2.0_f64.ln() };
            assert_close(samples[0], expected, 1e-9, &format!("p = {p}, {component:?} at the end"));
        }
    }
}
