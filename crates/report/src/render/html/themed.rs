//! A chart within a page: in the colors of the page, with a name for readers who do not see.

use crate::number::with_micro;

/// Colors of a chart, and the colors of the page that replace them.
const THEMED: [(&str, &str); 12] = [
    ("#262626", "var(--ink)"),
    ("#000000", "var(--ink)"),
    ("#707070", "var(--grey)"),
    ("#E3E3E3", "var(--grid)"),
    ("#FFFFFF", "var(--paper)"),
    ("#0072B2", "var(--blue)"),
    ("#D55E00", "var(--red)"),
    ("#009E73", "var(--green)"),
    ("#CC79A7", "var(--pink)"),
    ("#E69F00", "var(--amber)"),
    ("#005A8F", "var(--deep)"),
    ("#B34A00", "var(--rust)"),
];

/// The chart as it stands in a page.
pub(crate) fn themed(svg: &str, caption: &str) -> String {
    let svg = THEMED.iter().fold(svg.to_owned(), |text, (from, to)| text.replace(from, to));
    let caption = with_micro(caption);
    let name = minijinja::HtmlEscape(&caption);
    svg.replacen("<title></title>", &format!("<title>{name}</title>"), 1)
}
