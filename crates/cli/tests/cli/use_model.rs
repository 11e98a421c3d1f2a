//! compare, fit, predict and compensate as a user runs them.

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;

fn case(name: &str, file: &str) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "../../data/cases", name, file].iter().collect();
    path.to_str().unwrap().to_owned()
}

fn run(arguments: &[&str]) -> Output {
    Command::cargo_bin("hexbench").unwrap().args(arguments).output().unwrap()
}

fn on_case(command: &str, name: &str, more: &[&str]) -> Output {
    let (hexapod, data) = (case(name, "hexapod.toml"), case(name, "measurements.csv"));
    let mut all = vec![command, &hexapod, &data];
    all.extend(more);
    run(&all)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn saved_model(folder: &Path) -> String {
    let path = folder.join("model.toml").to_str().unwrap().to_owned();
    let fitted = on_case("fit", "mujoco-foundation", &["--add", "base-compliance", "-o", &path]);
    assert_eq!(fitted.status.code(), Some(0), "{}", text(&fitted.stderr));
    assert!(text(&fitted.stdout).contains("base-compliance.rotation-x"));
    path
}

#[test]
fn every_page_fits_eighty_columns() {
    let holdout = case("mujoco-foundation", "holdout.csv");
    for output in [
        on_case("compare", "mujoco-foundation", &["--holdout", &holdout]),
        on_case("compare", "paper-protocol", &[]),
        on_case("compare", "absolute-pitch", &[]),
        on_case("fit", "mujoco-foundation", &["--add", "base-compliance", "--holdout", &holdout]),
        on_case("fit", "paper-protocol", &["--estimator", "paper"]),
    ] {
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        for line in text(&output.stdout).lines() {
            assert!(line.chars().count() <= 80, "{} columns: {line}", line.chars().count());
        }
    }
}

#[test]
fn a_fit_that_leaves_something_says_what_to_do() {
    let said = |name: &str, added: &[&str]| {
        let more: Vec<&str> = added.iter().flat_map(|id| ["--add", id]).collect();
        let page = text(&on_case("fit", name, &more).stdout);
        let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
        ["`hexbench diagnose` names", "`--add leg-asymmetry:richer` fits the richer form"]
            .map(|s| page.contains(s))
    };
    assert_eq!(said("mujoco-foundation", &["leg-asymmetry"]), [true, true]);
    assert_eq!(said("mujoco-foundation", &["leg-asymmetry:richer"]), [true, false]);
    assert_eq!(said("two-effects", &["base-compliance"]), [true, false]);
    assert_eq!(said("two-effects", &["base-compliance", "load-offset"]), [false, false]);
}

#[test]
fn a_stiffness_under_friction_says_that_it_depends_on_the_size_of_the_small_forces() {
    let folder = tempfile::tempdir().unwrap();
    let rubbing = folder.path().join("friction.toml").to_str().unwrap().to_owned();
    on_case("fit", "friction", &["--add", "joint-friction", "-o", &rubbing]);
    let yielding = saved_model(folder.path());
    for (model, depends) in [(rubbing, true), (yielding, false)] {
        let output = run(&["stiffness", &model, "--load", "0,0,-200,0,0,0"]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let page = text(&output.stdout);
        assert_eq!(page.contains("A small load and its opposite"), depends, "{page}");
    }
}

#[test]
fn a_saved_model_predicts_its_holdout_and_finds_commands() {
    let folder = tempfile::tempdir().unwrap();
    let model = saved_model(folder.path());
    for (command, columns) in [("predict", 35), ("compensate", 47)] {
        let output = run(&[command, &model, &case("mujoco-foundation", "holdout.csv")]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let table = text(&output.stdout);
        assert_eq!(table.lines().count(), 31, "{command}");
        assert!(
            table.lines().all(|l| l.split(',').count() == columns),
            "{command}: {:?}",
            table.lines().next()
        );
    }
}

/// Entries of a 6x6 matrix of stiffness.json.
fn entries(matrix: &serde_json::Value) -> [[f64; 6]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[i][j].as_f64().unwrap()))
}

#[test]
fn maps_of_stiffness_show_what_single_poses_tell() {
    let folder = tempfile::tempdir().unwrap();
    let model = saved_model(folder.path());
    let [page, table] = ["map.html", "map.csv"].map(|name| folder.path().join(name).display().to_string());
    let load = "0,0,-200,0,0,0";
    let at = ["--pose", "0,0,5,0,0,0", "--load", load];
    let wanted = ["stiffness", &model, "--map", "20", "--html", &page, "-o", &table];
    let done = run(&[&wanted[..], &at].concat());
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    let [page, table] = [page, table].map(|path| std::fs::read_to_string(path).unwrap());
    for said in ["Softest direction", "Along z", "Deflection under the load", "<svg"] {
        assert!(page.contains(said), "{said}");
    }
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 82, "81 places");
    let column = |name: &str| rows[0].iter().position(|head| *head == name).unwrap();
    let number = |row: usize, name: &str| rows[row][column(name)].parse::<f64>().unwrap();
    for (row, a, b) in [(1, -20.0, 20.0), (41, 0.0, 0.0), (81, 20.0, -20.0)] {
        assert!((number(row, "a_mm") - a).abs().max((number(row, "b_mm") - b).abs()) < 1e-9, "row {row}");
    }
    let middle = run(&[&["stiffness", &model, "--json", "-"][..], &at].concat());
    let middle: serde_json::Value = serde_json::from_slice(&middle.stdout).unwrap();
    let softest = middle["states"][0]["of_forces"][0]["stiffness"].as_f64().unwrap();
    assert!((number(41, "k_force_1_N_per_m") / softest - 1.0).abs() < 1e-12);
    for wrong in [["--map", "0"], ["--map", "x"]] {
        assert_eq!(run(&[&["stiffness", &model][..], &wrong].concat()).status.code(), Some(2), "{wrong:?}");
    }
}

