//! The whole model.

use hexbench_core::{Sensor, Vector3};

use super::{
    element::Element,
    leg::LegStyle,
    load::LoadPart,
    part::{GRAVITY_M_PER_S2, LegPart, Parts},
    scenery::Looks,
    yielding,
};
use crate::{Situation, TruthError, World, setup::Cable};

/// Mass of platform and base, kg: they set how fast rest comes, not where it is.
const BODY_MASS_KG: f64 = 10.0;
/// Longest time step, s.
const LONGEST_STEP_S: f64 = 1e-4;
/// Time step per radian of the fastest oscillation; explicit integration of springs is stable below 2.
const STEP_PER_RADIAN: f64 = 0.3;
/// Softness of the closures: time constant in steps, and the share of the exact constraint force (MuJoCo allows no more).
const CLOSURE_STEPS: f64 = 2.0;
const CLOSURE_IMPEDANCE: f64 = 0.9999;

/// The machine at a commanded pose as an MJCF document, the wrench of the situation in its keyframe.
///
/// # Errors
/// [`TruthError::Inexpressible`] names what MJCF lacks; [`TruthError::Unreachable`], [`TruthError::NotFinite`].
pub fn export(world: &World, situation: &Situation) -> Result<String, TruthError> {
    let setup = world.structure(situation)?;
    let model = Model {
        name: &world.hexapod.name,
        pose: situation.pose.to_array(),
        parts: Parts::of(&setup)?,
        load: LoadPart::of(world, situation, &setup)?,
        sensors: &world.hexapod.sensors,
    };
    model.root().document()
}

struct Model<'a> {
    name: &'a str,
    pose: [f64; 6],
    parts: Parts,
    load: LoadPart,
    sensors: &'a [Sensor],
}

