//! `creep`: the legs creep under load.
//!
//! The load is put on right after the reference reading, or after the reading before it where the file states a sequence; every change
//! of force creeps from its own time on. The reference load has rested since its age before. A file that states the age
//! (`ref_age_s`) says how much of the preload is still to come. Without it the preload counts as settled, and a version with one more
//! parameter competes in which it may still creep: for the exponential law `g(age + t) - g(age) = exp(-age/tau) g(t)`, linear in the part.
//! The logarithmic law has no end; a part stands for it likewise, exactly where the preload is fresh or settled.

use std::sync::Arc;

use hexbench_core::Vector6;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Shape, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// Prior share of the logarithmic law.
const LOGARITHMIC: f64 = 0.1;
/// Prior share of a preload that has not settled, of either law.
const UNSETTLED: f64 = 0.2;

const FRACTION: ParameterInfo = ParameterInfo::new("fraction", "%", 100.0, Scale::Fixed(1.0), true);
const OF_PRELOAD: ParameterInfo = ParameterInfo::new("preload-fraction", "%", 100.0, Scale::Fixed(1.0), true);
const PER_E_FOLD: ParameterInfo =
    ParameterInfo::new("fraction-per-e-fold", "%", 100.0, Scale::Fixed(1.0), true);
const OF_PRELOAD_PER_E_FOLD: ParameterInfo =
    ParameterInfo::new("preload-fraction-per-e-fold", "%", 100.0, Scale::Fixed(1.0), true);

const INFO: TermInfo = TermInfo {
    id: "creep",
    title: "The legs creep under load",
    chapter: Chapter::Legs,
    physics: "The compliance of every leg grows while the load is applied, and while the preload is applied: ref_age_s says for how long.",
    equation: "e = chi c_i [(f - f0) g(elapsed) + f0 (g(age + elapsed) - g(age))], g(t) = 1 - exp(-t / tau)",
    source: "Findley, Lai and Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials, 1976, ch. 5",
    shows: "elapsed_s varies",
    how_to_isolate: "read the same load immediately and again after several minutes",
    parameters: &[FRACTION],
    shape: Some(Shape { name: "time-constant", unit: "s", per_si: 1.0, bounds: [1e-2, 1e7] }),
    needs: &[Need::Elapsed],
    rich: Rich::PerLeg,
};

const UNSETTLED_INFO: TermInfo = TermInfo {
    title: "The legs creep under load, and still under the preload",
    equation: "e = c_i [chi (f - f0) + chi' f0] g(elapsed), g(t) = 1 - exp(-t / tau), 0 <= chi' <= chi",
    parameters: &[FRACTION, OF_PRELOAD],
    rich: Rich::None,
    ..INFO
};

const LOGARITHMIC_INFO: TermInfo = TermInfo {
    title: "The legs creep under load without end",
    equation: "e = chi c_i [(f - f0) g(elapsed) + f0 (g(age + elapsed) - g(age))], g(t) = ln(1 + t / tau)",
    parameters: &[PER_E_FOLD],
    shape: Some(Shape { name: "logarithmic-time", unit: "s", per_si: 1.0, bounds: [1e-2, 1e7] }),
    rich: Rich::None,
    ..INFO
};

const LOGARITHMIC_UNSETTLED_INFO: TermInfo = TermInfo {
    title: "The legs creep without end under load, and still under the preload",
    equation: "e = c_i [chi (f - f0) + chi' f0] g(elapsed), g(t) = ln(1 + t / tau), 0 <= chi' <= chi",
    parameters: &[PER_E_FOLD, OF_PRELOAD_PER_E_FOLD],
    ..LOGARITHMIC_INFO
};

static VERSIONS: [TermInfo; 4] = [INFO, UNSETTLED_INFO, LOGARITHMIC_INFO, LOGARITHMIC_UNSETTLED_INFO];

/// Creep by one law, the preload settled or of a known age, or with a part of its own.
#[derive(Clone, Copy)]
pub(super) struct Creep {
    info: &'static TermInfo,
    law: Law,
    is_unsettled: bool,
}

/// The usual version.
pub(super) const CREEP: Creep = Creep { info: &VERSIONS[0], law: Law::Exponential, is_unsettled: false };

/// How creep goes with time.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Law {
    Exponential,
    Logarithmic,
}

