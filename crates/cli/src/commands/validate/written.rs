//! What studies write: tables, documents, the files of one trial.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use hexbench_experiments::trial::TrialError;
use hexbench_report::render::markdown;
use hexbench_report::table::{Frame, TableFormat};
use hexbench_report::words::as_word;
use hexbench_report::{Page, Section};
use hexbench_truth::campaign::SimulatedCase;

use crate::failure::Failure;
use crate::output::{OutPlace, Screen};

/// Writes the tables of a study and its page where one is asked for; shows the page and says what was written.
pub(super) fn write_and_show(
    mut files: Vec<(PathBuf, String)>,
    page: Page,
    document: Option<&OutPlace>,
    screen: &Screen,
) -> Result<(), Failure> {
    files.extend(document.map(|path| (path.to_path_buf(), markdown(&page))));
    let written = write_all(files, screen)?;
    let names = written.iter().map(|path| path.display().to_string());
    screen.show(&page.with(Section::new("Written").list(names)))
}

/// Writes files into folders that are made; returns their paths.
pub(super) fn write_all(files: Vec<(PathBuf, String)>, screen: &Screen) -> Result<Vec<PathBuf>, Failure> {
    for (path, text) in &files {
        screen.write_with_folder(path, text)?;
    }
    Ok(files.into_iter().map(|(path, _)| path).collect())
}

/// A table of trials for a file of comma-separated values.
pub(super) fn csv_file(path: PathBuf, frame: &Frame) -> Result<(PathBuf, String), Failure> {
    let mut text = Vec::new();
    let written = frame.write(TableFormat::Csv, &mut text);
    let text = written.and_then(|()| String::from_utf8(text).map_err(std::io::Error::other));
    let text = text.map_err(Failure::unwritable(&path))?;
    Ok((path, text))
}

/// Writes one campaign as files, and how to diagnose it.
pub(super) fn write_case(case: &SimulatedCase, folder: &Path, screen: &Screen) -> Result<(), Failure> {
    case.write(folder).map_err(TrialError::from)?;
    tell(folder, screen)
}

/// Says how to diagnose the campaign in a folder.
pub(super) fn tell(folder: &Path, screen: &Screen) -> Result<(), Failure> {
    let [hexapod, data, holdout] =
        ["hexapod.toml", "measurements.csv", "holdout.csv"].map(|name| as_word(folder.join(name)));
    screen.tell(&format!("hexbench diagnose {hexapod} {data} --holdout {holdout}\n"))
}

/// Folder of the charts of a document, next to it, and its name in the document.
pub(super) fn charts_of(document: &Path) -> (PathBuf, String) {
    let folder = document.with_extension("");
    let name = folder.file_name().unwrap_or(OsStr::new(".")).to_string_lossy().into_owned();
    (folder, name)
}

/// `--case` names a trial that the study does not have.
pub(super) fn no_trial(trial: &str, next: impl Into<String>) -> Failure {
    Failure::usage(format!("`{trial}` is no trial"), next)
}
