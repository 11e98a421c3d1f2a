//! Discovery of a law outside the catalogue, from files to a term file.
//!
//! The readings are diagnosed with the catalogue first. Where it leaves something, or where a simple law may do better than what it
//! names, the laws of [`discovery`](crate::inference::discovery) are scanned beside the springs and beside the catalogue's own best
//! explanations; the survivors compete with all effects of the catalogue, each set at its own optimum. Held-out poses have the last
//! word.

mod judgement;
mod part;
mod proposal;
mod report;
mod search;

use std::collections::BTreeSet;
use std::sync::Arc;

use hexbench_core::words::joined;
use hexbench_core::{Dataset, Hexapod};
use serde::Serialize;

pub use self::judgement::MOST_LAWS;
use self::judgement::{IDEAS, Judged};
pub use self::proposal::diagnose_with_proposal;
pub use self::report::{AllLegs, Discovery, HeldOutFall, LawLegs, LawReport};
use self::search::{Searched, search};
use crate::effects::term::Term;
use crate::effects::user_term::{self, UserTermError};
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::Fit;
use crate::estimation::fit_named::effects;
use crate::estimation::fit_named::{Added, asked_as, fit_wanted};
use crate::inference::diagnosis::{RankedSets, explain};
use crate::inference::discovery::LawTerm;
use crate::inference::examination::{Finding, FindingKind, examine};
use crate::inference::selection::HeldOut;
use crate::inference::verdict::Verdict;
use crate::results::diagnose::{
    Context, DiagnoseOptions, Diagnosis, DiagnosisStudy, StepReport, diagnose_with, prepare,
};

/// What a search for laws came to, in one word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DiscoveryReason {
    /// A law explains what is left, and held-out poses agree.
    Law,
    /// The springs explain the readings.
    NothingMissing,
    /// Effects of the catalogue explain them.
    Catalogue,
    /// What is wrong is in the data, or they cannot judge.
    Readings,
    /// Laws were weighed, and none convinces.
    NoLawConvinces,
}

/// Everything behind a discovery.
pub struct DiscoveryStudy {
    /// What people read.
    pub discovery: Discovery,
    /// The diagnosis with the catalogue.
    pub diagnosis: DiagnosisStudy,
    /// The search with laws; none where there was nothing to search for.
    pub outcome: Option<RankedSets>,
    /// Fits of the steps.
    pub fits: Vec<Fit>,
    /// The laws as term files, best first, those that look like the first behind it; none where no law was found.
    pub term_files: Vec<String>,
}

impl DiscoveryStudy {
    /// The best law as a term file; none where no law was found, so that nobody takes an idea for a finding.
    pub fn term_file(&self) -> Option<&str> {
        self.term_files.first().map(String::as_str)
    }

    /// What competes in a diagnosis that shows the law at work: `terms` and the law, where one was found.
    pub fn competing(&self, terms: &[Arc<dyn Term>]) -> Vec<Arc<dyn Term>> {
        terms.iter().cloned().chain(self.law().ok().flatten()).collect()
    }

    /// The law as a term, where one was found.
    ///
    /// # Errors
    /// [`UserTermError`] for a file that is none, which is a mistake of this program.
    pub fn law(&self) -> Result<Option<Arc<dyn Term>>, UserTermError> {
        self.term_file().map(user_term::parse).transpose()
    }
}

/// Searches a law for what springs and catalogue leave; held-out poses come from `holdout`, else poses are left out in turn.
///
/// # Errors
/// As [`diagnose_with`].
pub fn discover(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    options: &DiagnoseOptions,
) -> Result<DiscoveryStudy, ModelError> {
    discover_watched(hexapod, data, holdout, terms, options, &|| ())
}

/// The same; `watch` is called after every step, [`most_steps`] times at most.
///
/// # Errors
/// As [`discover`].
pub fn discover_watched(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    options: &DiagnoseOptions,
    watch: &dyn Fn(),
) -> Result<DiscoveryStudy, ModelError> {
    if let Some(found) = part::found_in_part(hexapod, data, holdout, terms, options, watch) {
        return Ok(found);
    }
    let diagnosis = diagnose_with(hexapod, data, holdout, terms, options)?;
    watch();
    let attempts = Attempts { hexapod, holdout, terms, diagnosis: &diagnosis, watch };
    let way = attempts.made(data, options)?;
    Ok(way.study(diagnosis))
}

