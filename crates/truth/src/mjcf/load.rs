//! The load: where it acts, along which axes, and six motors that apply it.

use hexbench_core::{Vector3, Wrench};
use serde_json::Value;

use super::{element::Element, inexpressible};
use crate::{Setup, Situation, TruthError, World};

/// How the commanded wrench reaches the platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LoadPart {
    /// Where the force acts, mobile frame, m.
    pub point: Vector3,
    /// Rotation vector of the axes along which the force is applied, rad.
    pub tilt: Vector3,
    /// The commanded wrench.
    pub wrench: Wrench,
}

impl LoadPart {
    /// The load as the effects of the world describe it, not as the structure has computed it: MuJoCo turns the axes itself.
    ///
    /// # Errors
    /// [`TruthError::Inexpressible`] when the structure carries another load than these effects explain.
    pub(super) fn of(world: &World, situation: &Situation, setup: &Setup) -> Result<Self, TruthError> {
        let point = only(world, "load-offset", "cog", 3)?;
        let angles = only(world, "load-tilt", "tilt", 2)?;
        let load = Self {
            point: Vector3::new(point[0], point[1], point[2]),
            tilt: Vector3::new(angles[0], angles[1], 0.0),
            wrench: situation.wrench,
        };
        if load.explains(setup) { Ok(load) } else { Err(inexpressible("a load beside the commanded one")) }
    }

    /// True when the structure carries one force of the commanded size at the point, and the commanded moment.
    fn explains(&self, setup: &Setup) -> bool {
        const ROUNDING: f64 = 1e-12;
        let acting = setup.wrench.force.norm() + setup.forces.iter().map(|f| f.force.norm()).sum::<f64>();
        let commanded = self.wrench.force.norm();
        (acting - commanded).abs() <= ROUNDING * commanded
            && setup.wrench.moment == self.wrench.moment
            && setup.forces.iter().all(|f| f.point == self.point)
    }

    /// Sites in the fixed frame: axes of moments and of forces.
    pub(super) fn fixed_sites(&self) -> [Element; 2] {
        let axes = Element::new("site").text("name", "load-axes").text("group", "4");
        let angle = self.tilt.norm();
        let turned = if angle == 0.0 {
            axes
        } else {
            let axis = self.tilt / angle;
            axes.numbers("axisangle", &[axis.x, axis.y, axis.z, angle])
        };
        [Element::new("site").text("name", "fixed-axes").text("group", "4"), turned]
    }

    /// Sites in the mobile frame: its origin and where the force acts.
    pub(super) fn mobile_sites(&self) -> [Element; 2] {
        [
            Element::new("site").text("name", "mobile-origin"),
            Element::new("site")
                .text("name", "load")
                .numbers("pos", self.point.as_slice())
                .text("rgba", "0.9 0.2 0.1 1"),
        ]
    }

    /// One motor for each component, in N and N m.
    pub(super) fn motors() -> Element {
        let motor = |(k, name): (usize, &&str)| {
            let (site, axes) = if k < 3 { ("load", "load-axes") } else { ("mobile-origin", "fixed-axes") };
            let mut gear = [0.0; 6];
            gear[k] = 1.0;
            Element::new("motor")
                .text("name", *name)
                .text("site", site)
                .text("refsite", axes)
                .numbers("gear", &gear)
        };
        Element::new("actuator").children(Wrench::NAMES.iter().enumerate().map(motor))
    }

    /// The keyframe with the wrench.
    pub(super) fn keyframe(&self) -> Element {
        let key = Element::new("key").text("name", "loaded").numbers("ctrl", &self.wrench.to_array());
        Element::new("keyframe").child(key)
    }
}

/// Parameters of the one effect with this id, zeros if there is none.
fn only(world: &World, id: &str, key: &str, count: usize) -> Result<Vec<f64>, TruthError> {
    let mut found = world.mechanisms.iter().filter(|m| m.id() == id);
    let Some(mechanism) = found.next() else { return Ok(vec![0.0; count]) };
    if found.next().is_some() {
        return Err(inexpressible("two effects of the same kind on the load"));
    }
    let values: Vec<f64> = match mechanism.parameters().get(key) {
        Some(Value::Array(list)) => list.iter().filter_map(Value::as_f64).collect(),
        _ => Vec::new(),
    };
    if values.len() == count {
        Ok(values)
    } else {
        Err(inexpressible("an effect on the load without its parameters"))
    }
}
