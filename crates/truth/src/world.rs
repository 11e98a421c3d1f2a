//! A machine with its imperfections, loaded and read.

use std::sync::Arc;

use hexbench_core::{Approach, Hexapod, LoadSequence, PastLoad, Pose, Vector6, Wrench};

use crate::{
    Instant, LegMemory, Mechanism, PastForces, Phase, Setup, Situation, Statics, TruthError,
    equilibrium::{Equilibrium, Newton},
};

/// The true machine: nominal drawings, true leg springs, and what the drawings do not say.
#[derive(Debug)]
pub struct World {
    /// Nominal machine, from which leg lengths are commanded.
    pub hexapod: Hexapod,
    /// Compliance of each leg spring, m/N.
    pub leg_compliance: [f64; 6],
    /// Effects at work, in the order in which they act.
    pub mechanisms: Vec<Box<dyn Mechanism>>,
    /// How states of rest are found.
    pub statics: Arc<dyn Statics>,
}

/// What the instrument sees at one moment: pose of the measured point, m and rad (Euler angles X-Y-Z extrinsic).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InstrumentReading {
    /// Pose read.
    pub pose: Pose,
    /// State of rest behind it.
    pub equilibrium: Equilibrium,
}

impl World {
    /// A machine with plain leg springs of the given stiffness (N/m).
    pub fn new(hexapod: Hexapod, leg_stiffness: &[f64; 6]) -> Self {
        Self {
            hexapod,
            leg_compliance: leg_stiffness.map(|k| 1.0 / k),
            mechanisms: Vec::new(),
            statics: Arc::new(Newton),
        }
    }

    /// The machine with one effect more.
    #[must_use]
    pub fn with(mut self, mechanism: Box<dyn Mechanism>) -> Self {
        self.mechanisms.push(mechanism);
        self
    }

    /// Stiffness of each leg, N/um.
    pub fn leg_stiffness_n_per_um(&self) -> [f64; 6] {
        self.leg_compliance.map(|c| 1e-6 / c)
    }

    /// The same machine without any effect: leg springs alone.
    #[must_use]
    pub fn without_effects(&self) -> Self {
        Self {
            hexapod: self.hexapod.clone(),
            leg_compliance: self.leg_compliance,
            mechanisms: Vec::new(),
            statics: Arc::clone(&self.statics),
        }
    }

    /// Deflection that an ideal instrument reads: loaded minus reference, m and rad, rotation as Euler differences.
    ///
    /// Path: unloaded machine, reference wrench (read), for approach -1 the exceeded load, load (read).
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn deflection(&self, situation: &Situation) -> Result<Vector6, TruthError> {
        self.deflection_after_loads(situation, &LoadSequence::default())
    }

