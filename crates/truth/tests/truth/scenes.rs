//! Scenes as they are read from a folder.

use hexbench_core::Approach;
use std::path::Path;

use hexbench_core::{
    Measurand,
    files::{FileError, write_hexapod},
};
use hexbench_truth::{
    Scene,
    campaign::machines::RING_A,
    scene::{PartName, VirtualBench},
};

const HEAD: &str = r#"
format = "scene/1"
title = "A small bench"
shows = "creep"
source = "this test"
seed = 5
[instrument]
kind = "numbers"
sigma_translation_um = 0.5
sigma_rotation_urad = 3
[plan]
"#;

const TRUTH: &str = r#"
format = "truth/1"
leg_stiffness_N_per_um = [4.2, 3.8, 2.8, 4.3, 3.7, 3.7]
[[effect]]
id = "creep"
share = 0.05
time = 60
"#;

fn write(folder: &Path, plan: &str, truth: &str) {
    std::fs::create_dir_all(folder.join("sealed")).unwrap();
    std::fs::write(folder.join("scene.toml"), format!("{HEAD}{plan}\n")).unwrap();
    std::fs::write(folder.join("sealed/truth.toml"), truth).unwrap();
    write_hexapod(&folder.join("hexapod.toml"), &RING_A.hexapod("ring")).unwrap();
}

fn scene(plan: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), plan, TRUTH);
    Scene::read(folder.path()).unwrap()
}

fn complaint(plan: &str, truth: &str) -> FileError {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), plan, truth);
    Scene::read(folder.path()).unwrap_err()
}

#[test]
fn a_make_gives_its_rows_and_keys_beside_it_change_them() {
    let plan = scene("make = \"rich\"\nposes = 4\nrepeats = 3\nholdout_poses = 2\n").plan();
    assert_eq!((plan.training.len(), plan.holdout.len()), (4 * 6 * 3, 2 * 6));
    assert_eq!(plan.measurand, Measurand::DeflectionEuler);
    assert_eq!(plan.training[0].situation, plan.training[2].situation);
    assert_ne!(plan.training[0].situation.pose, plan.holdout[0].situation.pose);
    assert!(plan.training.iter().any(|row| row.situation.approach == Approach::Overloaded));
}

#[test]
fn poses_and_loads_can_be_listed() {
    let listed = "poses_mm_deg = [[1, 2, 3, 0, 0, 5], [0, 0, 0, 0, 0, 0]]\nholdout_poses = 1\n\
        travel_mm = [4, 5, 6]\nturn_deg = [0, 0, 1]\n\
        loads_N_Nm = [[0, 0, -100, 0, 0, 0], [10, 0, 0, 0, 0, 1]]\nreference_N_Nm = [0, 0, -1, 0, 0, 0]\n\
        repeats = 2\napproach = [-1]\ndelta_T_K = [-0.5, 0.5]\nelapsed_s = 30\n";
    let plan = scene(listed).plan();
    assert_eq!((plan.training.len(), plan.holdout.len()), (8, 2));
    let row = plan.training[0].situation;
    assert!(
        (row.pose.translation.y - 0.002).abs() < 1e-15
            && (row.pose.angles.z.to_degrees() - 5.0).abs() < 1e-12
    );
    assert!(row.approach == Approach::Overloaded && row.delta_t.abs() < 0.5 && row.delta_t != 0.0);
    assert!((row.elapsed - 30.0).abs() < 1e-12 && (row.reference.force.z + 1.0).abs() < 1e-12);
    let held_out = plan.holdout[0].situation.pose;
    assert!(held_out.translation.x.abs() < 0.004 && held_out.angles.x == 0.0 && held_out.angles.z != 0.0);
}

#[test]
fn the_age_of_the_reference_load_is_in_the_file_when_the_plan_states_it() {
    let columns = |scene: &Scene| VirtualBench::new(scene, true).dataset(PartName::Training).unwrap();
    let open = columns(&scene("make = \"rich\"\nposes = 2\n"));
    assert!(!open.columns.reference_age && open.observations.iter().all(|o| o.reference_age.is_none()));
    let stated = columns(&scene("make = \"rich\"\nposes = 2\nref_age_s = [60, 600]\n"));
    let ages = || stated.observations.iter().map(|o| o.reference_age.unwrap());
    assert!(stated.columns.reference_age && ages().all(|age| (60.0..600.0).contains(&age)));
    assert!(ages().any(|age| age.total_cmp(&ages().next().unwrap()).is_ne()));
    let negative = complaint("make = \"rich\"\nref_age_s = -1\n", TRUTH);
    assert!(negative.to_string().contains("cannot be negative"), "{negative}");
}

