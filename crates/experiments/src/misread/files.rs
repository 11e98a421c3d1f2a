//! The files of a campaign as a reader gets them.

use hexbench_core::files::{campaign_to_csv, hexapod_to_toml, parse_hexapod, read_campaign_from};
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
        let hexapod =
            parse_hexapod(&hexapod_to_toml(hexapod), "hexapod.toml").map_err(|why| why.message())?;
        Ok(Self {
            measurements: read_again(&hexapod, measurements)?,
            holdout: read_again(&hexapod, holdout)?,
            hexapod,
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

fn read_again(hexapod: &Hexapod, data: &Dataset) -> Result<Dataset, String> {
    let mut text = Vec::new();
    campaign_to_csv(&mut text, hexapod, data).map_err(|why| why.to_string())?;
    let table = read_campaign_from(hexapod, text.as_slice(), &data.source).map_err(|why| why.message())?;
    Ok(table.dataset)
}
