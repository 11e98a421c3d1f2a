//! What a command writes destroys nothing: inputs, devices, links, and what was there before.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use tempfile::TempDir;

use crate::support::{complaint, hexbench, root};

/// A folder of its own with the files of a case, and the command in it.
struct Bench(TempDir);

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        for name in ["hexapod.toml", "measurements.csv"] {
            fs::copy(root().join("data/cases/mujoco-clean").join(name), folder.path().join(name)).unwrap();
        }
        Self(folder)
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, words: &[&str]) -> Output {
        hexbench().current_dir(self.0.path()).args(words).output().unwrap()
    }

    /// `fit` of the case with more arguments.
    fn fit(&self, more: &[&str]) -> Output {
        self.run(&[&["fit", "hexapod.toml", "measurements.csv"], more].concat())
    }

    /// `compare` of the case with more arguments.
    fn compare(&self, more: &[&str]) -> Output {
        self.run(&[&["compare", "hexapod.toml", "measurements.csv"], more].concat())
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).unwrap()
    }

    /// What temporary files are left.
    fn remains(&self) -> Vec<String> {
        let names =
            fs::read_dir(self.0.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        names.filter(|name| Path::new(name).extension().is_some_and(|end| end == "part")).collect()
    }
}

/// Says why a check is not made, past the capture of the test harness.
fn skipped(why: &str) {
    use std::io::Write as _;
    std::io::stderr().write_all(format!("skipped: {why}\n").as_bytes()).unwrap();
}

fn refused(output: &Output, why: &str) {
    assert_eq!(output.status.code(), Some(2), "{}", complaint(output));
    assert!(complaint(output).contains(why) && complaint(output).contains("next: "), "{}", complaint(output));
    assert!(output.stdout.is_empty(), "refused before any work");
}

#[test]
fn an_output_that_is_an_input_is_refused_and_the_input_stays() {
    let bench = Bench::new();
    let before = ["hexapod.toml", "measurements.csv"].map(|name| bench.read(name));
    refused(&bench.fit(&["-o", "hexapod.toml"]), "hexapod.toml is an input of this command");
    fs::create_dir(bench.at("sub")).unwrap();
    refused(&bench.compare(&["--json", "sub/../measurements.csv"]), "(as measurements.csv)");
    let absolute = bench.at("measurements.csv").display().to_string();
    refused(&bench.compare(&["--json", &absolute]), "(as measurements.csv)");
    refused(&bench.compare(&["--table", "measurements.csv"]), "measurements.csv is an input of this command");
    refused(&bench.compare(&["--html", "measurements.csv"]), "measurements.csv is an input of this command");
    assert_eq!(["hexapod.toml", "measurements.csv"].map(|name| bench.read(name)), before);
}

