//! The files of a campaign as a reader gets them.

use hexbench_core::files::{hexapod_to_toml, measurements_to_csv, parse_hexapod, read_measurements_from};
use hexbench_core::{Dataset, Hexapod};

use super::MisreadCampaign;

/// Machine, readings to learn from and readings held out.
#[derive(Debug)]
pub(super) struct ReadFiles {
    pub(super) hexapod: Hexapod,
    pub(super) measurements: Dataset,
    pub(super) holdout: Dataset,
}

impl ReadFiles {
    /// Writes the files of a campaign and reads them again; why they are refused.
    pub(super) fn of(campaign: &MisreadCampaign) -> Result<Self, String> {
        let (hexapod, [measurements, holdout]) = campaign.files();
        let hexapod = parse_hexapod(&hexapod_to_toml(hexapod), "hexapod.toml");
        Ok(Self {
            hexapod: hexapod.map_err(|why| why.message())?,
            measurements: read_again(measurements)?,
            holdout: read_again(holdout)?,
        })
    }

    /// Readings that repeat an earlier one to the last digit; each is counted once.
    pub(super) fn copies(&self) -> usize {
        let rows = self.measurements.observations.iter().chain(&self.holdout.observations);
        let mut readings: Vec<[u64; 6]> = rows.map(|row| row.measured.map(f64::to_bits)).collect();
        let all = readings.len();
        readings.sort_unstable();
        readings.dedup();
        all - readings.len()
    }
}

fn read_again(data: &Dataset) -> Result<Dataset, String> {
    let mut text = Vec::new();
    measurements_to_csv(&mut text, data).map_err(|why| why.to_string())?;
    let table = read_measurements_from(text.as_slice(), &data.source).map_err(|why| why.message())?;
    Ok(table.dataset)
}
