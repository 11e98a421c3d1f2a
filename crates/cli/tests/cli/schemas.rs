//! JSON Schemas of results: what the commands write fits them, and nothing is written that they do not name.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use crate::support::{cases, hexbench, root, text};

/// Set to add what results have and schemas lack; descriptions and enumerations that stand in a schema stay.
const BLESS: &str = "HEXBENCH_BLESS";
/// A folder with more results to learn from when schemas are written: rare values do not occur in the bundled cases.
const SAMPLES: &str = "HEXBENCH_SAMPLES";
const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

fn folder() -> PathBuf {
    root().join("docs/reference/schemas")
}

fn type_of(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    }
}

/// Adds what a value is to a schema; one that allows the value stays as it is.
fn learn(schema: &mut Map<String, Value>, value: &Value) {
    let is_new = schema.is_empty();
    let mut types: BTreeSet<String> = match schema.get("type") {
        Some(Value::String(one)) => BTreeSet::from([one.clone()]),
        Some(Value::Array(all)) => all.iter().map(|t| t.as_str().unwrap().to_owned()).collect(),
        _ => BTreeSet::new(),
    };
    types.insert(type_of(value).to_owned());
    let stated = if types.len() == 1 { json!(types.first()) } else { json!(types) };
    schema.insert("type".to_owned(), stated);
    match value {
        Value::Object(object) => learn_object(schema, object, is_new),
        Value::Array(all) => {
            let items = schema.entry("items").or_insert_with(|| json!({}));
            for item in all {
                learn(items.as_object_mut().unwrap(), item);
            }
        }
        Value::String(word) => {
            if let Some(allowed) = schema.get_mut("enum").and_then(Value::as_array_mut)
                && !allowed.iter().any(|known| known == word)
            {
                allowed.push(json!(word));
            }
        }
        _ => {}
    }
}

/// Objects whose keys are names of terms and parameters hold values of one kind; others have keys of their own.
fn learn_object(schema: &mut Map<String, Value>, object: &Map<String, Value>, is_new: bool) {
    let is_name = |key: &String| key.contains(['-', '.']);
    if schema.contains_key("additionalProperties") || object.keys().any(is_name) {
        let values = schema.entry("additionalProperties").or_insert_with(|| json!({}));
        object.values().for_each(|value| learn(values.as_object_mut().unwrap(), value));
        return;
    }
    let had_keys = schema.contains_key("properties");
    let properties = schema.entry("properties").or_insert_with(|| json!({})).as_object_mut().unwrap();
    for (key, value) in object {
        let property = properties.entry(key.clone()).or_insert_with(|| json!({}));
        learn(property.as_object_mut().unwrap(), value);
    }
    let known: Vec<Value> = match schema.get("required") {
        Some(Value::Array(known)) => known.clone(),
        _ if is_new || !had_keys => object.keys().map(|key| json!(key)).collect(),
        _ => Vec::new(),
    };
    let required = known.into_iter().filter(|key| object.contains_key(key.as_str().unwrap())).collect();
    schema.insert("required".to_owned(), Value::Array(required));
}

/// The schema of a format allows these results, and needs nothing more to do so.
pub(crate) fn check(format: &str, samples: &[Value]) {
    let name = format.replace('/', "-") + ".json";
    let path = folder().join(&name);
    let kept: Value =
        fs::read_to_string(&path).map_or(json!({}), |text| serde_json::from_str(&text).unwrap());
    let mut fresh = kept.clone();
    if fresh == json!({}) {
        learn(fresh.as_object_mut().unwrap(), &samples[0]);
        fresh["$schema"] = json!(DRAFT);
        fresh["title"] = json!(format);
        fresh["properties"]["format"] = json!({ "const": format, "type": "string" });
    }
    for sample in samples {
        assert_eq!(sample["format"], format);
        learn(fresh.as_object_mut().unwrap(), sample);
    }
    if std::env::var_os(BLESS).is_some() {
        for sample in more(format) {
            learn(fresh.as_object_mut().unwrap(), &sample);
        }
        fs::create_dir_all(folder()).unwrap();
        fs::write(&path, serde_json::to_string_pretty(&fresh).unwrap() + "\n").unwrap();
    }
    assert!(
        fresh == kept || std::env::var_os(BLESS).is_some(),
        "{name} is stale: run the tests once with {BLESS}=1"
    );
    assert_eq!(fresh["properties"]["format"]["const"], format);
}

