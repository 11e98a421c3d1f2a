//! All effects under one plan.

use hexbench_core::StatedTolerances;
use hexbench_model::effects::untestable::{Untestable, why_untestable};
use serde::Serialize;

use super::alike::alike;
use super::{Alike, EffectPower, EffectSizes, Planned, PreparedTest};
use crate::DesignError;

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
    /// How well the inputs are assumed to be known; absent where they count as exact.
    pub tolerances: Option<StatedTolerances>,
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

impl PowerStudy {
    /// How many times as large as with exact inputs an effect must be to be seen, for every effect that shows.
    pub fn growth_by_tolerances(&self) -> Vec<(&'static str, f64)> {
        let of = |e: &EffectPower| {
            let exact = e.seen_at_with_exact_inputs.filter(|_| e.shows())?;
            Some((e.term, e.seen_at.middle / exact))
        };
        self.effects.iter().filter_map(of).collect()
    }
}

/// Power of a plan for these subjects.
///
/// # Errors
/// As [`Planned::new`].
pub fn study(
    planned: &Planned,
    subjects: Vec<EffectSizes>,
    settings: PowerSettings,
) -> Result<PowerStudy, DesignError> {
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
    let mut effects: Vec<EffectPower> = testable
        .iter()
        .zip(&tests)
        .map(|(s, test)| EffectPower::of(planned, s, test.as_ref(), &settings))
        .collect();
    let tolerances = planned.tolerances();
    if tolerances.is_some() {
        let exact = planned.with_exact_inputs()?;
        for (effect, subject) in effects.iter_mut().zip(&testable) {
            effect.compare_with_exact(&exact, subject, &settings);
        }
    }
    let alike = alike(planned, &testable, &effects, &settings);
    Ok(PowerStudy { settings, tolerances, effects, untestable, alike, tests })
}
