//! Campaign books: how often a sound one alarms, how often a real change is noticed, and that it is named.

use hexbench_core::streams::{Purpose, stream};
use hexbench_model::estimation::estimate::Estimate;
use hexbench_model::estimation::noise::NoiseSource;
use hexbench_model::estimation::parameters::stiffness_name;
use hexbench_model::estimation::residuals::{ErrorSummary, Rms};
use hexbench_model::results::book::{
    CampaignBook, CampaignDay, ChangeKind, ChartSubject, DatedRun, FALSE_ALARM, book,
};
use hexbench_model::results::runs::{Incompatible, Run, RunStep};
use rand_distr::{ChiSquared, Distribution, StandardNormal};

const CAMPAIGNS: usize = 12;
const STIFFNESS: f64 = 4.0;
/// N/um; other campaigns have other uncertainties.
const STD: [f64; 3] = [0.03, 0.05, 0.04];
const HELD_OUT: usize = 180;
/// Standard deviations of a binomial count that chance is allowed.
const CHANCE: f64 = 3.0;

/// One result of a machine that does not change: six stiffnesses, two numbers of an effect, the held-out error.
fn run(k: usize, random: &mut impl rand::Rng) -> Run {
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    let std = STD[k % STD.len()];
    let mut parameters: Vec<Estimate> = (0..6)
        .map(|leg| Estimate {
            name: stiffness_name(leg),
            value: STIFFNESS + leg as f64 + std * normal(),
            std,
            unit: "N/um".to_owned(),
        })
        .collect();
    for (axis, value) in [("x", 1.2), ("y", 1.5)] {
        let name = format!("base-compliance.rotation-{axis}");
        parameters.push(Estimate {
            name,
            value: value + 0.1 * normal(),
            std: 0.1,
            unit: "nrad/(N m)".to_owned(),
        });
    }
    let chi2: f64 = ChiSquared::new(HELD_OUT as f64).unwrap().sample(random);
    let rms = Rms { translation_um: Some(0.5), rotation_urad: Some(3.0) };
    let chi2_reduced = 1.1 * chi2 / HELD_OUT as f64;
    let error = ErrorSummary { chi2_reduced, rms, per_coordinate: [1.0; 6], count: HELD_OUT };
    let terms = vec!["base-compliance".to_owned()];
    Run {
        file: format!("{k}.json"),
        format: "fit/1".into(),
        verdict: None,
        added: terms.clone(),
        probabilities: [].into(),
        steps: vec![RunStep { terms, fitted: error, holdout: Some(error) }],
        noise_translation_um: Some(0.5),
        noise_rotation_urad: Some(3.0),
        noise_source: NoiseSource::Metrology,
        noise_dof: None,
        parameters,
        origin: None,
        excluded: Vec::new(),
        keep_all: false,
        read_as: Vec::new(),
    }
}

/// Campaigns of a sound machine.
fn sound(index: u64, campaigns: usize) -> Vec<Run> {
    let mut random = stream(77, Purpose::Test, [index]);
    (0..campaigns).map(|k| run(k, &mut random)).collect()
}

fn booked(runs: Vec<Run>) -> CampaignBook {
    book(runs.into_iter().map(|run| DatedRun { run, day: None }).collect()).unwrap()
}

/// Leg 3 changed by `by(campaign)`, N/um.
fn changed(index: u64, by: impl Fn(usize) -> f64) -> CampaignBook {
    let mut runs = sound(index, CAMPAIGNS);
    runs.iter_mut().enumerate().for_each(|(k, run)| run.parameters[2].value += by(k + 1));
    booked(runs)
}

/// What is said of leg 3, when it is the only chart that alarms.
fn of_leg_3(book: &CampaignBook) -> Option<(ChangeKind, [usize; 2], f64)> {
    let leg = book.charts.iter().find(|c| c.name == stiffness_name(2))?;
    leg.changes.first().map(|c| (c.kind, c.between, c.size))
}

fn spread(p: f64, n: usize) -> f64 {
    (p * (1.0 - p) / n as f64).sqrt()
}

#[test]
fn a_sound_machine_alarms_as_seldom_as_said() {
    const BOOKS: usize = 4000;
    for campaigns in [3, 6, CAMPAIGNS] {
        let alarmed = (0..BOOKS).filter(|k| booked(sound(*k as u64, campaigns)).is_alarmed()).count();
        let share = alarmed as f64 / BOOKS as f64;
        println!("{campaigns} campaigns: {:.2} % of sound books alarm", 1e2 * share);
        assert!(share <= FALSE_ALARM + CHANCE * spread(FALSE_ALARM, BOOKS), "{campaigns} campaigns: {share}");
        assert!(share > 0.2 * FALSE_ALARM, "{campaigns} campaigns: {share}, so strict a rule is blind");
    }
}

#[test]
fn a_sound_machine_that_is_looked_at_after_every_campaign_alarms_seldom_too() {
    const MACHINES: usize = 1000;
    const MONTHS: usize = 24;
    let ever = |k: usize| {
        let runs = sound(1_000_000 + k as u64, MONTHS);
        (3..=MONTHS).any(|n| booked(runs[..n].to_vec()).is_alarmed())
    };
    let share = (0..MACHINES).filter(|k| ever(*k)).count() as f64 / MACHINES as f64;
    println!("looked at 22 times: {:.1} % ever alarm", 1e2 * share);
    assert!(share < 0.06, "{share}");
}

