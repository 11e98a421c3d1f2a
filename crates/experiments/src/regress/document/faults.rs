//! Planted faults.

use hexbench_report::{Section, Table};

use crate::alarm::table::LimitRow;
use crate::alarm::{LimitVerdict, probability};
use crate::regress::planted::Planted;

/// Failed limits listed for a planted fault.
const LISTED: usize = 5;

/// What was planted, whether it was noticed, and by what.
pub(super) fn sections(planted: &[Planted]) -> Vec<Section> {
    if planted.is_empty() {
        return Vec::new();
    }
    let (seen, unseen): (Vec<&Planted>, Vec<&Planted>) = planted.iter().partition(|p| p.failed() > 0);
    let of = |p: &Planted| {
        let exit = if p.comparison.fails() { "1" } else { "0" };
        [p.name.clone(), p.text.clone(), exit.to_owned(), p.failed().to_string()]
    };
    let table = Table::named(["fault", "what it does", "exit code", "limits that fail"]);
    let first = Section::new("Planted faults")
        .paragraph(format!(
            "`scripts/planted_faults.sh` plants one fault at a time in a copy of the sources (`data/regress/faults`), builds the suite and \
             runs it beside the committed baseline. {} of {} are seen.",
            seen.len(),
            planted.len()
        ))
        .table(table.rows(planted.iter().map(of)))
        .paragraph(format!("By what each is seen ({LISTED} limits at most, those without chance first):"));
    let mut all: Vec<Section> = std::iter::once(first).chain(seen.into_iter().map(seen_by)).collect();
    let last = all.pop();
    all.extend(last.map(|last| last.list(unseen.into_iter().map(not_seen))));
    all
}

fn seen_by(planted: &Planted) -> Section {
    let failed = planted.comparison.by_chance().into_iter().filter(|f| f.verdict == LimitVerdict::Worse);
    Section::new(planted.name.clone()).within().table(
        Table::named(["limit", "now", "baseline", "by chance"])
            .rows(failed.take(LISTED).map(|f| f.cells().into_iter().take(4))),
    )
}

fn not_seen(planted: &Planted) -> String {
    let closest = planted.comparison.least_probable().map_or_else(String::new, |(p, finding)| {
        format!(" The closest is \"{}\", by chance {}.", finding.title, probability(p))
    });
    format!("Not seen: {}.{closest}", planted.name)
}
