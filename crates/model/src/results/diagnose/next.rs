//! The proposed readings as people and programs receive them.

use super::report::{NextReport, SeparationReport};
use crate::inference::explanation::Explanation;
use crate::results::next::{Between, PairForecast, Proposal, ProposedReadings, RivalExplanation};

/// Pairs told.
const MOST_PAIRS: usize = 3;

/// Proposals with what they promise.
#[derive(Debug, Default)]
pub struct NextReadings {
    /// The readings.
    pub readings: Vec<NextReport>,
    /// What they promise, the pairs of the most probable explanations first.
    pub separation: Vec<SeparationReport>,
}

impl NextReadings {
    /// Readings proposed to separate these rivals.
    pub fn of(proposed: &ProposedReadings, rivals: &[RivalExplanation]) -> Self {
        let mut pairs: Vec<&PairForecast> = proposed.forecasts.iter().collect();
        let weight = |o: &PairForecast| o.between.map(|k| rivals[k].weight).iter().product::<f64>();
        pairs.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
        let separation = pairs.into_iter().take(MOST_PAIRS).map(|o| separation_report(o, rivals));
        Self {
            readings: proposed.proposals.iter().map(|p| next_report(p, rivals)).collect(),
            separation: separation.collect(),
        }
    }
}

fn next_report(p: &Proposal, rivals: &[RivalExplanation]) -> NextReport {
    let o = &p.observation;
    let pose = o.pose.to_array();
    NextReport {
        pose: std::array::from_fn(|k| if k < 3 { pose[k] * 1e3 } else { pose[k].to_degrees() }),
        wrench: o.wrench.to_array(),
        reference: o.reference.to_array(),
        approach: o.approach,
        elapsed_s: o.elapsed,
        delta_t_k: o.delta_t,
        repeats: p.repeats,
        separates: names(rivals, p.between),
        gain: p.gain,
        text: p.words.clone(),
    }
}

fn separation_report(o: &PairForecast, rivals: &[RivalExplanation]) -> SeparationReport {
    SeparationReport {
        between: names(rivals, o.between),
        log10_bayes_factor: o.separation.log_bayes_factor.map(|x| x / std::f64::consts::LN_10),
        right: o.separation.right,
        readings_needed: o.readings_needed,
    }
}

/// What each of two explanations has that the other has not.
fn names(rivals: &[RivalExplanation], [a, b]: Between) -> [String; 2] {
    [(a, b), (b, a)].map(|(own, other)| {
        let own = rivals[own].terms.iter().filter(|id| !rivals[other].terms.contains(id));
        let names: Vec<&str> = own.map(String::as_str).collect();
        if names.is_empty() { Explanation::Nothing.into() } else { names.join(" + ") }
    })
}
