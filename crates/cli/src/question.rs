//! What `diagnose` and `discover` ask about: a machine, its readings, what competes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use hexbench_app::memory::Computation;
use hexbench_app::session::SessionFile;
use hexbench_core::{Dataset, Hexapod, LineRange};
use hexbench_model::effects::term::Term;
use hexbench_model::results::diagnose::DiagnoseOptions;
use hexbench_model::results::runs::Origin;
use hexbench_report::words::{Provenance, as_option, files_asked};

use crate::failure::Failure;
use crate::input::{self, MemoryLimit, MostReadings, TableNames};
use crate::output::{origin, provenance, refuse_overlaps_of};
use crate::read_as::ReadAs;

/// Files, and the lines of them that count.
#[derive(Debug, Args)]
pub(crate) struct Question {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Deflections or absolute poses: measurements.csv
    data: PathBuf,
    /// Held-out readings, which no fit uses; by default, poses are left out in turn
    #[arg(long, value_name = "FILE")]
    holdout: Option<PathBuf>,
    #[command(flatten)]
    names: TableNames,
    #[command(flatten)]
    most: MostReadings,
    #[command(flatten)]
    memory: MemoryLimit,
    /// A term file of your own (term/1) that competes with the catalogue; may be given several times
    #[arg(long = "term", value_name = "FILE")]
    terms: Vec<PathBuf>,
    /// A session of the workbench: its formulas compete, its excluded readings are left out, and the files, which must be those of the
    /// session, are read as it reads them
    #[arg(long, value_name = "FILE", conflicts_with_all = ["terms", "exclude"])]
    session: Option<PathBuf>,
    /// Leave out the reading in this line of DATA: a line number as shown on the page, or a range (12-15); may be given several
    /// times
    #[arg(long, value_name = "LINE", value_delimiter = ',')]
    exclude: Vec<LineRange>,
}

/// What the files hold.
pub(crate) struct Asked {
    pub(crate) hexapod: Hexapod,
    pub(crate) data: Dataset,
    pub(crate) holdout: Option<Dataset>,
    /// The catalogue, and terms of one's own behind it.
    pub(crate) terms: Vec<Arc<dyn Term>>,
    /// Lines left out before anything else, and how the files are read: as a session reads them, then by further changes.
    pub(crate) options: DiagnoseOptions,
}

impl Question {
    /// Reads the files.
    pub(crate) fn read(&self, read_as: &ReadAs) -> Result<Asked, Failure> {
        let hexapod = input::hexapod(&self.hexapod)?;
        let data = input::measurements(&hexapod, &self.data, &self.names)?;
        let holdout = input::given_measurements(&hexapod, self.holdout.as_deref(), &self.names)?;
        let session = SessionFile::given(
            self.session.as_deref(),
            [&self.hexapod, &self.data],
            self.holdout.as_deref(),
        )?;
        let (terms, options) = if let Some(file) = session {
            let terms = file.session.terms().map_err(|cause| file.failure(cause))?;
            (terms, file.session.options())
        } else {
            let terms = input::catalogue_with(&input::user_terms(&self.terms)?);
            (terms, DiagnoseOptions::default().with_exclude(self.exclude.iter().copied()))
        };
        let data = self.most.of(data, &options.exclude);
        let holdout = holdout.map(|rows| self.most.of(rows, &[]));
        self.memory.refuse(Computation::Diagnosis, &data)?;
        Ok(Asked { hexapod, data, holdout, terms, options: options.with_read_as(read_as.changes.clone()) })
    }

    /// Refuse outputs that would overwrite one of the files.
    pub(crate) fn refuse_overlaps(&self, outputs: &[PathBuf]) -> Result<(), Failure> {
        let files: Vec<PathBuf> = self.files().cloned().collect();
        let outputs: Vec<&Path> = outputs.iter().map(PathBuf::as_path).collect();
        refuse_overlaps_of(&files, &outputs)
    }

    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.hexapod, &self.data].into_iter().chain(&self.holdout).chain(&self.terms).chain(&self.session)
    }

    /// The file of the measurements.
    pub(crate) fn data(&self) -> &Path {
        &self.data
    }

    /// Lines left out, as a shell takes them.
    pub(crate) fn left_out(&self) -> Vec<String> {
        self.exclude.iter().map(|lines| format!("--exclude {lines}")).collect()
    }

    /// These files and how they are read, as a shell takes them: each option with its value.
    pub(crate) fn words(&self, read_as: &ReadAs) -> Vec<String> {
        let mut words = files_asked(&self.hexapod, &self.data, self.holdout.as_ref());
        words.extend(self.names.words());
        words.extend(self.most.words());
        words.extend(self.terms.iter().map(|path| as_option("term", path)));
        words.extend(read_as.names().iter().map(|change| as_option("read-as", change)));
        words
    }

    /// Which machine and files a result is about.
    pub(crate) fn origin(&self, asked: &Asked) -> Result<Origin, Failure> {
        origin((&asked.hexapod, &self.hexapod), (&asked.data, &self.data), self.holdout.as_deref())
    }

    /// What a page says of the files behind it.
    pub(crate) fn provenance(&self) -> Result<Provenance, Failure> {
        provenance(self.files())
    }
}
