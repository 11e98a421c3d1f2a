//! The bench: what a page is told about measurements, selections, games and files to take home.
#![allow(clippy::unwrap_used, reason = "a test without its case fails")]

use hexbench_core::Approach;
use hexbench_model::application::model_file::Model;
use hexbench_model::inference::selection::HeldOut;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::NextReport;
use hexbench_workbench::bench::cases::CASES;
use hexbench_workbench::bench::{LoadedCampaign, Refusal, RefusalKind, catalogue};
use hexbench_workbench::wire::{
    Ask, Export, FileText, GameLevel, Guess, KeepSession, MeasuringPace, Open, Opened, PlanReadings,
    PlannedReadings, ReadingChoice, Selection, ServerLimits, SessionForm, SessionStep, TermTrial, Try, View,
    VisibleSize, What,
};

const LIMITS: ServerLimits =
    ServerLimits { bytes: 1 << 25, rows: 2000, own_terms: 8, term_bytes: 1 << 16, benches: 16 };

/// What is taken home of a selection.
fn taken(what: What, selection: Selection) -> Export {
    Export { what, plan: ReadingChoice::default(), selection }
}

fn open(request: &Open) -> Result<LoadedCampaign, Refusal> {
    LoadedCampaign::open(request, None, &LIMITS)
}

fn case(id: &str) -> LoadedCampaign {
    open(&Open::Case { id: id.to_owned() }).unwrap()
}

fn ticked(terms: &[&str]) -> Selection {
    Selection { terms: terms.iter().map(|&t| t.to_owned()).collect(), ..Selection::default() }
}

fn held_out(view: &View) -> f64 {
    view.holdout.unwrap().chi2_reduced
}

#[test]
fn the_page_gets_the_terms_in_chapters_as_a_machine_is_built() {
    let page = catalogue(LIMITS, None);
    assert_eq!(page.chapters.first(), Some(&"Structure"));
    assert_eq!(page.chapters.last(), Some(&"Absolute poses"));
    for term in &page.terms {
        assert!(page.chapters.contains(&term.chapter), "{} would not be shown: {}", term.id, term.chapter);
    }
}

#[test]
fn every_bundled_case_opens_with_finite_numbers() {
    for known in &CASES {
        let opened = case(known.id).opened("x").unwrap();
        let text = serde_json::to_string(&opened).unwrap();
        assert!(opened.view.times_noise.is_finite() && opened.readings > 0, "{}", known.id);
        // JSON has no NaN: it becomes null, which only optional stiffnesses may be.
        let nulls = text
            .replace("\"nominal\":null", "")
            .replace("\"contains\":null", "")
            .replace("\"seed\":null", "");
        assert!(!nulls.contains("null") || !opened.view.not_determined.is_empty(), "{}: {nulls}", known.id);
        lists_agree(&opened);
    }
}

fn lists_agree(opened: &Opened) {
    let (c, v) = (&opened.conditions, &opened.view);
    let n = c.pose.len();
    let lengths = [c.wrench.len(), c.leg_force_n.len(), c.platform_joints_mm.len(), c.measured_motion.len()];
    assert!(lengths.iter().all(|&len| len == n), "{lengths:?} {n}");
    let of_view =
        [v.residual_um.len(), v.predicted.len(), v.predicted_motion.len(), v.scatter.extremes.len()];
    assert!(of_view.iter().all(|&len| len == n), "{of_view:?} {n}");
}

#[test]
fn ticking_the_missing_effects_brings_the_held_out_error_down_to_the_noise() {
    let bench = case("mujoco-foundation");
    let (before, after) =
        (bench.view(&ticked(&[])).unwrap(), bench.view(&ticked(&["base-compliance"])).unwrap());
    assert!(!before.at_the_noise && before.chance < after.chance, "{:?} {:?}", before.chance, after.chance);
    assert!(held_out(&after) < 0.7 * held_out(&before));
    let both = case("two-effects").view(&ticked(&["base-compliance", "load-offset"])).unwrap();
    assert!(both.at_the_noise && (both.times_noise - 1.0).abs() < 3.0 * both.band, "{}", both.times_noise);
    assert!(!both.by_tolerances, "{}", both.times_noise);
    let sizes: Vec<&str> = after.parameters.iter().map(|p| p.name.as_str()).collect();
    assert!(sizes.contains(&"base-compliance.rotation-x"), "{sizes:?}");
    assert!(after.legs.iter().all(|leg| leg.stiffness.is_some()));
}

fn tried(bench: &LoadedCampaign, each: &[&str], beside: &[&str]) -> Vec<TermTrial> {
    let each = each.iter().map(|&t| t.to_owned()).collect();
    bench.try_each(&Try { each, selection: ticked(beside) }).unwrap().trials
}

