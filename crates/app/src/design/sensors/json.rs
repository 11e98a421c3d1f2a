//! `sensor-choice/1`: chosen sensors for other programs.

use hexbench_core::{Sensor, Vector3};
use hexbench_design::power::{EffectPower, Visibility};
use hexbench_design::sensors::Found;
use hexbench_model::effects::untestable::Untestable;
use serde::Serialize;

use super::{ChosenSensors, SensorNumber};

/// What is written.
#[derive(Debug, Serialize)]
pub struct SensorChoiceFile<'a> {
    format: &'static str,
    goal: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    see: Option<&'a str>,
    candidates: usize,
    readings: usize,
    poses: usize,
    /// Absent where no budget was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    budget: Option<f64>,
    search: Search,
    sensors: Vec<Chosen<'a>>,
    numbers: Vec<OneNumber<'a>>,
    parameters: Vec<Determined<'a>>,
    effects: Vec<Shown>,
    untestable: &'a [Untestable],
}

#[derive(Debug, Serialize)]
#[serde(tag = "by", rename_all = "kebab-case")]
enum Search {
    Enumeration { sets: u64 },
    Exchange { starts: usize, agreeing: usize, seed: u32 },
}

#[derive(Debug, Serialize)]
struct Chosen<'a> {
    name: &'a str,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    point_mm: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    direction: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    axis: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    leg: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    sigma_um: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma_urad: Option<f64>,
    cost: f64,
}

#[derive(Debug, Serialize)]
struct OneNumber<'a> {
    number: usize,
    determined: bool,
    value: Option<f64>,
    stiffness_uncertainty_percent: Option<[f64; 2]>,
    sensors: &'a [String],
}

#[derive(Debug, Serialize)]
struct Determined<'a> {
    name: &'a str,
    unit: &'static str,
    std: f64,
    of: f64,
}

#[derive(Debug, Serialize)]
struct Shown {
    term: &'static str,
    verdict: Visibility,
    unit: &'static str,
    usual_size: f64,
    smallest_size_seen: Option<f64>,
}

impl ChosenSensors {
    /// The choice as a file for other programs.
    pub fn file(&self) -> SensorChoiceFile<'_> {
        let [readings, poses] = self.plan;
        let study = &self.power.1.study;
        let shares = self.set().map_or(&[][..], |s| &s.shares);
        let determined = self.parameters.iter().zip(shares);
        SensorChoiceFile {
            format: "sensor-choice/1",
            goal: self.goal,
            see: self.see.as_deref(),
            candidates: self.candidates,
            readings,
            poses,
            budget: self.limits.budget,
            search: match self.found {
                Found::OfAll(sets) => Search::Enumeration { sets },
                Found::ByExchange { starts, agreeing } => {
                    Search::Exchange { starts, agreeing, seed: self.seed }
                }
            },
            sensors: self.chosen.iter().map(|c| chosen(&c.sensor, c.cost)).collect(),
            numbers: self.numbers.iter().map(number).collect(),
            parameters: determined
                .map(|(p, share)| Determined { name: &p.name, unit: p.unit, std: share * p.size, of: p.size })
                .collect(),
            effects: study.effects.iter().map(shown).collect(),
            untestable: &study.untestable,
        }
    }
}

fn chosen(sensor: &Sensor, cost: f64) -> Chosen<'_> {
    let kind = &sensor.kind;
    let three = |v: &Vector3| [v.x, v.y, v.z];
    let turns = kind.is_angle();
    let sigma = |number: usize| 1e6 * kind.sigma(number);
    Chosen {
        name: &sensor.name,
        kind: kind.word(),
        point_mm: kind.point().map(|p| three(&(p * 1e3))),
        direction: kind.direction().filter(|_| !turns).map(three),
        axis: kind.direction().filter(|_| turns).map(three),
        leg: kind.leg().map(|leg| leg + 1),
        sigma_um: if turns { Vec::new() } else { (0..kind.numbers()).map(sigma).collect() },
        sigma_urad: turns.then(|| sigma(0)),
        cost,
    }
}

fn number(alternative: &SensorNumber) -> OneNumber<'_> {
    let set = alternative.set.as_ref();
    OneNumber {
        number: alternative.limits.number,
        determined: set.is_some(),
        value: set.map(|s| s.value),
        stiffness_uncertainty_percent: set.map(|s| s.of_stiffnesses().map(|x| 100.0 * x)),
        sensors: set.map_or(&[], |s| &s.names),
    }
}

fn shown(effect: &EffectPower) -> Shown {
    Shown {
        term: effect.term,
        verdict: effect.verdict,
        unit: effect.unit,
        usual_size: effect.usual_size,
        smallest_size_seen: effect.size_seen(),
    }
}
