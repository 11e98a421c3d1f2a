//! `hexbench validate misread`.

use std::path::PathBuf;

use clap::Args;
use hexbench_experiments::misread::{
    self, Misread, MisreadGroup, MisreadProtocol, MisreadScene, SEED, SOUND, TRIALS, page, sheets,
};
use hexbench_report::table::{Frame, csv};
use hexbench_truth::misstatements;

use super::{known, written};
use crate::failure::Failure;
use crate::output::{OutPlace, Screen, TrialFiles};
use crate::shared::{NamedWork, TrialCommand};

/// Check that misread files are detected: signs, units, axes, leg orders, frames, angles, rows
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate misread --out misread")]
pub(crate) struct Arguments {
    /// Folder for the table of trials and the summary tables
    #[arg(short = 'o', long, value_name = "DIR")]
    out: PathBuf,
    /// Number of campaigns per misstatement: the families of machines in turn, alternately clean and with one
    /// effect
    #[arg(long, value_name = "N", default_value_t = TRIALS, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    trials: u32,
    /// Number of campaigns without a misstatement
    #[arg(long, value_name = "N", default_value_t = SOUND, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    sound: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Run only this misstatement; may be given several times
    #[arg(long = "misstatement", value_name = "MISSTATEMENT", value_parser = misstatement)]
    misstatements: Vec<&'static str>,
    /// Folders of scenes that provide some of the campaigns without a misstatement
    #[arg(long, value_name = "SCENE", num_args = 1..)]
    scenes: Vec<PathBuf>,
    /// Also write the study to FILE as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
    /// Write only the files of this trial, such as `fz-negated/ring_a-clean-0000`
    #[arg(long, value_name = "TRIAL", conflicts_with_all = ["trials", "sound", "misstatements", "markdown", "journal", "table"])]
    case: Option<String>,
    #[command(flatten)]
    kept: TrialFiles,
}

fn misstatement(id: &str) -> Result<&'static str, String> {
    known(id, "misstatements", misstatements::registry().map(|entry| entry.id))
}

impl TrialCommand for Arguments {
    fn kept(&self) -> &TrialFiles {
        &self.kept
    }

    fn files(&mut self) -> Vec<&mut PathBuf> {
        self.scenes.iter_mut().collect()
    }

    fn works(&self) -> Result<Vec<NamedWork>, Failure> {
        Ok(NamedWork::only(protocol(self)?))
    }
}

/// Run the study, write its files, tell the main figures.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let protocol = protocol(arguments)?;
    if let Some(trial) = &arguments.case {
        return write_case(trial, &protocol, arguments, screen);
    }
    let (study, trials) = arguments.kept.study_and_table(protocol)?;
    let files = files(&study, &trials, arguments)?;
    written::write_and_show(files, page(&study), arguments.markdown.as_ref(), screen)
}

fn protocol(arguments: &Arguments) -> Result<MisreadProtocol, Failure> {
    let all = MisreadProtocol::default();
    let asked = &arguments.misstatements;
    let chosen = if asked.is_empty() { all } else { all.with_misstatements(asked) };
    let scenes = arguments.scenes.iter().map(|folder| MisreadScene::of(folder));
    Ok(MisreadProtocol {
        seed: arguments.seed,
        trials: arguments.trials as usize,
        sound: arguments.sound as usize,
        scenes: scenes.collect::<Result<_, _>>()?,
        ..chosen
    })
}

fn files(study: &Misread, trials: &Frame, arguments: &Arguments) -> Result<Vec<(PathBuf, String)>, Failure> {
    let out = |name: &str| arguments.out.join(name);
    let records = &study.records;
    let families = sheets::groups("family", &MisreadGroup::of_each(records, |r| &r.campaign.family));
    let plans = sheets::groups("plan", &MisreadGroup::of_each(records, |r| &r.campaign.plan));
    Ok(vec![
        written::csv_file(out("trials.csv"), trials)?,
        (out("misstatements.csv"), csv::text(&sheets::misstatements(records))),
        (out("families.csv"), csv::text(&families)),
        (out("plans.csv"), csv::text(&plans)),
        (out("false-alarms.csv"), csv::text(&sheets::false_alarms(records))),
        (out("refusals.csv"), csv::text(&sheets::refusals(records))),
    ])
}

fn write_case(
    trial: &str,
    protocol: &MisreadProtocol,
    arguments: &Arguments,
    screen: &Screen,
) -> Result<(), Failure> {
    let campaign = misread::case(trial, protocol).ok_or_else(|| {
        written::no_trial(trial, "Give a misstatement, a machine and a number, such as fz-negated/ring_a-clean-0000, or sound/single-10x-0002, or with \
               `--scenes` scene/cubic-3x-0015; `--misstatement x` lists the misstatements.")
    })?;
    let folder = arguments.out.join(trial.replace('/', "-"));
    campaign.and_then(|campaign| campaign.write(&folder))?;
    written::tell(&folder, screen)
}
