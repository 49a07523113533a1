//! What plugins tell of themselves, refused where it cannot be.

use slipzone_api::{Edge, KernelTable, Parity, Quadrature, Refusal, Rule, Span, contract};

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

/// A kernel table that tells a length.
pub(crate) fn table(strategy: &'static str, table: Box<dyn KernelTable>) -> Result<Box<dyn KernelTable>, Refusal> {
    contract::length("length", table.length()).map_err(|fault| broken(strategy, &fault))?;
    Ok(table)
}