impl Model<'_> {
    fn root(&self) -> Element {
        let looks = self.looks();
        let style = LegStyle {
            radius: looks.rod_radius(),
            held_mass: BODY_MASS_KG,
            joint_stiffness: self.parts.joint_stiffness,
        };
        Element::new("mujoco")
            .text("model", self.name)
            .child(Element::new("compiler").text("angle", "radian").text("eulerseq", "XYZ"))
            .child(self.option())
            .child(looks.statistic())
            .child(Looks::visual())
            .child(Looks::assets())
            .child(self.worldbody(&looks, &style))
            .children(self.cables())
            .child(self.closures(&style))
            .child(LoadPart::motors())
            .child(self.sensors())
            .child(self.load.keyframe())
    }

    fn looks(&self) -> Looks {
        let mean = |points: [Vector3; 6]| points.iter().map(nalgebra::Matrix::norm).sum::<f64>() / 6.0;
        Looks {
            platform_radius: mean(self.parts.legs.map(|leg| leg.platform_joint)),
            base_radius: mean(self.parts.legs.map(|leg| leg.base_joint)),
            base_height: self.parts.base_centre.z,
        }
    }

    fn time_step(&self) -> f64 {
        let leg = &self.parts.legs[0];
        let fastest = (4.0 * self.parts.stiffest_leg() / leg.stiffness * leg.spring_stiffness()
            / leg.rod_mass())
        .sqrt();
        LONGEST_STEP_S.min(STEP_PER_RADIAN / fastest)
    }

    fn option(&self) -> Element {
        let gravity = if self.parts.has_weight() { -GRAVITY_M_PER_S2 } else { 0.0 };
        Element::new("option")
            .number("timestep", self.time_step())
            .numbers("gravity", &[0.0, 0.0, gravity])
            .text("integrator", "implicitfast")
            .text("solver", "Newton")
            .text("tolerance", "1e-14")
            .child(Element::new("flag").text("contact", "disable"))
    }

    fn worldbody(&self, looks: &Looks, style: &LegStyle) -> Element {
        Element::new("worldbody")
            .children(looks.surroundings())
            .children(self.load.fixed_sites())
            .children(self.anchors())
            .child(self.base(looks, style))
            .child(self.platform(looks))
    }

    fn base(&self, looks: &Looks, style: &LegStyle) -> Element {
        let springs = self.parts.base.unwrap_or_default();
        body("base", looks.base_radius)
            .numbers("pos", self.parts.base_centre.as_slice())
            .children(yielding::joints("base", &springs, BODY_MASS_KG, looks.base_radius))
            .child(looks.base_disc())
            .children(self.parts.legs.iter().map(|leg| leg.body(style)))
    }

    /// The body that the legs hold; the loaded and measured one is the same unless the plate yields.
    fn platform(&self, looks: &Looks) -> Element {
        let [a, b, c, alpha, beta, gamma] = self.pose;
        let centre = self.parts.legs.iter().map(|leg| leg.platform_joint).sum::<Vector3>() / 6.0;
        let held = body(self.held(), looks.platform_radius)
            .numbers("pos", &[a, b, c])
            .numbers("euler", &[alpha, beta, gamma])
            .child(Element::new("freejoint").text("name", "held"))
            .child(looks.platform_disc(&centre))
            .children(self.parts.legs.iter().map(LegPart::platform_site));
        let seen = self.load.mobile_sites().into_iter().chain(self.attachments()).chain(self.points());
        match &self.parts.plate {
            None => held.children(seen),
            Some(springs) => {
                let radius = looks.platform_radius;
                let joints = yielding::joints("platform", springs, BODY_MASS_KG, radius);
                held.child(body("platform", radius).children(joints).children(seen))
            }
        }
    }

    fn held(&self) -> &'static str {
        if self.parts.plate.is_some() { "plate" } else { "platform" }
    }

    fn closures(&self, style: &LegStyle) -> Element {
        let softness = |closure: Element| {
            closure
                .numbers("solref", &[CLOSURE_STEPS * self.time_step(), 1.0])
                .numbers("solimp", &[CLOSURE_IMPEDANCE, CLOSURE_IMPEDANCE, 1e-3])
        };
        let closures = self.parts.legs.iter().map(|leg| softness(leg.closure(style, self.held())));
        Element::new("equality").children(closures)
    }

    fn sensors(&self) -> Element {
        let place = |kind, name: &str| {
            let sensor = Element::new(kind).text("name", name).text("objtype", "site");
            sensor.text("objname", "mobile-origin")
        };
        Element::new("sensor")
            .children(self.parts.legs.iter().flat_map(LegPart::sensors))
            .child(place("framepos", "position"))
            .child(place("framequat", "orientation"))
    }

    /// Points of the platform at which sensors look.
    fn points(&self) -> impl Iterator<Item = Element> + '_ {
        self.sensors.iter().filter_map(|sensor| {
            let site = Element::new("site").text("name", format!("sensor-{}", sensor.name));
            Some(site.numbers("pos", sensor.kind.point()?.as_slice()))
        })
    }

    fn anchors(&self) -> Vec<Element> {
        let anchor = |(i, cable): (usize, &Cable)| {
            Element::new("site")
                .text("name", format!("cable-{}-anchor", i + 1))
                .numbers("pos", cable.anchor.as_slice())
        };
        self.parts.cables.iter().enumerate().map(anchor).collect()
    }

    fn attachments(&self) -> Vec<Element> {
        let site = |(i, cable): (usize, &Cable)| {
            let site = Element::new("site").text("name", format!("cable-{}-end", i + 1));
            site.numbers("pos", cable.attachment.as_slice())
        };
        self.parts.cables.iter().enumerate().map(site).collect()
    }

    fn cables(&self) -> Option<Element> {
        let tendon = |(i, cable): (usize, &Cable)| {
            let site = |end: &str| Element::new("site").text("site", format!("cable-{}-{end}", i + 1));
            Element::new("spatial")
                .text("name", format!("cable-{}", i + 1))
                .number("stiffness", cable.stiffness)
                .number("springlength", cable.free_length)
                .child(site("anchor"))
                .child(site("end"))
        };
        let tendons = self.parts.cables.iter().enumerate().map(tendon);
        (!self.parts.cables.is_empty()).then(|| Element::new("tendon").children(tendons))
    }
}

/// A body without weight, its mass at its origin.
fn body(name: &str, radius: f64) -> Element {
    let inertia = BODY_MASS_KG * radius * radius;
    let inertial = Element::new("inertial")
        .numbers("pos", &[0.0; 3])
        .number("mass", BODY_MASS_KG)
        .numbers("diaginertia", &[0.5 * inertia, 0.5 * inertia, inertia]);
    Element::new("body").text("name", name).text("gravcomp", "1").child(inertial)
}
