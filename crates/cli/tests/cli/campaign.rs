//! From ball centers and loads to measurements.csv: the round trip of every scene, and what is wrong with balls.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use hexbench_core::files::{read_campaign, read_hexapod};
use hexbench_core::{Dataset, Pose, Vector3};
use serde_json::Value;

use crate::scenes::simulate;
use crate::support::{complaint, hexbench, root, text};

/// Largest difference of two parameters that say the same, standard deviations.
const SAME_SIGMAS: f64 = 0.01;
/// The simulated table has six decimals of um and urad, the balls 1e-7 mm: 1e-4 um over the radius of 0.12 m.
const ROUNDING_UM_OR_URAD: f64 = 3e-3;

struct Bench(tempfile::TempDir);

impl Bench {
    /// The files of a simulated scene.
    fn of(scene: &str) -> Self {
        Self::with(scene, &[])
    }

    /// The same, read by touching balls.
    fn touched(scene: &str) -> Self {
        Self::with(scene, &["--balls"])
    }

    fn with(scene: &str, more: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        simulate(&root().join("scenes").join(scene), &folder.path().join("data"), more);
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join("data").join(name)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn write(&self, name: &str, content: &str) {
        fs::write(self.path(name), content).unwrap();
    }

    fn run(&self, arguments: &[&str]) -> std::process::Output {
        hexbench().current_dir(self.path("")).args(arguments).output().unwrap()
    }

    fn campaign(&self, more: &[&str]) -> std::process::Output {
        self.run(&[&["campaign", "balls.csv", "loads.csv", "-o", "out"], more].concat())
    }

    /// What standard error says of a campaign that ends so.
    fn said(&self, more: &[&str], code: i32) -> String {
        let output = self.campaign(more);
        let said = complaint(&output);
        assert_eq!(output.status.code(), Some(code), "{said}");
        said
    }

    fn dataset(&self, table: &str) -> Dataset {
        let hexapod = read_hexapod(&self.path("hexapod.toml")).unwrap();
        read_campaign(&hexapod, &self.path(table)).unwrap().dataset
    }

    /// Balls of one record, changed.
    fn change(&self, record: &str, change: impl Fn(&mut Vec<String>)) {
        let line = |line: &str| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if record == "*" && cells[0] != "record" || cells[0] == record {
                change(&mut cells);
            }
            cells.join(",")
        };
        let changed: Vec<String> = self.read("balls.csv").lines().map(line).collect();
        self.write("balls.csv", &(changed.join("\n") + "\n"));
    }
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap()
}

/// Largest difference of the measured numbers of two tables, um and urad (of absolute poses too).
fn difference(one: &Dataset, other: &Dataset) -> f64 {
    assert_eq!((one.observations.len(), one.measurand), (other.observations.len(), other.measurand));
    let rows = one.observations.iter().zip(&other.observations);
    let numbers = rows.flat_map(|(a, b)| (0..6).map(|k| (a.measured[k] - b.measured[k]).abs()));
    numbers.fold(0.0, f64::max) * 1e6
}

