//! All effects under one plan.

use hexbench_model::effects::untestable::{Untestable, why_untestable};
use serde::Serialize;

use super::alike::alike;
use super::{Alike, EffectPower, EffectSizes, Planned, PreparedTest};

/// What is asked.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PowerSettings {
    /// Chance of a false alarm.
    pub alarm: f64,
    /// Wanted chance to see an effect.
    pub power: f64,
    /// Seed of simulated thresholds and confusions.
    pub seed: u64,
    /// Campaigns behind every row of the confusion.
    pub draws: usize,
}

impl Default for PowerSettings {
    /// 1 % false alarm, 90 % power.
    fn default() -> Self {
        Self { alarm: 0.01, power: 0.9, seed: 1, draws: 100 }
    }
}

/// All effects under a plan.
#[derive(Debug, Clone, Serialize)]
pub struct PowerStudy {
    /// What was asked.
    pub settings: PowerSettings,
    /// Effects the plan can test.
    pub effects: Vec<EffectPower>,
    /// Those it cannot.
    pub untestable: Vec<Untestable>,
    /// Likeness and confusion, in the order of the effects.
    pub alike: Alike,
    /// Tests of the effects, in their order; none where nothing can be seen.
    #[serde(skip)]
    pub tests: Vec<Option<PreparedTest>>,
}

/// Power of a plan for these subjects.
pub fn study(planned: &Planned, subjects: Vec<EffectSizes>, settings: PowerSettings) -> PowerStudy {
    let mut untestable = Vec::new();
    let mut testable = Vec::new();
    for subject in subjects {
        match why_untestable(subject.term.as_ref(), &planned.campaign, &planned.lin) {
            None => testable.push(subject),
            Some(why) => untestable.push(Untestable::new(subject.term.as_ref(), why)),
        }
    }
    let tests: Vec<Option<PreparedTest>> =
        testable.iter().map(|s| PreparedTest::new(planned, s.term.as_ref(), &settings)).collect();
    let effects: Vec<EffectPower> = testable
        .iter()
        .zip(&tests)
        .map(|(s, test)| EffectPower::of(planned, s, test.as_ref(), &settings))
        .collect();
    let alike = alike(planned, &testable, &effects, &settings);
    PowerStudy { settings, effects, untestable, alike, tests }
}
