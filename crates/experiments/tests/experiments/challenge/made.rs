//! What is made: the same bytes, nothing of the truth among what is handed out.

use std::fs;

use hexbench_core::files::{read_conditions, read_hexapod, read_measurements};
use hexbench_experiments::challenge::{Challenge, ChallengeError, make};
use hexbench_experiments::harness::Silent;

use super::support::{Bench, EVERY_SORT, ONE, files, suite};

#[test]
fn the_same_suite_and_seed_give_the_same_bytes_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let made = |name: &str, threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let place = folder.path().join(name);
        pool.install(|| make(&suite(EVERY_SORT).with_seed(seed), &place, &Silent)).unwrap();
        files(&place)
    };
    let one = made("one", 1, 11);
    assert!(one == made("four", 4, 11), "another number of threads, other bytes");
    let other = made("other", 2, 12);
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    // The machine is told by the suite, all else is drawn.
    let drawn =
        one.iter().filter(|(name, _)| !name.ends_with("README.md") && !name.ends_with("hexapod.toml"));
    for (name, bytes) in drawn {
        assert!(other[name] != *bytes, "{} does not follow the seed", name.display());
    }
}

#[test]
fn every_file_is_listed_with_its_digest_and_reads_back() {
    let bench = Bench::of(EVERY_SORT);
    let manifest = bench.challenge.manifest();
    assert_eq!(manifest.files.len() + 1, files(&bench.place()).len());
    bench.challenge.verify().unwrap();
    for id in &manifest.cases {
        let [public, sealed] = ["cases", "sealed"].map(|part| bench.place().join(part).join(id));
        assert_eq!(read_hexapod(&public.join("hexapod.toml")).unwrap().name, *id);
        assert!(read_measurements(&public.join("measurements.csv")).unwrap().warnings.is_empty());
        let asked = read_conditions(&public.join("predict.csv")).unwrap().dataset.observations;
        let [truth, measured] =
            ["true.csv", "measured.csv"].map(|name| read_measurements(&sealed.join(name)).unwrap().dataset);
        assert_eq!(asked.len(), truth.observations.len());
        for (row, (t, m)) in asked.iter().zip(truth.observations.iter().zip(&measured.observations)) {
            assert_eq!((row.pose, row.wrench, row.reference), (t.pose, t.wrench, t.reference));
            assert!((t.measured[0] - m.measured[0]).abs() > 0.0, "{id}: a reading has noise");
        }
    }
}

#[test]
fn what_is_handed_out_tells_nothing_of_the_truth() {
    let bench = Bench::of(EVERY_SORT);
    for (name, bytes) in files(&bench.place().join("cases")) {
        let text = String::from_utf8(bytes).unwrap();
        for word in ["clean", "single", "pair", "outside", "ring_", "seed", "few-poses", "out:", "expansion"]
        {
            assert!(!text.contains(word), "{} tells {word}", name.display());
        }
        let header = text.lines().next().unwrap();
        assert!(
            !name.ends_with("predict.csv") || (!header.contains("da_um") && !header.contains("measured_"))
        );
    }
}

#[test]
fn one_reading_of_each_condition_is_handed_out_where_the_suite_says_so() {
    let bench = Bench::of(EVERY_SORT);
    let repeats = |id: &String| {
        let path = bench.place().join("cases").join(id).join("measurements.csv");
        let readings = read_measurements(&path).unwrap().dataset.observations;
        readings.iter().map(|o| o.repeat).max().unwrap()
    };
    let mut found: Vec<i64> = bench.challenge.manifest().cases.iter().map(repeats).collect();
    found.sort_unstable();
    assert_eq!(found, [1, 2, 2, 2, 2]);
}

#[test]
fn a_file_that_changed_is_named() {
    let bench = Bench::of(ONE);
    for name in ["cases/case-001/measurements.csv", "sealed/case-001/truth.json", "README.md"] {
        let path = bench.place().join(name);
        let before = fs::read(&path).unwrap();
        let mut after = before.clone();
        let last = after.len() - 2;
        after[last] ^= 1;
        fs::write(&path, after).unwrap();
        let error = bench.challenge.verify().unwrap_err();
        assert!(
            matches!(&error, ChallengeError::Tampered { .. }) && error.to_string().contains(name),
            "{error}"
        );
        fs::write(&path, before).unwrap();
        bench.challenge.verify().unwrap();
    }
    fs::remove_dir_all(bench.place().join("sealed")).unwrap();
    bench.challenge.verify_public().unwrap();
    assert!(bench.challenge.verify().unwrap_err().to_string().contains("there is no such file"));
}

#[test]
fn a_folder_with_something_in_it_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mine.txt"), "x").unwrap();
    let made = make(&suite(ONE), folder.path(), &Silent);
    assert!(matches!(made, Err(ChallengeError::NotEmpty(_))));
    assert_eq!(files(folder.path()).len(), 1);
}

#[test]
fn a_manifest_that_is_none_is_told() {
    let folder = tempfile::tempdir().unwrap();
    assert!(Challenge::open(folder.path()).unwrap_err().to_string().contains("challenge.toml"));
    fs::write(folder.path().join("challenge.toml"), "format = \"challenge/1\"\n").unwrap();
    let error = Challenge::open(folder.path()).unwrap_err().to_string();
    assert!(error.contains("` is missing"), "{error}");
}
