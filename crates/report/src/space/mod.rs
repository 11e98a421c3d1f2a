//! A comparison in three dimensions: the machine, the load with the largest residual, and the residual of every reading.

mod glb;

use hexbench_core::{Dataset, Vector3, Vector6};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Condition;
use hexbench_model::results::compare::{ComparedModel, JudgedModel};
use serde_json::json;

use self::glb::{Glb, Paint};
use crate::body::{around, displacements, ends, joints, largest};
use crate::render::PROGRAM;

/// Longest drawn motion of a joint, as a share of the platform radius; longest residual of an origin.
const DRAWN: f64 = 0.35;
/// Radius of legs as a share of the platform radius; rings and arrows are thinner.
const LEG: f64 = 0.02;

/// Linear values of the colors of charts.
const GREY: Paint = Paint { name: "as it stands", color: [0.45, 0.45, 0.45] };
const BLACK: Paint = Paint { name: "measured", color: [0.02, 0.02, 0.02] };
const BLUE: Paint = Paint { name: "predicted", color: [0.0, 0.168, 0.445] };
const ORANGE: Paint = Paint { name: "residual", color: [0.665, 0.112, 0.0] };
const GREEN: Paint = Paint { name: "load", color: [0.0, 0.342, 0.171] };

/// Machine, exaggerated motions and residuals as glTF 2.0 in one binary file (.glb), meters, z up below its first node; how many times too
/// large motions and residuals are drawn stands in `extras` of their groups. None where no condition has readings of six numbers that
/// tell a motion of the platform.
///
/// # Errors
/// [`ModelError::SingularPose`].
pub fn glb(data: &Dataset, compared: &ComparedModel) -> Result<Option<Vec<u8>>, ModelError> {
    let fitted = compared.comparison.fitted_here;
    let judged = JudgedModel::of(&compared.campaign, data, &compared.point, fitted)?;
    let determined = if compared.campaign.blocks.len() < 2 { judged.space.determined() } else { Vec::new() };
    let miss = |i: &usize| judged.lin.residual(*i).norm();
    let Some(worst) = determined.iter().copied().max_by(|a, b| miss(a).total_cmp(&miss(b))) else {
        return Ok(None);
    };
    let scene = Scene { judged: &judged, determined, radius: judged.lin.machine.nominal.platform_radius() };
    let mut out = Glb::default();
    scene.machine(&mut out, worst);
    scene.motions(&mut out, worst);
    scene.residuals(&mut out);
    Ok(Some(out.bytes(PROGRAM)))
}

struct Scene<'a> {
    judged: &'a JudgedModel<'a>,
    /// Conditions whose readings tell a motion.
    determined: Vec<usize>,
    /// Of the platform, m.
    radius: f64,
}

impl Scene<'_> {
    fn at(&self, i: usize) -> &Condition {
        &self.judged.lin.conditions[i]
    }

    /// Motion of the platform that is measured, and that is predicted; geometric twists.
    fn twists(&self, i: usize) -> [Vector6; 2] {
        let at = self.at(i);
        [at.reading, self.judged.lin.predicted(i)].map(|reading| at.motion(&reading))
    }

    /// Base, platform and legs where the load finds them.
    fn machine(&self, out: &mut Glb, i: usize) {
        let joints = joints(self.at(i));
        let [base, platform] = [0, 1].map(|end| ends(&joints, end));
        out.group("machine", &json!({}));
        for leg in 0..6 {
            out.tube(&format!("leg {}", leg + 1), GREY, [base[leg], platform[leg]], LEG * self.radius);
        }
        self.ring(out, "base", GREY, &base, LEG);
        self.ring(out, "platform", GREY, &platform, 0.7 * LEG);
    }

    /// Platform as measured and as predicted, exaggerated; what is missed at every joint; the load.
    fn motions(&self, out: &mut Glb, i: usize) {
        let at = self.at(i);
        let platform = ends(&joints(at), 1);
        let moves = self.twists(i).map(|twist| displacements(at, &twist));
        let most = moves.iter().map(largest).fold(0.0, f64::max);
        let factor = finite(DRAWN * self.radius / most);
        let change = |a: Vector3, b: Vector3| <[f64; 3]>::from(a - b);
        let extras = json!({
            "times_too_large": factor,
            "change_of_force_N": change(at.wrench.force, at.reference.force),
            "change_of_moment_N_m": change(at.wrench.moment, at.reference.moment),
        });
        out.group("load that the model misses most", &extras);
        let places = moves.map(|moved| std::array::from_fn(|leg| platform[leg] + moved[leg] * factor));
        for (name, paint, joints) in [("measured", BLACK, &places[0]), ("predicted", BLUE, &places[1])] {
            self.ring(out, name, paint, joints, 0.5 * LEG);
        }
        self.load(out, at);
        let missed = self.missed(i);
        let factor = finite(DRAWN * self.radius / largest(&missed));
        out.group("residuals at the joints", &json!({ "times_too_large": factor }));
        for leg in 0..6 {
            let ends = [platform[leg], platform[leg] + missed[leg] * factor];
            out.arrow(&format!("residual at joint {}", leg + 1), ORANGE, ends, 0.5 * LEG * self.radius);
        }
    }

    fn load(&self, out: &mut Glb, at: &Condition) {
        let force = at.wrench.force - at.reference.force;
        if let Some(along) = force.try_normalize(f64::MIN_POSITIVE) {
            let tip = at.place.translation;
            out.arrow("change of force", GREEN, [tip - along * self.radius, tip], LEG * self.radius);
        }
    }

    /// What is missed of the mobile origin under every condition.
    fn residuals(&self, out: &mut Glb) {
        let shift = |i: usize| {
            let [measured, predicted] = self.twists(i);
            (measured - predicted).fixed_rows::<3>(0).into_owned()
        };
        let most = self.determined.iter().map(|i| shift(*i).norm()).fold(0.0, f64::max);
        let factor = finite(DRAWN * self.radius / most);
        out.group("residuals at the mobile origin", &json!({ "times_too_large": factor }));
        for &i in &self.determined {
            let from = self.at(i).place.translation;
            let ends = [from, from + shift(i) * factor];
            out.arrow(&format!("condition {}", i + 1), ORANGE, ends, 0.25 * LEG * self.radius);
        }
    }

    fn missed(&self, i: usize) -> [Vector3; 6] {
        let [measured, predicted] = self.twists(i);
        displacements(self.at(i), &(measured - predicted))
    }

    /// A closed line through six joints, in the order of their angle.
    fn ring(&self, out: &mut Glb, name: &str, paint: Paint, joints: &[Vector3; 6], thick: f64) {
        let order = around(joints);
        for k in 0..6 {
            let [a, b] = [order[k], order[(k + 1) % 6]];
            out.tube(
                &format!("{name} {}-{}", a + 1, b + 1),
                paint,
                [joints[a], joints[b]],
                thick * self.radius,
            );
        }
    }
}

/// No exaggeration where nothing moves.
fn finite(factor: f64) -> f64 {
    if factor.is_finite() { factor } else { 1.0 }
}
