//! How far long work has come; on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar with how many of `what` are done, the bar's message, and how long the rest will take.
pub(super) fn bar(all: u64, what: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(&format!(
        "{{wide_bar}} {{human_pos}} of {{human_len}} {what}{{msg}}, {{eta}} left"
    ));
    ProgressBar::new(all).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
