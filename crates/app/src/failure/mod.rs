//! What can go wrong, the exit code of each, and what to do about it.

mod explained;

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use hexbench_core::files::FileError;
use hexbench_design::DesignError;
use hexbench_experiments::ExperimentError;
use hexbench_experiments::challenge::ChallengeError;
use hexbench_experiments::gate::GateError;
use hexbench_experiments::paper::PaperError;
use hexbench_experiments::power::PowerError;
use hexbench_experiments::regress::baseline::BaselineError;
use hexbench_experiments::sweep::StudyError;
use hexbench_experiments::trial::TrialError;
use hexbench_model::error::ModelError;
use hexbench_model::results::answer::AnswerError;
use hexbench_model::results::runs::Incompatible;
use hexbench_report::charts::ReportError;
use hexbench_report::plot::PlotError;
use hexbench_truth::TruthError;
use hexbench_truth::scene::SimulationError;
use thiserror::Error;

pub use explained::Explained;
use explained::Unusable;

/// Exit codes of the command; the Python package has an exception for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Done = 0,
    /// A requested check failed.
    CheckFailed = 1,
    /// Wrong usage; argument parsing exits with the same number.
    Usage = 2,
    /// The input says something that cannot be used.
    BadInput = 3,
    /// The data do not determine what was asked.
    NotDetermined = 4,
    /// A file cannot be read or written.
    InputOutput = 5,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// Why a subcommand stopped.
#[derive(Debug, Error)]
pub enum Failure {
    /// A file that cannot be used.
    #[error("{0}")]
    File(#[from] FileError),
    /// The model cannot be computed.
    #[error("{cause}")]
    Model {
        /// What stands in the way.
        cause: ModelError,
        /// The data it was about.
        data: String,
    },
    /// Something in a file, or all of it, that cannot be used.
    #[error("{}: {cause}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What stands in the way.
        cause: Box<dyn Explained>,
    },
    /// What stands in the way of anything else.
    #[error("{0}")]
    Cause(Box<dyn Explained>),
    /// A row of a table in memory that cannot be predicted.
    #[error("{table}: row {row}: {cause}")]
    MemoryRow {
        /// What the table is called.
        table: String,
        /// The row, from 0.
        row: u64,
        /// Why.
        cause: Box<ModelError>,
    },
    /// A state of a scene that the simulated world does not have, or that a format cannot express.
    #[error("{}: {place}: {cause}", scene.display())]
    SceneState {
        /// Folder of the scene.
        scene: PathBuf,
        /// Row of the plan or state of the table, from 1.
        place: String,
        /// What stands in the way.
        cause: TruthError,
    },
    /// A file that cannot be read.
    #[error("{}: cannot be read: {cause}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
    /// Wrong usage that only shows after parsing.
    #[error("{message}")]
    Usage {
        /// What is wrong.
        message: String,
        /// What to do.
        next: String,
    },
    /// The answer is not the expected one.
    #[error("check failed: {0}")]
    Check(String),
    /// A server that cannot begin.
    #[error("port {port} on 127.0.0.1 cannot be used: {cause}")]
    Server {
        /// Its port; 0: any.
        port: u16,
        /// Why not.
        cause: io::Error,
    },
    /// More memory than there is.
    #[error(
        "{what} of {rows} readings under {conditions} conditions needs about {}, but only {} are free",
        size(*needed_bytes),
        size(*free_bytes)
    )]
    Memory {
        /// What would be computed.
        what: &'static str,
        /// How many readings there are.
        rows: usize,
        /// Under how many conditions they were taken.
        conditions: usize,
        /// What it would take.
        needed_bytes: u64,
        /// What there is.
        free_bytes: u64,
    },
    /// Output that cannot be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Output {
        /// Where to.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
}

impl Failure {
    /// Options that cannot be meant so, and what to write instead.
    pub fn usage(message: impl Into<String>, next: impl Into<String>) -> Self {
        Self::Usage { message: message.into(), next: next.into() }
    }

    /// What a model makes of readings cannot be computed; `data` names them.
    pub fn of_model(data: &str) -> impl Fn(ModelError) -> Self + Copy {
        move |cause| Self::Model { cause, data: data.to_owned() }
    }

    /// A name is no term.
    pub fn of_name(cause: ModelError) -> Self {
        Self::Model { cause, data: String::new() }
    }

    /// What stands in the way.
    pub fn of(cause: impl Explained + 'static) -> Self {
        Self::Cause(Box::new(cause))
    }

