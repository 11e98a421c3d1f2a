//! A leg: uniform rods on a universal joint, springs between them.

use hexbench_core::Vector3;

use super::{element::Element, part::LegPart, yielding::damping};

/// Rods of a leg without weight: one spring between two.
const RODS: usize = 2;
/// Rods of a leg with weight: the axial force changes along it, four springs in series sample it.
const RODS_WITH_WEIGHT: usize = 5;
/// Mass of a leg that has no weight, kg; it has no part in the state of rest.
const WEIGHTLESS_MASS_KG: f64 = 1.0;
/// Mass of the head of a leg with a bending platform joint, kg. MuJoCo's force sensors count weight that `gravcomp` has taken
/// away, so it is next to nothing, and the head's joints have rotors in its place.
const HEAD_MASS_KG: f64 = 1e-6;
/// Inertia of those rotors, share of a rod's inertia about the far end of the leg.
const HEAD_ROTOR: f64 = 0.1;
/// Damping of the joints' rotation, share of the leg's inertia per second.
const SWING_DAMPING_PER_S: f64 = 20.0;

/// Sizes and stiffness that all legs share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LegStyle {
    /// Radius of the lowest rod, m.
    pub radius: f64,
    /// Mass that the legs hold, kg: sets the damping.
    pub held_mass: f64,
    /// Bending stiffness of base and platform joints, N m/rad.
    pub joint_stiffness: [f64; 2],
}

impl LegPart {
    /// Number of rods.
    pub(super) fn rods(&self) -> usize {
        if self.mass.is_some() { RODS_WITH_WEIGHT } else { RODS }
    }

    /// Mass of one rod, kg.
    pub(super) fn rod_mass(&self) -> f64 {
        self.mass.unwrap_or(WEIGHTLESS_MASS_KG) / self.rods() as f64
    }

    /// Stiffness of each of the springs between the rods, N/m.
    pub(super) fn spring_stiffness(&self) -> f64 {
        self.stiffness * (self.rods() - 1) as f64
    }

    fn name(&self) -> String {
        format!("leg-{}", self.number)
    }

    /// The leg as a body of the base.
    pub(super) fn body(&self, style: &LegStyle) -> Element {
        let upper = (1..self.rods()).rev().fold(self.end(style), |above, j| vec![self.rod(j, above, style)]);
        let lowest = Element::new("body")
            .text("name", self.name())
            .numbers("pos", self.base_joint.as_slice())
            .numbers("zaxis", self.direction.as_slice());
        lowest
            .children(self.bending_joints("base", style.joint_stiffness[0]))
            .child(ball(style.radius * 1.3, 0.0))
            .child(self.cylinder(0, style))
            .children(upper)
    }

    fn rod_length(&self) -> f64 {
        self.length / self.rods() as f64
    }

    /// Rod `j` with what follows above it.
    fn rod(&self, j: usize, above: Vec<Element>, style: &LegStyle) -> Element {
        let springs = (self.rods() - 1) as f64;
        let stiffness = self.spring_stiffness();
        let slide = Element::new("joint")
            .text("name", format!("leg-{}-slide-{j}", self.number))
            .text("type", "slide")
            .numbers("axis", Vector3::z().as_slice())
            .number("stiffness", stiffness)
            .number("springref", self.relaxed / springs)
            .number("damping", springs * damping(self.stiffness, style.held_mass));
        Element::new("body")
            .text("name", format!("leg-{}-rod-{j}", self.number))
            .numbers("pos", &[0.0, 0.0, self.rod_length()])
            .child(slide)
            .child(self.cylinder(j, style))
            .child(Element::new("site").text("name", self.force_site(j)).text("group", "4"))
            .children(above)
    }

