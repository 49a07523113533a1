//! Why a run gave no result, and how that is told.

use crate::scene::SceneError;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::io::Write;

/// A run that ends without a result.
#[derive(Debug)]
pub(super) enum Failure {
    /// The scene is wrong.
    Scene(Box<SceneError>),
    /// The arguments contradict each other or name what does not exist; with a hint.
    Usage(String, Option<String>),
    /// A file or the system failed.
    System(String),
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::Scene(Box::new(error))
    }
}

impl Failure {
    pub(super) fn exit_code(&self) -> u8 {
        match self {
            Self::Scene(_) | Self::Usage(..) => 2,
            Self::System(_) => 3,
        }
    }

    /// Tells it on standard error, in colour on a terminal only.
    pub(super) fn print(&self) {
        let group = match self {
            Self::Scene(error) => scene(error),
            Self::Usage(message, hint) => Group::with_title(Level::ERROR.primary_title(message))
                .elements(hint.as_deref().map(|hint| Level::HELP.message(hint))),
            Self::System(message) => Group::with_title(Level::ERROR.primary_title(message)),
        };
        // Nobody is left to be told when standard error itself is closed.
        let _ = writeln!(anstream::stderr(), "{}", Renderer::styled().render(&[group]));
    }
}

/// The line with the error marked, and what was found and expected below it.
fn scene(error: &SceneError) -> Group<'_> {
    let title = Level::ERROR.primary_title(error.message.as_str());
    let origin = || Origin::path(error.file.as_str()).line(error.line).char_column(error.column);
    let snippet = || {
        Snippet::source(error.excerpt.as_str())
            .line_start(error.line)
            .annotation(AnnotationKind::Primary.span(error.marked.clone()))
    };
    // A snippet works out its own column, rightly so unless the line was cut in front.
    let is_cut = error.excerpt[..error.marked.start].chars().count() + 1 != error.column;
    let group = match error.excerpt.as_str() {
        "" => title.element(origin()),
        _ if is_cut => title.element(origin()).element(snippet()),
        _ => title.element(snippet().path(error.file.as_str())),
    };
    group.elements(error.notes().map(|(name, note)| Level::NOTE.with_name(name).message(note)))
}
