//! Single faults: numbers, rows, loads, poses and reference readings that are not what the file says.
//!
//! Each hypothesis gives its readings a shift of their own (Baarda 1968, A testing procedure for use in geodetic networks):
//! with `B` its columns and `M` the projector off what the catalogue explains, chi-square falls by
//! `(B'r)' (B'MB)^-1 (B'r)`. The hypothesis of the largest evidence is accepted and its readings are left out, one after
//! the other, so that a large fault does not hide a smaller one.

use hexbench_core::statistics::median;
use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector};

use super::finding::{Finding, FindingKind, probability};
use super::remainder::Remainder;

/// Evidence beyond which a fault is believed, nats: odds of 3 000 to 1 after all that was tried.
const BELIEVED: f64 = 8.0;
/// The same of one that part of the catalogue could explain.
const EVIDENT: f64 = 16.0;
/// Prior size of a shift in its own standard deviations: what it costs to ask.
const PRIOR_SIZE: f64 = 30.0;
/// Faults by themselves are rare: prior odds of one in the file.
const PRIOR_ODDS: f64 = 0.05;
/// Median of the square of a Gaussian.
const MEDIAN_SQUARE: f64 = 0.454_936;
/// Names of the components of a wrench, with the unit.
pub(super) const WRENCH: [(&str, &str); 6] =
    [("fx", "N"), ("fy", "N"), ("fz", "N"), ("mx", "N m"), ("my", "N m"), ("mz", "N m")];
/// Names of the components of a pose, with the unit and its factor from SI.
const POSE: [(&str, &str, f64); 6] = [
    ("a", "mm", 1e3),
    ("b", "mm", 1e3),
    ("c", "mm", 1e3),
    ("alpha", "deg", 57.295_779_513_082_32),
    ("beta", "deg", 57.295_779_513_082_32),
    ("gamma", "deg", 57.295_779_513_082_32),
];

/// A fault that readings speak for.
pub(super) struct Fault {
    /// What is told.
    pub(super) finding: Finding,
    /// Rows of the dataset that are not what the file says.
    pub(super) rows: Vec<usize>,
    /// What it cost to ask for it among all others, nats.
    pub(super) cost: f64,
    /// True when they are all those of one pose.
    pub(super) of_pose: bool,
    /// Evidence for it beside readings that scatter as most of them do, nats.
    evidence: f64,
}

impl Fault {
    /// True for a wrong load or pose of which there is hardly a doubt.
    pub(super) fn is_evident_of_conditions(&self) -> bool {
        self.finding.kind.is_of_conditions() && self.evidence > EVIDENT
    }
}

/// The most probable fault, when one is believed. `most`: rows that a wrong reference may have; where more depend on it, a law of the
/// machine looks the same.
pub(super) fn worst(rest: &Remainder<'_>, most: usize) -> Option<Fault> {
    let scale = Scale::of(rest);
    let of_poses = Groups::of_poses(rest);
    let all = [
        numbers(rest, &scale),
        rows(rest, &scale),
        loads(rest, &scale),
        poses(rest, &scale, &of_poses),
        references(rest, &scale, &of_poses).filter(|fault| fault.rows.len() <= most),
    ];
    let best = all.into_iter().flatten().max_by(|a, b| a.evidence.total_cmp(&b.evidence))?;
    (best.evidence > BELIEVED).then_some(best)
}

/// Variances that most readings have, over the stated ones: whatever widens them all is no fault of one.
struct Scale {
    /// Of single readings.
    single: f64,
    /// Of averaged readings.
    mean: f64,
}

impl Scale {
    fn of(rest: &Remainder<'_>) -> Self {
        let typical = |squares: &mut dyn Iterator<Item = f64>| {
            median(squares).map_or(1.0, |m| (m / MEDIAN_SQUARE).max(1.0))
        };
        let read = |i: usize| rest.data.observations[i];
        let rows = (0..rest.rows.len())
            .flat_map(|i| (0..6).filter(move |&k| read(i).is_read(k)).map(move |k| (i, k)));
        let single = typical(&mut rows.map(|(i, k)| rest.rows[i][k].powi(2)));
        let of_group = |n: &usize| rest.campaign.groups[n / 6].reads[n % 6] > 0;
        let mean = typical(&mut (0..rest.means.len()).filter(of_group).map(|n| rest.means[n].powi(2)));
        Self { single, mean: mean.max(single) }
    }
}

