//! `hexbench validate power`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use hexbench_design::power::PowerSettings;
use hexbench_experiments::power::{Campaigns, PowerPlan, Simulation, Studied, document, pictures, plan_of};
use hexbench_model::effects::term::Term;
use hexbench_report::Page;
use hexbench_report::render::markdown;
use hexbench_truth::Scene;

use super::written;
use crate::failure::Failure;
use crate::input;
use crate::output::{OutPlace, Screen, TrialFiles};
use crate::shared::{NamedWork, TrialCommand};

/// Report which effects the plan of the paper and a richer plan can detect, computed and counted in the simulated world
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench validate power")]
pub(crate) struct Arguments {
    /// Scene with the plain plan
    #[arg(long, value_name = "SCENE", default_value = "scenes/paper")]
    plain: PathBuf,
    /// Scene with the rich plan
    #[arg(long, value_name = "SCENE", default_value = "scenes/paper-rich")]
    rich: PathBuf,
    /// Number of campaigns per effect and size
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    campaigns: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Write the page to FILE as Markdown, and its charts to a folder next to it
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutPlace>,
    #[command(flatten)]
    kept: TrialFiles,
}

impl TrialCommand for Arguments {
    fn kept(&self) -> &TrialFiles {
        &self.kept
    }

    fn files(&mut self) -> Vec<&mut PathBuf> {
        vec![&mut self.plain, &mut self.rich]
    }

    fn works(&self) -> Result<Vec<NamedWork>, Failure> {
        let terms = input::catalogue_with(&[]);
        let one = |folder: &Path| -> Result<NamedWork, Failure> {
            let (name, _, all) = campaigns(self, folder, &terms)?;
            Ok(NamedWork::named(&name, all))
        };
        Ok(vec![one(&self.plain)?, one(&self.rich)?])
    }
}

/// Name of a scene, its plan, and the campaigns that check it.
fn campaigns(
    arguments: &Arguments,
    folder: &Path,
    terms: &[Arc<dyn Term>],
) -> Result<(String, PowerPlan, Campaigns), Failure> {
    let scene = Scene::read(folder)?;
    let plan = plan_of(&scene)?;
    let simulation = Simulation { campaigns: arguments.campaigns as usize, diagnoses: true };
    let settings = PowerSettings { seed: arguments.seed, ..PowerSettings::default() };
    let all = Campaigns::new(&plan, terms, settings, simulation, &[])?;
    Ok((scene.name, plan, all))
}

/// Study both plans, print the page, write the files.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let terms = input::catalogue_with(&[]);
    let one = |folder: &Path| -> Result<Studied, Failure> {
        let (name, plan, all) = campaigns(arguments, folder, &terms)?;
        let gathered = arguments.kept.of_one(&name).run(&all)?;
        let power = all.power(&gathered)?;
        Ok(Studied::new(&name, plan, power)?)
    };
    let (plain, rich) = (one(&arguments.plain)?, one(&arguments.rich)?);
    write(arguments, &plain, &rich, screen)?;
    screen.show(&page(arguments, &plain, &rich, "power"))
}

fn write(arguments: &Arguments, plain: &Studied, rich: &Studied, screen: &Screen) -> Result<(), Failure> {
    let Some(path) = &arguments.markdown else { return Ok(()) };
    let (folder, beside) = written::charts_of(path);
    screen.write_with_folder(path, &markdown(&page(arguments, plain, rich, &beside)))?;
    for studied in [plain, rich] {
        for chart in pictures(&studied.power)? {
            screen.write_into(&folder, &format!("{}-{}", studied.name, chart.file), &chart.svg)?;
        }
    }
    Ok(())
}

fn page(arguments: &Arguments, plain: &Studied, rich: &Studied, charts: &str) -> Page {
    let again = format!(
        "hexbench validate power --campaigns {} --seed {} --markdown docs/results/power.md",
        arguments.campaigns, arguments.seed
    );
    document(plain, rich, charts, &again)
}
