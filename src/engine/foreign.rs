//! What plugins tell of themselves, refused where it cannot be.

use slipzone_api::{
    Base, Edge, Flexibility, KernelTable, LayerModel, LayerResponse, Parity, Quadrature, Refusal, Rule, Span, contract,
};
use std::sync::Arc;

/// What is said of a plugin that tells of itself what cannot be.
pub(crate) const BREACH: &str = "this plugin breaks its contract";

/// What a plugin tells of itself cannot be.
pub(crate) fn broken(plugin: &'static str, fault: &str) -> Refusal {
    Refusal::Unusable { plugin, why: format!("{BREACH}: {fault}; tell its author") }
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
