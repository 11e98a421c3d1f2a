//! Numbers in cells.

use std::borrow::Cow;

use super::FileProblem;

/// A number and whether it was written with a decimal comma.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Parsed {
    pub(crate) value: f64,
    pub(crate) comma: bool,
}

/// Largest number of a file, in its unit: far beyond every machine, and powers and products of such numbers are still finite.
const LARGEST: f64 = 1e30;
/// The smallest unit that files are written in: a number that was read can be written in it, and read again.
const SMALLEST_UNIT: f64 = 1e-6;

/// A number that can be computed with.
pub(crate) fn usable(value: f64) -> Result<f64, FileProblem> {
    if value.abs() <= LARGEST { Ok(value) } else { Err(FileProblem::TooLarge) }
}

/// The same of a number in SI.
pub(crate) fn usable_si(value: f64) -> Result<f64, FileProblem> {
    usable(value / SMALLEST_UNIT).map(|_| value)
}

/// A finite number. A decimal comma is read as a point; the caller knows whether the file may have them.
pub(crate) fn parse_number(text: &str) -> Result<Parsed, FileProblem> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(Parsed { value: usable(value)?, comma: false }),
        Ok(_) if text.bytes().any(|byte| byte.is_ascii_digit()) => Err(FileProblem::TooLarge),
        Ok(_) => Err(FileProblem::NotFinite),
        Err(_) if text.is_empty() => Err(FileProblem::EmptyCell),
        Err(_) => with_comma(text),
    }
}

fn with_comma(text: &str) -> Result<Parsed, FileProblem> {
    let text = &*with_hyphen(text);
    if let Some(value) = text.parse::<f64>().ok().filter(|value| value.is_finite()) {
        return Ok(Parsed { value: usable(value)?, comma: false });
    }
    let single = text.matches(',').count() == 1 && !text.contains('.');
    match text.replace(',', ".").parse::<f64>() {
        Ok(value) if single && value.is_finite() => Ok(Parsed { value: usable(value)?, comma: true }),
        _ => Err(no_number(text)),
    }
}

/// The minus of typesetting, and the dash that word processors make of it, as the hyphen of computers.
fn with_hyphen(text: &str) -> Cow<'_, str> {
    const MINUS: [char; 2] = ['\u{2212}', '\u{2013}'];
    if text.contains(MINUS) { text.replace(MINUS, "-").into() } else { text.into() }
}

/// What a cell is that is no number.
fn no_number(text: &str) -> FileProblem {
    if text.starts_with('=') {
        FileProblem::Formula
    } else if text.bytes().all(|byte| byte == b'#') {
        FileProblem::TooNarrow
    } else if stands_for_nothing(text) {
        FileProblem::NoValue
    } else if has_thousands(text) {
        FileProblem::Thousands
    } else if is_time_of_day(text) {
        FileProblem::TimeOfDay
    } else if is_date(text) {
        FileProblem::Date
    } else {
        FileProblem::NotANumber
    }
}

/// Words that people and programs write where there is no number.
fn stands_for_nothing(text: &str) -> bool {
    const WORDS: [&str; 18] = [
        "n/a",
        "na",
        "n.a.",
        "none",
        "null",
        "nil",
        "missing",
        "fail",
        "failed",
        "error",
        "err",
        "k.a.",
        "entf.",
        "x",
        "?",
        "overrange",
        "ovl",
        "invalid",
    ];
    let lower = text.to_lowercase();
    let is_dashes = lower.chars().all(|symbol| matches!(symbol, '-' | '\u{2014}' | '_' | '*' | '.'));
    let is_error = lower.starts_with('#') || lower.starts_with("error #") || lower.contains(".#");
    is_dashes || is_error || WORDS.contains(&lower.as_str())
}

/// Hours and minutes, perhaps seconds: `12:30`, `00:05:30.5`.
fn is_time_of_day(text: &str) -> bool {
    let parts: Vec<&str> = text.trim_end_matches(['A', 'P', 'M', 'a', 'p', 'm', ' ']).split(':').collect();
    let is_number = |part: &&str| part.parse::<f64>().is_ok_and(|number| (0.0..60.0).contains(&number));
    (2..=3).contains(&parts.len()) && parts.iter().all(is_number)
}

/// Digits in groups of three, perhaps with decimals: `1,234.5`, `1 234`, `1'234`.
fn has_thousands(text: &str) -> bool {
    let whole = text.trim_start_matches(['+', '-', '\u{2212}']);
    // Decimals stand behind another mark than the groups.
    let whole = match whole.rsplit_once(['.', ',']) {
        Some((before, decimals)) if decimals.len() != 3 || before.contains(['.', ',', ' ', '\'']) => before,
        _ => whole,
    };
    let digits = |group: &str| !group.is_empty() && group.bytes().all(|byte| byte.is_ascii_digit());
    let mut groups = whole.split(['.', ',', '\'', '\u{2019}', ' ', '\u{a0}', '\u{202f}']);
    let starts = groups.next().is_some_and(|first| digits(first) && first.len() <= 3);
    let mut others = groups.peekable();
    starts && others.peek().is_some() && others.all(|group| digits(group) && group.len() == 3)
}