/// What it costs to ask for a shift with `dof` components, one of `tried`, and the evidence of one that lowers chi-square by `gain`
/// where most readings have a `variance`; nats.
fn evidence(gain: f64, variance: f64, dof: usize, tried: usize) -> [f64; 2] {
    let cost = dof as f64 * PRIOR_SIZE.ln() + (tried.max(1) as f64).ln() - PRIOR_ODDS.ln();
    [cost, 0.5 * gain / variance - cost]
}

/// One number of one row.
fn numbers(rest: &Remainder<'_>, scale: &Scale) -> Option<Fault> {
    let z = |(i, k): (usize, usize)| {
        let g = rest.group_of[i];
        rest.rows[i][k] / (1.0 - rest.leverage(6 * g + k) / rest.readings(g)).sqrt()
    };
    let all = (0..rest.rows.len()).flat_map(|i| (0..6).map(move |k| (i, k)));
    let (i, k) = all.max_by(|&a, &b| z(a).abs().total_cmp(&z(b).abs()))?;
    let size = z((i, k));
    let odds = evidence(size * size, scale.single, 1, rest.campaign.numbers);
    let line = rest.data.observations[i].line;
    let value = rest.campaign.name_of(rest.group_of[i], k);
    let sigma = format!("{:.0} sigma", size.abs());
    let text =
        format!("{value} in line {line} is {sigma} away from the value expected from the other readings");
    Some(fault(FindingKind::Blunder, vec![i], rest, odds, sigma, text, "check the record of this line"))
}

/// All six numbers of one row: a sign, a unit, a row of another condition.
fn rows(rest: &Remainder<'_>, scale: &Scale) -> Option<Fault> {
    let gain = |&i: &usize| {
        let g = rest.group_of[i];
        (0..6)
            .map(|k| rest.rows[i][k].powi(2) / (1.0 - rest.leverage(6 * g + k) / rest.readings(g)))
            .sum::<f64>()
    };
    let i = (0..rest.rows.len()).max_by(|a, b| gain(a).total_cmp(&gain(b)))?;
    let odds = evidence(gain(&i), scale.single, rest.data.observations[i].numbers(), rest.rows.len());
    let line = rest.data.observations[i].line;
    let size = format!("{:.0} sigma", rest.rows[i].amax());
    let text =
        format!("line {line} as a whole does not match its pose and load; its largest deviation is {size}");
    Some(fault(FindingKind::Blunder, vec![i], rest, odds, size, text, "check the record of this line"))
}

/// One component of the load of one condition: all its repeats are off in the way that another load gives.
fn loads(rest: &Remainder<'_>, scale: &Scale) -> Option<Fault> {
    let responses = rest.lin.load_readers();
    let groups = rest.campaign.groups.len();
    let alone: Vec<Vec<usize>> = (0..groups).map(|g| vec![g]).collect();
    let column = |g: usize, k: usize| responses[g].column(k).into_owned();
    let Shift { gain, set: g, component: k, size: shift } = largest_shift(rest, &alone, column)?;
    let odds = evidence(gain, scale.mean, 1, 6 * groups);
    let at = &rest.campaign.groups[g];
    let stated = at.mean.wrench.to_array()[k];
    let (name, unit) = WRENCH[k];
    let size = format!("{:.3} {unit} instead of {stated:.3} {unit}", stated + shift);
    let text = format!("the readings of {} imply a load with {name} = {size}", lines_of(rest, &at.rows));
    let rows = at.rows.iter().map(|&i| i as usize).collect();
    Some(fault(
        FindingKind::Load,
        rows,
        rest,
        odds,
        size,
        text,
        "compare the load in the file with the load applied",
    ))
}

/// Groups of readings that have something in common.
struct Groups(Vec<Vec<usize>>);

impl Groups {
    /// Those of each pose.
    fn of_poses(rest: &Remainder<'_>) -> Self {
        let mut all: Vec<Vec<usize>> = Vec::new();
        for (g, group) in rest.campaign.groups.iter().enumerate() {
            if all.len() <= group.record {
                all.resize(group.record + 1, Vec::new());
            }
            all[group.record].push(g);
        }
        Self(all)
    }

