//! A machine as its drawing shows it: from above in characters, and as a picture.

use hexbench_core::{Hexapod, Sensor, SensorKind, Vector3};

use super::machine::unloaded;
use crate::number::significant;
use crate::page::{Block, Definition, Section};
use crate::plot::{Edge, PlotError, Wireframe};

/// Columns and rows of the view from above; a row is as high as two columns are wide.
const COLUMNS: usize = 49;
const ROWS: usize = 25;
/// Joints of the legs in their order.
const BASE: [char; 6] = ['1', '2', '3', '4', '5', '6'];
const PLATFORM: [char; 6] = ['a', 'b', 'c', 'd', 'e', 'f'];

/// Sensors in their order; those beyond have no letter of their own.
const SENSORS: [char; 26] = [
    'A', 'B', 'C', 'D', 'E', 'F', 'G', 'H', 'I', 'J', 'K', 'L', 'M', 'N', 'O', 'P', 'Q', 'R', 'S', 'T', 'U',
    'V', 'W', 'X', 'Y', 'Z',
];
const ONE_OF_MANY: char = '*';
/// Length of the axes of the frames, in radii of the platform.
const AXES: f64 = 0.5;
/// Length at which a gauge is drawn, and half the size of a point, in radii of the platform.
const GAUGE: f64 = 0.4;
const POINT: f64 = 0.06;
/// Distance at which a scale is drawn beside its leg, and sensors of angles from the mobile origin, in radii of the platform.
const BESIDE: f64 = 0.06;

/// The machine at the zero pose from the side and from above, with the axes of its frames and its sensors, as SVG; joints are marked as in
/// [`view_from_above`].
///
/// # Errors
/// [`PlotError::NotFinite`].
pub fn drawing(hexapod: &Hexapod) -> Result<String, PlotError> {
    let joints: [[Vector3; 2]; 6] =
        std::array::from_fn(|leg| [hexapod.base_joints[leg], hexapod.platform_joints[leg]]);
    let machine = Wireframe::new(format!("{} at the zero pose", hexapod.name))
        .seen("from the front, a little from above", 25.0, 22.0)
        .seen("from above, x to the right", 0.0, 90.0)
        .with("base (1 to 6), platform (a to f) and legs", Some(0), unloaded(&joints))
        .with("axes at the origin", None, tips(hexapod).map(|tip| [[0.0; 3], tip.into()]).to_vec());
    let of_kind = |word: &str| {
        let sensors = hexapod.sensors.iter().filter(|s| s.kind.word() == word);
        sensors.flat_map(|s| edges(hexapod, s)).collect::<Vec<Edge>>()
    };
    let mut words: Vec<&str> = Vec::new();
    for sensor in &hexapod.sensors {
        if !words.contains(&sensor.kind.word()) {
            words.push(sensor.kind.word());
        }
    }
    let with = |drawing: Wireframe, (k, word): (usize, &str)| {
        drawing.with(format!("sensors: {word}"), Some(1 + k), of_kind(word))
    };
    let machine = words.into_iter().enumerate().fold(machine, with);
    let joints = hexapod.base_joints.iter().zip(BASE).chain(hexapod.platform_joints.iter().zip(PLATFORM));
    let marks =
        joints.map(|(joint, mark)| (mark, *joint)).chain(['x', 'y', 'z'].into_iter().zip(tips(hexapod)));
    marks.fold(machine, |drawing, (mark, at)| drawing.marked(mark, at.into())).to_svg()
}

/// Ends of the axes, which both frames share at the zero pose.
fn tips(hexapod: &Hexapod) -> [Vector3; 3] {
    std::array::from_fn(|k| Vector3::ith(k, AXES * hexapod.platform_radius()))
}

