//! Exit code and next step of what stands in the way, beside each other for every cause.

use hexbench_core::words::joined;
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
use hexbench_model::results::runs::Incompatible;
use hexbench_report::charts::ReportError;
use hexbench_report::plot::PlotError;
use hexbench_truth::TruthError;
use hexbench_truth::scene::SimulationError;

use super::Exit;

/// An error that says what to do about it.
pub trait Explained: std::error::Error + Send + Sync {
    /// The exit code.
    fn exit(&self) -> Exit {
        Exit::BadInput
    }

    /// What to do about it, one sentence.
    fn next_step(&self) -> String;
}

/// A file that holds something else than it should.
#[derive(Debug, thiserror::Error)]
#[error("{why}")]
pub(super) struct Unusable {
    pub(super) why: String,
    pub(super) next: &'static str,
}

impl Explained for Unusable {
    fn next_step(&self) -> String {
        self.next.to_owned()
    }
}

impl Explained for ModelFileError {
    fn next_step(&self) -> String {
        match self {
            Self::Changed | Self::Unsealed => {
                "Fit the model again, or add --trust if you know what was changed.".to_owned()
            }
            _ => "`hexbench fit ... -o model.toml` writes such a file.".to_owned(),
        }
    }
}

impl Explained for SessionError {
    fn next_step(&self) -> String {
        SessionError::next_step(self).to_owned()
    }
}

impl Explained for UserTermError {
    fn next_step(&self) -> String {
        "Correct the file; docs/reference/file-formats.md describes the format term/1.".to_owned()
    }
}

impl Explained for PredictError {
    fn next_step(&self) -> String {
        "Check the pose (mm, deg) and the load (N, N m) in this line.".to_owned()
    }
}

impl Explained for Incompatible {
    fn next_step(&self) -> String {
        "Name two results of the same kind for the same machine.".to_owned()
    }
}

impl Explained for RegistrationError {
    fn next_step(&self) -> String {
        match self {
            Self::MissingBall { .. } => {
                "Measure every ball in every record, or remove the ball from the balls file."
            }
            Self::Undetermined { .. } => "Use three balls or more that span a triangle.",
        }
        .to_owned()
    }
}

impl Explained for BallCampaignError {
    fn next_step(&self) -> String {
        match self {
            Self::Registration(cause) => return cause.next_step(),
            Self::NoRecord { .. } => "Write a name from the column record of the table of balls.",
            Self::SameRecord { .. } => "Name the record of the reference state in ref_record.",
            Self::NoPlaces => "Add --balls balls.toml, or name the reference records in ref_record.",
            Self::Exchanged { .. } => "Correct the names of the balls in this record, and in similar ones.",
            Self::Mirrored { .. } => {
                "Export right-handed coordinates: one axis of the measuring machine has the opposite sign."
            }
            Self::Astray { .. } => {
                "Check the commanded pose of this record (mm, deg) and its record number; if the axes of the measuring machine are \
                 not those of the hexapod, add --balls and --align; if there are balls on the base, name them with --balls."
            }
        }
        .to_owned()
    }
}

impl Explained for TruthError {
    fn next_step(&self) -> String {
        "Check the joints in the hexapod file, the pose (mm, deg), load, stiffness and masses.".to_owned()
    }
}

impl Explained for SimulationError {
    fn exit(&self) -> Exit {
        if matches!(self, Self::Row(_)) { Exit::BadInput } else { Exit::InputOutput }
    }

    fn next_step(&self) -> String {
        match self {
            Self::Row(_) => "Check the poses, loads and effects of the scene: this state does not exist.",
            _ => "Check the free space and that the folder may be written to.",
        }
        .to_owned()
    }
}

impl Explained for DesignError {
    fn exit(&self) -> Exit {
        Exit::NotDetermined
    }

    fn next_step(&self) -> String {
        match self {
            Self::NeverDetermined { lacks, .. } if !lacks.is_empty() => {
                let some = joined(lacks);
                return format!("Add a load with {some} to [loads] of the space file, in wrenches_N_Nm or in [[loads.between]].");
            }
            Self::NeverDetermined { .. } => {
                "Let the space vary what they need: loads, rotations or [conditions]; `hexbench terms TERM` says what makes an \
                 effect visible."
            }
            Self::NoReading => "Raise --hours.",
            Self::FreeReading => "Add reading_s to [budget].",
            Self::SensorsNeverDetermine { .. } => {
                "Add candidates that look at other points or in other directions, or give poses and loads that differ more."
            }
            Self::TooFewSensors { enough: Some(n), .. } => return format!("Give --choose {n} or more."),
            Self::TooFewSensors { enough: None, .. } => {
                "Allow a larger --budget, or candidates that cost less."
            }
            Self::CannotShow { term, .. } => return shown_by(term),
            Self::NoCandidateShows { term } => return shown_by(term),
            Self::Model(cause) => return cause.next_step("the plan"),
            Self::NoPose { .. } => {
                "Widen the ranges in the space file, or check this limit there and in the hexapod file: its unit, its sign, the machine."
            }
            _ => "Widen the ranges or limits in the space file, or ask for more poses.",
        }
        .to_owned()
    }
}