#[test]
fn a_change_of_the_stated_size_is_noticed_as_often_as_said() {
    const BOOKS: usize = 600;
    const SAID: f64 = 0.9;
    let chart = booked(sound(0, CAMPAIGNS)).charts.swap_remove(2);
    for (what, size, from) in [("new", chart.visible.last, CAMPAIGNS), ("lasting", chart.visible.lasting, 7)]
    {
        for sign in [1.0, -1.0] {
            let by = |k: usize| if k >= from { sign * size } else { 0.0 };
            let found: Vec<_> = (0..BOOKS).filter_map(|k| of_leg_3(&changed(k as u64, by))).collect();
            let share = found.len() as f64 / BOOKS as f64;
            println!("{what}, {:+.3} N/um: noticed {:.1} %", sign * size, 1e2 * share);
            assert!((share - SAID).abs() < 0.04 + CHANCE * spread(SAID, BOOKS), "{what}: {share}");
            let right = found.iter().filter(|f| f.2 * sign > 0.0).count() as f64 / found.len() as f64;
            assert!(right > 0.99, "{what}: {right} of the changes found have the right sign");
        }
    }
}

#[test]
fn a_clear_change_is_named_with_its_campaign() {
    const BOOKS: u64 = 200;
    let named = |by: fn(usize) -> f64, kind: ChangeKind, campaign: usize| {
        let is_it = |k: &u64| {
            of_leg_3(&changed(*k, by))
                .is_some_and(|(found, [a, b], _)| found == kind && (a..=b).contains(&campaign))
        };
        (0..BOOKS).filter(is_it).count() as f64 / BOOKS as f64
    };
    let step = named(|k| if k >= 7 { -0.25 } else { 0.0 }, ChangeKind::Step, 7);
    let alone = named(|k| if k == 5 { -0.4 } else { 0.0 }, ChangeKind::Alone, 5);
    let drift = named(|k| -0.05 * k as f64, ChangeKind::Drift, 1);
    println!("named with the right campaign: step {step}, alone {alone}, drift {drift}");
    assert!(step > 0.9 && alone > 0.9 && drift > 0.9, "{step} {alone} {drift}");
}

#[test]
fn two_changes_of_a_leg_are_both_told() {
    let two = changed(3, |k| {
        if k == 3 {
            0.8
        } else if k >= 9 {
            -0.5
        } else {
            0.0
        }
    });
    let leg = &two.charts[2];
    let told: Vec<_> = leg.changes.iter().map(|c| (c.kind, c.campaign)).collect();
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told.contains(&(ChangeKind::Alone, 3)) && told.contains(&(ChangeKind::Step, 9)), "{told:?}");
    assert_eq!(leg.scatter, None);
    let alarmed: Vec<usize> = leg.points.iter().filter(|p| p.alarm).map(|p| p.campaign).collect();
    assert_eq!(alarmed, [3, 9, 10, 11, 12]);
}

#[test]
fn uncertainties_that_are_too_small_are_told_as_scatter() {
    let mut runs = sound(5, CAMPAIGNS);
    runs.iter_mut().enumerate().for_each(|(k, run)| {
        let jump = 0.3 * [1.0, -1.0, -0.7, 0.9, -1.2, 0.8][k % 6];
        run.parameters[2].value += jump;
    });
    let book = booked(runs);
    let leg = &book.charts[2];
    assert!(leg.scatter.is_some_and(|s| s > 3.0) && leg.changes.is_empty(), "{leg:?}");
    assert!(book.charts.iter().filter(|c| c.name != leg.name).all(|c| !c.is_alarmed()));
}

#[test]
fn dates_order_the_campaigns_and_place_them() {
    let day = |text: &str| Some(text.parse::<CampaignDay>().unwrap());
    let days = ["2026-03-01", "2026-01-01", "2026-02-01"].map(day);
    let dated: Vec<DatedRun> =
        sound(1, 3).into_iter().zip(days).map(|(run, day)| DatedRun { run, day }).collect();
    let found = book(dated.clone()).unwrap();
    let files: Vec<_> = found.campaigns.iter().map(|c| (c.file.as_str(), format!("{}", c.place))).collect();
    assert_eq!(
        files,
        [("1.json", "0"), ("2.json", "31"), ("0.json", "59")].map(|(file, days)| (file, days.to_owned()))
    );
    assert!(found.is_dated());
    let mut one_without = dated;
    one_without[1].day = None;
    let found = book(one_without).unwrap();
    assert!(!found.is_dated() && found.warnings[0].starts_with("Some campaigns have no date"));
    assert!((found.campaigns[0].place - 1.0).abs() < 1e-12);
}

#[test]
fn charts_have_what_enough_campaigns_have() {
    let mut runs = sound(2, 4);
    runs[0].parameters.retain(|p| p.name != stiffness_name(4));
    runs[1].parameters.truncate(6);
    runs[2].parameters.truncate(6);
    runs[1].steps[0].terms.clear();
    let book = booked(runs);
    let of = |about: ChartSubject| book.charts.iter().filter(|c| c.about == about).count();
    assert_eq!([of(ChartSubject::Stiffness), of(ChartSubject::Effect), of(ChartSubject::Error)], [6, 0, 1]);
    assert_eq!(book.charts[4].points.len(), 3);
    assert!(
        book.warnings[0].starts_with("Campaign 2: the fitted model has other terms"),
        "{:?}",
        book.warnings
    );
}

#[test]
fn too_few_results_are_refused() {
    let two = sound(0, 2).into_iter().map(|run| DatedRun { run, day: None }).collect();
    assert!(matches!(book(two), Err(Incompatible::Few { campaigns: 2, fewest: 3 })));
}