#[test]
fn loads_of_a_sequence_follow_each_other_under_one_reference() {
    let plan = "make = \"rich\"\nposes = 2\nrepeats = 2\norder = \"sequence\"\napproach = [1]\n";
    let scene = scene(plan);
    let noisy = VirtualBench::new(&scene, false).dataset(PartName::Training).unwrap();
    let exact = VirtualBench::new(&scene, true).dataset(PartName::Training).unwrap();
    assert!(noisy.columns.order && noisy.columns.reference_record);
    let mut rows: Vec<_> = exact.observations.iter().zip(&noisy.observations).collect();
    rows.sort_by_key(|(row, _)| row.order);
    let orders: Vec<_> = rows.iter().filter_map(|(row, _)| row.order).collect();
    assert_eq!(orders, (1..=24).collect::<Vec<_>>());
    for of_reference in rows.chunks(6) {
        assert!(of_reference.windows(2).all(|w| w[0].0.elapsed < w[1].0.elapsed));
        assert!(
            of_reference.iter().all(|(row, _)| row.reference_record == of_reference[0].0.reference_record)
        );
    }
    // The last load came after all others of its pose, and the machine went back to its reference load in between.
    let way = exact.sequences.to(rows[11].0).unwrap();
    assert_eq!(way.past.len(), 6 + 1 + 5);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("measurements.csv");
    hexbench_core::files::write_measurements(&file, &noisy).unwrap();
    assert_eq!(hexbench_core::files::read_measurements(&file).unwrap().dataset.sequences, noisy.sequences);
    let twice = complaint(&plan.replace("sequence", "twice"), TRUTH);
    assert!(twice.to_string().contains("separate"), "{twice}");
}

#[test]
fn conditions_can_be_a_table() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "conditions = \"todo.csv\"\nrepeats = 2\n", TRUTH);
    let header =
        "pose,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,elapsed_s";
    let rows = "7,1,2,3,0,0,0,0,0,-100,0,0,0,20\n8,0,0,0,0,0,0,0,0,-50,0,0,0,40\n";
    std::fs::write(folder.path().join("todo.csv"), format!("{header}\n{rows}")).unwrap();
    let plan = Scene::read(folder.path()).unwrap().plan();
    let numbers: Vec<_> = plan.training.iter().map(|row| (row.pose_id, row.repeat)).collect();
    assert_eq!(numbers, [(7, 1), (7, 2), (8, 1), (8, 2)]);
    assert!(plan.holdout.is_empty());
    assert!((plan.training[2].situation.elapsed - 40.0).abs() < 1e-12);
}

#[test]
fn a_row_does_not_depend_on_the_rows_asked_for_before() {
    let scene = scene("make = \"paper\"\n");
    let part = scene.part(PartName::Training);
    let forward: Vec<_> = part.iter().collect();
    let backward: Vec<_> = (0..part.len()).rev().map(|index| part.row(index).unwrap()).collect();
    assert_eq!(forward, backward.into_iter().rev().collect::<Vec<_>>());
    assert_eq!(part.row(part.len()), None);
}

#[test]
fn another_seed_draws_another_plan_of_the_same_world() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "make = \"rich\"\n", TRUTH);
    let [own, other] = [None, Some(6)].map(|seed| Scene::read_with_seed(folder.path(), seed).unwrap());
    assert_eq!(own.hidden_effects(), ["creep"]);
    assert!(own.leg_stiffness.iter().zip(&other.leg_stiffness).all(|(a, b)| a.total_cmp(b).is_eq()));
    assert_ne!(own.plan().training, other.plan().training);
    let (row, world) = (own.plan().training[0].situation, own.world());
    assert_eq!(world.deflection(&row), other.world().deflection(&row));
    assert_ne!(world.deflection(&row), world.without_effects().deflection(&row));
}

