//! What can go wrong, the exit code of each, and what to do about it.

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use hexbench_core::files::FileError;
use hexbench_design::DesignError;
use hexbench_experiments::ExperimentError;
use hexbench_experiments::alarm::BaselineFileError;
use hexbench_experiments::challenge::ChallengeError;
use hexbench_experiments::gate::GateError;
use hexbench_experiments::paper::PaperError;
use hexbench_experiments::power::PowerError;
use hexbench_experiments::regress::baseline::BaselineError;
use hexbench_experiments::sweep::StudyError;
use hexbench_experiments::trial::TrialError;
use hexbench_model::application::model_file::ModelFileError;
use hexbench_model::application::predict::PredictError;
use hexbench_model::application::session::SessionError;
use hexbench_model::effects::user_term::UserTermError;
use hexbench_model::error::ModelError;
use hexbench_model::machine::registration::{BallCampaignError, RegistrationError};
use hexbench_model::results::answer::AnswerError;
use hexbench_model::results::runs::Incompatible;
use hexbench_report::charts::ReportError;
use hexbench_report::plot::PlotError;
use hexbench_truth::TruthError;
use hexbench_truth::scene::SimulationError;
use thiserror::Error;

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
    /// A model file that is none.
    #[error("{}: {cause}", path.display())]
    ModelFile {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        cause: Box<ModelFileError>,
    },
    /// A session that cannot be opened.
    #[error("{}: {cause}", path.display())]
    Session {
        /// Its file.
        path: PathBuf,
        /// What stands in the way.
        cause: SessionError,
    },
    /// A result file that is none.
    #[error("{}: {cause}", path.display())]
    Result {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        cause: String,
    },
    /// A file of states of rest that is none, or of other states.
    #[error("{}: {cause}", path.display())]
    RestFile {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        cause: String,
    },
    /// Two results that have nothing to do with each other.
    #[error("{0}")]
    Runs(Incompatible),
    /// A term file that is none.
    #[error("{}: {cause}", path.display())]
    UserTerm {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        cause: Box<UserTermError>,
    },
    /// A row that cannot be predicted.
    #[error("{}: {cause}", path.display())]
    Row {
        /// The file of the row.
        path: PathBuf,
        /// The row, and why.
        cause: Box<PredictError>,
    },
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
    /// A state of the simulated machine that cannot be computed.
    #[error("{0}")]
    World(#[from] TruthError),
    /// A file that cannot be read.
    #[error("{}: cannot be read: {cause}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
    /// Balls that give no pose.
    #[error("{}: {cause}", path.display())]
    Balls {
        /// The file of the balls.
        path: PathBuf,
        /// The record, and why.
        cause: RegistrationError,
    },
    /// Records and loads that make no campaign.
    #[error("{}: {cause}", path.display())]
    Campaign {
        /// The file of the balls.
        path: PathBuf,
        /// What stands in the way.
        cause: BallCampaignError,
    },
    /// A scene that could not be simulated.
    #[error("{0}")]
    Simulation(SimulationError),
    /// A design problem without an answer.
    #[error("{0}")]
    Design(#[from] DesignError),
    /// An experiment that cannot go on.
    #[error("{0}")]
    Experiment(#[from] ExperimentError),
    /// A study that cannot go on.
    #[error("{0}")]
    Study(StudyError),
    /// A challenge that cannot go on.
    #[error("{0}")]
    Challenge(ChallengeError),
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
    /// A gate that cannot go on.
    #[error("{0}")]
    Gate(#[from] GateError),
    /// A baseline that cannot be used or written.
    #[error("{0}")]
    Baseline(#[from] BaselineError),
    /// A plan whose power cannot be told.
    #[error("{0}")]
    Power(#[from] PowerError),
    /// A study without an answer.
    #[error("{0}")]
    Reproduction(#[from] PaperError),
    /// A simulated campaign without an answer.
    #[error("{0}")]
    Trial(TrialError),
    /// A chart that cannot be drawn.
    #[error("{0}")]
    Plot(#[from] PlotError),
    /// A page that cannot be drawn.
    #[error("{0}")]
    Report(#[from] ReportError),
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

    /// A row of a file cannot be predicted.
    pub fn of_row(path: &Path) -> impl Fn(PredictError) -> Self + Copy {
        move |cause| Self::Row { path: path.to_owned(), cause: Box::new(cause) }
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
            Self::Model { cause, .. } | Self::Power(PowerError::Design(DesignError::Model(cause))) => {
                exit_of(cause)
            }
            Self::Experiment(cause) => exit_of_experiment(cause),
            Self::Challenge(cause) | Self::Gate(GateError::Challenge(cause)) => exit_of_challenge(cause),
            Self::Gate(GateError::File(cause)) | Self::Baseline(BaselineError::File(cause)) => {
                exit_of_baseline(cause)
            }
            Self::Usage { .. }
            | Self::Gate(
                GateError::NeedsFolder
                | GateError::NeedsFunction(_)
                | GateError::SeedOfMadeCases(_)
                | GateError::PartIsWork(_),
            ) => Exit::Usage,
            Self::Check(_) => Exit::CheckFailed,
            Self::Trial(TrialError::Truth(TruthError::File { .. })) => Exit::InputOutput,
            Self::Power(_)
            | Self::Study(_)
            | Self::Design(_)
            | Self::Reproduction(_)
            | Self::Trial(_)
            | Self::Plot(_)
            | Self::Report(_) => Exit::NotDetermined,
            Self::File(_)
            | Self::ModelFile { .. }
            | Self::Session { .. }
            | Self::UserTerm { .. }
            | Self::Result { .. }
            | Self::RestFile { .. }
            | Self::Runs(_)
            | Self::Row { .. }
            | Self::MemoryRow { .. }
            | Self::Balls { .. }
            | Self::Campaign { .. }
            | Self::SceneState { .. }
            | Self::Baseline(_)
            | Self::Gate(_)
            | Self::World(_)
            | Self::Simulation(SimulationError::Row(_)) => Exit::BadInput,
            Self::Output { .. }
            | Self::Server { .. }
            | Self::Unreadable { .. }
            | Self::Memory { .. }
            | Self::Simulation(_) => Exit::InputOutput,
        }
    }

    /// What to do about it, one sentence.
    pub fn next_step(&self) -> Option<String> {
        match self {
            Self::File(error) => Some(error.next_step()),
            Self::Model { cause, data } => Some(cause.next_step(data)),
            Self::Simulation(SimulationError::Row(_)) => {
                Some("Check the poses, loads and effects of the scene: this state does not exist.".into())
            }
            Self::Usage { next, .. } => Some(next.clone()).filter(|step| !step.is_empty()),
            Self::Experiment(cause) => Some(cause.next_step()),
            Self::Study(cause) => Some(cause.next_step()),
            Self::Challenge(cause) => Some(cause.next_step()),
            Self::Check(_) => None,
            Self::Baseline(cause) => Some(cause.next_step()),
            Self::Gate(cause) => Some(cause.next_step()),
            Self::Design(DesignError::NeverDetermined { .. }) => Some(
                "Let the space vary what they need: loads, rotations or [conditions]; `hexbench terms TERM` says what makes an \
                 effect visible."
                    .into(),
            ),
            Self::Design(cause) if of_sensors(cause).is_some() => of_sensors(cause),
            Self::Design(DesignError::Model(cause))
            | Self::Power(PowerError::Design(DesignError::Model(cause))) => Some(cause.next_step("the plan")),
            Self::Power(_) => Some("Check the poses (mm, deg) and loads (N, N m) of the plan.".into()),
            Self::Design(DesignError::NoPose { .. }) => Some(
                "Widen the ranges in the space file, or check this limit there and in the hexapod file: its unit, its sign, the machine."
                    .into(),
            ),
            Self::Design(_) => {
                Some("Widen the ranges or limits in the space file, or ask for more poses.".into())
            }
            Self::ModelFile { cause, .. }
                if matches!(**cause, ModelFileError::Changed | ModelFileError::Unsealed) =>
            {
                Some("Fit the model again, or add --trust if you know what was changed.".into())
            }
            Self::ModelFile { .. } => Some("`hexbench fit ... -o model.toml` writes such a file.".into()),
            Self::Result { .. } => {
                Some("`hexbench diagnose ... --json FILE` and `compare ... --json FILE` write such files.".into())
            }
            Self::RestFile { .. } => Some(
                "Export the same number of states of the same scene (`hexbench export SCENE --mjcf --states N -o DIR`), then run \
                 scripts/mujoco_check.py DIR."
                    .into(),
            ),
            Self::Session { cause, .. } => Some(cause.next_step().into()),
            Self::Runs(_) => Some("Name two results of the same kind for the same machine.".into()),
            Self::UserTerm { .. } => {
                Some("Correct the file; docs/reference/file-formats.md describes the format term/1.".into())
            }
            Self::Row { .. } => Some("Check the pose (mm, deg) and the load (N, N m) in this line.".into()),
            Self::MemoryRow { .. } => Some("Check the pose (mm, deg) and the load (N, N m) in this row.".into()),
            Self::SceneState { cause: TruthError::Inexpressible { .. }, .. } => {
                Some("Remove this effect from sealed/truth.toml for this purpose.".into())
            }
            Self::SceneState { .. } => {
                Some("Check the pose, the load and the hidden effects of the scene.".into())
            }
            Self::Balls { cause, .. } => Some(of_balls(cause)),
            Self::Campaign { cause, .. } => Some(of_campaign(cause)),
            Self::World(_) => Some(
                "Check the joints in the hexapod file, the pose (mm, deg), load, stiffness and masses."
                    .into(),
            ),
            Self::Unreadable { .. } => Some("Check the name of the file.".into()),
            Self::Trial(_) => Some("Use another trial or another seed.".into()),
            Self::Plot(_) => Some("Use more trials.".into()),
            Self::Report(_) => Some("Omit --html; the page in the terminal needs no charts.".into()),
            Self::Reproduction(_) => Some("Use another seed.".into()),
            Self::Memory { .. } => Some(
                "Use fewer readings (average repeats, use some of the poses), or raise the memory limit (`--max-memory`)."
                    .into(),
            ),
            Self::Server { .. } => {
                Some("Omit --port to use a free port.".into())
            }
            Self::Output { cause, .. } if cause.kind() == io::ErrorKind::NotFound => {
                Some("Create the folder first, or name another.".into())
            }
            Self::Output { cause, .. } if cause.kind() == io::ErrorKind::NotADirectory => {
                Some("Name a folder there, or another file.".into())
            }
            Self::Output { cause, .. } if cause.kind() == io::ErrorKind::IsADirectory => {
                Some("Name a file in it.".into())
            }
            Self::Output { cause, .. } if cause.kind() == io::ErrorKind::FileTooLarge => {
                Some("Raise the limit on file sizes (`ulimit -f`).".into())
            }
            Self::Output { .. } | Self::Simulation(_) => {
                Some("Check the free space and that the folder may be written to.".into())
            }
        }
    }
}

impl From<SimulationError> for Failure {
    fn from(error: SimulationError) -> Self {
        match error {
            SimulationError::File(file) => Self::File(file),
            SimulationError::NotEmpty(_) => Self::usage(
                error.to_string(),
                "Name another folder, or add --force to replace the files in it.",
            ),
            other => Self::Simulation(other),
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::File(file) => Self::File(file),
            StudyError::Plot(plot) => Self::Plot(plot),
            StudyError::Page(page) => Self::Report(page.into()),
            StudyError::Experiment(error) => Self::Experiment(error),
            StudyError::Design { .. } => Self::Study(error),
        }
    }
}

impl From<ChallengeError> for Failure {
    fn from(error: ChallengeError) -> Self {
        match error {
            ChallengeError::File(file) => Self::File(file),
            ChallengeError::Experiment(error) => Self::Experiment(error),
            other => Self::Challenge(other),
        }
    }
}

impl From<AnswerError> for Failure {
    fn from(error: AnswerError) -> Self {
        match error {
            AnswerError::File(file) => Self::File(file),
            AnswerError::Model(cause) => Self::Model { cause, data: "measurements.csv".into() },
            AnswerError::Row(cause) => Self::Row { path: "predict.csv".into(), cause: Box::new(cause) },
            AnswerError::Write { path, cause } => Self::Output { path, cause },
        }
    }
}

/// Bytes as people say them.
fn size(bytes: u64) -> String {
    let megabytes = bytes as f64 / 1e6;
    if megabytes < 1000.0 { format!("{megabytes:.0} MB") } else { format!("{:.1} GB", megabytes / 1e3) }
}

fn of_balls(cause: &RegistrationError) -> String {
    match cause {
        RegistrationError::MissingBall { .. } => {
            "Measure every ball in every record, or remove the ball from the balls file."
        }
        RegistrationError::Undetermined { .. } => "Use three balls or more that span a triangle.",
    }
    .into()
}

fn of_campaign(cause: &BallCampaignError) -> String {
    match cause {
        BallCampaignError::Registration(cause) => return of_balls(cause),
        BallCampaignError::NoRecord { .. } => {
            "Write a name from the column record of the table of balls."
        }
        BallCampaignError::SameRecord { .. } => "Name the record of the reference state in ref_record.",
        BallCampaignError::NoPlaces => "Add --balls balls.toml, or name the reference records in ref_record.",
        BallCampaignError::Exchanged { .. } => "Correct the names of the balls in this record, and in similar ones.",
        BallCampaignError::Mirrored { .. } => {
            "Export right-handed coordinates: one axis of the measuring machine has the opposite sign."
        }
        BallCampaignError::Astray { .. } => {
            "Check the commanded pose of this record (mm, deg) and its record number; if the axes of the measuring machine are \
             not those of the hexapod, add --balls and --align; if there are balls on the base, name them with --balls."
        }
    }
    .into()
}

fn exit_of_challenge(cause: &ChallengeError) -> Exit {
    match cause {
        ChallengeError::NotEmpty(_)
        | ChallengeError::NoSuite { .. }
        | ChallengeError::ShortSeed { .. }
        | ChallengeError::NoProgram(_)
        | ChallengeError::NoDependency(_)
        | ChallengeError::TooManyFiles { .. }
        | ChallengeError::OtherProgram { .. }
        | ChallengeError::SameName(_) => Exit::Usage,
        ChallengeError::Case { .. } => Exit::NotDetermined,
        _ if cause.is_input_output() => Exit::InputOutput,
        _ => Exit::BadInput,
    }
}

fn exit_of_baseline(cause: &BaselineFileError) -> Exit {
    match cause {
        BaselineFileError::NoReason => Exit::Usage,
        _ if cause.is_input_output() => Exit::InputOutput,
        _ => Exit::BadInput,
    }
}

fn exit_of_experiment(cause: &ExperimentError) -> Exit {
    match cause {
        ExperimentError::NotEmpty { .. } => Exit::Usage,
        _ if cause.is_input_output() => Exit::InputOutput,
        _ => Exit::BadInput,
    }
}

fn exit_of(cause: &ModelError) -> Exit {
    match cause {
        ModelError::UnknownTerm { .. } | ModelError::Selection(_) => Exit::Usage,
        ModelError::NotFinite { .. }
        | ModelError::Mismatch(_)
        | ModelError::Astray { .. }
        | ModelError::Misread { .. }
        | ModelError::NoReading { .. } => Exit::BadInput,
        _ => Exit::NotDetermined,
    }
}

/// What to do about sensors that cannot be chosen.
fn of_sensors(cause: &DesignError) -> Option<String> {
    match cause {
        DesignError::SensorsNeverDetermine { .. } => Some(
            "Add candidates that look at other points or in other directions, or give poses and loads that differ more.".into(),
        ),
        DesignError::TooFewSensors { enough: Some(n), .. } => Some(format!("Give --choose {n} or more.")),
        DesignError::TooFewSensors { enough: None, .. } => {
            Some("Allow a larger --budget, or candidates that cost less.".into())
        }
        DesignError::CannotShow { term, .. } => Some(shown_by(term)),
        DesignError::NoCandidateShows { term } => Some(shown_by(term)),
        _ => None,
    }
}

fn shown_by(term: &str) -> String {
    format!("`hexbench terms {term}` says what shows it: poses, loads or columns of the plan.")
}
