//! Writing `hexapod.toml`.

use super::read_hexapod::FORMAT;
use super::units::{PLAIN, unit_named};
use super::{Dimension, FileError, atomic_write};
use crate::{AngleConvention, Hexapod, Sensor, SensorInput, SensorKind, Tolerances, Vector3};
use std::fmt::Write;
use std::path::Path;

/// The text of `hexapod.toml`, in the units of the format. Reading it gives the same hexapod (within one rounding where
/// the change of unit leaves no shorter decimal).
pub fn hexapod_to_toml(hexapod: &Hexapod) -> String {
    let name = toml::Value::String(hexapod.name.clone());
    let mut text = format!("format = \"{FORMAT}\"\nname = {name}\n\n[geometry]\n");
    add_joints(&mut text, "base_joints_mm", &hexapod.base_joints);
    add_joints(&mut text, "platform_joints_mm", &hexapod.platform_joints);
    if let Some(metrology) = hexapod.metrology {
        text.push_str("\n[metrology]\n");
        add(
            &mut text,
            "sigma_translation_um",
            &in_unit(metrology.sigma_translation, "um", Dimension::Length),
        );
        add(&mut text, "sigma_rotation_urad", &in_unit(metrology.sigma_rotation, "urad", Dimension::Angle));
    }
    if hexapod.angles != AngleConvention::default() {
        text.push_str("\n[conventions]\n");
        add(&mut text, "angles", &format!("{:?}", hexapod.angles.word()));
    }
    add_legs(&mut text, hexapod);
    if let Some(z) = hexapod.mounting_plane_z {
        text.push_str("\n[base]\n");
        add(&mut text, "mounting_plane_z_mm", &millimetres(z));
    }
    if let Some(centre) = hexapod.payload_centre {
        text.push_str("\n[payload]\n");
        add(&mut text, "center_of_gravity_mm", &point(&centre));
    }
    add_tolerances(&mut text, &hexapod.tolerances, hexapod.sensors.is_empty());
    hexapod.sensors.iter().for_each(|sensor| add_sensor(&mut text, sensor));
    text
}

/// The same with a comment at every key, and what may be stated besides as comments.
pub fn hexapod_to_commented_toml(hexapod: &Hexapod) -> String {
    let mut text = hexapod_to_toml(hexapod);
    for (key, comment) in COMMENTS {
        if let Some(at) = text.find(key) {
            text.insert_str(at, comment);
        }
    }
    if hexapod.metrology.is_none() {
        text.push_str(OPEN_METROLOGY);
    }
    text.insert_str(0, HEAD);
    text + OPEN_SECTIONS
}

const HEAD: &str = "\
# A hexapod. Two frames coincide at the zero pose: x, y, z of the fixed frame stand still with the base, those of the
# mobile frame move with the platform. Poses and wrenches in measurements.csv are about their origin.
";

/// Keys, and what is said above each.
const COMMENTS: [(&str, &str); 3] = [
    ("base_joints_mm", "# Centers of the base joints of legs 1 to 6, fixed frame.\n"),
    (
        "platform_joints_mm",
        "# Centers of the platform joints of the same legs, mobile frame; at the zero pose the same numbers hold in the fixed frame.\n",
    ),
    ("sigma_translation_um", "# Standard deviation of ONE reading of a deflection.\n"),
];

const OPEN_METROLOGY: &str = "
# [metrology]                     # standard deviation of ONE reading of a deflection; otherwise repeats show it
# sigma_translation_um = 0.5
# sigma_rotation_urad = 3
";

const OPEN_SECTIONS: &str = "
# [legs]
# nominal_stiffness_N_per_um = [5, 5, 5, 5, 5, 5]
# min_length_mm = 150             # stroke: lengths between the joint centers
# max_length_mm = 200

# [conventions]                   # what alpha, beta, gamma of all files of this machine mean; extrinsic-xyz unless stated
# angles = \"intrinsic-xyz\"        # about axes that move with the platform: the U, V, W of many controllers

# [tolerances]                    # one standard deviation each: what the numbers of this file and of the loads are worth
# joints_mm = 0.05
# load_gain = 0.002
# load_point_mm = 0.5
";

/// Usual tolerances go without saying, and so do those of sensors where there are none.
fn add_tolerances(text: &mut String, tolerances: &Tolerances, without_sensors: bool) {
    let usual = Tolerances::default();
    if *tolerances == usual {
        return;
    }
    text.push_str("\n[tolerances]\n");
    add(text, "joints_mm", &millimetres(tolerances.joints));
    add(text, "load_gain", &format!("{:?}", tolerances.load_gain));
    add(text, "load_direction_deg", &in_unit(tolerances.load_direction, "deg", Dimension::Angle));
    add(text, "load_point_mm", &millimetres(tolerances.load_point));
    add(text, "frame_deg", &in_unit(tolerances.frame, "deg", Dimension::Angle));
    add(text, "noise", &format!("{:?}", tolerances.noise));
    let bits = |t: &Tolerances| SensorInput::ALL.map(|input| input.standard_deviation(t).to_bits());
    if without_sensors && bits(tolerances) == bits(&usual) {
        return;
    }
    add(text, "sensor_point_mm", &millimetres(tolerances.sensor_point));
    add(text, "sensor_direction_deg", &in_unit(tolerances.sensor_direction, "deg", Dimension::Angle));
    add(text, "sensor_gain", &format!("{:?}", tolerances.sensor_gain));
}