#[test]
fn what_is_wrong_is_told_with_place_rule_and_next_step() {
    let effect = |text: &str| {
        format!("format = \"truth/1\"\nleg_stiffness_N_per_um = [1, 1, 1, 1, 1, 1]\n[[effect]]\n{text}\n")
    };
    let table = [
        (
            "make = \"ritch\"",
            TRUTH.to_owned(),
            "scene.toml: line 12, column 8 (make): \"ritch\"",
            "Write \"rich\".",
        ),
        ("poses = 3", TRUTH.to_owned(), "a plan needs a make", "loads_N_Nm"),
        (
            "make = \"rich\"\nrepeats = 0",
            TRUTH.to_owned(),
            "line 13, column 11 (repeats): \"0\"",
            "Write for example",
        ),
        ("make = \"rich\"\nrepeets = 1", TRUTH.to_owned(), "repeets", "Write repeats."),
        ("make = \"rich\"\napproach = [2]", TRUTH.to_owned(), "(approach): \"2\"", "Write 1 if"),
        ("make = \"rich\"\nelapsed_s = [5, 1]", TRUTH.to_owned(), "(elapsed_s)", "Exchange"),
        ("make = \"rich\"\nposes = 90000000", TRUTH.to_owned(), "1080000000 rows", "Change poses"),
        (
            "conditions = \"none.csv\"",
            TRUTH.to_owned(),
            "none.csv: there is no such file",
            "Check the spelling",
        ),
        ("conditions = \"none.csv\"\nposes = 3", TRUTH.to_owned(), "(poses)", "Remove this key."),
        (
            "make = \"rich\"",
            effect("id = \"crepe\""),
            "truth.toml: line 4, column 6 (id): \"crepe\"",
            "docs/reference/file-formats.md",
        ),
        (
            "make = \"rich\"",
            effect("id = \"creep\"\nshare = 1"),
            "the key `time` is missing",
            "docs/reference/file-formats.md",
        ),
        ("make = \"rich\"", effect("share = 1"), "the key \"id\" is missing", "Add id."),
        (
            "make = \"rich\"",
            effect("id = \"out:leg-step\"\nleg = 7\nstep = 1e-6\ntime = 9"),
            "leg must be 1 to 6",
            "docs",
        ),
        (
            "make = \"rich\"",
            effect("id = \"creep\"\nshare = nan\ntime = 1"),
            "(share): \"nan\"",
            "correct number",
        ),
    ];
    for (plan, truth, message, next) in table {
        let error = complaint(plan, &truth);
        assert!(error.to_string().contains(message), "{error}");
        assert!(error.next_step().contains(next), "{error}: {}", error.next_step());
    }
}

fn bundled() -> Vec<std::path::PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let entries = std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path());
    let mut folders: Vec<_> = entries.filter(|path| path.is_dir()).collect();
    folders.sort();
    assert!(folders.len() >= 15, "{folders:?}");
    folders
}

/// `HEXBENCH_BLESS=1` draws them anew.
#[test]
fn every_bundled_scene_has_its_picture_and_its_page() {
    for folder in bundled() {
        let picture = Scene::read(&folder).unwrap().picture();
        let file = folder.join("picture.svg");
        if std::env::var_os("HEXBENCH_BLESS").is_some() {
            std::fs::write(&file, &picture).unwrap();
        }
        assert!(
            std::fs::read_to_string(&file).is_ok_and(|kept| kept == picture),
            "{} is stale",
            file.display()
        );
        let page = std::fs::read_to_string(folder.join("README.md")).unwrap();
        assert!(
            page.contains("picture.svg") && page.contains("Source of the numbers"),
            "{}",
            folder.display()
        );
    }
}

#[test]
fn every_bundled_scene_can_be_measured() {
    for folder in bundled() {
        let scene = Scene::read(&folder).unwrap();
        let bench = VirtualBench::new(&scene, false);
        for part in [PartName::Training, PartName::Holdout] {
            let rows = scene.part(part).len();
            assert!(rows > 5, "{}: {rows} rows", folder.display());
            let measured = bench.measure(part, 0..rows.min(40));
            assert!(measured.is_ok(), "{}: {measured:?}", folder.display());
        }
    }
}