#[test]
fn terms_tried_are_sorted_and_only_what_gains_more_than_chance_is_marked() {
    let bench = case("mujoco-foundation");
    let each = ["creep", "joint-friction", "load-offset", "base-compliance", "bracket-compliance"];
    let first = tried(&bench, &each, &[]);
    assert!(first[0].term == "base-compliance" && first[0].better, "{first:?}");
    let alone = bench.view(&ticked(&["base-compliance"])).unwrap().times_noise;
    assert!((first[0].times_noise - alone).abs() < 1e-12, "{alone}");
    // Beside the effect that is there none of the others gains anything, at whatever multiple of the noise they stand.
    let second = tried(&bench, &each[..3], &["base-compliance"]);
    assert!(second.len() == 3 && second.iter().all(|trial| !trial.better), "{second:?}");
}

#[test]
fn the_number_has_its_band_and_is_judged_as_the_diagnosis_judges_it() {
    for known in &CASES {
        let bench = case(known.id);
        let diagnosis = bench.diagnose(&Ask::default()).unwrap().diagnosis;
        let (view, step) = (bench.view(&ticked(&[])).unwrap(), &diagnosis.steps[0]);
        assert_eq!((view.chance, view.at_the_noise), (step.chance, step.is_at_the_noise()), "{}", known.id);
        let numbers = view.holdout.unwrap_or(view.fitted).count as f64;
        assert!((view.band.powi(-2) - 2.0 * numbers).abs() < 1e-9 * numbers, "{}: {}", known.id, view.band);
    }
}

#[test]
fn every_reading_held_out_is_shown_beside_the_model() {
    let bench = case("mujoco-foundation");
    let lists = bench.opened("x").unwrap().held_out.unwrap();
    let view = bench.view(&ticked(&["base-compliance"])).unwrap();
    let held = view.held_out_readings.unwrap();
    let n = lists.pose.len();
    assert_eq!([held.residual_um.len(), held.predicted.len(), held.measured.len()], [n; 3]);
    let miss = |i: usize| held.measured[i][0] - held.predicted[i][0];
    let rms = ((0..n).map(|i| miss(i).powi(2)).sum::<f64>() / n as f64).sqrt();
    // Readings of a condition are averaged: what is left of them is no larger than what single readings leave.
    let single = view.holdout.unwrap().per_coordinate[0];
    assert!(rms > 0.3 * single && rms <= 1.001 * single, "{rms} {single}");
}

#[test]
fn an_effect_in_its_richer_form_is_the_same_guess() {
    let easy = |seed| open(&Open::Game { level: GameLevel::Easy, seed: Some(seed) }).unwrap();
    let bench = (0..100).map(easy).find(|bench| {
        let hidden = bench.reveal(&Guess { guess: Vec::new() }).unwrap().hidden;
        hidden.iter().all(|h| h.id == "creep")
    });
    let said =
        |id: &str| bench.as_ref().unwrap().reveal(&Guess { guess: vec![id.to_owned()] }).unwrap().right;
    assert!(said("creep") && said("creep:richer") && !said("load-offset:richer"));
}

#[test]
fn a_wrong_term_does_not() {
    let bench = case("mujoco-foundation");
    let (before, wrong) =
        (bench.view(&ticked(&[])).unwrap(), bench.view(&ticked(&["joint-friction"])).unwrap());
    assert!(held_out(&wrong) > 0.9 * held_out(&before), "{} {}", held_out(&wrong), held_out(&before));
}

#[test]
fn an_answer_depends_on_the_question_alone() {
    let bench = case("two-effects");
    let first = bench.view(&ticked(&["base-compliance", "load-offset"])).unwrap();
    bench.view(&ticked(&["creep"])).unwrap();
    let again = bench.view(&ticked(&["base-compliance", "load-offset"])).unwrap();
    let text = |v: &View| serde_json::to_string(&View { milliseconds: 0.0, ..v.clone() }).unwrap();
    assert_eq!(text(&first), text(&again));
}

#[test]
fn without_a_holdout_file_poses_are_left_out_in_turn() {
    let known = CASES[0];
    let text = |name: &str, text: &str| FileText { name: name.to_owned(), text: text.to_owned() };
    let request = Open::Files {
        hexapod: text("hexapod.toml", known.hexapod),
        data: text("measurements.csv", known.data),
        holdout: None,
    };
    let view = open(&request).unwrap().view(&ticked(&["base-compliance"])).unwrap();
    assert_eq!(view.held_out, HeldOut::PosesInTurn);
    assert!(held_out(&view) > view.fitted.chi2_reduced * 0.5);
}

