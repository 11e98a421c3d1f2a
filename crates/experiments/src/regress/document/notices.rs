//! What each limit would notice, and why it exists.

use hexbench_core::words::upper_first;
use hexbench_report::{Section, Table};

use super::Proof;
use crate::alarm::{FALSE_ALARM, POWER, probability};
use crate::regress::comparison::level;
use crate::regress::figure::{figure, notice};
use crate::regress::limit::{LimitGroup, RegressLimit};
use crate::regress::notice::noticed;

/// A table for each group, then the reasons.
pub(super) fn sections(proof: &Proof<'_>) -> Vec<Section> {
    let level = level(proof.limits);
    let first = Section::new("What each limit would notice").paragraph(format!(
        "An unchanged program fails with a probability of at most {} % for each run; each of the limits with chance has an equal share \
         of it, {}. The last column: the figure at which a run fails with a probability of {} %. Small samples notice large changes \
         only: that is why each effect also has limits without noise.",
        100.0 * FALSE_ALARM,
        probability(level),
        100.0 * POWER
    ));
    let of_group = |group: LimitGroup| {
        let table = Table::named(["limit", "in a run", "baseline", "would notice"]);
        Section::new(upper_first(group.word())).within().table(table.rows(rows(proof, group, level)))
    };
    // Limits of one effect say the same for each.
    let general = proof.limits.iter().filter(|l| !l.id.contains(':'));
    let why = Section::new("Why").within().list(general.map(|l| format!("{}: {}", l.title, l.why)));
    std::iter::once(first).chain(LimitGroup::ALL.map(of_group)).chain([why]).collect()
}

fn rows(proof: &Proof<'_>, group: LimitGroup, level: f64) -> Vec<Vec<String>> {
    let of = |(limit, count): (&RegressLimit, &u64)| {
        let before = &proof.baseline.limits.get(&limit.id)?.sample;
        let least = noticed(limit.test, *count, before, level);
        let n = if limit.test.is_random() { count.to_string() } else { "-".to_owned() };
        Some(vec![limit.title.clone(), n, figure(limit.test, before), notice(limit.test, least, before)])
    };
    let counted = proof.limits.iter().zip(proof.counts);
    counted.filter(|(limit, _)| limit.group == group).filter_map(of).collect()
}
