//! A protocol with what its trials gave.

use hexbench_report::Section;

use super::{Gathered, Protocol, TrialResult};

/// All trials of a protocol.
#[derive(Debug)]
pub struct Study<P: Protocol> {
    /// What was run.
    pub protocol: P,
    /// Trials with an answer, in the order of the protocol.
    pub records: Vec<P::Record>,
    /// Trials without one: name and reason.
    pub failures: Vec<(String, String)>,
}

impl<P: Protocol> Study<P> {
    /// What the trials of a protocol gave.
    pub fn of(protocol: P, gathered: Gathered<P::Record>) -> Self {
        let answered = protocol.jobs().into_iter().zip(&gathered.answers);
        let failure = |(job, answer): (P::Job, &TrialResult<P::Record>)| {
            Some((protocol.name(&job), answer.as_ref().err()?.clone()))
        };
        let failures = answered.filter_map(failure).collect();
        Self { records: gathered.answers.into_iter().flatten().collect(), failures, protocol }
    }

    /// Trials without an answer, for a page; none where all have one.
    pub fn unanswered(&self) -> Option<Section> {
        unanswered(&self.failures)
    }
}

/// The same for the trials of several protocols.
pub(crate) fn unanswered<'a>(failures: impl IntoIterator<Item = &'a (String, String)>) -> Option<Section> {
    let listed = failures.into_iter().map(|(name, why)| format!("{name}: {why}"));
    Section::new("Without an answer").list(listed).unless_empty()
}
