//! The offending line of a file, shortened around the offending text.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

use hexbench_core::visible;
use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

/// Characters shown before and after the offending text.
const CONTEXT: usize = 28;
/// Most characters of the offending text itself.
const MOST_MARKED: usize = 40;
/// Bytes read before and after it to find the ends of the line.
const REACH: usize = 4096;

/// One shortened line; it answers every question for a span with that line.
#[derive(Debug)]
pub(crate) struct Excerpt {
    name: String,
    text: String,
    /// Offending text within `text`.
    span: Range<usize>,
    /// Line of the file, from 0.
    line: usize,
    /// Characters of the line before the offending text, when the line is not longer than what was read.
    column: usize,
}

impl Excerpt {
    /// The line that holds the bytes `span` of a file; `None` when it can no longer be read.
    pub(crate) fn of(path: &Path, span: &Range<usize>, line: u64) -> Option<Self> {
        let from = span.start.saturating_sub(REACH);
        let mut file = File::open(path).ok()?;
        file.seek(SeekFrom::Start(from as u64)).ok()?;
        let mut bytes = Vec::new();
        file.take((span.end - from + REACH) as u64).read_to_end(&mut bytes).ok()?;
        let inside = span.start - from..(span.end - from).min(bytes.len());
        let (before, column) = line_tail(&String::from_utf8_lossy(bytes.get(..inside.start)?));
        let middle = line_head(&String::from_utf8_lossy(bytes.get(inside.clone())?), MOST_MARKED);
        let after = line_head(&String::from_utf8_lossy(&bytes[inside.end..]), CONTEXT);
        let [before, middle, after] = [before, middle, after].map(|part| visible(&part).into_owned());
        let span = before.len()..before.len() + middle.len();
        let name = visible(&path.display().to_string()).into_owned();
        Some(Self {
            name,
            text: format!("{before}{middle}{after}"),
            span,
            line: usize::try_from(line).ok()?.saturating_sub(1),
            column,
        })
    }

    /// Where the offending text is in the excerpt.
    pub(crate) fn span(&self) -> SourceSpan {
        (self.span.start, self.span.len()).into()
    }
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        _: &SourceSpan,
        _: usize,
        _: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let all: SourceSpan = (0, self.text.len()).into();
        let name = self.name.clone();
        Ok(Box::new(MietteSpanContents::new_named(
            name,
            self.text.as_bytes(),
            all,
            self.line,
            self.column,
            1,
        )))
    }
}

/// End of the last line, shortened, and the number of characters of that line.
fn line_tail(text: &str) -> (String, usize) {
    let line = text.rsplit('\n').next().unwrap_or_default();
    let count = line.chars().count();
    if count <= CONTEXT {
        return (line.to_owned(), count);
    }
    (format!("...{}", line.chars().skip(count - CONTEXT).collect::<String>()), count)
}

/// Beginning of the first line, shortened to a number of characters.
fn line_head(text: &str, most: usize) -> String {
    let line = text.split(['\r', '\n']).next().unwrap_or_default();
    if line.chars().count() <= most {
        return line.to_owned();
    }
    format!("{}...", line.chars().take(most).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_is_cut_on_both_sides_of_the_offence() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("long.csv");
        let text = format!("head\n{}abc,{}\n", "1,".repeat(100), "2,".repeat(100));
        std::fs::write(&path, &text).unwrap();
        let start = text.find("abc").unwrap();
        let excerpt = Excerpt::of(&path, &(start..start + 3), 2).unwrap();
        assert_eq!(&excerpt.text[excerpt.span.clone()], "abc");
        assert!(excerpt.text.starts_with("...1,") && excerpt.text.ends_with("..."));
        assert_eq!((excerpt.line, excerpt.column), (1, 200));
    }

    #[test]
    fn a_whole_line_is_marked_by_its_beginning() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("wide.csv");
        std::fs::write(&path, "9,".repeat(100)).unwrap();
        let excerpt = Excerpt::of(&path, &(0..200), 1).unwrap();
        assert_eq!(excerpt.text.len(), MOST_MARKED + 3);
    }
}
