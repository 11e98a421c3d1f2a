//! Suites with scenes of one's own.

use std::fs;

use serde_json::Value;

use crate::challenge::{Bench, NOISE, own};
use crate::support::root;

/// A scene of one's own: the files of hidden-1, with a machine that is wider and another plan.
fn own_scene(bench: &Bench) {
    let from = root().join("scenes/hidden-1");
    fs::create_dir_all(bench.path("mine/sealed")).unwrap();
    for name in ["hexapod.toml", "scene.toml", "sealed/truth.toml"] {
        let text = fs::read_to_string(from.join(name)).unwrap();
        fs::write(bench.path("mine").join(name), text.replace("poses = 24", "poses = 16")).unwrap();
    }
    fs::create_dir_all(bench.path("gauges")).unwrap();
    let gauges = fs::read_to_string(root().join("scenes/granite/scene.toml")).unwrap();
    fs::create_dir_all(bench.path("gauges/sealed")).unwrap();
    fs::write(bench.path("gauges/scene.toml"), gauges).unwrap();
    for name in ["hexapod.toml", "sealed/truth.toml"] {
        fs::copy(root().join("scenes/granite").join(name), bench.path("gauges").join(name)).unwrap();
    }
}

/// The truths of a suite that is made, with the folder.
fn truths_of(bench: &Bench, suite: &str, cases: usize) -> Vec<Value> {
    fs::write(bench.path("suite.toml"), suite).unwrap();
    bench.make("challenge", &[]).assert().success();
    let read = |k: usize| bench.path(&format!("challenge/sealed/case-{k:03}/truth.json"));
    (1..=cases).map(|k| serde_json::from_str(&fs::read_to_string(read(k)).unwrap()).unwrap()).collect()
}

#[test]
fn sizes_in_units_faults_of_laboratories_and_noise_are_keys_of_suites_as_of_studies() {
    let suite = "format = \"challenge-suite/1\"\nname = \"own\"\nversion = 1\ntitle = \"Own\"\nseed = 4\n\
        [cases.sized]\nkind = \"single\"\ncount = 1\nmachine = \"ring_a\"\neffects = [\"base-compliance\"]\nsize_nm_per_N = 2\n\
        noise_um_urad = [0.25, 2]\n\
        [cases.pair]\nkind = \"pair\"\ncount = 1\neffects = [[\"thermal-expansion\", \"base-compliance\"]]\nsize_factor = [2, 4]\n\
        laboratory = [\"joints-0.1mm\"]\nnoise_scale = 2\n\
        [cases.in-scene]\nscene = \"mine\"\ncount = 1\neffects = [\"base-compliance\"]\nsize_nm_per_N = 3\n";
    let bench = Bench { folder: tempfile::tempdir().unwrap() };
    own_scene(&bench);
    let truths = truths_of(&bench, suite, 3);
    let of = |group: &str| truths.iter().find(|t| t["group"] == group).unwrap();
    let base = |truth: &Value| {
        let base: Vec<f64> = (0..3).map(|k| truth["parameters"]["base"][k].as_f64().unwrap()).collect();
        (base.iter().map(|k| k.powi(-2)).sum::<f64>() / 3.0).sqrt() * 1e9
    };
    assert!((base(of("sized")) - 2.0).abs() < 1e-9, "{}", of("sized"));
    assert!((base(of("in-scene")) - 3.0).abs() < 1e-9, "{}", of("in-scene"));
    assert_eq!(of("sized")["noise"], serde_json::json!({ "translation_um": 0.25, "rotation_urad": 2.0 }));
    assert!(of("sized").get("laboratory").is_none());
    let pair = of("pair");
    assert_eq!(pair["laboratory"], "joints-0.1mm");
    assert_eq!(pair["effects"], serde_json::json!(["thermal-expansion", "base-compliance"]));
    assert_eq!(pair["noise"], serde_json::json!({ "translation_um": 1.0, "rotation_urad": 6.0 }));
    // What the instrument states is handed out, what the laboratory does is not.
    let public = |truth: &Value, name: &str| {
        let id = truth["id"].as_str().unwrap();
        fs::read_to_string(bench.path(&format!("challenge/cases/{id}/{name}"))).unwrap()
    };
    assert!(public(of("sized"), "hexapod.toml").contains("0.25"));
    for name in ["hexapod.toml", "measurements.csv", "predict.csv"] {
        assert!(!public(pair, name).contains("joints-"), "{name}");
    }
}

