//! Compares both worlds over many drawn cases: `cargo run --release -p hexbench-rapier --example witness -- --count N`.

use std::{path::PathBuf, process::ExitCode, sync::Arc};

use hexbench_rapier::{RapierStatics, cross_check};
use hexbench_truth::Statics;
use rayon::prelude::*;

const SEED: u64 = 20_240_917;
const USUAL_COUNT: usize = 434;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match count(&arguments) {
        Ok(count) => run(count),
        Err(why) => {
            eprintln!("{why}\nusage: witness [--count N]");
            ExitCode::from(2)
        }
    }
}

fn count(arguments: &[String]) -> Result<usize, String> {
    match arguments {
        [] => Ok(USUAL_COUNT),
        [name, value] if name == "--count" => match value.parse() {
            Ok(count) if count > 0 => Ok(count),
            _ => Err(format!("--count {value}: a whole number from 1 on is needed")),
        },
        _ => Err(format!("unknown arguments: {}", arguments.join(" "))),
    }
}

fn run(count: usize) -> ExitCode {
    let statics: Arc<dyn Statics> = Arc::new(RapierStatics::default());
    let compare = |index| {
        let case = cross_check::CrossCheckCase::draw(index, SEED);
        case.compare(&statics).map_err(|error| (index, case.effect_name(), error))
    };
    let (done, failed): (Vec<_>, Vec<_>) =
        (0..count).into_par_iter().map(compare).collect::<Vec<_>>().into_iter().partition(Result::is_ok);
    let done: Vec<_> = done.into_iter().flatten().collect();
    print!("seed {SEED}\n{}", cross_check::summary(&done));
    for (index, effect, error) in failed.iter().filter_map(|f| f.as_ref().err()) {
        println!("case {index} ({effect}): {error}");
    }
    let folder =
        std::env::var_os("HEXBENCH_ARTEFACTS").map_or_else(|| "target/artefacts".into(), PathBuf::from);
    let path = folder.join("rapier-witness.csv");
    match std::fs::create_dir_all(&folder).and_then(|()| std::fs::write(&path, cross_check::csv(&done))) {
        Ok(()) => println!("{}", path.display()),
        Err(error) => eprintln!("{}: {error}", path.display()),
    }
    if failed.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
