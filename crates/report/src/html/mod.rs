//! A page for a browser: one file that needs nothing else, for the screen (light and dark) and for paper.
//!
//! Every text is escaped; only charts drawn by [`crate::plot`] enter as they are. Their neutral colours follow the theme.

mod block;
mod figure;

use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment, context};
use serde::Serialize;

pub use block::{Block, Cell, Mood};

/// What makes the pages, as they say themselves.
pub const PROGRAM: &str = concat!("hexbench ", env!("CARGO_PKG_VERSION"));

/// True for a page that this program wrote, in whatever version: such a file may be replaced.
pub fn is_own(page: &str) -> bool {
    page.contains("<meta name=\"generator\" content=\"hexbench ")
}

/// A page of sections.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Page {
    /// Its title.
    pub title: String,
    /// What it is about, in a line.
    pub subject: String,
    /// From top to bottom.
    pub sections: Vec<Section>,
}

/// A titled part of a page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Section {
    /// Anchor within the page: lower-case letters and hyphens.
    pub id: &'static str,
    /// Heading.
    pub title: String,
    /// Small print below it; may be empty.
    pub remark: String,
    /// What it shows.
    pub blocks: Vec<Block>,
}

impl Section {
    /// An empty section.
    pub fn new(id: &'static str, title: impl Into<String>, remark: impl Into<String>) -> Self {
        Self { id, title: title.into(), remark: remark.into(), blocks: Vec::new() }
    }

    /// The section with one block more.
    #[must_use]
    pub fn with(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// Name and chart of a block that is one.
    fn figure<'a>(&self, block: &'a Block) -> Option<(String, &'a str)> {
        match block {
            Block::Figure { name, svg, .. } if name.is_empty() => Some((self.id.to_owned(), svg)),
            Block::Figure { name, svg, .. } => Some((format!("{}-{name}", self.id), svg)),
            _ => None,
        }
    }
}

/// A page that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("the page could not be laid out: {0}")]
pub struct PageError(#[from] minijinja::Error);

impl Page {
    /// Every chart with its name: that of its section, and its own where the section has several.
    pub fn figures(&self) -> impl Iterator<Item = (String, &str)> {
        self.sections.iter().flat_map(|section| section.blocks.iter().filter_map(|b| section.figure(b)))
    }

    /// The page as HTML.
    ///
    /// # Errors
    /// [`PageError`] when the template fails: a fault of the program.
    pub fn to_html(&self) -> Result<String, PageError> {
        const NAME: &str = "report.html";
        let mut pages = Environment::new();
        pages.set_auto_escape_callback(|_| AutoEscape::Html);
        pages.add_filter("themed", |svg: &str, caption: &str| {
            minijinja::Value::from_safe_string(figure::themed(svg, caption))
        });
        pages.add_template(NAME, include_str!("../../templates/report.html"))?;
        let style = minijinja::Value::from_safe_string(include_str!("../../templates/report.css").to_owned());
        Ok(pages
            .get_template(NAME)?
            .render(context! { page => minijinja::Value::from(Serde(self)), style, program => PROGRAM })?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped_and_charts_are_not() {
        let section = Section::new("verdict", "<b>", "")
            .with(Block::paragraph("a < b & \"c\""))
            .with(Block::figure("<svg fill=\"#262626\"><title></title></svg>".to_owned(), "a <caption>"));
        let page = Page { title: "<script>".to_owned(), subject: String::new(), sections: vec![section] };
        let html = page.to_html().unwrap_or_default();
        assert!(!html.contains("<script>") && html.contains("&lt;script&gt;"));
        assert!(html.contains("a &lt; b &amp;"));
        assert!(html.contains("<svg fill=\"var(--ink)\"><title>a &lt;caption&gt;</title></svg>"), "{html}");
    }

    #[test]
    fn charts_are_named_by_their_section_and_keep_their_colours() {
        let chart = || "<svg fill=\"#262626\"></svg>".to_owned();
        let residuals = Section::new("residuals", "", "")
            .with(Block::named_figure("force", chart(), ""))
            .with(Block::named_figure("length", chart(), ""));
        let machine = Section::new("machine", "", "").with(Block::figure(chart(), ""));
        let page = Page { sections: vec![residuals, machine], ..Page::default() };
        let names: Vec<String> = page.figures().map(|(name, _)| name).collect();
        assert_eq!(names, ["residuals-force", "residuals-length", "machine"]);
        assert!(page.figures().all(|(_, svg)| svg == chart()));
    }

    #[test]
    fn a_page_knows_its_own() {
        assert!(is_own(&Page::default().to_html().unwrap_or_default()));
        assert!(!is_own("<!doctype html><p>hexbench 0.1.0"));
    }

    #[test]
    fn nothing_is_loaded_from_elsewhere() {
        let html = Page::default().to_html().unwrap_or_default();
        assert!(!html.contains("http://") && !html.contains("https://") && !html.contains("url("), "{html}");
    }
}
