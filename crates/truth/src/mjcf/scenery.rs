//! What only the eye needs: floor, lights, cameras, shapes without mass.

use hexbench_core::Vector3;

use super::element::Element;

/// Sizes of the machine for its looks, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Looks {
    /// Mean distance of the platform joints from the mobile origin.
    pub platform_radius: f64,
    /// Mean distance of the base joints from the base center.
    pub base_radius: f64,
    /// Height of the base center, fixed frame.
    pub base_height: f64,
}

impl Looks {
    /// Radius of the lowest rod of a leg.
    pub(super) fn rod_radius(&self) -> f64 {
        0.06 * self.platform_radius
    }

    fn thickness(&self) -> f64 {
        0.08 * self.platform_radius
    }

    fn reach(&self) -> f64 {
        self.base_radius - self.base_height.min(0.0)
    }

    /// Where the free camera of the viewer looks.
    pub(super) fn statistic(&self) -> Element {
        let middle = [0.0, 0.0, 0.5 * self.base_height];
        Element::new("statistic").numbers("center", &middle).number("extent", self.reach())
    }

    /// Window and shadows.
    pub(super) fn visual() -> Element {
        let headlight = Element::new("headlight").text("ambient", "0.35 0.35 0.35");
        let window = Element::new("global").text("offwidth", "1280").text("offheight", "960");
        Element::new("visual").child(window).child(headlight)
    }

    /// Sky and floor pattern.
    pub(super) fn assets() -> Element {
        let texture = || Element::new("texture").text("width", "256").text("height", "256");
        let sky = texture().text("type", "skybox").text("builtin", "gradient");
        let grid = texture().text("name", "grid").text("type", "2d").text("builtin", "checker");
        let material = Element::new("material").text("name", "grid").text("texture", "grid");
        Element::new("asset")
            .child(sky.text("rgb1", "0.75 0.82 0.9").text("rgb2", "0.95 0.97 1"))
            .child(grid.text("rgb1", "0.82 0.83 0.85").text("rgb2", "0.76 0.77 0.8"))
            .child(material.text("texrepeat", "8 8"))
    }

    /// Floor, light and cameras.
    pub(super) fn surroundings(&self) -> [Element; 4] {
        let floor = self.base_height - 4.0 * self.thickness();
        let reach = self.reach();
        let camera = |name, pos: [f64; 3]| {
            let camera = Element::new("camera").text("name", name).numbers("pos", &pos);
            camera.text("mode", "targetbody").text("target", "base")
        };
        [
            Element::new("geom")
                .text("type", "plane")
                .numbers("pos", &[0.0, 0.0, floor])
                .numbers("size", &[4.0 * reach, 4.0 * reach, 0.1 * reach])
                .text("material", "grid"),
            Element::new("light").numbers("pos", &[reach, -reach, 4.0 * reach]).text("dir", "-0.2 0.2 -1"),
            camera("overview", [2.4 * reach, -2.4 * reach, 1.2 * reach]),
            camera("side", [0.0, -3.5 * reach, 0.5 * self.base_height]),
        ]
    }

    /// A disc under the base joints.
    pub(super) fn base_disc(&self) -> Element {
        disc(1.15 * self.base_radius, self.thickness(), -self.thickness(), "0.35 0.37 0.4 1")
    }

    /// A disc through the platform joints.
    pub(super) fn platform_disc(&self, joints: &Vector3) -> Element {
        disc(self.platform_radius.hypot(joints.z), 0.5 * self.thickness(), joints.z, "0.15 0.4 0.7 0.85")
    }
}

/// A disc without mass.
fn disc(radius: f64, half_thickness: f64, z: f64, colour: &str) -> Element {
    Element::new("geom")
        .text("type", "cylinder")
        .numbers("size", &[radius, half_thickness])
        .numbers("pos", &[0.0, 0.0, z])
        .text("mass", "0")
        .text("rgba", colour)
}
