//! Perfect answers score perfectly, worse ones worse, unreadable ones not at all.

use hexbench_report::render::{html, markdown};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use hexbench_core::files::read_measurements;
use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Measurand};
use hexbench_experiments::challenge::answer::columns;
use hexbench_experiments::challenge::run::RunLimits;
use hexbench_experiments::challenge::score::{EntrantScore, Figures, Mean, leaderboard, page, places, score};
use hexbench_experiments::challenge::{ChallengeError, Truth};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::support::{Bench, EVERY_SORT, ONE};

/// Copies the answer that was prepared for a case, whose id is the name of its machine.
const COPY: &str = "id=$(sed -n 's/^name = \"\\(.*\\)\"/\\1/p' \"$1/hexapod.toml\"); cp \"$0/$id/\"* \"$2\"";
/// Digits that the change of units costs, of the largest number.
const DIGITS: f64 = 1e-9;

/// How an answer is made from the truth.
#[derive(Clone, Copy)]
struct Make {
    /// Relative error of every stiffness.
    stiffness: f64,
    /// Relative standard uncertainty stated, and of a random error beside it.
    stated: f64,
    random: f64,
    /// Error of every prediction in noise; the same stated when `sigma`.
    noise: f64,
    sigma: bool,
    /// Factor on all uncertainties that are stated.
    widen: f64,
    /// Probability stated for the truth, the rest for something else.
    belief: f64,
}

const PERFECT: Make =
    Make { stiffness: 0.0, stated: 0.01, random: 0.0, noise: 0.0, sigma: false, widen: 1.0, belief: 1.0 };

struct Prepared<'a> {
    bench: &'a Bench,
    folder: PathBuf,
    rng: Pcg64,
}

impl<'a> Prepared<'a> {
    /// Writes an answer to every case.
    fn answers(bench: &'a Bench, make: Make) -> PathBuf {
        let folder = bench.folder.path().join("prepared");
        let mut prepared = Self { bench, folder, rng: stream(5, Purpose::Test, []) };
        for id in bench.challenge.manifest().cases.clone() {
            prepared.answer(&id, make);
        }
        prepared.folder
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.rng)
    }

    fn answer(&mut self, id: &str, make: Make) {
        let sealed = self.bench.place().join("sealed").join(id);
        let truth: Truth =
            serde_json::from_str(&fs::read_to_string(sealed.join("truth.json")).unwrap()).unwrap();
        let readings = read_measurements(&sealed.join("true.csv")).unwrap().dataset;
        let folder = self.folder.join(id);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("predictions.csv"), self.predictions(&readings, truth.noise.sigma(), make))
            .unwrap();
        fs::write(folder.join("parameters.json"), self.parameters(&truth, make)).unwrap();
        fs::write(folder.join("diagnosis.json"), diagnosis(&truth, make.belief)).unwrap();
    }

    fn predictions(&mut self, readings: &Dataset, sigma: [f64; 6], make: Make) -> String {
        let [values, sigmas] = columns(readings.measurand);
        let mut table = format!("row,{}", values.join(","));
        if make.sigma {
            let _ = write!(table, ",{}", sigmas.join(","));
        }
        for (number, row) in (1..).zip(&readings.observations) {
            let _ = write!(table, "\n{number}");
            for k in 0..6 {
                let value = row.measured[k] + make.noise * sigma[k] * self.normal();
                let _ = write!(table, ",{}", in_its_unit(readings.measurand, k, value));
            }
            for s in sigma.iter().filter(|_| make.sigma) {
                let _ = write!(table, ",{}", make.widen * make.noise * s * 1e6);
            }
        }
        table
    }

    fn parameters(&mut self, truth: &Truth, make: Make) -> String {
        let number = |leg: usize, error: f64| {
            let k = truth.leg_stiffness_n_per_um[leg];
            let name = format!("leg-{}.stiffness", leg + 1);
            let (value, std) = (k * (1.0 + make.stiffness + error), k * make.stated * make.widen);
            serde_json::json!({"name": name, "value": value, "std": std, "unit": "N/um"})
        };
        let mut numbers: Vec<_> = (0..6).map(|leg| number(leg, make.random * self.normal())).collect();
        // The coefficient of an alpha in 1/K.
        let of_effect = |name: &str, true_value: f64, unit: &str| {
            let (value, std) =
                (true_value * (1.0 + make.stiffness), true_value.abs() * make.stated * make.widen);
            serde_json::json!({"name": name, "value": value, "std": std, "unit": unit})
        };
        if let Some(alpha) = truth.parameters.get("alpha").and_then(serde_json::Value::as_f64) {
            numbers.push(of_effect("thermal-expansion.coefficient", alpha * 1e6, "um/(m K)"));
        }
        serde_json::json!({"format": "parameters/1", "parameters": numbers}).to_string()
    }
}