/// Results of a format among those that were put aside.
fn more(format: &str) -> Vec<Value> {
    let Some(folder) = std::env::var_os(SAMPLES) else { return Vec::new() };
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let all = files.map(|path| serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap());
    all.filter(|value: &Value| value["format"] == format).collect()
}

fn json_of(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&text(hexbench().current_dir(folder).args(arguments).output().unwrap())).unwrap()
}

/// What a command writes of every bundled case.
fn of_cases(arguments: &[&str]) -> Vec<Value> {
    let folders = cases().into_iter().map(|case| root().join("data/cases").join(case));
    folders.map(|folder| json_of(&folder, arguments)).collect()
}

const FILES: [&str; 2] = ["hexapod.toml", "measurements.csv"];

fn with<'a>(command: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&[command], &FILES[..], more, &["--json", "-"]].concat()
}

#[test]
fn diagnoses_fit_their_schema() {
    let mut all = of_cases(&with("diagnose", &["--holdout", "holdout.csv"]));
    let case = root().join("data/cases/mujoco-foundation");
    for more in [&["--read-as", "deflection-sign=reversed"][..], &["--exclude", "17", "--keep-all"]] {
        all.push(json_of(&case, &with("diagnose", more)));
    }
    // Of misread files, with what they say when they are read right.
    let misread = tempfile::tempdir().unwrap();
    crate::session::reversed(misread.path());
    all.push(json_of(misread.path(), &with("diagnose", &["--holdout", "holdout.csv"])));
    assert!(all.last().unwrap()["other_reading"]["read_as"].is_array(), "{:?}", all.last());
    check("diagnosis/1", &all);
}

#[test]
fn comparisons_fit_their_schema() {
    let mut all = of_cases(&with("compare", &["--holdout", "holdout.csv"]));
    all.extend(of_cases(&with("compare", &[])));
    check("comparison/1", &all);
}

#[test]
fn fits_fit_their_schema() {
    let mut all = of_cases(&with("fit", &["--add", "base-compliance", "--holdout", "holdout.csv"]));
    let case = root().join("data/cases/mujoco-foundation");
    for more in [&[][..], &["--estimator", "paper"]] {
        all.push(json_of(&case, &with("fit", more)));
    }
    check("fit/1", &all);
}

#[test]
fn checks_fit_their_schema() {
    let mut all = of_cases(&with("check", &["holdout.csv"]));
    all.extend(of_cases(&with("check", &[])));
    all.extend(of_cases(&["check", FILES[0], "--json", "-"]));
    check("check/1", &all);
}

#[test]
fn catalogue_stiffness_and_power_fit_their_schemas() {
    check("terms/1", &[json_of(&root(), &["terms", "--json", "-"])]);
    let case = root().join("data/cases/mujoco-foundation");
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("model.toml");
    let model = model.to_str().unwrap();
    text(hexbench().current_dir(&case).args(["fit", FILES[0], FILES[1], "-o", model]).output().unwrap());
    check(
        "stiffness/1",
        &[
            json_of(&case, &["stiffness", model, "--json", "-"]),
            json_of(&case, &["stiffness", model, "--poses", "holdout.csv", "--json", "-"]),
        ],
    );
    let power = with("power", &["--effect", "base-compliance", "--simulate", "5"]);
    check("power/1", &[json_of(&case, &with("power", &[])), json_of(&case, &power)]);
}

#[test]
fn a_schema_stays_as_it_is_only_for_values_that_it_allows() {
    let mut schema = Map::new();
    learn(&mut schema, &json!({ "a": 1, "b": [{ "c": null }] }));
    for (value, is_allowed) in [
        (json!({ "a": 2.5, "b": [] }), true),
        (json!({ "a": 2.5, "b": [{ "c": null }, { "c": null }] }), true),
        (json!({ "a": 2.5 }), false),
        (json!({ "a": "2.5", "b": [] }), false),
        (json!({ "a": 1, "b": [], "d": 1 }), false),
        (json!({ "a": 1, "b": [{ "c": 3 }] }), false),
    ] {
        let mut learnt = schema.clone();
        learn(&mut learnt, &value);
        assert_eq!(learnt == schema, is_allowed, "{value}");
    }
}
