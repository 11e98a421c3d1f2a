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

/// Words on lines that fit a page, each but the last with the mark that a shell reads as "to be continued".
pub fn command_line(words: impl Iterator<Item = String>) -> String {
    const WIDTH: usize = 74;
    let mut lines: Vec<String> = Vec::new();
    for word in words {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < WIDTH => {
                line.push(' ');
                line.push_str(&word);
            }
            Some(_) => lines.push(format!("  {word}")),
            None => lines.push(word),
        }
    }
    lines.join(" \\\n")
}
