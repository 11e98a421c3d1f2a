//! Figures of one fault.

use hexbench_core::statistics::{Proportion, quantile};
use hexbench_model::inference::verdict::Verdict;
use hexbench_truth::laboratory::{self, FaultEntry};

use super::RobustnessRecord;

/// What became of the campaigns of one fault.
#[derive(Debug)]
pub struct Violation<'a> {
    /// The fault.
    pub fault: &'static FaultEntry,
    /// Its trials.
    pub records: Vec<&'a RobustnessRecord>,
}

impl<'a> Violation<'a> {
    /// One for each fault with a trial, the control first.
    pub fn of_each(records: &'a [RobustnessRecord]) -> Vec<Self> {
        let of = |fault: &'static FaultEntry| Self {
            fault,
            records: records.iter().filter(|r| r.fault == fault.id).collect(),
        };
        laboratory::registry().map(of).filter(|v| !v.records.is_empty()).collect()
    }

    fn share(
        &self,
        among: impl Fn(&RobustnessRecord) -> bool,
        test: impl Fn(&RobustnessRecord) -> bool,
    ) -> Proportion {
        Proportion::count(self.records.iter().filter(|r| among(r)), |r| test(r))
    }

    /// Clean machines called adequate, or whose data alone are blamed.
    pub fn clean_right(&self) -> Proportion {
        self.share(RobustnessRecord::is_clean, RobustnessRecord::is_right)
    }

    /// Hidden effects named first.
    pub fn effect_right(&self) -> Proportion {
        self.share(|r| !r.is_clean(), RobustnessRecord::is_right)
    }

    /// Answers with an effect that is not there.
    pub fn falsely_named(&self) -> Proportion {
        self.share(|_| true, RobustnessRecord::names_falsely)
    }

    /// Answers "outside": all that is hidden is in the catalogue, so that all of them are wrong.
    pub fn outside(&self) -> Proportion {
        self.share(|_| true, |r| r.answer.verdict == Verdict::Outside)
    }

    /// Answers with a finding that calls the fault by its name; of nothing where there is no word for it.
    pub fn reported(&self) -> Proportion {
        self.share(|_| !self.fault.findings.is_empty(), RobustnessRecord::tells_fault)
    }

    /// Answers with a finding of a fault that is not there.
    pub fn other_reported(&self) -> Proportion {
        self.share(|_| true, RobustnessRecord::tells_another)
    }

    /// Leg stiffnesses within 1.96 of their stated standard deviations; answers "outside" come with a model that is known to
    /// lack something and do not count.
    pub fn stiffness(&self) -> Proportion {
        let meant = self.records.iter().filter(|r| r.answer.verdict != Verdict::Outside);
        meant.map(|r| r.stiffness_coverage()).sum()
    }

    /// The same of all answers.
    pub fn any_stiffness(&self) -> Proportion {
        self.records.iter().map(|r| r.stiffness_coverage()).sum()
    }

    /// Median of the reduced chi-square of the final model on held-out poses.
    pub fn held_out(&self) -> Option<f64> {
        quantile(self.records.iter().filter_map(|r| r.answer.holdout[1]), 0.5)
    }

    /// Answers with a verdict on clean machines, and on those with an effect.
    pub fn verdicts(&self, verdict: Verdict) -> [usize; 2] {
        let count = |clean| {
            let of = |r: &&&RobustnessRecord| r.is_clean() == clean && r.answer.verdict == verdict;
            self.records.iter().filter(of).count()
        };
        [true, false].map(count)
    }
}
