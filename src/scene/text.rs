//! From the bytes of a file to text.

use super::SceneError;

/// The largest scene that is read, in bytes.
pub const LARGEST: usize = MEGABYTES * 1024 * 1024;
const MEGABYTES: usize = 16;
/// The byte-order mark of UTF-8.
const MARK: &[u8] = &[0xEF, 0xBB, 0xBF];

/// The text of a scene file, `name` being what errors call it.
///
/// # Errors
/// When the bytes are no text (binary, UTF-16, NUL), none at all, or more than [`LARGEST`]. A byte-order mark of UTF-8,
/// which some editors write, is left out.
pub fn text(name: &str, bytes: Vec<u8>) -> Result<String, SceneError> {
    text_of("scene", name, bytes)
}

/// As [`text()`], of a file that is to be something else, such as a `study`.
///
/// # Errors
/// As [`text()`].
pub fn text_of(what: &str, name: &str, mut bytes: Vec<u8>) -> Result<String, SceneError> {
    if bytes.len() > LARGEST {
        return Err(too_large(what, name));
    }
    if bytes.is_empty() {
        let error = SceneError::whole(name, "the file is empty").found("0 bytes");
        return Err(error.expected(format!("a {what} in TOML")));
    }
    if let [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] = bytes.as_slice() {
        return Err(SceneError::whole(name, "the file starts with a byte-order mark of UTF-16")
            .found("UTF-16")
            .expected("UTF-8")
            .hint("save the file as \"UTF-8\" (not \"Unicode\")"));
    }
    if bytes.starts_with(MARK) {
        bytes.drain(..MARK.len());
    }
    let not_text = |bytes: &[u8], at: usize, found: String| {
        let before = String::from_utf8_lossy(&bytes[..at]);
        SceneError::at(name, &before, before.len()..before.len(), "the file is not text")
            .found(found)
            .expected(format!("a {what} in TOML, in UTF-8"))
    };
    if let Some(at) = bytes.iter().position(|&byte| byte == 0) {
        // Text before a NUL may itself be broken; then that is the first error.
        if std::str::from_utf8(&bytes[..at]).is_ok() {
            return Err(not_text(&bytes, at, "a NUL byte".into()));
        }
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let byte = error.as_bytes()[at];
        not_text(error.as_bytes(), at, format!("the byte 0x{byte:02X}, which starts no character of UTF-8"))
    })
}

/// A scene, or a study, above [`LARGEST`], whether or not it was read.
pub fn too_large(what: &str, name: &str) -> SceneError {
    SceneError::whole(name, format!("the {what} is too large"))
        .found(format!("more than {MEGABYTES} MB"))
        .expected(format!("at most {MEGABYTES} MB"))
        .hint("keep long tables in a file of their own")
}
