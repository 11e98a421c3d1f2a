//! `hexbench validate robustness`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::robustness::{self, RobustnessProtocol, SEED, TRIALS, page, sheets};
use hexbench_report::table::csv;
use hexbench_truth::laboratory;

use super::{known, written};
use crate::failure::Failure;
use crate::output::{OutPlace, Screen, TrialFiles};
use crate::shared::sole_experiment;

/// Report how laboratory faults change the answer: wrong numbers, misstated noise, joints and loads that differ from the
/// drawing
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate robustness --out robustness")]
pub(crate) struct Arguments {
    /// Folder for the table of trials and the summary tables
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Number of campaigns per fault: alternately on a clean machine and with one effect
    #[arg(long, value_name = "N", default_value_t = TRIALS, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    trials: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Run only this fault and the control; may be given several times
    #[arg(long = "fault", value_name = "FAULT", value_parser = fault)]
    faults: Vec<&'static str>,
    /// Also write the study to FILE as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
    /// Write only the files of this trial, such as `outlier-20/clean-0003`
    #[arg(long, value_name = "TRIAL", conflicts_with_all = ["trials", "faults", "markdown", "journal", "table"])]
    case: Option<String>,
    #[command(flatten)]
    kept: TrialFiles,
}

fn fault(id: &str) -> Result<&'static str, String> {
    known(id, "faults", laboratory::registry().map(|entry| entry.id))
}

sole_experiment!(protocol);

fn protocol(arguments: &Arguments) -> RobustnessProtocol {
    let all = RobustnessProtocol::default();
    let chosen = if arguments.faults.is_empty() { all } else { all.with_faults(&arguments.faults) };
    RobustnessProtocol { seed: arguments.seed, trials: arguments.trials as usize, ..chosen }
}

/// Run the study, write its files, tell the main figures.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    if let Some(trial) = &arguments.case {
        return write_case(trial, arguments, screen);
    }
    let (study, trials) = arguments.kept.study_and_table(protocol(arguments))?;
    let out = |name: &str| arguments.out.join(name);
    let records = &study.records;
    let files = vec![
        written::csv_file(out("trials.csv"), &trials)?,
        (out("violations.csv"), csv::text(&sheets::violations(records))),
        (out("findings.csv"), csv::text(&sheets::findings(records))),
        (out("counts.csv"), csv::text(&sheets::counts(records))),
        (out("verdicts.csv"), csv::text(&sheets::verdicts(records))),
        (out("mistakes.csv"), csv::text(&sheets::mistakes_table(records))),
    ];
    written::write_and_show(files, page(&study), arguments.markdown.as_ref(), screen)
}

fn write_case(trial: &str, arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let case = robustness::case(trial, arguments.seed).ok_or_else(|| {
        written::no_trial(trial, "Give a fault, a machine and a number, such as outlier-20/clean-0003 or joints-0.1mm/single-0002; \
               `--fault x` lists the faults.")
    })?;
    let case = case?;
    written::write_case(&case, &arguments.out.join(trial.replace('/', "-")), screen)
}
