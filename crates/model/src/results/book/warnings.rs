//! What to know before the charts of a book are read.

use hexbench_core::words::joined;

use super::day::CampaignDay;
use crate::results::runs::{Origin, Run};

/// What does not hold for all campaigns alike.
pub(super) fn warnings(runs: &[Run], is_dated: bool, days: &[Option<CampaignDay>]) -> Vec<String> {
    let origin = |of: fn(&Origin) -> &String| {
        let of = move |run: &Run| run.origin.as_ref().map(of).cloned();
        others(runs, of)
    };
    let mut all = Vec::new();
    if !is_dated && days.iter().any(Option::is_some) {
        all.push("Some campaigns have no date: all are shown in the order given.".to_owned());
    }
    all.extend(models(runs));
    all.extend(same_readings(runs));
    all.extend(of_these(
        &origin(|o| &o.hexapod_sha256),
        "a hexapod file other than the first, whose joints, noise or nominal values may differ",
    ));
    all.extend(of_these(&origin(|o| &o.program), "results of another version of the program"));
    all.extend(of_these(
        &others(runs, |r| Some(r.noise_source)),
        "a noise level from another source than the first",
    ));
    all.extend(of_these(
        &others(runs, |r| Some((r.excluded.clone(), r.keep_all))),
        "a different choice of readings left out or kept than the first",
    ));
    all.extend(of_these(
        &others(runs, |r| Some(r.read_as.clone())),
        "files that were read differently from the first",
    ));
    all
}

/// Numbers of the campaigns, from one, that differ from the first one that has such a thing.
fn others<T: PartialEq>(runs: &[Run], of: impl Fn(&Run) -> Option<T>) -> Vec<usize> {
    let Some(first) = runs.iter().find_map(&of) else { return Vec::new() };
    (0..runs.len()).filter(|k| of(&runs[*k]).is_some_and(|x| x != first)).map(|k| k + 1).collect()
}

fn of_these(campaigns: &[usize], have: &str) -> Option<String> {
    let verb = if campaigns.len() == 1 { "has" } else { "have" };
    (!campaigns.is_empty()).then(|| format!("{} {verb} {have}.", numbered(campaigns)))
}

/// `Campaign 3`, `Campaigns 1, 2 and 7`.
fn numbered(campaigns: &[usize]) -> String {
    let words: Vec<String> = campaigns.iter().map(ToString::to_string).collect();
    let noun = if words.len() == 1 { "Campaign" } else { "Campaigns" };
    format!("{noun} {}", joined(&words))
}

/// Stiffnesses beside other effects are other numbers.
fn models(runs: &[Run]) -> Option<String> {
    let terms = |run: &Run| {
        let mut terms = run.steps.last().map(|s| s.terms.clone()).unwrap_or_default();
        terms.sort();
        terms
    };
    let other = others(runs, |run| Some(terms(run)));
    let these = (!other.is_empty()).then(|| numbered(&other))?;
    Some(format!(
        "{these}: the fitted model has other terms than that of campaign 1. A stiffness takes up what no term explains, so that such a change \
         may be one of the model alone: fit the same terms to every campaign (`hexbench fit --add ... --json`) to follow the machine."
    ))
}

/// The same readings under two names count twice.
fn same_readings(runs: &[Run]) -> Vec<String> {
    let data = |k: usize| runs[k].origin.as_ref().map(|o| &o.data_sha256);
    let earlier = |k: &usize| (0..*k).find(|i| data(*i).is_some() && data(*i) == data(*k));
    let sentence = |k: usize| {
        let first = earlier(&k)? + 1;
        Some(format!(
            "Campaigns {first} and {} have the same measurements, which therefore count twice.",
            k + 1
        ))
    };
    (0..runs.len()).filter_map(sentence).collect()
}