fn same_conditions(one: &Dataset, other: &Dataset) {
    for (a, b) in one.observations.iter().zip(&other.observations) {
        let of = |o: &hexbench_core::Observation| {
            (
                o.pose_id,
                o.repeat,
                o.pose,
                o.wrench,
                o.reference,
                o.approach,
                o.delta_t.to_bits(),
                o.elapsed.to_bits(),
            )
        };
        assert_eq!(of(a), of(b));
    }
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn balls_of_every_scene_give_the_readings_of_its_table() {
    for name in scenes_of_poses() {
        let bench = Bench::touched(&name);
        text(bench.campaign(&["--balls", "balls.toml"]));
        let [expected, found] =
            ["measurements.csv", "out/measurements.csv"].map(|table| bench.dataset(table));
        let apart = difference(&expected, &found);
        println!("{name}: {apart:.2e} um or urad");
        assert!(apart < ROUNDING_UM_OR_URAD, "{name}: {apart}");
        same_conditions(&expected, &found);
    }
}

/// The verdict, what was added, and the parameters of two results; by how many standard deviations these differ at most.
fn same_diagnosis(one: &Value, other: &Value, sigmas: f64) -> f64 {
    assert_eq!((&one["verdict"], &one["added"]), (&other["verdict"], &other["added"]));
    let pairs = one["parameters"].as_array().unwrap().iter().zip(other["parameters"].as_array().unwrap());
    let apart = pairs.map(|(a, b)| {
        assert_eq!(a["name"], b["name"]);
        let [a, b, std] = [&a["value"], &b["value"], &a["std"]].map(|x| x.as_f64().unwrap());
        (a - b).abs() / std
    });
    let apart = apart.fold(0.0, f64::max);
    assert!(apart < sigmas, "{apart} standard deviations");
    apart
}

/// Scenes whose readings are full poses.
fn scenes_of_poses() -> Vec<String> {
    let scenes = root().join("scenes");
    let names = fs::read_dir(&scenes).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let description = |name: &String| fs::read_to_string(scenes.join(name).join("scene.toml"));
    let reads_poses =
        |name: &String| description(name).is_ok_and(|text| !text.contains("kind = \"sensors\""));
    let mut names: Vec<String> = names.filter(reads_poses).collect();
    names.sort();
    assert!(names.len() > 13, "{names:?}");
    names
}

/// Verdict by verdict, parameter by parameter: what comes of the balls is what comes of the table beside them.
#[test]
fn the_diagnosis_of_the_round_trip_of_every_scene_is_that_of_its_table() {
    for name in scenes_of_poses() {
        let bench = Bench::touched(&name);
        text(bench.campaign(&["--balls", "balls.toml"]));
        text(bench.run(&["diagnose", "hexapod.toml", "measurements.csv", "--json", "table.json"]));
        text(bench.run(&["diagnose", "hexapod.toml", "out/measurements.csv", "--json", "trip.json"]));
        let [table, trip] = ["table.json", "trip.json"].map(|name| json(&bench.path(name)));
        let apart = same_diagnosis(&table, &trip, SAME_SIGMAS);
        println!("{name}: {} {}, {apart:.1e} standard deviations apart", table["verdict"], table["added"]);
    }
}

#[test]
fn a_scene_that_reads_no_poses_has_no_balls_to_touch() {
    let folder = tempfile::tempdir().unwrap();
    let scene = root().join("scenes/granite");
    let output = hexbench()
        .arg("simulate")
        .arg(scene)
        .args(["--balls", "-o"])
        .arg(folder.path().join("x"))
        .output()
        .unwrap();
    let said = complaint(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("the sensors of this scene read no poses"), "{said}");
}

/// Numbers of a drawing, ball centers and loads; commands as they are typed.
#[test]
fn three_commands_lead_from_a_drawing_and_ball_centres_to_the_effect() {
    let bench = Bench::of("paper-rich");
    let folder = tempfile::tempdir().unwrap();
    for file in ["balls.csv", "loads.csv"] {
        fs::copy(bench.path(file), folder.path().join(file)).unwrap();
    }
    let typed = [
        "init --base-radius 160 --base-gap 20 --platform-radius 120 --platform-gap 20 --height 165",
        "campaign balls.csv loads.csv -o campaign",
        "diagnose hexapod.toml campaign/measurements.csv",
    ];
    let run =
        |line: &str| text(hexbench().current_dir(folder.path()).args(line.split(' ')).output().unwrap());
    let pages = typed.map(run);
    assert!(pages[2].contains("NAMED") && pages[2].contains("base-compliance"), "{}", pages[2]);
    // Each page names the command that comes next.
    for (page, next) in pages.iter().zip(&typed[1..]) {
        let words = next.split(' ').next().unwrap();
        assert!(
            page.contains(&format!("hexbench {}", if words == "campaign" { "diagnose" } else { words })),
            "{page}"
        );
    }
    let keys: usize = typed.iter().map(|line| "hexbench ".len() + line.len() + 1).sum();
    println!("{keys} keys");
    assert!(keys <= 210, "{keys}");
}

/// The balls of a scene as other programs would have written them: the same readings, and the page says whose layout it was.
#[test]
fn balls_in_the_layouts_of_other_programs_give_the_same_readings() {
    let bench = Bench::of("paper");
    text(bench.campaign(&["--balls", "balls.toml"]));
    let expected = bench.dataset("out/measurements.csv");
    let balls = bench.read("balls.csv");
    let rows: Vec<Vec<&str>> = balls.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let calypso = rows.iter().flat_map(|row| {
        let line = |(axis, number): (&str, &str)| {
            format!("plan\t{}\t{axis}Value\t{number}\t{}\tmm\n", row[0], row[4])
        };
        ["x", "y", "z"].into_iter().zip(row[5..].iter().copied()).map(line).collect::<Vec<_>>()
    });
    let calypso = "planid\tpartnb\tidsymbol\tactual\tfeatureid\tunit\n".to_owned()
        + &calypso.collect::<String>()
        + "END\n";
    let point = |row: &Vec<_>| [&[row[0], row[4]], &row[5..]].concat().join(" ") + "\n";
    let list = rows.iter().map(point).collect::<Vec<_>>().concat();
    for (file, told, more) in [
        (calypso, "Zeiss Calypso", &[][..]),
        ("// mm\n".to_owned() + &list, "SpatialAnalyzer", &["--unit", "mm"]),
    ] {
        fs::remove_dir_all(bench.path("out")).unwrap();
        bench.write("balls.csv", &file);
        let page = text(bench.campaign(&[&["--balls", "balls.toml"], more].concat()));
        assert!(page.contains("read as") && page.contains(told), "{page}");
        assert!(difference(&expected, &bench.dataset("out/measurements.csv")) < 1e-9);
    }
    assert!(bench.said(&["--balls", "balls.toml"], 3).contains("states no unit for its coordinates"));
    let poses = text(bench.run(&["poses", "balls.csv", "--unit", "mm", "--balls", "balls.toml"]));
    assert_eq!(poses.lines().count() - 1, 2 * expected.observations.len());
}

#[test]
fn balls_on_the_base_give_every_record_its_frame() {
    let folder = tempfile::tempdir().unwrap();
    for file in ["hexapod.toml", "scene.toml", "sealed/truth.toml"] {
        let into = folder.path().join(file);
        fs::create_dir_all(into.parent().unwrap()).unwrap();
        fs::copy(root().join("scenes/paper-rich").join(file), into).unwrap();
    }
    let scene = folder.path().join("scene.toml");
    let base = "kind = \"balls\"\nbase_balls_mm = [[300, 300, -200], [-300, 300, -200], [0, -350, -100]]";
    fs::write(&scene, fs::read_to_string(&scene).unwrap().replacen("kind = \"balls\"", base, 1)).unwrap();
    let bench = Bench(tempfile::tempdir().unwrap());
    simulate(folder.path(), &bench.path(""), &[]);
    assert!(bench.said(&[], 3).contains("if there are balls on the base, name them with --balls"));
    text(bench.campaign(&["--balls", "balls.toml"]));
    let [table, trip] = ["measurements.csv", "out/measurements.csv"].map(|name| bench.dataset(name));
    assert!(difference(&table, &trip) < ROUNDING_UM_OR_URAD);
    let [stated, found] = [table, trip].map(|data| data.observations[0].sigma.unwrap());
    assert!(stated.iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-5 * a), "{stated:?} {found:?}");
}