#[test]
fn a_fault_in_a_file_is_told_with_its_place() {
    let known = CASES[0];
    let spoilt = known.data.replacen("fz_N", "fz_dyn", 1);
    let text = |name: &str, text: &str| FileText { name: name.to_owned(), text: text.to_owned() };
    let request = |data: &str| Open::Files {
        hexapod: text("hexapod.toml", known.hexapod),
        data: text("../../mine.csv", data),
        holdout: None,
    };
    let refusal = open(&request(&spoilt)).unwrap_err();
    assert_eq!(refusal.kind, RefusalKind::BadInput);
    assert!(refusal.message.starts_with("mine.csv: line 1, column 11"), "{}", refusal.message);
    assert!(!refusal.next.is_empty());
    let header = known.data.lines().next().unwrap();
    let row = known.data.lines().nth(1).unwrap().strip_prefix("1,1,").unwrap();
    let rows: Vec<String> = (0..=LIMITS.rows).map(|repeat| format!("1,{repeat},{row}")).collect();
    let long = format!("{header}\n{}\n", rows.join("\n"));
    assert_eq!(open(&request(&long)).unwrap_err().kind, RefusalKind::TooLarge);
}

#[test]
fn what_cannot_be_answered_is_refused_with_a_reason() {
    let bench = case("mujoco-foundation");
    let message = |terms: &[&str]| bench.view(&ticked(terms)).unwrap_err().message;
    assert!(message(&["base-complience"]).contains("did you mean `base-compliance`"));
    assert!(message(&["leg-offset"]).contains("cannot be fitted"));
    assert!(message(&["creep", "creep"]).contains("twice"));
    assert_eq!(bench.reveal(&Guess { guess: Vec::new() }).unwrap_err().kind, RefusalKind::Conflict);
    assert_eq!(open(&Open::Case { id: "../etc".to_owned() }).unwrap_err().kind, RefusalKind::Unknown);
    assert_eq!(open(&Open::Given {}).unwrap_err().kind, RefusalKind::Unknown);
    let untestable = bench.opened("x").unwrap().untestable;
    assert!(untestable.iter().any(|u| u.term == "leg-offset"), "{untestable:?}");
}

const OWN: &str = r#"
format = "term/1"
id = "softer-when-loaded"
title = "Legs soften with the force"
elongation = "size * (f*abs(f) - f0*abs(f0))"
[[parameters]]
name = "size"
unit = "nm/N"
scale = 1
"#;

#[test]
fn a_formula_of_ones_own_is_a_term_like_any_other() {
    let bench = case("contact");
    let own = |text: &str| Selection { own: vec![text.to_owned()], ..ticked(&["softer-when-loaded"]) };
    let (before, after) = (bench.view(&ticked(&[])).unwrap(), bench.view(&own(OWN)).unwrap());
    assert!(held_out(&after) < held_out(&before), "{} {}", held_out(&after), held_out(&before));
    let refusal = bench.view(&own(&OWN.replace("f0)", "f9)"))).unwrap_err();
    assert!(refusal.message.contains("`f9`"), "{}", refusal.message);
}

#[test]
fn a_simulation_is_the_same_for_the_same_seed() {
    let request = |seed| Open::Simulation {
        machine: "ring_b".to_owned(),
        plan: "few-poses".to_owned(),
        effects: vec!["creep".to_owned()],
        distance: Some(20.0),
        seed: Some(seed),
    };
    let csv = |seed| {
        let export = taken(What::Measurements, Selection::default());
        open(&request(seed)).unwrap().export(&export).unwrap().text
    };
    assert_eq!(csv(5), csv(5));
    assert_ne!(csv(5), csv(6));
    let opened = open(&request(5)).unwrap().opened("x").unwrap();
    assert_eq!(opened.contains.unwrap()[0].id, "creep");
    assert!(!opened.sealed);
}

#[test]
fn what_cannot_be_simulated_is_refused() {
    let request = |machine: &str, effects: &[&str], distance| Open::Simulation {
        machine: machine.to_owned(),
        plan: "paper".to_owned(),
        effects: effects.iter().map(|&e| e.to_owned()).collect(),
        distance,
        seed: Some(1),
    };
    let kind = |r: Open| open(&r).unwrap_err().kind;
    assert_eq!(kind(request("tripod", &[], None)), RefusalKind::Unknown);
    assert_eq!(kind(request("ring_a", &["gremlins"], None)), RefusalKind::Unknown);
    assert_eq!(kind(request("ring_a", &["creep", "creep"], None)), RefusalKind::BadInput);
    assert_eq!(kind(request("ring_a", &["creep"], Some(f64::NAN))), RefusalKind::BadInput);
    assert_eq!(kind(request("ring_a", &["creep"], Some(-1.0))), RefusalKind::BadInput);
}

#[test]
fn a_game_hides_its_truth_until_it_is_revealed() {
    for seed in 0..6 {
        let bench = open(&Open::Game { level: GameLevel::Honest, seed: Some(seed) }).unwrap();
        let opened = bench.opened("x").unwrap();
        assert!(opened.sealed && opened.contains.is_none());
        let truth = bench.reveal(&Guess { guess: vec!["nothing-of-the-kind".to_owned()] }).unwrap();
        assert!(!truth.right);
        let told = serde_json::to_string(&opened).unwrap();
        for hidden in &truth.hidden {
            // The list of terms that cannot be tested may name it only for lack of a column.
            assert!(!told.contains(&hidden.title), "{told}");
        }
        let guess = truth.hidden.iter().map(|h| h.id.clone());
        let guess = guess.map(|id| if id.starts_with("out:") { "outside".to_owned() } else { id }).collect();
        assert!(bench.reveal(&Guess { guess }).unwrap().right);
    }
}