#[test]
fn every_way_to_write_is_refused_to_write_over_the_machine() {
    let bench = Bench::new();
    let before = bench.read("hexapod.toml");
    for words in [
        &["diagnose", "hexapod.toml", "measurements.csv", "--json", "hexapod.toml"][..],
        &["diagnose", "hexapod.toml", "measurements.csv", "--markdown", "hexapod.toml"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--next", "hexapod.toml"],
        &["discover", "hexapod.toml", "measurements.csv", "-o", "hexapod.toml"],
        &["check", "hexapod.toml", "--picture", "hexapod.toml"],
        &["design", "hexapod.toml", "space.toml", "-o", "hexapod.toml"],
        &["predict", "model.toml", "hexapod.toml", "-o", "hexapod.toml"],
        &["compensate", "model.toml", "hexapod.toml", "-o", "hexapod.toml"],
        &["stiffness", "model.toml", "--poses", "hexapod.toml", "-o", "hexapod.toml"],
        &["transient", "hexapod.toml", "--load", "1,0,0,0,0,0", "-o", "hexapod.toml"],
        &["power", "hexapod.toml", "measurements.csv", "--svg", "hexapod.toml"],
        &["runs", "a.json", "hexapod.toml", "--json", "hexapod.toml"],
        &["poses", "hexapod.toml", "--balls", "balls.toml", "-o", "hexapod.toml"],
    ] {
        let output = bench.run(words);
        refused(&output, "hexapod.toml is an input of this command");
        assert_eq!(bench.read("hexapod.toml"), before, "{words:?}");
    }
}

#[test]
fn a_law_does_not_overwrite_the_term_it_was_searched_beside() {
    let bench = Bench::new();
    fs::write(bench.at("law-1.toml"), "a term").unwrap();
    let words = ["discover", "hexapod.toml", "measurements.csv", "--term", "law-1.toml", "--all", "."];
    refused(&bench.run(&words), "law-1.toml is an input of this command");
}

#[test]
fn two_outputs_in_one_place_are_refused() {
    let bench = Bench::new();
    let why = "only one would remain";
    refused(&bench.compare(&["--json", "x", "--html", "x"]), why);
    refused(&bench.compare(&["--json", "x", "--html", "./x"]), why);
    refused(&bench.compare(&["--json", "-", "--markdown", "-"]), why);
    assert!(!bench.at("x").exists());
}

#[test]
fn a_missing_folder_is_said_before_any_work() {
    let bench = Bench::new();
    let page = bench.run(&["diagnose", "hexapod.toml", "measurements.csv", "--html", "none/page.html"]);
    for output in [bench.fit(&["-o", "none/model.toml"]), page] {
        assert_eq!(output.status.code(), Some(5));
        let said = complaint(&output);
        assert!(said.contains("there is no folder") && said.contains("Create the folder first"), "{said}");
        assert!(output.stdout.is_empty(), "nothing is computed first");
    }
}

#[test]
fn a_file_in_the_place_of_a_folder_is_said_before_any_work() {
    let bench = Bench::new();
    let at_file = bench.fit(&["-o", "hexapod.toml/model.toml"]);
    assert_eq!(at_file.status.code(), Some(5));
    let said_of = complaint(&at_file);
    assert!(
        said_of.contains("hexapod.toml is a file, not a folder") && said_of.contains("Name a folder"),
        "{said_of}"
    );
    let scene = root().join("scenes/hidden-1");
    let folder = bench.run(&["simulate", scene.to_str().unwrap(), "-o", "hexapod.toml"]);
    refused(&folder, "hexapod.toml is a file, not a folder");
    let picture = bench.run(&["check", "hexapod.toml", "--picture", "measurements.csv/new/machine.svg"]);
    assert!(
        complaint(&picture).contains("measurements.csv is a file, not a folder"),
        "{}",
        complaint(&picture)
    );
}

#[test]
fn a_folder_that_a_command_makes_need_not_be_there() {
    let bench = Bench::new();
    let output = bench.run(&["check", "hexapod.toml", "--picture", "new/machine.svg"]);
    assert!(output.status.success() && bench.at("new/machine.svg").is_file(), "{}", complaint(&output));
}

#[cfg(unix)]
mod unix {
    use std::io::Read;
    use std::os::unix::fs::{FileTypeExt, symlink};
    use std::process::{Command, Stdio};

    use super::*;

    fn make(words: &[&str], at: &Path) -> bool {
        let (path, rest) = (at.to_str().unwrap(), &words[1..]);
        let made = Command::new(words[0]).arg(path).args(rest).stderr(Stdio::null()).status();
        made.is_ok_and(|status| status.success())
    }

    /// A shell in the folder, with the command as `$0`.
    fn shell(bench: &Bench, script: &str) -> Output {
        Command::new("sh")
            .current_dir(bench.0.path())
            .args(["-c", script, env!("CARGO_BIN_EXE_hexbench")])
            .output()
            .unwrap()
    }

    #[test]
    fn an_input_is_known_through_links() {
        let bench = Bench::new();
        let before = bench.read("measurements.csv");
        symlink("measurements.csv", bench.at("link")).unwrap();
        fs::hard_link(bench.at("measurements.csv"), bench.at("hard")).unwrap();
        for name in ["link", "hard"] {
            refused(&bench.compare(&["--json", name]), "(as measurements.csv)");
        }
        symlink("nowhere", bench.at("one")).unwrap();
        refused(&bench.compare(&["--json", "one", "--html", "nowhere"]), "only one would remain");
        assert_eq!(bench.read("measurements.csv"), before);
    }

    #[test]
    fn a_link_is_followed_and_its_target_replaced() {
        let bench = Bench::new();
        fs::create_dir(bench.at("there")).unwrap();
        fs::write(bench.at("there/old"), "old").unwrap();
        symlink("there/old", bench.at("first")).unwrap();
        symlink("there/new", bench.at("dangling")).unwrap();
        for (link, target) in [("first", "there/old"), ("dangling", "there/new")] {
            let output = bench.fit(&["-o", link]);
            assert!(output.status.success(), "{}", complaint(&output));
            assert!(fs::symlink_metadata(bench.at(link)).unwrap().is_symlink());
            assert!(bench.read(target).contains("model"), "{target}");
        }
    }

    #[test]
    fn a_pipe_receives_the_bytes_and_stays() {
        let bench = Bench::new();
        assert!(make(&["mkfifo"], &bench.at("pipe")));
        let path = bench.at("pipe");
        let reader = std::thread::spawn(move || {
            let mut text = String::new();
            fs::File::open(path).unwrap().read_to_string(&mut text).unwrap();
            text
        });
        let output = bench.compare(&["--json", "pipe"]);
        assert!(output.status.success(), "{}", complaint(&output));
        assert!(serde_json::from_str::<serde_json::Value>(&reader.join().unwrap()).is_ok());
        assert!(fs::metadata(bench.at("pipe")).unwrap().file_type().is_fifo());
    }

    /// Where nobody may make devices, the tests of pipes and links stand alone.
    #[test]
    fn a_device_is_never_replaced() {
        let bench = Bench::new();
        let devices = [("full", "7"), ("null", "3")];
        if !devices.iter().all(|(name, minor)| make(&["mknod", "c", "1", minor], &bench.at(name))) {
            return skipped("nobody may make devices here; pipes and links are tested");
        }
        let is_device = |name: &str| fs::metadata(bench.at(name)).unwrap().file_type().is_char_device();
        let full = bench.fit(&["-o", "full"]);
        assert_eq!(full.status.code(), Some(5), "{}", complaint(&full));
        let null = bench.compare(&["--json", "null", "--html", "null"]);
        assert!(null.status.success(), "{}", complaint(&null));
        assert!(is_device("full") && is_device("null"));
        assert_eq!(bench.remains(), [""; 0]);
    }

    #[test]
    fn standard_output_by_name_is_standard_output() {
        let bench = Bench::new();
        symlink("/proc/self/fd/1", bench.at("stdout")).unwrap();
        for name in ["stdout", "/dev/stdout", "-"] {
            let output = bench.compare(&["--json", name]);
            assert!(output.status.success(), "{}", complaint(&output));
            assert!(
                serde_json::from_slice::<serde_json::Value>(&output.stdout).is_ok(),
                "{name}: JSON alone"
            );
        }
        assert!(fs::symlink_metadata(bench.at("stdout")).unwrap().is_symlink());
        assert!(fs::symlink_metadata("/dev/stdout").unwrap().is_symlink());
    }

    /// The shell has opened the file: what is in it already stays in front.
    #[test]
    fn standard_output_that_is_a_file_is_written_on() {
        let bench = Bench::new();
        let compare = "compare hexapod.toml measurements.csv --json";
        let output = shell(&bench, &format!("echo first >out; \"$0\" {compare} /dev/stdout >>out"));
        assert!(output.status.success(), "{}", complaint(&output));
        assert!(bench.read("out").starts_with("first\n{"));
        let output = shell(&bench, &format!("\"$0\" {compare} out >out"));
        assert_eq!(output.status.code(), Some(2), "{}", complaint(&output));
        let before = bench.read("measurements.csv");
        let output = shell(&bench, &format!("\"$0\" {compare} x >>measurements.csv"));
        assert_eq!((output.status.code(), bench.read("measurements.csv")), (Some(2), before));
    }

    #[test]
    fn a_file_beyond_its_limit_leaves_the_old_one_and_nothing_else() {
        let bench = Bench::new();
        fs::write(bench.at("x.html"), "old").unwrap();
        let output = shell(&bench, "ulimit -f 1; \"$0\" compare hexapod.toml measurements.csv --html x.html");
        assert_eq!(output.status.code(), Some(5), "{}", complaint(&output));
        assert!(complaint(&output).contains("ulimit"), "{}", complaint(&output));
        assert_eq!((bench.read("x.html").as_str(), bench.remains().len()), ("old", 0));
    }

    /// The disk is mounted in a world of its own, where the system lets a test have one.
    #[test]
    fn a_full_disk_leaves_the_old_file_and_nothing_else() {
        let bench = Bench::new();
        fs::create_dir(bench.at("disk")).unwrap();
        let script =
            "unshare -m sh -c 'mount -t tmpfs -o size=16k none disk || exit 99; echo old >disk/x.html
            \"$0\" compare hexapod.toml measurements.csv --html disk/x.html
            echo code $?; ls -A disk; cat disk/x.html' \"$0\" || exit 99";
        let output = shell(&bench, script);
        if output.status.code() == Some(99) {
            return skipped("no disk may be mounted here; a file at its limit is tested");
        }
        assert_eq!(
            String::from_utf8_lossy(&output.stdout),
            "code 5\nx.html\nold\n",
            "{}",
            complaint(&output)
        );
    }

    #[test]
    fn what_a_killed_command_left_is_swept_by_the_next() {
        let bench = Bench::new();
        fs::write(bench.at(".hexbench-killed.part"), "half").unwrap();
        assert!(bench.fit(&["-o", "model.toml"]).status.success());
        assert_eq!(bench.remains(), [""; 0]);
    }
}
