//! Every reading beside what a model says of it: a table for other programs.

use hexbench_core::files::MeasurementsWriter;
use hexbench_core::{Channel, Columns, Dataset, Hexapod, Observation};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::{Campaign, row_sigma};
use hexbench_model::results::compare::{ComparedModel, JudgedModel};

use crate::table::{DataColumn, Frame, TableValues};

/// Name of the table's format.
const FORMAT: &str = "readings/1";
/// Columns of the measured values.
const COORDINATES: usize = 6;

/// The readings compared, then the held-out ones: what was commanded and applied, what was measured, what the model predicts, what is
/// left, the same in units of the noise, and leg forces, leg lengths and residual leg elongations. One row per reading, in the units of
/// `measurements.csv`; fixed frame, forces in tension positive.
///
/// # Errors
/// [`ModelError::SingularPose`].
pub fn readings(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    compared: &ComparedModel,
) -> Result<Frame, ModelError> {
    let held = holdout
        .map(|rows| Campaign::held_out(hexapod, rows, compared.campaign.noise, &compared.point.machine))
        .transpose()?;
    let mut parts = vec![Part::new("measurements", &compared.campaign, data, compared)?];
    if let (Some(rows), Some(campaign)) = (holdout, &held) {
        parts.push(Part::new("holdout", campaign, rows, compared)?);
    }
    Ok(Frame { format: FORMAT, origin: Vec::new(), columns: columns(&parts) })
}

/// Readings with the model at them.
struct Part<'a> {
    name: &'static str,
    data: &'a Dataset,
    judged: JudgedModel<'a>,
    campaign: &'a Campaign,
}

/// A reading, its residual, its condition.
#[derive(Clone, Copy)]
struct At<'a> {
    part: &'a Part<'a>,
    row: usize,
}

impl<'a> Part<'a> {
    fn new(
        name: &'static str,
        campaign: &'a Campaign,
        data: &'a Dataset,
        compared: &'a ComparedModel,
    ) -> Result<Self, ModelError> {
        Ok(Self { name, data, judged: JudgedModel::of(campaign, data, &compared.point, false)?, campaign })
    }
}

impl<'a> At<'a> {
    fn reading(self) -> &'a Observation {
        &self.part.data.observations[self.row]
    }

    fn condition(self) -> usize {
        self.part.judged.rows[self.row].condition
    }

    /// Residual, m and rad.
    fn residual(self, k: usize) -> f64 {
        self.part.judged.rows[self.row].value[k]
    }

    /// Standard deviation, m and rad.
    fn sigma(self, k: usize) -> f64 {
        row_sigma(self.reading(), &self.part.campaign.noise)[k]
    }

    /// Which of its six numbers a channel is; none where it was not read.
    fn place_of(self, channel: Channel) -> Option<usize> {
        self.part.data.place_of(self.reading(), channel)
    }

    /// True for numbers of one row of a file.
    fn shares_line(&self, next: &Self) -> bool {
        let (one, other) = (self.reading(), next.reading());
        std::ptr::eq(self.part, next.part) && one.line == other.line && one.block != other.block
    }

    /// The reading the model expects.
    fn predicted(self) -> Observation {
        let mut expected = *self.reading();
        let back = std::array::from_fn(|k| -self.residual(k));
        expected.measured = self.part.campaign.axes.moved(&expected.measured, &back);
        expected
    }
}