/// Beginnings of the names of months in languages of spreadsheets.
const MONTHS: [&str; 30] = [
    "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec", "mär", "mrz", "mai",
    "okt", "dez", "fév", "avr", "jui", "aoû", "déc", "ene", "abr", "ago", "dic", "gen", "mag", "giu", "lug",
];

/// Day, month and perhaps year: `3.5.2026`, `2026-05-03`, `03-May`, `3. Mai`.
fn is_date(text: &str) -> bool {
    let parts: Vec<&str> = text.split(['.', '-', '/', ' ']).filter(|part| !part.is_empty()).collect();
    let number =
        |part: &str, digits: usize| part.len() <= digits && part.bytes().all(|byte| byte.is_ascii_digit());
    let month = |part: &str| {
        let beginning: String = part.chars().take(3).flat_map(char::to_lowercase).collect();
        part.chars().all(char::is_alphabetic) && MONTHS.contains(&beginning.as_str())
    };
    match parts[..] {
        [day, name] => (number(day, 2) && month(name)) || (month(day) && number(name, 2)),
        [day, name, year] if month(name) => number(day, 2) && number(year, 4),
        [one, two, three] => {
            let year = |part: &str| part.len() == 4 && number(part, 4);
            number(two, 2) && ((number(one, 2) && year(three)) || (year(one) && number(three, 2)))
        }
        _ => false,
    }
}

/// Which decimal signs a file has used so far; a file must keep to one.
#[derive(Debug, Default)]
pub(crate) struct Decimals {
    comma_line: Option<u64>,
    point_line: Option<u64>,
}

impl Decimals {
    /// Notes the sign of one number.
    pub(crate) fn note(&mut self, text: &str, parsed: Parsed, line: u64) -> Result<(), FileProblem> {
        let other_line = if parsed.comma {
            self.comma_line.get_or_insert(line);
            self.point_line
        } else if text.contains('.') {
            self.point_line.get_or_insert(line);
            self.comma_line
        } else {
            None
        };
        other_line.map_or(Ok(()), |other_line| Err(FileProblem::MixedDecimals { other_line }))
    }

    /// True when numbers were written with commas.
    pub(crate) fn has_comma(&self) -> bool {
        self.comma_line.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_to_the_last_bit() {
        for value in [0.1, -1e-300, 5e-324, LARGEST, -0.0, 123_456.789] {
            assert_eq!(parse_number(&value.to_string()).unwrap().value.to_bits(), f64::to_bits(value));
        }
    }

    #[test]
    fn what_is_no_number_has_its_own_reason() {
        assert!(matches!(parse_number("nan"), Err(FileProblem::NotFinite)));
        assert!(matches!(parse_number("-Infinity"), Err(FileProblem::NotFinite)));
        assert!(
            ["1e400", "-1e308", "1,1e30"]
                .iter()
                .all(|n| matches!(parse_number(n), Err(FileProblem::TooLarge)))
        );
        assert!(matches!(parse_number(""), Err(FileProblem::EmptyCell)));
        assert!(matches!(parse_number("1,234.5"), Err(FileProblem::Thousands)));
        assert!(matches!(parse_number("-1 338.5"), Err(FileProblem::Thousands)));
        assert!(matches!(parse_number("1'234"), Err(FileProblem::Thousands)));
        for date in ["3.5.2026", "2026-05-03", "03-May", "3. Mai", "Mai 26"] {
            assert!(matches!(parse_number(date), Err(FileProblem::Date)), "{date}");
        }
        for time in ["12:30", "00:05:30.5", "1:02 PM"] {
            assert!(matches!(parse_number(time), Err(FileProblem::TimeOfDay)), "{time}");
        }
        for nothing in ["n/a", "-", "\u{2014}", "NA", "#N/A", "#WERT!", "1.#QNAN", "---"] {
            assert!(matches!(parse_number(nothing), Err(FileProblem::NoValue)), "{nothing}");
        }
        assert!(matches!(parse_number("=A1*2"), Err(FileProblem::Formula)));
        assert!(matches!(parse_number("####"), Err(FileProblem::TooNarrow)));
        assert_eq!(parse_number("\u{2212}1,5").unwrap(), Parsed { value: -1.5, comma: true });
        assert_eq!(parse_number("\u{2013}1.5").unwrap(), Parsed { value: -1.5, comma: false });
        for neither in ["5 deg", "3 mrad", "12.5 mm", "1.2.3", "a.b", "1,2,3", "--5", "1 2"] {
            assert!(matches!(parse_number(neither), Err(FileProblem::NotANumber)), "{neither}");
        }
        assert!(matches!(parse_number("12 N"), Err(FileProblem::NotANumber)));
        assert_eq!(parse_number("-1,5e-3").unwrap(), Parsed { value: -1.5e-3, comma: true });
    }
}
