//! Messages between page and server, as JSON. Names contain the units; numbers are in the frames of the files.
//!
//! Everything loaded is immutable: a bench is made once and evaluates selections of terms. The page itself keeps the ticked terms and
//! the undo history, so two tabs cannot disturb each other.

pub use hexbench_model::application::foresight::SessionForesight;
pub use hexbench_model::application::session::{Selection, SessionStep};
use hexbench_model::estimation::estimate::Estimate;
use hexbench_model::estimation::noise::NoiseSource;
use hexbench_model::estimation::residuals::ErrorSummary;
use hexbench_model::inference::selection::HeldOut;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::compare::association::Association;
use hexbench_model::results::diagnose::{Diagnosis, NextReport, SeparationReport};
pub use hexbench_report::charts::StoryChart;
use hexbench_report::{Page, Section};
use serde::{Deserialize, Serialize};

#[cfg(test)]
mod typescript;

/// Answer to `GET /api/catalogue`: what there is to choose from.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Catalogue {
    /// Version of the program.
    pub version: &'static str,
    /// Terms of the model, in the order of the catalogue.
    pub terms: Vec<TermCard>,
    /// Chapters of the catalogue, in the order in which they are shown.
    pub chapters: Vec<&'static str>,
    /// Bundled measurements.
    pub cases: Vec<Choice>,
    /// Families of machines that can be simulated.
    pub machines: Vec<Choice>,
    /// Plans of a simulated campaign.
    pub plans: Vec<Choice>,
    /// Effects that can be put into a simulated machine; those outside the catalogue begin with `out:`.
    pub effects: Vec<Choice>,
    /// The files named on the command line, when there are any; opened by `{"from": "given"}`.
    pub given: Option<Choice>,
    /// What a formula of one's own may use.
    pub formula: FormulaHelp,
    /// What the server accepts.
    pub limits: ServerLimits,
}

/// A term of the model.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct TermCard {
    /// Kebab-case id.
    pub id: String,
    /// A few words.
    pub title: String,
    /// One of [`Catalogue::chapters`].
    pub chapter: &'static str,
    /// One or two sentences.
    pub physics: String,
    /// First-order equation.
    pub equation: String,
    /// What the data must contain for it to show.
    pub shows: String,
    /// True when it has a richer form, asked for by `:richer` behind the id.
    pub richer: bool,
    /// Names of its parameters with their units.
    pub parameters: Vec<NamedUnit>,
}

/// A name and a unit.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct NamedUnit {
    /// Name.
    pub name: String,
    /// Unit.
    pub unit: String,
}

/// Something to choose.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Choice {
    /// What is sent back.
    pub id: String,
    /// What people read.
    pub title: String,
    /// A sentence more; may be empty.
    pub text: String,
}

/// What a formula may use.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct FormulaHelp {
    /// Names and meanings, with units.
    pub variables: Vec<Choice>,
    /// Names of functions.
    pub functions: Vec<String>,
    /// Units a parameter may have.
    pub units: Vec<String>,
    /// A term file to begin with.
    pub example: String,
}

/// What the server accepts.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ServerLimits {
    /// Bytes of a request.
    pub bytes: usize,
    /// Readings of a file.
    pub rows: usize,
    /// Terms of one's own in a request.
    pub own_terms: usize,
    /// Bytes of a term of one's own.
    pub term_bytes: usize,
    /// Benches kept; the one unused for longest gives way.
    pub benches: usize,
}

/// Body of `POST /api/benches`.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(tag = "from", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Open {
    /// Measurements that come with the program.
    Case {
        /// One of [`Catalogue::cases`].
        id: String,
    },
    /// The files given on the command line, when there are any.
    Given {},
    /// Files the page has read; their names are only shown.
    Files {
        /// hexapod.toml
        hexapod: FileText,
        /// measurements.csv
        data: FileText,
        /// holdout.csv
        holdout: Option<FileText>,
    },
    /// What is opened otherwise, with more measurements below its own: a run sheet that was filled in.
    More {
        /// How the others are opened.
        base: Box<Open>,
        /// Readings of the same kind, with the same columns.
        readings: FileText,
    },
    /// What is opened otherwise, read differently from what its files say.
    ReadAs {
        /// How it is opened.
        base: Box<Open>,
        /// Changes as `--read-as` takes them, applied in their order.
        changes: Vec<String>,
    },
    /// A machine simulated on the spot.
    Simulation {
        /// One of [`Catalogue::machines`].
        machine: String,
        /// One of [`Catalogue::plans`].
        plan: String,
        /// Ids of [`Catalogue::effects`].
        effects: Vec<String>,
        /// How far each effect stands out of what the springs can absorb, in units of the noise; none: its usual size.
        distance: Option<f64>,
        /// Decides machine, plan and noise; none: drawn.
        seed: Option<u64>,
    },
    /// Something is hidden from the user.
    Game {
        /// How hard.
        level: GameLevel,
        /// Decides everything; none: drawn.
        seed: Option<u64>,
    },
}

