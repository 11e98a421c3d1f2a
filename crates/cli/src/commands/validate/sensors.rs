//! `hexbench validate sensors`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_experiments::sensors::{
    ALIKE, AlikeProtocol, SEED, SensorProtocol, TRIALS, alike, faults, page, ways,
};
use hexbench_report::table::csv;

use super::written;
use crate::failure::Failure;
use crate::output::{OutPlace, Screen, TrialFiles};
use crate::shared::{NamedWork, TrialCommand};

/// Journals of the two experiments.
const WAYS: &str = "ways";
const SAME: &str = "alike";

/// Report the quality of campaigns with gauges, balls, levels or scales instead of full poses, and with faulty
/// sensors
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate sensors --out sensors")]
pub(crate) struct Arguments {
    /// Folder for the tables of trials and the summary tables
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Number of campaigns per set of sensors, and half as many per fault: alternately on a clean machine and with one
    /// effect
    #[arg(long, value_name = "N", default_value_t = TRIALS, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    trials: u32,
    /// Number of campaigns read in equivalent ways: as a pose, three points and six distances, complete and with empty cells
    #[arg(long, value_name = "N", default_value_t = ALIKE, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    alike: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Also write the study to FILE as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
    /// Write only the files of this trial, such as `sensor-place/six-gauges-clean-0000`; for `alike/clean-0000`, one folder per
    /// way of reading
    #[arg(long, value_name = "TRIAL", conflicts_with_all = ["markdown", "journal", "table"])]
    case: Option<String>,
    #[command(flatten)]
    kept: TrialFiles,
}

impl TrialCommand for Arguments {
    fn kept(&self) -> &TrialFiles {
        &self.kept
    }

    fn works(&self) -> Result<Vec<NamedWork>, Failure> {
        let (ways, same) = protocols(self);
        Ok(vec![NamedWork::named(WAYS, ways), NamedWork::named(SAME, same)])
    }
}

fn protocols(arguments: &Arguments) -> (SensorProtocol, AlikeProtocol) {
    let seed = arguments.seed;
    let ways = SensorProtocol { seed, trials: arguments.trials as usize };
    (ways, AlikeProtocol { seed, campaigns: u64::from(arguments.alike) })
}

/// Run the study, write its files, tell the main figures.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let (protocol, same) = protocols(arguments);
    if let Some(trial) = &arguments.case {
        return write_trial((&protocol, &same), trial, &arguments.out, screen);
    }
    let (study, trials) = arguments.kept.of_one(WAYS).study_and_table(protocol)?;
    let (same, trials_of_same) = arguments.kept.of_one(SAME).study_and_table(same)?;
    let out = |name: &str| arguments.out.join(name);
    let files = vec![
        written::csv_file(out("trials.csv"), &trials)?,
        written::csv_file(out("alike-trials.csv"), &trials_of_same)?,
        (out("ways.csv"), csv::text(&ways(&study))),
        (out("faults.csv"), csv::text(&faults(&study))),
        (out("alike.csv"), csv::text(&alike(&same))),
    ];
    written::write_and_show(files, page(&study, &same), arguments.markdown.as_ref(), screen)
}

fn write_trial(
    (ways, alike): (&SensorProtocol, &AlikeProtocol),
    trial: &str,
    out: &Path,
    screen: &Screen,
) -> Result<(), Failure> {
    let folder = out.join(trial.replace('/', "-"));
    if let Some(case) = ways.case(trial) {
        return written::write_case(&case?, &folder, screen);
    }
    let cases = alike.cases(trial).ok_or_else(|| {
        written::no_trial(trial, "Give a group, a way of reading, a machine and a number, such as sensor-place/six-gauges-clean-0000, \
               scales/scales-single-0002 or alike/clean-0000; the tables of trials list them.")
    })?;
    for (way, case) in cases? {
        written::write_case(&case, &folder.join(way), screen)?;
    }
    Ok(())
}
