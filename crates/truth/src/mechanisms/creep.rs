//! Leg compliance grows under load: `creep`.
//!
//! Every change of force on a leg spring makes it yield further from then on (Boltzmann superposition): `chi c df g(t)` when the
//! change is `t` old. The reference force had rested for its age when the reference was read, and loads of a sequence came before it or
//! after; what all of them have yielded until the reference reading is in the reference. A load of unknown age has settled.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, one_of};
use crate::{Instant, Phase, Setup};

/// Leg compliance grows under load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Creep {
    /// Final growth of the compliance `chi`; of the logarithmic law, its growth in the time in which the logarithm is one.
    pub share: f64,
    /// Time constant `tau`, s.
    pub time: f64,
    /// How long the reference load had rested at the reference reading where the plan does not say, s; none: it has settled.
    #[serde(default)]
    pub age: Option<f64>,
    /// How it goes with time.
    #[serde(default)]
    pub law: CreepLaw,
}

/// How creep goes with the time since a change of force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CreepLaw {
    /// `g(t) = 1 - exp(-t / tau)`: it comes to an end.
    #[default]
    Exponential,
    /// `g(t) = ln(1 + t / tau)`: it never does.
    Logarithmic,
}

impl Creep {
    /// A preload that has settled, and creep that comes to an end.
    pub fn new(share: f64, time: f64) -> Self {
        Self { share, time, age: None, law: CreepLaw::Exponential }
    }

    /// `g(t)` for a force that is `t` seconds old.
    fn grown(&self, t: f64) -> f64 {
        match self.law {
            CreepLaw::Exponential => -(-t / self.time).exp_m1(),
            CreepLaw::Logarithmic => (t / self.time).ln_1p(),
        }
    }

    /// What a change of force yields between the reference reading and `t` seconds after it, over its first yield; a settled one nothing.
    fn grown_since_reference(&self, put_on: Option<f64>, t: f64) -> f64 {
        match (put_on, self.law) {
            (None, _) => 0.0,
            (Some(put_on), _) if put_on >= 0.0 => self.grown(t - put_on),
            (Some(put_on), CreepLaw::Exponential) => (put_on / self.time).exp() * self.grown(t),
            (Some(put_on), CreepLaw::Logarithmic) => (t / (self.time - put_on)).ln_1p(),
        }
    }
}

impl Registered for Creep {
    const ID: &'static str = "creep";
    const TITLE: &'static str = "Leg compliance grows under load";
    const PHYSICS: &'static str = "e += chi c [(f - f0) g(elapsed) + f0 (g(age + elapsed) - g(age))], g(t) = 1 - exp(-t / tau) or ln(1 + t / tau)";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        Self::new(0.05, one_of(rng, &[20.0, 60.0, 150.0]))
    }

    fn check(&self) -> Result<(), &'static str> {
        if self.age.is_none_or(|age| age >= 0.0) { Ok(()) } else { Err("the age is not negative") }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        if moment.phase != Phase::Loaded {
            return;
        }
        let t = moment.elapsed();
        let present = self.share * self.grown_since_reference(Some(moment.put_on), t);
        for (i, law) in setup.laws.iter_mut().enumerate() {
            let c = law.compliance;
            let mut before = 0.0;
            for past in moment.past {
                let age = self.age.filter(|_| past.is_reference).map(|age| -age);
                let grown = self.share * self.grown_since_reference(past.put_on.or(age), t);
                law.offset += c * grown * (past.forces[i] - before);
                before = past.forces[i];
            }
            law.compliance += c * present;
            law.offset -= c * present * before;
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { share: self.share * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        let mut numbers = vec![self.share, self.time];
        numbers.extend(self.age);
        let mut all = vec![("creep", json!(numbers))];
        if self.law == CreepLaw::Logarithmic {
            all.push(("creep_law", json!(self.law)));
        }
        all
    }
}
