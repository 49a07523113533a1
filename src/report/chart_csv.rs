//! Charts as a table: a line for each run.

use super::csv::{cell, line};
use crate::chart::{Chart, Errors, Measured, Run, Spread};

/// All runs as CSV, with a heading.
pub fn chart_csv(charts: &[Chart]) -> String {
    let head = "scene,method,resolution,cutoff,tolerance,ended,wrong,seconds_fresh,seconds_fresh_least,seconds_fresh_most,\
                seconds_on_known_layer,unknowns,wave_numbers,kernels_read,systems,multiplications,\
                error_edge,error_stick,error_load,error_pressure,error_shear,\
                claimed_edge,claimed_stick,claimed_load,band_edge,band_stick,band_load,band_pressure,band_shear,reason\n";
    let rows = charts.iter().flat_map(|chart| chart.runs.iter().map(|run| row(chart, run)));
    [head.to_owned()].into_iter().chain(rows).collect()
}

fn row(chart: &Chart, run: &Run) -> String {
    let seconds = |spread: Option<Spread>, which: fn(Spread) -> f64| cell(spread.map(which));
    let all = |errors: &Errors| Measured::ALL.map(|measured| cell(errors.of(measured)));
    let mut cells = vec![
        chart.scene.to_owned(),
        run.method.name(),
        run.setting.resolution.map(|n| n.to_string()).unwrap_or_default(),
        cell(run.setting.cutoff),
        cell(Some(run.setting.tolerance)),
        run.ended.name().to_owned(),
        run.wrong.to_string(),
        seconds(run.fresh, |spread| spread.median),
        seconds(run.fresh, |spread| spread.least),
        seconds(run.fresh, |spread| spread.most),
        seconds(run.known, |spread| spread.median),
        run.unknowns.to_string(),
        run.flexibility_evaluations.to_string(),
        run.kernel_evaluations.to_string(),
        run.factorisations.to_string(),
        run.operations.to_string(),
    ];
    cells.extend(all(&run.errors));
    cells.extend(all(&run.claimed).into_iter().take(3));
    cells.extend(all(&chart.band));
    cells.push(run.reason.clone().unwrap_or_default());
    line(cells)
}