fn with_instrument(instrument: &str) -> Result<Scene, FileError> {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "make = \"rich\"\nposes = 3\n", TRUTH);
    let whole = std::fs::read_to_string(folder.path().join("scene.toml")).unwrap();
    let (before, after) = whole.split_at(whole.find("[instrument]").unwrap());
    let plan = &after[after.find("[plan]").unwrap()..];
    let text = format!("{before}[instrument]\n{instrument}\n{plan}");
    std::fs::write(folder.path().join("scene.toml"), text).unwrap();
    Scene::read(folder.path())
}

const BALLS: &str =
    "kind = \"balls\"\nballs_mm = [[120, 0, 0], [-60, 104, 0], [-60, -104, 30]]\nsigma_ball_um = 1\n";
const BASE: &str = "base_balls_mm = [[300, 0, -200], [-150, 260, -200], [-150, -260, -150]]\n";

/// Whitened by the stated standard deviations, errors have unit mean square: the whole chain from balls to the table.
#[test]
fn readings_by_balls_have_the_stated_noise() {
    for base in ["", BASE] {
        let mut scene = with_instrument(&format!("{BALLS}{base}")).unwrap();
        scene.plan = scene.plan.with_repeats(40).unwrap();
        let rows = scene.part(PartName::Training).len();
        let read =
            |noise_free| VirtualBench::new(&scene, noise_free).measure(PartName::Training, 0..rows).unwrap();
        let mut squares = 0.0;
        for (noisy, ideal) in read(false).iter().zip(read(true)) {
            let (sigma, count) = (noisy.observation.sigma.unwrap(), 6.0 * rows as f64);
            for k in 0..6 {
                let error = noisy.observation.measured[k] - ideal.observation.measured[k];
                squares += (error / sigma[k]).powi(2) / count;
            }
        }
        // Correlations between the six numbers widen the spread of the mean square, at most as if only rows counted.
        let bound = 4.5 * (2.0 / rows as f64).sqrt();
        println!("base {}: {squares:.4}, bound {bound:.4}", !base.is_empty());
        assert!((squares - 1.0).abs() < bound, "{squares}");
    }
}

#[test]
fn a_frame_that_drifts_shows_unless_balls_on_the_base_carry_it() {
    let deflection = |more: &str| {
        let scene = with_instrument(&format!("{BALLS}{more}")).unwrap();
        VirtualBench::new(&scene, false).measure(PartName::Training, 0..1).unwrap()[0].observation.measured[0]
    };
    let drift = "drift_um_per_h = [5000, 0, 0]\n";
    assert!((deflection(drift) - deflection("")).abs() > 5e-6);
    assert!((deflection(&format!("{BASE}{drift}")) - deflection(BASE)).abs() < 1e-9);
}

const GAUGES: &str = "[[sensor]]\nname = \"g1\"\nkind = \"distance\"\npoint_mm = [120, 0, 40]\ndirection = [0, 0, 1]\nsigma_um = 0.3\n\
                      [[sensor]]\nname = \"ball\"\nkind = \"point\"\npoint_mm = [0, 110, 40]\nsigma_um = 0.6\n\
                      [[sensor]]\nname = \"level\"\nkind = \"inclination\"\naxis = [1, 0, 0]\nsigma_urad = 1.5\n\
                      [[sensor]]\nname = \"scale\"\nkind = \"leg-length\"\nleg = 3\nsigma_um = 0.2\n";

/// A scene read by a gauge, a ball, a level, a scale and two numbers of the pose.
fn with_sensors(plan: &str) -> Result<Scene, FileError> {
    let read =
        "kind = \"sensors\"\nread = [\"dc\", \"da\"]\nsigma_translation_um = 0.5\nsigma_rotation_urad = 3\n";
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), plan, TRUTH);
    let whole = std::fs::read_to_string(folder.path().join("scene.toml")).unwrap();
    let before = &whole[..whole.find("[instrument]").unwrap()];
    let text = format!("{before}[instrument]\n{read}[plan]\n{plan}\n{GAUGES}");
    std::fs::write(folder.path().join("scene.toml"), text).unwrap();
    Scene::read(folder.path())
}

