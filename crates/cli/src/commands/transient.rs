//! `hexbench transient HEXAPOD --load fx,fy,fz,mx,my,mz`.

use std::path::PathBuf;

use clap::Args;
use hexbench_core::{Hexapod, Measurand, Pose, Vector6, Wrench};

use hexbench_rapier::parts::Inertia;
use hexbench_rapier::transient::{LoadStep, SETTLED, Transient, csv, nominal, settle, static_deflection};
use hexbench_report::{Block, Page, Section, Table, number};

use crate::failure::Failure;
use crate::input;
use crate::numbers::{pose, positive, within, wrench};
use crate::output::{OutFile, Screen};

/// Simulate how the machine settles after a load step, and compute its natural frequencies
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench transient hexapod.toml --load 0,0,-200,0,0,0 --payload-kg 12 -o transient.csv")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Force (N) and moment (N m) at the mobile origin: fx,fy,fz,mx,my,mz
    #[arg(long, value_name = "WRENCH", value_parser = wrench, allow_hyphen_values = true)]
    load: Wrench,
    /// Pose (mm, deg): a,b,c,alpha,beta,gamma
    #[arg(long, value_name = "POSE", value_parser = pose, allow_hyphen_values = true, default_value = "0,0,0,0,0,0")]
    pose: Pose,
    /// Mass of the platform with its payload, kg; a disc of the radius of its joints
    #[arg(long, value_name = "MASS", value_parser = positive, default_value = "10")]
    payload_kg: f64,
    /// Mass of each leg, kg
    #[arg(long, value_name = "MASS", value_parser = positive, default_value = "1")]
    leg_kg: f64,
    /// Damping ratio of the lowest mode, 0.005 to 2
    #[arg(long, value_name = "RATIO", value_parser = ratio, default_value = "0.05")]
    damping_ratio: f64,
    /// Stiffness of every leg, N/um [default: `nominal_stiffness_N_per_um` of the file]
    #[arg(long, value_name = "STIFFNESS", value_parser = positive)]
    stiffness: Option<f64>,
    /// Write the trace to FILE (trace.csv)
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutFile>,
}

fn ratio(text: &str) -> Result<f64, String> {
    within(text, 0.005..=2.0, "0.005 to 2")
}

/// Settle, tell, save.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let stiffness = stiffness(arguments, &hexapod)?;
    if arguments.load == Wrench::default() {
        return Err(Failure::usage(
            "the load is zero, so nothing moves".to_owned(),
            "Give a force (N) or a moment (N m), for example `--load 0,0,-200,0,0,0`.",
        ));
    }
    let setup = nominal(&hexapod, &stiffness, arguments.pose, arguments.load)?;
    let standing = static_deflection(&setup)?;
    let step = LoadStep {
        platform: Inertia::disc(arguments.payload_kg, hexapod.platform_radius()),
        leg_mass: arguments.leg_kg,
        damping_ratio: arguments.damping_ratio,
    };
    let transient = settle(&setup, &step)?;
    screen.show(&page(&transient, &standing))?;
    arguments.output.as_ref().map_or(Ok(()), |path| screen.write_to(path, &csv(&transient.samples)))
}

fn stiffness(arguments: &Arguments, hexapod: &Hexapod) -> Result<[f64; 6], Failure> {
    let common = arguments.stiffness.map(|k| [k * 1e6; 6]);
    common.or(hexapod.nominal_stiffness).ok_or_else(|| {
        Failure::usage(
            format!("{} states no nominal_stiffness_N_per_um", arguments.hexapod.display()),
            "Add the stiffness of the legs: --stiffness 4 (N/um).",
        )
    })
}

fn page(transient: &Transient, standing: &Vector6) -> Page {
    let hz = transient.modes.frequencies_hz().map(|f| number::significant(f, 4)).join("  ");
    let seen = transient.observed_frequency_hz.map_or_else(
        || "The load barely excited the lowest mode, or it is damped too much.".to_owned(),
        |f| format!("The lowest mode was seen to swing at {} Hz.", number::significant(f, 4)),
    );
    let time = number::significant(transient.settling_time, 3);
    let row = |(name, deflection): (&str, &Vector6)| {
        let cells = deflection.iter().map(|d| format!("{:.3}", d * 1e6 + 0.0));
        std::iter::once(name.to_owned()).chain(cells).collect::<Vec<_>>()
    };
    let header = [""].into_iter().chain(Measurand::DeflectionEuler.names());
    let rows = [("end of the trace", &transient.limit()), ("static equilibrium", standing)].map(row);
    let modes = Section::new("Natural frequencies")
        .remark("linear leg springs, platform and legs with mass")
        .with(Block::code(format!("{hz}  Hz")))
        .paragraph(seen);
    let step = Section::new("After the load step")
        .remark("without gravity; um and urad")
        .paragraph(format!("Settled within {:.0} % of the deflection after {time} s.", 100.0 * SETTLED))
        .table(Table::named(header).rows(rows));
    Page::default().with(modes).with(step)
}