    /// Rows of the dataset in some of them.
    fn rows(&self, set: usize, rest: &Remainder<'_>) -> Vec<usize> {
        self.0[set].iter().flat_map(|&g| rest.campaign.groups[g].rows.iter().map(|&i| i as usize)).collect()
    }
}

/// All readings at one pose, off by the same numbers under every load: those of the reading that they are differences from.
fn references(rest: &Remainder<'_>, scale: &Scale, of_poses: &Groups) -> Option<Fault> {
    if rest.campaign.is_absolute() {
        return None;
    }
    // Under one load alone it is a wrong row.
    let several = (0..of_poses.0.len()).filter(|&p| of_poses.0[p].len() > 1);
    let of = |p: usize| Some((p, common_shift(rest, &of_poses.0[p])?));
    let (p, found) = several.filter_map(of).max_by(|a, b| a.1.gain.total_cmp(&b.1.gain))?;
    let odds = evidence(found.gain, scale.mean, found.numbers, of_poses.0.len());
    let rows = of_poses.rows(p, rest);
    let pose = rest.data.observations[*rows.first()?].pose_id;
    let name = rest.campaign.name_of(of_poses.0[p][0], found.most);
    let size = format!("{name} by {:.0} sigma", found.in_sigma);
    let text = format!(
        "all readings at pose {pose} are off by the same amount whatever the load, {size} most: the reference reading there is wrong"
    );
    let next = "read the reference of this pose again; the readings of this pose are left out here";
    let fault = fault(FindingKind::Blunder, rows, rest, odds, size, text, next);
    Some(Fault { of_pose: true, ..fault })
}

/// Numbers by which some groups are off together.
struct CommonShift {
    /// Fall of chi-square.
    gain: f64,
    /// How many there are.
    numbers: usize,
    /// The one furthest from zero, and how far, in standard deviations of it.
    most: usize,
    in_sigma: f64,
}

/// The same shift of every number in some groups, where it is beyond the noise of a reading; none where the catalogue explains one of
/// them as well.
fn common_shift(rest: &Remainder<'_>, groups: &[usize]) -> Option<CommonShift> {
    let (mut b, mut normal) = (Vector6::zeros(), Matrix6::zeros());
    let mut overlap = DMatrix::zeros(rest.basis.ncols(), 6);
    for &g in groups {
        let group = &rest.campaign.groups[g];
        let reads = |k: usize| if group.reads[k] > 0 { group.sigma[k].recip() } else { 0.0 };
        let per_shift = Vector6::from_fn(|k, _| reads(k));
        b += per_shift.component_mul(&rest.means.fixed_rows::<6>(6 * g));
        normal += Matrix6::from_diagonal(&per_shift.component_mul(&per_shift));
        let basis = rest.basis.fixed_rows::<6>(6 * g);
        for (k, mut column) in overlap.column_iter_mut().enumerate() {
            column.axpy(per_shift[k], &basis.row(k).transpose(), 1.0);
        }
    }
    let read: Vec<usize> = (0..6).filter(|&k| normal[(k, k)] > 0.0).collect();
    let before = normal.diagonal();
    normal -= Matrix6::from_iterator(overlap.tr_mul(&overlap).iter().copied());
    if read.iter().any(|&k| normal[(k, k)] < 1e-3 * before[k]) {
        return None;
    }
    (0..6).filter(|k| !read.contains(k)).for_each(|k| normal[(k, k)] = 1.0);
    let covariance = normal.cholesky()?.inverse();
    let shift = covariance * b;
    let in_sigma = |k: usize| shift[k].abs() / covariance[(k, k)].sqrt();
    let most = read.iter().copied().max_by(|&a, &b| in_sigma(a).total_cmp(&in_sigma(b)))?;
    // A reading that others are differences from has the noise of a reading, which all of them share.
    let group = &rest.campaign.groups[*groups.first()?];
    let mut usual = covariance;
    for &k in &read {
        usual[(k, k)] += group.sigma[k].powi(2) * f64::from(group.reads[k]);
    }
    let is_gross = 0.5 * shift.dot(&usual.cholesky()?.solve(&shift)) > EVIDENT;
    is_gross.then(|| CommonShift { gain: b.dot(&shift), numbers: read.len(), most, in_sigma: in_sigma(most) })
}

