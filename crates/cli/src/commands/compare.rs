//! `hexbench compare HEXAPOD DATA`.

use std::path::PathBuf;

use clap::Args;
use hexbench_app::memory::Computation;
use hexbench_core::Dataset;
use hexbench_core::files::atomic_write;
use hexbench_model::inference::misread::AsMeant;
use hexbench_model::results::compare::compare;
use hexbench_model::results::runs::WithOrigin;
use hexbench_report::space::glb;
use hexbench_report::words::{readings, subject};
use hexbench_report::{charts, words};

use crate::failure::Failure;
use crate::input::{self, MemoryLimit, MostReadings, TableNames, Trust};
use crate::numbers::positive;
use crate::output::{OutFile, PageFiles, Screen, TableFile, origin, provenance, write_json};
use crate::read_as::ReadAs;

/// Compare a model with measurements: errors relative to the noise, where they occur, what they correlate with
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench compare hexapod.toml measurements.csv --html residuals.html\n  \
    hexbench compare hexapod.toml measurements.csv --model model.toml --holdout holdout.csv\n  \
    hexbench compare hexapod.toml measurements.csv --gltf machine.glb")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Deflections or absolute poses: measurements.csv
    data: PathBuf,
    /// Compare this model (model.toml) without refitting; by default the leg springs are fitted to the data
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    #[command(flatten)]
    trust: Trust,
    /// Held-out readings, which no fit uses; they are compared too
    #[arg(long, value_name = "FILE")]
    holdout: Option<PathBuf>,
    #[command(flatten)]
    names: TableNames,
    #[command(flatten)]
    most: MostReadings,
    #[command(flatten)]
    memory: MemoryLimit,
    #[command(flatten)]
    read_as: ReadAs,
    /// Write all numbers to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Write every reading with its model value to FILE, for pandas, polars or xarray: .parquet or .csv; without `--most-readings`, all
    /// readings are used then
    #[arg(long, value_name = "FILE")]
    table: Option<TableFile>,
    /// Write a 3D model of the machine with its residuals to FILE: glTF 2.0, binary (.glb)
    #[arg(long, value_name = "FILE")]
    gltf: Option<OutFile>,
    #[command(flatten)]
    page: PageFiles,
    /// Exit with 1 unless the chi-square per degree of freedom (of the holdout if there is one) is below LIMIT
    #[arg(long, value_name = "LIMIT", value_parser = positive, allow_negative_numbers = true)]
    check: Option<f64>,
}

impl Arguments {
    /// The files read.
    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.hexapod, &self.data].into_iter().chain(&self.model).chain(&self.holdout)
    }
}

/// Write a scene in space, where there is one.
fn write_scene(file: &OutFile, scene: Option<Vec<u8>>) -> Result<(), Failure> {
    let Some(bytes) = scene else {
        let message =
            "no condition has readings that determine a motion of the platform, so there is nothing to draw";
        return Err(Failure::usage(message.to_owned(), "Omit `--gltf`; it needs readings of full poses."));
    };
    atomic_write(file, |out| out.write_all(&bytes)).map_err(Failure::unwritable(file))
}

/// Compare and tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let data = input::measurements(&hexapod, &arguments.data, &arguments.names)?;
    // A table of every reading has every reading.
    let has_all = arguments.table.is_some() && !arguments.most.is_given();
    let used = |rows: Dataset| if has_all { rows } else { arguments.most.of(rows, &[]) };
    let data = used(data);
    arguments.memory.refuse(Computation::Comparison, &data)?;
    let holdout =
        input::given_measurements(&hexapod, arguments.holdout.as_deref(), &arguments.names)?.map(used);
    let meant = AsMeant::of(&hexapod, &data, holdout.as_ref(), &arguments.read_as.changes);
    let (hexapod, data, holdout) = (&*meant.hexapod, &*meant.data, meant.holdout.as_deref());
    input::warn_of_misread(hexapod, data, &arguments.read_as);
    let model = arguments.model.as_deref().map(|path| arguments.trust.model(path)).transpose()?;
    input::warn_of_holdout(data, holdout);
    if let Some((model, path)) = model.as_ref().zip(arguments.model.as_deref()) {
        input::warn_of_other_machine(model, hexapod, path);
        input::warn_of_missing_columns(model, data, &arguments.data);
        if let Some((rows, path)) = holdout.zip(arguments.holdout.as_deref()) {
            input::warn_of_missing_columns(model, rows, path);
        }
    }
    let failed = Failure::of_model(&data.source);
    let mut compared = compare(hexapod, data, model.as_ref(), holdout).map_err(failed)?;
    compared.comparison.read_as = arguments.read_as.names();
    let result = &compared.comparison;
    if let Some(path) = &arguments.json {
        let run =
            origin((hexapod, &arguments.hexapod), (data, &arguments.data), arguments.holdout.as_deref())?;
        write_json(screen, Some(path), &WithOrigin { result, run })?;
    }
    if let Some(file) = &arguments.table {
        let frame = readings(hexapod, data, holdout, &compared).map_err(failed)?;
        file.write(frame, arguments.files())?;
    }
    if let Some(file) = &arguments.gltf {
        write_scene(file, glb(data, &compared).map_err(failed)?)?;
    }
    arguments.page.write(screen, || {
        let provenance = provenance(arguments.files())?;
        Ok(charts::comparison(hexapod, data, holdout, &compared, &provenance)?)
    })?;
    if !OutFile::any_is_stdout([&arguments.json]) && !arguments.page.to_stdout() {
        let about = subject::entries(data, holdout, &compared.campaign);
        screen.show(&words::comparison(&hexapod.name, about, result))?;
    }
    let reached = result.holdout.unwrap_or(result.error).chi2_reduced;
    match arguments.check {
        Some(limit) if reached.is_nan() || reached >= limit => {
            Err(Failure::Check(format!("the reduced chi-square is {reached:.3}, not below {limit}")))
        }
        _ => Ok(()),
    }
}
