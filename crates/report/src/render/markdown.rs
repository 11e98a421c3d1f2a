//! A page as Markdown.

use crate::page::{Block, Cell, Definition, Page, Section, Table};

use super::layout::{WIDTH, length, padded, wrapped};

/// The page as Markdown; charts by their files.
pub fn markdown(page: &Page) -> String {
    let page = &page.visible();
    let title = (!page.title.is_empty()).then(|| format!("# {}", page.title));
    let subject = (!page.subject.is_empty()).then(|| entries(&page.subject));
    let blocks: Vec<String> =
        title.into_iter().chain(subject).chain(page.sections.iter().flat_map(section)).collect();
    blocks.join("\n\n") + "\n"
}

fn section(section: &Section) -> Vec<String> {
    let blocks: Vec<String> = section.blocks.iter().filter_map(block).collect();
    if blocks.is_empty() && !section.blocks.is_empty() {
        return Vec::new();
    }
    let heading = format!("{} {}", "#".repeat(section.depth + 1), section.title);
    let heading = (!section.title.is_empty()).then_some(heading);
    let remark = (!section.remark.is_empty()).then(|| hung("", "", &sentence(&section.remark)));
    heading.into_iter().chain(remark).chain(blocks).collect()
}

fn block(block: &Block) -> Option<String> {
    Some(match block {
        Block::Verdict { word, sentences, .. } => {
            let [first, rest @ ..] = sentences.as_slice() else { return Some(format!("**{word}**")) };
            let first = hung("", "", &format!("**{word}** {first}"));
            std::iter::once(first)
                .chain(rest.iter().map(|s| hung("", "", s)))
                .collect::<Vec<_>>()
                .join("\n\n")
        }
        Block::Paragraph { text, .. } => hung("", "", text),
        Block::List { items } => lines(items, |item| hung("- ", "  ", item)),
        Block::Entries { number: Some(n), entries: all } => {
            let parts: Vec<String> = all.iter().map(|e| format!("{}: {}", e.label, e.text)).collect();
            hung(&format!("{n}. "), "   ", &parts.join("; "))
        }
        Block::Entries { entries: all, .. } => entries(all),
        Block::Code { text } => format!("```text\n{}\n```", text.trim_end()),
        Block::Table(t) => table(t),
        Block::Figure(figure) => format!("![{}]({})", figure.caption, figure.file.as_ref()?),
    })
}

fn entries(all: &[Definition]) -> String {
    lines(all, |e| hung("- ", "  ", &format!("{}: {}", e.label, e.text)))
}

fn lines<T>(items: &[T], render: impl Fn(&T) -> String) -> String {
    items.iter().map(render).collect::<Vec<_>>().join("\n")
}

/// Text wrapped to the width, the first line after `first`, the others after `rest`.
fn hung(first: &str, rest: &str, text: &str) -> String {
    let all = wrapped(text, WIDTH - rest.len().max(first.len()));
    let line = |(k, line): (usize, &String)| format!("{}{line}", if k == 0 { first } else { rest });
    all.iter().enumerate().map(line).collect::<Vec<_>>().join("\n")
}

/// A remark as a sentence: a capital first letter, unless it begins with a unit or a name, and a full stop.
pub(super) fn sentence(remark: &str) -> String {
    const UNITS: [&str; 5] = ["um", "mm", "urad", "deg", "m"];
    let first = remark.split_whitespace().next().unwrap_or("");
    let is_word = !UNITS.contains(&first) && first.chars().all(char::is_alphabetic);
    let mut letters = remark.chars();
    let head = letters.next().map(|c| if is_word { c.to_uppercase().collect() } else { c.to_string() });
    let stop = if remark.ends_with(['.', '?', ':']) { "" } else { "." };
    format!("{}{}{stop}", head.unwrap_or_default(), letters.as_str())
}

/// Columns of bars repeat a number and are left out.
fn table(t: &Table) -> String {
    const NARROWEST: usize = 3;
    let holds_bars = |k: usize| t.rows.iter().any(|r| matches!(r.get(k), Some(Cell::Bar { .. })));
    let kept: Vec<usize> = (0..t.columns.len()).filter(|&k| !holds_bars(k)).collect();
    let width = |k: usize| {
        let cells = (0..t.rows.len()).map(|r| length(&escaped(t.text(r, k))));
        cells.max().unwrap_or(0).max(length(&t.columns[k].title)).max(NARROWEST)
    };
    let widths: Vec<usize> = kept.iter().map(|&k| width(k)).collect();
    let line = |cell: &dyn Fn(usize) -> String| {
        let cells = kept.iter().zip(&widths).map(|(&k, w)| padded(&cell(k), *w, t.columns[k].words));
        format!("| {} |", cells.collect::<Vec<_>>().join(" | "))
    };
    let rule = kept
        .iter()
        .zip(&widths)
        .map(|(&k, w)| format!("{}{}", "-".repeat(w - 1), if t.columns[k].words { "-" } else { ":" }));
    let rule = format!("| {} |", rule.collect::<Vec<_>>().join(" | "));
    let rows = (0..t.rows.len()).map(|r| line(&|k| escaped(t.text(r, k))));
    let title = (!t.title.is_empty()).then(|| format!("{}\n", t.title));
    title
        .into_iter()
        .chain([line(&|k| t.columns[k].title.clone()), rule])
        .chain(rows)
        .collect::<Vec<_>>()
        .join("\n")
}

/// A bar within a cell would end it.
fn escaped(text: &str) -> String {
    text.replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Figure;

    #[test]
    fn a_page_is_markdown() {
        let section = Section::new("Part")
            .paragraph("word ".repeat(40))
            .list(["one", "two"])
            .table(Table::named(["leg", "k"]).rows([["1", "4.20"]]))
            .with(Block::Figure(Figure::in_file("a.svg", "A curve")));
        let text = markdown(&Page::new("Title").with(section));
        assert!(text.starts_with("# Title\n\n## Part\n\nword word"));
        assert!(text.contains("- one\n- two\n\n| leg |    k |\n| --- | ---: |\n| 1   | 4.20 |"));
        assert!(text.ends_with("![A curve](a.svg)\n"));
        assert!(text.lines().all(|l| length(l) <= WIDTH));
    }

    #[test]
    fn a_remark_becomes_a_sentence() {
        assert_eq!(sentence("elongation of each leg, um"), "Elongation of each leg, um.");
        assert_eq!(sentence("um and deg"), "um and deg.");
        assert_eq!(sentence("on held-out poses"), "On held-out poses.");
        assert_eq!(sentence("`hexbench terms` explains"), "`hexbench terms` explains.");
    }
}