/// Steps that a search takes at most: a diagnosis, and the search in each of two ways; for a large file the same in a part of it.
pub fn most_steps(data: &Dataset) -> u64 {
    let once = 1 + 2 * search::MOST_STEPS;
    if part::of(data).is_some() { 2 * once } else { once }
}

/// In which way the readings were looked at, and what it came to.
enum Way {
    /// As stated: a law that convinces.
    AsStated(Attempt),
    /// As the diagnosis left them.
    AsExamined(Attempt),
    /// As the diagnosis left them, and the one effect that it names does as well as the best of so many laws.
    ForTheCatalogue(usize),
    /// Not at all: there is nothing to search for.
    Needless,
}

impl Way {
    /// What is said of it.
    fn said(&self, diagnosis: &Diagnosis) -> Discovery {
        let without = without_law(diagnosis);
        match self {
            Self::AsStated(attempt) => {
                let warnings = [&[needless(diagnosis)], &attempt.inputs_off[..]].concat();
                attempt.judged.report(Discovery { searched: attempt.tried, warnings, ..without })
            }
            Self::AsExamined(attempt) => {
                let warnings = [&without.warnings[..], &attempt.inputs_off].concat();
                let template = Discovery { searched: attempt.tried, warnings, ..without };
                let judged = &attempt.judged;
                if judged.convinces { judged.report(template) } else { judged.ideas(template) }
            }
            Self::ForTheCatalogue(searched) => Discovery { searched: *searched, ..without },
            Self::Needless => without,
        }
    }

    fn study(self, diagnosis: DiagnosisStudy) -> DiscoveryStudy {
        let said = self.said(&diagnosis.diagnosis);
        match self {
            Self::AsStated(attempt) | Self::AsExamined(attempt) => attempt.finished(said, diagnosis),
            Self::ForTheCatalogue(_) | Self::Needless => {
                let fits = diagnosis.fits.clone();
                DiscoveryStudy { discovery: said, diagnosis, outcome: None, fits, term_files: Vec::new() }
            }
        }
    }
}

/// Where a law was found.
pub(crate) struct Source<'a> {
    data: &'a Dataset,
}

impl Source<'_> {
    /// Lines that a term file begins with.
    fn comments(&self, law: &LawReport) -> Vec<String> {
        let version = env!("CARGO_PKG_VERSION");
        let mut lines = vec![
            format!(
                "Found by hexbench {version} in {}, {} readings.",
                self.data.source,
                self.data.observations.len()
            ),
            format!("Probability {:.3}.", law.probability),
        ];
        let held = law
            .held_out
            .map(|h| format!("Held-out error {:.2} -> {:.2} times the noise.", h.before, h.after));
        lines.extend(held);
        lines.extend(
            law.parameters.iter().map(|p| format!("{} = {:.5} +- {:.2} {}", p.name, p.value, p.std, p.unit)),
        );
        lines
    }
}

/// Laws weighed beside the catalogue, and what is said of them.
struct Attempt {
    outcome: RankedSets,
    laws: Vec<LawTerm>,
    judged: Judged,
    tried: usize,
    /// What laws that convince leave to say of the inputs; nothing of others.
    inputs_off: Vec<String>,
}

impl Attempt {
    /// True when laws explain readings that look faulty: what is left is noise, and held-out readings, which no search has seen, would pick
    /// these laws out of so many by themselves. The best of many laws follows a few wrong readings, and no others.
    fn replaces_faults(&self, diagnosis: &Diagnosis) -> bool {
        let judged = &self.judged;
        let of_so_many = (self.tried.max(1) as f64).ln();
        judged.convinces
            && judged.is_at_the_noise()
            && judged.gain >= of_so_many
            && self.gain_over(diagnosis).is_none_or(|gain| gain >= of_so_many)
    }

    /// What held-out readings gain by the laws over the answer without the readings that look faulty, nats: springs that are fitted to those as
    /// well foresee worse, and a law that makes up for that has not been seen. None where the answer weighs the others by another noise.
    fn gain_over(&self, diagnosis: &Diagnosis) -> Option<f64> {
        let is_apart = |f: &Finding| f.is_as_stated() || f.excludes();
        if !diagnosis.findings.iter().all(is_apart) {
            return None;
        }
        let held_out = |steps: &[StepReport]| steps.last()?.holdout;
        let (with, without) = (held_out(&self.judged.steps)?, held_out(&diagnosis.steps)?);
        let numbers = with.count.min(without.count) as f64;
        Some(0.5 * numbers * (without.chi2_reduced - with.chi2_reduced))
    }

