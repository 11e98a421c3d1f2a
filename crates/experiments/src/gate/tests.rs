//! What the gate promises, on simulated scores: a program that did not change passes, edits are noticed as often as it says.

use std::collections::BTreeMap;

use hexbench_core::streams::{Purpose, stream};
use rand::RngExt;
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

use super::comparison::{GateComparison, compare};
use super::notice::Noticed;
use super::values::GateValues;
use super::work::Checked;
use super::{GateBaseline, GateEntrant, GateSuite};
use crate::alarm::LimitVerdict;
use crate::challenge::run::RunLimits;
use crate::challenge::score::{CaseScore, LegScore, PredictionScore, ProperScore};

const CASES: usize = 84;
const REPEATS: usize = 5;

/// A program in numbers: what chance does in each case, and what an edit did.
#[derive(Clone, Copy)]
struct Simulated {
    /// Scatter of the logarithm of errors between runs; none: the same answers every time.
    scatter: f64,
    /// Probability with which an edit makes an answer confidently wrong, in every run.
    edit: f64,
    /// Which cases it meets.
    seed: u64,
}

const STEADY: Simulated = Simulated { scatter: 0.0, edit: 0.0, seed: 0 };
const RANDOM: Simulated = Simulated { scatter: 0.3, ..STEADY };

impl Simulated {
    fn run(&self, number: u64) -> Vec<CaseScore> {
        (0..CASES).map(|case| self.case(case, number)).collect()
    }

    fn case(&self, case: usize, number: u64) -> CaseScore {
        // What belongs to the case, to the edit, and to the run.
        let mut own = stream(1, Purpose::Test, [case as u64]);
        let mut edit = stream(self.seed, Purpose::Test, [case as u64, 2]);
        let mut run = stream(number, Purpose::Test, [case as u64, 3]);
        let is_random = self.scatter > 0.0;
        let edited = edit.random::<f64>() < self.edit;
        let normal = |rng: &mut Pcg64| rng.sample::<f64, _>(StandardNormal);
        let error = 0.02 * f64::exp(normal(&mut own) + self.scatter * normal(&mut run));
        // Most cases are never wrong, some always, some by chance.
        let wrong = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, if is_random { 0.3 } else { 0.0 }][case % 7];
        let wrong = run.random::<f64>() < wrong;
        let failure = (is_random && run.random::<f64>() < 0.01).then(|| "time limit".to_owned());
        let z = if edited { 8.0 } else { 1.0 };
        let proper = ProperScore { crps: 0.6 * error, interval: None };
        let leg = LegScore { relative_error: error, z: Some(z), proper };
        let prediction = PredictionScore {
            chi2_reduced: 1.0,
            error_in_noise: error,
            rms_um: error,
            rms_urad: error,
            covered: None,
            z: Some(1.0),
            proper,
        };
        let answered = failure.is_none();
        CaseScore {
            id: format!("case-{:03}", case + 1),
            group: "one".to_owned(),
            distance: 10.0,
            failure,
            legs: [answered.then_some(leg); 6],
            stiffness: answered.then_some(proper),
            prediction: answered.then_some(prediction),
            outcome: answered.then_some(if wrong { "wrong" } else { "right" }),
            confidence: Some(0.6),
            ..CaseScore::default()
        }
    }

    fn runs(&self, first: u64, count: usize) -> Vec<Vec<CaseScore>> {
        (first..).take(count).map(|number| self.run(number)).collect()
    }

    fn baseline(&self) -> GateBaseline {
        let all = GateValues::of(&self.runs(0, REPEATS));
        let steady = all.is_steady();
        GateBaseline {
            format: String::new(),
            entrant: entrant(),
            repeats: REPEATS,
            steady,
            history: Vec::new(),
            cases: (0..CASES).map(|k| format!("case-{:03}", k + 1)).collect(),
            figures: if steady { all.first() } else { all },
            suite: GateSuite {
                name: "simulated".to_owned(),
                version: 1,
                seed: Some(1),
                text: None,
                file: "simulated".to_owned(),
                cases_sha256: String::new(),
            },
        }
    }

    /// A check of this program beside a baseline, with runs from a number on.
    fn check(&self, baseline: &GateBaseline, first: u64) -> GateComparison {
        let runs = self.runs(first, if baseline.steady { 1 } else { REPEATS });
        let values = GateValues::of(&runs);
        compare(baseline, &entrant(), &Checked { cases: runs[0].clone(), values, scattered: Vec::new() })
    }
}