/// Without known places, and with the balls themselves as readings: other weights, the same answer within the noise.
#[test]
fn balls_that_nobody_has_measured_give_the_same_answer() {
    let bench = Bench::of("paper-rich");
    text(bench.run(&["diagnose", "hexapod.toml", "measurements.csv", "--json", "table.json"]));
    text(bench.campaign(&[]));
    text(bench.run(&["diagnose", "hexapod.toml", "out/measurements.csv", "--json", "unmeasured.json"]));
    let points = ["campaign", "balls.csv", "loads.csv", "--points", "hexapod.toml", "-o", "points"];
    text(bench.run(&points));
    text(bench.run(&["diagnose", "points/hexapod.toml", "points/measurements.csv", "--json", "points.json"]));
    let table = json(&bench.path("table.json"));
    for name in ["unmeasured.json", "points.json"] {
        same_diagnosis(&table, &json(&bench.path(name)), 0.5);
    }
}

#[test]
fn masses_on_a_point_and_over_a_pulley_become_wrenches() {
    let bench = Bench::of("paper");
    let loads = bench.read("loads.csv");
    let mut lines = loads.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let mut text_of = format!(
        "{},mass_kg,ref_mass_kg,load_x_mm,load_y_mm,load_z_mm,pull_x,pull_y,pull_z\n",
        head[..10].join(",")
    );
    for cells in lines {
        let _ = writeln!(text_of, "{},34.5,12.2,10,0,50,0,3,-4", cells[..10].join(","));
    }
    bench.write("loads.csv", &text_of);
    text(bench.campaign(&["--gravity", "10"]));
    for o in bench.dataset("out/measurements.csv").observations {
        let force = Vector3::new(0.0, 0.6, -0.8) * 345.0;
        let moment = (o.pose.rotation() * Vector3::new(0.01, 0.0, 0.05)).cross(&force);
        assert!((o.wrench.force - force).norm() < 1e-9 && (o.wrench.moment - moment).norm() < 1e-9);
        assert!((o.reference.force - force * 12.2 / 34.5).norm() < 1e-9, "{o:?}");
    }
}

