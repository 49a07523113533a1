//! Reads a scene from a file or from standard input.

use super::Failure;
use slipzone::scene::{self, Scene};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Whether a path stands for standard input or output.
pub(super) fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads and checks a scene.
pub(super) fn scene(path: &Path) -> Result<Scene, Failure> {
    let name = if is_dash(path) { "<stdin>".into() } else { path.to_string_lossy() };
    let bytes = if is_dash(path) { limited(std::io::stdin().lock()) } else { file(path) };
    let bytes = bytes.map_err(|error| Failure::System(format!("cannot read the scene {name}: {error}")))?;
    let text = scene::text(&name, bytes)?;
    Ok(scene::parse(&name, &text)?)
}

fn file(path: &Path) -> std::io::Result<Vec<u8>> {
    // Said here, since systems differ in whether opening or reading a folder fails.
    if path.is_dir() {
        return Err(std::io::Error::other("it is a directory"));
    }
    limited(File::open(path)?)
}

/// At most one byte more than a scene may have: enough to tell that it is too large.
fn limited(source: impl Read) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(scene::LARGEST as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}
