//! The page and its charts, into files.

use std::fs;
use std::path::Path;

use hexbench_core::files::atomic_write;
use hexbench_report::png::png;
use hexbench_report::render::{html, markdown as markdown_of};

use super::{SweepChart, document, pictures};
use crate::error::ExperimentError;
use crate::sweep::error::StudyError;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

/// Name of the page for a browser.
pub const HTML: &str = "study.html";

/// Writes `study.md`, the same as one file for a browser (`study.html`) and `charts` (SVG, and PNG where the system has a font) into a folder, and the page once more as
/// `markdown` with its charts beside it, when that is wanted.
///
/// # Errors
/// [`StudyError::Plot`], [`StudyError::Page`], [`ExperimentError::Write`].
pub fn write(
    study: &SweepStudy,
    cells: &[CellStatistics],
    folder: &Path,
    markdown: Option<&Path>,
) -> Result<(), StudyError> {
    let pictures = pictures(study, cells)?;
    let text = |folder: &str| markdown_of(&document(study, cells, &pictures, folder));
    page(&folder.join("study.md"), &folder.join("charts"), &text, &pictures)?;
    let in_browser = html(&document(study, cells, &pictures, "charts"))?;
    file(&folder.join(HTML), in_browser.as_bytes())?;
    for (picture, png) in pictures.iter().filter_map(|p| Some((p, png(&p.svg)?))) {
        file(&folder.join("charts").join(format!("{}.png", picture.name)), &png)?;
    }
    Ok(markdown.map_or(Ok(()), |path| page(path, &path.with_extension(""), &text, &pictures))?)
}

/// The page and its charts as SVG, which are in `folder` beside it.
fn page(
    path: &Path,
    folder: &Path,
    text: &dyn Fn(&str) -> String,
    pictures: &[SweepChart],
) -> Result<(), ExperimentError> {
    let beside = folder.file_name().unwrap_or_default().to_string_lossy();
    file(path, text(&beside).as_bytes())?;
    for picture in pictures {
        file(&folder.join(format!("{}.svg", picture.name)), picture.svg.as_bytes())?;
    }
    Ok(())
}

fn file(path: &Path, bytes: &[u8]) -> Result<(), ExperimentError> {
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
    folder
        .map_or(Ok(()), fs::create_dir_all)
        .and_then(|()| atomic_write(path, |out| out.write_all(bytes)))
        .map_err(ExperimentError::writing(path))
}