#[test]
fn the_diagnosis_names_the_effect_and_the_files_can_be_taken_home() {
    let bench = case("mujoco-foundation");
    let answer = bench.diagnose(&Ask::default()).unwrap();
    assert_eq!(
        (answer.word, answer.diagnosis.added.as_slice()),
        (Verdict::Named, &["base-compliance".to_owned()][..])
    );
    let take = |what, terms: &[&str]| bench.export(&taken(what, ticked(terms))).unwrap();
    let model = Model::from_toml(&take(What::Model, &["base-compliance"]).text).unwrap();
    assert!(!model.is_absolute());
    let report = take(What::Report, &[]);
    assert!(report.text.starts_with("<!doctype html>") && report.text.contains("base-compliance"));
    let json: serde_json::Value = serde_json::from_str(&take(What::Diagnosis, &[]).text).unwrap();
    assert_eq!(json["format"], "diagnosis/1");
    assert_eq!(json["run"]["machine"], bench.opened("x").unwrap().title);
    assert_eq!(take(What::Hexapod, &[]).text, CASES[0].hexapod);
    assert_eq!(take(What::Holdout, &[]).text, CASES[0].holdout);
}

#[test]
fn the_story_is_one_picture_of_the_diagnosis_and_of_every_step() {
    let bench = case("mujoco-foundation");
    let of_diagnosis = bench.diagnose(&Ask::default()).unwrap().picture.unwrap();
    let of_step = |terms: &[&str]| bench.picture(&ticked(terms)).unwrap().picture.unwrap();
    let (named, springs) = (of_step(&["base-compliance"]), of_step(&[]));
    // The diagnosis fits with a prior over the size, the step without: what is left differs in its last digit.
    let before_left = |words: &[String]| words[0].split(", left").next().unwrap().to_owned();
    assert_eq!(
        before_left(&named.words),
        before_left(&of_diagnosis.words),
        "the step that the diagnosis names"
    );
    assert_eq!(named.words[1], of_diagnosis.words[1]);
    assert!(of_diagnosis.words[0].contains("left with the added effects"), "{:?}", of_diagnosis.words);
    assert!(of_diagnosis.words[1].contains("+ base-compliance"), "{:?}", of_diagnosis.words);
    assert!(!springs.words.concat().contains("left"), "{:?}", springs.words);
    let report = bench.export(&taken(What::Report, Selection::default())).unwrap().text;
    assert!(report.contains(&of_diagnosis.wide), "the report has the very same picture");
    for svg in [&of_diagnosis.wide, &of_diagnosis.narrow] {
        assert!(svg.contains("role=\"img\"") && !svg.contains("<title></title>") && !svg.contains("#FFFFFF"));
    }
    let error = bench.picture(&ticked(&["base-complience"])).map(|p| p.milliseconds).unwrap_err();
    assert!(error.message.contains("did you mean"), "{}", error.message);
}

#[test]
fn a_bending_foundation_needs_the_richer_form() {
    let request = Open::Simulation {
        machine: "ring_b".to_owned(),
        plan: "rich".to_owned(),
        effects: vec!["out:base-bending".to_owned()],
        distance: Some(60.0),
        seed: Some(3),
    };
    let bench = open(&request).unwrap();
    let error = |terms: &[&str]| held_out(&bench.view(&ticked(terms)).unwrap());
    let [springs, ideal, richer] =
        [error(&[]), error(&["base-compliance"]), error(&["base-compliance:richer"])];
    assert!(richer < ideal && ideal < springs, "{springs} {ideal} {richer}");
    assert!(bench.view(&ticked(&["base-compliance:richer"])).unwrap().at_the_noise, "{richer}");
    let diagnosed = bench.diagnose(&Ask::default()).unwrap();
    assert!(serde_json::to_string(&diagnosed.page).unwrap().contains("it is a full 6x6 compliance"));
    let found = diagnosed.diagnosis;
    assert_eq!(
        (found.added, &found.add[..]),
        (vec!["base-compliance".to_owned()], &["base-compliance:richer".to_owned()][..])
    );
    let of_diagnosis = found.steps.last().unwrap().holdout.unwrap().chi2_reduced;
    // Its priors are narrower than those of a fit that is asked for.
    let differ = (of_diagnosis - richer).abs() / (ideal - richer);
    assert!(
        differ < 0.02,
        "a fit of what is to be added is that of the diagnosis: {ideal} {richer} {of_diagnosis}"
    );
    assert_eq!(bench.discover(&Ask::default()).unwrap().beside, found.add);
    let refusal = bench.view(&ticked(&["load-tilt:richer"])).map(|v| v.times_noise).unwrap_err();
    assert!(refusal.message.contains("no richer form"), "{}", refusal.message);
}

