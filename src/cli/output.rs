//! Files of results: written whole or not at all.

use super::Failure;
use super::input::is_dash;
use std::collections::BTreeSet;
use std::fs::{self, Permissions};
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tempfile::{Builder, NamedTempFile};

/// How the names of temporary files begin; so many letters and digits follow.
const PREFIX: &str = ".slipzone-";
const LETTERS: usize = 6;

/// A temporary file that nothing was written to for so long is of no run that is alive.
const ABANDONED: Duration = Duration::from_hours(24);

/// Temporary files that there are or were.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Folders that were looked through for what other runs left.
static CLEARED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn temporary_files() -> MutexGuard<'static, Vec<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files, and keeps any from being made or put in its place as long as what it returns is held.
pub(super) fn abandon() -> MutexGuard<'static, Vec<PathBuf>> {
    let files = temporary_files();
    for file in &*files {
        // Most are in their places, or gone.
        let _ = fs::remove_file(file);
    }
    files
}

/// Removes the temporary files of runs that were killed, once for all files in a folder: it may hold very many. What
/// cannot be removed does no harm.
fn clear(folder: &Path) {
    if !CLEARED.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.into()) {
        return;
    }
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let random = name.to_str().and_then(|name| name.strip_prefix(PREFIX)).unwrap_or_default();
        let is_temporary = random.len() == LETTERS && random.bytes().all(|byte| byte.is_ascii_alphanumeric());
        let is_abandoned = || {
            let changed = entry.metadata().ok().filter(fs::Metadata::is_file)?.modified().ok()?;
            changed.elapsed().ok().filter(|age| *age > ABANDONED)
        };
        if is_temporary && is_abandoned().is_some() {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// A file to be written, found fit for it.
#[derive(Debug)]
pub(super) struct Target {
    /// As it was asked for.
    shown: PathBuf,
    /// The file itself, symbolic links followed: they stay what they are.
    real: PathBuf,
    /// A device or a pipe, or whatever the program was started with as one of its streams: it cannot be replaced, only
    /// written to.
    special: bool,
}

impl Target {
    /// Checks that the file can be written, before any work is done.
    pub(super) fn new(path: &Path) -> Result<Self, Failure> {
        let failed = |why: &dyn std::fmt::Display| Failure::System(format!("cannot write {}: {why}", path.display()));
        // `Path` does not tell `results/` from `results`.
        if path.to_string_lossy().ends_with(std::path::is_separator) {
            return Err(failed(&"that is the name of a directory"));
        }
        let real = real(path).map_err(|error| failed(&error))?;
        let stream = stream(path);
        let special = match fs::metadata(&real) {
            Ok(found) if found.is_dir() => return Err(failed(&"it is a directory")),
            _ if stream.is_some() => true,
            Ok(found) if found.is_file() => {
                if found.permissions().readonly() {
                    return Err(failed(&"it is write-protected"));
                }
                // To rename over it takes no leave of the file.
                fs::OpenOptions::new().write(true).open(&real).map_err(|error| failed(&error))?;
                false
            }
            Ok(_) => true,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => false,
            // Such as too long a name.
            Err(error) => return Err(failed(&error)),
        };
        let target = Self { shown: path.into(), real: stream.unwrap_or(real), special };
        if !target.special {
            // The only sure way to learn whether a folder can be written to.
            target.temporary().map_err(|error| failed(&error))?;
            clear(target.folder());
        }
        Ok(target)
    }

    fn folder(&self) -> &Path {
        folder_of(&self.real)
    }

    /// An empty file beside the target, with the permissions of the file it replaces, or of any new file.
    fn temporary(&self) -> std::io::Result<NamedTempFile> {
        let mut builder = Builder::new();
        builder.prefix(PREFIX).rand_bytes(LETTERS);
        let old = fs::metadata(&self.real).ok().map(|found| found.permissions());
        if let Some(permissions) = old.clone().or_else(ordinary) {
            builder.permissions(permissions);
        }
        let mut made = temporary_files();
        // Its own name for the file means nothing to who asked for another.
        let file = builder.tempfile_in(self.folder()).map_err(|error| std::io::Error::from(error.kind()))?;
        made.push(file.path().into());
        drop(made);
        if let Some(permissions) = old {
            // The process's mask has been applied to them once more.
            file.as_file().set_permissions(permissions)?;
        }
        Ok(file)
    }

    /// A file to be written bit by bit, which replaces the target only when it is kept.
    pub(super) fn begin(&self) -> Result<Pending<'_>, Failure> {
        let file = match self.real.to_str() {
            _ if !self.special => self.temporary().map(Writing::File),
            // What is written by its name would not move the place where the report goes on.
            Some(STANDARD_OUTPUT) => Ok(Writing::Special(Box::new(std::io::stdout()))),
            _ => {
                let opened = fs::OpenOptions::new().append(true).open(&self.real);
                opened.map(|file| Writing::Special(Box::new(file)))
            }
        };
        let file = file.map_err(|error| self.failed(&error))?;
        Ok(Pending { file: BufWriter::new(file), target: self })
    }

    /// A file that holds this text.
    fn finished(&self, text: &str) -> Result<Finished<'_>, Failure> {
        let mut file = self.begin()?;
        file.write(text.as_bytes())?;
        file.finished()
    }

    fn failed(&self, error: &dyn std::fmt::Display) -> Failure {
        Failure::System(format!("cannot write {}: {error}", self.shown.display()))
    }
}

