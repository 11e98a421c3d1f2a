//! A user's own term: equal to a catalogue term it gives the same fit; hostile files are refused in words.

use std::sync::Arc;

use hexbench_core::Vector6;
use hexbench_model::effects::chain::Action;
use hexbench_model::effects::term::Term;
use hexbench_model::effects::user_term::{UserTermError, parse};
use hexbench_model::estimation::fit::{TermSpec, fit};
use hexbench_model::results::diagnose::{diagnose, prepare};
use hexbench_model::terms::catalogue;

use crate::cases;

const BRACKET: &str = r#"
format = "term/1"
id = "my-brackets"
title = "Mounts yield sideways"
elongation = "size*(nx^2 + ny^2)*df"
parameters = [{ name = "size", unit = "nm/N", scale = 50, positive = true }]
"#;

const TENSION: &str = r#"
format = "term/1"
id = "my-tension"
title = "Legs are softer when they pull"
elongation = "size*(max(f, 0) - max(f0, 0))"
parameters = [{ name = "size", unit = "nm/N", scale = 50 }]
"#;

fn wanted(term: &Arc<dyn Term>, shape: f64, prior: f64) -> TermSpec {
    let prior = vec![prior; term.info().parameters.len()];
    TermSpec { term: Arc::clone(term), rich: false, shape, prior }
}

fn catalogue_term(id: &str) -> Arc<dyn Term> {
    catalogue().into_iter().find(|t| t.info().id == id).unwrap()
}

fn same_fit(own: &str, id: &str, shape: f64, case: &str) {
    let (hexapod, data, _) = cases::case(case);
    let campaign = prepare(&hexapod, &data).unwrap();
    let of = |term: &Arc<dyn Term>| fit(&campaign, &[wanted(term, shape, 1.0)], None).unwrap();
    let (own, theirs) = (of(&parse(own).unwrap()), of(&catalogue_term(id)));
    assert!((own.chi2 / theirs.chi2 - 1.0).abs() < 1e-9, "{} {}", own.chi2, theirs.chi2);
    for (a, b) in own.point.active[0].values.iter().zip(&theirs.point.active[0].values) {
        assert!((a / b - 1.0).abs() < 1e-5, "{a} {b}");
    }
}

#[test]
fn a_user_term_equal_to_a_catalogue_term_gives_the_same_fit() {
    same_fit(TENSION, "leg-asymmetry", 1.0, "mujoco-foundation");
    let tilt = r#"
        format = "term/1"
        id = "my-nonlinearity"
        title = "Hertz"
        elongation = "size*(sign(f)*(abs(f)/100)^p - sign(f0)*(abs(f0)/100)^p)"
        parameters = [{ name = "size", unit = "um", scale = 5 }]
        shape = { name = "p", unit = "1", bounds = [0.4, 0.9], grid = [0.5, 0.6667, 0.8] }
    "#;
    same_fit(tilt, "leg-nonlinearity", 2.0 / 3.0, "contact");
}

#[test]
fn a_wrench_formula_acts_like_the_same_wrench() {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    let campaign = prepare(&hexapod, &data).unwrap();
    let own = parse(
        r#"
        format = "term/1"
        id = "lost-force"
        title = "A share of the vertical force never arrives"
        wrench = ["", "", "share*(fz - ref_fz)", "", "", ""]
        parameters = [{ name = "share", unit = "%", scale = 5 }]
    "#,
    )
    .unwrap();
    let lin = hexbench_model::estimation::linearization::Linearization::at(
        &campaign,
        &hexbench_model::estimation::fit::fit_baseline(&campaign).unwrap().point,
    )
    .unwrap();
    let mut out = Vec::new();
    for c in &lin.conditions {
        out.clear();
        own.actions(&lin.machine, c, 1.0, &mut out);
        let change = c.wrench.force.z - c.reference.force.z;
        assert_eq!(out, vec![Action::Wrench(hexbench_core::Vector6::ith(2, change))]);
    }
}

#[test]
fn a_user_term_wins_the_diagnosis_of_an_effect_outside_the_catalogue() {
    let (hexapod, data, holdout) = cases::case("not-in-catalogue");
    let own = parse(
        r#"
        format = "term/1"
        id = "nut-wobble"
        title = "Compliance of the legs repeats with their length"
        elongation = "(s*sin(tau*q/period) + c1*cos(tau*q/period))*df"
        parameters = [
            { name = "s", unit = "nm/N", scale = 30 },
            { name = "c1", unit = "nm/N", scale = 30 },
        ]
        shape = { name = "period", unit = "mm", bounds = [4, 16], grid = [6, 6.5, 7, 7.5, 7.75, 8, 8.25, 8.5, 9, 10] }
    "#,
    )
    .unwrap();
    let mut terms = catalogue();
    terms.push(own);
    let study = diagnose(&hexapod, &data, Some(&holdout), &terms).unwrap();
    assert_eq!(study.diagnosis.added, ["nut-wobble"], "{:?}", study.diagnosis.present);
    let last = study.diagnosis.steps.last().unwrap().holdout.unwrap();
    assert!(last.chi2_reduced < 1.4, "held-out chi-square {}", last.chi2_reduced);
}

