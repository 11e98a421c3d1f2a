//! The accuracy regression on a small suite: it passes unchanged, notices what is planted, and keeps its promises about chance.

use std::path::Path;
use std::sync::OnceLock;

use hexbench_core::statistics::Proportion;
use hexbench_core::streams::{Purpose, stream};
use hexbench_experiments::alarm::{LimitVerdict, POWER, Update};
use hexbench_experiments::calibration::Fate;
use hexbench_experiments::harness::{self, Silent};
use hexbench_experiments::regress::baseline::{Baseline, FirstRun, made};
use hexbench_experiments::regress::cases::xml;
use hexbench_experiments::regress::comparison::{RunComparison, compare};
use hexbench_experiments::regress::gathered::pool;
use hexbench_experiments::regress::limit::{LimitTest, LimitUnit};
use hexbench_experiments::regress::limits::limits;
use hexbench_experiments::regress::notice::noticed;
use hexbench_experiments::regress::rule::judge;
use hexbench_experiments::regress::sample::CondensedValues;
use hexbench_experiments::regress::suite::RegressSuite;
use hexbench_experiments::regress::summary::page;
use hexbench_experiments::regress::trials::{SuiteRuns, SuiteTrials};
use hexbench_report::render::plain;
use rand::RngExt;
use rand_distr::{ChiSquared, Distribution, StandardNormal};
use rand_pcg::Pcg64;

fn update(reason: &str) -> Update {
    Update { date: "2026-01-02".into(), hexbench: "0".into(), seed: 1, runs: 3, reason: reason.into() }
}

fn runs(suite: &RegressSuite, seed: u64, count: usize) -> Vec<SuiteTrials> {
    let runs = SuiteRuns::new(suite, seed, count);
    runs.of_each(harness::run(&runs, None, &Silent).unwrap())
}

/// A baseline of three runs of the quick suite, and its first run.
fn baseline() -> &'static (Baseline, SuiteTrials) {
    static MADE: OnceLock<(Baseline, SuiteTrials)> = OnceLock::new();
    MADE.get_or_init(|| {
        let suite = RegressSuite::quick();
        let runs = runs(&suite, 1, 3);
        let limits = limits(&suite);
        let baseline = made(&suite, &limits, &pool(&limits, &runs), update("first"), Vec::new()).unwrap();
        (baseline, runs[0].clone())
    })
}

fn beside(trials: &SuiteTrials, seed: u64) -> RunComparison {
    let suite = RegressSuite::quick();
    compare(&suite, &limits(&suite), (trials, seed), &baseline().0, "0")
}

fn failed(trials: &SuiteTrials) -> Vec<String> {
    beside(trials, 1).of(LimitVerdict::Worse).map(|f| f.id.clone()).collect()
}

#[test]
fn the_same_run_passes_with_the_same_values_and_another_seed_passes_on_any_number_of_threads() {
    let first = beside(&baseline().1, 1);
    assert!(!first.fails(), "{}", plain(&page(&first, false)));
    assert_eq!(first.same_values(), Some(first.findings.len()));
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        beside(&pool.install(|| runs(&RegressSuite::quick(), 9, 1))[0], 9)
    };
    let [one, three] = [1, 3].map(of);
    assert_eq!(serde_json::to_string(&one).unwrap(), serde_json::to_string(&three).unwrap());
    assert!(!one.fails(), "{}", plain(&page(&one, false)));
    assert_eq!(one.same_values(), None);
    assert!(one.findings.iter().any(|f| f.chance.is_some_and(|p| p < 1.0)), "nothing was drawn");
}

