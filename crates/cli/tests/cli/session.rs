//! A session of the workbench, opened by the command beside the files it was made with.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::support::{hexbench, root};
use crate::workbench::start;

const SHOWN: &str = r#"{"terms":["base-compliance","load-offset"],"exclude":[3,7]}"#;

fn files() -> [PathBuf; 3] {
    ["hexapod.toml", "measurements.csv", "holdout.csv"]
        .map(|name| root().join("data/cases/mujoco-foundation").join(name))
}

/// What the page shows of a model, and the session saved there.
fn saved(folder: &Path) -> (Value, PathBuf) {
    saved_of(folder, &json!({ "from": "given" }))
}

/// The same of what is opened so.
fn saved_of(folder: &Path, open: &Value) -> (Value, PathBuf) {
    let workbench = start(folder);
    let bench = workbench.ask("POST /api/benches", &open.to_string()).1;
    let path = |what: &str| format!("POST /api/benches/{}/{what}", bench["id"].as_str().unwrap());
    let (status, view) = workbench.ask(&path("view"), SHOWN);
    assert_eq!(status, 200, "{view}");
    let shown: Value = serde_json::from_str(SHOWN).unwrap();
    let steps = json!([
        { "selection": {}, "times_noise": bench["view"]["times_noise"] },
        { "selection": shown, "times_noise": view["times_noise"] },
    ]);
    let kept = json!({ "form": "file", "steps": steps, "at": 1, "notes": "lines 3 and 7: door open" });
    let (status, answer) = workbench.ask(&path("session"), &kept.to_string());
    assert_eq!(status, 200, "{answer}");
    let session = folder.join("session.json");
    fs::write(&session, answer["text"].as_str().unwrap()).unwrap();
    (view, session)
}

/// Exit code, JSON on standard output, standard error.
fn run(
    command: &str,
    [hexapod, data, holdout]: &[PathBuf; 3],
    session: &Path,
) -> (Option<i32>, Value, String) {
    let mut hexbench = hexbench();
    hexbench.arg(command).args([hexapod, data]).arg("--holdout").arg(holdout);
    let output = hexbench.arg("--session").arg(session).args(["--json", "-"]).output().unwrap();
    let told = serde_json::from_slice(&output.stdout).unwrap_or_default();
    (output.status.code(), told, String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_session_gives_the_numbers_of_the_page_in_the_command() {
    let folder = tempfile::tempdir().unwrap();
    let (view, session) = saved(folder.path());
    let kept = serde_json::from_str(&fs::read_to_string(&session).unwrap()).unwrap();
    crate::schemas::check("session/1", &[kept]);
    let (code, fit, stderr) = run("fit", &files(), &session);
    assert_eq!(code, Some(0), "{stderr}");
    assert_eq!((&fit["terms"], &fit["excluded"]), (&view["terms"], &json!([3, 7])));
    assert_eq!((&fit["held_out"], &fit["fitted"]), (&view["holdout"], &view["fitted"]));
    let (legs, numbers) = fit["parameters"].as_array().unwrap().split_at(6);
    assert_eq!(Value::from(numbers), view["parameters"]);
    for (told, shown) in legs.iter().zip(view["legs"].as_array().unwrap()) {
        assert_eq!((&told["value"], &told["std"]), (&shown["stiffness"], &shown["std"]));
    }
    let (code, diagnosis, stderr) = run("diagnose", &files(), &session);
    assert_eq!((code, &diagnosis["excluded"]), (Some(0), &json!([3, 7])), "{stderr}");
}

/// The files with every deflection of the other sign.
pub(crate) fn reversed(folder: &Path) -> [PathBuf; 3] {
    files().map(|path| {
        let (text, turned) = (fs::read_to_string(&path).unwrap(), folder.join(path.file_name().unwrap()));
        let (header, rows) = text.split_once('\n').unwrap();
        let is_read: Vec<bool> =
            header.split(',').map(|name| name.starts_with('d') && !name.starts_with("delta")).collect();
        let cell = |(cell, &read): (&str, &bool)| match (read, cell.strip_prefix('-')) {
            (false, _) => cell.to_owned(),
            (true, Some(size)) => size.to_owned(),
            (true, None) => format!("-{cell}"),
        };
        let row = |row: &str| row.split(',').zip(&is_read).map(cell).collect::<Vec<_>>().join(",");
        let rows: Vec<String> = rows.lines().map(row).collect();
        let is_table = path.extension().is_some_and(|ext| ext == "csv");
        fs::write(&turned, if is_table { format!("{header}\n{}\n", rows.join("\n")) } else { text }).unwrap();
        turned
    })
}

#[test]
fn a_session_of_files_read_differently_reads_them_so_in_the_command() {
    let folder = tempfile::tempdir().unwrap();
    let turned = reversed(folder.path());
    let file = |path: &PathBuf| json!({ "name": path.file_name().unwrap().to_str(), "text": fs::read_to_string(path).unwrap() });
    let [hexapod, data, holdout] = &turned;
    let base =
        json!({ "from": "files", "hexapod": file(hexapod), "data": file(data), "holdout": file(holdout) });
    let open = json!({ "from": "read-as", "base": base, "changes": ["deflection-sign=reversed"] });
    let (view, session) = saved_of(folder.path(), &open);
    let kept: Value = serde_json::from_str(&fs::read_to_string(&session).unwrap()).unwrap();
    assert_eq!(kept["read_as"], json!(["deflection-sign=reversed"]));
    crate::schemas::check("session/1", &[kept]);
    let (code, fit, stderr) = run("fit", &turned, &session);
    assert_eq!(code, Some(0), "{stderr}");
    assert_eq!((&fit["held_out"], &fit["fitted"]), (&view["holdout"], &view["fitted"]));
    for (told, shown) in fit["parameters"].as_array().unwrap().iter().zip(view["legs"].as_array().unwrap()) {
        assert_eq!((&told["value"], &told["std"]), (&shown["stiffness"], &shown["std"]));
    }
    let (code, diagnosis, stderr) = run("diagnose", &turned, &session);
    assert_eq!((code, &diagnosis["read_as"]), (Some(0), &json!(["deflection-sign=reversed"])), "{stderr}");
    assert_eq!(diagnosis["verdict"], "named", "as the files mean, not as they say");
}

#[test]
fn a_session_beside_a_changed_file_is_refused_with_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let (_, session) = saved(folder.path());
    let [hexapod, data, holdout] = files();
    let changed = folder.path().join("measurements.csv");
    fs::write(&changed, fs::read_to_string(&data).unwrap() + "\n").unwrap();
    let (code, _, stderr) = run("fit", &[hexapod, changed, holdout.clone()], &session);
    assert_eq!(code, Some(3), "{stderr}");
    assert!(stderr.contains("measurements.csv is not the file of the session"), "{stderr}");
    let (code, _, stderr) = run("fit", &files(), &holdout);
    assert!(code == Some(3) && stderr.contains("holdout.csv: this is not a session file"), "{stderr}");
}
