//! An effect that no catalogue has: legs whose compliance repeats with the pitch of their ball screws.
//!
//! `cargo run --release -p hexbench --example own_term`. A term answers one question: what does one unit of each of its parameters do at
//! a pose and load? Diagnosis, fit and prediction take it from there.

use std::error::Error;
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

use hexbench::model::effects::term::{Chapter, ParameterInfo, Rich, Scale, TermInfo};
use hexbench::model::{effects::chain::Action, estimation::campaign::Condition, machine::geometry::Machine};
use hexbench::prelude::*;

/// Travel per period, m: from the data sheet of the screw.
const PITCH: f64 = 8e-3;

struct ScrewCompliance;

/// A compliance in nm/N, up to twice that of a typical leg, of any sign.
const fn amplitude(name: &'static str) -> ParameterInfo {
    ParameterInfo::new(name, "nm/N", 1e9, Scale::Compliance, false)
}

static INFO: TermInfo = TermInfo {
    id: "screw-compliance",
    title: "Leg compliance periodic in leg length",
    chapter: Chapter::Own,
    physics: "Balls enter and leave the nut of the screw once per pitch; the leg yields more where fewer carry.",
    equation: "e = (a sin(2 pi q / pitch) + b cos(2 pi q / pitch)) (f - f0)",
    source: "data sheet of the screw",
    shows: "poses lie at many leg lengths",
    how_to_isolate: "measure in small steps of leg length under one load",
    parameters: &[amplitude("sine"), amplitude("cosine")],
    shape: None,
    needs: &[],
    rich: Rich::None,
};

impl Term for ScrewCompliance {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    /// Extra elongation of each leg (m) per unit of each parameter (m/N), in the order of the parameters.
    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let force = at.force - at.reference_force;
        let phase = at.legs.lengths * (TAU / PITCH);
        out.push(Action::Elongation(force.component_mul(&phase.map(f64::sin))));
        out.push(Action::Elongation(force.component_mul(&phase.map(f64::cos))));
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases/not-in-catalogue");
    let hexapod = read_hexapod(&folder.join("hexapod.toml"))?;
    let data = read_measurements(&folder.join("measurements.csv"))?.dataset;
    let holdout = read_measurements(&folder.join("holdout.csv"))?.dataset;

    // The catalogue alone finds that something is missing, and describes it.
    let known = diagnose(&hexapod, &data, Some(&holdout), &catalogue())?.diagnosis;
    println!("catalogue: {:?}, {}", known.verdict, known.outside.map_or_else(String::new, |o| o.text));

    // With the term in the race it is named, and the held-out error is the noise.
    let own: Arc<dyn Term> = Arc::new(ScrewCompliance);
    let terms = [catalogue(), vec![Arc::clone(&own)]].concat();
    let found = diagnose(&hexapod, &data, Some(&holdout), &terms)?.diagnosis;
    println!("with the term: {:?}, {}", found.verdict, found.added.join(", "));
    let campaign = prepare(&hexapod, &data)?;
    let task = JudgedTask { hexapod: &hexapod, data: &data, campaign: &campaign, holdout: Some(&holdout) };
    let fitted = task.fit(&[Added::from(own)])?;
    println!("held-out error: {:.2} x noise", fitted.error().times_noise());
    for Estimate { name, value, std, unit } in estimates(&fitted.fit).determined {
        println!("  {name:<28} {value:>8.3} +- {std:.3} {unit}");
    }
    Ok(())
}

#[test]
fn the_example_runs() -> Result<(), Box<dyn Error>> {
    main()
}