fn in_its_unit(measurand: Measurand, k: usize, value: f64) -> f64 {
    match (measurand, k < 3) {
        (Measurand::AbsolutePose, true) => value * 1e3,
        (Measurand::AbsolutePose, false) => value.to_degrees(),
        _ => value * 1e6,
    }
}

/// The right verdict, and a probability for what is the case.
fn diagnosis(truth: &Truth, belief: f64) -> String {
    let outside = truth.effects.iter().any(|e| e.starts_with("out:"));
    let (verdict, first) = match truth.effects.first() {
        None => ("adequate", "none"),
        Some(_) if outside => ("outside", "outside"),
        Some(first) => ("named", first.as_str()),
    };
    let added = if verdict == "named" { truth.effects.clone() } else { Vec::new() };
    let candidates = serde_json::json!([
        {"term": first, "probability": belief}, {"term": "something-else", "probability": 1.0 - belief}]);
    serde_json::json!({"format": "diagnosis/1", "verdict": verdict, "added": added, "candidates": candidates})
        .to_string()
}

fn scored(bench: &Bench) -> EntrantScore {
    score(&bench.challenge, &[bench.answers()]).unwrap().entrants.remove(0)
}

/// Scores of an answer made from the truth.
fn made(cases: &str, make: Make) -> EntrantScore {
    let bench = Bench::of(cases);
    let prepared = Prepared::answers(&bench, make);
    bench.run_with(COPY, &prepared, RunLimits::default());
    scored(&bench)
}

#[test]
fn perfect_answers_score_perfectly() {
    let found = made(EVERY_SORT, PERFECT);
    let all = &found.all;
    assert_eq!((all.cases, all.answered, found.failures().count()), (5, 5, 0));
    assert!(all.stiffness_error.unwrap() < DIGITS && all.stiffness_z.unwrap() < DIGITS, "{all:?}");
    assert_eq!(all.stiffness_covered.map(|i| (i.hits, i.of)), Some((30, 30)));
    for case in &found.cases {
        let p = case.prediction.unwrap();
        assert!(p.error_in_noise < 1e-6 && p.rms_um < 1e-6 && p.rms_urad < 1e-5, "{}: {p:?}", case.id);
        assert!(
            (0.5..1.5).contains(&p.chi2_reduced),
            "{}: what is left of the readings is noise: {p:?}",
            case.id
        );
    }
    assert_eq!(all.outcomes, Some([5, 0, 0]));
    // Two cases hide two effects each: their probabilities are of something else.
    let log = all.log.unwrap();
    assert!(log.of >= 3 && log.mean.abs() < DIGITS && all.brier.unwrap().mean.abs() < DIGITS, "{log:?}");
    assert_eq!(all.predictions_covered, None);
}