/// A file that is being written.
pub(super) struct Pending<'a> {
    file: BufWriter<Writing>,
    target: &'a Target,
}

/// A file that is written to the end.
pub(super) struct Finished<'a> {
    file: Writing,
    target: &'a Target,
}

enum Writing {
    File(NamedTempFile),
    Special(Box<dyn Write>),
}

impl Write for Writing {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        match self {
            Self::File(file) => file.as_file_mut().write(bytes),
            Self::Special(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        match self {
            Self::File(file) => file.as_file_mut().flush(),
            Self::Special(file) => file.flush(),
        }
    }
}

impl<'a> Pending<'a> {
    pub(super) fn write(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.file.write_all(bytes).map_err(|error| self.target.failed(&error))
    }

    /// Everything is on the disk: what is left is to rename it.
    pub(super) fn finished(self) -> Result<Finished<'a>, Failure> {
        let target = self.target;
        let mut file = self.file.into_inner().map_err(|error| target.failed(error.error()))?;
        let written = match &mut file {
            Writing::File(file) => file.as_file().sync_all(),
            Writing::Special(file) => file.flush(),
        };
        written.map_err(|error| target.failed(&error))?;
        Ok(Finished { file, target })
    }
}

impl Finished<'_> {
    /// Puts the file in its place.
    pub(super) fn keep(self) -> Result<(), Failure> {
        match self.file {
            Writing::File(file) => {
                let _kept = temporary_files();
                file.persist(&self.target.real).map(drop).map_err(|error| self.target.failed(&error.error))
            }
            Writing::Special(_) => Ok(()),
        }
    }
}

/// Writes all files: none is touched before each of them is ready. What goes to devices cannot wait and goes last.
pub(super) fn write(files: &[(Target, String)]) -> Result<(), Failure> {
    let mut files: Vec<_> = files.iter().collect();
    files.sort_by_key(|(target, _)| target.special);
    let ready = files.into_iter().map(|(target, text)| target.finished(text)).collect::<Result<Vec<_>, _>>()?;
    ready.into_iter().try_for_each(Finished::keep)
}

/// Refuses a file that is there already; a folder is left to [`Target::new`].
pub(super) fn absent(path: &Path) -> Result<(), Failure> {
    match fs::symlink_metadata(path) {
        Ok(found) if !found.is_dir() => Err(exists(path)),
        _ => Ok(()),
    }
}

/// Writes a file that must not be there yet, not even since it was looked for.
pub(super) fn create(target: &Target, text: &str) -> Result<(), Failure> {
    // A device is there, and must not be written to before that is said.
    let finished = if target.special { None } else { Some(target.finished(text)?) };
    let Some(Finished { file: Writing::File(file), .. }) = finished else { return Err(exists(&target.shown)) };
    match file.persist_noclobber(&target.real) {
        Err(error) if error.error.kind() == ErrorKind::AlreadyExists => Err(exists(&target.shown)),
        written => written.map(drop).map_err(|error| target.failed(&error.error)),
    }
}

fn exists(path: &Path) -> Failure {
    let hint = "it is left as it is: give another name, or `-` to print";
    Failure::Usage(format!("{} is there already", path.display()), Some(hint.into()))
}

/// Makes a folder, and those around it, where there is none.
pub(super) fn make_folder(folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| {
        let file = folder.ancestors().find(|path| path.is_file());
        let why = file.map_or_else(|| error.to_string(), |file| format!("{} is a file", file.display()));
        Failure::System(format!("cannot make the folder {}: {why}", folder.display()))
    })
}

/// Refuses standard output where a file is needed; the hint says what else there is.
pub(super) fn named(option: &str, path: &Path, hint: &str) -> Result<(), Failure> {
    if is_dash(path) {
        return Err(Failure::Usage(format!("{option} needs the name of a file"), Some(hint.into())));
    }
    Ok(())
}

