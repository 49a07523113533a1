//! The rows of a table, from a scene or from a file, each number checked.

use slipzone_api::{Fault, Files, LARGEST_FILE, Place};
use std::ops::Range;

/// The most rows that are taken.
const MOST: usize = 1_000_000;

/// Points with ascending `x`.
pub(super) type Rows = Vec<[f64; 2]>;

/// Rows from the scene itself.
pub(super) fn of_points(points: &[[f64; 2]]) -> Result<Rows, Fault> {
    let mut rows = Vec::with_capacity(points.len());
    for (index, point) in points.iter().enumerate() {
        push(&mut rows, *point).map_err(|wrong| {
            let index = index.to_string();
            let column = wrong.column.map(|column| column.to_string());
            let path: Vec<_> = ["points", &index].into_iter().chain(column.as_deref()).collect();
            wrong.fault(&path)
        })?;
    }
    Ok(rows)
}

/// Rows from a file: two columns between commas, semicolons, tabs or blanks. Empty lines, what follows a `#`, and one
/// line of headings are passed over.
pub(super) fn of_file(name: &str, files: &dyn Files) -> Result<Rows, Fault> {
    let bytes = files.read(name).map_err(|why| {
        Fault::new(&["file"], "cannot read the file").found(why).expected("a file of rows `x, height`")
    })?;
    let text = text(name, &bytes)?;
    let mut rows = Rows::new();
    let mut may_be_heading = true;
    for (index, line) in text.lines().enumerate() {
        let content = line.split('#').next().unwrap_or_default();
        if content.trim().is_empty() {
            continue;
        }
        let at = |span: Range<usize>| clipped(name, index + 1, line, span);
        let (columns, fields) = fields(content);
        let numbers = fields.clone().map(|span| number(&content[span]));
        if std::mem::take(&mut may_be_heading) && numbers.iter().all(Option::is_none) {
            continue;
        }
        let whole = fields[0].start..content.trim_end().len();
        if columns != 2 {
            let fault = Fault::new(&["file"], "not a row of two columns").at(at(whole));
            let count = if columns == 1 { "1 column".into() } else { format!("{columns} columns") };
            return Err(fault.found(count).expected("x and height, between commas, semicolons, tabs or blanks"));
        }
        let number = |column: usize| {
            numbers[column].ok_or_else(|| {
                let span = &fields[column];
                let found = &content[span.clone()];
                let fault = Fault::new(&["file"], "not a number").at(at(span.clone()));
                let fault = fault.found(format!("`{}`", clip(found))).expected("a number such as 0.5");
                if found.contains(',') { fault.hint("decimals are written with a point") } else { fault }
            })
        };
        let row = [number(0)?, number(1)?];
        push(&mut rows, row).map_err(|wrong| {
            let span = wrong.column.map_or(whole.clone(), |column| fields[column].clone());
            wrong.fault(&["file"]).at(at(span))
        })?;
    }
    Ok(rows)
}

/// The place that is a file as a whole.
pub(super) fn whole(name: &str) -> Place {
    Place::File { name: name.into(), line: 0, text: String::new(), span: 0..0 }
}

/// What is wrong with a row.
struct Wrong {
    /// 0 for x, 1 for the height, none for the row.
    column: Option<usize>,
    message: &'static str,
    found: String,
    expected: String,
}

impl Wrong {
    fn fault(self, path: &[&str]) -> Fault {
        Fault::new(path, self.message).found(self.found).expected(self.expected)
    }
}

/// Appends a row that follows those before it.
fn push(rows: &mut Rows, row: [f64; 2]) -> Result<(), Wrong> {
    for (column, value) in row.iter().enumerate() {
        if !(*value == 0.0 || (1e-100..=1e100).contains(&value.abs())) {
            let message = if column == 0 { "an x that is not allowed" } else { "a height that is not allowed" };
            let expected = "0, or a number between 1e-100 and 1e100, or its negative".into();
            return Err(Wrong { column: Some(column), message, found: format!("`{value}`"), expected });
        }
    }
    if let Some([before, _]) = rows.last()
        && row[0] <= *before
    {
        let is_less = row[0] < *before;
        let message = if is_less { "an x that does not ascend" } else { "an x that was there before" };
        let (found, expected) = (format!("{} after {before}", row[0]), format!("an x above {before}"));
        return Err(Wrong { column: Some(0), message, found, expected });
    }
    if rows.len() == MOST {
        let (found, expected) = (format!("row {}", MOST + 1), format!("at most {MOST} rows"));
        return Err(Wrong { column: None, message: "too many rows", found, expected });
    }
    rows.push(row);
    Ok(())
}

/// The text of a file.
fn text<'b>(name: &str, bytes: &'b [u8]) -> Result<&'b str, Fault> {
    let fault = |message: &str| Fault::new(&["file"], message).at(whole(name));
    if bytes.len() > LARGEST_FILE {
        let fault = fault("the file is too large").found("more than 64 MB").expected("at most 64 MB");
        return Err(fault.hint("thin the points out: a few hundred describe a shape"));
    }
    // Spreadsheets put a mark in front.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        let fault = fault("the file is not text").found("the mark of UTF-16").expected("text in UTF-8");
        return Err(fault.hint("save the file as \"UTF-8\" (not \"Unicode\")"));
    }
    std::str::from_utf8(bytes).map_err(|error| {
        let before = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
        let line = 1 + before.matches('\n').count();
        let start_of_line = before.rsplit('\n').next().unwrap_or_default();
        let end = start_of_line.len();
        let found = format!("the byte 0x{:02X}, which starts no character of UTF-8", bytes[error.valid_up_to()]);
        let place = clipped(name, line, start_of_line, end..end);
        fault("the file is not text").at(place).found(found).expected("rows of x and height, in UTF-8")
    })
}

/// How many fields a line has, and the first two of them, without the blanks around them.
fn fields(line: &str) -> (usize, [Range<usize>; 2]) {
    let bytes = line.as_bytes();
    let separators: &[u8] = if bytes.contains(&b';') || bytes.contains(&b'\t') {
        b";\t"
    } else if bytes.contains(&b',') {
        b","
    } else {
        b" "
    };
    let mut fields = [0..0, 0..0];
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

/// The beginning of a text.
fn clip(text: &str) -> String {
    const MOST: usize = 40;
    let short: String = text.chars().take(MOST).collect();
    if short.len() == text.len() { short } else { short + "..." }
}
