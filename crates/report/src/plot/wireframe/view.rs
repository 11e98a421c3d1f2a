//! A side from which bodies are seen, in parallel projection.

#[derive(Debug, Clone, PartialEq)]
pub(super) struct View {
    pub(super) name: String,
    /// Turn about the z axis, then tilt towards the viewer, rad.
    azimuth: f64,
    elevation: f64,
}

impl View {
    /// Angles in degrees.
    pub(super) fn new(name: impl Into<String>, azimuth_deg: f64, elevation_deg: f64) -> Self {
        Self { name: name.into(), azimuth: azimuth_deg.to_radians(), elevation: elevation_deg.to_radians() }
    }

    /// Right and up on the page.
    pub(super) fn project(&self, [x, y, z]: &[f64; 3]) -> [f64; 2] {
        let (sa, ca) = self.azimuth.sin_cos();
        let (se, ce) = self.elevation.sin_cos();
        [ca * x + sa * y, se * (ca * y - sa * x) + ce * z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_above_x_is_right_and_y_is_up() {
        let view = View::new("", 0.0, 90.0);
        let [right, up] = view.project(&[2.0, 3.0, 7.0]);
        assert!((right - 2.0).abs() < 1e-12 && (up - 3.0).abs() < 1e-12, "{right} {up}");
    }

    #[test]
    fn from_the_front_z_is_up() {
        let view = View::new("", 0.0, 0.0);
        assert!((view.project(&[2.0, 3.0, 7.0])[1] - 7.0).abs() < 1e-12);
    }
}