/// How hard a game is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum GameLevel {
    /// One effect of the catalogue, easy to see.
    Easy,
    /// One or two effects.
    Hard,
    /// Anything: nothing at all, one, two, or something the catalogue does not know.
    Honest,
}

/// A file as text.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct FileText {
    /// Its name, for messages; never used to find a file.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// Answer to `POST /api/benches` (201).
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Opened {
    /// Names it in later requests.
    pub id: String,
    /// Name of the machine.
    pub title: String,
    /// A line each: files, readings, noise.
    pub about: Vec<String>,
    /// What a simulation was made from, to make it again.
    pub seed: Option<u64>,
    /// What was put in, unless it is hidden; empty when nothing was, absent for measurements.
    pub contains: Option<Vec<Hidden>>,
    /// True for a game: what is in it is told by `reveal` only.
    pub sealed: bool,
    /// True for absolute poses, false for deflections.
    pub absolute: bool,
    /// Readings fitted.
    pub readings: usize,
    /// How the files are read differently from what they say, as `--read-as` takes it; empty: as they are written.
    pub read_as: Vec<String>,
    /// Standard deviation of one reading.
    pub noise: NoiseLevels,
    /// Why a term cannot be tested with these data; terms not listed can.
    pub untestable: Vec<UntestableTerm>,
    /// Base joints, mm, fixed frame.
    pub base_joints_mm: [[f64; 3]; 6],
    /// Where and how was measured.
    pub conditions: ConditionLists,
    /// The same of the holdout file; absent without one.
    pub held_out: Option<ConditionLists>,
    /// The springs alone.
    pub view: View,
}

/// Noise of one reading.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct NoiseLevels {
    /// Of a translation, um.
    pub translation_um: f64,
    /// Of a rotation, urad.
    pub rotation_urad: f64,
    /// Where it comes from.
    #[cfg_attr(test, ts(as = "String"))]
    pub source: NoiseSource,
}

/// A term the data cannot speak about.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct UntestableTerm {
    /// Its id.
    pub term: String,
    /// Why.
    pub why: String,
}

/// Conditions (readings averaged where all that was set is equal), one entry per condition shown in every list. Deflections are
/// loaded minus reference; of an absolute pose what is measured beside what is commanded.
#[derive(Debug, Clone, Default, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ConditionLists {
    /// How many there are; those shown are evenly chosen.
    pub of: usize,
    /// a, b, c (mm), alpha, beta, gamma (deg).
    pub pose: Vec<[f64; 6]>,
    /// Change of the wrench: N, N m.
    pub wrench: Vec<[f64; 6]>,
    /// Change of the leg forces, N, tension positive.
    pub leg_force_n: Vec<[f64; 6]>,
    /// Leg lengths, mm.
    pub leg_length_mm: Vec<[f64; 6]>,
    /// Time since the reference, s.
    pub elapsed_s: Vec<f64>,
    /// Temperature since the reference, K.
    pub delta_t_k: Vec<f64>,
    /// 1 or -1.
    pub approach: Vec<f64>,
    /// The file they come from.
    pub file: String,
    /// Lines of the file that hold its readings.
    pub lines: Vec<Vec<u64>>,
    /// Platform joints before the load, mm, fixed frame.
    pub platform_joints_mm: Vec<[[f64; 3]; 6]>,
    /// Measured: a, b, c (um), alpha, beta, gamma (urad).
    pub measured: Vec<[f64; 6]>,
    /// The same as motion of the platform at its origin, fixed axes: um, urad (rotation vector).
    pub measured_motion: Vec<[f64; 6]>,
}