    fn finished(self, discovery: Discovery, diagnosis: DiagnosisStudy) -> DiscoveryStudy {
        let Judged { fits, mut term_files, .. } = self.judged;
        term_files.truncate(if discovery.found { discovery.laws.len() } else { 0 });
        DiscoveryStudy { discovery, outcome: Some(self.outcome), fits, term_files, diagnosis }
    }
}

/// The readings, looked at in two ways.
struct Attempts<'a> {
    hexapod: &'a Hexapod,
    holdout: Option<&'a Dataset>,
    terms: &'a [Arc<dyn Term>],
    diagnosis: &'a DiagnosisStudy,
    watch: &'a dyn Fn(),
}

impl Attempts<'_> {
    fn made(&self, data: &Dataset, options: &DiagnoseOptions) -> Result<Way, ModelError> {
        let replaces = |attempt: &Attempt| attempt.replaces_faults(&self.diagnosis.diagnosis);
        if let Some(attempt) = self.as_stated(data, options)?.filter(replaces) {
            return Ok(Way::AsStated(attempt));
        }
        self.as_examined()
    }

    /// With every reading and the noise as stated, where the diagnosis found a fault of the data: a law that it does not know looks like
    /// wrong loads, wrong poses or noise that readings share.
    fn as_stated(&self, data: &Dataset, options: &DiagnoseOptions) -> Result<Option<Attempt>, ModelError> {
        let diagnosis = &self.diagnosis.diagnosis;
        // Where all readings are kept on request, those that the diagnosis would leave out were examined too.
        let examined = |f: &Finding| f.is_as_stated() || (options.keep_all && f.excludes());
        if diagnosis.findings.iter().all(examined) || diagnosis.is_misread() {
            return Ok(None);
        }
        let meant = self.diagnosis.as_meant.as_ref().map_or(data, |meant| &*meant.data);
        let (data, _) = options.applied(meant)?;
        let campaign = prepare(self.machine(), &data)?;
        if !campaign.noise.allows_verdict() {
            return Ok(None);
        }
        let outcome = explain(&campaign, self.terms)?;
        // Taken up only where it convinces.
        self.searched(&data, &campaign, &outcome, 0).map(Some)
    }

    /// As the diagnosis left them.
    fn as_examined(&self) -> Result<Way, ModelError> {
        let verdict = self.diagnosis.diagnosis.verdict;
        if matches!(verdict, Verdict::Adequate | Verdict::Measurement | Verdict::Undecided) {
            return Ok(Way::Needless);
        }
        let DiagnosisStudy { data, campaign, outcome, diagnosis, .. } = self.diagnosis;
        let ideas = if reason(diagnosis).0 == DiscoveryReason::NoLawConvinces { IDEAS } else { 0 };
        let attempt = self.searched(data, campaign, outcome, ideas)?;
        let may_replace = verdict == Verdict::Named && attempt.judged.convinces;
        if may_replace && !self.beats_the_effect(&attempt) {
            return Ok(Way::ForTheCatalogue(attempt.tried));
        }
        Ok(Way::AsExamined(attempt))
    }

    /// True when a law fits the readings better than the one effect that the diagnosis names, every parameter charged `ln n` (Schwarz
    /// 1978), by more than the best of `N` laws would by chance, `2 ln N` in chi-square: an effect of the catalogue that does as well wins.
    /// Several effects in the place of one law are no such effect.
    fn beats_the_effect(&self, attempt: &Attempt) -> bool {
        let DiagnosisStudy { campaign, diagnosis, fits, .. } = self.diagnosis;
        if diagnosis.added.len() > 1 {
            return true;
        }
        let numbers = campaign.numbers.max(1) as f64;
        let cost = |fit: Option<&Fit>| fit.map_or(f64::INFINITY, |fit| fit.chi2 - fit.dof * numbers.ln());
        let named = diagnosis.added.iter().map(|id| Added::named(id, self.terms));
        // A richer form may have more parameters than these readings ask for.
        let plain = named.collect::<Result<Vec<_>, _>>().and_then(|all| fit_wanted(campaign, &all)).ok();
        let catalogue = cost(fits.last()).min(cost(plain.as_ref().map(|(_, fit)| fit)));
        cost(attempt.judged.fits.last()) + 2.0 * (attempt.tried.max(1) as f64).ln() < catalogue
    }

    fn searched(
        &self,
        data: &Dataset,
        campaign: &Campaign,
        outcome: &RankedSets,
        ideas: usize,
    ) -> Result<Attempt, ModelError> {
        let Searched { outcome, laws, tried } = search(campaign, outcome, self.terms, self.watch)?;
        let judged = self.judged(data, campaign, &outcome, &laws, ideas)?;
        let inputs_off =
            if judged.convinces { self.inputs_off(data, campaign, &outcome)? } else { Vec::new() };
        Ok(Attempt { outcome, laws, judged, tried, inputs_off })
    }

    /// Inputs that are off by more than their tolerance beside the laws, which hid it: a fit that takes them as stated misses the readings.
    fn inputs_off(
        &self,
        data: &Dataset,
        campaign: &Campaign,
        outcome: &RankedSets,
    ) -> Result<Vec<String>, ModelError> {
        let found = examine(self.machine(), data, campaign.noise, outcome)?.findings;
        let is_off = |f: &&Finding| f.kind == FindingKind::Tolerance && !f.is_as_stated();
        Ok(found.iter().filter(is_off).map(|f| format!("beside the law, {}; {}", f.text, f.next)).collect())
    }

    fn judged(
        &self,
        data: &Dataset,
        campaign: &Campaign,
        outcome: &RankedSets,
        laws: &[LawTerm],
        ideas: usize,
    ) -> Result<Judged, ModelError> {
        let context = Context { hexapod: self.machine(), data, holdout: self.held_out(), campaign, outcome };
        Judged::of(&context, laws, &Source { data }, ideas)
    }

    fn machine(&self) -> &Hexapod {
        self.diagnosis.as_meant.as_ref().map_or(self.hexapod, |meant| &meant.hexapod)
    }

    /// The readings held out, unless the diagnosis found that they are of another machine or among those fitted.
    fn held_out(&self) -> Option<&Dataset> {
        let meant = self.diagnosis.as_meant.as_ref().and_then(|meant| meant.holdout.as_deref());
        meant.or(self.holdout).filter(|_| self.diagnosis.diagnosis.holdout == HeldOut::File)
    }
}

