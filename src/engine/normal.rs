//! The frictionless normal problem: pressure under a punch on a contact of given half-width.

use super::layer::Layer;
use slipzone_api::{Component, Density, Edge, Parity, Refusal, Rule, Span, Station};

/// The pressure on one contact, in layer units.
pub(crate) struct Pressure {
    pub(crate) half_width: f64,
    pub(crate) force: f64,
    /// `lim p sqrt(b^2 - x^2)` at the edge.
    pub(crate) edge_factor: f64,
    rule: Box<dyn Rule>,
    unknowns: Vec<f64>,
}

impl Pressure {
    /// Pressure at a point strictly inside the contact.
    pub(crate) fn at(&self, station: Station) -> f64 {
        self.rule.value(Density { unknowns: &self.unknowns, carrier: 0.0 }, station)
    }

    /// `(1/pi) int p(r) k(x - r) dr` at each target within the contact; zeros without a kernel.
    pub(crate) fn potential(&self, layer: &Layer, component: Component, targets: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; targets.len()];
        if let Some(kernel) = layer.kernel(component) {
            self.rule.potential_into(&self.unknowns, kernel, targets, &mut out);
        }
        out
    }

    /// Depth of the punch; `None` on a half-plane.
    pub(crate) fn depth(&self, layer: &Layer) -> Option<f64> {
        depth_at_centre(layer, self.rule.as_ref(), &self.unknowns)
    }

    /// Distance to the edge of the outermost collocation point: what the resolution can tell apart there.
    pub(crate) fn finest_gap(&self) -> f64 {
        self.rule.collocation().last().map_or(self.half_width, |station| station.gap)
    }

    /// Number of unknowns behind it.
    pub(crate) fn size(&self) -> usize {
        self.unknowns.len()
    }
}

/// Pressure under the punch with sharp corners at `half_width`, by force: the sum of a flat punch that
/// carries the force and of a curved face that carries none.
pub(crate) struct SharpPunch {
    half_width: f64,
    rule: Box<dyn Rule>,
    /// Unknowns per unit force.
    by_force: Vec<f64>,
    /// Unknowns of the face's own shape at zero force.
    by_shape: Vec<f64>,
}

impl SharpPunch {
    pub(crate) fn new(layer: &mut Layer, half_width: f64) -> Result<Self, Refusal> {
        layer.reach(half_width)?;
        let rule = layer.quadrature.rule(&Span::symmetric(half_width, Parity::Even, Edge::Sharp))?;
        let n = rule.unknowns();
        let mut rows = vec![0.0; n * n];
        let (equations, resultant) = rows.split_at_mut(n * (n - 1));
        rule.operator_into(layer.kernel(Component::NormalSlope), equations);
        rule.resultant_into(resultant);
        let a0 = layer.problem.elastic.a0();
        let mut force = vec![0.0; n];
        force[n - 1] = 1.0;
        let mut shape: Vec<f64> = rule.collocation().iter().map(|s| layer.problem.slope(s.x) / a0).collect();
        shape.push(0.0);
        let mut solved = layer.solve(&rows, &[&force, &shape])?;
        let by_shape = solved.pop().expect("two right-hand sides");
        let by_force = solved.pop().expect("two right-hand sides");
        Ok(Self { half_width, rule, by_force, by_shape })
    }

    /// Force that gives an indentation; `None` on a half-plane.
    pub(crate) fn force_at(&self, layer: &Layer, indentation: f64) -> Option<f64> {
        let depth = |unknowns: &[f64]| depth_at_centre(layer, self.rule.as_ref(), unknowns);
        Some((indentation - depth(&self.by_shape)?) / depth(&self.by_force)?)
    }

    pub(crate) fn under(self, force: f64) -> Pressure {
        let unknowns: Vec<f64> = self.by_force.iter().zip(&self.by_shape).map(|(f, s)| force * f + s).collect();
        Pressure {
            half_width: self.half_width,
            force,
            edge_factor: self.rule.edge_factor(&unknowns),
            rule: self.rule,
            unknowns,
        }
    }
}

/// Pressure under a punch whose contact ends smoothly at `half_width`.
pub(crate) fn smooth_punch(layer: &mut Layer, half_width: f64) -> Result<Pressure, Refusal> {
    layer.reach(half_width)?;
    let rule = layer.quadrature.rule(&Span::symmetric(half_width, Parity::Even, Edge::Smooth))?;
    let n = rule.unknowns();
    let mut rows = vec![0.0; n * n];
    rule.operator_into(layer.kernel(Component::NormalSlope), &mut rows);
    let a0 = layer.problem.elastic.a0();
    let slope: Vec<f64> = rule.collocation().iter().map(|s| layer.problem.slope(s.x) / a0).collect();
    let unknowns = layer.solve(&rows, &[&slope])?.pop().expect("one right-hand side");
    let mut resultant = vec![0.0; n];
    rule.resultant_into(&mut resultant);
    let force = resultant.iter().zip(&unknowns).map(|(r, u)| r * u).sum();
    Ok(Pressure { half_width, force, edge_factor: 0.0, rule, unknowns })
}

/// Surface depth `v(0) = delta - g(0)` under a pressure; `None` on a half-plane.
fn depth_at_centre(layer: &Layer, rule: &dyn Rule, unknowns: &[f64]) -> Option<f64> {
    if !layer.has_depth() {
        return None;
    }
    let mut depth = [0.0];
    rule.potential_into(unknowns, layer.kernel(Component::Depth)?, &[0.0], &mut depth);
    Some(layer.problem.elastic.a0() * depth[0] + layer.problem.height(0.0))
}