#[test]
fn worse_answers_have_worse_scores_by_what_they_are_worse() {
    let worse = made(EVERY_SORT, Make { stiffness: 0.03, noise: 0.5, belief: 0.5, ..PERFECT });
    let f = &worse.all;
    assert!(
        (f.stiffness_error.unwrap() - 0.03).abs() < DIGITS && (f.stiffness_z.unwrap() - 3.0).abs() < 1e-6,
        "{f:?}"
    );
    assert_eq!(f.stiffness_covered.unwrap().hits, 0);
    assert!((f.error_in_noise.unwrap() - 0.5).abs() < 0.05, "{f:?}");
    assert!(
        (f.log.unwrap().mean - 2f64.ln()).abs() < DIGITS && (f.brier.unwrap().mean - 0.5).abs() < DIGITS,
        "{f:?}"
    );
    let worst = made(EVERY_SORT, Make { noise: 2.0, belief: 0.1, ..PERFECT });
    assert!((worst.all.error_in_noise.unwrap() / f.error_in_noise.unwrap() - 4.0).abs() < DIGITS);
    assert!(worst.all.chi2_reduced > f.chi2_reduced && worst.all.log.unwrap().mean > f.log.unwrap().mean);
    assert!(worst.all.brier.unwrap().mean > f.brier.unwrap().mean);
}

#[test]
fn honest_intervals_cover_what_they_say() {
    let cases = EVERY_SORT.replace("count = 1", "count = 4");
    let found = made(&cases, Make { random: 0.01, noise: 0.3, sigma: true, ..PERFECT }).all;
    for (what, interval) in
        [("stiffness", found.stiffness_covered), ("prediction", found.predictions_covered)]
    {
        let [low, high] = interval.unwrap().bounds;
        assert!((low..=high).contains(&0.95), "{what}: {interval:?}");
    }
    let z = found.stiffness_z.unwrap();
    assert!((0.8..1.2).contains(&z), "root mean square of 120 numbers: {z}");
}

#[test]
fn huge_uncertainties_hold_everything_and_do_not_win() {
    let cases = EVERY_SORT.replace("count = 1", "count = 4");
    let honest = Make { random: 0.01, noise: 0.3, sigma: true, ..PERFECT };
    let [own, wide, narrow] = [1.0, 1000.0, 0.1].map(|widen| made(&cases, Make { widen, ..honest }).all);
    let held = |f: &Figures| [f.stiffness_covered, f.predictions_covered].map(|i| i.map(|i| i.hits == i.of));
    assert_eq!(held(&wide), [Some(true), Some(true)], "huge intervals hold everything");
    for (what, of) in [
        ("stiffness, CRPS", (|f: &Figures| f.stiffness_crps) as fn(&Figures) -> Option<Mean>),
        ("stiffness, interval score", |f| f.stiffness_interval),
        ("predictions, CRPS", |f| f.predictions_crps),
        ("predictions, interval score", |f| f.predictions_interval),
    ] {
        let [own, wide, narrow] = [&own, &wide, &narrow].map(|f| of(f).unwrap().mean);
        assert!(own < wide && own < narrow, "{what}: {own}, too wide {wide}, too narrow {narrow}");
        assert!(wide > 100.0 * own, "{what}: {own}, too wide {wide}");
    }
}

#[test]
fn places_reward_neither_silence_nor_huge_uncertainties() {
    let cases = EVERY_SORT.replace("count = 1", "count = 3");
    let honest = Make { random: 0.01, noise: 0.3, sigma: true, ..PERFECT };
    let makes = [
        ("wide", Make { widen: 1000.0, ..honest }, ""),
        (
            "silent",
            honest,
            "case $(sed -n 's/^name = //p' \"$1/hexapod.toml\") in *[02468]\\\") exit 1 ;; esac;",
        ),
        ("honest", honest, ""),
        ("worse", Make { random: 0.03, noise: 0.9, stated: 0.03, ..honest }, ""),
    ];
    let bench = Bench::of(&cases);
    let folders: Vec<PathBuf> = makes
        .into_iter()
        .map(|(name, make, before)| answers_as(&bench, name, make, &format!("{before} {COPY}")))
        .collect();
    let scores = score(&bench.challenge, &folders).unwrap();
    let (disciplines, ranked) = places(&scores.entrants);
    assert_eq!(disciplines, ["leg stiffness", "predictions", "diagnoses", "probabilities"]);
    let order: Vec<&str> = ranked.iter().map(|p| scores.entrants[p.entrant].name.as_str()).collect();
    assert_eq!(order[0], "honest", "{ranked:?}");
    let silent = ranked.iter().find(|p| scores.entrants[p.entrant].name == "silent").unwrap();
    let (behind, [low, _]) = silent.behind.unwrap();
    assert!(scores.entrants[silent.entrant].all.answered < 15 && low > 0.0, "{behind}: silence does not pay");
    let places_of_all: f64 = ranked.iter().map(|p| p.all.mean).sum();
    assert!((places_of_all - 10.0).abs() < 1e-9, "1 + 2 + 3 + 4 are shared: {places_of_all}");
    let board = html(&leaderboard(&scores).unwrap()).unwrap();
    for wanted in
        ["Ranking", "Do probabilities mean what they say?", "Do intervals hold?", "By group of cases"]
    {
        assert!(board.contains(wanted), "{wanted} is not in {board}");
    }
}