    /// The same after the loads of a sequence.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn deflection_after_loads(
        &self,
        situation: &Situation,
        sequence: &LoadSequence,
    ) -> Result<Vector6, TruthError> {
        let [before, loaded] = self.before_and_after_loads(situation, sequence)?;
        Ok(difference(&loaded, &before))
    }

    /// Poses that an ideal instrument reads in the reference state and in the loaded state, along the path of
    /// [`World::deflection`].
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn before_and_after(&self, situation: &Situation) -> Result<[Pose; 2], TruthError> {
        self.before_and_after_loads(situation, &LoadSequence::default())
    }

    /// The same after the loads of a sequence; times are not known where the sequence does not say.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn before_and_after_loads(
        &self,
        situation: &Situation,
        sequence: &LoadSequence,
    ) -> Result<[Pose; 2], TruthError> {
        let moment = self.moment(situation)?;
        let (before, since): (Vec<&PastLoad>, Vec<&PastLoad>) =
            sequence.past.iter().partition(|load| load.before_reference);
        let mut way = Way { world: self, memory: [LegMemory::default(); 6], past: Vec::new() };
        for load in before {
            way.pass(&Instant { phase: Phase::Overload, ..moment }, load.wrench, load.put_on, false)?;
        }
        let age = situation.reference_age.map(|age| -age);
        let reference = way.pass(&moment, situation.reference, age, true)?;
        for load in since {
            way.pass(&Instant { phase: Phase::Overload, ..moment }, load.wrench, load.put_on, false)?;
        }
        let at_load = Instant { past: &way.past, put_on: sequence.put_on, ..moment };
        let loaded = self.load(at_load, way.memory)?;
        Ok([self.read(&moment, &reference), loaded.pose])
    }

    /// Pose that an ideal instrument reads under the load, reached from the unloaded machine.
    ///
    /// # Errors
    /// As [`World::reading`].
    pub fn pose(&self, situation: &Situation) -> Result<Pose, TruthError> {
        self.reading(situation).map(|reading| reading.pose)
    }

    /// Pose under the load, reached from the unloaded machine, and the state of rest behind it.
    ///
    /// # Errors
    /// [`TruthError::Unreachable`], [`TruthError::Singular`], [`TruthError::GaveWay`], [`TruthError::NotConverged`],
    /// [`TruthError::NotFinite`]: never a number that is not a solution.
    pub fn reading(&self, situation: &Situation) -> Result<InstrumentReading, TruthError> {
        self.load(self.moment(situation)?, [LegMemory::default(); 6])
    }

    /// The structure under the load, as [`World::reading`] brings it to rest.
    ///
    /// # Errors
    /// [`TruthError::Unreachable`], [`TruthError::NotFinite`].
    pub fn structure(&self, situation: &Situation) -> Result<Setup, TruthError> {
        let moment = Instant { phase: Phase::Loaded, ..self.moment(situation)? };
        Ok(self.setup(&moment, situation.wrench))
    }

    fn load(&self, moment: Instant<'_>, remembered: [LegMemory; 6]) -> Result<InstrumentReading, TruthError> {
        let situation = moment.situation;
        let mut memory = remembered;
        if situation.approach == Approach::Overloaded {
            let on_the_way = Instant { phase: Phase::Overload, ..moment };
            memory = self.state(&on_the_way, situation.exceeded(), &memory)?.memory;
        }
        let moment = Instant { phase: Phase::Loaded, ..moment };
        let equilibrium = self.state(&moment, situation.wrench, &memory)?;
        Ok(InstrumentReading { pose: self.read(&moment, &equilibrium), equilibrium })
    }

    fn moment<'a>(&'a self, situation: &'a Situation) -> Result<Instant<'a>, TruthError> {
        let nominal_lengths = self.commanded_lengths(&situation.pose)?;
        Ok(Instant {
            hexapod: &self.hexapod,
            situation,
            phase: Phase::Reference,
            nominal_lengths,
            home_lengths: leg_lengths(&self.hexapod, &Pose::default()),
            past: &[],
            put_on: 0.0,
        })
    }

    fn commanded_lengths(&self, pose: &Pose) -> Result<[f64; 6], TruthError> {
        let lengths = leg_lengths(&self.hexapod, pose);
        if !lengths.iter().all(|q| q.is_finite()) {
            return Err(TruthError::NotFinite { what: "commanded pose" });
        }
        let [shortest, longest] = self.hexapod.stroke.unwrap_or([f64::MIN_POSITIVE, f64::INFINITY]);
        match lengths.iter().position(|&q| q < shortest || q > longest) {
            None => Ok(lengths),
            Some(i) => Err(TruthError::Unreachable {
                leg: i + 1,
                length_mm: lengths[i] * 1e3,
                shortest_mm: shortest * 1e3,
                longest_mm: longest * 1e3,
            }),
        }
    }

    /// The structure as the mechanisms make it at a moment.
    pub fn setup(&self, moment: &Instant<'_>, wrench: Wrench) -> Setup {
        let mut setup = Setup::nominal(moment, &self.leg_compliance, wrench);
        for mechanism in &self.mechanisms {
            mechanism.act(moment, &mut setup);
        }
        setup
    }

    fn state(
        &self,
        moment: &Instant<'_>,
        wrench: Wrench,
        remembered: &[LegMemory; 6],
    ) -> Result<Equilibrium, TruthError> {
        self.statics.rest(&self.setup(moment, wrench), remembered)
    }

    fn read(&self, moment: &Instant<'_>, equilibrium: &Equilibrium) -> Pose {
        let mut body = equilibrium.platform;
        for mechanism in &self.mechanisms {
            mechanism.see(moment, &mut body);
        }
        let mut pose = Pose::from_rotation(body.origin, &body.axes);
        for mechanism in &self.mechanisms {
            mechanism.read(moment, &mut pose);
        }
        pose
    }
}

/// Loads passed one after the other.
struct Way<'a> {
    world: &'a World,
    memory: [LegMemory; 6],
    past: Vec<PastForces>,
}

impl Way<'_> {
    /// Puts a load on, and remembers it.
    fn pass(
        &mut self,
        moment: &Instant<'_>,
        wrench: Wrench,
        put_on: Option<f64>,
        is_reference: bool,
    ) -> Result<Equilibrium, TruthError> {
        let rest = self.world.state(moment, wrench, &self.memory)?;
        self.memory = rest.memory;
        let forces = rest.memory.map(|leg| leg.spring_force);
        self.past.push(PastForces { forces, put_on, is_reference });
        Ok(rest)
    }
}

/// Nominal leg lengths at a pose, m.
fn leg_lengths(hexapod: &Hexapod, pose: &Pose) -> [f64; 6] {
    let r = pose.rotation();
    std::array::from_fn(|i| {
        (pose.translation + r * hexapod.platform_joints[i] - hexapod.base_joints[i]).norm()
    })
}

/// Difference of two poses parameter by parameter, angles taken the short way round.
pub(crate) fn difference(after: &Pose, before: &Pose) -> Vector6 {
    let mut d = after.to_vector() - before.to_vector();
    for k in 3..6 {
        d[k] = d[k].sin().atan2(d[k].cos());
    }
    d
}
