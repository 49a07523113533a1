//! The journal of a sweep: one line per finished scene, appended as it is found.
//!
//! The first line says which study it belongs to. A line that was cut off by the end of the program is dropped when the
//! journal is opened again; all before it are kept.

use super::{Failure, output};
use crate::api::clip;
use crate::engine::Status;
use crate::report::StudyTable;
use crate::study::{Record, RecordStatus, Study};
use serde::Deserialize;
use serde_json::Value;
use std::collections::{BTreeMap, HashSet};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A journal open for one sweep.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    tally: Tally,
}

/// What a journal holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    /// All scenes below this number.
    prefix: u64,
    /// And some above it.
    beyond: HashSet<u64>,
    /// How many did not converge.
    pub(super) failed: u64,
}

impl Tally {
    pub(super) fn has(&self, row: u64) -> bool {
        row < self.prefix || self.beyond.contains(&row)
    }

    pub(super) fn count(&self) -> u64 {
        self.prefix + self.beyond.len() as u64
    }

    fn add(&mut self, row: u64, is_converged: bool) {
        if self.has(row) {
            return;
        }
        self.failed += u64::from(!is_converged);
        self.beyond.insert(row);
        while self.beyond.remove(&self.prefix) {
            self.prefix += 1;
        }
    }
}

/// The first line.
#[derive(serde::Serialize, serde::Deserialize)]
struct Head {
    journal: String,
    format: u32,
    rows: u64,
    study: Vec<String>,
}

/// What is looked at in the others once they are known to be records.
#[derive(serde::Deserialize)]
struct Line {
    index: u64,
    status: RecordStatus,
}

const KIND: &str = "slipzone sweep";

impl Journal {
    /// Opens the journal of a study in a folder, a new one where there is none; `anew` empties it first.
    pub(super) fn open(path: &Path, study: &mut Study, anew: bool) -> Result<Self, Failure> {
        let failed = |why: &dyn std::fmt::Display| failed(path, why);
        let mut options = OpenOptions::new();
        let file = options.read(true).append(true).create(true).open(path).map_err(|error| failed(&error))?;
        let is_file = file.metadata().map_err(|error| failed(&error))?.is_file();
        if !is_file || output::stream(path).is_some() {
            return Err(failed(&"not a file, and nothing could go on from it; take it away, or take another --out"));
        }
        // Some file systems know no locks.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(failed(&"another sweep is writing it; wait, or take another --out"));
        }
        begins_as_journal(&file, path)?;
        if anew {
            file.set_len(0).map_err(|error| failed(&error))?;
        }
        let mut journal = Self { path: path.into(), file, tally: Tally::default() };
        let kept = journal.read(study)?;
        let length = journal.file.metadata().map_err(|error| failed(&error))?.len();
        if length > kept {
            journal.file.set_len(kept).map_err(|error| failed(&error))?;
        }
        if kept == 0 {
            let head = Head { journal: KIND.into(), format: 1, rows: study.rows(), study: lines(study) };
            journal.write(&head)?;
        }
        Ok(journal)
    }

    /// Takes note of what is there already; returns how many bytes of it are whole lines.
    fn read(&mut self, study: &mut Study) -> Result<u64, Failure> {
        let path = self.path.clone();
        let failed = |why: &dyn std::fmt::Display| failed(&path, why);
        let columns = StudyTable::new(study);
        let mut reader = BufReader::with_capacity(1 << 16, &self.file);
        reader.seek(SeekFrom::Start(0)).map_err(|error| failed(&error))?;
        let (mut line, mut kept, mut number) = (Vec::new(), 0, 0_u64);
        loop {
            line.clear();
            let length = reader.read_until(b'\n', &mut line).map_err(|error| failed(&error))?;
            if !line.ends_with(b"\n") {
                return Ok(kept);
            }
            number += 1;
            let broken = |what: &str| {
                failed(&format!("line {number} is {what}; mend it, or begin anew with --fresh or another --out"))
            };
            // What is skipped in a record is not looked at by the decoder.
            if let Err(error) = std::str::from_utf8(&line) {
                let byte = line[error.valid_up_to()];
                return Err(broken(&format!(
                    "not text in UTF-8 (byte 0x{byte:02X} in column {})",
                    error.valid_up_to() + 1
                )));
            }
            if number == 1 {
                let head: Head = serde_json::from_slice(&line).map_err(|_| broken("not the head of a journal"))?;
                if head.journal != KIND || head.format != 1 {
                    return Err(broken("not the head of a journal of this program"));
                }
                // A figure that is no longer wanted makes no other study.
                if head.study.iter().any(|line| line == "tractions = true") {
                    study.ask_for_tractions();
                }
                same_study(&path, &head.study, &lines(study))?;
                if head.rows != study.rows() {
                    return Err(broken("the head of a journal of a study with another number of scenes"));
                }
            } else {
                let record: Option<Value> = serde_json::from_slice(&line).ok();
                let record = record.filter(|record| columns.is_filled_by(record));
                let record = record.and_then(|record| Line::deserialize(record).ok());
                let record = record.ok_or_else(|| broken("no record of a sweep"))?;
                if record.index >= study.rows() {
                    return Err(broken("a record of a scene that the study does not have"));
                }
                self.tally.add(record.index, record.status == RecordStatus::Solved(Status::Converged));
            }
            kept += length as u64;
        }
    }

    /// What it holds.
    pub(super) fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Appends a record, in one piece.
    pub(super) fn append(&mut self, record: &Record) -> Result<(), Failure> {
        self.write(record)?;
        self.tally.add(record.index, record.is_converged());
        Ok(())
    }

    fn write(&mut self, line: &impl serde::Serialize) -> Result<(), Failure> {
        let mut text = serde_json::to_vec(line).expect("keys are strings");
        text.push(b'\n');
        self.file.write_all(&text).map_err(|error| failed(&self.path, &error))
    }

    /// The lines of the records in the order of the study, when all are there.
    pub(super) fn in_order(&self) -> io::Result<InOrder> {
        self.file.sync_data()?;
        let mut reader = BufReader::with_capacity(1 << 16, File::open(&self.path)?);
        let mut head = Vec::new();
        let at = reader.read_until(b'\n', &mut head)? as u64;
        Ok(InOrder { reader, at, other: File::open(&self.path)?, ahead: BTreeMap::new(), next: 0 })
    }
}