#[test]
fn axes_of_the_measuring_machine_are_told_and_turned_back() {
    let bench = Bench::of("paper-rich");
    let turn = Pose::from_array([0.3, -0.2, 0.1, 0.02, -0.03, 1.2]);
    text(bench.campaign(&["--balls", "balls.toml"]));
    let straight = bench.dataset("out/measurements.csv");
    fs::remove_dir_all(bench.path("out")).unwrap();
    bench.change("*", |cells| {
        let p = Vector3::new(number(&cells[5]), number(&cells[6]), number(&cells[7]));
        let seen = turn.translation * 1e3 + turn.rotation() * p;
        (0..3).for_each(|k| cells[5 + k] = format!("{:.9}", seen[k]));
    });
    let said = bench.said(&["--balls", "balls.toml"], 0);
    assert!(said.contains("are turned by 68") && said.contains("--align"), "{said}");
    fs::remove_dir_all(bench.path("out")).unwrap();
    let said = bench.said(&["--balls", "balls.toml", "--align"], 0);
    assert!(!said.contains("warning"), "{said}");
    // What the machine is off its commands leaves the axes uncertain by some 1e-4 rad, and readings by that share.
    let apart = difference(&straight, &bench.dataset("out/measurements.csv"));
    let largest =
        straight.observations.iter().flat_map(|o| o.measured).fold(0.0, |m: f64, x| m.max(x.abs())) * 1e6;
    println!("{apart} of {largest} um or urad");
    assert!(apart < 1e-3 * largest, "{apart} of {largest}");
}

#[test]
fn a_ball_that_moved_is_named_with_its_records() {
    let bench = Bench::of("paper");
    bench.change("8", |cells| {
        if cells[4] == "P2" {
            // Away from both others: of three balls, distances to one other alone do not tell which of the two moved.
            cells[5] = format!("{:.7}", number(&cells[5]) - 0.05);
            cells[6] = format!("{:.7}", number(&cells[6]) + 0.05);
        }
    });
    let said = bench.said(&["--balls", "balls.toml", "--json", "moved.json"], 0);
    assert!(said.contains("ball P2 moved on the platform between records 7 and 8"), "{said}");
    assert_eq!(said.matches("warning:").count(), 1, "{said}");
    let moved = json(&bench.path("moved.json"));
    assert_eq!(moved["moved"][0]["records"], serde_json::json!(["7", "8"]));
    let sound = Bench::of("paper-rich");
    let quiet = sound.run(&["campaign", "balls.csv", "loads.csv", "-o", "out", "--json", "-"]);
    let sound = serde_json::from_str(&text(quiet)).unwrap();
    crate::schemas::check("campaign/1", &[moved, sound]);
}