#[test]
fn a_formula_without_value_at_a_reading_names_line_and_variables() {
    let text = BRACKET.replace("size*(nx^2 + ny^2)*df", "size*df/(elapsed - 76.907)");
    let term = parse(&text).unwrap();
    let (hexapod, data, _) = cases::case("contact");
    let campaign = prepare(&hexapod, &data).unwrap();
    let point = hexbench_model::estimation::fit::fit_baseline(&campaign).unwrap().point;
    let lin = hexbench_model::estimation::linearization::Linearization::at(&campaign, &point).unwrap();
    let why = hexbench_model::effects::untestable::why_untestable(term.as_ref(), &campaign, &lin)
        .unwrap()
        .to_string();
    assert!(
        why.starts_with("line 2: `size*df/(elapsed - 76.907)` gives") && why.contains("elapsed = 76.907"),
        "{why}"
    );
}

#[test]
fn a_term_has_at_most_36_parameters() {
    let text = |count: usize| {
        let sum: Vec<String> = (0..count).map(|k| format!("s{k}*df^{}", k + 1)).collect();
        let head = format!(
            "format = \"term/1\"\nid = \"many\"\ntitle = \"Many\"\nelongation = \"{}\"\n",
            sum.join(" + ")
        );
        let own =
            |k: usize| format!("[[parameters]]\nname = \"s{k}\"\nunit = \"um\"\nscale = 1e-{}\n", 3 * k);
        (0..count).map(own).fold(head, |all, own| all + &own)
    };
    let refused = |count: usize| parse(&text(count)).err().map(|why| why.to_string()).unwrap_or_default();
    assert!(refused(37).contains("at most 36"), "{}", refused(37));
    assert!(!refused(36).contains("at most 36"), "{}", refused(36));
}

#[test]
fn hostile_term_files_are_refused_in_words() {
    let formula = |f: &str| BRACKET.replace("size*(nx^2 + ny^2)*df", f);
    let swap = |a: &str, b: &str| BRACKET.replace(a, b);
    let table = [
        (formula(&"(".repeat(100_000)), "100000 characters"),
        (formula(&"-".repeat(1_990)), "nested deeper"),
        (formula("size*forse"), "not a known variable"),
        (formula(""), "empty"),
        (formula("size*df/0"), "no finite value"),
        (formula("size*df*1e308*1e308"), "no finite value"),
        (formula("size*1e999"), "not a number"),
        (formula("size*sin(2*pi*q/8)*df"), "the argument of sin is a length"),
        (formula("size*max(q - 200, 0)*df"), "200 is combined with a length but has no unit"),
        (formula("size*df*(q + f)"), "m and N cannot be added"),
        (BRACKET.replace("parameters =", "legs = [1, 7]\nparameters ="), "different leg numbers from 1 to 6"),
        (
            BRACKET.replace(
                "elongation = \"",
                "wrench = [\"0\", \"\", \"\", \"\", \"\", \"\"]\nelongation = \"",
            ),
            "cannot stand together",
        ),
        (formula("size^2*df"), "not linear in `size`"),
        (formula("abs(size)*df"), "not linear in `size`"),
        (formula("size*df + 1e-6"), "not linear in `size`"),
        (formula("sin(size*df)"), "not linear in `size`"),
        (formula("df"), "appears in no formula"),
        (swap("my-brackets", "base-compliance"), "catalogue"),
        (swap("my-brackets", "My Brackets"), "kebab-case"),
        (swap("scale = 50", "scale = -1"), "positive number"),
        (swap("scale = 50", "scale = nan"), "positive number"),
        (swap("parameters =", "prior = 0\nparameters ="), "above 0, at most 1"),
        (swap("parameters =", "prior = 1.5\nparameters ="), "above 0, at most 1"),
        (swap("parameters =", "prior = nan\nparameters ="), "above 0, at most 1"),
        (swap("nm/N", "furlong"), "per_si"),
        (swap("name = \"size\"", "name = \"df\""), "is a variable of formulas: f - f0, N"),
        (swap("title", "titel"), "unknown key"),
        (swap("term/1", "term/2"), "term/1"),
        (swap("elongation =", "wrench ="), "expected a list of 6"),
        (String::new(), "` is missing"),
        ("\u{0}\u{feff}[[[".to_owned(), ""),
        ("[".repeat(100_000), ""),
    ];
    for (text, part) in table {
        let error =
            parse(&text).err().unwrap_or_else(|| panic!("accepted: {}", &text[..text.len().min(300)]));
        assert!(error.to_string().contains(part), "{error}");
    }
    assert!(matches!(parse(&formula("size*df/0")), Err(UserTermError::NoValue { .. })));
}

