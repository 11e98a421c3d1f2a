//! What sort of reading it is, in words: only what matters is said. An aspect matters when the reading separates much less
//! without it.

use hexbench_core::words::joined;
use hexbench_core::{Approach, Hexapod, Observation, Pose, Vector3, Vector6};

use crate::estimation::campaign::Campaign;
use crate::machine::kinematics::Legs;

/// An aspect matters when less than this share of the gain is left without it.
pub const MATTERS: f64 = 0.7;
/// A coordinate is told when it is at least this share of the largest of its kind.
const NOTABLE: f64 = 0.6;
/// A leg force counts as reversed when it is at least this share of the largest on its other side.
const REVERSED: f64 = 0.05;

/// One aspect of a reading that may be taken away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aspect {
    /// Its wrench.
    Load,
    /// Where the platform is.
    Position,
    /// How it is turned.
    Tilt,
    /// From which side the load is approached.
    Approach,
    /// How long it waits.
    Wait,
    /// The temperature.
    Temperature,
}

/// All aspects.
pub const ASPECTS: [Aspect; 6] =
    [Aspect::Load, Aspect::Position, Aspect::Tilt, Aspect::Approach, Aspect::Wait, Aspect::Temperature];

/// Ordinary values of the aspects.
#[derive(Debug, Clone)]
pub struct Ordinary {
    load: Observation,
    waits: [f64; 2],
}

impl Ordinary {
    /// A reading with an ordinary load, and the shortest and longest wait.
    pub fn new(load: Observation, waits: [f64; 2]) -> Self {
        Self { load, waits }
    }

    /// As a campaign shows them: its most frequent load.
    pub(super) fn of(campaign: &Campaign) -> Option<Self> {
        let first = campaign.groups.first()?.mean;
        let count = |o: &Observation| campaign.groups.iter().filter(|g| g.mean.wrench == o.wrench).count();
        let rows = || campaign.groups.iter().map(|g| &g.mean);
        let load = rows().fold(first, |best, o| if count(o) > count(&best) { *o } else { best });
        let shortest = rows().map(|o| o.elapsed).fold(f64::INFINITY, f64::min);
        let longest = rows().map(|o| o.elapsed).fold(0.0, f64::max);
        Some(Self { load, waits: [shortest, longest] })
    }

    /// The reading without an aspect; none when it is ordinary in it already.
    pub fn without(&self, o: &Observation, aspect: Aspect) -> Option<Observation> {
        let pose = o.pose;
        let plain = match aspect {
            Aspect::Load => Observation { wrench: self.load.wrench, reference: self.load.reference, ..*o },
            Aspect::Position => Observation { pose: Pose { translation: Vector3::zeros(), ..pose }, ..*o },
            Aspect::Tilt => Observation { pose: Pose { angles: Vector3::zeros(), ..pose }, ..*o },
            Aspect::Approach => Observation { approach: Approach::Direct, ..*o },
            Aspect::Wait => Observation { elapsed: self.other_wait(o.elapsed), ..*o },
            Aspect::Temperature => Observation { delta_t: 0.0, ..*o },
        };
        (plain != *o).then_some(plain)
    }

    fn other_wait(&self, wait: f64) -> f64 {
        let [shortest, longest] = self.waits;
        if wait > 0.5 * (shortest + longest) { shortest } else { longest }
    }

    fn is_long(&self, wait: f64) -> bool {
        wait > 0.5 * (self.waits[0] + self.waits[1])
    }

    /// A phrase for each aspect that matters; `half` range of every pose coordinate, m and rad.
    pub fn phrase(&self, hexapod: &Hexapod, half: &[f64; 6], o: &Observation, matters: &[Aspect]) -> String {
        let of = |a: &Aspect| match a {
            Aspect::Load => load(hexapod, o),
            Aspect::Position => position(&o.pose, half),
            Aspect::Tilt => tilt(&o.pose),
            Aspect::Approach => "approach from the other side (exceed the load first)".to_owned(),
            Aspect::Wait if self.is_long(o.elapsed) => format!("wait {} s", o.elapsed),
            Aspect::Wait => format!("read early, after {} s", o.elapsed),
            Aspect::Temperature => {
                format!(
                    "with the machine {} K {}",
                    o.delta_t.abs(),
                    if o.delta_t > 0.0 { "warmer" } else { "colder" }
                )
            }
        };
        let phrases: Vec<String> = matters.iter().map(of).filter(|p| !p.is_empty()).collect();
        phrases.join(", ")
    }
}

/// `load sideways along x, which reverses the force of leg 3`.
fn load(hexapod: &Hexapod, o: &Observation) -> String {
    let change = o.wrench.to_vector() - o.reference.to_vector();
    let radius = hexapod.platform_radius();
    let scaled = Vector6::from_fn(|k, _| if k < 3 { change[k] } else { change[k] / radius });
    let axis = scaled.iamax();
    let name = ["x", "y", "z"][axis % 3];
    let kind = match axis {
        0 | 1 => format!("load sideways along {name}"),
        2 if change[2] > 0.0 => "pull upwards".to_owned(),
        2 => "press down".to_owned(),
        5 => "twist about z".to_owned(),
        _ => format!("apply a moment about {name}"),
    };
    let reversed = reversed(hexapod, o);
    let legs = joined(&reversed.iter().map(ToString::to_string).collect::<Vec<_>>());
    match reversed.len() {
        0 => kind,
        1 => format!("{kind}, which reverses the force of leg {legs}"),
        6 => format!("{kind}, which reverses the force of every leg"),
        _ => format!("{kind}, which reverses the forces of legs {legs}"),
    }
}

/// Legs (from 1) that are pushed in one state and pulled in the other.
fn reversed(hexapod: &Hexapod, o: &Observation) -> Vec<usize> {
    let Ok(legs) = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &o.pose) else {
        return Vec::new();
    };
    let (before, after) = (legs.forces(&o.reference.to_vector()), legs.forces(&o.wrench.to_vector()));
    let least = REVERSED * before.amax().max(after.amax());
    let turns = |i: &usize| before[*i] * after[*i] < 0.0 && before[*i].abs().min(after[*i].abs()) > least;
    (0..6).filter(turns).map(|i| i + 1).collect()
}

/// `at large x and small z`: coordinates near the end of their range.
fn position(pose: &Pose, half: &[f64; 6]) -> String {
    let x = pose.to_array();
    let far = (0..3).filter(|&k| x[k].abs() > NOTABLE * half[k]);
    let far: Vec<String> = far
        .map(|k| format!("{} {}", if x[k] > 0.0 { "large" } else { "large negative" }, ["x", "y", "z"][k]))
        .collect();
    if far.is_empty() { "away from the center".to_owned() } else { format!("at {}", far.join(" and ")) }
}

fn tilt(pose: &Pose) -> String {
    let x = pose.angles;
    let largest = x.amax();
    let notable = (0..3).filter(|&k| x[k].abs() >= NOTABLE * largest);
    let axes: Vec<&str> = notable.map(|k| ["x", "y", "z"][k]).collect();
    format!("with the platform rotated about {}", joined(&axes))
}
