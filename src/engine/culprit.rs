//! Which plugin gives what is no number, where a solve has failed.

use super::foreign::{broken, rule};
use super::prepared_layer::PreparedLayer;
use crate::plan::Methods;
use slipzone_api::{Component, Edge, LayerResponse, Parity, Parts, Refusal, Rule};

/// Wave numbers that are looked at where something failed: 0, and so many, evenly spaced in their logarithms within
/// these bounds in units of `1/h`.
const WAVES: u32 = 101;
const BETWEEN: (f64, f64) = (1e-3, 1e2);
/// Distances over what a table reaches.
const DISTANCES: [f64; 4] = [0.01, 0.1, 0.5, 1.0];

/// The first plugin that gives what is no number, looked for once a solve has failed.
pub(crate) fn culprit(methods: &Methods, layer: &PreparedLayer) -> Option<Refusal> {
    let flexibility = || of_response(layer.response()).map(|fault| (methods.flexibility.typetag_name(), fault));
    let kernel = || of_tables(layer).map(|fault| (methods.kernel.typetag_name(), fault));
    let quadrature = || {
        let mut rule = rule(&*methods.quadrature, Parity::Even, Edge::Sharp).ok()?;
        of_rule(&mut *rule, layer).map(|fault| (methods.quadrature.typetag_name(), fault))
    };
    let (plugin, fault) = flexibility().or_else(kernel).or_else(quadrature)?;
    Some(broken(plugin, &fault))
}

fn of_response(response: &dyn LayerResponse) -> Option<String> {
    let (least, most) = BETWEEN;
    let waves = (0..WAVES).map(|i| least * (most / least).powf(f64::from(i) / f64::from(WAVES - 1)));
    let at = |s: f64| {
        let flexibility = response.surface(s).ok()?;
        none_of(&[flexibility.vv, flexibility.uu, flexibility.uv], &format!("surface({s})"))
    };
    std::iter::once(0.0).chain(waves).find_map(at)
}

fn of_tables(layer: &PreparedLayer) -> Option<String> {
    layer.kernels().find_map(|(table, component)| {
        DISTANCES.iter().find_map(|share| {
            let distance = share * layer.reach();
            let Parts { smooth, sign, log } = table.parts(component, distance);
            none_of(&[smooth, sign, log], &format!("parts({component:?}, {distance})"))
        })
    })
}

fn of_rule(rule: &mut dyn Rule, layer: &PreparedLayer) -> Option<String> {
    let (unknowns, points) = (rule.unknowns(), rule.collocation().len());
    let even = vec![1.0; unknowns];
    let (mut weights, mut rows, mut values) = (vec![0.0; unknowns], vec![0.0; unknowns * points], vec![0.0; points]);
    rule.resultant_into(&mut weights);
    rule.operator_into(None, &mut rows);
    rule.values_into(&even, rule.collocation(), &mut values);
    let factor = [rule.edge_factor(&even)];
    // Kernels end where they were tabulated to.
    let depth = layer.kernel(Component::Depth).map(|kernel| {
        rule.stretch(0.5 * layer.reach());
        rule.potential_at_centre(&even, kernel)
    });
    let told: [(&[f64], &str); 5] = [
        (&weights, "resultant_into"),
        (&rows, "operator_into"),
        (&values, "values_into"),
        (&factor, "edge_factor"),
        (depth.as_slice(), "potential_at_centre"),
    ];
    told.into_iter().find_map(|(numbers, name)| none_of(numbers, name))
}

/// A method that gave what is no number.
fn none_of(numbers: &[f64], method: &str) -> Option<String> {
    let none = numbers.iter().find(|number| !number.is_finite())?;
    Some(format!("{method} gives {none}"))
}
