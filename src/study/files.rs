//! Files that the scenes of a study name: read once, when the study is.

use slipzone_api::Files;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Files by the names that the scenes give them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Kept(pub(super) BTreeMap<String, Vec<u8>>);

impl Files for Kept {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let kept = self.0.get(name).cloned();
        kept.ok_or_else(|| format!("`{name}` was not read with the study: name it in a list of `values`"))
    }
}

/// Files of a folder, kept as they are read.
pub(super) struct Reading<'a> {
    source: &'a dyn Files,
    /// The scene's, seen from the study.
    folder: PathBuf,
    kept: RefCell<Kept>,
}

impl<'a> Reading<'a> {
    pub(super) fn new(source: &'a dyn Files, folder: PathBuf) -> Self {
        Self { source, folder, kept: RefCell::default() }
    }

    pub(super) fn kept(self) -> Kept {
        self.kept.into_inner()
    }
}

impl Files for Reading<'_> {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        if let Ok(bytes) = self.kept.borrow().read(name) {
            return Ok(bytes);
        }
        let bytes = self.source.read(&self.folder.join(name).to_string_lossy())?;
        self.kept.borrow_mut().0.insert(name.to_owned(), bytes.clone());
        Ok(bytes)
    }
}
