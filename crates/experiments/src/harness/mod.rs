//! The harness of all experiments: jobs, progress, failures, a record of every trial, a journal.
//!
//! ```text
//! Protocol: trial 0 .. n --draw, identify, compare--> Record --shard after shard--> journal
//!           journal, in the order of the trials --> Gathered --> figures, page;  --> table of trials
//! ```
//!
//! - A trial is a pure function of the protocol and its number, with its own random streams. The results depend neither on
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

/// An experiment: numbered trials, what is recorded of each, and what a row of its table shows.
pub trait Protocol: Sync {
    /// What is known of a trial afterwards; kept exactly, to the last bit of every number.
    type Record: Serialize + DeserializeOwned + Send;
    /// Why a trial has no answer.
    type Error: std::fmt::Display;

    /// Everything the trials depend on.
    fn identity(&self) -> Identity;

    /// How many trials there are.
    fn trials(&self) -> u64;

    /// Draws a campaign, identifies, compares with the truth.
    ///
    /// # Errors
    /// The campaign cannot be made or identified: a result too, kept as its reason.
    fn trial(&self, number: u64) -> Result<Self::Record, Self::Error>;

    /// Name of a trial in tables.
    fn name(&self, number: u64) -> String;

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
    let Some(folder) = folder else {
        progress.begin(protocol.trials(), 0);
        let one = |number| Ok::<_, ExperimentError>(answer(protocol, number, progress));
        return each(0..protocol.trials(), progress, one).map(Gathered::new);
    };
    let rows = Rows(protocol);
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

/// One trial, watched.
fn answer<P: Protocol + ?Sized>(
    protocol: &P,
    number: u64,
    progress: &dyn Progress,
) -> TrialResult<P::Record> {
    let answer = protocol.trial(number).map_err(|why| why.to_string());
    progress.advance(1);
    answer
}

/// The trials of a protocol as shards, for those who compute them elsewhere.
pub fn sharded<P: Protocol + Send + 'static>(protocol: P) -> Box<dyn Sharded + Send> {
    Box::new(Rows(Box::new(protocol)))
}

/// Shards of a protocol, borrowed or owned: the answers in the order of the trials.
struct Rows<B>(B);

impl<B: Deref<Target: Protocol> + Sync> Sharded for Rows<B> {
    fn identity(&self) -> Identity {
        self.0.identity()
    }

    fn shards(&self) -> Shards {
        Shards { trials: self.0.trials(), size: self.0.trials_of_a_shard() }
    }

    fn content(&self, shard: u64, progress: &dyn Progress) -> Result<Vec<u8>, ExperimentError> {
        // One after the other: threads that help each other would have many shards half done when a run is killed.
        let unless_stopped = |number| {
            if progress.is_stopped() {
                Err(ExperimentError::Stopped)
            } else {
                Ok(answer(&*self.0, number, progress))
            }
        };
        let answers: Vec<TrialResult<<B::Target as Protocol>::Record>> =
            self.shards().trials_of(shard).map(unless_stopped).collect::<Result<_, _>>()?;
        postcard::to_stdvec(&answers).map_err(|why| ExperimentError::Unkept(why.to_string()))
    }
}