#[test]
fn the_stiffness_of_the_platform_is_a_page_a_table_and_a_file_with_the_same_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let model = saved_model(folder.path());
    let page = run(&["stiffness", &model, "--point", "0,0,80"]);
    assert_eq!(page.status.code(), Some(0), "{}", text(&page.stderr));
    let page = text(&page.stdout);
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    for said in [
        "Principal stiffnesses",
        "Stiffness matrix K",
        "Compliance matrix C",
        "0, 0, 80 mm in the mobile frame",
    ] {
        assert!(page.contains(said), "{said}: {page}");
    }
    let told = run(&["stiffness", &model, "--point", "0,0,80", "--json", "-"]);
    let told: serde_json::Value = serde_json::from_slice(&told.stdout).unwrap();
    assert_eq!(told["format"], "stiffness/1");
    let state = &told["states"][0];
    let (k, c) = (entries(&state["stiffness"]), entries(&state["compliance"]));
    for i in 0..6 {
        for j in 0..6 {
            let product: f64 = (0..6).map(|n| k[i][n] * c[n][j]).sum();
            assert!((product - f64::from(i == j)).abs() < 1e-9, "K C ({i}, {j}) is {product}");
        }
    }
    let shown = format!("{:.4}", state["of_forces"][0]["stiffness"].as_f64().unwrap() * 1e-6);
    assert!(page.contains(&shown), "{shown}: {page}");
    // A file of one pose at home is the same state.
    let poses = folder.path().join("home.csv");
    let header = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";
    std::fs::write(&poses, format!("{header}\n1,1,0,0,0,0,0,0,0,0,0,0,0,0\n")).unwrap();
    let table =
        text(&run(&["stiffness", &model, "--point", "0,0,80", "--poses", poses.to_str().unwrap()]).stdout);
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let column = lines[0].iter().position(|name| *name == "K_fy_ry_SI").unwrap();
    assert!((lines[1][column].parse::<f64>().unwrap() / k[1][4] - 1.0).abs() < 1e-9, "{table}");
}