/// A gauge looks along its direction at its point, a reflector is a cross, a level its axis through the mobile origin, a scale stands
/// beside its leg.
fn edges(hexapod: &Hexapod, sensor: &Sensor) -> Vec<Edge> {
    let radius = hexapod.platform_radius();
    let edge = |from: Vector3, to: Vector3| [from.into(), to.into()];
    match &sensor.kind {
        SensorKind::Distance { point, direction, .. } => {
            let across =
                direction.cross(&Vector3::ith(direction.iamin(), 1.0)).normalize() * (0.5 * POINT * radius);
            let tip = point + direction * (POINT * radius);
            vec![
                edge(*point, point + direction * (GAUGE * radius)),
                edge(*point, tip + across),
                edge(*point, tip - across),
            ]
        }
        SensorKind::Point { point, .. } => (0..3)
            .map(|k| Vector3::ith(k, POINT * radius))
            .map(|arm| edge(point - arm, point + arm))
            .collect(),
        SensorKind::Inclination { axis, .. } => {
            let arm = axis * (0.5 * GAUGE * radius);
            vec![edge(-arm, arm)]
        }
        SensorKind::LegLength { leg, .. } => {
            let [base, platform] = [hexapod.base_joints[*leg], hexapod.platform_joints[*leg]];
            let out = Vector3::new(base.x + platform.x, base.y + platform.y, 0.0);
            let beside = out / out.norm().max(f64::MIN_POSITIVE) * (BESIDE * radius);
            vec![edge(base + beside, platform + beside)]
        }
        SensorKind::Function { .. } => Vec::new(),
    }
}

/// The sensors of a machine one by one, and where they are from above; none without sensors.
pub fn sensors(hexapod: &Hexapod) -> Option<Section> {
    let entry = |(k, sensor): (usize, &Sensor)| Definition::new(label(k, sensor), about(sensor));
    let section = Section::new("Sensors")
        .id("sensors")
        .remark("labels as in the view from above: 1 to 6 base joints, a to f platform joints; x to the right, y up")
        .with(Block::entries(hexapod.sensors.iter().enumerate().map(entry)))
        .with(Block::Code { text: view_from_above(hexapod) });
    (!hexapod.sensors.is_empty()).then_some(section)
}

fn mark(k: usize) -> char {
    SENSORS.get(k).copied().unwrap_or(ONE_OF_MANY)
}

fn label(k: usize, sensor: &Sensor) -> String {
    if sensor.kind.point().is_some() { format!("{} {}", mark(k), sensor.name) } else { sensor.name.clone() }
}

fn about(sensor: &Sensor) -> String {
    let list =
        |v: &Vector3, scale: f64| v.iter().map(|x| significant(x * scale, 4)).collect::<Vec<_>>().join(", ");
    let word = sensor.kind.word();
    let micro = |sigma: f64| significant(sigma * 1e6, 3);
    match &sensor.kind {
        SensorKind::Distance { point, direction, sigma } => format!(
            "{word} of ({}) mm along ({}), {} um per reading",
            list(point, 1e3),
            list(direction, 1.0),
            micro(*sigma)
        ),
        SensorKind::Point { point, sigma } => {
            format!("{word} at ({}) mm, {} um per reading", list(point, 1e3), sigma.map(micro).join(", "))
        }
        SensorKind::Inclination { axis, sigma } => {
            format!("{word} about ({}), {} urad per reading", list(axis, 1.0), micro(*sigma))
        }
        SensorKind::LegLength { leg, sigma } => {
            format!("{word} of leg {}, {} um per reading", leg + 1, micro(*sigma))
        }
        SensorKind::Function { is_angle, sigma, .. } => {
            let unit = if *is_angle { "urad" } else { "um" };
            format!("{word} of the pose, {} {unit} per reading", micro(*sigma))
        }
    }
}

