//! The model file gives back the same bits and refuses what is no model.

use std::sync::{Arc, LazyLock};

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::application::predict::predict;
use hexbench_model::effects::user_term;
use hexbench_model::estimation::fit::{TermSpec, fit};
use hexbench_model::results::diagnose::prepare;
use hexbench_model::terms::catalogue;
use proptest::prelude::*;

use crate::cases;

fn model(hexapod: &Hexapod, data: &Dataset, terms: &[(&str, bool, f64)]) -> Model {
    let campaign = prepare(hexapod, data).unwrap();
    let own = user_term::parse(
        r#"
        format = "term/1"
        id = "soft-start"
        title = "Softer at small forces"
        elongation = "size*(tanh(f/f_s) - tanh(f0/f_s))"
        parameters = [{ name = "size", unit = "um", scale = 2 }]
        shape = { name = "f_s", unit = "N", bounds = [5, 200], grid = [20, 50] }
    "#,
    )
    .unwrap();
    let mut all = catalogue();
    all.push(own);
    let wanted: Vec<TermSpec> = terms
        .iter()
        .map(|(id, rich, shape)| {
            let term = Arc::clone(all.iter().find(|t| t.info().id == *id).unwrap());
            let lin = hexbench_model::estimation::linearization::parameter_count(term.as_ref(), *rich);
            TermSpec { term, rich: *rich, shape: *shape, prior: vec![1e-4; lin] }
        })
        .collect();
    let fitted = fit(&campaign, &wanted, None).unwrap();
    let origin = DataOrigin {
        file: data.source.clone(),
        sha256: "0".repeat(64),
        readings: campaign.readings,
        read_as: Vec::new(),
        excluded: Vec::new(),
    };
    Model::new(&campaign, &fitted, Estimator::Gls, origin)
}

fn bits(model: &Model) -> Vec<u64> {
    let p = &model.point;
    let mut all: Vec<f64> = p.compliances.iter().copied().collect();
    for a in &p.active {
        all.extend(&a.values);
        all.push(a.shape);
    }
    all.extend(
        p.machine.metrology_frame.rotation.coords.iter().chain(p.machine.target_frame.rotation.coords.iter()),
    );
    all.extend(p.machine.metrology_frame.translation.vector.iter());
    all.extend(p.machine.target_frame.translation.vector.iter());
    all.extend(p.machine.base_joints.iter().chain(&p.machine.platform_joints).flatten());
    all.extend(model.covariance.iter());
    all.extend([model.noise.translation, model.noise.rotation, model.noise.dof, model.chi2, model.dof]);
    all.into_iter().map(f64::to_bits).collect()
}

fn models() -> Vec<Model> {
    let (h, d, _) = cases::case("mujoco-foundation");
    let (ha, da, _) = cases::case("absolute-pitch");
    vec![
        model(&h, &d, &[]),
        model(
            &h,
            &d,
            &[("base-compliance", false, 1.0), ("creep", false, 60.0), ("soft-start", false, 40.0)],
        ),
        model(&h, &d, &[("base-compliance", true, 1.0), ("joint-friction", false, 5.0)]),
        model(&ha, &da, &[("joint-geometry", false, 1.0), ("actuator-pitch", false, 3e-3)]),
    ]
}

#[test]
fn a_model_comes_back_bit_for_bit() {
    for original in models() {
        let text = original.to_toml().unwrap();
        let back = Model::from_toml(&text).unwrap();
        assert_eq!(bits(&back), bits(&original));
        assert_eq!(back.to_toml().unwrap(), text);
        assert_eq!(
            (back.parameters, back.determined, back.data),
            (original.parameters, original.determined, original.data)
        );
    }
}

#[test]
fn a_reopened_model_predicts_the_same_numbers() {
    let (_, data, _) = cases::case("mujoco-foundation");
    let original = models().remove(1);
    let back = Model::from_toml(&original.to_toml().unwrap()).unwrap();
    assert_eq!(predict(&back, &data.observations[..9]), predict(&original, &data.observations[..9]));
}

#[test]
fn what_is_no_model_is_refused_with_key_and_rule() {
    let text = models().remove(1).to_toml().unwrap();
    let after = |line_start: &str, new: &str| {
        let old = text
            .lines()
            .find(|l| l.starts_with(line_start))
            .unwrap_or_else(|| panic!("{line_start}\n{text}"));
        text.replacen(old, new, 1)
    };
    let table = [
        (after("format", "format = \"model/2\""), "model/1"),
        (after("mode", "mode = \"deflections\""), "must be one of"),
        (after("settled", "settled = true\nsetled = true"), "unknown key"),
        (after("id = \"base", "id = \"base-complience\""), "did you mean `base-compliance`"),
        (after("id = \"creep\"", "id = \"base-compliance\""), ""),
        (after("compliance_si", "compliance_si = nan"), "not a finite number"),
        (after("compliance_si", "compliance_si = 1e-7"), "contradicts"),
        (text.replace("[term.shape]", "[term.shpe]"), "unknown key"),
        (after("form = ", "form = \"richer\""), "must be ideal, rich, translation or rotation"),
        (after("unit = ", "unit = \"um\""), "the unit must be"),
        (after("order = ", "order = []"), "names are expected"),
        (after("matrix = ", "matrix = [[1.0]]"), "rows of"),
        (text.replace("parameters.rotation-z", "parameters.rotation-q"), "did you mean"),
        (text.replace("estimator = \"gls\"", "estimator = \"ols\""), "gls or paper"),
        (text.replace("elongation = ", "elongatoin = "), "soft-start"),
        (String::new(), "` is missing"),
    ];
    for (text, part) in table {
        let error = Model::from_toml(&text).unwrap_err().to_string();
        assert!(error.contains(part), "{part}: {error}");
    }
}