#[test]
fn numbers_of_effects_are_scored_where_all_of_them_are_stated() {
    let of = |effects: &str| {
        let cases = "[cases.one]\nkind = \"single\"\ncount = 2\neffects = [\"EFFECTS\"]\nplan = \"few-poses\"\nmachine = \"ring_a\"\n";
        made(&cases.replace("EFFECTS", effects), Make { stiffness: 0.1, stated: 0.05, ..PERFECT })
    };
    let thermal = of("thermal-expansion");
    let crps = thermal.all.effects_crps.unwrap();
    // An error of a tenth, two stated uncertainties: 1.45279 of these by the closed form.
    assert!(crps.of == 2 && (crps.mean - 0.05 * 1.452_79).abs() < 1e-6, "{crps:?}");
    let leg = thermal.all.stiffness_crps.unwrap().mean;
    assert!((crps.mean - leg).abs() < 1e-6, "{crps:?}, legs {leg}");
    // The offset of the load is hidden too, and nobody states it.
    let both = of("thermal-expansion+load-offset");
    assert!(both.all.effects_crps.is_none() && both.all.stiffness_crps.is_some());
}

#[test]
fn what_is_not_said_is_not_scored() {
    let bench = Bench::of(ONE);
    let prepared = Prepared::answers(&bench, PERFECT);
    bench.run_with(&format!("{COPY}; rm \"$2\"/*.json"), &prepared, RunLimits::default());
    let scores = score(&bench.challenge, &[bench.answers()]).unwrap();
    let f = &scores.entrants[0].all;
    assert_eq!((f.stiffness_error, f.stiffness_covered, f.outcomes, f.log), (None, None, None, None));
    assert!(f.answered == 1 && f.error_in_noise.is_some());
    let text = markdown(&page(&scores));
    let line = text.lines().find(|l| l.contains("right / honest / wrong")).unwrap();
    assert!(line.trim_end().ends_with("- |"), "{line}");
}

#[test]
fn an_answer_that_cannot_be_read_is_a_failed_case_with_its_reason() {
    for (spoil, expected) in [
        (
            "echo '{' > \"$2/parameters.json\"",
            "parameters.json: line 2, column 0: not valid JSON: the file ends too early",
        ),
        (
            "sed -i s/0.5/NaN/ \"$2/diagnosis.json\"; echo '[1, NaN' > \"$2/diagnosis.json\"",
            "diagnosis.json: ",
        ),
        (
            "sed -i '2s/,[^,]*/,nan/' \"$2/predictions.csv\"",
            "predictions.csv: line 2, column 2 (da_um): \"nan\"",
        ),
        ("sed -i '$d' \"$2/predictions.csv\"", "1 of 10 rows are missing, the first is row 10"),
        (
            "printf '\\n11,1,2,3,4,5,6\\n' >> \"$2/predictions.csv\"",
            "\"11\" is no row of predict.csv; they are 1 to 10",
        ),
        ("printf '\\n10,1,2,3,4,5,6\\n' >> \"$2/predictions.csv\"", "row 10 is predicted twice"),
        ("head -c 3000 /dev/urandom > \"$2/predictions.csv\"", "predictions.csv"),
        (": > \"$2/predictions.csv\"", "predictions.csv: the file is empty"),
    ] {
        let bench = Bench::of(ONE);
        let prepared = Prepared::answers(&bench, PERFECT);
        bench.run_with(&format!("{COPY}; {spoil}"), &prepared, RunLimits::default());
        let found = scored(&bench);
        let failures: Vec<(&str, &str)> = found.failures().collect();
        assert!(failures.len() == 1 && failures[0].1.contains(expected), "{spoil}: {failures:?}");
        assert_eq!((found.all.answered, found.all.error_in_noise), (0, None));
    }
}

