//! Brings a punch of its own: registered in this file, named by a scene like any other, solved.
//!
//! The punch is crowned: a face of radius R between sharp corners at `|x| = half_width`, such as a flat
//! punch that was not ground quite flat. On a half-plane the answer is known. The pressure of a cylinder
//! that presses itself to the corners, `sqrt(b^2 - x^2)/(A0 R)`, carries `P0 = pi b^2/(2 A0 R)`; the rest
//! of the force rests on the corners like under a flat punch, so that
//!
//! ```text
//! p(x) = sqrt(b^2 - x^2)/(A0 R) + (P - P0)/(pi sqrt(b^2 - x^2)),        edge.ratio = (1 - P0/P)/pi.
//! ```
//!
//! With less force than P0 the corners do not touch: the pressure would have to pull there, and the
//! solution says so. Run it with `cargo run --example own_punch`; docs/adding-a-punch.md tells how such a
//! file becomes part of slipzone.

use serde::{Deserialize, Serialize};
use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::parse;
use slipzone_api::{Positive, PunchProfile, PunchShape, Refusal};
use std::f64::consts::PI;

/// `g(x) = x^2/(2 radius)` for `|x| <= half_width`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Crowned {
    half_width: Positive,
    radius: Positive,
}

slipzone_api::register!(Punch, "crowned", "slightly convex face between sharp corners",
    example: "type = \"crowned\"\nhalf_width = 1.0\nradius = 10.0",
    parameters: [
        ("half_width", "half the punch's width (length)", true, [0.1, 1.0, 10.0], Positive),
        ("radius", "radius of the face (length)", true, [1.0, 10.0, 100.0], Positive),
    ],
    source: "examples/own_punch.rs");

#[typetag::serde(name = "crowned")]
impl PunchProfile for Crowned {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(Face { half_width: self.half_width.get(), radius: self.radius.get() }))
    }
}

#[derive(Debug)]
struct Face {
    half_width: f64,
    radius: f64,
}

impl PunchShape for Face {
    fn height(&self, x: f64) -> f64 {
        x * x / (2.0 * self.radius)
    }

    fn slope(&self, x: f64) -> f64 {
        x / self.radius
    }

    fn fixed_half_width(&self) -> Option<f64> {
        Some(self.half_width)
    }

    fn natural_length(&self) -> f64 {
        self.half_width
    }
}

/// The punch on an incompressible half-plane of shear modulus 1, where `A0 = 1/2`.
fn pressed(force: f64) -> Result<Solution, Box<dyn std::error::Error>> {
    let text = format!(
        r#"
        format = 1

        [layer]
        poisson = 0.5
        base = {{ type = "infinite" }}
        grading = {{ type = "homogeneous", modulus = 1.0 }}

        [punch]
        type = "crowned"
        half_width = {HALF_WIDTH}
        radius = {RADIUS}

        [load]
        force = {force}
        "#
    );
    // Finds `crowned` in the registry, where `register!` above has put it.
    Ok(solve(&parse("own_punch", &text)?))
}

const HALF_WIDTH: f64 = 1.0;
const RADIUS: f64 = 10.0;
const A0: f64 = 0.5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let corners_touch = PI * HALF_WIDTH.powi(2) / (2.0 * A0 * RADIUS);
    println!("the corners touch above P0 = {corners_touch:.4}\n");

    println!("   P/P0   edge.ratio     closed form   p(0)          closed form");
    for times in [1.25, 2.0, 10.0] {
        let force = times * corners_touch;
        let solution = pressed(force)?;
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let ratio = solution.edge.ratio.ok_or("a converged solution has an edge")?;
        let centre = solution.pressure.centre.ok_or("a smooth face has a pressure in the middle")?;
        let exact_ratio = (1.0 - 1.0 / times) / PI;
        let exact_centre = HALF_WIDTH / (A0 * RADIUS) + (force - corners_touch) / (PI * HALF_WIDTH);
        println!("{times:7.2}   {ratio:.10}   {exact_ratio:.10}  {centre:.10}  {exact_centre:.10}");
        // Each number is as good as the solution says, and that is the default tolerance at least.
        for (path, got, exact) in [("edge.ratio", ratio, exact_ratio), ("pressure.centre", centre, exact_centre)] {
            let (error, claimed) = ((got / exact - 1.0).abs(), solution.error.each[path]);
            assert!(error <= claimed && claimed <= 1e-8, "{path}: error {error:.1e}, {claimed:.1e} claimed");
        }
    }

    let too_little = pressed(0.8 * corners_touch)?;
    println!("\nwith P = 0.8 P0: {}", too_little.reason.as_deref().unwrap_or("no complaint"));
    assert_eq!(too_little.status, Status::AssumptionViolated);
    Ok(())
}