impl Law {
    /// `g(t)`.
    fn growth(self, t: f64, tau: f64) -> f64 {
        match self {
            Self::Exponential => 1.0 - (-t / tau).exp(),
            Self::Logarithmic => (1.0 + t / tau).ln(),
        }
    }

    /// What a change of force yields between the reference reading and `t` after it: `g(t - put_on)`, less what it had yielded before.
    fn growth_since_reference(self, put_on: f64, t: f64, tau: f64) -> f64 {
        match self {
            _ if put_on >= 0.0 => self.growth(t - put_on, tau),
            Self::Exponential => (put_on / tau).exp() * self.growth(t, tau),
            Self::Logarithmic => self.growth(t, tau - put_on),
        }
    }
}

impl Creep {
    /// Creep by the changes of force before the reference reading, and by those since, over the compliance.
    fn yields(&self, at: &Condition, tau: f64) -> [Vector6; 2] {
        let growth = |put_on: Option<f64>| {
            put_on.map_or(0.0, |put_on| self.law.growth_since_reference(put_on, at.elapsed, tau))
        };
        let (before, since) = at.past.split_at(at.past.partition_point(|state| state.load.before_reference));
        let (mut yields, mut carried) = ([Vector6::zeros(); 2], Vector6::zeros());
        let mut change = |side: usize, forces: Vector6, put_on: Option<f64>| {
            yields[side] += (forces - carried) * growth(put_on);
            carried = forces;
        };
        for state in before {
            change(0, state.spring_forces, state.load.put_on);
        }
        change(0, at.spring_forces[0], at.reference_age.map(|age| -age));
        for state in since {
            change(1, state.spring_forces, state.load.put_on);
        }
        change(1, at.spring_forces[1], Some(at.put_on));
        yields
    }
}

impl Term for Creep {
    fn info(&self) -> &TermInfo {
        self.info
    }

    fn actions(&self, _: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        let [before, since] = self.yields(at, shape);
        if self.is_unsettled {
            let preload = at.spring_forces[0] * self.law.growth(at.elapsed, shape);
            out.extend([Action::Force(since), Action::Force(preload)]);
            return;
        }
        out.push(Action::Force(before + since));
    }

    fn shape_grid(&self, conditions: &[Condition]) -> Vec<f64> {
        let is_open = |c: &Condition| c.reference_age.is_none() && c.reference_force.amax() > 0.0;
        if self.is_unsettled && !conditions.iter().any(is_open) {
            return Vec::new();
        }
        // From a third of the shortest to three times the longest wait. What goes faster has settled when the reference is read, which
        // waits as long as the others; beside the springs such a part would be a constant load.
        let waits = conditions.iter().flat_map(|c| [c.elapsed - c.put_on, c.elapsed]).filter(|&t| t > 0.0);
        let (short, long) = waits.fold((f64::INFINITY, 0.0_f64), |(a, b), t| (a.min(t), b.max(t)));
        if long <= 0.0 {
            return Vec::new();
        }
        let fastest = if self.is_unsettled { short } else { short / 3.0 };
        let (first, last) = (fastest.max(long / 300.0), 3.0 * long);
        let steps = if self.law == Law::Exponential { 7 } else { 3 };
        (0..=steps).map(|k| first * (last / first).powf(f64::from(k) / f64::from(steps))).collect()
    }

    fn second_is_part_of_first(&self) -> bool {
        self.is_unsettled
    }

    fn version(&self) -> Option<&'static str> {
        match (self.law, self.is_unsettled) {
            (Law::Exponential, false) => None,
            (Law::Exponential, true) => Some("unsettled"),
            (Law::Logarithmic, false) => Some("logarithmic"),
            (Law::Logarithmic, true) => Some("logarithmic-unsettled"),
        }
    }

    fn versions(&self) -> Vec<(f64, Arc<dyn Term>)> {
        let version =
            |info, law, is_unsettled| -> Arc<dyn Term> { Arc::new(Self { info, law, is_unsettled }) };
        vec![
            (UNSETTLED * (1.0 - LOGARITHMIC), version(&VERSIONS[1], Law::Exponential, true)),
            ((1.0 - UNSETTLED) * LOGARITHMIC, version(&VERSIONS[2], Law::Logarithmic, false)),
            (UNSETTLED * LOGARITHMIC, version(&VERSIONS[3], Law::Logarithmic, true)),
        ]
    }
}