fn kept(bench: &LoadedCampaign, form: SessionForm, selection: &Selection) -> String {
    let times_noise = bench.view(selection).unwrap().times_noise;
    let springs = SessionStep { selection: Selection::default(), times_noise: 1.5 };
    let steps = vec![springs, SessionStep { selection: selection.clone(), times_noise }];
    bench
        .keep(&KeepSession { form, steps, at: 1, notes: "warm day".to_owned(), foreseen: None })
        .unwrap()
        .text
}

#[test]
fn a_session_is_gone_on_with_beside_the_same_files_only() {
    let bench = case("mujoco-foundation");
    let without = Selection { exclude: vec![3, 4], ..ticked(&["base-compliance"]) };
    let file = |text: String| FileText { name: "session.json".to_owned(), text };
    let text = kept(&bench, SessionForm::File, &without);
    let resumed = bench.resume(&file(text.clone())).unwrap();
    assert_eq!((resumed.at, resumed.notes.as_str()), (1, "warm day"));
    assert_eq!(resumed.steps[1].selection, without);
    let refusal = case("mujoco-clean").resume(&file(text.clone())).unwrap_err();
    assert!(refusal.message.contains("is not the file"), "{}", refusal.message);
    let refusal = bench.resume(&file("pose,a_mm".to_owned())).unwrap_err();
    assert!(refusal.message.contains("not a session file"), "{}", refusal.message);
    let page = kept(&bench, SessionForm::Report, &without);
    assert!(
        page.contains("2 readings are left out of the fit, as requested: lines 3-4.")
            && page.contains("warm day")
    );
}

#[test]
fn readings_left_out_are_fitted_no_more_shown_all_the_same_and_recorded() {
    let bench = case("mujoco-foundation");
    let all = bench.view(&ticked(&["base-compliance"])).unwrap();
    let without = Selection { exclude: vec![3, 4], ..ticked(&["base-compliance"]) };
    let fewer = bench.view(&without).unwrap();
    assert_eq!(fewer.residual_um.len(), all.residual_um.len());
    assert!(fewer.fitted.count < all.fitted.count && fewer.legs != all.legs);
    let take = |what| bench.export(&taken(what, without.clone())).unwrap().text;
    assert_eq!(Model::from_toml(&take(What::Model)).unwrap().data.excluded, [3, 4]);
    let json: serde_json::Value = serde_json::from_str(&take(What::Diagnosis)).unwrap();
    assert_eq!(json["excluded"], serde_json::json!([3, 4]));
    assert!(take(What::Report).contains("without lines 3-4"));
    let lists = bench.opened("x").unwrap().conditions;
    assert!(lists.lines.iter().flatten().any(|&line| line == 3), "{:?}", lists.lines);
    let header = Selection { exclude: vec![1], ..Selection::default() };
    let refusal = bench.view(&header).map(|view| view.times_noise).unwrap_err();
    assert!(refusal.message.contains("line 1 contains no reading"), "{}", refusal.message);
}

#[test]
fn a_run_sheet_goes_to_the_machine_and_comes_back_below_the_readings() {
    let bench = case("paper-protocol");
    let diagnosis = bench.diagnose(&Ask::default()).unwrap().diagnosis;
    let take = |what| bench.export(&taken(what, Selection::default())).unwrap().text;
    let sheet = take(What::RunSheet);
    let rows: usize = diagnosis.next.iter().map(|reading| reading.repeats).sum();
    assert_eq!(sheet.lines().count(), 1 + rows, "{sheet}");
    assert!(sheet.lines().skip(1).all(|row| row.ends_with(",,,,,,")), "{sheet}");
    let is_short = |cell: &str| cell.len() <= "-119.6820".len() && !cell.contains('e');
    assert!(sheet.lines().skip(1).zip(1..).all(|(row, k)| row.starts_with(&format!("{k},"))), "{sheet}");
    assert!(sheet.lines().skip(1).flat_map(|row| row.split(',')).all(is_short), "{sheet}");
    assert!(take(What::RunSheetPage).contains("F (130, 0, -119.682) N"));
    let more = |text: &str| {
        let readings = FileText { name: "run-sheet.csv".to_owned(), text: text.to_owned() };
        open(&Open::More { base: Box::new(Open::Case { id: "paper-protocol".to_owned() }), readings })
    };
    let unread = sheet.replace(",,,,,,,", ",0,,,,,,");
    let filled = unread.replace(",,,,,,", ",1,2,3,4,5,6");
    let (before, after) = (bench.opened("x").unwrap(), more(&filled).unwrap().opened("x").unwrap());
    assert_eq!(after.readings, before.readings + rows);
    let lines = |opened: &Opened| opened.conditions.lines.concat();
    assert!(lines(&before).iter().all(|line| lines(&after).contains(line)), "every reading keeps its line");
    let refused = |text: &str| more(text).map(|bench| bench.bytes()).unwrap_err().message;
    assert!(refused(&sheet).contains("delta_T_K): the cell is empty"), "{}", refused(&sheet));
    assert!(refused(&unread).contains("nothing was read in this row"), "{}", refused(&unread));
    let lacking = filled.replace("elapsed_s", "note_1");
    assert!(refused(&lacking).contains("run-sheet.csv"), "{}", refused(&lacking));
    let none = taken(What::RunSheet, Selection::default());
    assert_eq!(
        case("mujoco-clean").export(&none).map(|file| file.text).unwrap_err().kind,
        RefusalKind::Conflict
    );
}

