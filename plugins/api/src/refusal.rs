//! Why a method declines to give numbers.

/// A refusal is a result (`status = "refused"`), not a crash: it says what stopped the method and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// A method fails at one wave number.
    #[error("{method} fails at wave number s = {wave_number:.6e}/h: {why}; {remedy}")]
    WaveNumber {
        /// Name of the plugin.
        method: &'static str,
        /// The wave number, in units of 1/h.
        wave_number: f64,
        /// What overflows or degenerates, with its size.
        why: String,
        /// What to use instead.
        remedy: &'static str,
    },
    /// A combination of plugins, base, friction and load that is not implemented yet.
    #[error("{what} is not implemented yet; {remedy}")]
    NotBuilt {
        /// The combination.
        what: String,
        /// What to use instead.
        remedy: String,
    },
    /// What a scene says of a plugin turns out not to be usable: an unread file, a formula that is none.
    #[error("{plugin}: {why}")]
    Unusable {
        /// Name of the plugin.
        plugin: &'static str,
        /// What is wrong and what to do.
        why: String,
    },
    /// The scene lies outside what a method can resolve with bounded work.
    #[error("{method}: {why}; {remedy}")]
    OutOfReach {
        /// Name of the plugin or stage.
        method: &'static str,
        /// The limit, the scene's number and where they part.
        why: String,
        /// What to use instead.
        remedy: &'static str,
    },
    /// The scene lies outside what can be resolved, whatever the method: no name of one would tell more.
    #[error("{why}; {remedy}")]
    Limit {
        /// The limit, and the scene's number where there is one.
        why: String,
        /// What to do instead.
        remedy: &'static str,
    },
}
