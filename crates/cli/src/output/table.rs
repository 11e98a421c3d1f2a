//! Results as tables for other programs.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use hexbench_core::files::atomic_write;
use hexbench_report::render::PROGRAM;
use hexbench_report::table::{Frame, TableFormat};

use super::provenance;
use crate::failure::Failure;

/// A file for a table; the end of its name tells how it is written.
#[derive(Debug, Clone)]
pub(crate) struct TableFile {
    path: PathBuf,
    kind: TableFormat,
}

impl FromStr for TableFile {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let path = PathBuf::from(text);
        let kind = TableFormat::of(&path).ok_or("the name of a table must end in .parquet or .csv")?;
        Ok(Self { path, kind })
    }
}

impl TableFile {
    /// A file whose name asks for Parquet.
    pub(crate) fn parquet(path: &Path) -> Option<Self> {
        let kind = TableFormat::of(path).filter(|kind| *kind == TableFormat::Parquet)?;
        Some(Self { path: path.to_owned(), kind })
    }

    /// Where it goes.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Write a table made from these files; command, version and digests go into it where the format has a place.
    pub(crate) fn write<'a>(
        &self,
        mut frame: Frame,
        read: impl IntoIterator<Item = &'a PathBuf>,
    ) -> Result<(), Failure> {
        let from = provenance(read)?;
        frame.origin.push(("program".into(), PROGRAM.to_owned()));
        frame.origin.push(("command".into(), from.command));
        let digest = |(path, sha256): (String, String)| (format!("sha256:{}", name(&path)), sha256);
        frame.origin.extend(from.files.into_iter().map(digest));
        self.write_as_it_is(&frame)
    }

    /// Write a table that says itself what it was made from.
    pub(crate) fn write_as_it_is(&self, frame: &Frame) -> Result<(), Failure> {
        atomic_write(&self.path, |out| frame.write(self.kind, out)).map_err(Failure::unwritable(&self.path))
    }

    /// A file beside this one for one of several tables: `trials.csv` becomes `trials-NAME.csv`.
    pub(crate) fn of_one(&self, name: &str) -> Self {
        let [stem, end] = [self.path.file_stem(), self.path.extension()]
            .map(|part| part.unwrap_or_default().to_string_lossy().into_owned());
        Self { path: self.path.with_file_name(format!("{stem}-{name}.{end}")), ..*self }
    }
}

/// Name of a file without its folder.
fn name(path: &str) -> String {
    Path::new(path).file_name().map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}