#[test]
fn what_is_planted_in_the_values_fails_its_own_limits() {
    type Plant = fn(&mut SuiteTrials);
    let faults: [(&str, Plant); 6] = [
        ("stiffness-pulls", |t| {
            for f in t.fits.iter_mut().filter_map(|f| f.found.as_mut()) {
                f.springs.as_mut().unwrap().chi2 *= 6.0;
            }
        }),
        ("stiffness-error", |t| {
            t.fits.iter_mut().filter_map(|f| f.found.as_mut()).for_each(|f| f.stiffness_error = Some(5.0));
        }),
        ("exact-effect:target-offset", |t| {
            t.machines
                .iter_mut()
                .filter(|m| m.subject.name == "target-offset")
                .for_each(|m| m.found.as_mut().unwrap().effect.as_mut().unwrap().error *= 1.6);
        }),
        ("exact-bounds", |t| t.machines[0].found.as_mut().unwrap().stiffness.as_mut().unwrap().error = 1.0),
        ("misfits", |t| t.fits.iter_mut().filter_map(|f| f.found.as_mut()).for_each(|f| f.misfit = true)),
        ("without-answer", |t| t.fits.iter_mut().for_each(|f| f.found = None)),
    ];
    for (id, plant) in faults {
        let mut trials = baseline().1.clone();
        plant(&mut trials);
        let found = failed(&trials);
        assert!(found.iter().any(|f| f == id), "{id} is not among {found:?}");
    }
}

#[test]
fn errors_that_grow_by_six_percent_on_the_same_campaigns_are_seen_though_chance_could_do_that_on_others() {
    let suite = RegressSuite::quick();
    let limits = limits(&suite);
    let trials = &baseline().1;
    let at = limits.iter().position(|limit| limit.id == "stiffness-error").unwrap();
    let now = pool(&limits, std::slice::from_ref(trials)).swap_remove(at).sample;
    let verdict = |growth: f64, seed: u64| {
        let mut committed = baseline().0.clone();
        let first_run = FirstRun { n: now.count(), mean: now.moments().0 - growth.ln() };
        committed.limits.get_mut("stiffness-error").unwrap().first_run = Some(first_run);
        compare(&suite, &limits, (trials, seed), &committed, "0").findings.swap_remove(at).verdict
    };
    assert_eq!(verdict(1.04, 1), LimitVerdict::Same);
    assert_eq!(verdict(1.06, 1), LimitVerdict::Worse);
    assert_eq!(verdict(1.06, 2), LimitVerdict::Same, "another seed draws other campaigns");
}

#[test]
fn one_confident_false_answer_more_on_the_same_campaigns_is_seen() {
    let suite = RegressSuite::quick();
    let mut trials = baseline().1.clone();
    let sure = |t: &SuiteTrials| {
        let values = limits(&suite).into_iter().find(|l| l.id == "false-names").unwrap().values;
        values(t).iter().filter(|v| **v > 0.5).count()
    };
    let before = sure(&trials);
    let answer = trials.answers.iter_mut().flatten().find(|a| a.record.fate == Fate::Right).unwrap();
    answer.record.fate = Fate::FalseName;
    assert_eq!(sure(&trials), before + 1);
    assert!(failed(&trials).iter().any(|id| id == "false-names"), "{:?}", failed(&trials));
    let elsewhere = beside(&trials, 2);
    assert!(elsewhere.of(LimitVerdict::Worse).all(|f| f.id != "false-names"), "chance could do that");
}

