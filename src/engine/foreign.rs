//! What plugins tell of themselves, refused where it cannot be.

use super::prepared_layer::PreparedLayer;
use crate::plan::Methods;
use slipzone_api::{
    Base, Component, Edge, Flexibility, KernelTable, LayerModel, LayerResponse, Parity, Parts, Quadrature, Refusal,
    Rule, Span, contract,
};
use std::sync::Arc;

/// Wave numbers that are looked at where something failed, in units of `1/h`, and distances over what a table reaches.
const WAVES: [f64; 6] = [0.0, 0.1, 1.0, 3.0, 10.0, 100.0];
const DISTANCES: [f64; 4] = [0.01, 0.1, 0.5, 1.0];

/// What a plugin tells of itself cannot be.
pub(crate) fn broken(plugin: &'static str, fault: &str) -> Refusal {
    Refusal::Unusable { plugin, why: format!("this plugin breaks its contract: {fault}; tell its author") }
}

/// A quadrature's rule on `[-1, 1]`, whose equations fit its unknowns.
pub(crate) fn rule(quadrature: &dyn Quadrature, parity: Parity, edge: Edge) -> Result<Box<dyn Rule>, Refusal> {
    let rule = quadrature.rule(&Span::symmetric(1.0, parity, edge))?;
    contract::rule(&*rule, parity, edge).map_err(|fault| broken(quadrature.typetag_name(), &fault))?;
    Ok(rule)
}

/// The response of a layer that tells lengths, and of a base that is felt.
pub(crate) fn response(
    flexibility: &dyn Flexibility,
    layer: &Arc<LayerModel>,
) -> Result<Box<dyn LayerResponse>, Refusal> {
    let response = flexibility.respond(layer)?;
    let is_felt = matches!(layer.base, Base::Rigid | Base::Frictionless);
    let fault = match contract::response(&*response) {
        Ok(()) if is_felt && response.depth().is_none() => "depth() = None of a layer whose base is felt".into(),
        Ok(()) => return Ok(response),
        Err(fault) => fault,
    };
    Err(broken(flexibility.typetag_name(), &fault))
}

/// A kernel table that tells lengths.
pub(crate) fn table(strategy: &'static str, table: Box<dyn KernelTable>) -> Result<Box<dyn KernelTable>, Refusal> {
    contract::table(&*table).map_err(|fault| broken(strategy, &fault))?;
    Ok(table)
}

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
    let at = |s: &f64| {
        let flexibility = response.surface(*s).ok()?;
        none_of(&[flexibility.vv, flexibility.uu, flexibility.uv], &format!("surface({s})"))
    };
    WAVES.iter().find_map(at)
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
