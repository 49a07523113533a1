//! Brings a grading of its own, registered in this file, and shows what a law gains by telling more than its modulus.
//!
//! Three laws, each from 1 at the surface to 8 at the base: smooth, with a kink, with a jump. Each is solved knowing
//! its modulus alone; then with its Taylor coefficients at the surface; then with the place of the kink or jump; then
//! with what the law is made of, `exponent` or `sublayers`. The answers agree, the work does not: docs/layers.md has
//! the table. Run it with `cargo run --release --example own_grading`.

use serde::{Deserialize, Serialize};
use slipzone::engine::{Status, solve};
use slipzone::scene::parse;
use slipzone_api::{Grading, ModulusLaw, Refusal, Setting, Sublayer};
use std::time::Instant;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Shape {
    /// `8^depth`.
    Smooth,
    /// Linear down to `BREAK`, constant below.
    Kink,
    /// 1 down to `BREAK`, 8 below.
    Jump,
}

/// What is told beside the modulus, each of them with all before it.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Tells {
    Modulus,
    Series,
    Breakpoints,
    All,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Told {
    shape: Shape,
    tells: Tells,
}

slipzone_api::register!(Grading, "told", "one of three laws, and how much of it is told",
    example: "type = \"told\"\nshape = \"smooth\"\ntells = \"modulus\"",
    parameters: [
        ("shape", "\"smooth\", \"kink\" or \"jump\"", true, [], OneOf(&["smooth", "kink", "jump"])),
        ("tells", "\"modulus\", \"series\", \"breakpoints\" or \"all\"", true, [], OneOf(&["modulus", "series", "breakpoints", "all"])),
    ],
    source: "examples/own_grading.rs");

#[typetag::serde(name = "told")]
impl Grading for Told {
    fn law(&self, _: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let parts = match self.shape {
            _ if self.tells < Tells::All => vec![],
            Shape::Smooth => vec![],
            Shape::Kink => vec![(BREAK, 1.0, 8.0), (1.0 - BREAK, 8.0, 8.0)],
            Shape::Jump => vec![(BREAK, 1.0, 1.0), (1.0 - BREAK, 8.0, 8.0)],
        };
        let part =
            |(thickness, top, bottom): (f64, f64, f64)| Sublayer { thickness, law: Box::new(Line { top, bottom }) };
        Ok(Box::new(Law { told: self.clone(), sublayers: parts.into_iter().map(part).collect() }))
    }
}

/// Depth of the kink and of the jump, in thicknesses.
const BREAK: f64 = 0.3;

#[derive(Debug)]
struct Law {
    told: Told,
    sublayers: Vec<Sublayer>,
}

impl ModulusLaw for Law {
    // All that is required.
    fn modulus(&self, depth: f64) -> f64 {
        match self.told.shape {
            Shape::Smooth => 8.0_f64.powf(depth),
            Shape::Kink => 1.0 + 7.0 * (depth / BREAK).min(1.0),
            Shape::Jump => {
                if depth < BREAK {
                    1.0
                } else {
                    8.0
                }
            }
        }
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let known = if self.told.tells >= Tells::Series { terms } else { terms.min(1) };
        let mut series = vec![0.0; known];
        if let Some(first) = series.first_mut() {
            *first = 1.0;
        }
        match self.told.shape {
            Shape::Smooth => {
                for k in 1..known {
                    series[k] = series[k - 1] * 8.0_f64.ln() / k as f64;
                }
            }
            Shape::Kink if known > 1 => series[1] = 7.0 / BREAK,
            Shape::Kink | Shape::Jump => {}
        }
        series
    }

    fn breakpoints(&self) -> &[f64] {
        if self.told.tells >= Tells::Breakpoints && self.told.shape != Shape::Smooth { &[BREAK] } else { &[] }
    }

    fn exponent(&self) -> Option<f64> {
        (self.told.tells == Tells::All && self.told.shape == Shape::Smooth).then(|| 8.0_f64.ln())
    }

    fn sublayers(&self) -> &[Sublayer] {
        &self.sublayers
    }
}

/// A sublayer's law, from one modulus to another.
#[derive(Debug)]
struct Line {
    top: f64,
    bottom: f64,
}

impl ModulusLaw for Line {
    fn modulus(&self, depth: f64) -> f64 {
        self.top + (self.bottom - self.top) * depth
    }

    fn exponent(&self) -> Option<f64> {
        (self.top - self.bottom == 0.0).then_some(0.0)
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        (0..terms).map(|k| [1.0, self.bottom / self.top - 1.0].get(k).copied().unwrap_or(0.0)).collect()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("shape    tells         edge.ratio     flexibilities    time");
    for shape in ["smooth", "kink", "jump"] {
        let mut least_told = None;
        for tells in ["modulus", "series", "breakpoints", "all"] {
            let scene = parse(
                "own_grading",
                &format!(
                    r#"
                    format = 1
                    layer = {{ thickness = 5.0, poisson = 0.3, grading = {{ type = "told", shape = "{shape}", tells = "{tells}" }} }}
                    punch = {{ type = "flat", half_width = 1.0 }}
                    load = {{ force = 1.0 }}
                    "#
                ),
            )?;
            let solution = solve(&scene);
            assert_eq!(solution.status, Status::Converged, "{shape}, {tells}: {:?}", solution.reason);
            let ratio = solution.edge.ratio.ok_or("a converged solution has an edge")?;
            let expected = *least_told.get_or_insert(ratio);
            assert!((ratio / expected - 1.0).abs() < 2e-8, "{shape}, {tells}: {ratio}, told less {expected}");
            let mut times: Vec<_> = (0..15)
                .map(|_| {
                    let start = Instant::now();
                    std::hint::black_box(solve(&scene));
                    start.elapsed()
                })
                .collect();
            times.sort();
            println!(
                "{shape:8} {tells:13} {ratio:.10} {:10} {:13.2} ms",
                solution.plan.flexibility_evaluations,
                times[7].as_secs_f64() * 1e3
            );
        }
    }
    Ok(())
}
