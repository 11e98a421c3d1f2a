//! Reading a TOML file of a stated format.

use super::dialect::is_table;
use super::error::Fault;
use super::lines::utf8_text;
use super::next_step::FILES_IN_ORDER;
use super::toml_value::{KeyUnit, TomlSection, place_of};
use super::{FileError, FilePlace, FileProblem};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use toml::de::DeTable;

const MAX_FILE_BYTES: usize = 1 << 20;

/// A format: what `format = "..."` must say, and the keys of the top level (`format` among them).
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// Name and version, for example `hexapod/1`.
    pub name: &'static str,
    /// Keys of the top level.
    pub keys: &'static [KeyUnit],
}

/// Reads a TOML file of a format and hands its top level to `make`.
///
/// # Errors
/// No such file, not TOML, another format, an unknown key, or the fault that `make` found.
pub fn read_toml<T>(
    path: &Path,
    format: Format,
    make: impl FnOnce(&TomlSection<'_>) -> Result<T, Fault>,
) -> Result<T, FileError> {
    let parsed = read_file(path).and_then(|bytes| parse_toml(utf8_text(&bytes)?, format, make));
    parsed.map_err(|fault| fault.in_file(path))
}

/// The same from text; `name` stands for the file in messages.
///
/// # Errors
/// As [`read_toml`].
pub fn read_toml_text<T>(
    text: &str,
    name: &Path,
    format: Format,
    make: impl FnOnce(&TomlSection<'_>) -> Result<T, Fault>,
) -> Result<T, FileError> {
    parse_toml(text, format, make).map_err(|fault| fault.in_file(name))
}

/// The text of a small file, UTF-8.
///
/// # Errors
/// No such file, a file of more than 1 MiB, a byte that is no text, with its line.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    let text = read_file(path).and_then(|bytes| Ok(utf8_text(&bytes)?.to_owned()));
    text.map_err(|fault| fault.in_file(path))
}

pub(crate) fn parse_toml<T>(
    text: &str,
    format: Format,
    make: impl FnOnce(&TomlSection<'_>) -> Result<T, Fault>,
) -> Result<T, Fault> {
    let root = DeTable::parse(text).map_err(|wrong| {
        if is_table(text) {
            let rule = format!("this is a table, not a file of the format {}", format.name);
            return Fault::rule(FilePlace::file(), rule, FILES_IN_ORDER);
        }
        let place = wrong.span().map_or_else(FilePlace::file, |span| place_of(text, &span));
        Fault::new(place, FileProblem::Toml(wrong.message().replace('\n', " ")))
    })?;
    // The format first: a file of another format may have other keys.
    check_format(&TomlSection::peek(text, root.get_ref(), format.keys)?, format.name)?;
    make(&TomlSection::open(text, "", root.get_ref(), format.keys)?)
}

fn read_file(path: &Path) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_FILE_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > MAX_FILE_BYTES {
        return Err(Fault::new(FilePlace::file(), FileProblem::FileTooLong { limit_bytes: MAX_FILE_BYTES }));
    }
    Ok(bytes)
}

fn check_format(top: &TomlSection<'_>, expected: &'static str) -> Result<(), Fault> {
    let Some(format) = top.get("format") else {
        return Err(Fault::new(FilePlace::file(), FileProblem::Format { expected }));
    };
    if format.string()? == expected { Ok(()) } else { Err(format.fault(FileProblem::Format { expected })) }
}