/// Refuses outputs that would overwrite one another or the scene.
pub(super) fn distinct(scene: &Path, outputs: &[(&str, &Path)]) -> Result<(), Failure> {
    for (option, path) in outputs {
        let Some(own) = identity(path) else { continue };
        if identity(scene).as_ref() == Some(&own) {
            let message = format!("{option} would overwrite the scene {}", scene.display());
            return Err(Failure::Usage(message, Some("give the result a name of its own".into())));
        }
    }
    apart(outputs)
}

/// Refuses outputs that would overwrite one another.
pub(super) fn apart(outputs: &[(&str, &Path)]) -> Result<(), Failure> {
    for (index, (option, path)) in outputs.iter().enumerate() {
        let Some(own) = identity(path) else { continue };
        if let Some((other, _)) = outputs[..index].iter().find(|(_, path)| identity(path).as_ref() == Some(&own)) {
            let message = format!("{other} and {option} name the same file {}", path.display());
            return Err(Failure::Usage(message, Some("give each result a name of its own".into())));
        }
    }
    Ok(())
}

/// Refuses outputs that would overwrite a file that the scene or the study, the `reader`, has read.
pub(super) fn spared(reader: &str, read: &[PathBuf], outputs: &[(&str, &Path)], hint: &str) -> Result<(), Failure> {
    for (option, path) in outputs {
        let Some(own) = identity(path) else { continue };
        if let Some(file) = read.iter().find(|file| identity(file).as_ref() == Some(&own)) {
            let message = format!("{option} would overwrite {}, which the {reader} reads", file.display());
            return Err(Failure::Usage(message, Some(hint.into())));
        }
    }
    Ok(())
}

/// What tells a file that would be replaced from others.
fn identity(path: &Path) -> Option<PathBuf> {
    (!is_dash(path)).then(|| real(path).ok()).flatten().filter(|path| is_replaceable(path))
}

/// Devices and pipes may be written to twice.
fn is_replaceable(path: &Path) -> bool {
    fs::metadata(path).map_or(true, |found| found.is_file())
}

/// The folder that a file is in.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The file that a path means: links followed, and the folder made absolute when the file is yet to come.
fn real(path: &Path) -> std::io::Result<PathBuf> {
    match path.canonicalize() {
        Ok(real) => Ok(real),
        // A pipe behind /dev/stdout exists without having a path.
        Err(_) if path.exists() => Ok(path.into()),
        Err(error) => {
            // A link may lead to what is yet to come.
            let path = links(path).last().unwrap_or_default();
            let name = path.file_name().ok_or(error)?;
            let folder = folder_of(&path);
            let folder = folder.canonicalize().map_err(|error| {
                std::io::Error::new(error.kind(), format!("its folder {}: {error}", folder.display()))
            })?;
            Ok(folder.join(name))
        }
    }
}

/// A path, and where its links lead one after another.
fn links(path: &Path) -> impl Iterator<Item = PathBuf> {
    /// As many as systems follow.
    const MOST: usize = 40;
    let next = |path: &PathBuf| Some(folder_of(path).canonicalize().ok()?.join(fs::read_link(path).ok()?));
    std::iter::successors(Some(path.to_path_buf()), next).take(MOST)
}

/// Standard output among the streams of the program.
const STANDARD_OUTPUT: &str = "/dev/fd/1";

/// The name in `/dev/fd` of the stream that a path leads to, as `/dev/stdout` does, wherever that has been redirected
/// to.
pub(super) fn stream(path: &Path) -> Option<PathBuf> {
    let streams = Path::new(STANDARD_OUTPUT).parent()?;
    let real = streams.canonicalize().ok()?;
    let among_them = |path: &PathBuf| folder_of(path).canonicalize().is_ok_and(|folder| folder == real);
    links(path).find(among_them).and_then(|path| Some(streams.join(path.file_name()?)))
}

/// Permissions of a new file before the process's mask; temporary files are private otherwise.
#[cfg(unix)]
#[allow(clippy::unnecessary_wraps)] // `None` elsewhere
fn ordinary() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn ordinary() -> Option<Permissions> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// To list it for each of the files would take as long as to write them where it holds very many.
    #[test]
    fn a_folder_is_looked_through_once() {
        let folder = tempfile::tempdir().unwrap();
        let left = folder.path().join(".slipzone-aB3dE6");
        let leave = || {
            let file = fs::File::create(&left).unwrap();
            file.set_modified(std::time::SystemTime::now() - 2 * ABANDONED).unwrap();
        };
        leave();
        Target::new(&folder.path().join("one.json")).unwrap();
        assert!(!left.exists());
        leave();
        Target::new(&folder.path().join("other.csv")).unwrap();
        assert!(left.exists());
    }
}