#[test]
fn gauges_are_predicted_in_their_unit_beside_the_pose() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let scene: PathBuf = [env!("CARGO_MANIFEST_DIR"), "../../scenes/granite"].iter().collect();
    crate::scenes::simulate(&scene, &folder.path().join("bench"), &[]);
    let [hexapod, data, holdout] =
        ["hexapod.toml", "measurements.csv", "holdout.csv"].map(|name| file(&format!("bench/{name}")));
    let model = file("model.toml");
    let truth: serde_json::Value =
        serde_json::from_slice(&std::fs::read(file("bench/sealed/truth.json")).unwrap()).unwrap();
    let mut fit = vec!["fit", &hexapod, &data, "-o", &model];
    let effects = truth["effects"].as_array().unwrap();
    for id in effects {
        fit.extend(["--add", id.as_str().unwrap()]);
    }
    assert_eq!(run(&fit).status.code(), Some(0));
    let predicted = text(&run(&["predict", &model, &holdout]).stdout);
    let read = std::fs::read_to_string(&holdout).unwrap();
    let column = |table: &str, name: &str| -> Vec<f64> {
        let k = table.lines().next().unwrap().split(',').position(|n| n == name).expect(name);
        table.lines().skip(1).map(|line| line.split(',').nth(k).unwrap().parse().unwrap()).collect()
    };
    assert_eq!(column(&predicted, "da_um").len(), column(&read, "z1_um").len());
    let mut squares = Vec::new();
    for name in ["z1_um", "z2_um", "z3_um", "t1_um", "t2_um", "t3_um"] {
        let sigmas = column(&predicted, &format!("sigma_{name}"));
        let both = column(&predicted, name).into_iter().zip(column(&read, name));
        // The gauges scatter by 0.2 um.
        squares.extend(both.zip(sigmas).map(|((p, x), s)| (x - p).powi(2) / (s.powi(2) + 0.04)));
    }
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    let slack = 4.0 * (2.0 / squares.len() as f64).sqrt();
    assert!((mean - 1.0).abs() < slack, "{mean} of {}", squares.len());
}

#[test]
fn what_was_compensated_and_predicted_again_lands_on_the_wanted_pose() {
    let folder = tempfile::tempdir().unwrap();
    let model = saved_model(folder.path());
    let (poses, commands) = (folder.path().join("poses.csv"), folder.path().join("commands.csv"));
    let header = "a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";
    std::fs::write(&poses, format!("{header}\n10,-5,3,2,-1,4,20,0,-300,1,2,0\n")).unwrap();
    let (poses, commands) = (poses.to_str().unwrap(), commands.to_str().unwrap());
    assert_eq!(run(&["compensate", &model, poses, "-o", commands]).status.code(), Some(0));
    let predicted = text(&run(&["predict", &model, commands]).stdout);
    let row: Vec<f64> = predicted.lines().nth(1).unwrap().split(',').map(|c| c.parse().unwrap()).collect();
    let wanted = [10.0, -5.0, 3.0, 2.0, -1.0, 4.0];
    for k in 0..6 {
        let moved = if k < 3 { row[14 + k] * 1e-3 } else { (row[14 + k] * 1e-6).to_degrees() };
        assert!((row[2 + k] + moved - wanted[k]).abs() < 2e-8, "axis {k}: {} + {moved}", row[2 + k]);
    }
}

#[test]
fn failures_have_their_exit_codes() {
    let folder = tempfile::tempdir().unwrap();
    let holdout = case("mujoco-foundation", "holdout.csv");
    let file = |name: &str, content: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let broken = file("broken.toml", "format = \"model/1\"\n");
    let term = file("term.toml", "format = \"term/1\"\nid = \"x\"\n");
    let table = [
        (on_case("fit", "mujoco-clean", &["--add", "base-complience"]), 2, "did you mean"),
        (on_case("fit", "mujoco-clean", &["--add", "creep", "--estimator", "paper"]), 2, "leg springs only"),
        (on_case("fit", "mujoco-clean", &["--add", "leg-offset"]), 4, "absolute poses"),
        (on_case("fit", "mujoco-clean", &["--term", &term]), 3, "` is missing"),
        (on_case("fit", "mujoco-clean", &["--term", "no-such-file"]), 5, "there is no such file"),
        (on_case("fit", "absolute-pitch", &["--estimator", "paper"]), 3, "gls"),
        (on_case("compare", "mujoco-foundation", &["--check", "1.5"]), 1, "check failed"),
        (run(&["predict", &broken, &holdout]), 3, "` is missing"),
        (run(&["predict", "no-such-model", &holdout]), 5, "there is no such file"),
    ];
    for (output, code, part) in table {
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{message}");
        assert!(message.contains(part) && message.contains("error"), "{part}: {message}");
    }
}

#[test]
fn a_users_term_is_fitted_saved_reopened_and_diagnosed() {
    let folder = tempfile::tempdir().unwrap();
    let (term, model) = (folder.path().join("term.toml"), folder.path().join("model.toml"));
    let definition = "format = \"term/1\"\nid = \"my-brackets\"\ntitle = \"Mounts yield\"\n\
        elongation = \"size*(nx^2 + ny^2)*df\"\n\
        [[parameters]]\nname = \"size\"\nunit = \"nm/N\"\nscale = 50\n";
    std::fs::write(&term, definition).unwrap();
    let (term, model) = (term.to_str().unwrap(), model.to_str().unwrap());
    let fitted = on_case("fit", "mujoco-foundation", &["--term", term, "-o", model]);
    assert!(text(&fitted.stdout).contains("my-brackets.size"), "{}", text(&fitted.stderr));
    let predicted = run(&["predict", model, &case("mujoco-foundation", "holdout.csv")]);
    assert_eq!(predicted.status.code(), Some(0));
    let diagnosed = on_case("diagnose", "mujoco-clean", &["--term", term, "--json", "-"]);
    assert!(text(&diagnosed.stdout).contains("my-brackets"));
}

