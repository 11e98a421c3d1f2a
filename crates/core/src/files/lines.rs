//! A text file line by line: one buffer, exact offsets, nothing longer than the limit.

use std::io::{BufRead, Cursor, Read};

use encoding_rs::{UTF_8, WINDOWS_1252};

use super::error::Fault;
use super::records::MARK;
use super::{FilePlace, FileProblem};

/// Longest line that is read; a row of measurements has some hundred bytes.
pub(crate) const MAX_LINE_BYTES: usize = 1 << 20;
/// Longest file that is decoded as a whole.
const MOST_DECODED_BYTES: u64 = 1 << 28;

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
pub(crate) struct Lines<R> {
    input: Input<R>,
    buffer: Vec<u8>,
    /// A line that is not UTF-8, as Windows-1252.
    decoded: String,
    /// What the file is written in, other than UTF-8.
    pub(crate) encoding: Option<&'static str>,
    number: u64,
    next_start: usize,
}

/// The bytes of a file as they come, or all of them decoded.
enum Input<R> {
    Plain(R),
    Decoded(Cursor<String>),
}

impl<R: BufRead> Lines<R> {
    pub(crate) fn new(input: R) -> Self {
        Self {
            input: Input::Plain(input),
            buffer: Vec::new(),
            decoded: String::new(),
            encoding: None,
            number: 0,
            next_start: 0,
        }
    }

    /// The next line into the buffer; its bytes.
    fn fill(&mut self) -> Result<usize, Fault> {
        const LIMIT: u64 = MAX_LINE_BYTES as u64 + 1;
        if self.number == 0 {
            self.decode_marked()?;
        }
        Ok(match &mut self.input {
            Input::Plain(input) => input.take(LIMIT).read_until(b'\n', &mut self.buffer)?,
            Input::Decoded(text) => text.take(LIMIT).read_until(b'\n', &mut self.buffer)?,
        })
    }

    /// Two bytes per character are told by the mark before them.
    fn decode_marked(&mut self) -> Result<(), Fault> {
        let Input::Plain(input) = &mut self.input else { return Ok(()) };
        let Some((encoding, _)) = encoding_rs::Encoding::for_bom(input.fill_buf()?) else { return Ok(()) };
        if encoding == UTF_8 {
            return Ok(());
        }
        let mut bytes = Vec::new();
        input.take(MOST_DECODED_BYTES).read_to_end(&mut bytes)?;
        let (text, _, is_damaged) = encoding.decode(&bytes);
        if is_damaged || bytes.len() as u64 == MOST_DECODED_BYTES {
            return Err(Fault::new(FilePlace::file(), FileProblem::Utf16));
        }
        self.encoding = Some(encoding.name());
        self.input = Input::Decoded(Cursor::new(text.into_owned()));
        Ok(())
    }

    /// The next line, or none at the end.
    pub(crate) fn next_line(&mut self) -> Result<Option<RawLine<'_>>, Fault> {
        self.buffer.clear();
        let start = self.next_start;
        let length = self.fill()?;
        if length == 0 {
            return Ok(None);
        }
        self.number += 1;
        self.next_start += length;
        if self.number == 1 && self.buffer.first() == Some(&MARK) {
            // Names of records have no line.
            self.buffer.remove(0);
            self.number = 0;
        }
        refuse_binary(&self.buffer, self.number, start)?;
        let ended = self.buffer.ends_with(b"\n");
        let mark = if self.number == 1 && self.buffer.starts_with(BYTE_ORDER_MARK) { 3 } else { 0 };
        let text = if let Ok(text) = std::str::from_utf8(&self.buffer[mark..]) {
            text
        } else {
            self.encoding = Some(WINDOWS_1252.name());
            self.decoded = WINDOWS_1252.decode_without_bom_handling(&self.buffer[mark..]).0.into_owned();
            &self.decoded
        };
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
