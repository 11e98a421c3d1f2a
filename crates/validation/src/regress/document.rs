//! `docs/regress.md`: the rule, what each limit would notice, unchanged runs, planted faults.

use hexbench_report::Document;

use super::baseline::Baseline;
use super::comparison::{level, probability};
use super::figure::{figure, notice};
use super::limit::{Group, Limit};
use super::notice::{POWER, noticed};
use super::planted::Planted;
use super::rule::{FALSE_ALARM, Verdict};
use super::suite::{MACHINES_SEED, Suite};
use super::summary::row;
use super::unchanged::Unchanged;
use crate::proportion::Proportion;

/// Failed limits listed for a planted fault.
const LISTED: usize = 4;
/// Borders of the distribution of smallest probabilities, in units of the level of one limit.
const BORDERS: [f64; 5] = [1.0, 10.0, 100.0, 1000.0, 10_000.0];

const BEGINNING: &str = "\
# Accuracy regression

`hexbench regress` runs a fixed suite of campaigns with a known truth and compares accuracy, honesty of uncertainties, answers,
probabilities and effort with the committed baseline `data/regress/baseline.json`. It ends with exit code 1 when something is
worse than chance explains. This page is written by `scripts/regress_proof.sh`; a workflow for GitHub Actions is
[github-actions-accuracy.yml](github-actions-accuracy.yml).

```text
hexbench regress                                       compare with the committed baseline
hexbench regress --junit limits.xml --markdown -       for continuous integration
hexbench regress --seed 7                              other campaigns of the same kind
hexbench regress --update --reason \"TEXT\"              make the figures of this program the baseline
```
";

const RULE: &str = "\
Both the run and the baseline are samples. Each limit asks how probable so large a change for the worse would be if nothing had
changed, with `n1` campaigns now and `n0` in the baseline:

- **Shares** (false names, regions that miss the truth): Fisher's exact test, one-sided. A campaign counts once.
- **Errors and counts**: Student's test of logarithms, `t = (m1 - m0) / (s sqrt(1/n1 + 1/n0))` with `s` and `n0 - 1` degrees of
  freedom of the baseline. Errors of estimates are heavy-tailed, their logarithms are not; values are clipped to a range.
- **Pulls** (`m' C^-1 m / n` of the misses `m` of `n` numbers in their covariance `C`, one value for each campaign, 16 at most): the
  F law of the ratio of two means. The degrees of freedom are those that give the variance `v` seen in the baseline,
  `2 n m^2 / v` (Satterthwaite 1946), so that correlated or heavy-tailed pulls do not count for more than they are worth. Too wide is
  a fault as well as too narrow: what moves away from 1 is worse.
- **Without noise** chance takes no part: the same machines are fitted in every run, whatever its seed. An error may grow by half
  and no more; solvers stop within a hundredth of a percent of the same point, so that this is no rounding. Where world and
  model agree to rounding, the bound derived for it must hold (see [recovery.md](recovery.md)).
- **Effort** is counted (iterations, linearisations, sets), never timed.

A change for the better beyond chance is told and does not fail. With the seed of the baseline, the page also says how many limits
have the very same values, bit for bit: after a change that should move nothing, that should be all of them. The comparison is
then cautious, since the run is one of those behind the baseline. A baseline is not changed without a reason; reasons and dates are
kept in it. One of another suite, or one whose numbers contradict each other, is refused.
";

/// The page.
pub fn document(
    suite: &Suite,
    limits: &[Limit],
    baseline: &Baseline,
    runs: &[Unchanged],
    planted: &[Planted],
    sample: &Counts,
) -> String {
    let mut page = Document::default();
    scope(&mut page, suite, baseline, limits);
    planted_faults(&mut page, planted);
    unchanged(&mut page, runs, limits);
    let tail = {
        let mut tail = Document::default();
        sensitivity(&mut tail, limits, baseline, sample);
        tail.to_markdown()
    };
    format!("{BEGINNING}\n{}\n## The rule\n\n{RULE}\n{tail}", page.to_markdown())
}

/// How many values each limit has in one run.
pub type Counts = Vec<u64>;

fn scope(page: &mut Document, suite: &Suite, baseline: &Baseline, limits: &[Limit]) {
    let diagnosed: Vec<String> =
        suite.portions.iter().map(|p| format!("{} {}", p.trials, p.kind.name())).collect();
    page.heading(2, "What is run");
    page.list([
        format!(
            "{} noisy campaigns, fitted by the right model: {} of each of springs, geometry and every effect of the catalogue; \
             machines, plans, noise and sizes are drawn.",
            suite.subjects.len() * suite.fits,
            suite.fits
        ),
        format!(
            "{} diagnoses, which are told nothing: {}.",
            suite.portions.iter().map(|p| p.trials).sum::<usize>(),
            diagnosed.join(", ")
        ),
        format!(
            "{} campaigns without noise, {} of each, drawn once and for all (seed {MACHINES_SEED}).",
            suite.subjects.len() * suite.machines,
            suite.machines
        ),
        format!(
            "{} limits, {} of them with chance; the baseline has {} runs from seed {}.",
            limits.len(),
            limits.iter().filter(|l| l.test.is_random()).count(),
            baseline.runs,
            baseline.seed
        ),
    ]);
    page.paragraph(
        "The suite does not test: files and their readers, the pages, plans and their design, the workbench, times. The same \
         seed gives the same figures on any number of threads.",
    );
    page.heading(3, "History of the baseline");
    let of = |u: &super::baseline::Update| {
        vec![u.date.clone(), u.hexbench.clone(), format!("{} from seed {}", u.runs, u.seed), u.reason.clone()]
    };
    page.table(["date", "hexbench", "runs", "reason"], baseline.history.iter().map(of));
}

