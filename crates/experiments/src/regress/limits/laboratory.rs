//! Answers on campaigns of laboratories that do something wrong: one fault of each sort, and none.

use hexbench_model::inference::verdict::Verdict;

use super::share;
use crate::regress::limit::{LimitGroup, LimitTest, RegressLimit};
use crate::robustness::RobustnessRecord;

/// Leg stiffnesses, of six, that may miss the truth by more than 1.96 standard deviations: two do by chance in 3 of 100 campaigns.
const MISSES: usize = 1;

/// The limits.
pub(super) fn all() -> Vec<RegressLimit> {
    vec![
        limit(
            ("laboratory-false-names", "faults of laboratories: effects named that are not there"),
            "What is wrong with the data must not be told as physics of the machine.",
            |r| Some(r.names_falsely()),
        ),
        limit(
            ("laboratory-clean", "faults of laboratories: clean machines not called so"),
            "A sound machine must pass, whatever is said of the data.",
            |r| r.is_clean().then(|| !r.is_right()),
        ),
        limit(
            ("laboratory-effect", "faults of laboratories: a hidden effect that is not the first one named"),
            "A fault of the data must not hide an effect that nobody overlooks in good data.",
            |r| (!r.is_clean()).then(|| !r.is_right()),
        ),
        limit(
            (
                "laboratory-coverage",
                "faults of laboratories: two leg stiffnesses or more outside 1.96 standard deviations",
            ),
            "A stated uncertainty counts in the laboratory that people have.",
            |r| {
                let within = r.stiffness_coverage();
                // Answers \"outside\" come with a model that is known to lack something.
                let meant = within.of > 0 && r.answer.verdict != Verdict::Outside;
                meant.then(|| within.of - within.hits > MISSES)
            },
        ),
    ]
}

/// Share of bad answers among those that a limit looks at.
fn limit(
    (id, title): (&str, &str),
    why: &str,
    is_bad: fn(&RobustnessRecord) -> Option<bool>,
) -> RegressLimit {
    RegressLimit::new((id, LimitGroup::Laboratories), title, why, LimitTest::Share, move |t| {
        t.laboratories.iter().flatten().filter_map(|r| is_bad(r).map(share)).collect()
    })
}
