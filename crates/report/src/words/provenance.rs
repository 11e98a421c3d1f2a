//! What made a page.

use hexbench_model::estimation::noise::NoiseSource;

use crate::page::{PageColumn, Section, Table};
use crate::render::PROGRAM;

/// What made the page, for its foot.
#[derive(Debug, Clone)]
pub struct Provenance {
    /// The command line.
    pub command: String,
    /// Files read, each with its digest.
    pub files: Vec<(String, String)>,
}

impl Provenance {
    /// Program, command, noise, files.
    pub fn section(&self, noise: NoiseSource) -> Section {
        self.with_lines(&[["noise", noise.word()]])
    }

    /// Program, command, files: of results that were read, each with a noise of its own.
    pub fn read_section(&self) -> Section {
        self.with_lines(&[])
    }

    fn with_lines(&self, more: &[[&str; 2]]) -> Section {
        let head = [["program", PROGRAM], ["command", &self.command]].into_iter().chain(more.iter().copied());
        let files = self.files.iter().map(|(file, digest)| [file.clone(), format!("SHA-256 {digest}")]);
        let table = Table::new([PageColumn::words(""), PageColumn::words("")]).rows(head).rows(files);
        Section::new("Where this comes from").id("provenance").table(table)
    }
}
