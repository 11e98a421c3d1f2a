//! Planted faults.

use hexbench_report::Page;

use crate::regress::comparison::probability;
use crate::regress::planted::Planted;
use crate::regress::rule::Verdict;
use crate::regress::summary::row;

/// Failed limits listed for a planted fault.
const LISTED: usize = 5;

/// What was planted, whether it was noticed, and by what.
pub(super) fn section(page: &mut Page, planted: &[Planted]) {
    if planted.is_empty() {
        return;
    }
    let seen = planted.iter().filter(|p| p.failed() > 0).count();
    page.heading(2, "Planted faults");
    page.paragraph(format!(
        "`scripts/planted_faults.sh` plants one fault at a time in a copy of the sources (`data/regress/faults`), builds the suite and \
         runs it beside the committed baseline. {seen} of {} are seen.",
        planted.len()
    ));
    let of = |p: &Planted| {
        let exit = if p.comparison.fails() { "1" } else { "0" };
        vec![p.name.clone(), p.text.clone(), exit.to_owned(), p.failed().to_string()]
    };
    page.table(["fault", "what it does", "exit code", "limits that fail"], planted.iter().map(of));
    page.paragraph(format!("By what each is seen ({LISTED} limits at most, those without chance first):"));
    planted.iter().filter(|p| p.failed() > 0).for_each(|p| seen_by(page, p));
    page.list(planted.iter().filter(|p| p.failed() == 0).map(not_seen));
}

fn seen_by(page: &mut Page, planted: &Planted) {
    page.heading(3, planted.name.clone());
    let failed = planted.comparison.by_chance().into_iter().filter(|f| f.verdict == Verdict::Worse);
    page.table(["limit", "now", "baseline", "by chance"], failed.take(LISTED).map(row));
}

fn not_seen(planted: &Planted) -> String {
    let closest = planted.comparison.least_probable().map_or_else(String::new, |(p, finding)| {
        format!(" The closest is \"{}\", by chance {}.", finding.title, probability(p))
    });
    format!("Not seen: {}.{closest}", planted.name)
}
