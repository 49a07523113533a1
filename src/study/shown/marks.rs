//! What a figure's description gives by itself: a name, lines and points.

use super::fault::wrong;
use crate::study::plot::{Plot, PlotKind, Scale};
use slipzone_api::{Fault, MODERATE};

/// A name that stays in its folder on every system, and is that of a figure.
pub(super) fn file_name(name: &str) -> Result<(), Fault> {
    let odd = |c: char| c.is_control() || "<>:\"/\\|?*".contains(c);
    let stem = name.strip_suffix(".svg").unwrap_or_default();
    if stem.is_empty() || stem.starts_with('.') || name.chars().any(odd) {
        let fault = wrong(&["file"], "not the name of a figure", "a name such as `stick.svg`, without folders");
        return Err(fault.found(format!("`{name}`")));
    }
    Ok(())
}

/// Lines and points that can be drawn.
pub(super) fn marks(plot: &Plot) -> Result<(), Fault> {
    // As far as the numbers of a scene may go: an axis in equal factors has a tick for each power of ten.
    let drawable = |value: f64, scale: Scale| match scale {
        Scale::Linear => value.abs() <= *MODERATE.end(),
        Scale::Log => MODERATE.contains(&value),
    };
    let expected = |scale: Scale| match scale {
        Scale::Linear => "numbers between -1e100 and 1e100",
        Scale::Log => "numbers between 1e-100 and 1e100, as the scale is `log`",
    };
    for (index, line) in plot.lines.iter().enumerate() {
        if !drawable(line.y, plot.y_scale) {
            let path = ["lines", &index.to_string(), "y"];
            let fault = wrong(&path, "a line that cannot be drawn", expected(plot.y_scale));
            return Err(fault.found(format!("{:?}", line.y)));
        }
    }
    for (index, points) in plot.points.iter().enumerate() {
        let index = index.to_string();
        if points.x.len() != points.y.len() {
            let fault = wrong(&["points", &index, "y"], "as many `y` as `x` are needed", "one for each");
            return Err(fault.found(format!("{} and {}", points.y.len(), points.x.len())));
        }
        for (key, values, scale) in [("x", &points.x, plot.x_scale), ("y", &points.y, plot.y_scale)] {
            if let Some(odd) = values.iter().find(|value| !drawable(**value, scale)) {
                let path = ["points", &index, key];
                let fault = wrong(&path, "points that cannot be drawn", expected(scale));
                return Err(fault.found(format!("{odd:?}")));
            }
        }
    }
    if plot.kind == PlotKind::Tractions {
        let (middle, ends) = ("go from the middle", "end at 0");
        for (key, scale, what) in [("x_scale", plot.x_scale, middle), ("y_scale", plot.y_scale, ends)] {
            if scale == Scale::Log {
                let message = format!("tractions {what}, for which a log axis has no place");
                return Err(wrong(&[key], message, format!("no `{key}`")).found("`log`"));
            }
        }
    }
    if plot.kind == PlotKind::Tractions && !plot.points.is_empty() {
        return Err(wrong(&["points"], "points go with curves only", "no `points` beside tractions"));
    }
    if plot.kind == PlotKind::Map && !(plot.lines.is_empty() && plot.points.is_empty()) {
        let key = if plot.lines.is_empty() { "points" } else { "lines" };
        return Err(wrong(&[key], "a map has no ordinate of numbers", format!("no `{key}`")));
    }
    Ok(())
}
