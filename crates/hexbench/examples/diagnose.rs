//! From files to a named effect, its size, and a prediction.
//!
//! `cargo run --release -p hexbench --example diagnose [FOLDER]` with hexapod.toml, measurements.csv and holdout.csv in FOLDER; without
//! one, measurements of a machine whose foundation yields, made by MuJoCo.

use std::error::Error;
use std::path::{Path, PathBuf};

use hexbench::prelude::*;

fn main() -> Result<(), Box<dyn Error>> {
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases/mujoco-foundation");
    let given = std::env::args().nth(1).map(PathBuf::from).filter(|path| path.is_dir());
    report(&given.unwrap_or(bundled))
}

fn report(folder: &Path) -> Result<(), Box<dyn Error>> {
    // Readers check a file completely; an error names line, column, value and next step.
    let hexapod = read_hexapod(&folder.join("hexapod.toml"))?;
    let measurements = read_measurements(&folder.join("measurements.csv"))?.dataset;
    let holdout = read_measurements(&folder.join("holdout.csv"))?.dataset;

    // Which effect do six springs lack? Every term of the catalogue competes; held-out poses have the last word.
    let study = diagnose(&hexapod, &measurements, Some(&holdout), &catalogue())?;
    let Diagnosis { verdict, added, add, candidates, steps, .. } = &study.diagnosis;
    println!("verdict: {verdict:?} {}", added.join(", "));
    for candidate in candidates.iter().take(3) {
        println!("  {:<24} probability {:.3}", candidate.term, candidate.probability);
    }
    println!("held-out error, one term after the other:");
    for step in steps {
        let model = step.terms.last().map_or("springs alone", String::as_str);
        if let Some(error) = step.holdout {
            println!("  {model:<24} {:.2} x noise", error.times_noise());
        }
    }

    // The same terms in the same forms, fitted by name: sizes in their own units, with standard uncertainties.
    let all = catalogue();
    let chosen = add.iter().map(|id| Added::named(id, &all)).collect::<Result<Vec<_>, _>>()?;
    let campaign = prepare(&hexapod, &measurements)?;
    let task =
        JudgedTask { hexapod: &hexapod, data: &measurements, campaign: &campaign, holdout: Some(&holdout) };
    let judged = task.fit(&chosen)?;
    println!("fitted:");
    for Estimate { name, value, std, unit } in estimates(&judged.fit).determined {
        println!("  {name:<32} {value:>8.3} +- {std:.3} {unit}");
    }

    // A model that can be kept (`to_toml`) and used: here for the first held-out pose and load.
    let model = Model::new(&campaign, &judged.fit, Estimator::Gls, DataOrigin::default());
    let asked = &holdout.observations[..1];
    for (Prediction { value, sigma }, reading) in predict(&model, asked)?.iter().zip(asked) {
        let [predicted, sigma, read] = [value[2], sigma[2], reading.measured[2]].map(|z| z * 1e6);
        println!("vertical deflection: predicted {predicted:.2} +- {sigma:.2} um, read {read:.2} um");
    }
    Ok(())
}

#[test]
fn the_example_runs() -> Result<(), Box<dyn Error>> {
    main()
}