#[test]
fn junit_has_a_case_for_each_limit_and_tells_of_each_failure_figures_and_the_next_step() {
    let mut trials = baseline().1.clone();
    trials.fits.iter_mut().filter_map(|f| f.found.as_mut()).for_each(|f| f.stiffness_error = Some(5.0));
    let comparison = beside(&trials, 1);
    let text = xml(&comparison).unwrap();
    let xml = roxmltree::Document::parse(&text).unwrap();
    let root = xml.root_element();
    assert_eq!(root.tag_name().name(), "testsuites");
    let count = |tag: &str| xml.descendants().filter(|n| n.has_tag_name(tag)).count();
    assert_eq!(count("testcase"), comparison.findings.len());
    let failures = comparison.of(LimitVerdict::Worse).count();
    assert!(failures > 0);
    assert_eq!(count("failure"), failures);
    for suite in root.children().filter(|n| n.has_tag_name("testsuite")) {
        let cases = suite.children().filter(|n| n.has_tag_name("testcase"));
        let broken = cases.clone().filter(|c| c.children().any(|n| n.has_tag_name("failure"))).count();
        assert!(cases.clone().all(|c| c.has_attribute("name") && c.has_attribute("classname")));
        assert_eq!(suite.attribute("tests"), Some(cases.count().to_string().as_str()));
        assert_eq!(suite.attribute("failures"), Some(broken.to_string().as_str()));
        assert_eq!(suite.attribute("errors"), Some("0"));
    }
    let failure = xml.descendants().find(|n| n.has_tag_name("failure")).unwrap();
    assert!(failure.attribute("message").unwrap().contains("baseline"), "{failure:?}");
    let words = failure.text().unwrap();
    assert!(words.contains("expected:") && words.contains("next:") && words.contains("--update"), "{words}");
}

#[test]
fn limits_have_names_of_their_own_and_reasons() {
    for suite in [RegressSuite::full(), RegressSuite::quick()] {
        let all = limits(&suite);
        let mut ids: Vec<&str> = all.iter().map(|l| l.id.as_str()).collect();
        let mut titles: Vec<&str> = all.iter().map(|l| l.title.as_str()).collect();
        for names in [&mut ids, &mut titles] {
            let before = names.len();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), before, "two limits share a name");
        }
        assert!(all.iter().all(|l| l.why.ends_with('.') && !l.id.contains(' ')));
    }
}

#[test]
fn the_committed_baseline_is_one_of_the_full_suite() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/regress/baseline.json");
    let suite = RegressSuite::full();
    let baseline = Baseline::read_for(&path, &suite, &limits(&suite)).unwrap();
    assert!(baseline.history.iter().all(|u| !u.reason.trim().is_empty() && u.runs > 0));
}

/// What a patch needs to find: the lines of its hunks that it keeps or takes away, and the file they are in.
fn expected_by(patch: &str) -> (&str, Vec<String>) {
    let file = patch.lines().find_map(|line| line.strip_prefix("+++ b/")).unwrap();
    let mut hunks = Vec::new();
    for line in patch.lines().skip_while(|line| !line.starts_with("@@")) {
        match line.split_at_checked(1) {
            Some(("@", _)) => hunks.push(String::new()),
            Some((" " | "-", text)) => hunks.last_mut().unwrap().extend([text, "\n"]),
            None => hunks.last_mut().unwrap().push('\n'),
            Some(_) => {}
        }
    }
    (file, hunks)
}

/// `scripts/planted_faults.sh` takes hours on few cores; that its patches still fit is seen here.
#[test]
fn the_planted_faults_fit_the_sources() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut count = 0;
    for entry in std::fs::read_dir(root.join("data/regress/faults")).unwrap() {
        let path = entry.unwrap().path();
        let patch = std::fs::read_to_string(&path).unwrap();
        let (file, hunks) = expected_by(&patch);
        let source = std::fs::read_to_string(root.join(file)).unwrap();
        assert!(!hunks.is_empty(), "{}", path.display());
        for hunk in hunks {
            assert!(source.contains(&hunk), "{} does not find in {file}:\n{hunk}", path.display());
        }
        count += 1;
    }
    assert!(count >= 9, "{count} faults");
}

#[test]
fn an_update_without_a_reason_is_refused_and_history_is_kept() {
    let suite = RegressSuite::quick();
    let limits = limits(&suite);
    let gathered = pool(&limits, std::slice::from_ref(&baseline().1));
    for nothing in ["", "  \n"] {
        assert!(made(&suite, &limits, &gathered, update(nothing), Vec::new()).is_err());
    }
    let second = made(&suite, &limits, &gathered, update("second"), baseline().0.history.clone()).unwrap();
    let reasons: Vec<&str> = second.history.iter().map(|u| u.reason.as_str()).collect();
    assert_eq!(reasons, ["first", "second"]);
}

