//! Leg compliance grows under load: `creep`.
//!
//! Every change of force on a leg spring makes it yield further from then on (Boltzmann superposition): `chi c df g(t)` when the
//! change is `t` old. The reference force came first, and had rested for its age when the reference was read; what it has yielded
//! until then is in the reference. The load came right after that reading.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed_if};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "creep",
    title: "Leg compliance grows under load",
    physics: "e += chi c [(f - f0) g(elapsed) + f0 (g(age + elapsed) - g(age))], g(t) = 1 - exp(-t / tau) or ln(1 + t / tau)",
    shows: Shows::Deflection,
    draw,
    parse: |value| {
        parsed_if::<Creep>(value, |creep| creep.age.is_none_or(|age| age >= 0.0), "the age is not negative")
    },
};

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

    /// What a force that was `age` seconds old grows by in the next `t`; a settled one does not grow.
    fn grown_later(&self, age: Option<f64>, t: f64) -> f64 {
        let Some(age) = age else { return 0.0 };
        match self.law {
            CreepLaw::Exponential => (-age / self.time).exp() * self.grown(t),
            CreepLaw::Logarithmic => (t / (self.time + age)).ln_1p(),
        }
    }
}

impl Mechanism for Creep {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        let t = moment.elapsed();
        let [change, reference] =
            [self.grown(t), self.grown_later(moment.reference_age().or(self.age), t)].map(|g| self.share * g);
        for (i, law) in setup.laws.iter_mut().enumerate() {
            let (c, before) = (law.compliance, moment.reference_forces[i]);
            law.compliance += c * change;
            law.offset -= c * change * before;
            if reference != 0.0 {
                law.offset += c * reference * before;
            }
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { share: self.share * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        let mut numbers = vec![self.share, self.time];
        numbers.extend(self.age);
        let mut all = Map::from_iter([("creep".to_owned(), json!(numbers))]);
        if self.law == CreepLaw::Logarithmic {
            all.insert("creep_law".to_owned(), json!(self.law));
        }
        all
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(Creep::new(0.05, one_of(rng, &[20.0, 60.0, 150.0])))
}
