//! A text file line by line: one buffer, exact offsets, nothing longer than the limit.

use super::error::Fault;
use super::{FilePlace, FileProblem};
use std::io::{BufRead, Read};

/// Longest line that is read; a row of measurements has some hundred bytes.
pub(crate) const MAX_LINE_BYTES: usize = 1 << 20;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// A line as it stands in the file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawLine<'a> {
    /// Without line end and byte order mark.
    pub(crate) text: &'a str,
    /// Number from 1.
    pub(crate) number: u64,
    /// Offset of the text in the file.
    pub(crate) start: usize,
    /// True when a newline follows.
    pub(crate) ended: bool,
}

/// Reads lines into one buffer.
#[derive(Debug)]
pub(crate) struct Lines<R> {
    input: R,
    buffer: Vec<u8>,
    number: u64,
    next_start: usize,
}

impl<R: BufRead> Lines<R> {
    pub(crate) fn new(input: R) -> Self {
        Self { input, buffer: Vec::new(), number: 0, next_start: 0 }
    }

    /// The next line, or none at the end.
    pub(crate) fn next_line(&mut self) -> Result<Option<RawLine<'_>>, Fault> {
        self.buffer.clear();
        let start = self.next_start;
        let length = (&mut self.input).take(MAX_LINE_BYTES as u64 + 1).read_until(b'\n', &mut self.buffer)?;
        if length == 0 {
            return Ok(None);
        }
        self.number += 1;
        self.next_start += length;
        refuse_binary(&self.buffer, self.number, start)?;
        let ended = self.buffer.ends_with(b"\n");
        let mark = if self.number == 1 && self.buffer.starts_with(BYTE_ORDER_MARK) { 3 } else { 0 };
        let text = utf8(&self.buffer[mark..], self.number, start + mark)?;
        let text = text.trim_end_matches(['\n', '\r']);
        Ok(Some(RawLine { text, number: self.number, start: start + mark, ended }))
    }
}

fn refuse_binary(bytes: &[u8], number: u64, start: usize) -> Result<(), Fault> {
    let at = |offset: usize| FilePlace::line(number, start + offset..start + offset + 1);
    if number == 1 && is_utf16(bytes) {
        return Err(Fault::new(FilePlace::file(), FileProblem::Utf16));
    }
    if let Some(offset) = memchr::memchr(0, bytes) {
        return Err(Fault::new(at(offset), FileProblem::NulByte { byte: start + offset }));
    }
    if bytes.len() > MAX_LINE_BYTES {
        return Err(Fault::new(at(0), FileProblem::LineTooLong { limit_bytes: MAX_LINE_BYTES }));
    }
    Ok(())
}

/// A UTF-16 byte order mark, or a zero in every other byte at the start.
fn is_utf16(bytes: &[u8]) -> bool {
    let marked = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    marked || matches!(bytes, [0, x, 0, y, ..] | [x, 0, y, 0, ..] if *x != 0 && *y != 0)
}

fn utf8(bytes: &[u8], number: u64, start: usize) -> Result<&str, Fault> {
    std::str::from_utf8(bytes).map_err(|wrong| {
        let byte = start + wrong.valid_up_to();
        Fault::new(FilePlace::line(number, byte..byte + 1), FileProblem::NotUtf8 { byte })
    })
}

/// A whole small file as text; the same checks as for lines.
pub(crate) fn utf8_text(bytes: &[u8]) -> Result<&str, Fault> {
    if is_utf16(bytes) {
        return Err(Fault::new(FilePlace::file(), FileProblem::Utf16));
    }
    let line = |offset: usize| 1 + memchr::memchr_iter(b'\n', &bytes[..offset]).count() as u64;
    std::str::from_utf8(bytes).map_err(|wrong| {
        let byte = wrong.valid_up_to();
        Fault::new(FilePlace::line(line(byte), byte..byte + 1), FileProblem::NotUtf8 { byte })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_are_those_of_the_file() {
        let mut lines = Lines::new(&b"\xef\xbb\xbfab\r\ncd\n\nlast"[..]);
        let mut seen = Vec::new();
        while let Some(line) = lines.next_line().unwrap() {
            seen.push((line.text.to_owned(), line.number, line.start, line.ended));
        }
        let expected = [("ab", 1, 3, true), ("cd", 2, 7, true), ("", 3, 10, true), ("last", 4, 11, false)];
        assert_eq!(
            seen,
            expected.map(|(text, number, start, ended)| (text.to_owned(), number, start, ended))
        );
    }
}
