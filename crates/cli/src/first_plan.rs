//! `init --plan`: a plan to measure by, and the table that its readings go into.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_app::first_plan::first_plan;
use hexbench_core::files::{CsvText, conditions_to_columns};
use hexbench_core::{Dataset, Hexapod};
use hexbench_design::noise_to_come;
use hexbench_report::words::as_word;

use crate::failure::Failure;
use crate::output::Screen;

/// The plan that is asked for.
#[derive(Debug, Args)]
pub(crate) struct FirstPlan {
    /// Also write plan.csv, with the poses and loads to measure, and an empty measurements.csv for its readings
    #[arg(long)]
    plan: bool,
    /// Largest force of the plan, N
    #[arg(long, value_name = "N", default_value_t = 200.0, requires = "plan", allow_negative_numbers = true)]
    load: f64,
}

const PLAN: &str = "plan.csv";
const MEASUREMENTS: &str = "measurements.csv";
const READINGS: [&str; 8] =
    ["delta_T_K", "elapsed_s", "da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"];

/// Noise for a machine that states none: `power` refuses to guess.
const USUAL_NOISE: &str = " --sigma 0.5,3";

/// What stands above the empty table; no commas, so that a spreadsheet leaves a line in one cell.
const COMMENTS: &str = "\
# Fill in the last eight columns. A row is one reading: the deflection is loaded minus reference.
# 1. Go to the pose (a_mm to gamma_deg; {angles}). Put on the reference load (ref_fx_N to ref_mz_Nm) and read.
# 2. Put on the load (fx_N to mz_Nm) and read again. Loads act on the platform at its origin in fixed axes: what hangs down is fz_N < 0.
#    Write down the loads that were there if yours differ: the numbers here are a proposal.
# approach    1: straight to the load. -1: first go beyond it by 0.4 of the change of load and come back: friction and play show so.
# repeat      the same reading taken anew from the reference load on. It shows the noise.
# delta_T_K   temperature of the structure at the loaded reading minus at the reference reading. Remove the column if you have none.
# elapsed_s   seconds between the two readings. Remove the column if you have none.
# da_um to dgamma_urad   loaded minus reference: shift of the origin along fixed axes and changes of the three angles.
#    Rotation vectors: name the three columns drx_urad dry_urad drz_urad. A cell that was not read stays empty.
# Lines that begin with # are passed over. Other units: write them into the names (dc_mm or fz_kgf).
";

impl FirstPlan {
    /// Files that will be written; none unless a plan is asked for.
    ///
    /// # Errors
    /// A load that is no force.
    pub(crate) fn files(&self, machine: &Path) -> Result<Vec<PathBuf>, Failure> {
        if !(self.load.is_finite() && self.load > 0.0) {
            return Err(Failure::usage(
                format!("--load {}: a force is positive", self.load),
                "Enter the largest force that you can apply to the platform, in N.",
            ));
        }
        let files = [PLAN, MEASUREMENTS].into_iter().filter(|_| self.plan);
        Ok(files.map(|name| machine.with_file_name(name)).collect())
    }

    /// Writes both beside the machine.
    pub(crate) fn write(&self, hexapod: &Hexapod, machine: &Path, screen: &Screen) -> Result<(), Failure> {
        let files = self.files(machine)?;
        let [plan, measurements] = &files[..] else { return Ok(()) };
        let readings = first_plan(hexapod, self.load);
        screen.write_to(plan, &table(&readings, hexapod, &[]))?;
        let comments = COMMENTS.replace("{angles}", &format!("{} angles", hexapod.angles.word()));
        screen.write_to(measurements, &(comments + &table(&readings, hexapod, &READINGS)))
    }

    /// What to do next.
    pub(crate) fn next(&self, hexapod: &Hexapod, machine: &Path) -> String {
        let at = |name: &str| as_word(machine.with_file_name(name));
        let (machine, data) = (as_word(machine), at(MEASUREMENTS));
        let sigma = if noise_to_come(hexapod).is_some() { "" } else { USUAL_NOISE };
        let power = format!("hexbench power {machine} {}{sigma}\n", at(PLAN));
        let power = if self.plan { power.as_str() } else { "" };
        format!("{power}hexbench check {machine} {data}\nhexbench diagnose {machine} {data}")
    }
}

/// Poses and loads, and more columns that are empty.
fn table(readings: &Dataset, hexapod: &Hexapod, empty: &[&str]) -> String {
    let columns = conditions_to_columns(&hexapod.angles.as_stated(readings));
    let names = columns.iter().map(|(name, _)| name.as_str());
    let mut table = CsvText::new(names.chain(empty.iter().copied()));
    for row in 0..readings.observations.len() {
        let cells = columns.iter().map(|(_, values)| values[row].to_string());
        table.row(cells.chain(empty.iter().map(|_| String::new())));
    }
    table.into_text()
}
