//! Runs of the unchanged program.

use hexbench_core::statistics::Proportion;
use hexbench_report::{Section, Table};

use super::random;
use crate::alarm::{FALSE_ALARM, probability};
use crate::regress::comparison::level;
use crate::regress::limit::RegressLimit;
use crate::regress::unchanged::Unchanged;

/// Borders of the distribution of smallest probabilities, in units of the level of one limit.
const BORDERS: [f64; 5] = [1.0, 10.0, 100.0, 1000.0, 10_000.0];
/// Runs listed.
const LISTED: usize = 5;

/// How many failed, and how probable the least probable limit of each run was.
pub(super) fn section(runs: &[Unchanged], limits: &[RegressLimit]) -> Option<Section> {
    let (first, last) = (runs.first()?, runs.last()?);
    let mut least: Vec<&Unchanged> = runs.iter().collect();
    least.sort_by(|a, b| a.least.total_cmp(&b.least));
    let of = |r: &&Unchanged| vec![r.seed.to_string(), r.least_of.clone(), probability(r.least)];
    let section = Section::new("Runs of the unchanged program")
.paragraph(in_words(runs, limits))
.paragraph(format!(
        "Seeds {} to {}, made again by `hexbench validate regress --runs {} --seed {}`. The smallest probability of each run:",
        first.seed,
        last.seed,
        runs.len(),
        first.seed
    ))
.table(Table::named(["smallest probability at most", "runs", "expected of exact, independent tests"]).rows(distribution(runs, limits)))
.paragraph("The smallest of all:")
.table(Table::named(["seed", "limit", "probability"]).rows(least.iter().take(LISTED).map(of)));
    Some(section)
}

fn in_words(runs: &[Unchanged], limits: &[RegressLimit]) -> String {
    let failed = Proportion::count(runs, |r| !r.worse.is_empty());
    let better = runs.iter().filter(|r| !r.better.is_empty()).count();
    format!(
        "{} runs with fresh seeds beside the committed baseline: {} failed (at most {:.1} % with 95 % confidence; the rule promises {} \
         %), {better} were called better. {} limits have chance in them; each fails below {}.",
        failed.of,
        failed.hits,
        100.0 * failed.upper_bound(),
        100.0 * FALSE_ALARM,
        random(limits),
        probability(level(limits)),
    )
}

/// Runs whose smallest probability is at most a border, and how many there would be of independent tests with even
/// probabilities; discrete tests have larger ones.
fn distribution(runs: &[Unchanged], limits: &[RegressLimit]) -> Vec<Vec<String>> {
    let of = |border: f64| {
        let p = border * level(limits);
        let any = 1.0 - (1.0 - p).powf(random(limits) as f64);
        let below = runs.iter().filter(|r| r.least <= p).count();
        vec![probability(p), below.to_string(), format!("{:.1}", runs.len() as f64 * any)]
    };
    BORDERS.map(of).to_vec()
}
