//! Writing measurements that sensors read, or of which cells are empty.

use std::io::{self, Write};
use std::path::Path;

use super::sensor_columns::usual_names;
use super::write_measurements::{MeasurementsWriter, measurements_to_csv, write_number};
use super::{FileError, atomic_write};
use crate::{Channel, Columns, Dataset, Hexapod, Observation, UNREAD};

/// Writes `measurements.csv` of a machine, whole or not at all: what sensors read in columns of their own, and empty cells where
/// nothing was read. Of full poses alone, as [`super::write_measurements`].
///
/// # Errors
/// As [`super::write_measurements`].
pub fn write_campaign(path: &Path, hexapod: &Hexapod, dataset: &Dataset) -> Result<(), FileError> {
    atomic_write(path, |out| campaign_to_csv(out, hexapod, dataset))
        .map_err(|cause| FileError::writing(path, cause))
}

/// The same to any destination.
///
/// # Errors
/// As [`write_campaign`].
pub fn campaign_to_csv(out: &mut dyn Write, hexapod: &Hexapod, dataset: &Dataset) -> io::Result<()> {
    if !dataset.has_other_readings() {
        return measurements_to_csv(out, dataset);
    }
    let conditions = MeasurementsWriter::conditions(Columns { sigma: false, ..dataset.columns });
    let channels = channels(dataset, hexapod);
    let names = channels.iter().map(|c| c.name(hexapod, dataset));
    writeln!(out, "{}", conditions.names().chain(names).collect::<Vec<_>>().join(","))?;
    for row in rows(dataset) {
        conditions.cells(out, &row[0])?;
        for channel in &channels {
            out.write_all(b",")?;
            if let Some(value) = channel.value(dataset, row) {
                write_number(out, 1e6 * value)?;
            }
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

/// Observations of one line of a file.
fn rows(dataset: &Dataset) -> impl Iterator<Item = &[Observation]> {
    dataset.observations.chunk_by(|one, next| one.line == next.line && one.block != next.block)
}

/// A column of readings, or of standard deviations.
struct Written {
    channel: Channel,
    is_sigma: bool,
}

/// Columns of readings, then of standard deviations that the machine does not state.
fn channels(dataset: &Dataset, hexapod: &Hexapod) -> Vec<Written> {
    let all = dataset.blocks.iter().flatten().filter(|channel| **channel != Channel::Nothing);
    let values = all.clone().map(|&channel| Written { channel, is_sigma: false });
    let differs = |channel: Channel| {
        let stated = channel.stated_sigma(&hexapod.sensors, hexapod.metrology);
        let own = |o: &Observation| {
            let place = dataset.channels(o).iter().position(|c| *c == channel)?;
            o.sigma.map(|sigma| sigma[place]).filter(|sigma| *sigma < UNREAD)
        };
        let is_first = !matches!(channel, Channel::Sensor { number, .. } if number > 0);
        is_first && dataset.observations.iter().filter_map(own).any(|s| stated.is_none_or(|t| !is_same(s, t)))
    };
    let mut sigmas: Vec<Channel> = all.copied().filter(|c| differs(*c)).collect();
    if sigmas.iter().any(|c| matches!(c, Channel::Pose(_))) {
        // Those of pose numbers are complete or absent.
        sigmas.retain(|c| !matches!(c, Channel::Pose(_)));
        sigmas.extend(Channel::POSE);
    }
    values.chain(sigmas.into_iter().map(|channel| Written { channel, is_sigma: true })).collect()
}

/// Equal but for a change of unit.
fn is_same(one: f64, other: f64) -> bool {
    (one - other).abs() <= 1e-12 * other.abs()
}

impl Written {
    fn name(&self, hexapod: &Hexapod, dataset: &Dataset) -> String {
        let unit = if self.channel.is_angle(&hexapod.sensors) { "urad" } else { "um" };
        match (self.channel, self.is_sigma) {
            (Channel::Sensor { sensor, number }, false) => {
                usual_names(&hexapod.sensors[sensor])[number].clone()
            }
            (Channel::Sensor { sensor, .. }, true) => {
                format!("{}_sigma_{unit}", hexapod.sensors[sensor].name)
            }
            (channel, is_sigma) => {
                let name = channel.name(&hexapod.sensors, dataset.measurand);
                format!("{}{name}_{unit}", if is_sigma { "sigma_" } else { "" })
            }
        }
    }

    fn value(&self, dataset: &Dataset, row: &[Observation]) -> Option<f64> {
        let read = row.iter().find_map(|o| {
            let k = dataset.channels(o).iter().position(|c| *c == self.channel)?;
            let sigma = o.sigma.map_or(0.0, |sigma| sigma[k]);
            o.is_read(k).then_some(if self.is_sigma { sigma } else { o.measured[k] })
        });
        // Standard deviations of pose numbers stand in every row, also of those that were not read.
        let is_pose_sigma = self.is_sigma && matches!(self.channel, Channel::Pose(_));
        read.or(is_pose_sigma.then_some(1e-6))
    }
}