    /// A uniform rod; each is thinner than the one below it.
    fn cylinder(&self, j: usize, style: &LegStyle) -> Element {
        let colour = if j == 0 { "0.25 0.28 0.32 1" } else { "0.75 0.78 0.82 1" };
        Element::new("geom")
            .text("type", "cylinder")
            .numbers("fromto", &[0.0, 0.0, 0.0, 0.0, 0.0, self.rod_length()])
            .number("size", style.radius * (1.0 - 0.15 * j as f64))
            .number("mass", self.rod_mass())
            .text("rgba", colour)
    }

    /// The upper end: a site to be closed onto the platform, or a head on a bending joint to be welded to it.
    fn end(&self, style: &LegStyle) -> Vec<Element> {
        let stiffness = style.joint_stiffness[1];
        let place = [0.0, 0.0, self.rod_length()];
        if stiffness == 0.0 {
            let site = Element::new("site").text("name", format!("leg-{}-end", self.number));
            return vec![site.text("group", "4").numbers("pos", &place)];
        }
        let rotor = HEAD_ROTOR * self.swing_inertia();
        let twist = self.hinge("twist", Vector3::z(), 0.0);
        let bending = self.bending_joints("platform", stiffness);
        let head = Element::new("body")
            .text("name", format!("leg-{}-head", self.number))
            .numbers("pos", &place)
            .child(twist.number("armature", rotor))
            .children(bending.map(|joint| joint.number("armature", rotor)))
            .child(ball(style.radius, HEAD_MASS_KG));
        vec![head]
    }

    fn bending_joints(&self, end: &str, stiffness: f64) -> [Element; 2] {
        [("x", Vector3::x()), ("y", Vector3::y())]
            .map(|(name, axis)| self.hinge(&format!("{end}-{name}"), axis, stiffness))
    }

    /// Inertia of a rod about the far end of the leg, kg m^2.
    fn swing_inertia(&self) -> f64 {
        self.rod_mass() * self.length * self.length
    }

    fn hinge(&self, name: &str, axis: Vector3, stiffness: f64) -> Element {
        let inertia = self.swing_inertia();
        let hinge = Element::new("joint")
            .text("name", format!("leg-{}-{name}", self.number))
            .text("type", "hinge")
            .numbers("axis", axis.as_slice())
            .number("damping", SWING_DAMPING_PER_S * inertia + damping(stiffness, inertia));
        if stiffness == 0.0 { hinge } else { hinge.number("stiffness", stiffness) }
    }

    /// What closes the leg onto a body that it holds.
    pub(super) fn closure(&self, style: &LegStyle, held: &str) -> Element {
        let name = format!("leg-{}-closure", self.number);
        if style.joint_stiffness[1] == 0.0 {
            return Element::new("connect")
                .text("name", name)
                .text("site1", format!("leg-{}-end", self.number))
                .text("site2", self.platform_site_name());
        }
        Element::new("weld")
            .text("name", name)
            .text("body1", format!("leg-{}-head", self.number))
            .text("body2", held)
            .numbers("anchor", self.platform_joint.as_slice())
    }

    /// Where the leg meets the body it holds.
    pub(super) fn platform_site(&self) -> Element {
        let site = Element::new("site").text("name", self.platform_site_name());
        site.numbers("pos", self.platform_joint.as_slice())
    }

    fn platform_site_name(&self) -> String {
        format!("leg-{}-platform-joint", self.number)
    }

    fn force_site(&self, j: usize) -> String {
        format!("leg-{}-rod-{j}-foot", self.number)
    }

    /// Axial force between the rods.
    pub(super) fn sensors(&self) -> Vec<Element> {
        let sensor = |j| {
            Element::new("force")
                .text("name", format!("leg-{}-force-{j}", self.number))
                .text("site", self.force_site(j))
        };
        (1..self.rods()).map(sensor).collect()
    }
}

fn ball(radius: f64, mass: f64) -> Element {
    let ball = Element::new("geom").text("type", "sphere").number("size", radius).number("mass", mass);
    ball.text("rgba", "0.85 0.6 0.15 1")
}