/// What the law makes of the faults that the diagnosis saw.
fn needless(diagnosis: &Diagnosis) -> String {
    let kinds: BTreeSet<String> = diagnosis.findings.iter().map(|f| f.kind.title().to_owned()).collect();
    let kinds: Vec<String> = kinds.into_iter().collect();
    format!(
        "without the law the readings look faulty ({}); the law explains all of them unchanged",
        joined(&kinds)
    )
}

/// What there is to say without any law.
fn without_law(diagnosis: &Diagnosis) -> Discovery {
    let (reason, text) = reason(diagnosis);
    Discovery {
        format: "discovery/1",
        found: false,
        reason,
        text,
        verdict: diagnosis.verdict,
        beside: named(diagnosis),
        laws: Vec::new(),
        steps: diagnosis.steps.clone(),
        probability: 0.0,
        next: Vec::new(),
        separation: Vec::new(),
        searched: 0,
        warnings: diagnosis.warnings.clone(),
    }
}

/// The effects that a diagnosis names of files as they are, in the forms that it needs.
fn named(diagnosis: &Diagnosis) -> Vec<String> {
    let all = diagnosis.added.iter().filter(|_| !diagnosis.is_misread());
    all.map(|id| asked_as(id, diagnosis.richer.contains(id))).collect()
}

fn reason(diagnosis: &Diagnosis) -> (DiscoveryReason, String) {
    let at_the_noise = diagnosis.steps.last().is_some_and(StepReport::is_at_the_noise);
    let (reason, text) = match diagnosis.verdict {
        Verdict::Adequate => (
            DiscoveryReason::NothingMissing,
            "nothing is missing: the springs explain the readings to within the noise",
        ),
        Verdict::Measurement => (
            DiscoveryReason::Readings,
            "the fault is in the data, not in the machine: see the findings of `hexbench diagnose`",
        ),
        Verdict::Undecided => {
            (DiscoveryReason::Readings, "these readings cannot show whether anything is missing")
        }
        Verdict::Named | Verdict::Ambiguous if at_the_noise && !diagnosis.added.is_empty() => {
            let effects = effects(&named(diagnosis));
            return (DiscoveryReason::Catalogue, format!("the catalogue explains it: {effects}"));
        }
        Verdict::Named | Verdict::Ambiguous if at_the_noise => (
            DiscoveryReason::Catalogue,
            "the catalogue explains it, in more than one way: see `hexbench diagnose`",
        ),
        Verdict::Named | Verdict::Ambiguous | Verdict::Outside => (
            DiscoveryReason::NoLawConvinces,
            "something is missing, but none of the laws searched is convincing",
        ),
    };
    (reason, text.to_owned())
}
