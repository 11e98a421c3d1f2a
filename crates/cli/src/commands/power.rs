//! `hexbench power HEXAPOD PLAN`.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use hexbench_core::{Hexapod, Measurand, Metrology};
use hexbench_design::nominal;
use hexbench_design::power::PowerSettings;
use hexbench_experiments::power::{Campaigns, PlanReport, Power, PowerPlan, Simulation, pictures};
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::fit_named::term_named;

use crate::failure::Failure;
use crate::input;
use crate::numbers::{positive, within};
use crate::output::{OutFile, OutPlace, Screen, TrialFiles, write_json, write_markdown};
use crate::shared::{NamedWork, TrialCommand};

/// Report which effects a plan can detect, how large they must be, and what each would be mistaken for
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench power hexapod.toml plan.csv\n  \
    hexbench power hexapod.toml measurements.csv --effect joint-friction --sigma 0.5,3")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Poses and loads to measure: plan.csv from `design`, or measurements.csv (measured values are ignored)
    plan: PathBuf,
    /// A term file of your own (term/1) in addition to the catalogue; may be given several times
    #[arg(long = "term", value_name = "FILE")]
    terms: Vec<PathBuf>,
    /// Report only this effect; may be given several times
    #[arg(long = "effect", value_name = "TERM")]
    effects: Vec<String>,
    /// False-alarm probability of each test
    #[arg(long, value_name = "CHANCE", value_parser = chance, default_value = "0.01")]
    alarm: f64,
    /// Required probability of detecting an effect
    #[arg(long, value_name = "CHANCE", value_parser = chance, default_value = "0.9")]
    power: f64,
    /// Check every effect with N campaigns in the simulated world, each with a complete diagnosis
    #[arg(long, value_name = "N", num_args = 0..=1, default_missing_value = "200", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    simulate: Option<u32>,
    /// Seed of samples, thresholds and campaigns
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// The plan measures absolute poses instead of deflections
    #[arg(long)]
    absolute: bool,
    /// Stiffness of every leg, N/um [default: `nominal_stiffness_N_per_um` of the machine, otherwise 4]
    #[arg(long, value_name = "STIFFNESS", value_parser = positive)]
    stiffness: Option<f64>,
    /// Noise of one reading, um and urad, instead of the noise in the files
    #[arg(long, value_name = "UM,URAD", value_parser = sigma)]
    sigma: Option<Sigma>,
    /// Assume that the noise will be estimated from the repeats of the plan
    #[arg(long)]
    noise_from_repeats: bool,
    /// Write all figures to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Write the charts to a folder, or only the heat map to a file (.svg)
    #[arg(long, value_name = "DIR")]
    svg: Option<OutPlace>,
    /// Write the page as Markdown to FILE
    #[arg(long, value_name = "FILE")]
    markdown: Option<OutFile>,
    #[command(flatten)]
    kept: TrialFiles,
}

/// Noise of one reading, m and rad.
#[derive(Debug, Clone, Copy)]
struct Sigma(Metrology);

fn chance(text: &str) -> Result<f64, String> {
    within(text, 1e-4..=0.9999, "0.0001 to 0.9999")
}

fn sigma(text: &str) -> Result<Sigma, String> {
    let parts: Vec<f64> = text.split(',').map(positive).collect::<Result<_, _>>()?;
    match parts[..] {
        [um, urad] => Ok(Sigma(Metrology { sigma_translation: um * 1e-6, sigma_rotation: urad * 1e-6 })),
        _ => Err(format!("{} numbers; two with a comma between are needed, such as 0.5,3", parts.len())),
    }
}

impl TrialCommand for Arguments {
    fn kept(&self) -> &TrialFiles {
        &self.kept
    }

    fn files(&mut self) -> Vec<&mut PathBuf> {
        [&mut self.hexapod, &mut self.plan].into_iter().chain(&mut self.terms).collect()
    }

    fn works(&self) -> Result<Vec<NamedWork>, Failure> {
        let terms = input::catalogue_with(&input::user_terms(&self.terms)?);
        known(&self.effects, &terms)?;
        Ok(NamedWork::only(campaigns(self, &plan(self)?, &terms)?))
    }
}

fn campaigns(arguments: &Arguments, plan: &PowerPlan, terms: &[Arc<dyn Term>]) -> Result<Campaigns, Failure> {
    let settings = PowerSettings {
        alarm: arguments.alarm,
        power: arguments.power,
        seed: arguments.seed,
        ..PowerSettings::default()
    };
    let campaigns = arguments.simulate.map_or(0, |n| n as usize);
    let simulation = Simulation { campaigns, diagnoses: campaigns > 0 };
    Ok(Campaigns::new(plan, terms, settings, simulation, &arguments.effects)?)
}