/// Answer to `POST /api/benches/{id}/view`: springs and the selected terms, fitted to the data.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct View {
    /// The selection, in its order.
    pub terms: Vec<String>,
    /// Error on the readings fitted.
    pub fitted: ErrorSummary,
    /// Error on held-out readings; absent where none can be held out.
    pub holdout: Option<ErrorSummary>,
    /// `holdout file` or `poses left out in turn`.
    #[cfg_attr(test, ts(as = "String"))]
    pub held_out: HeldOut,
    /// Held-out error (else fitted) as a multiple of the noise.
    pub times_noise: f64,
    /// Standard deviation of that multiple where the noise is all there is; it is then one on the average.
    pub band: f64,
    /// Chance of a held-out error as large as this if the model is right; absent where nothing could be held out or the noise is not
    /// known apart from the residuals.
    pub chance: Option<f64>,
    /// True when that is what the noise gives, and errors of the inputs within their tolerances.
    pub at_the_noise: bool,
    /// True when it is that, and more than the noise alone gives.
    pub by_tolerances: bool,
    /// Numbers of the terms.
    pub parameters: Vec<Estimate>,
    /// Leg stiffness, N/um.
    pub legs: [Leg; 6],
    /// Names of what the data leave open.
    pub not_determined: Vec<String>,
    /// Pairs of numbers that can hardly be told apart.
    pub look_alikes: Vec<LookAlike>,
    /// Elongation of each leg the model leaves, um, per condition shown.
    pub residual_um: Vec<[f64; 6]>,
    /// Prediction in measured coordinates, um and urad, per condition shown.
    pub predicted: Vec<[f64; 6]>,
    /// Prediction as motion of the platform, um and urad, per condition shown.
    pub predicted_motion: Vec<[f64; 6]>,
    /// The same of the readings of the holdout file; absent without one.
    pub held_out_readings: Option<HeldOutReadings>,
    /// Are the residuals noise?
    pub scatter: ReadingResiduals,
    /// Time taken on the server, ms.
    pub milliseconds: f64,
}

/// Readings of the holdout file beside the model, one entry per condition of [`Opened::held_out`].
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct HeldOutReadings {
    /// Elongation of each leg the model leaves, um.
    pub residual_um: Vec<[f64; 6]>,
    /// Prediction in measured coordinates, um and urad.
    pub predicted: Vec<[f64; 6]>,
    /// Measured, in the frames of the model: um and urad.
    pub measured: Vec<[f64; 6]>,
}

/// Stiffness of one leg, N/um; absent where the data leave it open.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Leg {
    /// Stiffness.
    pub stiffness: Option<f64>,
    /// Standard uncertainty (k = 1).
    pub std: Option<f64>,
    /// As the machine's file states it.
    pub nominal: Option<f64>,
}

/// Two numbers with correlated estimates.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct LookAlike {
    /// One.
    pub a: String,
    /// The other.
    pub b: String,
    /// Correlation of the estimates.
    pub correlation: f64,
}

/// Residuals of single readings in units of the noise.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ReadingResiduals {
    /// Outline of the histogram: residual, share per unit.
    pub histogram: Vec<[f64; 2]>,
    /// Normal plot: expected of noise, found.
    pub quantiles: Vec<[f64; 2]>,
    /// Per condition shown, the number farthest from zero of its readings that are fitted; null where none of them is.
    pub extremes: Vec<Option<f64>>,
}

/// Body of `POST /api/benches/{id}/trials`: each of some terms beside a model.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct Try {
    /// Ids of the terms tried.
    pub each: Vec<String>,
    /// The model they are added to, one at a time.
    #[serde(flatten)]
    pub selection: Selection,
}

/// Answer to `POST /api/benches/{id}/trials`.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Tried {
    /// Terms that could be fitted; the one with which held-out readings are foreseen best comes first.
    pub trials: Vec<TermTrial>,
    /// Time taken on the server, ms.
    pub milliseconds: f64,
}

/// Answer to `POST /api/benches/{id}/followed`: what the residuals of a selection follow.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Followed {
    /// The most significant first, one for each thing followed; empty where nothing is followed significantly.
    pub panels: Vec<FollowedPanel>,
    /// False where the readings do not determine the elongation of every leg: nothing is asked then.
    pub seen: bool,
    /// Time taken on the server, ms.
    pub milliseconds: f64,
}

/// Answer to `POST /api/benches/{id}/picture`: the model of a selection beside the springs alone, in one picture.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Pictured {
    /// The machine with what the terms explain; null where the readings do not determine the motion of the platform.
    pub picture: Option<StoryChart>,
    /// Time taken on the server, ms.
    pub milliseconds: f64,
}

