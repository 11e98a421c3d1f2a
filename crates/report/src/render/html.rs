//! A page for a browser: one file that needs nothing else, for the screen (light and dark) and for paper.
//!
//! Every text is escaped; only charts drawn by [`crate::plot`] enter as they are. Their neutral colors follow the theme.

mod inline;
mod themed;

use hexbench_core::visible_lines;
use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment, Value, context};

use crate::page::Page;

use super::markdown::sentence;

pub(crate) use self::themed::themed;

/// What makes the pages, as they say themselves.
pub const PROGRAM: &str = concat!("hexbench ", env!("CARGO_PKG_VERSION"));

/// True for a page that this program wrote, in whatever version: such a file may be replaced.
pub fn is_own(page: &str) -> bool {
    page.contains("<meta name=\"generator\" content=\"hexbench ")
}

/// A page that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("the page could not be laid out: {0}")]
pub struct PageError(#[from] minijinja::Error);

/// The page as HTML.
///
/// # Errors
/// [`PageError`] when the template fails: a fault of the program.
pub fn html(page: &Page) -> Result<String, PageError> {
    const NAME: &str = "report.html";
    let mut pages = Environment::new();
    pages.set_auto_escape_callback(|_| AutoEscape::Html);
    pages.add_filter("themed", |svg: &str, caption: &str| {
        Value::from_safe_string(themed::themed(svg, caption))
    });
    pages.add_filter("inline", |text: &str| Value::from_safe_string(inline::inline(text)));
    pages.add_filter("column_title", inline::title);
    pages.add_filter("sentence", sentence);
    pages.add_template(NAME, include_str!("../../templates/report.html"))?;
    let style = Value::from_safe_string(include_str!("../../templates/report.css").to_owned());
    let text = pages
        .get_template(NAME)?
        .render(context! { page => Value::from(Serde(page)), style, program => PROGRAM })?;
    // A page goes to terminals too (`--html -`), and letters that turn the direction of writing act in a browser as well.
    Ok(visible_lines(&text).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::{Block, Figure, Section};

    #[test]
    fn text_is_escaped_and_charts_are_not() {
        let section = Section::new("<b>").paragraph("a < b & \"c\", `x < y`").with(Block::Figure(
            Figure::new("<svg fill=\"#262626\"><title></title></svg>".to_owned(), "a <caption>"),
        ));
        let html = html(&Page::new("<script>").with(section)).unwrap_or_default();
        assert!(!html.contains("<script>") && html.contains("&lt;script&gt;"));
        assert!(html.contains("a &lt; b &amp;") && html.contains("<code>x &lt; y</code>"), "{html}");
        assert!(html.contains("<svg fill=\"var(--ink)\"><title>a &lt;caption&gt;</title></svg>"), "{html}");
    }

    #[test]
    fn a_page_knows_its_own() {
        assert!(is_own(&html(&Page::default()).unwrap_or_default()));
        assert!(!is_own("<!doctype html><p>hexbench 0.1.0"));
    }

    #[test]
    fn nothing_is_loaded_from_elsewhere() {
        let html = html(&Page::default().with(Section::new("a").with(Block::code("ls")))).unwrap_or_default();
        assert!(!html.contains("http://") && !html.contains("https://") && !html.contains("url("), "{html}");
    }
}