#[test]
fn sensors_read_what_the_states_say_with_the_stated_noise() {
    let mut scene = with_sensors("make = \"rich\"\nposes = 3\n").unwrap();
    scene.plan = scene.plan.with_repeats(20).unwrap();
    let dataset = |noise_free| VirtualBench::new(&scene, noise_free).dataset(PartName::Training).unwrap();
    let (noisy, exact) = (dataset(false), dataset(true));
    let names = noisy.blocks.iter().flatten().map(|c| c.name(&scene.hexapod.sensors, noisy.measurand));
    let names: Vec<String> = names.filter(|name| !name.is_empty()).collect();
    assert_eq!(names, ["da", "dc", "g1", "ball_x", "ball_y", "ball_z", "level", "scale"]);
    let rows = scene.part(PartName::Training).len();
    assert_eq!(noisy.observations.len() as u64, 2 * rows);
    let first = scene.part(PartName::Training).row(0).unwrap();
    let states = scene.world().before_and_after(&first.situation).unwrap();
    let moved = states[1].translation - states[0].translation;
    let expected = hexbench_truth::metrology::read_sensors(&scene.hexapod, &states);
    let read = exact.rows().next().unwrap();
    let read: Vec<f64> = read.iter().flat_map(|o| o.measured).collect();
    let expected: Vec<f64> = [moved.x, moved.z].into_iter().chain(expected).collect();
    // The files carry a picometre and a picoradian.
    assert!(read.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12), "{read:?} {expected:?}");
    let mut squares = 0.0;
    let count = 8.0 * rows as f64;
    for (a, b) in noisy.observations.iter().zip(&exact.observations) {
        squares +=
            (0..6).map(|k| ((a.measured[k] - b.measured[k]) / a.sigma.unwrap()[k]).powi(2)).sum::<f64>()
                / count;
    }
    let bound = 4.5 * (2.0 / count).sqrt();
    assert!((squares - 1.0).abs() < bound, "{squares}, not 1 within {bound}");
}

#[test]
fn a_scene_with_sensors_writes_files_that_read_back() {
    let scene = with_sensors("make = \"rich\"\nposes = 3\nholdout_poses = 2\n").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let bench = VirtualBench::new(&scene, false);
    bench.write(folder.path(), hexbench_truth::scene::Existing::Replaced, &|_| ()).unwrap();
    let machine = hexbench_core::files::read_hexapod(&folder.path().join("hexapod.toml")).unwrap();
    assert_eq!(machine.sensors, scene.hexapod.sensors);
    for part in [PartName::Training, PartName::Holdout] {
        let read = hexbench_core::files::read_campaign(&machine, &folder.path().join(part.file())).unwrap();
        assert!(read.warnings.is_empty(), "{:?}", read.warnings);
        let kept = bench.dataset(part).unwrap();
        assert_eq!(
            (read.dataset.blocks, read.dataset.observations.len()),
            (kept.blocks, kept.observations.len())
        );
        for (a, b) in read.dataset.observations.iter().zip(&kept.observations) {
            assert!((0..6).all(|k| (a.measured[k] - b.measured[k]).abs() < 1e-15), "{a:?} {b:?}");
        }
    }
    let refused = with_sensors("make = \"absolute\"\nposes = 3\n").unwrap_err().to_string();
    assert!(refused.contains("sensors read deflections"), "{refused}");
}

#[test]
fn what_is_wrong_with_an_instrument_is_told() {
    let table = [
        ("kind = \"laser\"", "\"numbers\", \"balls\" or \"sensors\""),
        ("kind = \"sensors\"", "there is no sensor to read"),
        (
            "kind = \"numbers\"\nsigma_translation_um = 1\nsigma_rotation_urad = 1\nread = [\"da\"]",
            "has no such key",
        ),
        ("kind = \"numbers\"\nsigma_translation_um = 1", "the key \"sigma_rotation_urad\" is missing"),
        ("kind = \"numbers\"\nsigma_ball_um = 1", "has no such key"),
        (
            "kind = \"balls\"\nsigma_ball_um = 1\nballs_mm = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]",
            "not on one line",
        ),
        (&format!("{BALLS}blunder_share = 2"), "between 0 and 1"),
        (&format!("{BALLS}drift_um_per_h = [1, 2]"), "three rates"),
    ];
    for (instrument, message) in table {
        let error = with_instrument(instrument).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
        assert!(error.place.line.is_some() || message.contains("missing"), "{error}");
    }
}
