//! A drawing of a scene: legs at the zero pose, and the platform at the poses of the plan, from above and from the side.

use std::fmt::Write;

use hexbench_core::{Hexapod, Pose, Vector3};

use super::{PartName, Scene};

/// Side of one view, in units of the drawing.
const SIZE: f64 = 300.0;
/// Space about a view.
const MARGIN: f64 = 30.0;
/// Most poses drawn.
const MOST_POSES: usize = 60;

/// One view: which coordinates go to the right and up, and how far the machine reaches.
struct View {
    title: &'static str,
    axes: [usize; 2],
    left: f64,
    centre: [f64; 2],
    per_metre: f64,
}

impl Scene {
    /// The drawing as SVG; the same scene gives the same bytes.
    pub fn picture(&self) -> String {
        let poses = self.different_poses();
        let width = 2.0 * SIZE + 3.0 * MARGIN;
        let height = SIZE + 2.0 * MARGIN;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
        );
        for (number, (title, axes)) in
            [("from above", [0, 1]), ("from the side", [0, 2])].into_iter().enumerate()
        {
            let left = MARGIN + number as f64 * (SIZE + MARGIN);
            View::new(title, axes, left, &self.hexapod, &poses).draw(&mut svg, &self.hexapod, &poses);
        }
        svg + "</svg>\n"
    }

    fn different_poses(&self) -> Vec<Pose> {
        let mut poses: Vec<Pose> = Vec::new();
        for row in self.part(PartName::Training).iter() {
            if poses.len() == MOST_POSES {
                break;
            }
            if !poses.contains(&row.situation.pose) {
                poses.push(row.situation.pose);
            }
        }
        poses
    }
}

fn platform_at(hexapod: &Hexapod, pose: &Pose) -> [Vector3; 6] {
    let r = pose.rotation();
    hexapod.platform_joints.map(|b| pose.translation + r * b)
}

impl View {
    fn new(title: &'static str, axes: [usize; 2], left: f64, hexapod: &Hexapod, poses: &[Pose]) -> Self {
        let moved = poses.iter().flat_map(|pose| platform_at(hexapod, pose));
        let points: Vec<Vector3> =
            hexapod.base_joints.into_iter().chain(hexapod.platform_joints).chain(moved).collect();
        let range = axes.map(|axis| {
            let values = points.iter().map(|p| p[axis]);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        });
        let reach = range.iter().map(|[low, high]| high - low).fold(f64::MIN_POSITIVE, f64::max);
        let centre = range.map(|[low, high]| 0.5 * (low + high));
        Self { title, axes, left, centre, per_metre: SIZE / reach }
    }

    /// Place of a point on the drawing.
    fn at(&self, point: &Vector3) -> [f64; 2] {
        let [right, up] = [0, 1].map(|k| (point[self.axes[k]] - self.centre[k]) * self.per_metre);
        [self.left + 0.5 * SIZE + right, MARGIN + 0.5 * SIZE - up]
    }

    fn draw(&self, svg: &mut String, hexapod: &Hexapod, poses: &[Pose]) {
        let label_y = SIZE + 1.7 * MARGIN;
        let _ =
            writeln!(svg, "<text x=\"{}\" y=\"{label_y:.0}\" fill=\"#555\">{}</text>", self.left, self.title);
        for pose in poses {
            self.outline(svg, &platform_at(hexapod, pose), "#e9b872", 0.6);
        }
        self.outline(svg, &hexapod.base_joints, "#555", 1.0);
        self.outline(svg, &hexapod.platform_joints, "#b5651d", 1.4);
        for (base, platform) in hexapod.base_joints.iter().zip(&hexapod.platform_joints) {
            leg(svg, self.at(base), self.at(platform));
        }
    }

    /// The hull of six joints in the order of their angle about their mean.
    fn outline(&self, svg: &mut String, joints: &[Vector3; 6], colour: &str, width: f64) {
        let mean = joints.iter().sum::<Vector3>() / 6.0;
        let mut around = *joints;
        around.sort_by(|a, b| {
            let angle = |p: &Vector3| (p.y - mean.y).atan2(p.x - mean.x);
            angle(a).total_cmp(&angle(b))
        });
        let points: Vec<String> =
            around.iter().map(|p| self.at(p)).map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let _ = writeln!(
            svg,
            "<polygon points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"/>",
            points.join(" ")
        );
    }
}

fn leg(svg: &mut String, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
    let _ = writeln!(
        svg,
        "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#1f5f8b\" stroke-width=\"3\" \
         stroke-linecap=\"round\"/>\n<circle cx=\"{x1:.1}\" cy=\"{y1:.1}\" r=\"3.5\" fill=\"#555\"/>\n\
         <circle cx=\"{x2:.1}\" cy=\"{y2:.1}\" r=\"3.5\" fill=\"#b5651d\"/>"
    );
}
