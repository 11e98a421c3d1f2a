//! What a diagnosis claims, and whether it is true.

use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::verdict::Verdict;

use super::{CalibrationRecord, Fate};

/// A statement with its probability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    /// Probability as stated.
    pub stated: f64,
    /// Whether it was so.
    pub is_true: bool,
    /// What the trial counts for.
    pub weight: f64,
}

/// Kinds of claims.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Claims {
    /// Exactly the effects named are the truth, where the verdict is "named".
    Named,
    /// The best first addition is at work, where that is an effect of the catalogue.
    First,
    /// An effect is at work, alone or with others: one claim for each effect the file can test, unless the verdict is
    /// "outside".
    Presence,
    /// The same where the verdict is "outside".
    PresenceBesideOutside,
    /// Something outside the catalogue is at work.
    Outside,
    /// Nothing is hidden.
    Nothing,
    /// Exactly the verdict is the truth; ambiguous ones claim nothing.
    Verdict,
}

hexbench_core::worded! {
    /// A few words.
    Claims::title {
        Named => "exactly what is named",
        First => "first candidate, an effect",
        Presence => "presence of an effect",
        Outside => "something outside",
        Nothing => "nothing hidden",
        Verdict => "any verdict but ambiguous",
        PresenceBesideOutside => "presence beside \"outside\"",
    }
}

impl Claims {
    /// Claims of these trials, each with the weight of its trial.
    pub fn of<'a>(self, records: impl IntoIterator<Item = &'a CalibrationRecord>, mix: &Mix) -> Vec<Claim> {
        records.into_iter().flat_map(|r| self.one(r, mix.weight(r))).collect()
    }

    fn one(self, r: &CalibrationRecord, weight: f64) -> Vec<Claim> {
        let claim = |stated: f64, is_true: bool| Claim { stated, is_true, weight };
        let presence = || r.present.iter().map(|(id, &p)| claim(p, r.contains(id))).collect();
        let verdict = || r.confidence.map(|p| claim(p, r.fate == Fate::Right)).into_iter().collect();
        let (best, stated) = &r.best;
        let first = best.term().map(|_| claim(*stated, r.holds(best)));
        match self {
            Self::First => first.into_iter().collect(),
            Self::Presence if r.verdict != Verdict::Outside => presence(),
            Self::PresenceBesideOutside if r.verdict == Verdict::Outside => presence(),
            Self::Named if r.verdict == Verdict::Named => verdict(),
            Self::Named | Self::Presence | Self::PresenceBesideOutside => Vec::new(),
            Self::Outside => vec![claim(r.outside, r.holds(&Explanation::Outside))],
            Self::Nothing => vec![claim(r.none, r.holds(&Explanation::Nothing))],
            Self::Verdict => verdict(),
        }
    }
}

/// Weights of the trials: how often each sort of truth is taken to occur.
#[derive(Debug, Clone, PartialEq)]
pub struct Mix {
    weights: [f64; 4],
}

/// Shares of no, one and two effects and of something outside that the diagnosis itself expects before it has seen data.
const EXPECTED: [f64; 4] = [0.45, 0.38, 0.13, 0.04];

impl Mix {
    /// Every trial counts once.
    pub fn as_drawn() -> Self {
        Self { weights: [1.0; 4] }
    }

    /// Truths as often as the diagnosis expects them; together the trials count as often as there are.
    pub fn as_expected(records: &[CalibrationRecord]) -> Self {
        let mut counts = [0_usize; 4];
        for r in records {
            counts[class(r)] += 1;
        }
        let present: f64 = (0..4).filter(|&k| counts[k] > 0).map(|k| EXPECTED[k]).sum();
        let share = |k: usize| EXPECTED[k] / present * records.len() as f64 / counts[k].max(1) as f64;
        Self { weights: std::array::from_fn(share) }
    }

    fn weight(&self, record: &CalibrationRecord) -> f64 {
        self.weights[class(record)]
    }
}

/// No effect, one, two, something outside.
fn class(record: &CalibrationRecord) -> usize {
    if record.is_outside() { 3 } else { record.hidden.len().min(2) }
}