fn plan(
    bench: &LoadedCampaign,
    number: Option<usize>,
    repeats: &[usize],
) -> Result<PlannedReadings, Refusal> {
    let choice = ReadingChoice { number, repeats: repeats.to_vec() };
    bench.plan(&PlanReadings { choice, ..PlanReadings::default() })
}

/// The smaller of the expected logarithms of the first pair.
fn promised(plan: &PlannedReadings) -> f64 {
    plan.separation.first().map_or(0.0, |pair| pair.log10_bayes_factor[0].min(pair.log10_bayes_factor[1]))
}

#[test]
fn a_plan_promises_what_the_diagnosis_promises_more_with_more_readings_and_nothing_without() {
    let bench = case("paper-protocol");
    let asked = plan(&bench, None, &[]).unwrap();
    let told = bench.diagnose(&Ask::default()).unwrap().diagnosis;
    let text = |pairs: &_| serde_json::to_string(pairs).unwrap();
    assert_eq!(text(&asked.separation), text(&told.separation));
    let repeats: Vec<usize> = asked.next.iter().map(|reading| reading.repeats).collect();
    let same = plan(&bench, None, &repeats).unwrap();
    assert!(
        (promised(&same) / promised(&asked) - 1.0).abs() < 1e-6,
        "{} {}",
        promised(&same),
        promised(&asked)
    );
    let twice: Vec<usize> = repeats.iter().map(|n| 2 * n).collect();
    assert!(promised(&plan(&bench, None, &twice).unwrap()) > promised(&asked));
    let one_left_out: Vec<usize> =
        repeats.iter().enumerate().map(|(k, &n)| if k == 0 { 0 } else { n }).collect();
    let fewer = plan(&bench, None, &one_left_out).unwrap();
    assert!(promised(&fewer) < promised(&asked) && fewer.next.len() == asked.next.len());
    assert!(plan(&bench, None, &vec![0; repeats.len()]).unwrap().separation.is_empty());
    let many = plan(&bench, Some(9), &[]).unwrap();
    assert_eq!(many.next.iter().map(|reading| reading.repeats).sum::<usize>(), 9);
    assert_eq!(many.platform_joints_mm.len(), many.next.len());
    for (number, repeats) in [(Some(0), vec![]), (Some(1000), vec![]), (None, vec![1; 40]), (None, vec![99])]
    {
        assert_eq!(plan(&bench, number, &repeats).unwrap_err().kind, RefusalKind::BadInput);
    }
    let choice = ReadingChoice { number: None, repeats: one_left_out.clone() };
    let sheet = Export { what: What::RunSheet, plan: choice, selection: Selection::default() };
    let rows = bench.export(&sheet).unwrap().text.lines().count();
    assert_eq!(rows, 1 + one_left_out.iter().sum::<usize>(), "the run sheet is that of the plan");
}