/// Residual elongations over what they follow.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct FollowedPanel {
    /// What is followed, and how significantly.
    pub association: Association,
    /// Words for what is followed.
    pub title: &'static str,
    /// Its unit; empty for the approach.
    pub unit: &'static str,
    /// Per condition shown and leg: where it stands, and what its elongation in um is divided by; null where the panel leaves it out.
    pub places: Vec<[Option<[f64; 2]>; 6]>,
    /// Means of bins: what is followed, mean residual, its standard uncertainty.
    pub bins: Vec<[f64; 3]>,
    /// The course that the test asks about; empty for the approach.
    pub course: Vec<[f64; 2]>,
}

/// A term tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct TermTrial {
    /// Its id.
    pub term: String,
    /// Held-out error with it (else that of the readings fitted) as a multiple of the noise.
    pub times_noise: f64,
    /// What it gains in the logarithm of the predictive density of the held-out readings, nats: what the terms are sorted by; absent
    /// where nothing is held out.
    pub gain: Option<f64>,
    /// Chance that the best of as many useless terms takes as much off what the model leaves of the readings fitted; absent where they
    /// cannot tell.
    pub chance: Option<f64>,
    /// True when that chance is not believed in, and the readings held out are better foreseen as well.
    pub better: bool,
}

/// Body of `POST /api/benches/{id}/diagnosis` and of `POST /api/benches/{id}/discovery`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct Ask {
    /// Term files of one's own that compete.
    #[serde(default)]
    pub own: Vec<String>,
    /// Lines of the measurements that are left out.
    #[serde(default)]
    pub exclude: Vec<u64>,
}

/// Answer to `POST /api/benches/{id}/check`, whose body is that of a diagnosis: what is wrong with the files, before any effect is compared.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct CheckedFiles {
    /// True when nothing has to be put right first.
    pub ready: bool,
    /// What is wrong and what looks odd, with what to do, as `hexbench check` says it; empty where there is neither.
    pub sections: Vec<Section>,
    /// Ways to read the files that findings name, each as changes that `--read-as` takes.
    pub ways: Vec<Vec<String>>,
    /// Time taken on the server, ms.
    pub milliseconds: f64,
}

/// Answer to `POST /api/benches/{id}/diagnosis`.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Diagnosed {
    /// The verdict.
    pub word: Verdict,
    /// Everything the diagnosis says, as every other medium says it.
    pub page: Page,
    /// The machine with what was found, of misread files as the springs alone see them; null where the readings do not determine the
    /// motion of the platform.
    pub picture: Option<StoryChart>,
    /// Ways to read the files that findings name, each as changes that `--read-as` takes.
    pub ways: Vec<Vec<String>>,
    /// Everything, as `diagnose --json` writes it.
    pub diagnosis: Diagnosis,
    /// Time taken on the server, ms.
    pub milliseconds: f64,
}

/// Body of `POST /api/benches/{id}/plan`: the readings to take next.
#[derive(Debug, Clone, Default, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct PlanReadings {
    /// Term files of one's own that compete.
    #[serde(default)]
    pub own: Vec<String>,
    /// Lines of the measurements that are left out.
    #[serde(default)]
    pub exclude: Vec<u64>,
    /// Which readings.
    #[serde(default)]
    pub choice: ReadingChoice,
    /// What measuring takes; nothing unless said.
    #[serde(default)]
    pub pace: MeasuringPace,
    /// As many readings as fit in so many hours, instead of a choice.
    #[serde(default)]
    pub hours: Option<f64>,
}

/// What the parts of measuring take.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct MeasuringPace {
    /// Time to read once the load rests, s.
    pub reading_s: f64,
    /// Time of one change of load, s.
    pub load_change_s: f64,
    /// Time of one change of pose, s.
    pub pose_change_s: f64,
}

/// Which of the readings that would separate the explanations left are taken.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct ReadingChoice {
    /// Readings proposed, with their repeats; null: as many as the diagnosis asks for.
    #[serde(default)]
    pub number: Option<usize>,
    /// How often each of them is read, zero for one that is left out; empty: as proposed.
    #[serde(default)]
    pub repeats: Vec<usize>,
}

