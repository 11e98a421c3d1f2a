//! How well the inputs of a model are known.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::dataset::Measurand;
use crate::words::to_digits;

/// What the numbers of a machine and its loads are worth: one standard deviation each, never zero. SI, as model files name them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerances {
    /// Of every coordinate of a joint, m.
    #[serde(rename = "joints_m")]
    pub joints: f64,
    /// Of the scale of every component of the loads, relative.
    pub load_gain: f64,
    /// Of the direction of the loads about each axis, rad.
    #[serde(rename = "load_direction_rad")]
    pub load_direction: f64,
    /// Of the point at which the loads act, each coordinate in the mobile frame, m.
    #[serde(rename = "load_point_m")]
    pub load_point: f64,
    /// Of the axes of the readings about each axis, rad.
    #[serde(rename = "frame_rad")]
    pub frame: f64,
    /// Of a stated standard deviation of the noise, relative.
    pub noise: f64,
    /// Of each coordinate of the point that a sensor looks at, m.
    #[serde(rename = "sensor_point_m", default = "usual_sensor_point")]
    pub sensor_point: f64,
    /// Of the direction or axis of a sensor, rad.
    #[serde(rename = "sensor_direction_rad", default = "usual_sensor_direction")]
    pub sensor_direction: f64,
    /// Of what a sensor shows over what it should, relative.
    #[serde(default = "usual_sensor_gain")]
    pub sensor_gain: f64,
}

// Files of earlier versions say nothing of sensors.
fn usual_sensor_point() -> f64 {
    Tolerances::default().sensor_point
}

fn usual_sensor_direction() -> f64 {
    Tolerances::default().sensor_direction
}

fn usual_sensor_gain() -> f64 {
    Tolerances::default().sensor_gain
}

impl Default for Tolerances {
    /// A machine built with care and loaded by hand: joints to 0.05 mm, load cells to 0.2 %, directions to 0.05 degrees, the point of
    /// attack to 0.5 mm, axes to 0.02 degrees, a stated noise to 10 %, sensors set up by hand to 0.5 mm and 0.5 degrees and calibrated to
    /// 0.2 %.
    fn default() -> Self {
        Self {
            joints: 5e-5,
            load_gain: 2e-3,
            load_direction: 0.05_f64.to_radians(),
            load_point: 5e-4,
            frame: 0.02_f64.to_radians(),
            noise: 0.1,
            sensor_point: 5e-4,
            sensor_direction: 0.5_f64.to_radians(),
            sensor_gain: 2e-3,
        }
    }
}

impl Tolerances {
    /// Every one of them of this size.
    pub fn every(size: f64) -> Self {
        Self {
            joints: size,
            load_gain: size,
            load_direction: size,
            load_point: size,
            frame: size,
            noise: size,
            sensor_point: size,
            sensor_direction: size,
            sensor_gain: size,
        }
    }

    /// All of them.
    pub fn all(&self) -> [f64; 9] {
        let Self {
            joints,
            load_gain,
            load_direction,
            load_point,
            frame,
            noise,
            sensor_point,
            sensor_direction,
            sensor_gain,
        } = *self;
        let of_inputs = [joints, load_gain, load_direction, load_point, frame, noise];
        let of_sensors = [sensor_point, sensor_direction, sensor_gain];
        std::array::from_fn(|k| if k < 6 { of_inputs[k] } else { of_sensors[k - 6] })
    }
}

/// Tolerances of the inputs of a model in the units of the hexapod file, as a plan assumes them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StatedTolerances {
    /// Of every coordinate of a joint; none for absolute poses, where joints are an effect of the catalogue.
    pub joints_mm: Option<f64>,
    /// Of the scale of every component of the loads, relative.
    pub load_gain: f64,
    /// Of the direction of the loads about each axis.
    pub load_direction_deg: f64,
    /// Of the point at which the loads act.
    pub load_point_mm: f64,
    /// Of the axes of the readings about each axis; none for absolute poses, whose frames are estimated.
    pub frame_deg: Option<f64>,
}

impl StatedTolerances {
    /// Those that count for readings of a kind.
    pub fn of(tolerances: &Tolerances, measurand: Measurand) -> Self {
        match measurand {
            Measurand::AbsolutePose => Self { joints_mm: None, frame_deg: None, ..Self::from(tolerances) },
            _ => Self::from(tolerances),
        }
    }
}

impl From<&Tolerances> for StatedTolerances {
    fn from(t: &Tolerances) -> Self {
        Self {
            joints_mm: Some(plain(t.joints * 1e3)),
            load_gain: t.load_gain,
            load_direction_deg: plain(t.load_direction.to_degrees()),
            load_point_mm: plain(t.load_point * 1e3),
            frame_deg: Some(plain(t.frame.to_degrees())),
        }
    }
}

impl fmt::Display for StatedTolerances {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(joints) = self.joints_mm {
            write!(f, "joints {joints} mm, ")?;
        }
        let gain = plain(100.0 * self.load_gain);
        write!(f, "load gain {gain} %, load direction {} deg, ", self.load_direction_deg)?;
        write!(f, "load point {} mm", self.load_point_mm)?;
        match self.frame_deg {
            Some(frame) => write!(f, ", axes of the readings {frame} deg"),
            None => Ok(()),
        }
    }
}

/// Without the rounding that a change of unit brings.
fn plain(x: f64) -> f64 {
    to_digits(x, 12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_tolerances_are_told_in_the_units_of_the_file() {
        let told = StatedTolerances::from(&Tolerances::default()).to_string();
        let expected = "joints 0.05 mm, load gain 0.2 %, load direction 0.05 deg, load point 0.5 mm, axes of the readings 0.02 deg";
        assert_eq!(told, expected);
        let of_loads = StatedTolerances::of(&Tolerances::default(), Measurand::AbsolutePose).to_string();
        assert_eq!(of_loads, "load gain 0.2 %, load direction 0.05 deg, load point 0.5 mm");
    }
}
