//! Writing measurements that sensors read, or of which cells are empty.

use std::io::{self, Write};
use std::path::Path;

use super::write_measurements::{
    MeasurementsWriter, conditions_to_columns, measurements_to_columns, measurements_to_csv, write_number,
};
use super::{FileError, atomic_write};
use crate::{Channel, Columns, Dataset, Hexapod, Observation};

/// Writes `measurements.csv` of a machine, whole or not at all: what sensors read in columns of their own, and empty cells where
/// nothing was read; angles by the convention of the machine. Of full poses alone, as [`super::write_measurements`].
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
    if let Some(line) = hexapod.angles.lacks_an_angle(dataset) {
        let why = format!("the row of line {line} lacks one of three angles");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    }
    let dataset = &*hexapod.angles.as_stated(dataset);
    if !dataset.has_other_readings() {
        return measurements_to_csv(out, dataset);
    }
    let conditions = MeasurementsWriter::conditions(Columns { sigma: false, ..dataset.columns });
    let channels = channels(dataset, hexapod);
    let names = channels.iter().map(|c| c.name(hexapod, dataset));
    writeln!(out, "{}", conditions.names().chain(names).collect::<Vec<_>>().join(","))?;
    for row in dataset.rows() {
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

/// The same as columns in memory: name with unit, and one number per row; NaN where nothing was read.
pub fn campaign_to_columns(hexapod: &Hexapod, dataset: &Dataset) -> Vec<(String, Vec<f64>)> {
    let dataset = &*hexapod.angles.as_stated(dataset);
    if !dataset.has_other_readings() {
        return measurements_to_columns(dataset);
    }
    let rows: Vec<&[Observation]> = dataset.rows().collect();
    let first = Dataset { observations: rows.iter().map(|row| row[0]).collect(), ..dataset.clone() };
    let read = |column: &Written| {
        let cells = rows.iter().map(|row| column.value(dataset, row).map_or(f64::NAN, |value| 1e6 * value));
        (column.name(hexapod, dataset), cells.collect())
    };
    conditions_to_columns(&first).into_iter().chain(channels(dataset, hexapod).iter().map(read)).collect()
}

/// A column of readings, or of standard deviations.
struct Written {
    channel: Channel,
    is_sigma: bool,
}

/// Columns of readings, then of standard deviations that the machine does not state.
fn channels(dataset: &Dataset, hexapod: &Hexapod) -> Vec<Written> {
    let all = dataset.all_channels();
    let values = all.clone().map(|channel| Written { channel, is_sigma: false });
    let differs = |channel: Channel| {
        let stated = channel.stated_sigma(&hexapod.sensors, hexapod.metrology);
        let own = |o: &Observation| {
            let place = dataset.place_of(o, channel)?;
            o.sigma.map(|sigma| sigma[place])
        };
        let is_first = !matches!(channel, Channel::Sensor { number, .. } if number > 0);
        is_first && dataset.observations.iter().filter_map(own).any(|s| stated.is_none_or(|t| !is_same(s, t)))
    };
    let mut sigmas: Vec<Channel> = all.filter(|c| differs(*c)).collect();
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
        let sensors = &hexapod.sensors;
        let column = self.channel.column(sensors, dataset.measurand);
        match self.channel {
            Channel::Sensor { sensor, .. } if self.is_sigma => {
                format!("{}_sigma_{}", sensors[sensor].name, self.channel.unit(sensors))
            }
            _ if self.is_sigma => format!("sigma_{column}"),
            _ => column,
        }
    }

    fn value(&self, dataset: &Dataset, row: &[Observation]) -> Option<f64> {
        let read = row.iter().find_map(|o| {
            let k = dataset.place_of(o, self.channel)?;
            Some(if self.is_sigma { o.sigma.map_or(0.0, |sigma| sigma[k]) } else { o.measured[k] })
        });
        // Standard deviations of pose numbers stand in every row, also of those that were not read.
        let is_pose_sigma = self.is_sigma && matches!(self.channel, Channel::Pose(_));
        read.or(is_pose_sigma.then_some(1e-6))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::read_campaign_from;
    use crate::{Sensor, SensorKind, Vector3};

    #[test]
    fn columns_in_memory_are_those_of_the_file_with_nan_where_nothing_was_read() {
        let ring = |z: f64| std::array::from_fn(|k| Vector3::new((k as f64).cos(), (k as f64).sin(), z));
        let gauge = SensorKind::LegLength { leg: 0, sigma: 1e-6 };
        let ball = SensorKind::Point { point: Vector3::zeros(), sigma: [1e-6; 3] };
        let level = SensorKind::Inclination { axis: Vector3::x(), sigma: 1e-6 };
        let kinds = [("g1", gauge), ("ball", ball), ("level", level)];
        let sensors = kinds.map(|(name, kind)| Sensor::new(name, kind)).into();
        let hexapod = Hexapod { sensors, ..Hexapod::of_joints("ring", ring(-1.0), ring(0.0)) };
        let text = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
                    g1_um,ball_x_um,ball_y_um,ball_z_um,level_urad\n\
                    1,1,0,0,0,0,0,0,0,0,-100,0,0,0,1.5,2,3,4,5\n\
                    2,1,1,0,0,0,0,0,0,0,-200,0,0,0,,2,3,4,-6.5\n";
        let dataset = read_campaign_from(&hexapod, text.as_bytes(), "m.csv").unwrap().dataset;
        let columns = campaign_to_columns(&hexapod, &dataset);
        let names: Vec<&str> = columns.iter().map(|c| c.0.as_str()).collect();
        assert_eq!(names.join(","), text.lines().next().unwrap());
        assert_eq!(dataset.rows().count(), 2);
        for (column, (name, values)) in columns.iter().enumerate() {
            for (row, value) in values.iter().enumerate() {
                let cell = text.lines().nth(row + 1).unwrap().split(',').nth(column).unwrap();
                let expected: f64 = cell.parse().unwrap_or(f64::NAN);
                let same = (value - expected).abs() < 1e-9 || (value.is_nan() && expected.is_nan());
                assert!(same, "{name} row {row}: {value}, not {cell}");
            }
        }
    }
}
