//! No source makes a generator of its own.

use std::fs;
use std::path::{Path, PathBuf};

/// What makes generators: the streams, and the tests that measure them.
const ROOMS: [&str; 2] = ["core/src/streams.rs", "core/tests/core/streams"];
/// Folders of a crate that hold sources.
const FOLDERS: [&str; 4] = ["src", "tests", "benches", "examples"];
/// Ways to make a generator that is not a hashed stream.
const BARE: [&str; 5] = ["Pcg64::new(", "Pcg64::from_", "Pcg64Mcg", "seed_from_u64", "SeedableRng"];

/// Sentences about what a source does and should not.
fn violations(file: &str, text: &str) -> Vec<String> {
    let found = BARE.iter().filter(|bare| text.contains(**bare));
    found.map(|bare| format!("{file}: {bare} instead of hexbench_core::streams::stream")).collect()
}

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Rust files below a folder.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let below = folders.iter().flat_map(|folder| rust_files(folder));
    below.chain(files.into_iter().filter(|file| file.extension().is_some_and(|e| e == "rs"))).collect()
}

#[test]
fn every_random_number_comes_from_a_hashed_stream() {
    let all = fs::read_dir(crates()).unwrap().map(|entry| entry.unwrap().path());
    let folders = all.flat_map(|package| FOLDERS.map(|folder| package.join(folder)));
    let files: Vec<PathBuf> = folders.filter(|f| f.is_dir()).flat_map(|f| rust_files(&f)).collect();
    let is_room = |file: &Path| ROOMS.iter().any(|room| file.to_string_lossy().contains(room));
    let (rooms, others): (Vec<_>, Vec<_>) = files.iter().partition(|file| is_room(file));
    assert!(rooms.len() > 1 && others.len() > 100, "{} files", files.len());
    let found: Vec<String> = others
        .into_iter()
        .flat_map(|file| violations(&file.display().to_string(), &fs::read_to_string(file).unwrap()))
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_generator_made_elsewhere_is_found() {
    assert_eq!(violations("x.rs", "let mut rng = stream(seed, Purpose::CaseNoise, [row]);"), [""; 0]);
    assert_eq!(violations("x.rs", "let mut rng = Pcg64::new(u128::from(seed), 1);").len(), 1);
    assert_eq!(violations("x.rs", "let mut rng = SmallRng::seed_from_u64(7);").len(), 1);
}
