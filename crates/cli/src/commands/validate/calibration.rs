//! `hexbench validate calibration`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_experiments::calibration::{
    self, Calibration, CalibrationProtocol, Curve, MOST_FALSE_NAMES, SEED, false_names, page, pictures,
    sheets, trials_csv,
};
use hexbench_experiments::trial::numbered;
use hexbench_report::render::markdown;
use hexbench_report::table::csv;
use hexbench_report::{Block, Definition, Section};
use hexbench_truth::campaign::CaseKind;

use super::written;
use crate::failure::Failure;
use crate::output::{OutPlace, Screen, TrialFiles};
use crate::shared::sole_experiment;

/// Check how far the stated probabilities can be trusted: effects, sizes, plans and machines with a known truth
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate calibration --out calibration")]
pub(crate) struct Arguments {
    /// Folder for the table of trials, the summary tables and the charts
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Number of campaigns to simulate, in the proportions of the protocol
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    trials: Option<u32>,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Also write the study to FILE as Markdown, and its charts to a folder next to it
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
    /// Write only the files of this trial, such as `pair-0007`
    #[arg(long, value_name = "TRIAL", conflicts_with_all = ["trials", "markdown", "check", "journal", "table"])]
    case: Option<String>,
    /// Exit with 1 if absent effects are named in significantly more than 1 % of the trials
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    kept: TrialFiles,
}

sole_experiment!(protocol);

fn protocol(arguments: &Arguments) -> CalibrationProtocol {
    let protocol = CalibrationProtocol::default().with_seed(arguments.seed);
    match arguments.trials {
        Some(trials) => protocol.with_trials(trials as usize),
        None => protocol,
    }
}

/// Run the study, write its files, tell the main figures.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    if let Some(trial) = &arguments.case {
        return write_case(trial, arguments, screen);
    }
    let protocol = protocol(arguments);
    let gathered = arguments.kept.run(&protocol)?;
    let study = Calibration::of(protocol, gathered);
    let written = write(&study, arguments, screen)?;
    screen.show(&page(&study, "charts").with(files(&written)))?;
    check(arguments.check, &study)
}

/// Folder by folder.
fn files(written: &[PathBuf]) -> Section {
    let folder = |group: &[PathBuf]| {
        let names: Vec<_> = group.iter().filter_map(|p| p.file_name()).map(|n| n.to_string_lossy()).collect();
        let folder = group[0].parent().unwrap_or(Path::new("")).join("");
        Definition::new(folder.display().to_string(), names.join(", "))
    };
    let groups = written.chunk_by(|a, b| a.parent() == b.parent());
    Section::new("Written").with(Block::entries(groups.map(folder)))
}

/// Returns the paths written.
fn write(study: &Calibration, arguments: &Arguments, screen: &Screen) -> Result<Vec<PathBuf>, Failure> {
    let out = &arguments.out;
    let mut files: Vec<(PathBuf, String)> = vec![(out.join("trials.csv"), trials_csv(&study.records))];
    files.extend(tables(study).map(|(name, text)| (out.join(name), text)));
    let charts = pictures(&study.records)?;
    files.extend(charts.iter().map(|c| (out.join(c.file), c.svg.clone())));
    if let Some(path) = &arguments.markdown {
        let (folder, beside) = written::charts_of(path);
        files.push((path.to_path_buf(), markdown(&page(study, &beside))));
        files.extend(charts.into_iter().map(|c| (folder.join(c.file), c.svg)));
    }
    written::write_all(files, screen)
}

fn tables(study: &Calibration) -> impl Iterator<Item = (&'static str, String)> {
    let records = &study.records;
    let curves: Vec<Curve> =
        [CaseKind::Single, CaseKind::Outside, CaseKind::RichForm, CaseKind::SeedProtocol]
            .into_iter()
            .flat_map(|kind| Curve::of_each(records, kind))
            .collect();
    let all = [
        ("fates.csv", sheets::fates(records)),
        ("confusion.csv", sheets::confusion(records)),
        ("scores.csv", sheets::all_scores(records)),
        ("scores-by-kind.csv", sheets::scores_by_kind(records)),
        ("reliability.csv", sheets::reliability(records, 0.0)),
        ("power.csv", sheets::power(&curves)),
        ("coverage.csv", sheets::coverage(records)),
        ("intervals.csv", sheets::intervals(records)),
        ("numbers.csv", sheets::numbers(records)),
        ("mistakes.csv", sheets::mistakes_table(records)),
    ];
    all.into_iter().map(|(name, table)| (name, csv::text(&table)))
}

fn write_case(trial: &str, arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let (kind, index) = parse(trial).ok_or_else(|| {
        let kinds = CaseKind::ALL.map(CaseKind::name).join(", ");
        written::no_trial(trial, format!("Use a kind and a number, such as pair-0007; kinds are {kinds}."))
    })?;
    let case = calibration::case(kind, index, arguments.seed)?;
    written::write_case(&case, &arguments.out.join(&case.spec.id), screen)
}

fn parse(trial: &str) -> Option<(CaseKind, usize)> {
    let (kind, index) = numbered(trial)?;
    Some((CaseKind::named(kind)?, index))
}

fn check(asked: bool, study: &Calibration) -> Result<(), Failure> {
    let found = false_names(&study.records);
    if !asked || !found.is_above(MOST_FALSE_NAMES) {
        return Ok(());
    }
    Err(Failure::Check(format!(
        "{} of {} trials name an effect that is not there, more than {} %",
        found.hits,
        found.of,
        100.0 * MOST_FALSE_NAMES
    )))
}