/// Draws of the rule.
const DRAWS: usize = 4000;
/// Campaigns now and in the baseline.
const NOW: usize = 40;
const BEFORE: usize = 320;
/// Level of one limit: large enough that false alarms can be counted.
const LEVEL: f64 = 5e-3;

type Law = fn(&mut Pcg64, f64) -> f64;

/// A kind of limit, values of a mean (of sizes: times a factor), and the usual mean.
fn kinds() -> [(LimitTest, Law, f64); 4] {
    let size = LimitTest::Size { range: [1e-9, 1e9], least: 0.1, unit: LimitUnit::Plain };
    let normal: Law = |rng, m| m * f64::exp(StandardNormal.sample(rng));
    // The error of one number: the logarithm of its size is skewed.
    let half_normal: Law = |rng, m| {
        let z: f64 = StandardNormal.sample(rng);
        m * z.abs().max(1e-6)
    };
    let pulls: Law = |rng, m| m * ChiSquared::new(6.0).unwrap().sample(rng) / 6.0;
    let share: Law = |rng, m| f64::from(u8::from(rng.random_bool(m.min(1.0))));
    [
        (size, normal, 1.0),
        (size, half_normal, 1.0),
        (LimitTest::Spread, pulls, 1.0),
        (LimitTest::Share, share, 0.1),
    ]
}

fn drawn((test, law, mean): (LimitTest, Law, f64), n: usize, rng: &mut Pcg64) -> CondensedValues {
    let values: Vec<f64> = (0..n).map(|_| law(rng, mean)).collect();
    CondensedValues::of(test, &values)
}

#[test]
fn without_a_change_the_rule_fails_no_more_often_than_its_level() {
    for (k, kind) in kinds().into_iter().enumerate() {
        let mut rng = stream(7, Purpose::Test, [k as u64]);
        let fails = |_| {
            let before = drawn(kind, BEFORE, &mut rng);
            let now = drawn(kind, NOW, &mut rng);
            judge(kind.0, &now, &before, BEFORE / NOW, LEVEL).verdict == LimitVerdict::Worse
        };
        let hits = (0..DRAWS).map(fails).filter(|fails| *fails).count();
        let found = Proportion { hits, of: DRAWS };
        println!("{:?}: {hits} of {DRAWS}", kind.0);
        assert!(!found.is_above(LEVEL), "{:?}: {hits} of {DRAWS} at a level of {LEVEL}", kind.0);
    }
}

#[test]
fn a_change_of_the_stated_size_is_noticed_in_nine_cases_of_ten() {
    // The baseline is drawn too, so that the stated size moves with it; and no more than a tenth fewer may be noticed.
    const LEAST: f64 = POWER - 0.05;
    for (k, kind) in kinds().into_iter().enumerate() {
        let mut rng = stream(8, Purpose::Test, [k as u64]);
        let notices = |_: &usize| {
            let before = drawn(kind, BEFORE, &mut rng);
            let size = noticed(kind.0, NOW as u64, &before, LEVEL).unwrap();
            let changed = if matches!(kind.0, LimitTest::Size { .. }) { kind.2 * size } else { size };
            let now = drawn((kind.0, kind.1, changed), NOW, &mut rng);
            judge(kind.0, &now, &before, BEFORE / NOW, LEVEL).verdict == LimitVerdict::Worse
        };
        let hits = (0..DRAWS / 8).filter(notices).count();
        let share = hits as f64 / (DRAWS / 8) as f64;
        println!("{:?}: noticed in {:.1} %", kind.0, 100.0 * share);
        assert!(share > LEAST, "{:?}: noticed in {share}, least {LEAST}", kind.0);
    }
}