#[test]
fn a_file_that_was_changed_is_refused_unless_it_is_trusted() {
    let original = models().remove(1);
    let text = original.to_toml().unwrap();
    let joint = original.hexapod.base_joints[0].x.to_string();
    let moved = text.replacen(&joint, &format!("{joint}1"), 1);
    let error = text.lines().find(|l| l.starts_with("standard_error")).unwrap();
    let unsealed = &text[..text.find("[seal]").unwrap()];
    for (changed, part) in [
        (moved, "changed after"),
        (text.replacen(error, "standard_error_N_per_um = 1e308", 1), "changed after"),
        (text.replace("sha256 = \"", "sha256 = \"0"), "changed after"),
        (unsealed.to_owned(), "is missing"),
    ] {
        assert_ne!(changed, text);
        let error = Model::from_toml(&changed).unwrap_err().to_string();
        assert!(error.contains(part), "{part}: {error}");
        assert!(Model::from_changed_toml(&changed).is_ok());
    }
    let commented = text.replace("\n[noise]", "\n# noise of one reading\n\n[noise]");
    assert!(commented != text && Model::from_toml(&commented).is_ok(), "a comment is no number");
}

#[test]
fn a_spring_that_cannot_be_is_neither_read_nor_written() {
    let original = models().remove(0);
    let text = original.to_toml().unwrap();
    let line = text.lines().find(|l| l.starts_with("compliance_si")).unwrap();
    for value in ["0.0", "-0.0", "-1e-7"] {
        let changed = text.replacen(line, &format!("compliance_si = {value}"), 1);
        let error = Model::from_changed_toml(&changed).unwrap_err().to_string();
        assert!(error.contains("leg 1") && error.contains("greater than zero"), "{error}");
    }
    let mut turned = original;
    turned.point.compliances[2] = -1e-7;
    assert!(turned.to_toml().unwrap_err().to_string().starts_with("leg 3"));
}

fn with_covariance(change: impl Fn(&mut Vec<Vec<f64>>)) -> String {
    let model = models().remove(0);
    let mut table: toml::Table = model.to_toml().unwrap().parse().unwrap();
    let mut rows: Vec<Vec<f64>> = model.covariance.row_iter().map(|r| r.iter().copied().collect()).collect();
    change(&mut rows);
    table["covariance"]["matrix"] = toml::Value::try_from(rows).unwrap();
    Model::from_toml(&toml::to_string(&table).unwrap()).map_or_else(|e| e.to_string(), |_| String::new())
}

#[test]
fn a_matrix_that_is_no_covariance_is_refused() {
    assert_eq!(with_covariance(|_| {}), "");
    assert!(with_covariance(|m| m[0][1] *= 1.01).contains("not symmetric"));
    assert!(with_covariance(|m| m[2][2] = -m[2][2]).contains("negative"));
    assert!(with_covariance(|m| m[3][3] = f64::INFINITY).contains("finite"));
    let too_correlated = with_covariance(|m| {
        let c = 1.2 * (m[0][0] * m[1][1]).sqrt();
        (m[0][1], m[1][0]) = (c, c);
    });
    assert!(too_correlated.contains("not a covariance"), "{too_correlated}");
}

proptest! {
    #[test]
    fn any_springs_that_a_machine_may_have_come_back(springs in prop::array::uniform6((-99.0..99.0_f64).prop_map(|power| 10_f64.powf(power)))) {
        let mut model = SPRINGS.clone();
        model.point.compliances = hexbench_core::Vector6::from_column_slice(&springs);
        let back = Model::from_toml(&model.to_toml().unwrap()).unwrap();
        prop_assert_eq!(back.point.compliances.map(f64::to_bits), model.point.compliances.map(f64::to_bits));
    }

    #[test]
    fn damaged_files_never_panic(at in 0_usize..6000, byte in any::<u8>()) {
        let mut text = SAMPLE.clone().into_bytes();
        let place = at % text.len();
        text[place] = byte;
        let _ = Model::from_toml(&String::from_utf8_lossy(&text));
    }
}

/// The model without terms, fitted once for all that is drawn.
static SPRINGS: LazyLock<Model> = LazyLock::new(|| models().remove(0));
static SAMPLE: LazyLock<String> = LazyLock::new(|| SPRINGS.to_toml().unwrap());