#[test]
fn a_case_that_was_not_run_or_answered_from_other_files_has_failed() {
    let bench = Bench::of(EVERY_SORT);
    let prepared = Prepared::answers(&bench, PERFECT);
    bench.run_with(COPY, &prepared, RunLimits::default());
    fs::remove_dir_all(bench.answers().join("cases/case-002")).unwrap();
    let record = bench.answers().join("cases/case-005/run.json");
    let text = fs::read_to_string(&record).unwrap();
    fs::write(&record, text.replace("\"case_sha256\": \"", "\"case_sha256\": \"0")).unwrap();
    let found = scored(&bench);
    let failures: Vec<(&str, &str)> = found.failures().collect();
    assert_eq!(failures.len(), 2, "{failures:?}");
    assert!(failures[0].0 == "case-002" && failures[0].1.starts_with("not answered"), "{failures:?}");
    assert!(failures[1].0 == "case-005" && failures[1].1.contains("other files"), "{failures:?}");
}

#[test]
fn nothing_is_scored_against_a_truth_that_changed() {
    let bench = Bench::of(ONE);
    let prepared = Prepared::answers(&bench, PERFECT);
    bench.run_with(COPY, &prepared, RunLimits::default());
    for (part, name, from, to) in [
        ("sealed", "truth.json", "\"clean\"", "\"dirty\""),
        ("sealed", "true.csv", ",1,", ",2,"),
        ("cases", "measurements.csv", ",1,", ",2,"),
    ] {
        let path = bench.place().join(part).join("case-001").join(name);
        let before = fs::read_to_string(&path).unwrap();
        let after = before.replacen(from, to, 1);
        assert_ne!(before, after, "{name}");
        fs::write(&path, after).unwrap();
        let error = score(&bench.challenge, &[bench.answers()]).unwrap_err();
        assert!(
            matches!(&error, ChallengeError::Tampered { .. }) && error.to_string().contains(name),
            "{error}"
        );
        fs::write(&path, before).unwrap();
    }
    score(&bench.challenge, &[bench.answers()]).unwrap();
}

#[test]
fn programs_stand_side_by_side_with_the_best_as_measure() {
    let bench = Bench::of(EVERY_SORT);
    let folders: Vec<PathBuf> = [("good", 0.1), ("middling", 0.2), ("bad", 0.8)]
        .into_iter()
        .map(|(name, noise)| {
            answers_as(&bench, name, Make { noise, stiffness: noise / 10.0, ..PERFECT }, COPY)
        })
        .collect();
    let scores = score(&bench.challenge, &folders).unwrap();
    let text = markdown(&page(&scores));
    let line = text.lines().find(|l| l.contains("predictions: times the best")).unwrap();
    assert!(line.contains("(5 cases)") && line.contains(" 1.0 "), "{line}");
    assert!(line.contains("2.0 (") && line.contains("8.0 ("), "{line}");
    let twice = score(&bench.challenge, &[folders[0].clone(), folders[0].clone()]);
    assert!(matches!(twice, Err(ChallengeError::SameName(_))));
}

/// Answers of one make, under a name and in a folder of their own.
fn answers_as(bench: &Bench, name: &str, make: Make, script: &str) -> PathBuf {
    let prepared = Prepared::answers(bench, make);
    bench.run_with(script, &prepared, RunLimits::default());
    let folder = bench.folder.path().join(name);
    fs::rename(bench.answers(), &folder).unwrap();
    rename(&folder, name);
    folder
}

fn rename(folder: &Path, name: &str) {
    let path = folder.join("answers.json");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(path, text.replace("\"name\": \"script\"", &format!("\"name\": \"{name}\""))).unwrap();
}