/// Study the plan, tell, save.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let terms = input::catalogue_with(&input::user_terms(&arguments.terms)?);
    known(&arguments.effects, &terms)?;
    refuse_power(arguments)?;
    let plan = plan(arguments)?;
    let power = studied(arguments, &plan, &terms)?;
    let page =
        PlanReport { plan: &plan, power: &power, only: &arguments.effects, verbose: screen.is_verbose() };
    write(arguments, &page, screen)?;
    screen.show_unless([&arguments.json, &arguments.markdown], || page.document())
}

fn known(ids: &[String], terms: &[Arc<dyn Term>]) -> Result<(), Failure> {
    ids.iter().try_for_each(|id| term_named(id, terms).map(|_| ()).map_err(Failure::of_name))
}

/// A test that noise passes more often than an effect tells nothing.
fn refuse_power(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.power > arguments.alarm {
        return Ok(());
    }
    let Arguments { power, alarm, .. } = arguments;
    let message = format!("a power of {power} is not above the false-alarm probability of {alarm}");
    Err(Failure::usage(message, "Give a larger `--power`, or a smaller `--alarm`."))
}

/// The plan with its machine and noise.
fn plan(arguments: &Arguments) -> Result<PowerPlan, Failure> {
    let mut hexapod = input::hexapod(&arguments.hexapod)?;
    refuse_for_sensors(arguments, &hexapod)?;
    let mut rows = input::plan_of(&hexapod, &arguments.plan)?;
    if arguments.absolute {
        rows.measurand = Measurand::AbsolutePose;
        refuse_references(arguments, rows.columns.reference)?;
    }
    if let Some(Sigma(stated)) = arguments.sigma {
        hexapod.metrology = Some(stated);
        rows.columns.sigma = false;
    }
    let stiffness = stiffness(arguments.stiffness, &hexapod);
    let plan = PowerPlan::new(hexapod, rows, stiffness).ok_or_else(|| {
        Failure::usage(
            format!(
                "neither {} nor {} states how well readings are taken",
                arguments.hexapod.display(),
                arguments.plan.display()
            ),
            "State [metrology] in the hexapod file, or add --sigma UM,URAD for one reading, such as 0.5,3.",
        )
    })?;
    if !arguments.noise_from_repeats {
        return Ok(plan);
    }
    plan.with_noise_from_repeats().ok_or_else(|| {
        Failure::usage(
            format!("{} repeats too few readings to estimate their noise", arguments.plan.display()),
            "Repeat at least three readings, or omit --noise-from-repeats.",
        )
    })
}

/// What is only known of full poses.
fn refuse_for_sensors(arguments: &Arguments, hexapod: &Hexapod) -> Result<(), Failure> {
    let options = [
        ("--simulate", arguments.simulate.is_some()),
        ("--absolute", arguments.absolute),
        ("--sigma", arguments.sigma.is_some()),
        ("--noise-from-repeats", arguments.noise_from_repeats),
    ];
    match options.into_iter().find(|o| o.1 && !hexapod.sensors.is_empty()) {
        None => Ok(()),
        Some((option, _)) => Err(Failure::usage(
            format!("{option} is for full poses, and {} has sensors", arguments.hexapod.display()),
            format!("Omit {option}, or remove the [[sensor]] tables."),
        )),
    }
}

fn refuse_references(arguments: &Arguments, has_references: bool) -> Result<(), Failure> {
    if !has_references {
        return Ok(());
    }
    Err(Failure::usage(
        format!("{} has ref_ columns, but absolute poses have no reference state", arguments.plan.display()),
        "Remove the ref_ columns, or omit --absolute.",
    ))
}

/// Given, or stated, or that of the paper's legs; N/m.
fn stiffness(given_n_per_um: Option<f64>, hexapod: &Hexapod) -> [f64; 6] {
    given_n_per_um.map_or_else(|| nominal::stiffness(hexapod), |k| [k * 1e6; 6])
}

fn studied(arguments: &Arguments, plan: &PowerPlan, terms: &[Arc<dyn Term>]) -> Result<Power, Failure> {
    let all = campaigns(arguments, plan, terms)?;
    let gathered = arguments.kept.run(&all)?;
    Ok(all.power(&gathered)?)
}

fn write(arguments: &Arguments, page: &PlanReport<'_>, screen: &Screen) -> Result<(), Failure> {
    write_json(screen, arguments.json.as_ref(), page.power)?;
    write_markdown(screen, arguments.markdown.as_ref(), &page.document())?;
    let Some(path) = &arguments.svg else { return Ok(()) };
    let charts = pictures(page.power)?;
    if path.extension().is_some_and(|e| e == "svg") {
        let heat_map = charts.first().map_or("", |c| c.svg.as_str());
        return screen.write_to(path, heat_map);
    }
    for chart in &charts {
        screen.write_into(path, chart.file, &chart.svg)?;
    }
    Ok(())
}