fn columns(parts: &[Part<'_>]) -> Vec<DataColumn> {
    let readings: Vec<At<'_>> =
        parts.iter().flat_map(|part| (0..part.judged.rows.len()).map(move |row| At { part, row })).collect();
    let lines: Vec<&[At<'_>]> = readings.chunk_by(At::shares_line).collect();
    let rows: Vec<At<'_>> = lines.iter().map(|line| line[0]).collect();
    let mut all = vec![
        words(
            "part",
            "the readings compared (measurements), or those held out",
            rows.iter().map(|at| at.part.name),
        ),
        whole(
            "line",
            "line of its file, from 1",
            rows.iter().map(|at| i64::try_from(at.reading().line).unwrap_or(0)),
        ),
    ];
    if parts.iter().all(|part| part.campaign.reads_poses) {
        all.extend(stated(parts, &rows));
        all.extend(judged(parts, &rows));
    } else {
        all.extend(of_channels(parts, &rows, &lines));
    }
    all.extend(legs(&rows));
    all
}

/// A value of one of the six numbers of a reading.
type Value = fn(At<'_>, usize) -> f64;

/// The same of readings that are no full poses: each under the name of its sensor or of its pose number, empty where nothing was read.
fn of_channels(parts: &[Part<'_>], rows: &[At<'_>], lines: &[&[At<'_>]]) -> Vec<DataColumn> {
    let file = MeasurementsWriter::conditions(optional(parts));
    let names: Vec<String> = file.names().collect();
    let stated = (0..names.len()).map(|k| stated_column(&file, &names[k], k, "as stated in the file", rows));
    let mut channels: Vec<Channel> = Vec::new();
    for channel in parts.iter().flat_map(|part| part.data.all_channels()) {
        if !channels.contains(&channel) {
            channels.push(channel);
        }
    }
    let sensors = &parts[0].campaign.hexapod.sensors;
    let measurand = parts[0].data.measurand;
    let kinds: [(&str, &str, Value); 5] = [
        ("", "as measured", |at, k| at.reading().measured[k] * 1e6),
        ("predicted_", "as the model predicts", |at, k| (at.reading().measured[k] - at.residual(k)) * 1e6),
        ("residual_", "measured minus predicted", |at, k| at.residual(k) * 1e6),
        ("sigma_", "standard deviation of the reading", |at, k| at.sigma(k) * 1e6),
        ("whitened_", "residual over its standard deviation", |at, k| {
            at.part.judged.rows[at.row].whitened[k]
        }),
    ];
    let read = |(prefix, meaning, value): (&str, &str, Value)| {
        let column = |&channel: &Channel| {
            let cell = |line: &&[At<'_>]| line.iter().find_map(|at| Some(value(*at, at.place_of(channel)?)));
            let name = format!("{prefix}{}", channel.name(sensors, measurand));
            let unit = channel.unit(sensors);
            let cells = lines.iter().map(|line| cell(line).unwrap_or(f64::NAN));
            if prefix == "whitened_" {
                numbers(&name, "", meaning, cells)
            } else {
                numbers(&format!("{name}_{unit}"), unit, meaning, cells)
            }
        };
        channels.iter().map(column).collect::<Vec<_>>()
    };
    stated.chain(kinds.into_iter().flat_map(read)).collect()
}

/// What the files say, in their own columns, and the predicted values in the same.
fn stated(parts: &[Part<'_>], rows: &[At<'_>]) -> Vec<DataColumn> {
    let file = MeasurementsWriter::new(parts[0].data.measurand, optional(parts));
    let names: Vec<String> = file.names().collect();
    let measured = names.len() - COORDINATES..names.len();
    let column = |k: usize| {
        let meaning = if measured.contains(&k) { "as measured" } else { "as stated in the file" };
        stated_column(&file, &names[k], k, meaning, rows)
    };
    let predicted = |k: usize| {
        let name = format!("predicted_{}", names[k].trim_start_matches("measured_"));
        numbers(
            &name,
            file.unit(k),
            "as the model predicts",
            rows.iter().map(|at| file.value(k, &at.predicted())),
        )
    };
    (0..names.len()).map(column).chain(measured.clone().map(predicted)).collect()
}

/// Optional columns that any of the files has, but for standard deviations.
fn optional(parts: &[Part<'_>]) -> Columns {
    let has = |of: fn(Columns) -> bool| parts.iter().any(|part| of(part.data.columns));
    Columns {
        reference: has(|c| c.reference),
        approach: has(|c| c.approach),
        overload: has(|c| c.overload),
        delta_t: has(|c| c.delta_t),
        elapsed: has(|c| c.elapsed),
        reference_age: has(|c| c.reference_age),
        reference_record: has(|c| c.reference_record),
        order: has(|c| c.order),
        sigma: false,
    }
}

/// A column of the files as they have it.
fn stated_column(
    file: &MeasurementsWriter,
    name: &str,
    k: usize,
    meaning: &str,
    rows: &[At<'_>],
) -> DataColumn {
    let cells = rows.iter().map(|at| file.value(k, at.reading()));
    match name {
        // Numbers of poses and repeats are whole.
        #[allow(clippy::cast_possible_truncation)]
        "pose" | "repeat" => whole(name, meaning, cells.map(|x| x as i64)),
        name => numbers(name, file.unit(k), meaning, cells),
    }
}

/// Residuals, in um and urad, their standard deviations by noise, and both divided.
fn judged(parts: &[Part<'_>], rows: &[At<'_>]) -> Vec<DataColumn> {
    let names = parts[0].data.measurand.names();
    let unit = |k: usize| if k < 3 { "um" } else { "urad" };
    let residual = |k: usize| {
        let name = format!("residual_{}_{}", names[k], unit(k));
        numbers(&name, unit(k), "measured minus predicted", rows.iter().map(move |at| at.residual(k) * 1e6))
    };
    let sigma = |k: usize| {
        let name = format!("sigma_{}_{}", names[k], unit(k));
        let noise = rows.iter().map(move |at| at.sigma(k) * 1e6);
        numbers(&name, unit(k), "standard deviation of the reading", noise)
    };
    let whitened = |k: usize| {
        let over = rows.iter().map(move |at| at.part.judged.rows[at.row].whitened[k]);
        numbers(&format!("whitened_{}", names[k]), "", "residual over its standard deviation", over)
    };
    let six = 0..COORDINATES;
    six.clone().map(residual).chain(six.clone().map(sigma)).chain(six.map(whitened)).collect()
}

/// Forces, lengths and residual elongations of the legs; those of averaged readings are repeated for each.
fn legs(rows: &[At<'_>]) -> Vec<DataColumn> {
    let at = |at: &At<'_>| at.condition();
    let force = |leg: usize| {
        let forces = rows.iter().map(move |r| r.part.judged.lin.conditions[at(r)].force[leg]);
        numbers(
            &format!("leg_{}_force_N", leg + 1),
            "N",
            "force in the leg spring under the load, tension positive",
            forces,
        )
    };
    let length = |leg: usize| {
        let lengths = rows.iter().map(move |r| r.part.judged.lin.conditions[at(r)].legs.lengths[leg] * 1e3);
        numbers(&format!("leg_{}_length_mm", leg + 1), "mm", "length of the leg at the pose", lengths)
    };
    let left = |leg: usize| {
        let left = rows.iter().map(move |r| {
            let space = &r.part.judged.space;
            if space.is_determined(at(r)) { space.elongation[at(r)][leg] * 1e6 } else { f64::NAN }
        });
        let meaning = "elongation of the leg that would explain what is left of the averaged readings of this condition; none where \
                       they do not determine it";
        numbers(&format!("leg_{}_residual_um", leg + 1), "um", meaning, left)
    };
    (0..6).map(force).chain((0..6).map(length)).chain((0..6).map(left)).collect()
}

fn numbers(name: &str, unit: &str, meaning: &str, cells: impl Iterator<Item = f64>) -> DataColumn {
    let unit = if unit.is_empty() { "1" } else { unit };
    DataColumn::new(name, unit, meaning, TableValues::Numbers(cells.collect()))
}

fn whole(name: &str, meaning: &str, cells: impl Iterator<Item = i64>) -> DataColumn {
    DataColumn::new(name, "1", meaning, TableValues::Integers(cells.collect()))
}

fn words(name: &str, meaning: &str, cells: impl Iterator<Item = &'static str>) -> DataColumn {
    DataColumn::new(name, "", meaning, TableValues::Words(cells.collect()))
}
