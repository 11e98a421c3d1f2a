//! All effects under one plan.

use hexbench_model::untestable::{Untestable, why_untestable};
use serde::Serialize;

use super::alike::alike;
use super::{Alike, Effect, Planned, Subject, Test};

/// What is asked.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// Chance of a false alarm.
    pub alarm: f64,
    /// Wanted chance to see an effect.
    pub power: f64,
    /// Seed of simulated thresholds and confusions.
    pub seed: u64,
    /// Campaigns behind every row of the confusion.
    pub draws: usize,
}

impl Default for Settings {
    /// 1 % false alarm, 90 % power.
    fn default() -> Self {
        Self { alarm: 0.01, power: 0.9, seed: 1, draws: 100 }
    }
}

/// All effects under a plan.
#[derive(Debug, Clone, Serialize)]
pub struct Study {
    /// What was asked.
    pub settings: Settings,
    /// Effects the plan can test.
    pub effects: Vec<Effect>,
    /// Those it cannot.
    pub untestable: Vec<Untestable>,
    /// Likeness and confusion, in the order of the effects.
    pub alike: Alike,
    /// Tests of the effects, in their order; none where nothing can be seen.
    #[serde(skip)]
    pub tests: Vec<Option<Test>>,
}

/// Power of a plan for these subjects.
pub fn study(planned: &Planned, subjects: Vec<Subject>, settings: Settings) -> Study {
    let mut untestable = Vec::new();
    let mut testable = Vec::new();
    for subject in subjects {
        match why_untestable(subject.term.as_ref(), &planned.campaign, &planned.lin) {
            None => testable.push(subject),
            Some(why) => untestable.push(Untestable::new(subject.term.as_ref(), why)),
        }
    }
    let tests: Vec<Option<Test>> =
        testable.iter().map(|s| Test::new(planned, s.term.as_ref(), &settings)).collect();
    let effects: Vec<Effect> = testable
        .iter()
        .zip(&tests)
        .map(|(s, test)| Effect::of(planned, s, test.as_ref(), &settings))
        .collect();
    let alike = alike(planned, &testable, &effects, &settings);
    Study { settings, effects, untestable, alike, tests }
}
