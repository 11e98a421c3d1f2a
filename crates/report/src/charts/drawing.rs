//! A machine as its drawing shows it: from above in characters, and as a picture.

use hexbench_core::{Hexapod, Vector3};

use super::machine::unloaded;
use crate::plot::{PlotError, Wireframe};

/// Columns and rows of the view from above; a row is as high as two columns are wide.
const COLUMNS: usize = 49;
const ROWS: usize = 25;
/// Joints of the legs in their order.
const BASE: [char; 6] = ['1', '2', '3', '4', '5', '6'];
const PLATFORM: [char; 6] = ['a', 'b', 'c', 'd', 'e', 'f'];

/// The machine at the zero pose from the side and from above, as SVG.
///
/// # Errors
/// [`PlotError::NotFinite`].
pub fn drawing(hexapod: &Hexapod) -> Result<String, PlotError> {
    let joints: [[Vector3; 2]; 6] =
        std::array::from_fn(|leg| [hexapod.base_joints[leg], hexapod.platform_joints[leg]]);
    Wireframe::new(format!("{} at the zero pose", hexapod.name))
        .seen("from the front, a little from above", 25.0, 22.0)
        .seen("from above, x to the right", 0.0, 90.0)
        .with("base, platform and legs", Some(0), unloaded(&joints))
        .to_svg()
}

/// The machine at the zero pose from above: 1 to 6 are base joints, a to f the platform joints of the same legs; x to the right, y up.
pub fn view_from_above(hexapod: &Hexapod) -> String {
    let (base, platform) = (&hexapod.base_joints, &hexapod.platform_joints);
    let reach = base.iter().chain(platform).map(|j| j.xy().amax()).fold(f64::MIN_POSITIVE, f64::max);
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
    }
}
