//! The plan under study.

use hexbench_core::{Dataset, Hexapod, Metrology, Observation, Vector6};
use hexbench_model::estimation::campaign::row_sigma;
use hexbench_model::estimation::frames::ReadingAxes;
use hexbench_model::estimation::noise::{Noise, NoiseSource, scatter, stated_or_repeated};

/// A plan with the machine and the instrument it is for.
#[derive(Debug, Clone)]
pub struct PowerPlan {
    /// The machine.
    pub hexapod: Hexapod,
    /// What is to be read; measured values do not matter.
    pub rows: Dataset,
    /// Stiffness of each leg, N/m.
    pub stiffness: [f64; 6],
    /// Noise of one reading; standard deviations of single rows win where the rows state them.
    pub noise: Noise,
}

impl PowerPlan {
    /// A plan with the noise its rows state, else its machine; `None` when neither does.
    pub fn new(hexapod: Hexapod, rows: Dataset, stiffness: [f64; 6]) -> Option<Self> {
        let unread = Dataset { observations: rows.observations.iter().map(unread).collect(), ..rows };
        let noise = stated_or_repeated(&hexapod, &unread)?;
        Some(Self { hexapod, rows: unread, stiffness, noise })
    }

    /// The same plan with the noise to be estimated from its repeats; `None` when they are too few for it.
    pub fn with_noise_from_repeats(mut self) -> Option<Self> {
        const ENOUGH: f64 = 9.0;
        let repeats = scatter(&self.rows, &ReadingAxes::default()).dof;
        self.rows.columns.sigma = false;
        self.noise = Noise { source: NoiseSource::Repeats, dof: 2.0 * repeats, ..self.noise };
        (repeats >= ENOUGH).then_some(self)
    }

    /// Compliance of each leg, m/N.
    pub fn springs(&self) -> Vector6 {
        Vector6::from(self.stiffness.map(f64::recip))
    }

    /// Standard deviations of a row, m and rad.
    pub fn sigma(&self, row: usize) -> Vector6 {
        row_sigma(&self.rows.observations[row], &self.noise).into()
    }

    /// The machine as a diagnosis of the readings would be given it.
    pub fn machine(&self) -> Hexapod {
        let stated =
            Metrology { sigma_translation: self.noise.translation, sigma_rotation: self.noise.rotation };
        let metrology = (self.noise.source == NoiseSource::Metrology).then_some(stated);
        Hexapod { metrology, ..self.hexapod.clone() }
    }
}

/// A row before it is measured: repeats must not be taken for an estimate of the noise.
fn unread(row: &Observation) -> Observation {
    Observation { measured: [0.0; 6], ..*row }
}