#[test]
fn a_suite_sets_noise_and_faults_of_the_laboratory_beside_a_scene() {
    let head = "format = \"challenge-suite/1\"\nname = \"own\"\nversion = 1\ntitle = \"Own\"\nseed = 4\n";
    let bench = Bench { folder: tempfile::tempdir().unwrap() };
    own_scene(&bench);
    let bench = &bench;
    // The same case with one key more: everything else that is drawn stays.
    let made = |name: &'static str, scene: &str, more: &str| {
        let suite = format!("{head}[cases.a]\nscene = \"{scene}\"\ncount = 1\n{more}\n");
        fs::write(bench.path("suite.toml"), suite).unwrap();
        bench.make(name, &[]).assert().success();
        move |file: &str| fs::read_to_string(bench.path(&format!("{name}/{file}"))).unwrap()
    };
    let [measurements, hexapod] =
        ["measurements.csv", "hexapod.toml"].map(|file| format!("cases/case-001/{file}"));
    let [measured, ideal] = ["measured.csv", "true.csv"].map(|file| format!("sealed/case-001/{file}"));
    let plain = made("plain", "mine", "");
    let truth = |read: &dyn Fn(&str) -> String| -> Value {
        serde_json::from_str(&read("sealed/case-001/truth.json")).unwrap()
    };

    let noisy = made("noisy", "mine", "noise_um_urad = [2, 9]");
    assert_eq!(noisy(&ideal), plain(&ideal));
    assert_eq!(truth(&noisy)["noise"], serde_json::json!({ "translation_um": 2.0, "rotation_urad": 9.0 }));
    let error = translations_apart(&noisy(&measured), &noisy(&ideal));
    assert!((1.4..2.6).contains(&error), "{error} um");
    assert!(noisy(&hexapod).contains("sigma_translation_um = 2"), "{}", noisy(&hexapod));
    let doubled = made("doubled", "mine", "noise_scale = 2");
    let stated = |truth: &Value| truth["noise"]["translation_um"].as_f64().unwrap();
    assert!((stated(&truth(&doubled)) / stated(&truth(&plain)) - 2.0).abs() < 1e-9);

    let slip = made("slip", "mine", "laboratory = \"unit-slip\"");
    assert_eq!(truth(&slip)["laboratory"], "unit-slip");
    let differ = |a: &str, b: &str| a.lines().zip(b.lines()).filter(|(a, b)| a != b).count();
    assert_eq!(differ(&slip(&measurements), &plain(&measurements)), 1, "one row is written wrongly");
    assert_eq!(slip(&measured), plain(&measured));
    let joints = made("joints", "mine", "laboratory = [\"joints-0.1mm\"]");
    assert!(joints(&hexapod) == plain(&hexapod) && joints(&ideal) != plain(&ideal));
    for name in [&measurements, &hexapod] {
        assert!(!slip(name).contains("slip") && !joints(name).contains("joints-"), "{name}");
    }

    let gauges = made("gauges-plain", "gauges", "");
    let quieter = made("gauges-quieter", "gauges", "noise_scale = 0.5");
    let sigma = |text: &str| -> f64 {
        let line = text.lines().find(|line| line.starts_with("sigma_um")).unwrap();
        line.split('=').nth(1).unwrap().trim().parse().unwrap()
    };
    assert!((sigma(&quieter(&hexapod)) / sigma(&gauges(&hexapod)) - 0.5).abs() < 1e-9);
}