fn add_sensor(text: &mut String, sensor: &Sensor) {
    text.push_str("\n[[sensor]]\n");
    add(text, "name", &format!("{:?}", sensor.name));
    add(text, "kind", &format!("{:?}", sensor.kind.word()));
    let um = |sigma: f64| in_unit(sigma, "um", Dimension::Length);
    let plain = |v: &Vector3| list(&[v.x, v.y, v.z].map(|x| format!("{x:?}")));
    match &sensor.kind {
        SensorKind::Distance { point: at, direction, sigma } => {
            add(text, "point_mm", &point(at));
            add(text, "direction", &plain(direction));
            add(text, "sigma_um", &um(*sigma));
        }
        SensorKind::Point { point: at, sigma } => {
            add(text, "point_mm", &point(at));
            add(text, "sigma_um", &list(&sigma.map(um)));
        }
        SensorKind::Inclination { axis, sigma } => {
            add(text, "axis", &plain(axis));
            add(text, "sigma_urad", &in_unit(*sigma, "urad", Dimension::Angle));
        }
        SensorKind::LegLength { leg, sigma } => {
            add(text, "leg", &format!("{}", leg + 1));
            add(text, "sigma_um", &um(*sigma));
        }
        // Reading it back says that no file holds the function.
        SensorKind::Function { is_angle: true, sigma, .. } => {
            add(text, "sigma_urad", &in_unit(*sigma, "urad", Dimension::Angle));
        }
        SensorKind::Function { sigma, .. } => add(text, "sigma_um", &um(*sigma)),
    }
}

/// Writes `hexapod.toml` whole or not at all.
///
/// # Errors
/// A full disk, or a folder that cannot be written to.
pub fn write_hexapod(path: &Path, hexapod: &Hexapod) -> Result<(), FileError> {
    atomic_write(path, |out| out.write_all(hexapod_to_toml(hexapod).as_bytes()))
        .map_err(|cause| FileError::writing(path, cause))
}

fn add(text: &mut String, key: &str, value: &str) {
    // Writing into a String cannot fail.
    let _ = writeln!(text, "{key} = {value}");
}

fn add_joints(text: &mut String, key: &str, joints: &[Vector3; 6]) {
    let rows = joints.each_ref().map(|joint| format!("  {},\n", point(joint)));
    add(text, key, &format!("[\n{}]", rows.concat()));
}

fn add_legs(text: &mut String, hexapod: &Hexapod) {
    let Hexapod { nominal_stiffness, stroke, brackets, .. } = hexapod;
    if nominal_stiffness.is_none() && stroke.is_none() && brackets.is_none() {
        return;
    }
    text.push_str("\n[legs]\n");
    if let Some(stiffness) = nominal_stiffness {
        let values = stiffness.map(|value| in_unit(value, "N_per_um", Dimension::Stiffness));
        add(text, "nominal_stiffness_N_per_um", &list(&values));
    }
    if let Some([shortest, longest]) = *stroke {
        add(text, "min_length_mm", &millimetres(shortest));
        add(text, "max_length_mm", &millimetres(longest));
    }
    if let Some(pairs) = brackets {
        let pairs: Vec<String> = pairs.iter().map(|[i, j]| format!("[{}, {}]", i + 1, j + 1)).collect();
        add(text, "brackets", &list(&pairs));
    }
}

fn point(point: &Vector3) -> String {
    list(&[millimetres(point.x), millimetres(point.y), millimetres(point.z)])
}

fn list(values: &[String]) -> String {
    format!("[{}]", values.join(", "))
}

fn millimetres(metres: f64) -> String {
    in_unit(metres, "mm", Dimension::Length)
}

/// `{:?}` keeps a point or exponent in every float, as TOML wants it.
fn in_unit(si: f64, unit: &str, kind: Dimension) -> String {
    format!("{:?}", unit_named(unit, kind).unwrap_or(&PLAIN).from_si(si))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Metrology;

    fn machine() -> Hexapod {
        let ring = |z: f64| std::array::from_fn(|k| Vector3::new((k as f64).cos(), (k as f64).sin(), z));
        Hexapod::of_joints("ring", ring(-1.0), ring(0.0))
    }

    #[test]
    fn tolerances_of_sensors_are_written_where_there_are_sensors_or_where_they_are_stated() {
        let tolerances = Tolerances { joints: 1e-4, ..Tolerances::default() };
        let without = Hexapod { tolerances, ..machine() };
        let text = hexapod_to_toml(&without);
        assert!(text.contains("joints_mm = 0.1") && !text.contains("sensor_"), "{text}");
        let kind = SensorKind::LegLength { leg: 0, sigma: 1e-6 };
        let with = Hexapod { sensors: vec![Sensor::new("s", kind)], ..without.clone() };
        assert!(hexapod_to_toml(&with).contains("sensor_point_mm = 0.5"));
        let stated = Tolerances { sensor_point: 1e-3, ..tolerances };
        let text = hexapod_to_toml(&Hexapod { tolerances: stated, ..without });
        assert!(text.contains("sensor_point_mm = 1.0"), "{text}");
    }

    #[test]
    fn angles_are_written_where_they_are_not_those_of_the_format_and_open_noise_as_a_comment() {
        let angles = AngleConvention::FixedZyx;
        let text = hexapod_to_toml(&Hexapod { angles, ..machine() });
        assert!(text.contains(&format!("angles = {:?}", angles.word())), "{text}");
        assert!(!hexapod_to_toml(&machine()).contains("angles ="));
        let metrology = Some(Metrology { sigma_translation: 1e-6, sigma_rotation: 1e-6 });
        let [open, stated] =
            [machine(), Hexapod { metrology, ..machine() }].map(|h| hexapod_to_commented_toml(&h));
        assert!(open.contains(OPEN_METROLOGY) && !stated.contains(OPEN_METROLOGY));
    }
}
