//! What a comparison with a baseline writes for continuous integration.

use clap::Args;
use hexbench_experiments::alarm::junit::XmlError;
use hexbench_report::Page;
use serde::Serialize;

use super::{OutFile, Screen, write_json, write_markdown};
use crate::failure::Failure;

/// Where a comparison goes.
#[derive(Debug, Args)]
pub(crate) struct ComparisonFiles {
    /// Write the limits to FILE as JUnit XML, one test case per limit
    #[arg(long, value_name = "FILE", conflicts_with = "update")]
    junit: Option<OutFile>,
    /// Write all figures to FILE, or to standard output (-)
    #[arg(long, value_name = "FILE", conflicts_with = "update")]
    json: Option<OutFile>,
    /// Write a short Markdown page to FILE, or to standard output (-)
    #[arg(long, value_name = "FILE", conflicts_with = "update")]
    markdown: Option<OutFile>,
}

impl ComparisonFiles {
    /// Writes what is asked for; the page goes to the screen unless something else went to standard output.
    pub(crate) fn write(
        &self,
        screen: &Screen,
        page: &Page,
        comparison: &impl Serialize,
        junit: impl FnOnce() -> Result<String, XmlError>,
    ) -> Result<(), Failure> {
        if let Some(path) = &self.junit {
            let text = junit().map_err(std::io::Error::other).map_err(Failure::unwritable(path))?;
            screen.write_to(path, &text)?;
        }
        write_json(screen, self.json.as_ref(), comparison)?;
        write_markdown(screen, self.markdown.as_ref(), page)?;
        let is_taken = OutFile::any_is_stdout([&self.junit, &self.json, &self.markdown]);
        if is_taken { Ok(()) } else { screen.show(page) }
    }
}

/// Fails with the names of the limits that are worse.
pub(crate) fn refuse_worse<'a>(worse: impl IntoIterator<Item = &'a str>) -> Result<(), Failure> {
    let worse: Vec<&str> = worse.into_iter().collect();
    match worse.split_first() {
        None => Ok(()),
        Some((first, [])) => Err(Failure::Check(format!("{first}: significantly worse"))),
        Some((first, others)) => {
            Err(Failure::Check(format!("{first}, and {} more limits: significantly worse", others.len())))
        }
    }
}
