//! A scene in the hands of a laboratory.

use hexbench_core::{Dataset, Measurand, Metrology, Vector6};

use super::{Instrument, PartName, RowError, Scene, VirtualBench};
use crate::campaign::{PlanRow, Stage};
use crate::laboratory::{CAREFUL, FaultEntry};
use crate::metrology::InstrumentNoise;

/// A scene, measured as a laboratory does.
#[derive(Debug)]
pub struct SceneLaboratory<'a> {
    bench: VirtualBench<'a>,
    laboratory: &'a FaultEntry,
}

impl Scene {
    /// True when faults of laboratories are defined for its readings: deflections in numbers, each with a reference of its own.
    pub fn takes_laboratories(&self) -> bool {
        self.numbers().is_some() && !self.plan.states_order() && !self.plan.states_reference_record()
    }

    /// Noise of deflections that are read in numbers; none of other readings.
    fn numbers(&self) -> Option<&InstrumentNoise> {
        match &self.instrument {
            Instrument::Numbers(noise) if self.measurand() != Measurand::AbsolutePose => Some(noise),
            _ => None,
        }
    }
}

impl<'a> SceneLaboratory<'a> {
    /// A laboratory that makes the machine another than that of the file, if that is its fault. Where the readings of a scene take no faults,
    /// it is careful.
    pub fn new(scene: &'a Scene, laboratory: &'a FaultEntry) -> Self {
        let laboratory = if scene.takes_laboratories() { laboratory } else { &CAREFUL };
        let mut world = scene.world();
        laboratory.fault.alter(&mut world, &mut Stage::Machine.stream(scene.seed, 0));
        Self { bench: VirtualBench::of_world(scene, world, false), laboratory }
    }

    /// What the file states of the instrument.
    pub fn stated(&self) -> Option<Metrology> {
        let mut metrology = self.bench.scene().hexapod.metrology?;
        self.laboratory.fault.state(&mut metrology);
        Some(metrology)
    }

    /// The rows of a part as an instrument without errors reads them.
    ///
    /// # Errors
    /// [`RowError`].
    pub fn ideal(&mut self, part: PartName) -> Result<Dataset, RowError> {
        self.bench.set_noise_free(true);
        let ideal = self.bench.dataset(part);
        self.bench.set_noise_free(false);
        ideal
    }

    /// The rows of a part as it reads them and writes them down.
    ///
    /// # Errors
    /// [`RowError`].
    pub fn read(&mut self, part: PartName) -> Result<Dataset, RowError> {
        let mut data = self.bench.dataset(part)?;
        let scene = self.bench.scene();
        let Some(sigma) = scene.numbers().map(InstrumentNoise::sigma) else { return Ok(data) };
        if self.laboratory.id == CAREFUL.id {
            return Ok(data);
        }
        self.err(&mut data, part, &sigma)?;
        let fault = self.laboratory.fault;
        // The same stream for both parts: they come from the same hands.
        fault.write(&mut data, &mut Stage::Writing.stream(scene.seed, 0));
        if part == PartName::Training {
            fault.slip(&mut data, &sigma, &mut Stage::Slips.stream(scene.seed, 0));
        }
        Ok(data)
    }

    /// Gives the errors of readings the law of the laboratory.
    fn err(&mut self, data: &mut Dataset, part: PartName, sigma: &Vector6) -> Result<(), RowError> {
        let ideal = self.ideal(part)?;
        let scene = self.bench.scene();
        let rows: Vec<PlanRow> = scene.part(part).iter().collect();
        let pairs = data.observations.iter().zip(&ideal.observations);
        let mut errors: Vec<Vector6> =
            pairs.map(|(o, exact)| Vector6::from(o.measured) - Vector6::from(exact.measured)).collect();
        let mut rng = Stage::Errors.stream(scene.seed, u64::from(part == PartName::Holdout));
        self.laboratory.fault.err(&rows, sigma, &mut errors, &mut rng);
        for ((o, exact), error) in data.observations.iter_mut().zip(&ideal.observations).zip(&errors) {
            o.measured = self.bench.written(Vector6::from(exact.measured) + error);
        }
        Ok(())
    }
}