fn actions_of(text: &str) -> Vec<(hexbench_model::estimation::campaign::Condition, Vec<Action>)> {
    let (hexapod, data, _) = cases::case("contact");
    let campaign = prepare(&hexapod, &data).unwrap();
    let point = hexbench_model::estimation::fit::fit_baseline(&campaign).unwrap().point;
    let lin = hexbench_model::estimation::linearization::Linearization::at(&campaign, &point).unwrap();
    let term = parse(text).unwrap();
    let of = |c: &hexbench_model::estimation::campaign::Condition| {
        let mut out = Vec::new();
        term.actions(&lin.machine, c, 1.0, &mut out);
        (c.clone(), out)
    };
    lin.conditions.iter().map(of).collect()
}

#[test]
fn laws_of_one_file_add_up_each_in_its_legs() {
    let text = r#"
        format = "term/1"
        id = "two-laws"
        title = "Legs 1 and 4 yield, and leg 2 under its neighbor"
        [[laws]]
        elongation = "size*df/k_i*(4 N/um)"
        legs = [1, 4]
        [[laws]]
        elongation = "size*df_next/(1 + elapsed/(2 min)) + own*c_i*f_3"
        legs = [2]
        [[parameters]]
        name = "size"
        unit = "nm/N"
        scale = 20
        [[parameters]]
        name = "own"
        unit = "1"
        scale = 0.1
    "#
    .replace("*(4 N/um)", "*4e6");
    for (at, actions) in actions_of(&text) {
        let df = at.force_change();
        let leg_2 = df[2] / (1.0 + at.elapsed / 120.0);
        let soft = |leg: usize| df[leg] * at.compliances[leg] * 4e6;
        let first = Vector6::new(soft(0), leg_2, 0.0, soft(3), 0.0, 0.0);
        let second = Vector6::new(0.0, at.compliances[1] * at.force[2], 0.0, 0.0, 0.0, 0.0);
        for (action, expected) in actions.iter().zip([first, second]) {
            let Action::Elongation(e) = action else { panic!("{action:?}") };
            assert!((e - expected).amax() <= 1e-12 * expected.amax(), "{e} {expected}");
        }
    }
}

#[test]
fn a_size_of_its_own_in_every_leg_is_six_parameters() {
    let text = BRACKET.replace("positive = true", "per_leg = true");
    let names: Vec<&str> = parse(&text).unwrap().info().parameters.iter().map(|p| p.name).collect();
    assert_eq!(names, ["size-leg-1", "size-leg-2", "size-leg-3", "size-leg-4", "size-leg-5", "size-leg-6"]);
    for (at, actions) in actions_of(&text) {
        let Action::Elongation(e) = actions[4] else { panic!("{actions:?}") };
        let n = at.legs.directions[4];
        let expected = (n.x.powi(2) + n.y.powi(2)) * at.force_change()[4];
        assert!(
            (e[4] - expected).abs() < 1e-12 * expected.abs() && e.iter().filter(|x| **x != 0.0).count() == 1
        );
    }
}

#[test]
fn base_and_platform_move_as_bodies() {
    let text = |key: &str| {
        format!(
            "format = \"term/1\"\nid = \"moves\"\ntitle = \"A body turns about z\"\n{key} = [\"\", \"\", \"\", \"\", \"\", \
             \"size*(fz - ref_fz)\"]\nparameters = [{{ name = \"size\", unit = \"urad/N\", scale = 1 }}]"
        )
    };
    let is_twist = |actions: &[Action], expected: Vector6| {
        let (Action::Base(x) | Action::Plate(x)) = actions[0] else { panic!("{actions:?}") };
        assert!((x - expected).amax() <= 1e-12 * expected.amax(), "{x} {expected}");
    };
    for (at, actions) in actions_of(&text("base_motion")) {
        let turn = at.wrench.force.z - at.reference.force.z;
        let t = at.place.translation;
        is_twist(&actions, Vector6::new(-turn * t.y, turn * t.x, 0.0, 0.0, 0.0, turn));
    }
    for (at, actions) in actions_of(&text("platform_motion")) {
        let axis = at.place.rotation.column(2) * (at.wrench.force.z - at.reference.force.z);
        is_twist(&actions, Vector6::new(0.0, 0.0, 0.0, axis.x, axis.y, axis.z));
    }
}

#[test]
fn a_time_constant_may_be_called_tau() {
    let text = BRACKET.replace("size*(nx^2 + ny^2)*df", "size*df*(1 - exp(-elapsed/tau))")
        + "shape = { name = \"tau\", unit = \"min\", bounds = [0.1, 60], grid = [1, 2, 5] }";
    let term = parse(&text).unwrap();
    let [low, high] = term.info().shape.unwrap().bounds;
    assert!((low - 6.0).abs() < 1e-9 && (high - 3600.0).abs() < 1e-9, "{low} s, {high} s");
    let plain = BRACKET.replace("size*(nx^2 + ny^2)*df", "size*df*sin(2*pi*q/period)")
        + "shape = { name = \"period\", unit = \"1\", bounds = [4, 16], grid = [8] }";
    let error = parse(&plain).err().unwrap().to_string();
    assert!(error.contains("the argument of sin is a length"), "{error}");
}