#[test]
fn a_plan_takes_as_long_as_its_readings_fits_in_the_hours_there_are_and_shows_smaller_effects() {
    let bench = case("paper-protocol");
    let pace = MeasuringPace { reading_s: 40.0, load_change_s: 30.0, pose_change_s: 120.0 };
    let ask = |hours, number, repeats: &[usize]| {
        let choice = ReadingChoice { number, repeats: repeats.to_vec() };
        bench.plan(&PlanReadings { pace, hours, choice, ..PlanReadings::default() })
    };
    let readings = |plan: &PlannedReadings| plan.next.iter().map(|r| r.repeats).sum::<usize>();
    let nine = ask(None, Some(9), &[]).unwrap();
    let alone = |reading: &NextReport| {
        let changes = if reading.approach == Approach::Overloaded { 2.0 } else { 1.0 };
        reading.repeats as f64 * (changes * 30.0 + reading.elapsed_s + 40.0)
    };
    let sum = nine.next.iter().map(alone).sum::<f64>() + 120.0 * nine.poses as f64;
    assert!((nine.seconds - sum).abs() < 1e-9 && nine.poses > 0, "{} {sum}", nine.seconds);

    // As many as fit: in exactly the time of nine there are nine, in a little less fewer.
    let text = |plan: &PlannedReadings| serde_json::to_string(&plan.next).unwrap();
    let fitting = ask(Some(nine.seconds / 3600.0), None, &[]).unwrap();
    assert_eq!(text(&fitting), text(&nine));
    let fewer = ask(Some((nine.seconds - 1.0) / 3600.0), None, &[]).unwrap();
    assert!(readings(&fewer) < 9 && fewer.seconds < nine.seconds);
    assert_eq!(readings(&ask(Some(1000.0), None, &[]).unwrap()), 60, "never more than a plan may have");

    // Nothing shows worse with more readings, and without any the measurements show what they show.
    let none = ask(None, None, &vec![0; ask(None, None, &[]).unwrap().next.len()]).unwrap();
    assert!(none.seconds == 0.0 && none.visible.iter().all(|size| size.planned == size.now));
    let sizes = |size: &VisibleSize| size.now.zip(size.planned).map(|(now, planned)| planned / now);
    let ratios: Vec<f64> = nine.visible.iter().filter_map(sizes).collect();
    assert!(ratios.len() > 10 && ratios.iter().all(|r| *r < 1.0 + 1e-6), "{ratios:?}");
    assert!(ratios.iter().any(|r| *r < 0.5), "{ratios:?}");

    for (hours, number) in
        [(Some(0.001), None), (Some(-1.0), None), (Some(f64::NAN), None), (Some(1.0), Some(3))]
    {
        assert_eq!(ask(hours, number, &[]).unwrap_err().kind, RefusalKind::BadInput);
    }
    let never = PlanReadings { pace: MeasuringPace { reading_s: -1.0, ..pace }, ..PlanReadings::default() };
    assert_eq!(bench.plan(&never).unwrap_err().kind, RefusalKind::BadInput);
}

#[test]
fn readings_that_come_later_leave_those_that_were_there_in_their_lines() {
    let known = CASES[0];
    let text = |name: &str, text: &str| FileText { name: name.to_owned(), text: text.to_owned() };
    let (header, rows) = known.data.split_once('\n').unwrap();
    let base = Open::Files {
        hexapod: text("hexapod.toml", known.hexapod),
        data: text("mine.csv", &format!("# a comment\n{header}\n# another\n{rows}")),
        holdout: None,
    };
    let lines = |request: &Open| open(request).unwrap().opened("x").unwrap().conditions.lines.concat();
    let before = lines(&base);
    let last = *before.iter().max().unwrap();
    // Another last digit: the same numbers again would be a copy.
    let readings = text("more.csv", &format!("{header}\n{}7\n", rows.lines().next().unwrap()));
    let after = lines(&Open::More { base: Box::new(base), readings });
    assert_eq!((before[0], after.len()), (4, before.len() + 1));
    assert!(before.iter().all(|line| after.contains(line)) && after.contains(&(last + 1)), "{after:?}");
}

#[test]
fn what_residuals_follow_is_ranked_and_falls_with_the_effect() {
    let bench = case("friction");
    let springs = bench.followed(&Selection::default()).unwrap();
    assert!(springs.seen && (1..=3).contains(&springs.panels.len()), "{}", springs.panels.len());
    let first = &springs.panels[0];
    assert_eq!((first.association.variable, first.title), ("approach", "approach"));
    let shown = bench.opened("1").unwrap().conditions.pose.len();
    assert!(springs.panels.iter().all(|panel| panel.places.len() == shown));
    let leg = springs.panels.iter().find_map(|p| Some((p, p.association.leg?)));
    if let Some((panel, leg)) = leg {
        assert!(panel.places.iter().all(|six| (0..6).all(|k| k + 1 == leg || six[k].is_none())));
    }
    let without = Selection { exclude: vec![3, 4], ..ticked(&["joint-friction"]) };
    let found = bench.followed(&without).unwrap();
    let still = found.panels.iter().any(|panel| panel.association.variable == "approach");
    assert!(!still, "{:?}", found.panels.iter().map(|p| p.association.clone()).collect::<Vec<_>>());
}

/// Measurements with every deflection of the other sign.
fn reversed(text: &str) -> String {
    let (header, rows) = text.split_once('\n').unwrap();
    let is_read: Vec<bool> =
        header.split(',').map(|c| c.starts_with('d') && !c.starts_with("delta")).collect();
    let turned = |cell: &str| cell.strip_prefix('-').map_or_else(|| format!("-{cell}"), str::to_owned);
    let row = |row: &str| {
        let cells = row.split(',').zip(&is_read);
        cells.map(|(c, read)| if *read { turned(c) } else { c.to_owned() }).collect::<Vec<_>>().join(",")
    };
    let rows: Vec<String> = rows.lines().map(row).collect();
    format!("{header}\n{}\n", rows.join("\n"))
}

