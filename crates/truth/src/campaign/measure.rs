//! Running a plan on a world.

use hexbench_core::{Columns, Dataset, Measurand, Vector6};
use rand_pcg::Pcg64;

use super::PlanRow;
use crate::{
    TruthError, World,
    metrology::{InstrumentFrames, InstrumentNoise},
};

/// A world with its instrument.
#[derive(Debug)]
pub struct SimulatedCampaign {
    /// The machine.
    pub world: World,
    /// Frames of the instrument; they matter for absolute poses only.
    pub frames: InstrumentFrames,
    /// Noise of the instrument.
    pub noise: InstrumentNoise,
}

impl SimulatedCampaign {
    /// What an ideal instrument reads, row by row: deflections, or absolute poses; m and rad.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn ideal(&self, rows: &[PlanRow], measurand: Measurand) -> Result<Vec<Vector6>, TruthError> {
        let mut readings: Vec<Vector6> = Vec::with_capacity(rows.len());
        for (i, row) in rows.iter().enumerate() {
            let again = i > 0 && rows[i - 1].situation == row.situation;
            let reading = if again { readings[i - 1] } else { self.one(row, measurand)? };
            readings.push(reading);
        }
        Ok(readings)
    }

    fn one(&self, row: &PlanRow, measurand: Measurand) -> Result<Vector6, TruthError> {
        if measurand == Measurand::AbsolutePose {
            self.world.pose(&row.situation).map(|pose| self.frames.seen(&pose).to_vector())
        } else {
            self.world.deflection(&row.situation)
        }
    }
}

/// Measures the rows; the same generator gives the same noise whatever the world.
///
/// # Errors
/// As [`World::reading`].
pub fn measure(
    campaign: &SimulatedCampaign,
    rows: &[PlanRow],
    measurand: Measurand,
    source: &str,
    rng: &mut Pcg64,
) -> Result<Dataset, TruthError> {
    let errors: Vec<Vector6> = rows.iter().map(|_| campaign.noise.draw(rng)).collect();
    read(campaign, rows, measurand, source, &errors)
}

/// Reads the rows with given errors, m and rad.
pub(super) fn read(
    campaign: &SimulatedCampaign,
    rows: &[PlanRow],
    measurand: Measurand,
    source: &str,
    errors: &[Vector6],
) -> Result<Dataset, TruthError> {
    let readings = campaign.ideal(rows, measurand)?;
    let observations = rows
        .iter()
        .zip(readings)
        .zip(errors)
        .enumerate()
        .map(|(i, ((row, r), error))| row.read(i as u64 + 2, (r + error).into(), None));
    let deflections = measurand != Measurand::AbsolutePose;
    Ok(Dataset {
        blocks: Dataset::pose_blocks(),
        source: source.to_owned(),
        measurand,
        columns: Columns {
            reference: deflections,
            approach: deflections,
            delta_t: true,
            elapsed: true,
            reference_age: deflections && rows.iter().all(|row| row.situation.reference_age.is_some()),
            reference_record: false,
            sigma: false,
        },
        observations: observations.collect(),
    })
}
