//! Both worlds side by side: the same machine, effect, pose and load, two ways to the state of rest.

use std::{fmt::Write, sync::Arc, time::Instant};

use hexbench_core::files::CsvText;
use hexbench_core::statistics::quantile;
use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Approach, Hexapod, Vector6};
use hexbench_truth::{
    Situation, Statics, TruthError, World,
    campaign::{PlanKind, machines},
    mechanisms::{MechanismEntry, REGISTRY},
    world::InstrumentReading,
};
use rand::RngExt;

/// One situation in which the worlds are compared.
#[derive(Debug, Clone)]
pub struct CrossCheckCase {
    /// Number of the case.
    pub index: usize,
    /// Family of the machine.
    pub family: &'static str,
    /// Effect at work; none: leg springs alone.
    pub effect: Option<&'static MechanismEntry>,
    /// Nominal machine.
    pub hexapod: Hexapod,
    /// Stiffness of the legs, N/m.
    pub stiffness: [f64; 6],
    /// Pose, loads and path.
    pub situation: Situation,
    seed: u64,
}

/// How far apart the worlds are in one case, all as shares.
#[derive(Debug, Clone, PartialEq)]
pub struct WorldDifference {
    /// Number of the case.
    pub index: usize,
    /// Family of the machine.
    pub family: &'static str,
    /// Id of the effect, or `none`.
    pub effect: &'static str,
    /// Size of the deflection (loaded minus reference), m.
    pub deflection: f64,
    /// Difference in position over the deflection: of the deflection or of the loaded pose, whichever is larger.
    pub translation: f64,
    /// Difference in orientation over the rotation (that of the deflection, plus its translation over the radius).
    pub rotation: f64,
    /// Largest difference of a leg force over the largest leg force.
    pub force: f64,
    /// Time of one state of rest in the second world, s.
    pub seconds: f64,
}

impl WorldDifference {
    /// The largest of the three shares.
    pub fn worst(&self) -> f64 {
        self.translation.max(self.rotation).max(self.force)
    }
}

impl CrossCheckCase {
    /// Case `index` of a seed. Consecutive ones walk through all effects and all families of machines; sizes, poses, loads
    /// and the approach to the load are drawn.
    pub fn draw(index: usize, seed: u64) -> Self {
        let mut rng = stream(seed, Purpose::WorldsSituation, [index as u64]);
        let effects = REGISTRY.len() + 1;
        let family = machines::FAMILIES[index % machines::FAMILIES.len()];
        let hexapod = machines::draw(family, &mut rng);
        let stiffness = machines::leg_stiffness(family, &mut rng);
        let rows = PlanKind::OtherLoads.draw(&hexapod, &mut rng).training;
        let situation = rows[rng.random_range(0..rows.len())].situation;
        let effect = (index % effects).checked_sub(1).map(|i| &REGISTRY[i]);
        Self { index, family, effect, hexapod, stiffness, situation, seed }
    }

    /// Name of the effect, `none` for leg springs alone.
    pub fn effect_name(&self) -> &'static str {
        self.effect.map_or("none", |effect| effect.id)
    }

    /// The machine with its effect in the first world.
    pub fn world(&self) -> World {
        let world = World::new(self.hexapod.clone(), &self.stiffness);
        let mut rng = stream(self.seed, Purpose::WorldsEffect, [self.index as u64]);
        match self.effect {
            None => world,
            Some(effect) => world.with((effect.draw)(&self.hexapod, &mut rng)),
        }
    }

    /// Compares the first world with the same one on other statics.
    ///
    /// # Errors
    /// As [`World::reading`], of either world.
    pub fn compare(&self, other: &Arc<dyn Statics>) -> Result<WorldDifference, TruthError> {
        let first = self.world();
        let mut second = self.world();
        second.statics = Arc::clone(other);
        let deflections = [first.deflection(&self.situation)?, second.deflection(&self.situation)?];
        let reading = first.reading(&self.situation)?;
        let start = Instant::now();
        let checked = second.reading(&self.situation)?;
        // An overload on the way is a second state of rest.
        let states = if self.situation.approach == Approach::Overloaded { 2.0 } else { 1.0 };
        let seconds = start.elapsed().as_secs_f64() / states;
        Ok(WorldDifference { seconds, ..self.differences(&deflections, &reading, &checked) })
    }

    fn differences(
        &self,
        deflections: &[Vector6; 2],
        first: &InstrumentReading,
        second: &InstrumentReading,
    ) -> WorldDifference {
        let [size, turn] = parts(&deflections[0]);
        let by_deflection = parts(&(deflections[1] - deflections[0]));
        let by_pose = parts(&second.equilibrium.platform.relative_to(&first.equilibrium.platform));
        let forces = (first.equilibrium.forces, second.equilibrium.forces);
        let largest = forces.0.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        let apart = forces.0.iter().zip(forces.1).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        WorldDifference {
            index: self.index,
            family: self.family,
            effect: self.effect_name(),
            deflection: size,
            translation: by_deflection[0].max(by_pose[0]) / size,
            rotation: by_deflection[1].max(by_pose[1]) / (turn + size / self.hexapod.platform_radius()),
            force: apart / largest,
            seconds: 0.0,
        }
    }
}

/// Sizes of translation and rotation.
fn parts(d: &Vector6) -> [f64; 2] {
    [d.fixed_rows::<3>(0).norm(), d.fixed_rows::<3>(3).norm()]
}

/// One line for each comparison.
pub fn csv(comparisons: &[WorldDifference]) -> String {
    let header = ["case", "family", "effect", "deflection_um", "translation", "rotation", "force", "seconds"];
    let mut text = CsvText::new(header);
    for c in comparisons {
        let head = [
            c.index.to_string(),
            c.family.to_string(),
            c.effect.to_string(),
            format!("{:.6}", c.deflection * 1e6),
        ];
        let shares = [c.translation, c.rotation, c.force].map(|x| format!("{x:.3e}"));
        text.row(head.into_iter().chain(shares).chain([format!("{:.4}", c.seconds)]));
    }
    text.into_text()
}

/// Median, 99 % quantile and largest value of each quantity, as a page.
pub fn summary(comparisons: &[WorldDifference]) -> String {
    let mut text = format!("{} cases{:>23}{:>12}{:>12}\n", comparisons.len(), "median", "99 %", "largest");
    let mut line = |name: &str, value: fn(&WorldDifference) -> f64| {
        let at = |share: f64| quantile(comparisons.iter().map(value), share);
        if let (Some(q50), Some(q99), Some(most)) = (at(0.5), at(0.99), at(1.0)) {
            let _ = writeln!(text, "{name:<22}{q50:>12.1e}{q99:>12.1e}{most:>12.1e}");
        }
    };
    line("position", |c| c.translation);
    line("orientation", |c| c.rotation);
    line("leg forces", |c| c.force);
    line("s per state of rest", |c| c.seconds);
    text
}
