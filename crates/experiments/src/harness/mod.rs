//! The harness of all experiments: jobs, progress, failures, a record of every trial, a journal.
//!
//! ```text
//! Protocol: jobs --draw, identify, compare--> Record --shard after shard--> journal
//!           journal, in the order of the trials --> Gathered --> figures, page;  --> table of trials
//! ```
//!
//! - A trial is a pure function of the protocol and its job, with its own random streams. The results depend neither on
//!   threads, nor on the order of the work, nor on interruptions.
//! - A trial without an answer is a result with its reason; only an error ends an experiment.
//! - With a journal, every finished shard is saved at once, and a killed run can be resumed.

mod gathered;
mod loops;
mod part;
mod progress;
mod sharded;
mod shared;
mod study;
mod table;
pub(crate) mod words;

use std::ops::Deref;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::ExperimentError;
use crate::journal::{Identity, Shards};
pub use gathered::{Gathered, TrialResult};
pub(crate) use loops::{each, on_threads};
pub use part::{ExperimentPart, NoPart};
pub use progress::{Progress, Silent};
pub use sharded::{Sharded, compute, record};
pub(crate) use shared::refuse_pending;
pub use shared::{compute_part, take_over};
pub use study::Study;
pub(crate) use study::unanswered;
pub use table::{Field, RecordValue, table};

/// An experiment: a list of trials, what is recorded of each, and what a row of its table shows.
pub trait Protocol: Sync {
    /// What a trial is: which campaign, and what becomes of it.
    type Job: Send + Sync;
    /// What is known of a trial afterwards; kept exactly, to the last bit of every number.
    type Record: Serialize + DeserializeOwned + Send;
    /// Why a trial has no answer.
    type Error: std::fmt::Display;

    /// Everything the trials depend on.
    fn identity(&self) -> Identity;

    /// What each trial is, in their order.
    fn jobs(&self) -> Vec<Self::Job>;

    /// Draws a campaign, identifies, compares with the truth.
    ///
    /// # Errors
    /// The campaign cannot be made or identified: a result too, kept as its reason.
    fn trial(&self, job: &Self::Job) -> Result<Self::Record, Self::Error>;

    /// Name of a trial in tables.
    fn name(&self, job: &Self::Job) -> String;

    /// What a row of the table of trials shows of a record.
    fn fields(&self) -> Vec<Field<Self::Record>>;

    /// Trials kept as one: some tenths of a second of work, so that little is lost when a run is killed.
    fn trials_of_a_shard(&self) -> u64 {
        4
    }
}

/// Runs what is missing of an experiment, keeps it in the journal of a folder where one is given, and gathers all.
///
/// # Errors
/// [`ExperimentError`] when the folder is of no use or the progress asks for a stop; what is kept stays.
pub fn run<P: Protocol>(
    protocol: &P,
    folder: Option<&Path>,
    progress: &dyn Progress,
) -> Result<Gathered<P::Record>, ExperimentError> {
    let rows = Rows::of(protocol);
    let Some(folder) = folder else {
        progress.begin(rows.jobs.len() as u64, 0);
        let one = |job| Ok::<_, ExperimentError>(rows.answer(job, progress));
        return each(&rows.jobs, progress, one).map(Gathered::new);
    };
    let journal = compute_part(&rows, folder, None, progress)?;
    let mut all = Vec::new();
    for shard in 0..rows.shards().count() {
        let content = journal.content(shard)?;
        let own: Vec<TrialResult<P::Record>> =
            postcard::from_bytes(&content).map_err(|_| journal.missing(shard))?;
        all.extend(own);
    }
    Ok(Gathered::new(all))
}

/// The trials of a protocol as shards, for those who compute them elsewhere.
pub fn sharded<P: Protocol + Send + 'static>(protocol: P) -> Box<dyn Sharded + Send> {
    Box::new(Rows::of(Box::new(protocol)))
}

/// Shards of a protocol, borrowed or owned: the answers in the order of the trials.
struct Rows<B: Deref<Target = P>, P: Protocol> {
    protocol: B,
    jobs: Vec<P::Job>,
}

impl<B: Deref<Target = P>, P: Protocol> Rows<B, P> {
    fn of(protocol: B) -> Self {
        Self { jobs: protocol.jobs(), protocol }
    }

    /// One trial, watched.
    fn answer(&self, job: &P::Job, progress: &dyn Progress) -> TrialResult<P::Record> {
        let answer = self.protocol.trial(job).map_err(|why| why.to_string());
        progress.advance(1);
        answer
    }
}

impl<B: Deref<Target = P> + Sync, P: Protocol> Sharded for Rows<B, P> {
    fn identity(&self) -> Identity {
        self.protocol.identity()
    }

    fn shards(&self) -> Shards {
        Shards { trials: self.jobs.len() as u64, size: self.protocol.trials_of_a_shard() }
    }

    fn content(&self, shard: u64, progress: &dyn Progress) -> Result<Vec<u8>, ExperimentError> {
        // One after the other: threads that help each other would have many shards half done when a run is killed.
        let unless_stopped = |job| {
            if progress.is_stopped() { Err(ExperimentError::Stopped) } else { Ok(self.answer(job, progress)) }
        };
        let trials = self.shards().trials_of(shard);
        let [first, end] = [trials.start, trials.end].map(|n| usize::try_from(n).unwrap_or(usize::MAX));
        let answers: Vec<TrialResult<P::Record>> =
            self.jobs[first..end].iter().map(unless_stopped).collect::<Result<_, _>>()?;
        postcard::to_stdvec(&answers).map_err(|why| ExperimentError::Unkept(why.to_string()))
    }
}
