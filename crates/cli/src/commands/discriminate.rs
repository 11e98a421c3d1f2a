//! `hexbench discriminate HEXAPOD SPACE --between TERM --between TERM`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use hexbench_core::{Dataset, Hexapod, Observation};
use hexbench_design::Space;
use hexbench_design::discriminate::{Contest, Distance, SeparatingPlan, candidate_readings};
use hexbench_design::noise_to_come;
use hexbench_design::nominal;
use hexbench_design::space_file::read_space;
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::fit_named::term_named;
use hexbench_model::estimation::noise::Noise;
use hexbench_model::results::diagnose::prepare;
use hexbench_model::results::next::{EXCLUDED_ODDS, Effort, PairForecast, Suspects, propose, suspects};
use hexbench_report::words::notes::read_by;

use crate::csv;
use crate::failure::Failure;
use crate::input::{self, TableNames};
use crate::output::{OutFile, Progress, Screen, write_json};
use crate::page::discriminated::{Discriminated, Pair, Planned, Promise, discriminated};

/// Readings of a new plan, and further ones beside data, unless asked otherwise.
const USUAL_READINGS: [u16; 2] = [12, 6];

/// Choose the readings that separate effects: a new plan, or the next readings to add to existing data
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench discriminate hexapod.toml space.toml --between base-compliance --between leg-coupling -o next.csv")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Allowed poses, and available loads and conditions: space.toml
    space: PathBuf,
    /// An effect to separate from the others; two or more
    #[arg(long, value_name = "TERM", required = true)]
    between: Vec<String>,
    /// A term file of your own (term/1) whose term `--between` may name
    #[arg(long = "term", value_name = "FILE")]
    terms: Vec<PathBuf>,
    /// Readings to choose (default: 12 for a new plan, 6 to add to existing data)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=200))]
    readings: Option<u16>,
    /// Existing measurements, to which the next readings are added
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,
    /// A plan to compare the new one with: poses and loads as in measurements.csv
    #[arg(long, value_name = "FILE", conflicts_with = "data")]
    against: Option<PathBuf>,
    /// Assumed effect size in a new plan: how many standard deviations each effect would stand out in evenly spread
    /// readings (5 is just visible)
    #[arg(long, value_name = "D", default_value = "20", conflicts_with = "data", value_parser = visibility)]
    visible: f64,
    /// Seed of the candidate poses
    #[arg(long, value_name = "S", default_value = "1")]
    seed: u32,
    /// Write the readings to FILE: measurements.csv without the measured columns
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutFile>,
    /// Write the result as JSON to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
}

fn visibility(text: &str) -> Result<f64, String> {
    let known = text.parse().ok().filter(|d: &f64| (0.1..=1e3).contains(d));
    known.ok_or_else(|| "a number from 0.1 to 1000".to_owned())
}

/// Choose, tell, save.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let space = read_space(&arguments.space, &hexapod)?.at_corners().with_loads_fixed();
    let own = input::user_terms(&arguments.terms)?;
    let terms = rivals(&arguments.between, &input::catalogue_with(&own))?;
    let found = match &arguments.data {
        None => new_plan(arguments, &hexapod, &space, &terms)?,
        Some(path) => next_readings(arguments, &hexapod, &space, &terms, path)?,
    };
    let to_stdout = arguments.json.as_ref().is_some_and(OutFile::is_stdout);
    if let Some(path) = &arguments.json {
        write_json(screen, path, &found.json())?;
    }
    if !to_stdout {
        screen.show(&discriminated(&found))?;
    }
    arguments.output.as_ref().map_or(Ok(()), |path| screen.write_to(path, &table(&found, &hexapod)))
}

fn rivals(ids: &[String], known: &[Arc<dyn Term>]) -> Result<Vec<Arc<dyn Term>>, Failure> {
    let twice = (1..ids.len()).any(|i| ids[..i].contains(&ids[i]));
    if ids.len() < 2 || twice {
        return Err(Failure::usage(
            "separating effects needs two different ones",
            "Add --between TERM twice; `hexbench terms` lists the terms.",
        ));
    }
    ids.iter().map(|id| term_named(id, known).map_err(Failure::of_name)).collect()
}

fn new_plan(
    arguments: &Arguments,
    hexapod: &Hexapod,
    space: &Space,
    terms: &[Arc<dyn Term>],
) -> Result<Discriminated, Failure> {
    let candidate_readings = candidate_readings(space, hexapod, terms, arguments.seed)?;
    let count = usize::from(arguments.readings.unwrap_or(USUAL_READINGS[0]));
    let contest = Contest::new(
        hexapod,
        nominal::compliance(hexapod),
        noise(hexapod)?,
        terms,
        &candidate_readings,
        count,
        arguments.visible,
    )?;
    let progress = Progress::of(count as u64, "readings");
    let plan =
        SeparatingPlan::search(&contest, space, hexapod, &candidate_readings, count, &|| progress.advance(1));
    progress.done();
    let plan = plan?;
    let before = arguments.against.as_ref().map(|path| distances(&contest, path, hexapod)).transpose()?;
    let names: Vec<String> = terms.iter().map(|t| t.info().id.to_owned()).collect();
    let promise = |distances: &[Distance], [a, b]: [usize; 2]| {
        let of = |pair: [usize; 2]| distances.iter().find(|d| d.of == pair).copied();
        of([a, b]).zip(of([b, a])).map(|(x, y)| Promise::of_distances([x, y]))
    };
    let pair = |between: [usize; 2]| {
        Some(Pair {
            between: between.map(|k| names[k].clone()),
            in_hand: None,
            before: before.as_ref().and_then(|d| promise(d, between)),
            after: promise(&plan.distances, between)?,
            readings_needed: needed(&plan.distances, between, count),
        })
    };
    let sizes = (0..contest.rivals()).map(|k| (names[k].clone(), contest.assumed(k)));
    Ok(Discriminated {
        format: "discrimination/1",
        data: None,
        readings: plan
            .readings
            .into_iter()
            .map(|r| Planned { observation: r.observation, repeats: r.repeats, words: r.words })
            .collect(),
        pairs: pairs(terms.len()).filter_map(pair).collect(),
        sizes: sizes.collect(),
        breakers: breakers(terms),
        candidates: candidate_readings.len(),
        tolerances: contest.tolerances(),
        read_by: read_by(&hexapod.sensors),
        seed: arguments.seed,
    })
}

