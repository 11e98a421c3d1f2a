//! Running a plan on a world.

use std::collections::HashMap;
use std::f64::consts::FRAC_1_SQRT_2;

use hexbench_core::{Columns, Dataset, LoadSequence, Measurand, Observation, Vector6};
use rand_pcg::Pcg64;

use super::PlanRow;
use crate::{
    TruthError, World,
    metrology::{InstrumentFrames, InstrumentNoise, read_sensors},
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
        Self::of_rows(rows, |row, sequence| self.one(row, sequence, measurand))
    }

    /// What the sensors of the machine read without errors, row by row, sensor by sensor; m and rad.
    ///
    /// # Errors
    /// As [`World::before_and_after_loads`].
    pub fn sensed(&self, rows: &[PlanRow]) -> Result<Vec<Vec<f64>>, TruthError> {
        let alone = LoadSequence::default();
        Self::of_rows(rows, |row, sequence| {
            let states = self.world.before_and_after_loads(&row.situation, sequence.unwrap_or(&alone))?;
            Ok(read_sensors(&self.world.hexapod, &states))
        })
    }

    /// What rows read, equal ones in a sequence computed once.
    fn of_rows<T: Clone>(
        rows: &[PlanRow],
        one: impl Fn(&PlanRow, Option<&LoadSequence>) -> Result<T, TruthError>,
    ) -> Result<Vec<T>, TruthError> {
        let mut readings: Vec<T> = Vec::with_capacity(rows.len());
        let unread: Vec<Observation> = rows.iter().map(PlanRow::unread).collect();
        let sequences = LoadSequence::of_all(&unread);
        for (i, row) in rows.iter().enumerate() {
            let again = i > 0 && row.order.is_none() && rows[i - 1].situation == row.situation;
            let reading = if again { readings[i - 1].clone() } else { one(row, sequences[i].as_ref())? };
            readings.push(reading);
        }
        Ok(readings)
    }

    fn one(
        &self,
        row: &PlanRow,
        sequence: Option<&LoadSequence>,
        measurand: Measurand,
    ) -> Result<Vector6, TruthError> {
        if measurand == Measurand::AbsolutePose {
            return self.world.pose(&row.situation).map(|pose| self.frames.seen(&pose).to_vector());
        }
        match sequence {
            None => self.world.deflection(&row.situation),
            Some(sequence) => self.world.deflection_after_loads(&row.situation, sequence),
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
    let mut errors: Vec<Vector6> = rows.iter().map(|_| campaign.noise.draw(rng)).collect();
    share_references(rows, &mut errors, campaign, rng);
    read(campaign, rows, measurand, source, &errors)
}

/// Of readings that share a reference, half of the variance is that of the reference.
fn share_references(rows: &[PlanRow], errors: &mut [Vector6], campaign: &SimulatedCampaign, rng: &mut Pcg64) {
    let mut references: HashMap<i64, Vector6> = HashMap::new();
    for (row, error) in rows.iter().zip(errors) {
        let Some(record) = row.reference_record else { continue };
        let shared = references.entry(record).or_insert_with(|| campaign.noise.draw(rng));
        *error = (*error + *shared) * FRAC_1_SQRT_2;
    }
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
    let columns = Columns {
        reference: deflections,
        approach: deflections,
        overload: deflections && rows.iter().any(PlanRow::states_overload),
        delta_t: true,
        elapsed: true,
        reference_age: deflections && rows.iter().all(|row| row.situation.reference_age.is_some()),
        reference_record: deflections && rows.iter().all(|row| row.reference_record.is_some()),
        order: deflections && rows.iter().all(|row| row.order.is_some()),
        sigma: false,
    };
    Ok(Dataset::of_poses(source, measurand, columns, observations.collect()))
}
