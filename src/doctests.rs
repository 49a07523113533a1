//! The documents' own code: Rust blocks run as doc tests, TOML blocks as scenes.

/// Compiled and run by `cargo test --doc`.
#[cfg(doctest)]
#[doc = include_str!("../docs/adding-a-punch.md")]
pub struct AddingAPunch;

#[cfg(test)]
mod tests {
    use crate::engine::Status;

    /// The blocks of a document that open with `fence`, each with the number of its first line.
    fn blocks<'a>(document: &'a str, fence: &'a str) -> impl Iterator<Item = (usize, String)> + 'a {
        let lines = || document.lines().enumerate();
        lines().filter(move |(_, line)| line.trim() == fence).map(move |(opening, _)| {
            let body = lines().skip(opening + 1).map(|(_, line)| line).take_while(|line| line.trim() != "```");
            (opening + 2, body.collect::<Vec<_>>().join("\n"))
        })
    }

    /// A block marked `toml` is a whole scene; fragments are indented and carry no mark.
    #[test]
    fn scenes_in_the_documents_run() {
        crate::link_plugins();
        let documents = [
            ("docs/plugins.md", include_str!("../docs/plugins.md")),
            ("docs/formats.md", include_str!("../docs/formats.md")),
        ];
        for (name, document) in documents {
            let scenes: Vec<_> = blocks(document, "```toml").collect();
            assert!(!scenes.is_empty(), "{name} shows no scene");
            for (line, text) in scenes {
                let scene = crate::scene::parse(name, &text).unwrap_or_else(|e| panic!("{name}:{line}: {e}"));
                let solution = crate::engine::solve(&scene);
                assert_eq!(solution.status, Status::Converged, "{name}:{line}: {:?}", solution.reason);
            }
        }
    }

    #[test]
    fn every_plugin_has_a_section() {
        crate::link_plugins();
        let document = include_str!("../docs/plugins.md");
        for info in slipzone_api::plugins() {
            let heading = format!("### {} `{}`", info.family.name(), info.name);
            assert!(document.lines().any(|line| line == heading), "docs/plugins.md lacks the section `{heading}`");
        }
    }
}
