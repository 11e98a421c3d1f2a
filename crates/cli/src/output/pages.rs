//! Results as files: JSON, a page for a browser, its charts.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_core::files::{atomic_write, content_hash};
use hexbench_core::{Dataset, Hexapod, visible_json};
use hexbench_model::results::runs::Origin;
use hexbench_report::Page;
use hexbench_report::charts::ReportError;
use hexbench_report::png::png;
use hexbench_report::render::{PROGRAM, html, markdown};
use hexbench_report::words::{Provenance, as_word};
use serde::Serialize;

use super::{OutFile, Screen, report};
use crate::failure::Failure;

/// Where a page goes.
#[derive(Debug, Args)]
pub(crate) struct PageFiles {
    /// Write the page with charts to FILE, as a single HTML file that needs no network
    #[arg(long, value_name = "FILE")]
    html: Option<OutFile>,
    /// Write the page as Markdown to FILE, or to standard output (-)
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutFile>,
    /// Write every chart of the page into DIR, as SVG and as PNG
    #[arg(long, value_name = "DIR")]
    charts: Option<PathBuf>,
}

impl PageFiles {
    /// Files that are written.
    pub(crate) fn files(&self) -> Vec<&Path> {
        [&self.html, &self.markdown].into_iter().flatten().map(|file| &**file).collect()
    }

    /// True when the page itself goes to standard output.
    pub(crate) fn to_stdout(&self) -> bool {
        OutFile::any_is_stdout([&self.html, &self.markdown])
    }

    /// Make the page if anyone wants it, and write it.
    pub(crate) fn write(
        &self,
        screen: &Screen,
        page: impl FnOnce() -> Result<Page, Failure>,
    ) -> Result<(), Failure> {
        if self.html.is_none() && self.markdown.is_none() && self.charts.is_none() {
            return Ok(());
        }
        let page = page()?;
        if let Some(path) = &self.html {
            screen.write_to(path, &html(&page).map_err(ReportError::from)?)?;
        }
        write_markdown(screen, self.markdown.as_ref(), &page)?;
        self.charts.as_deref().map_or(Ok(()), |folder| write_charts(&page, folder))
    }
}

/// Every chart under the name it has in the page.
fn write_charts(page: &Page, folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(Failure::unwritable(folder))?;
    let mut without_picture = false;
    for (name, figure) in page.figures() {
        write(&folder.join(&name).with_extension("svg"), figure.svg.as_bytes())?;
        match png(&figure.svg) {
            Some(picture) => write(&folder.join(&name).with_extension("png"), &picture)?,
            None => without_picture = true,
        }
    }
    if without_picture {
        let next = "Install a font, or convert the SVG files elsewhere.";
        report::warn("no PNG was written: this system has no font", next);
    }
    Ok(())
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    atomic_write(path, |out| out.write_all(bytes)).map_err(Failure::unwritable(path))
}

/// The command line and the digests of all files read.
pub(crate) fn provenance<'a>(files: impl IntoIterator<Item = &'a PathBuf>) -> Result<Provenance, Failure> {
    let digest = |path: &PathBuf| Ok((path.display().to_string(), content_hash(path)?));
    let files = files.into_iter().map(digest).collect::<Result<_, Failure>>()?;
    let words: Vec<String> = std::env::args_os().skip(1).map(|word| as_word(&word)).collect();
    Ok(Provenance { command: format!("hexbench {}", words.join(" ")), files })
}

/// Which machine and files a result is about.
pub(crate) fn origin(
    hexapod: (&Hexapod, &Path),
    data: (&Dataset, &Path),
    holdout: Option<&Path>,
) -> Result<Origin, Failure> {
    let [of_hexapod, of_data] = [content_hash(hexapod.1)?, content_hash(data.1)?];
    let of_holdout = holdout.map(content_hash).transpose()?;
    Ok(Origin::new(PROGRAM, (hexapod.0, of_hexapod), (data.0, of_data), of_holdout))
}

/// Write a result as JSON where a file is asked for.
pub(crate) fn write_json(
    screen: &Screen,
    asked: Option<&OutFile>,
    value: &impl Serialize,
) -> Result<(), Failure> {
    let Some(path) = asked else { return Ok(()) };
    let text = serde_json::to_string_pretty(value).map_err(|e| Failure::unwritable(path)(e.into()))? + "\n";
    screen.write_to(path, &visible_json(&text))
}

/// Write a page as Markdown where a file is asked for.
pub(crate) fn write_markdown(screen: &Screen, asked: Option<&OutFile>, page: &Page) -> Result<(), Failure> {
    asked.map_or(Ok(()), |path| screen.write_to(path, &markdown(page)))
}
