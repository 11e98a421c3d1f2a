//! Words of a command line.

use std::ffi::OsStr;

/// A word as a shell takes it.
pub fn as_word(word: impl AsRef<OsStr>) -> String {
    let word = word.as_ref().to_string_lossy();
    let is_plain = |c: char| c.is_alphanumeric() || "-_./=:,+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.into_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// An option with its value, which may be any text.
pub fn as_option(name: &str, value: impl AsRef<OsStr>) -> String {
    format!("--{name} {}", as_word(value))
}