/// The machine at the zero pose from above: 1 to 6 are base joints, a to f the platform joints of the same legs, A to Z the points of the
/// sensors in their order; x to the right, y up.
pub fn view_from_above(hexapod: &Hexapod) -> String {
    let (base, platform) = (&hexapod.base_joints, &hexapod.platform_joints);
    let points = || hexapod.sensors.iter().enumerate().filter_map(|(k, s)| Some((k, s.kind.point()?)));
    let joints = base.iter().chain(platform);
    let reach =
        joints.chain(points().map(|(_, p)| p)).map(|j| j.xy().amax()).fold(f64::MIN_POSITIVE, f64::max);
    let at = |x: f64, y: f64| (ROWS - 1 - cell(y / reach, ROWS), cell(x / reach, COLUMNS));
    let mut cells = vec![[' '; COLUMNS]; ROWS];
    let mut put = |(row, column): (usize, usize), mark: char| cells[row][column] = mark;
    for (from, to) in base.iter().zip(platform) {
        for step in 0..=COLUMNS {
            let between = from.lerp(to, step as f64 / COLUMNS as f64);
            put(at(between.x, between.y), '.');
        }
    }
    put(at(0.0, 0.0), '+');
    for (joints, marks) in [(base, BASE), (platform, PLATFORM)] {
        joints.iter().zip(marks).for_each(|(joint, mark)| put(at(joint.x, joint.y), mark));
    }
    for (k, point) in points() {
        put(at(point.x, point.y), mark(k));
    }
    let lines = cells.iter().map(|row| row.iter().collect::<String>().trim_end().to_owned());
    lines.collect::<Vec<_>>().join("\n")
}

/// Of so many cells from -1 to 1, the one that holds a share of the reach.
fn cell(share: f64, cells: usize) -> usize {
    let middle = |k: &usize| 2.0 * *k as f64 / (cells - 1) as f64 - 1.0;
    let off = |k: &usize| (middle(k) - share).abs();
    (0..cells).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use hexbench_core::JointCircle;

    use super::*;

    #[test]
    fn joints_stand_where_the_drawing_has_them() {
        let gap = 20.0_f64.to_radians();
        let base = JointCircle::base_pairs(0.16, gap).joints(-0.165);
        let machine = Hexapod::of_joints("rings", base, JointCircle::platform_pairs(0.12, gap).joints(0.0));
        let view = view_from_above(&machine);
        let place = |mark: char| {
            let found = view.lines().enumerate().find_map(|(row, line)| Some((row, line.find(mark)?)));
            found.unwrap_or_else(|| panic!("{mark} in\n{view}"))
        };
        // Legs 1 and 2 end to the right, 1 below 2; platform joints a and b belong to them.
        assert_eq!(place('1').1, place('2').1);
        assert!(place('1').0 > place('2').0 && place('1').1 > place('4').1, "{view}");
        assert!(place('a').0 > place('b').0, "{view}");
        let svg = drawing(&machine).unwrap();
        assert!(svg.contains("rings at the zero pose") && svg.contains("from above"));
        assert!(sensors(&machine).is_none() && !svg.contains("sensors"));
    }

    #[test]
    fn sensors_stand_where_the_file_has_them() {
        let base = JointCircle::base_pairs(0.16, 0.3).joints(-0.165);
        let mut machine =
            Hexapod::of_joints("rings", base, JointCircle::platform_pairs(0.12, 0.3).joints(0.0));
        let gauge = |x, y| SensorKind::Distance {
            point: Vector3::new(x, y, 0.04),
            direction: Vector3::z(),
            sigma: 2e-7,
        };
        machine.sensors = vec![
            Sensor::new("right", gauge(0.3, 0.0)),
            Sensor::new("up", gauge(0.0, 0.3)),
            Sensor::new("level", SensorKind::Inclination { axis: Vector3::x(), sigma: 1e-6 }),
            Sensor::new("scale", SensorKind::LegLength { leg: 2, sigma: 1e-7 }),
        ];
        let view = view_from_above(&machine);
        let lines: Vec<&str> = view.lines().collect();
        assert_eq!(lines[ROWS / 2].find('A'), Some(COLUMNS - 1), "{view}");
        assert_eq!(lines[0].find('B'), Some(COLUMNS / 2), "{view}");
        let svg = drawing(&machine).unwrap();
        for word in ["distance", "inclination", "leg-length"] {
            assert!(svg.contains(&format!("sensors: {word}")), "{word}");
        }
        assert!(!svg.contains("sensors: point"));
        assert_eq!(
            about(&machine.sensors[0]),
            "distance of (300.0, 0, 40.00) mm along (0, 0, 1.000), 0.200 um per reading"
        );
    }
}
