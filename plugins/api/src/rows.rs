//! The rows of a table, from a scene or from a file.

use crate::{Fault, Files, LARGEST_FILE, Place, clip};
use std::ops::{Range, RangeInclusive};

/// What stands in the columns of a table.
#[derive(Clone, Debug)]
pub struct Columns {
    /// How many there are.
    pub count: RangeInclusive<usize>,
    /// Their number in words, such as "two".
    pub number: &'static str,
    /// What they are, such as "x and height".
    pub names: &'static str,
}

/// What is wrong with a row.
#[derive(Clone, Debug)]
pub struct Wrong {
    /// The column, counted from 0; none for the row.
    pub column: Option<usize>,
    /// What is wrong, in one line.
    pub message: String,
    /// What was found.
    pub found: String,
    /// What would be right.
    pub expected: String,
    /// What to do.
    pub hint: Option<&'static str>,
}

impl Wrong {
    fn fault(self, path: &[&str]) -> Fault {
        let hint = self.hint.map(str::to_owned);
        Fault { hint, ..Fault::new(path, self.message).found(self.found).expected(self.expected) }
    }
}

/// That the first column, `name` with its article, ascends.
///
/// # Errors
/// In words, if it does not.
pub fn ascending(name: &str, before: Option<f64>, value: f64) -> Result<(), Wrong> {
    let Some(before) = before.filter(|before| value <= *before) else { return Ok(()) };
    let fault = if value < before { "that does not ascend" } else { "that was there before" };
    let (found, expected) = (format!("{value} after {before}"), format!("{name} above {before}"));
    Err(Wrong { column: Some(0), message: format!("{name} {fault}"), found, expected, hint: None })
}

/// That there are more rows than the `most` that are taken.
pub fn too_many(most: usize) -> Wrong {
    let (found, expected) = (format!("row {}", most + 1), format!("at most {most} rows"));
    Wrong { column: None, message: "too many rows".into(), found, expected, hint: None }
}

/// Where the rows of a table come from.
#[derive(Clone, Debug)]
pub enum Source<R> {
    /// The file of that name.
    File(String),
    /// The scene itself.
    Points(Vec<R>),
}

impl<R: AsRef<[f64]>> Source<R> {
    /// What a scene has under `file` and `points`, rows of `names`.
    ///
    /// # Errors
    /// In words, if it has both or neither.
    pub fn of_keys(file: Option<String>, points: Option<Vec<R>>, names: &str) -> Result<Self, String> {
        match (file, points) {
            (Some(file), None) => Ok(Self::File(file)),
            (None, Some(points)) => Ok(Self::Points(points)),
            (Some(_), Some(_)) => Err("expected one of `file` and `points`, found both".into()),
            (None, None) => Err(format!("expected `file` or `points` (rows of {names}), found neither")),
        }
    }

    /// What it is under `file` and `points`.
    pub fn into_keys(self) -> (Option<String>, Option<Vec<R>>) {
        match self {
            Self::File(file) => (Some(file), None),
            Self::Points(points) => (None, Some(points)),
        }
    }

    /// Hands on the rows, each to `take`.
    ///
    /// # Errors
    /// What `take` says, with the place in `points`; those of [`of_file`].
    pub fn rows(
        &self,
        files: &dyn Files,
        columns: &Columns,
        take: impl FnMut(&[f64]) -> Result<(), Wrong>,
    ) -> Result<(), Fault> {
        match self {
            Self::File(name) => of_file(name, files, columns, take),
            Self::Points(points) => of_points(points, take),
        }
    }

    /// A fault of all rows, with its place; one that names its own keeps that.
    pub fn fault(&self, fault: Fault) -> Fault {
        match self {
            _ if !fault.path.is_empty() => fault,
            Self::File(name) => Fault { path: vec!["file".into()], ..fault }.at(whole(name)),
            Self::Points(_) => Fault { path: vec!["points".into()], ..fault },
        }
    }
}

/// Hands on rows that the scene itself has under `points`, each to `take`.
fn of_points(points: &[impl AsRef<[f64]>], mut take: impl FnMut(&[f64]) -> Result<(), Wrong>) -> Result<(), Fault> {
    for (index, point) in points.iter().enumerate() {
        take(point.as_ref()).map_err(|wrong| {
            let index = index.to_string();
            let column = wrong.column.map(|column| column.to_string());
            let path: Vec<_> = ["points", &index].into_iter().chain(column.as_deref()).collect();
            wrong.fault(&path)
        })?;
    }
    Ok(())
}