fn shown_by(term: &str) -> String {
    format!("`hexbench terms {term}` says what shows it: poses, loads or columns of the plan.")
}

impl Explained for PowerError {
    fn exit(&self) -> Exit {
        if let Self::Design(DesignError::Model(cause)) = self { of_model(cause) } else { Exit::NotDetermined }
    }

    fn next_step(&self) -> String {
        match self {
            Self::Design(DesignError::Model(cause)) => cause.next_step("the plan"),
            _ => "Check the poses (mm, deg) and loads (N, N m) of the plan.".to_owned(),
        }
    }
}

impl Explained for ExperimentError {
    fn exit(&self) -> Exit {
        match self {
            Self::NotEmpty { .. } => Exit::Usage,
            _ if self.is_input_output() => Exit::InputOutput,
            _ => Exit::BadInput,
        }
    }

    fn next_step(&self) -> String {
        ExperimentError::next_step(self)
    }
}

impl Explained for StudyError {
    fn exit(&self) -> Exit {
        Exit::NotDetermined
    }

    fn next_step(&self) -> String {
        StudyError::next_step(self)
    }
}

impl Explained for ChallengeError {
    fn exit(&self) -> Exit {
        match self {
            Self::NotEmpty(_)
            | Self::NoSuite { .. }
            | Self::ShortSeed { .. }
            | Self::NoProgram(_)
            | Self::NotExecutable(_)
            | Self::NoDependency(_)
            | Self::TooManyFiles { .. }
            | Self::OtherProgram { .. }
            | Self::SameName(_) => Exit::Usage,
            Self::Case { .. } => Exit::NotDetermined,
            _ if self.is_input_output() => Exit::InputOutput,
            _ => Exit::BadInput,
        }
    }

    fn next_step(&self) -> String {
        ChallengeError::next_step(self)
    }
}

impl Explained for GateError {
    fn exit(&self) -> Exit {
        match self {
            Self::Challenge(cause) => cause.exit(),
            Self::File(cause) => of_baseline(cause),
            Self::NeedsFolder | Self::NeedsFunction(_) | Self::SeedOfMadeCases(_) | Self::PartIsWork(_) => {
                Exit::Usage
            }
            _ => Exit::BadInput,
        }
    }

    fn next_step(&self) -> String {
        GateError::next_step(self)
    }
}

impl Explained for BaselineError {
    fn exit(&self) -> Exit {
        if let Self::File(cause) = self { of_baseline(cause) } else { Exit::BadInput }
    }

    fn next_step(&self) -> String {
        BaselineError::next_step(self)
    }
}

impl Explained for TrialError {
    fn exit(&self) -> Exit {
        match self {
            Self::Truth(TruthError::File { .. }) => Exit::InputOutput,
            _ => Exit::NotDetermined,
        }
    }

    fn next_step(&self) -> String {
        "Use another trial or another seed.".to_owned()
    }
}

impl Explained for PaperError {
    fn exit(&self) -> Exit {
        Exit::NotDetermined
    }

    fn next_step(&self) -> String {
        "Use another seed.".to_owned()
    }
}

impl Explained for PlotError {
    fn exit(&self) -> Exit {
        Exit::NotDetermined
    }

    fn next_step(&self) -> String {
        "Use more trials.".to_owned()
    }
}

impl Explained for ReportError {
    fn exit(&self) -> Exit {
        Exit::NotDetermined
    }

    fn next_step(&self) -> String {
        "Omit --html; the page in the terminal needs no charts.".to_owned()
    }
}

fn of_baseline(cause: &BaselineFileError) -> Exit {
    match cause {
        BaselineFileError::NoReason => Exit::Usage,
        _ if cause.is_input_output() => Exit::InputOutput,
        _ => Exit::BadInput,
    }
}

pub(super) fn of_model(cause: &ModelError) -> Exit {
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