fn next_readings(
    arguments: &Arguments,
    hexapod: &Hexapod,
    space: &Space,
    terms: &[Arc<dyn Term>],
    path: &Path,
) -> Result<Discriminated, Failure> {
    let data = input::measurements(hexapod, path, &TableNames::default())?;
    let source = path.display().to_string();
    let of_model = Failure::of_model(&source);
    let campaign = prepare(hexapod, &data).map_err(of_model)?;
    let Suspects { rivals, log_evidence } = suspects(&campaign, terms).map_err(of_model)?;
    let as_read = |o: Observation| {
        let measured = if data.is_absolute() { o.pose.to_array() } else { [0.0; 6] };
        Observation { measured, ..o }
    };
    let candidate_readings: Vec<Observation> =
        candidate_readings(space, hexapod, terms, arguments.seed)?.into_iter().map(as_read).collect();
    let count = usize::from(arguments.readings.unwrap_or(USUAL_READINGS[1]));
    let proposed =
        propose(&campaign, &rivals, &candidate_readings, Effort::Exactly(count)).map_err(of_model)?;
    let names: Vec<String> = terms.iter().map(|t| t.info().id.to_owned()).collect();
    let pair = |o: &PairForecast| {
        let [a, b] = o.between;
        let odds = log_evidence[a].zip(log_evidence[b]).map(|(a, b)| (a - b) / std::f64::consts::LN_10);
        Pair {
            between: o.between.map(|k| names[k].clone()),
            in_hand: odds,
            before: None,
            after: Promise::of(&o.separation),
            readings_needed: o.readings_needed,
        }
    };
    Ok(Discriminated {
        format: "discrimination/1",
        data: Some(source.clone()),
        pairs: proposed.forecasts.iter().map(pair).collect(),
        readings: proposed
            .proposals
            .into_iter()
            .map(|p| Planned { observation: p.observation, repeats: p.repeats, words: p.words })
            .collect(),
        sizes: Vec::new(),
        breakers: breakers(terms),
        candidates: candidate_readings.len(),
        tolerances: campaign.assumed_tolerances(),
        read_by: None,
        seed: arguments.seed,
    })
}

/// Readings like those of the plan after which the wrong one of a pair is on average excluded: information grows with their number.
fn needed(distances: &[Distance], pair: [usize; 2], count: usize) -> Option<usize> {
    const MOST: usize = 10_000;
    let own = distances.iter().filter(|d| d.of.iter().all(|k| pair.contains(k)));
    let least = own.map(Distance::log_likelihood_ratio).fold(f64::INFINITY, f64::min);
    let each = least / count as f64;
    (1..=MOST).find(|&n| n as f64 * each >= EXCLUDED_ODDS.ln())
}

fn pairs(rivals: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..rivals).flat_map(move |a| (a + 1..rivals).map(move |b| [a, b]))
}

fn breakers(terms: &[Arc<dyn Term>]) -> Vec<(String, String)> {
    terms.iter().map(|t| (t.info().id.to_owned(), t.info().how_to_isolate.to_owned())).collect()
}

/// Distances by the plan of a file.
fn distances(contest: &Contest<'_>, path: &Path, hexapod: &Hexapod) -> Result<Vec<Distance>, Failure> {
    let rows = input::conditions(path, &TableNames::default(), hexapod)?.observations;
    let informations = contest.informations(&rows)?;
    let total = informations.iter().skip(1).fold(informations[0].clone(), |sum, m| sum + m);
    Ok(contest.distances(&total))
}

fn noise(hexapod: &Hexapod) -> Result<Noise, Failure> {
    noise_to_come(hexapod).ok_or_else(|| Failure::usage("how well readings separate effects depends on their noise, which the hexapod file does not state", "Add [metrology] with sigma_translation_um and sigma_rotation_urad."))
}

/// The readings, each repeat in a row of its own.
fn table(found: &Discriminated, hexapod: &Hexapod) -> String {
    let repeated = (1..).zip(&found.readings).flat_map(|(pose_id, r)| {
        (1..).take(r.repeats).map(move |repeat| Observation { pose_id, repeat, ..r.observation })
    });
    csv::conditions(&Dataset::of_deflections("", repeated.collect()), hexapod)
}