/// Hands on the rows of a file that the scene names under `file`: columns between commas, semicolons, tabs or blanks.
/// Empty lines, what follows a `#`, and one line of headings are passed over.
///
/// # Errors
/// A file that cannot be had or is no text; a line that is no row of numbers; what `take` says; all with their place.
pub fn of_file(
    name: &str,
    files: &dyn Files,
    columns: &Columns,
    mut take: impl FnMut(&[f64]) -> Result<(), Wrong>,
) -> Result<(), Fault> {
    let bytes = files.read(name).map_err(|why| {
        let expected = format!("a file of rows of {}", columns.names);
        Fault::new(&["file"], "cannot read the file").found(why).expected(expected)
    })?;
    let text = text(name, &bytes, columns)?;
    let mut may_be_heading = true;
    for (index, line) in lines(text).enumerate() {
        let content = line.split('#').next().unwrap_or_default();
        if content.trim().is_empty() {
            continue;
        }
        let at = |span: Range<usize>| clipped(name, index + 1, line, span);
        let (count, fields) = fields(content);
        let fields = &fields[..count.min(MOST_COLUMNS)];
        let numbers = fields.iter().map(|span| number(&content[span.clone()]));
        if std::mem::take(&mut may_be_heading) && numbers.clone().all(|number| number.is_none()) {
            continue;
        }
        let whole = fields[0].start..content.trim_end().len();
        if !columns.count.contains(&count) {
            let fault = Fault::new(&["file"], format!("not a row of {} columns", columns.number)).at(at(whole));
            let found = if count == 1 { "1 column".into() } else { format!("{count} columns") };
            let expected = format!("{}, between commas, semicolons, tabs or blanks", columns.names);
            let fault = fault.found(found).expected(expected);
            return Err(if has_decimal_comma(content.trim()) { fault.hint(WITH_A_POINT) } else { fault });
        }
        let mut row = [0.0; MOST_COLUMNS];
        for ((number, span), cell) in numbers.zip(fields).zip(&mut row) {
            *cell = number.ok_or_else(|| {
                let found = &content[span.clone()];
                let fault = Fault::new(&["file"], "not a number").at(at(span.clone()));
                let fault = fault.found(format!("`{}`", clip(found, 40))).expected("a number such as 0.5");
                if found.contains(',') { fault.hint(WITH_A_POINT) } else { fault }
            })?;
        }
        take(&row[..count]).map_err(|wrong| {
            let span = wrong.column.map_or(whole.clone(), |column| fields[column].clone());
            wrong.fault(&["file"]).at(at(span))
        })?;
    }
    Ok(())
}

/// What is said of a comma within a number.
const WITH_A_POINT: &str = "decimals are written with a point";

/// Whether a line that something else divides into columns has a comma between two digits.
fn has_decimal_comma(line: &str) -> bool {
    let is_within = |digits: &[u8]| digits[0].is_ascii_digit() && digits[1] == b',' && digits[2].is_ascii_digit();
    line.contains([' ', '\t', ';']) && line.as_bytes().windows(3).any(is_within)
}

/// The most columns that a table may have.
const MOST_COLUMNS: usize = 4;

/// The place that is a file as a whole.
fn whole(name: &str) -> Place {
    Place::File { name: name.into(), line: 0, text: String::new(), span: 0..0 }
}

/// The text of a file.
fn text<'b>(name: &str, bytes: &'b [u8], columns: &Columns) -> Result<&'b str, Fault> {
    let fault = |message: &str| Fault::new(&["file"], message).at(whole(name));
    if bytes.len() > LARGEST_FILE {
        let fault = fault("the file is too large").found("more than 64 MB").expected("at most 64 MB");
        return Err(fault.hint("thin the rows out: a few hundred are enough"));
    }
    // Spreadsheets put a mark in front.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        let fault = fault("the file is not text").found("the mark of UTF-16").expected("text in UTF-8");
        return Err(fault.hint("save the file as \"UTF-8\" (not \"Unicode\")"));
    }
    std::str::from_utf8(bytes).map_err(|error| {
        let before = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
        let (number, start_of_line) = lines(&before).enumerate().last().unwrap_or_default();
        let end = start_of_line.len();
        let found = format!("the byte 0x{:02X}, which starts no character of UTF-8", bytes[error.valid_up_to()]);
        let place = clipped(name, 1 + number, start_of_line, end..end);
        fault("the file is not text").at(place).found(found).expected(format!("rows of {}, in UTF-8", columns.names))
    })
}

/// The lines of a text, however they end: by LF, by CR and LF, or by CR alone as of old.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    text.split(end).map(|line| line.strip_suffix('\r').unwrap_or(line))
}

/// How many fields a line has, and the first of them, without the blanks around them.
fn fields(line: &str) -> (usize, [Range<usize>; MOST_COLUMNS]) {
    let bytes = line.as_bytes();
    let separators: &[u8] = if bytes.contains(&b';') || bytes.contains(&b'\t') {
        b";\t"
    } else if bytes.contains(&b',') {
        b","
    } else {
        b" "
    };
    let mut fields = [const { 0..0 }; MOST_COLUMNS];
    let (mut count, mut from) = (0, 0);
    for part in bytes.split(|byte| separators.contains(byte)) {
        let start = from + part.len() - part.trim_ascii_start().len();
        let end = start + part.trim_ascii().len();
        // Blanks in a row separate once.
        if separators != b" " || start < end {
            if let Some(field) = fields.get_mut(count) {
                *field = start..end;
            }
            count += 1;
        }
        from += part.len() + 1;
    }
    (count, fields)
}

/// A number; also one in quotes, as some programs write them.
fn number(field: &str) -> Option<f64> {
    let plain = field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(field);
    plain.trim().parse().ok()
}

/// A place in a line, of which no more is kept than a message shows.
fn clipped(name: &str, line: usize, text: &str, span: Range<usize>) -> Place {
    const MOST: usize = 400;
    let mut end = text.len().min(MOST);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    Place::File { name: name.into(), line, text: text[..end].into(), span: span.start.min(end)..span.end.min(end) }
}