fn planted_faults(page: &mut Document, planted: &[Planted]) {
    if planted.is_empty() {
        return;
    }
    let seen = planted.iter().filter(|p| p.failed() > 0).count();
    page.heading(2, "Planted faults");
    page.paragraph(format!(
        "`scripts/planted_faults.sh` plants one fault at a time in a copy of the sources (`data/regress/faults`), builds it and runs \
         `hexbench regress`. {seen} of {} are seen.",
        planted.len()
    ));
    let of = |p: &Planted| {
        let exit = if p.comparison.fails() { "1" } else { "0" };
        vec![p.name.clone(), p.text.clone(), exit.to_owned(), p.failed().to_string()]
    };
    page.table(["fault", "what it does", "exit code", "limits that fail"], planted.iter().map(of));
    page.paragraph(format!("The {LISTED} plainest of the limits that fail:"));
    for p in planted.iter().filter(|p| p.failed() > 0) {
        page.heading(3, p.name.clone());
        let failed = p.comparison.by_chance().into_iter().filter(|f| f.verdict == Verdict::Worse);
        page.table(["limit", "now", "baseline", "by chance"], failed.take(LISTED).map(row));
    }
}

fn unchanged(page: &mut Document, runs: &[Unchanged], limits: &[Limit]) {
    if runs.is_empty() {
        return;
    }
    let failed = Proportion::count(runs, |r| !r.worse.is_empty());
    let better = runs.iter().filter(|r| !r.better.is_empty()).count();
    page.heading(2, "Runs of the unchanged program");
    page.paragraph(format!(
        "{} runs with fresh seeds beside the committed baseline: {} failed (at most {:.1} % with 95 % confidence; the rule promises {} \
         %), {better} were told to be better. The smallest probability of each run, of {} limits with chance; a limit fails below {}.",
        failed.of,
        failed.hits,
        100.0 * failed.upper_bound(),
        100.0 * FALSE_ALARM,
        limits.iter().filter(|l| l.test.is_random()).count(),
        probability(level(limits)),
    ));
    let level = level(limits);
    let below = |border: f64| runs.iter().filter(|r| r.least <= border * level).count();
    let of = |&border: &f64| {
        let expected = runs.len() as f64
            * -(limits.iter().filter(|l| l.test.is_random()).count() as f64 * (-border * level).ln_1p())
                .exp_m1();
        vec![probability(border * level), below(border).to_string(), format!("{expected:.1}")]
    };
    page.table(
        ["smallest probability below", "runs", "expected of exact, independent tests"],
        BORDERS.iter().map(of),
    );
    let mut least: Vec<&Unchanged> = runs.iter().collect();
    least.sort_by(|a, b| a.least.total_cmp(&b.least));
    page.paragraph("The five smallest:");
    page.table(
        ["seed", "limit", "probability"],
        least.iter().take(5).map(|r| vec![r.seed.to_string(), r.least_of.clone(), probability(r.least)]),
    );
    let (first, last) = (runs.iter().map(|r| r.seed).min(), runs.iter().map(|r| r.seed).max());
    if let (Some(first), Some(last)) = (first, last) {
        page.paragraph(format!(
            "Seeds {first} to {last}; `hexbench validate regress --runs {} --seed {first}` repeats it.",
            runs.len()
        ));
    }
}

fn sensitivity(page: &mut Document, limits: &[Limit], baseline: &Baseline, counts: &Counts) {
    page.heading(2, "What each limit would notice");
    page.paragraph(format!(
        "An unchanged program fails with a probability of at most {} % for each run; each of the limits with chance has an equal share \
         of it, {}. The last column: the figure at which a run fails with a probability of {} %. Small samples notice large changes \
         only: that is why each effect also has limits without noise.",
        100.0 * FALSE_ALARM,
        probability(level(limits)),
        100.0 * POWER
    ));
    let level = level(limits);
    for group in Group::ALL {
        let of = |(limit, count): (&Limit, &u64)| {
            let before = &baseline.limits.get(&limit.id)?.sample;
            let least = noticed(limit.test, *count, before, level);
            let n = if limit.test.is_random() { count.to_string() } else { "-".to_owned() };
            Some(vec![limit.title.clone(), n, figure(limit.test, before), notice(limit.test, least, before)])
        };
        let rows = limits.iter().zip(counts).filter(|(l, _)| l.group == group).filter_map(of);
        page.heading(3, capital(group.word()));
        page.table(["limit", "in a run", "baseline", "would notice"], rows);
    }
    page.heading(3, "Why");
    // Limits of one effect say the same for each.
    let reasons = limits.iter().filter(|l| !l.id.contains(':')).map(|l| format!("{}: {}", l.title, l.why));
    page.list(reasons);
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