    /// The same in a file.
    pub fn in_file<E: Explained + 'static>(path: &Path) -> impl Fn(E) -> Self + Copy {
        move |cause| Self::InFile { path: path.to_owned(), cause: Box::new(cause) }
    }

    /// A file holds something else than it should.
    pub fn unusable(path: &Path, why: impl Into<String>, next: &'static str) -> Self {
        Self::in_file(path)(Unusable { why: why.into(), next })
    }

    /// A file cannot be read.
    pub fn unreadable(path: &Path) -> impl Fn(io::Error) -> Self + Copy {
        move |cause| Self::Unreadable { path: path.to_owned(), cause }
    }

    /// A file or a folder cannot be written.
    pub fn unwritable(path: &Path) -> impl Fn(io::Error) -> Self + Copy {
        move |cause| Self::Output { path: path.to_owned(), cause }
    }

    /// The exit code.
    pub fn exit(&self) -> Exit {
        match self {
            Self::File(error) if error.is_input_output() => Exit::InputOutput,
            Self::Model { cause, .. } => explained::of_model(cause),
            Self::InFile { cause, .. } | Self::Cause(cause) => cause.exit(),
            Self::Usage { .. } => Exit::Usage,
            Self::Check(_) => Exit::CheckFailed,
            Self::File(_) | Self::MemoryRow { .. } | Self::SceneState { .. } => Exit::BadInput,
            Self::Output { .. } | Self::Server { .. } | Self::Unreadable { .. } | Self::Memory { .. } => {
                Exit::InputOutput
            }
        }
    }

    /// What to do about it, one sentence.
    pub fn next_step(&self) -> Option<String> {
        let next = match self {
            Self::File(error) => return Some(error.next_step()),
            Self::Model { cause, data } => return Some(cause.next_step(data)),
            Self::InFile { cause, .. } | Self::Cause(cause) => return Some(cause.next_step()),
            Self::Usage { next, .. } => return Some(next.clone()).filter(|step| !step.is_empty()),
            Self::Check(_) => return None,
            Self::MemoryRow { .. } => "Check the pose (mm, deg) and the load (N, N m) in this row.",
            Self::SceneState { cause: TruthError::Inexpressible { .. }, .. } => {
                "Remove this effect from sealed/truth.toml for this purpose."
            }
            Self::SceneState { .. } => "Check the pose, the load and the hidden effects of the scene.",
            Self::Unreadable { .. } => "Check the name of the file.",
            Self::Memory { .. } => {
                "Use fewer readings (average repeats, use some of the poses; `diagnose`, `discover` and `compare` draw some by `--most-readings`), or raise the memory limit (`--max-memory`)."
            }
            Self::Server { .. } => "Omit --port to use a free port.",
            Self::Output { cause, .. } => of_output(cause),
        };
        Some(next.to_owned())
    }
}

fn of_output(cause: &io::Error) -> &'static str {
    match cause.kind() {
        io::ErrorKind::NotFound => "Create the folder first, or name another.",
        io::ErrorKind::NotADirectory => "Name a folder there, or another file.",
        io::ErrorKind::IsADirectory => "Name a file in it.",
        io::ErrorKind::FileTooLarge => "Raise the limit on file sizes (`ulimit -f`).",
        _ => "Check the free space and that the folder may be written to.",
    }
}

macro_rules! explained {
    ($($cause:ty),+ $(,)?) => {
        $(impl From<$cause> for Failure {
            fn from(cause: $cause) -> Self {
                Self::of(cause)
            }
        })+
    };
}

explained!(
    BaselineError,
    DesignError,
    ExperimentError,
    GateError,
    Incompatible,
    PaperError,
    PlotError,
    PowerError,
    ReportError,
    TrialError,
    TruthError,
);

impl From<SimulationError> for Failure {
    fn from(error: SimulationError) -> Self {
        match error {
            SimulationError::File(file) => Self::File(file),
            SimulationError::NotEmpty(_) => Self::usage(
                error.to_string(),
                "Name another folder, or add --force to replace the files in it.",
            ),
            other => Self::of(other),
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::File(file) => Self::File(file),
            StudyError::Plot(plot) => plot.into(),
            StudyError::Page(page) => ReportError::from(page).into(),
            StudyError::Experiment(error) => error.into(),
            StudyError::Design { .. } => Self::of(error),
        }
    }
}

impl From<ChallengeError> for Failure {
    fn from(error: ChallengeError) -> Self {
        match error {
            ChallengeError::File(file) => Self::File(file),
            ChallengeError::Experiment(error) => error.into(),
            other => Self::of(other),
        }
    }
}

impl From<AnswerError> for Failure {
    fn from(error: AnswerError) -> Self {
        match error {
            AnswerError::File(file) => Self::File(file),
            AnswerError::Model(cause) => Self::Model { cause, data: "measurements.csv".into() },
            AnswerError::Row(cause) => Self::in_file(Path::new("predict.csv"))(cause),
            AnswerError::Write { path, cause } => Self::Output { path, cause },
        }
    }
}

/// Bytes as people say them.
fn size(bytes: u64) -> String {
    let megabytes = bytes as f64 / 1e6;
    if megabytes < 1000.0 { format!("{megabytes:.0} MB") } else { format!("{:.1} GB", megabytes / 1e3) }
}
