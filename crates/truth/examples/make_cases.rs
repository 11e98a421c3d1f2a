//! Writes simulated campaigns with a hidden truth beside them.
//!
//! `make_cases --out DIR --seed N --count M --kinds single,pair,outside,clean,seed-protocol,absolute,rich-form,triple
//! [--distance D | --distance LOW:HIGH]`: M cases of each kind; the same seed gives the same bytes on any number of threads.

use std::{path::PathBuf, process::ExitCode};

use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use rayon::prelude::*;

struct Settings {
    out: PathBuf,
    seed: u64,
    count: usize,
    kinds: Vec<CaseKind>,
    distance: Option<[f64; 2]>,
}

fn main() -> ExitCode {
    match settings().and_then(|s| run(&s)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn run(settings: &Settings) -> Result<(), String> {
    eprintln!("seed {}", settings.seed);
    let jobs: Vec<(CaseKind, usize)> =
        settings.kinds.iter().flat_map(|&kind| (0..settings.count).map(move |i| (kind, i))).collect();
    let failures: Vec<String> =
        jobs.par_iter().filter_map(|&(kind, i)| one(settings, kind, i).err()).collect();
    for why in &failures {
        eprintln!("{why}");
    }
    eprintln!("{} cases in {}", jobs.len() - failures.len(), settings.out.display());
    if failures.is_empty() { Ok(()) } else { Err(format!("{} cases could not be made", failures.len())) }
}

fn one(settings: &Settings, kind: CaseKind, index: usize) -> Result<(), String> {
    let case = SimulatedCase::draw(kind, index, settings.seed, settings.distance)
        .map_err(|e| format!("{}-{index}: {e}", kind.name()))?;
    case.write(&settings.out.join(&case.spec.id)).map_err(|e| e.to_string())
}

fn settings() -> Result<Settings, String> {
    let mut s = Settings {
        out: PathBuf::from("cases"),
        seed: 1,
        count: 16,
        kinds: CaseKind::ALL.to_vec(),
        distance: None,
    };
    let mut words = std::env::args().skip(1);
    while let Some(option) = words.next() {
        let value = words.next().ok_or_else(|| format!("{option} needs a value"))?;
        match option.as_str() {
            "--out" => s.out = PathBuf::from(value),
            "--seed" => s.seed = number(&value)?,
            "--count" => s.count = number(&value)?,
            "--kinds" => s.kinds = value.split(',').map(kind).collect::<Result<_, _>>()?,
            "--distance" => s.distance = Some(range(&value)?),
            _ => return Err(format!("unknown option {option}")),
        }
    }
    Ok(s)
}

fn number<T: std::str::FromStr>(word: &str) -> Result<T, String> {
    word.parse().map_err(|_| format!("`{word}` is not a number this option takes"))
}

fn range(word: &str) -> Result<[f64; 2], String> {
    let (low, high) = word.split_once(':').unwrap_or((word, word));
    let range: [f64; 2] = [number(low)?, number(high)?];
    let good = range[0] > 0.0 && range[0] <= range[1] && range[1].is_finite();
    if good { Ok(range) } else { Err(format!("`{word}` is not a distance or a range LOW:HIGH")) }
}

fn kind(name: &str) -> Result<CaseKind, String> {
    CaseKind::ALL
        .into_iter()
        .find(|k| k.name() == name)
        .ok_or_else(|| format!("kind `{name}` is none of {}", CaseKind::ALL.map(CaseKind::name).join(", ")))
}