/// Root mean square difference of the translations of two tables, um.
fn translations_apart(a: &str, b: &str) -> f64 {
    let place = |name| a.lines().next().unwrap().split(',').position(|column| column == name).unwrap();
    let columns = ["da_um", "db_um", "dc_um"].map(place);
    let numbers = |text: &str| -> Vec<f64> {
        let row = |line: &str| {
            let cells: Vec<&str> = line.split(',').collect();
            columns.map(|k| cells[k].parse::<f64>().unwrap())
        };
        text.lines().skip(1).flat_map(row).collect()
    };
    let squares: Vec<f64> = numbers(a).iter().zip(numbers(b)).map(|(a, b)| (a - b).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn a_mechanism_of_ones_own_is_a_formula_in_a_scene() {
    let bench = Bench { folder: tempfile::tempdir().unwrap() };
    own_scene(&bench);
    let truth = bench.path("mine/sealed/truth.toml");
    let stiffness = fs::read_to_string(&truth).unwrap();
    let kept = |line: &&str| line.starts_with("leg_stiffness") || line.starts_with("format");
    let stiffness = stiffness.lines().filter(kept).collect::<Vec<_>>().join("\n") + "\n";
    let with = |formula: &str| {
        let effect = format!("[[effect]]\nid = \"out:formula\"\nelongation = \"{formula}\"\nsize = 4e-7\n");
        fs::write(&truth, format!("{stiffness}{effect}")).unwrap();
    };
    let suite = "format = \"challenge-suite/1\"\nname = \"own\"\nversion = 1\ntitle = \"Own\"\nseed = 4\n\
        [cases.mine]\nscene = \"mine\"\ncount = 1\n";
    with("size*tanh(f/(40 N))*cos(leg)");
    let truths = truths_of(&bench, suite, 1);
    assert_eq!(truths[0]["effects"], serde_json::json!(["out:formula"]));
    assert_eq!(truths[0]["parameters"]["formula"]["numbers"]["size"], 4e-7);
    assert!(truths[0]["distance"].as_f64().unwrap() > 3.0, "{}", truths[0]);
    bench.run("ours", &[own(), "challenge", "answer"]).assert().success();
    assert_eq!(bench.json(&["ours"])["entrants"][0]["all"]["answered"], 1);
    with("size*tanh(f/(40 N)");
    let refused = bench.make("again", &[]).output().unwrap();
    let told = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(3), "{told}");
    assert!(
        told.contains("truth.toml: line 5, column 14 (elongation)") && told.contains("not closed"),
        "{told}"
    );
}

#[test]
fn scenes_of_ones_own_are_made_run_and_scored() {
    let suite = "format = \"challenge-suite/1\"\nname = \"own\"\nversion = 1\ntitle = \"Own\"\nseed = 4\n\
        [cases.as-it-is]\nscene = \"mine\"\ncount = 2\n\
        [cases.another-effect]\nscene = \"mine\"\ncount = 1\neffects = [\"thermal-expansion\"]\ndistance = 40\n\
        [cases.gauges]\nscene = [\"gauges\"]\ncount = 1\n";
    let bench = Bench { folder: tempfile::tempdir().unwrap() };
    own_scene(&bench);
    fs::write(bench.path("suite.toml"), suite).unwrap();
    bench.make("challenge", &[]).assert().success();
    bench.make("again", &[]).assert().success();
    let read = |name: &str| fs::read_to_string(bench.path(name)).unwrap();
    assert_eq!(read("challenge/challenge.toml"), read("again/challenge.toml"));
    let truths: Vec<Value> = (1..=4)
        .map(|k| serde_json::from_str(&read(&format!("challenge/sealed/case-00{k}/truth.json"))).unwrap())
        .collect();
    let of = |group: &str| truths.iter().filter(|t| t["group"] == group).collect::<Vec<_>>();
    let [one, two] = of("as-it-is")[..] else { panic!("{truths:#?}") };
    assert!(one["machine"] == "mine" && one["effects"] == two["effects"] && one["seed"] != two["seed"]);
    let thermal = of("another-effect")[0];
    assert_eq!(thermal["effects"], serde_json::json!(["thermal-expansion"]));
    assert!((thermal["distance"].as_f64().unwrap() - 40.0).abs() < 0.1, "{thermal}");
    let public = read(&format!("challenge/cases/{}/hexapod.toml", of("gauges")[0]["id"].as_str().unwrap()));
    assert_eq!(public.matches("[[sensor]]").count(), 6);
    for word in ["mine", "hidden", "granite", "sealed"] {
        assert!(!public.contains(word), "{word} is told: {public}");
    }
    bench.run("ours", &[own(), "challenge", "answer"]).assert().success();
    let all = &bench.json(&["ours"])["entrants"][0]["all"];
    assert_eq!(
        (&all["answered"], &all["outcomes"]),
        (&serde_json::json!(4), &serde_json::json!([4, 0, 0])),
        "{all:#}"
    );
    assert!(NOISE.contains(&all["chi2_reduced"].as_f64().unwrap()), "{all:#}");
}

#[test]
fn a_scene_that_is_none_and_keys_that_it_decides_are_told_with_their_line() {
    let bench = Bench { folder: tempfile::tempdir().unwrap() };
    own_scene(&bench);
    let head = "format = \"challenge-suite/1\"\nname = \"own\"\nversion = 1\ntitle = \"Own\"\nseed = 4\n";
    for (group, wanted) in [
        ("scene = \"nowhere\"\ncount = 1", "there is no scene.toml in the folder"),
        ("scene = []\ncount = 1", "the list is empty"),
        ("scene = \"mine\"\nkind = \"single\"\ncount = 1", "the scene decides the kind"),
        ("scene = \"mine\"\nmachine = \"ring_a\"\ncount = 1", "the scene decides the machine"),
        ("scene = \"mine\"\ndistance = 5\ncount = 1", "the effects of the scene have their own sizes"),
        ("scene = \"gauges\"\nnoise_um_urad = [1, 2]\ncount = 1", "a noise that this key does not tell"),
        ("scene = [\"mine\", \"gauges\"]\nlaboratory = \"drift-1\"\ncount = 1", "faults of deflections"),
    ] {
        fs::write(bench.path("suite.toml"), format!("{head}[cases.a]\n{group}\n")).unwrap();
        let output = bench.make("x", &[]).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(
            output.status.code() == Some(3) && error.contains(wanted) && error.contains("line "),
            "{group}: {error}"
        );
    }
}