#[test]
fn of_absolute_poses_the_added_effects_leave_the_noise_in_the_picture_as_in_the_verdict() {
    let answer = case("absolute-pitch").diagnose(&Ask::default()).unwrap();
    let words = answer.picture.unwrap().words.remove(0);
    let um = |name: &str| -> f64 {
        let behind = words.split(name).nth(1).unwrap_or_else(|| panic!("{name} in {words}"));
        behind.split_whitespace().next().unwrap().parse().unwrap()
    };
    let [missed, left, noise] =
        ["the springs miss ", "left with the added effects ", "noise of this joint "].map(um);
    assert!(left < 4.0 * noise && missed > 20.0 * noise, "{words}");
    assert_eq!(
        case("mujoco-clean").diagnose(&Ask::default()).unwrap().picture,
        None,
        "springs are sufficient"
    );
}

#[test]
fn a_misread_file_has_its_picture_and_is_read_as_its_finding_says() {
    let known = CASES.iter().find(|c| c.id == "mujoco-foundation").unwrap();
    let file = |name: &str, text: String| FileText { name: name.to_owned(), text };
    let written = Open::Files {
        hexapod: file("hexapod.toml", known.hexapod.to_owned()),
        data: file("measurements.csv", reversed(known.data)),
        holdout: Some(file("holdout.csv", reversed(known.holdout))),
    };
    let as_written = open(&written).unwrap().diagnose(&Ask::default()).unwrap();
    assert_eq!(as_written.word, Verdict::Measurement);
    assert_eq!(as_written.picture.map(|p| p.title).as_deref(), Some("The machine under load"));
    let way = vec!["deflection-sign=reversed".to_owned()];
    assert!(as_written.ways.contains(&way), "{:?}", as_written.ways);
    let checked = open(&written).unwrap().check(&Ask::default()).unwrap();
    assert!(!checked.ready && checked.ways.contains(&way), "{:?}", checked.ways);
    assert_eq!(checked.sections[0].id, "findings");

    let bench = open(&Open::ReadAs { base: Box::new(written.clone()), changes: way.clone() }).unwrap();
    let opened = bench.opened("x").unwrap();
    assert_eq!(opened.read_as, way);
    assert!(opened.about.iter().any(|line| line.contains(&way[0])), "{:?}", opened.about);
    let found = bench.diagnose(&Ask::default()).unwrap();
    assert_eq!((found.word, found.diagnosis.add), (Verdict::Named, vec!["base-compliance".to_owned()]));
    assert_eq!(found.diagnosis.read_as, way);
    assert!(found.ways.is_empty());
    let checked = bench.check(&Ask::default()).unwrap();
    assert!(checked.ready && checked.ways.is_empty(), "{:?}", checked.sections);
    let sound = case("mujoco-foundation").view(&ticked(&["base-compliance"])).unwrap();
    let here = bench.view(&ticked(&["base-compliance"])).unwrap();
    assert!((here.times_noise / sound.times_noise - 1.0).abs() < 1e-9, "{}", here.times_noise);
    let take = |what| bench.export(&taken(what, ticked(&["base-compliance"]))).unwrap().text;
    assert_eq!(Model::from_toml(&take(What::Model)).unwrap().data.read_as, way);
    for what in [What::Report, What::Diagnosis] {
        assert!(take(what).contains(&way[0]), "{what:?} does not say how the files were read");
    }
    assert_eq!(take(What::Measurements), reversed(known.data), "the files stay as they are");

    let unread =
        open(&Open::ReadAs { base: Box::new(written.clone()), changes: vec!["shape=round".to_owned()] });
    assert_eq!(unread.unwrap_err().kind, RefusalKind::BadInput);
    let text = kept(&bench, SessionForm::File, &ticked(&["base-compliance"]));
    let session = FileText { name: "session.json".to_owned(), text };
    let as_written = open(&written).unwrap();
    for here in [&bench, &as_written] {
        assert_eq!(here.resume(&session).unwrap().read_as, way, "the session says how it reads the files");
    }
}

#[test]
fn the_largest_residual_of_a_condition_is_that_of_its_readings_that_count() {
    let bench = case("mujoco-foundation");
    let opened = bench.opened("x").unwrap();
    let ends = opened.view.scatter.quantiles.iter().map(|point| point[1].abs());
    let most = opened.view.scatter.extremes.iter().map(|value| value.unwrap().abs()).fold(0.0, f64::max);
    assert_eq!(
        Some(most),
        ends.max_by(f64::total_cmp),
        "the farthest of all is the farthest of its condition"
    );
    let selection = Selection { exclude: opened.conditions.lines[3].clone(), ..Selection::default() };
    let without = bench.view(&selection).unwrap().scatter.extremes;
    assert_eq!(without.iter().position(Option::is_none), Some(3));
    assert_eq!(without.iter().filter(|value| value.is_none()).count(), 1);
}