/// Refuses a file that is something else: it is not to be written to, cut or thrown away.
fn begins_as_journal(mut file: &File, path: &Path) -> Result<(), Failure> {
    let head = format!("{{\"journal\":\"{KIND}\"");
    let mut begin = Vec::new();
    file.seek(SeekFrom::Start(0)).map_err(|error| failed(path, &error))?;
    file.take(head.len() as u64).read_to_end(&mut begin).map_err(|error| failed(path, &error))?;
    if head.as_bytes().starts_with(&begin) {
        return Ok(());
    }
    Err(failed(path, &"line 1 is not the head of a journal; move that file away, or take another --out"))
}

fn lines(study: &Study) -> Vec<String> {
    study.description().lines().map(str::to_owned).collect()
}

fn failed(path: &Path, why: &dyn std::fmt::Display) -> Failure {
    Failure::System(format!("the journal {}: {why}", path.display()))
}

/// Refuses to go on with a study that has changed, and shows what did.
fn same_study(path: &Path, before: &[String], now: &[String]) -> Result<(), Failure> {
    /// Lines, and characters of each.
    const SHOWN: usize = 12;
    const LONGEST: usize = 160;
    if before == now {
        return Ok(());
    }
    let gone = before.iter().filter(|line| !now.contains(line)).map(|line| format!("journal: {}", clip(line, LONGEST)));
    let come = now.iter().filter(|line| !before.contains(line)).map(|line| format!("study:   {}", clip(line, LONGEST)));
    let mut changed: Vec<String> = gone.chain(come).collect();
    if changed.is_empty() {
        changed.push("the same lines in another order".into());
    }
    let more = changed.len().saturating_sub(SHOWN);
    changed.truncate(SHOWN);
    if more > 0 {
        changed.push(format!("and {more} lines more"));
    }
    Err(Failure::Usage(
        format!("the journal {} belongs to another study, or to this one before it was changed", path.display()),
        Some(format!(
            "what differs:\n{}\nchange it back, name another folder with --out, or begin anew with --fresh",
            changed.join("\n")
        )),
    ))
}

/// Records in the order of the study, read from a journal that has them nearly in order.
pub(super) struct InOrder {
    reader: BufReader<File>,
    /// Where the reader is.
    at: u64,
    /// Reads what the first one has passed.
    other: File,
    /// Where those stand that came too early: places, not lines, so that memory stays small whatever was late.
    ahead: BTreeMap<u64, (u64, usize)>,
    next: u64,
}

impl InOrder {
    /// The next record's line; `None` after the last.
    pub(super) fn next_line(&mut self) -> io::Result<Option<Vec<u8>>> {
        if let Some((at, length)) = self.ahead.remove(&self.next) {
            let mut line = vec![0; length];
            self.other.seek(SeekFrom::Start(at))?;
            self.other.read_exact(&mut line)?;
            self.next += 1;
            return Ok(Some(line));
        }
        let mut line = Vec::new();
        loop {
            line.clear();
            let length = self.reader.read_until(b'\n', &mut line)?;
            if length == 0 {
                return Ok(None);
            }
            let at = self.at;
            self.at += length as u64;
            let Line { index, .. } = serde_json::from_slice(&line)?;
            if index == self.next {
                self.next += 1;
                return Ok(Some(line));
            }
            // A scene that is there twice counts once.
            if index > self.next {
                self.ahead.entry(index).or_insert((at, length));
            }
        }
    }
}
