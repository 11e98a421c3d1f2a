//! `docs/results/regress.md`: the rule, the smallest change that each limit notices, unchanged runs, planted
//! faults.

mod faults;
mod notices;
mod runs;

use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section, Table};

use super::baseline::Baseline;
use super::limit::RegressLimit;
use super::planted::Planted;
use super::suite::{MACHINES_SEED, RegressSuite};
use super::unchanged::Unchanged;
use crate::alarm::Update;

const COMMANDS: &str = "\
hexbench regress                                       compare with the committed baseline
hexbench regress --junit limits.xml --markdown -       for continuous integration
hexbench regress --seed 7                              other campaigns of the same kind
hexbench regress --update --reason \"TEXT\"              make the figures of this program the baseline";

/// What the page is about.
pub struct Proof<'a> {
    /// What is run.
    pub suite: &'a RegressSuite,
    /// Its limits.
    pub limits: &'a [RegressLimit],
    /// How many values each limit has in one run.
    pub counts: &'a [u64],
    /// What runs are compared with.
    pub baseline: &'a Baseline,
    /// Runs that must not fail.
    pub runs: &'a [Unchanged],
    /// Runs that must.
    pub planted: &'a [Planted],
}

/// The page.
pub fn page(proof: &Proof<'_>) -> Page {
    Page::new("Accuracy regression")
        .with(introduction())
        .with(scope(proof.suite, proof.baseline, proof.limits))
        .with(history(proof.baseline))
        .with_all(faults::sections(proof.planted))
        .with(runs::section(proof.runs, proof.limits))
        .with(rule())
        .with_all(notices::sections(proof))
}

fn introduction() -> Section {
    Section::lead()
        .paragraph(written_by("scripts/regress_proof.sh"))
        .paragraph(
            "`hexbench regress` runs a fixed suite of campaigns with a known truth and compares accuracy, honesty of uncertainties, \
             answers, probabilities and effort with the committed baseline `data/regress/baseline.json`. It ends with exit code 1 \
             when something is worse than chance explains. A workflow for GitHub Actions is \
             [github-actions-accuracy.yml](../guide/github-actions-accuracy.yml).",
        )
        .with(Block::code(COMMANDS))
}

fn rule() -> Section {
    Section::new("The rule")
        .paragraph(
            "Both the run and the baseline are samples. Each limit asks how probable so large a change for the worse would be if \
             nothing had changed, with `n1` campaigns now and `n0` in the baseline:",
        )
        .list([
            "**Shares** (false names, regions that miss the truth): Fisher's exact test, one-sided. A campaign counts once.",
            "**Errors and counts**: Student's test of logarithms, `t = (m1 - m0) / (s sqrt(1/n1 + 1/n0))` with `s` and `n0 - 1` \
             degrees of freedom of the baseline. Errors of estimates are heavy-tailed, their logarithms are not; values are clipped \
             to a range.",
            "**Pulls** (`m' C^-1 m / n` of the misses `m` of `n` numbers in their covariance `C`, one value for each campaign, 16 at \
             most): the F law of the ratio of two means. The degrees of freedom are those that give the variance `v` seen in the \
             baseline, `2 n m^2 / v` (Satterthwaite 1946), so that correlated or heavy-tailed pulls do not count for more than they \
             are worth; two standard errors of `v` are added, since a baseline that happens to scatter little would raise false \
             alarms. Too wide is a fault as well as too narrow: what moves away from 1 is worse. Pulls are judged over all effects \
             together and not effect by effect: the few campaigns of one effect, with an outlier now and then, have no tail that \
             could be trusted.",
            "**Without noise** chance takes no part: the same machines are fitted in every run, whatever its seed. An error may grow \
             by half and no more; solvers stop within a hundredth of a percent of the same point, so that this is no rounding. \
             Where world and model agree to rounding, the bound derived for it must hold (see [recovery.md](recovery.md)).",
            "**No values**: some limits look at campaigns that chance chooses, those well visible. Of the values of the baseline's \
             `R` runs and of this one, each is as probably in any of them: this one has none with probability `(R / (R + 1))^n0` at \
             most.",
            "**Effort** is counted (iterations, linearizations, sets), never timed.",
        ])
        .paragraph(
            "A change for the better beyond chance is reported and does not fail. With the seed of the baseline, the page also says \
             how many limits have the very same values, bit for bit: after a change that should move nothing, that should be all of \
             them. The comparison is then cautious, since the run is one of those behind the baseline. A baseline is not changed \
             without a reason; reasons and dates are kept in it. One of another suite, or one whose numbers contradict each other, \
             is refused.",
        )
}

/// Limits in which chance takes part.
fn random(limits: &[RegressLimit]) -> usize {
    limits.iter().filter(|l| l.test.is_random()).count()
}

fn scope(suite: &RegressSuite, baseline: &Baseline, limits: &[RegressLimit]) -> Section {
    let diagnosed: Vec<String> =
        suite.portions.iter().map(|p| format!("{} {}", p.trials, p.kind.name())).collect();
    Section::new("What is run")
.list([
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
            "{} diagnoses of campaigns in which the laboratory does something wrong, {} of each fault, half of them on clean \
             machines: {}.",
            suite.faults.len() * suite.laboratory,
            suite.laboratory,
            suite.faults.join(", ")
        ),
        format!(
            "{} diagnoses of campaigns whose files do not say what is meant, {} of each misstatement: {}; and {} of sound ones.",
            suite.misstatements.len() * suite.misread,
            suite.misread,
            suite.misstatements.join(", "),
            suite.sound
        ),
        format!(
            "{} campaigns without noise, {} of each, drawn once and for all (seed {MACHINES_SEED}).",
            suite.subjects.len() * suite.machines,
            suite.machines
        ),
        format!(
            "{} limits, {} of them with chance; the baseline has {} runs from seed {}.",
            limits.len(),
            random(limits),
            baseline.runs,
            baseline.seed
        ),
    ])
.paragraph("The suite does not test: files and their readers, the pages, plans and their design, the workbench, times. The same \
         seed gives the same figures on any number of threads.")
}

fn history(baseline: &Baseline) -> Section {
    let of = |u: &Update| {
        vec![u.date.clone(), u.hexbench.clone(), format!("{} from seed {}", u.runs, u.seed), u.reason.clone()]
    };
    Section::new("History of the baseline")
        .within()
        .table(Table::named(["date", "hexbench", "runs", "reason"]).rows(baseline.history.iter().map(of)))
}
