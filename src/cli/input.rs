//! Reads a scene or a study from a file or from standard input.

use super::Failure;
use crate::api::{Files, LARGEST_FILE};
use crate::scene::{self, Scene};
use crate::study::Study;
use std::cell::RefCell;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Whether a path stands for standard input or output.
pub(super) fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads and checks a scene; with it, the files that it names.
pub(super) fn scene(path: &Path) -> Result<(Scene, Vec<PathBuf>), Failure> {
    let (name, text) = text(path, "scene")?;
    let folder = Folder::of(path);
    let scene = scene::parse_with(&name, &text, &folder)?;
    Ok((scene, folder.read.into_inner()))
}

/// Reads and checks a study; with it, the files that it and its scenes name.
pub(super) fn study(path: &Path) -> Result<(Study, Vec<PathBuf>), Failure> {
    let (name, text) = text(path, "study")?;
    let folder = Folder::of(path);
    let study = Study::parse(&name, &text, &folder)?;
    Ok((study, folder.read.into_inner()))
}

/// What errors call a file, and its text.
fn text(path: &Path, what: &str) -> Result<(String, String), Failure> {
    let name = if is_dash(path) { "<stdin>".into() } else { path.to_string_lossy() };
    let most = scene::LARGEST;
    let bytes = if is_dash(path) { limited(std::io::stdin().lock(), most) } else { file(path, most) };
    let bytes = bytes.map_err(|error| Failure::System(format!("cannot read the {what} {name}: {error}")))?;
    let text = scene::text_of(what, &name, bytes)?;
    Ok((name.into_owned(), text))
}

/// The folder of a scene or a study, which the files that it names are relative to.
struct Folder<'a> {
    path: &'a Path,
    /// What was read of it.
    read: RefCell<Vec<PathBuf>>,
}

impl<'a> Folder<'a> {
    /// Of a file; of standard input the current one.
    fn of(path: &'a Path) -> Self {
        let folder = if is_dash(path) { None } else { path.parent() };
        Self { path: folder.unwrap_or(Path::new("")), read: RefCell::default() }
    }
}

impl Files for Folder<'_> {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let path = self.path.join(name);
        let bytes = file(&path, LARGEST_FILE).map_err(|error| format!("{}: {error}", path.display()))?;
        self.read.borrow_mut().push(path);
        Ok(bytes)
    }
}

/// At most one byte more than `most`: enough to tell that the file is too large.
fn file(path: &Path, most: usize) -> std::io::Result<Vec<u8>> {
    // Said here, since systems differ in whether opening or reading a folder fails.
    if path.is_dir() {
        return Err(std::io::Error::other("it is a directory"));
    }
    limited(File::open(path)?, most)
}

fn limited(source: impl Read, most: usize) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(most as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}