/// Answer to `POST /api/benches/{id}/plan`.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct PlannedReadings {
    /// The readings proposed, in the order in which they were chosen; those left out without repeats.
    pub next: Vec<NextReport>,
    /// Platform joints at each of them before the load, mm, fixed frame.
    pub platform_joints_mm: Vec<[[f64; 3]; 6]>,
    /// What they promise, pair by pair; empty without readings, and where nothing is in doubt.
    pub separation: Vec<SeparationReport>,
    /// The smallest effects that show now and with these readings, beside those of the diagnosis.
    pub visible: Vec<VisibleSize>,
    /// Different poses among the readings taken.
    pub poses: usize,
    /// Time that they take, s.
    pub seconds: f64,
    /// Time taken on the server, ms.
    pub milliseconds: f64,
}

/// The smallest size of an effect that shows in nine of ten campaigns.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct VisibleSize {
    /// Id of the effect.
    pub term: String,
    /// Its parameter.
    pub parameter: String,
    /// Unit of the sizes.
    pub unit: String,
    /// With the measurements alone; null when no size shows.
    pub now: Option<f64>,
    /// With the readings taken beside them.
    pub planned: Option<f64>,
}

/// Answer to `POST /api/benches/{id}/discovery`, whose body is that of a diagnosis.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Discovered {
    /// Everything the search says, as every other medium says it.
    pub page: Page,
    /// The law as a term file (term/1); absent where none was found.
    pub law: Option<String>,
    /// Effects of the catalogue that stand beside it.
    pub beside: Vec<String>,
    /// Time taken on the server, ms.
    pub milliseconds: f64,
}

/// Body of `POST /api/benches/{id}/export`.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct Export {
    /// What.
    pub what: What,
    /// The readings of a run sheet.
    #[serde(default)]
    pub plan: ReadingChoice,
    /// The model, for `model`; the competitors of one's own, for `report` and `diagnosis`.
    #[serde(flatten)]
    pub selection: Selection,
}

/// Body of `POST /api/benches/{id}/session`: what was done, to be kept.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct KeepSession {
    /// As a file to be opened again, or as a page to be read.
    pub form: SessionForm,
    /// Every step, the springs alone first.
    pub steps: Vec<SessionStep>,
    /// The step that is shown, from zero.
    pub at: usize,
    /// What somebody wrote beside it.
    pub notes: String,
    /// What readings that were brought back were foreseen to tell; absent where none were.
    #[serde(default)]
    pub foreseen: Option<SessionForesight>,
}

/// In what form a session is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum SessionForm {
    /// session.json
    File,
    /// A page without scripts.
    Report,
}

/// Answer to `POST /api/benches/{id}/resume`, whose body is the file: what was done with these very measurements.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Resumed {
    /// How the session reads the files differently from what they say; to be gone on with, they are opened so.
    pub read_as: Vec<String>,
    /// Every step, the springs alone first.
    pub steps: Vec<SessionStep>,
    /// The step that was shown, from zero.
    pub at: usize,
    /// What somebody wrote beside it.
    pub notes: String,
    /// What readings that were brought back were foreseen to tell; null where none were.
    pub foreseen: Option<SessionForesight>,
}

/// What can be taken home.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum What {
    /// model.toml of the selection.
    Model,
    /// The page of `diagnose --html`.
    Report,
    /// `diagnose --json`.
    Diagnosis,
    /// The machine's file.
    Hexapod,
    /// The measurements.
    Measurements,
    /// The held-out measurements.
    Holdout,
    /// The readings the diagnosis asks for next, to be taken and filled in.
    RunSheet,
    /// The same on paper.
    RunSheetPage,
}

/// Answer to `POST /api/benches/{id}/export`.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Exported {
    /// Name for the file.
    pub name: String,
    /// Media type.
    pub media: &'static str,
    /// What is in it.
    pub text: String,
}

/// Body of `POST /api/benches/{id}/reveal`.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct Guess {
    /// Ids of terms; `outside` for something the catalogue does not know; empty: nothing is hidden.
    pub guess: Vec<String>,
}

/// Answer to `POST /api/benches/{id}/reveal`.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Revealed {
    /// True when the guess names all that is hidden and nothing else.
    pub right: bool,
    /// What is hidden.
    pub hidden: Vec<Hidden>,
    /// True leg stiffness, N/um.
    pub leg_stiffness: [f64; 6],
}

/// An effect in a simulated machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Hidden {
    /// Its id; `out:...` when the catalogue lacks it.
    pub id: String,
    /// In words.
    pub title: String,
}

/// Body of every refusal.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Refused {
    /// What is wrong.
    pub error: String,
    /// What to do.
    pub next: String,
}