#[test]
fn exchanged_and_mirrored_balls_are_refused() {
    let exchanged = Bench::of("paper-rich");
    exchanged.change("8", |cells| {
        let other = match cells[4].as_str() {
            "P1" => "P2",
            "P2" => "P1",
            same => same,
        };
        cells[4] = other.to_owned();
    });
    for places in [&["--balls", "balls.toml"][..], &[]] {
        let said = exchanged.said(places, 3);
        assert!(said.contains("record 8") && said.contains("P1 for P2, P2 for P1"), "{said}");
    }
    let mirrored = Bench::of("paper-rich");
    mirrored.change("*", |cells| cells[7] = format!("{:.7}", -number(&cells[7])));
    let said = mirrored.said(&["--balls", "balls.toml"], 3);
    assert!(said.contains("mirror image") && said.contains("next: Export right-handed"), "{said}");
}

#[test]
fn what_does_not_fit_together_is_told_with_its_next_step() {
    let bench = Bench::of("paper");
    let (balls, loads) = (bench.read("balls.csv"), bench.read("loads.csv"));
    let with_loads = |from: &str, to: &str, message: &str| {
        bench.write("loads.csv", &loads.replacen(from, to, 1));
        let said = bench.said(&["--balls", "balls.toml"], 3);
        assert!(said.contains(message) && said.contains("next: "), "{said}");
    };
    with_loads("\n1,2,", "\n1,99,", "line 2 of the loads: there is no record 99");
    with_loads(
        "\n1,2,",
        "\n2,2,",
        "line 2 of the loads: record 2 is used both as loaded and as reference state",
    );
    with_loads("record,", "rec,", "ref_record");
    with_loads("fz_N", "fz", "the name has no unit");
    with_loads(",2.616,", ",52.616,", "from their positions at the commanded pose");
    bench.write("loads.csv", &loads);
    bench.write("balls.csv", &balls.replacen("\n4,loaded,1,2,P2", "\n4,loaded,1,2,Q2", 1));
    assert!(bench.said(&["--balls", "balls.toml"], 3).contains("record 4 lacks ball P2"));
    bench.write("balls.csv", &balls);
    assert!(bench.said(&["--gravity", "-9.81"], 2).contains("--gravity -9.81"));
    bench.said(&[], 0);
    assert!(bench.said(&[], 2).contains("exists already"));
}

#[test]
fn a_table_may_come_from_standard_input_and_under_other_names() {
    let bench = Bench::of("paper-rich");
    let of_file = ["diagnose", "hexapod.toml", "measurements.csv", "--json", "file.json"];
    text(bench.run(&of_file));
    let theirs = bench.read("measurements.csv").replacen("a_mm,b_mm,c_mm", "X,Y,Z", 1);
    bench.write("theirs.csv", &theirs);
    let refused = bench.run(&["diagnose", "hexapod.toml", "theirs.csv"]);
    let said = complaint(&refused);
    assert!(
        said.contains("next: Rename them, in the file or with --columns: X is a_mm, Y is b_mm, Z is c_mm"),
        "{said}"
    );
    let entry = |(name, is): (&str, &str)| format!("[[column]]\nname = \"{name}\"\nis = \"{is}\"\n");
    let map: String = [("X", "a_mm"), ("Y", "b_mm"), ("Z", "c_mm")].map(entry).concat();
    bench.write("map.toml", &format!("format = \"columns/1\"\n{map}"));
    let mut piped = hexbench();
    piped.current_dir(bench.path("")).args(["diagnose", "hexapod.toml", "-", "--columns", "map.toml"]);
    text(piped.args(["--json", "piped.json"]).write_stdin(theirs).output().unwrap());
    let [file, piped] = ["file.json", "piped.json"].map(|name| json(&bench.path(name)));
    assert_eq!(file["parameters"], piped["parameters"]);
    assert_eq!((&file["verdict"], &file["candidates"]), (&piped["verdict"], &piped["candidates"]));
}
