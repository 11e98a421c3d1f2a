//! Where another program is ahead of the first.

use super::cells::ratio_in_words;
use super::paired::ratio_of;
use super::{CaseScore, ChallengeScores, EntrantScore};

/// An error of a case, by name.
type Measure = (&'static str, fn(&CaseScore) -> Option<f64>);

const MEASURES: [Measure; 2] = [
    ("predictions", |c| c.prediction.map(|p| p.error_in_noise)),
    ("leg stiffness", CaseScore::stiffness_error),
];

/// One sentence for each group and figure in which a rival is ahead.
pub(super) fn found(scores: &ChallengeScores, first: &EntrantScore, rivals: &[EntrantScore]) -> Vec<String> {
    let of_rival = |rival: &EntrantScore| {
        let groups = scores.groups.iter().enumerate();
        groups.flat_map(|(g, group)| in_group(&group.name, g, first, rival)).collect::<Vec<_>>()
    };
    rivals.iter().flat_map(of_rival).collect()
}

fn in_group(group: &str, index: usize, first: &EntrantScore, rival: &EntrantScore) -> Vec<String> {
    let (name, other) = (&rival.name, &first.name);
    let pairs = || rival.cases.iter().zip(&first.cases).filter(|(c, _)| c.group == group);
    let ahead = |(what, error): &Measure| {
        let (ratio, cases) = ratio_of(pairs().map(|(r, f)| (error(r), error(f))))?;
        let sentence =
            || format!("{name}, {group}, {what}: {} times {other}, {cases} cases", ratio_in_words(ratio));
        (ratio.0 < 1.0).then(sentence)
    };
    let right = |e: &EntrantScore| e.groups[index].figures.outcomes.map_or(0, |counts| counts[0]);
    let (own, others) = (right(rival), right(first));
    let more = format!("{name}, {group}, diagnoses: right in {own}, {other} in {others}");
    MEASURES.iter().filter_map(ahead).chain((own > others).then_some(more)).collect()
}
