//! The page of `hexbench design`.

use hexbench_core::Pose;
use hexbench_model::observability::Observability;
use nalgebra::DMatrix;

use crate::output::{Ink, Paper, Table, number};

/// A plan to be shown.
pub(crate) struct Designed {
    /// Name of the criterion.
    pub(crate) criterion: &'static str,
    /// Its value at the optimum.
    pub(crate) best: f64,
    /// Its value for the rounded poses.
    pub(crate) value: f64,
    /// Information matrix of the rounded poses.
    pub(crate) information: DMatrix<f64>,
    /// Names of the parameters.
    pub(crate) names: Vec<String>,
    /// Rounded poses.
    pub(crate) poses: Vec<Pose>,
    /// Loads at each pose.
    pub(crate) loads: usize,
    /// Readings of each.
    pub(crate) repeats: usize,
    /// Starts; those that ended at a plan; those that agree with the best.
    pub(crate) starts: [usize; 3],
    /// True when rows are in units of the stated noise.
    pub(crate) weighted: bool,
    /// Seed of the starts.
    pub(crate) seed: u32,
}

/// The page.
pub(crate) fn designed(plan: &Designed, ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    paper.heading("Plan", "mm and deg; fixed axes");
    table(&mut paper, plan);
    let readings = plan.poses.len() * plan.loads * plan.repeats;
    let loads = if plan.loads == 1 { "1 load".to_owned() } else { format!("{} loads", plan.loads) };
    paper.paragraph(
        2,
        &format!("{loads} at each pose, {} readings of each: {readings} readings.", plan.repeats),
    );
    paper.heading("How good", "");
    quality(&mut paper, plan);
    paper.heading("How sure of the optimum", "");
    let [starts, ended, agreeing] = plan.starts;
    let text = format!(
        "{agreeing} of {starts} starts reached this value, {} ended at a worse one, {} within no limits (seed {}). \
         Rounding the poses changes it by {:.1e}.",
        ended - agreeing,
        starts - ended,
        plan.seed,
        plan.value / plan.best - 1.0,
    );
    paper.paragraph(2, &text);
    if plan.weighted {
        uncertainty(&mut paper, plan);
    }
    paper.into_text()
}

fn table(paper: &mut Paper, plan: &Designed) {
    let mut table = Table::default();
    table.row(["pose", "a", "b", "c", "alpha", "beta", "gamma"]);
    for (k, pose) in plan.poses.iter().enumerate() {
        let x = pose.to_array();
        let cell = |i: usize| format!("{:.3}", if i < 3 { x[i] * 1e3 } else { x[i].to_degrees() } + 0.0);
        table.row(std::iter::once((k + 1).to_string()).chain((0..6).map(cell)));
    }
    table.lines().iter().for_each(|line| paper.line(line));
}

fn quality(paper: &mut Paper, plan: &Designed) {
    let eigen = plan.information.clone().symmetric_eigenvalues();
    let readings = plan.poses.len() * plan.loads * plan.repeats;
    let o = Observability::new(eigen.iter().map(|l| l.max(0.0).sqrt()), readings);
    let chosen = format!("{} = {}", plan.criterion, number::significant(plan.value, 6));
    let units = if plan.weighted {
        "rows in units of the noise, columns in relative changes"
    } else {
        "m and rad side by side, as in the paper; state [metrology] to weigh them"
    };
    paper.paragraph(2, &format!("{chosen} ({units})."));
    let mut table = Table::default();
    table.row(["", "O1", "O2", "O3", "O4", "O5", "condition"]);
    let values = [o.o1, o.o2, o.o3, o.o4, o.o5, 1.0 / o.o2];
    table.row(std::iter::once(String::new()).chain(values.map(|v| number::significant(v, 4))));
    table.lines().iter().for_each(|line| paper.line(line));
}

/// Standard uncertainties that the plan promises.
fn uncertainty(paper: &mut Paper, plan: &Designed) {
    let Some(factor) = plan.information.clone().cholesky() else { return };
    let covariance = factor.inverse();
    paper.heading("What it will determine", "standard uncertainty, k = 1");
    let mut table = Table::default();
    for (k, name) in plan.names.iter().enumerate() {
        let relative = 100.0 * covariance[(k, k)].sqrt();
        let of = if k < 6 { "% of the nominal one" } else { "% of its usual size" };
        table.row([name.clone(), number::significant(relative, 2), of.to_owned()]);
    }
    table.left(2).lines().iter().for_each(|line| paper.line(line));
}