fn entrant() -> GateEntrant {
    GateEntrant {
        program: vec!["simulated".to_owned()],
        inside: false,
        depends: Vec::new(),
        limits: RunLimits::default(),
        files: BTreeMap::new(),
    }
}

#[test]
fn a_hundred_unchanged_runs_of_a_random_program_give_one_alarm_at_most() {
    const CHECKS: u64 = 100;
    let baseline = RANDOM.baseline();
    assert!(!baseline.steady);
    let is_alarm = |check: &u64| RANDOM.check(&baseline, 1000 + 10 * check).fails();
    let alarms = (0..CHECKS).filter(is_alarm).count();
    assert!(alarms <= 1, "{alarms} alarms in {CHECKS} checks");
}

#[test]
fn an_unchanged_program_without_scatter_has_the_same_scores_and_passes() {
    let baseline = STEADY.baseline();
    assert!(baseline.steady && baseline.figures.count() == 1);
    let found = STEADY.check(&baseline, 77);
    assert!(found.same && !found.fails() && found.changes.is_empty(), "{found:?}");
    assert!(found.false_alarm < 1e-3, "{}", found.false_alarm);
}

#[test]
fn a_figure_that_no_answer_has_any_more_is_no_test_that_passed() {
    let baseline = STEADY.baseline();
    let mut run = STEADY.run(77);
    for case in &mut run {
        *case = CaseScore {
            id: case.id.clone(),
            group: case.group.clone(),
            failure: Some("time limit".to_owned()),
            ..CaseScore::default()
        };
    }
    let values = GateValues::of(std::slice::from_ref(&run));
    let found = compare(&baseline, &entrant(), &Checked { cases: run, values, scattered: Vec::new() });
    let text = super::cases::xml(&found).unwrap();
    let xml = roxmltree::Document::parse(&text).unwrap();
    let count = |tag: &str| xml.descendants().filter(|n| n.has_tag_name(tag)).count();
    let silent = found.findings.iter().filter(|f| !f.is_stated_now()).count();
    assert!(silent > 3 && count("skipped") == silent && count("failure") == 1, "{text}");
    assert!(text.contains("now no answer has it"), "{text}");
}

/// Share of edits that are noticed, and the chance that the gate states.
fn noticed(program: Simulated, edits: u64) -> (f64, f64) {
    let baseline = program.baseline();
    let check = |seed: u64| {
        Simulated { edit: super::notice::SHARE, seed, ..program }.check(&baseline, 5000 + 10 * seed)
    };
    let found: Vec<GateComparison> = (1..=edits).map(check).collect();
    let alarms = found.iter().filter(|c| {
        c.findings.iter().any(|f| f.id == "stiffness-far-off" && f.verdict == LimitVerdict::Worse)
    });
    let stated = found[0].findings.iter().find_map(|f| match f.noticed {
        Noticed::Hits { chance, .. } if f.id == "stiffness-far-off" => Some(chance),
        _ => None,
    });
    (alarms.count() as f64 / edits as f64, stated.unwrap())
}

#[test]
fn three_percent_of_confidently_wrong_answers_are_noticed_as_often_as_stated() {
    const EDITS: u64 = 300;
    let (share, stated) = noticed(STEADY, EDITS);
    assert!((stated - 0.92).abs() < 0.02, "{stated}");
    assert!(
        (share - stated).abs() < 4.0 * (stated * (1.0 - stated) / EDITS as f64).sqrt(),
        "{share}, stated {stated}"
    );
    let (share, stated) = noticed(RANDOM, EDITS / 2);
    assert!(stated > 0.5 && share > stated - 0.12, "random: {share}, stated {stated}");
}
