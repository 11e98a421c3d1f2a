//! Hide an effect in a simulated machine, find it, and compare with the truth.
//!
//! `cargo run --release -p hexbench --example simulate_and_recover`. The simulated world (`hexbench_truth`) solves the equilibrium at
//! finite deflection and shares no physics with what explains its readings (`hexbench`): this program is where the two meet.

use std::error::Error;
use std::path::Path;

use hexbench::prelude::*;
use hexbench_truth::scene::{PartName, Scene, VirtualBench};

/// Standard deviations within which an estimate agrees with the truth.
const AGREES: f64 = 4.0;

fn main() -> Result<(), Box<dyn Error>> {
    // A scene is a machine, a plan, an instrument, and what is hidden.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/hidden-1");
    let scene = Scene::read(&folder)?;
    let bench = VirtualBench::new(&scene, false);
    let [measurements, holdout] = [bench.dataset(PartName::Training)?, bench.dataset(PartName::Holdout)?];
    println!("{}: {} readings of {}", scene.name, measurements.observations.len(), scene.hexapod.name);

    // From here on nothing is known but the drawing of the machine and the readings.
    let study = diagnose(&scene.hexapod, &measurements, Some(&holdout), &catalogue())?;
    let Diagnosis { verdict, added, parameters, .. } = &study.diagnosis;
    println!("found:  {verdict:?} {}", added.join(", "));

    // The seal is broken.
    println!("hidden: {}", scene.hidden_effects().join(", "));
    assert_eq!(*added, scene.hidden_effects(), "the effect hidden is the effect named");
    println!("leg stiffness, N/um:");
    for (leg, truth) in (1..).zip(scene.leg_stiffness.map(|k| k * 1e-6)) {
        let name = format!("leg-{leg}.stiffness");
        let Some(found) = parameters.iter().find(|e| e.name == name) else { continue };
        let off = (found.value - truth) / found.std;
        println!(
            "  {name}  true {truth:.3}  found {:.3} +- {:.3}  ({off:+.1} sigma)",
            found.value, found.std
        );
        assert!(off.abs() < AGREES, "{name} is {off:.1} standard deviations off");
    }
    Ok(())
}

#[test]
fn the_example_runs() -> Result<(), Box<dyn Error>> {
    main()
}
