//! Shares of trials in words, with their exact bounds.

use hexbench_core::statistics::Proportion;
use hexbench_report::number::hundredths;

/// `9 of 2002 (0.4 %, 0.2 .. 0.9)`.
pub(crate) fn in_words(p: Proportion) -> String {
    format!("{} of {} ({} %, {})", p.hits, p.of, hundredths(p.rate()), bounds(p))
}

/// What stands for nothing.
pub(crate) fn dash() -> String {
    "-".to_owned()
}

/// What is shown of a value; a dash of none.
pub(crate) fn or_dash<T>(value: Option<T>, shown: impl FnOnce(T) -> String) -> String {
    value.map_or_else(dash, shown)
}

/// `9 of 20 (23.1 .. 68.5 %)`; a dash of nothing.
pub(crate) fn counted(p: Proportion) -> String {
    if p.of == 0 { dash() } else { format!("{} of {} ({} %)", p.hits, p.of, bounds(p)) }
}

/// Exact 95 % bounds in percent; a dash of nothing.
pub(crate) fn bounds(p: Proportion) -> String {
    if p.of == 0 {
        return dash();
    }
    let [low, high] = p.interval();
    format!("{} .. {}", hundredths(low), hundredths(high))
}

/// Percent; a dash of nothing.
pub(crate) fn percent(p: Proportion) -> String {
    if p.of == 0 { dash() } else { hundredths(p.rate()) }
}