/// One component of one commanded pose.
fn poses(rest: &Remainder<'_>, scale: &Scale, of_poses: &Groups) -> Option<Fault> {
    let slopes = rest.by_pose?;
    let column = |g: usize, k: usize| slopes.fixed_view::<6, 1>(6 * g, k).into_owned();
    let Shift { gain, set: p, component: k, size: shift } = largest_shift(rest, &of_poses.0, column)?;
    let odds = evidence(gain, scale.mean, 1, 6 * of_poses.0.len());
    let rows = of_poses.rows(p, rest);
    let first = &rest.data.observations[*rows.first()?];
    let (name, unit, per_si) = POSE[k];
    let stated = first.pose.to_array()[k] * per_si;
    let size = format!("{:+.2} {unit}", shift * per_si);
    let text = format!(
        "the readings at pose {} imply a pose with {name} = {:.2} {unit} instead of {stated:.2} {unit}",
        first.pose_id,
        stated + shift * per_si
    );
    let next = "compare the pose in the file with the pose commanded";
    Some(Fault { of_pose: true, ..fault(FindingKind::Pose, rows, rest, odds, size, text, next) })
}

/// A shift of one component of six in a set of groups.
struct Shift {
    /// Fall of chi-square.
    gain: f64,
    set: usize,
    component: usize,
    size: f64,
}

/// The shift by which chi-square falls most; `column`: what one unit of a component does to the means of a group.
fn largest_shift(
    rest: &Remainder<'_>,
    sets: &[Vec<usize>],
    column: impl Fn(usize, usize) -> Vector6,
) -> Option<Shift> {
    let each = (0..sets.len()).flat_map(|set| (0..6).map(move |component| (set, component)));
    let of = |(set, component): (usize, usize)| {
        let groups = &sets[set];
        let columns: Vec<Vector6> = groups.iter().map(|&g| column(g, component)).collect();
        let (gain, size) = shift_of(rest, groups, &columns)?;
        Some(Shift { gain, set, component, size })
    };
    // The first of equals.
    each.filter_map(of).reduce(|best, next| if next.gain > best.gain { next } else { best })
}

/// Fall of chi-square when some groups get a shift along these columns, and the shift.
fn shift_of(rest: &Remainder<'_>, groups: &[usize], columns: &[Vector6]) -> Option<(f64, f64)> {
    let (mut b, mut before) = (0.0, 0.0);
    let mut overlap = DVector::zeros(rest.basis.ncols());
    for (&g, column) in groups.iter().zip(columns) {
        b += column.dot(&rest.means.fixed_rows::<6>(6 * g));
        before += column.norm_squared();
        overlap += rest.basis.fixed_rows::<6>(6 * g).tr_mul(column);
    }
    let own = before - overlap.norm_squared();
    // A shift that the catalogue explains as well cannot be told from it.
    (own > 0.0 && own >= 1e-3 * before).then(|| (b * b / own, b / own))
}

fn fault(
    kind: FindingKind,
    rows: Vec<usize>,
    rest: &Remainder<'_>,
    [cost, evidence]: [f64; 2],
    size: String,
    text: String,
    next: &str,
) -> Fault {
    let lines = rows.iter().map(|&i| rest.data.observations[i].line).collect();
    let finding = Finding {
        probability: probability(evidence),
        rows: lines,
        size,
        text,
        next: next.to_owned(),
        ..Finding::of(kind)
    };
    Fault { finding, rows, cost, of_pose: false, evidence }
}

fn lines_of(rest: &Remainder<'_>, rows: &[u32]) -> String {
    let line = |&i: &u32| rest.data.observations[i as usize].line.to_string();
    match rows {
        [one] => format!("line {}", line(one)),
        many => {
            format!("lines {}", hexbench_core::words::joined(&many.iter().map(line).collect::<Vec<_>>()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_has_to_pay_for_its_size_for_its_rarity_and_for_all_that_was_tried() {
        let [cost, told] = evidence(80.0, 2.0, 2, 600);
        assert!((cost - (2.0 * 30.0_f64.ln() + 600.0_f64.ln() + 20.0_f64.ln())).abs() < 1e-12, "{cost}");
        assert!((told - (20.0 - cost)).abs() < 1e-12, "{told}");
    }
}