/// Numbers of a column of a table, by the beginning of its name.
fn column(table: &str, beginning: &str) -> Vec<f64> {
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let at = names.iter().position(|name| name.starts_with(beginning));
    let at = at.unwrap_or_else(|| panic!("no column {beginning} among {names:?}"));
    lines.map(|cells| cells[at].parse().unwrap()).collect()
}

#[test]
fn every_command_that_shows_uncertainties_gives_them_with_the_coverage_asked_for() {
    // Noise of this case is stated: the factor is that of the normal distribution.
    const K: f64 = 1.96;
    let folder = tempfile::tempdir().unwrap();
    let (model, poses) = (saved_model(folder.path()), case("mujoco-foundation", "holdout.csv"));
    for (command, more, name) in
        [("predict", vec![poses.as_str()], "da"), ("stiffness", vec!["--poses", &poses], "k_force_1")]
    {
        let table = |coverage: &[&str]| {
            let output = run(&[&[command, model.as_str()], more.as_slice(), coverage].concat());
            assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
            text(&output.stdout)
        };
        let (standard, wide) = (table(&[]), table(&["--coverage", "95"]));
        let (one, other) =
            (column(&standard, &format!("sigma_{name}")), column(&wide, &format!("u95_{name}")));
        let near = |(a, b): (&f64, &f64)| (b / a - K).abs() < 1e-3 * K;
        assert!(!one.is_empty() && one.iter().zip(&other).all(near), "{command}: {one:?} {other:?}");
        assert!(!wide.contains("sigma_"), "{command}: {}", wide.lines().next().unwrap());
    }
    let page = text(&run(&["stiffness", &model, "--coverage", "95"]).stdout);
    assert_eq!(page.matches("expanded uncertainty, 95 % (k = 1.96)").count(), 3, "{page}");
    let page = text(&on_case("diagnose", "mujoco-foundation", &["--coverage", "95"]).stdout);
    let standard = text(&on_case("diagnose", "mujoco-foundation", &[]).stdout);
    assert_eq!(page.matches("expanded uncertainty, 95 % (k = 1.96)").count(), 2, "{page}");
    let uncertainty_of_leg_1 = |page: &str| -> f64 {
        let section = page.split("Leg stiffness").nth(1).unwrap();
        let line =
            section.lines().find(|line| line.trim_start().starts_with("+- ") && !line.contains('(')).unwrap();
        line.split_whitespace().nth(1).unwrap().parse().unwrap()
    };
    let ratio = uncertainty_of_leg_1(&page) / uncertainty_of_leg_1(&standard);
    // Two digits are shown.
    assert!((ratio / K - 1.0).abs() < 0.06, "{ratio}");
    for (command, wrong) in [("predict", "100"), ("stiffness", "0"), ("diagnose", "x")] {
        assert_eq!(run(&[command, "a", "b", "--coverage", wrong]).status.code(), Some(2), "{command}");
    }
}

#[test]
fn commands_beyond_the_stroke_are_told_with_their_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, content: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let machine = std::fs::read_to_string(case("mujoco-foundation", "hexapod.toml")).unwrap();
    let machine = file("hexapod.toml", &(machine + "\n[legs]\nmin_length_mm = 150\nmax_length_mm = 250\n"));
    let model = folder.path().join("model.toml").to_str().unwrap().to_owned();
    let fitted = run(&["fit", &machine, &case("mujoco-foundation", "measurements.csv"), "-o", &model]);
    assert!(fitted.status.success(), "{}", text(&fitted.stderr));
    let columns = "a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";
    let rows =
        file("wanted.csv", &format!("{columns}\n0,0,0,0,0,0,0,0,-9,0,0,0\n0,0,500,0,0,0,0,0,-9,0,0,0\n"));
    for command in ["compensate", "predict"] {
        let output = run(&[command, &model, &rows]);
        let said = text(&output.stderr);
        assert!(output.status.success() && said.contains("its stroke is 150.0 to 250.0 mm"), "{said}");
        assert!(said.contains("line 3: leg"), "{said}");
    }
}
