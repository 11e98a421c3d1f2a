//! Mistakes that have a size: turned axes, another point of reference, a load that was left out, a joint elsewhere, an instrument that
//! shows too much by a factor or by an amount.
//!
//! Moments and deflections about another point of the platform are effects of the catalogue, and left to it.
//!
//! The size is found by Gauss-Newton on what the springs leave of the readings, with derivatives by differences.

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;
use hexbench_core::{Vector3, Wrench};
use nalgebra::{DMatrix, DVector};

use super::FEWEST_CONDITIONS;
use super::change::{Change, Group, JointCoordinate, ReadingColumn, ReferencePoint, Sensors, Target};
use super::sample::{FEW_NUMBERS, Sample};

/// Iterations at most.
const MOST_STEPS: usize = 8;
/// Gain of chi-square, relative, below which a size has settled.
const SETTLED: f64 = 1e-4;
/// Turns smaller than this are what a tolerance is for, rad.
const LEAST_TURN: f64 = 0.01;
/// The largest turn that is looked for beside other names of the axes, rad.
const LARGEST_TURN: f64 = 0.8;
/// Share of the platform's radius below which another point of reference is a small effect and no mistake.
const LEAST_OFFSET: f64 = 0.1;
/// The same for a joint.
const LEAST_JOINT: f64 = 0.06;
/// Logarithm of a factor below which it is what a tolerance is for.
const LEAST_FACTOR: f64 = 0.05;
/// The same of a component of the loads, whose tolerance is fitted beside effects.
const LEAST_LOAD_FACTOR: f64 = 0.3;
/// The same of the largest factor that is looked for: beyond it are other units.
const LARGEST_FACTOR: f64 = 1.1;
/// Share of the typical reading of a column below which a zero error is what first-order springs miss.
const LEAST_ZERO: f64 = 0.02;
/// Share of the typical force below which a load that nobody wrote down is a tray or a hook, and no preload.
const LEAST_PRELOAD: f64 = 0.25;
/// The same of the least load that counts at all.
const LEAST_LOAD: f64 = 0.02;
/// Share of a turn about the vertical below which turned loads are tilted loads.
const UPRIGHT_SHARE: f64 = 0.7;
/// Sizes are looked for up to so many radii of the platform.
const MOST_RADII: f64 = 20.0;
/// Mistakes of a kind that are looked at closely.
const MOST_REFINED: usize = 3;
/// Heights from which the search for a height begins, in heights of the machine.
const HEIGHTS: [f64; 9] = [-2.0, -1.0, -0.5, -0.2, 0.0, 0.2, 0.5, 1.0, 2.0];
/// Step of the differences, in natural units of the size.
const STEP: f64 = 1e-4;

/// A mistake with a size.
#[derive(Debug, Clone, Copy)]
enum Sized {
    Turn(Target),
    Height(ReferencePoint),
    Preload,
    Weight,
    Joint(JointCoordinate),
    Factor(Columns),
    /// With what its column typically reads, m or rad.
    Zero(ReadingColumn, f64),
}

/// Numbers that an instrument may show too large by a factor of its own.
#[derive(Debug, Clone, Copy)]
enum Columns {
    Group(Group),
    Sensor(Sensors),
}

impl Columns {
    fn times(self, factor: f64) -> Change {
        match self {
            Self::Group(group) => Change::Scaled(group, factor),
            Self::Sensor(which) => Change::SensorScaled(which, factor),
        }
    }
}

impl Sized {
    /// The mistake at a size, given in radians, in radii of the platform, in the typical force or deflection, or as the logarithm of a
    /// factor.
    fn change(self, sample: &Sample, v: &[f64]) -> Change {
        let radius = sample.hexapod.platform_radius();
        match self {
            Self::Turn(target) => Change::Turned(target, Vector3::from_column_slice(v)),
            Self::Height(origin) => Change::Origin(origin, Vector3::new(0.0, 0.0, v[0] * radius)),
            Self::Preload => {
                let force = typical_force(sample);
                let unit = |k: usize| if k < 3 { force } else { force * radius };
                Change::Preload(Wrench::from_array(std::array::from_fn(|k| v[k] * unit(k))))
            }
            Self::Weight => {
                let force = Vector3::new(0.0, 0.0, v[0] * typical_force(sample));
                Change::Preload(Wrench { force, moment: Vector3::zeros() })
            }
            Self::Joint(coordinate) => Change::Joint(coordinate, v[0] * radius),
            Self::Factor(columns) => columns.times(v[0].exp()),
            Self::Zero(column, typical) => Change::ZeroError(column, v[0] * typical),
        }
    }

    /// Where the search begins.
    fn start(self, sample: &Sample) -> Vec<f64> {
        match self {
            Self::Turn(_) => vec![0.0; 3],
            Self::Preload => vec![0.0; 6],
            Self::Joint(_) | Self::Weight | Self::Factor(_) | Self::Zero(..) => vec![0.0],
            Self::Height(_) => {
                let hexapod = &sample.hexapod;
                let platform = hexapod.platform_joints.iter().map(|b| b.z).sum::<f64>() / 6.0;
                let radius = hexapod.platform_radius();
                let height = (platform - hexapod.base_centre().z).abs().max(radius) / radius;
                let square = |h: &f64| {
                    let left = sample.residuals(&[self.change(sample, &[*h])]);
                    left.map_or(f64::INFINITY, |r| r.norm_squared())
                };
                let all = HEIGHTS.map(|share| share * height);
                vec![all.into_iter().min_by(|a, b| square(a).total_cmp(&square(b))).unwrap_or(0.0)]
            }
        }
    }

    /// True for loads that are tilted, but not turned about the vertical: the catalogue has an effect for that.
    fn is_like_an_effect(self, values: &DVector<f64>) -> bool {
        matches!(self, Self::Turn(Target::Wrench | Target::Joints))
            && values[2].abs() < UPRIGHT_SHARE * values.norm()
    }

    /// True when the size is neither what a tolerance is for nor out of reach.
    fn counts(self, values: &DVector<f64>) -> bool {
        let range = match self {
            Self::Turn(_) => LEAST_TURN..LARGEST_TURN,
            Self::Height(_) => LEAST_OFFSET..MOST_RADII,
            // Small ones are no preload: they tell a zero error from a load.
            Self::Preload | Self::Weight => LEAST_LOAD..100.0,
            Self::Joint(_) => LEAST_JOINT..MOST_RADII,
            Self::Factor(Columns::Group(Group::Load(_))) => LEAST_LOAD_FACTOR..LARGEST_FACTOR,
            Self::Factor(_) => LEAST_FACTOR..LARGEST_FACTOR,
            Self::Zero(..) => LEAST_ZERO..f64::INFINITY,
        };
        range.contains(&values.norm())
    }
}

/// Every mistake with a size, at the size that explains most.
pub(super) fn refined(sample: &Sample) -> Vec<Change> {
    let coarse = sample.with_numbers(FEW_NUMBERS);
    let mut all = vec![
        Sized::Turn(Target::Wrench),
        Sized::Turn(Target::Joints),
        Sized::Height(ReferencePoint::Poses),
        Sized::Height(ReferencePoint::PlatformJoints),
        Sized::Preload,
        Sized::Weight,
    ];
    if sample.reads_poses {
        // Turned axes mix numbers, and take all of them.
        all.push(Sized::Turn(Target::Readings));
    }
    let joints: Vec<Sized> = JointCoordinate::all().map(Sized::Joint).collect();
    let (factors, zeros) = if sample.data.observations.len() < FEWEST_CONDITIONS {
        Default::default()
    } else {
        of_columns(sample)
    };
    all.extend([joints, factors, zeros].iter().flat_map(|kind| promising(&coarse, kind)));
    let at_best = |mistake: &Sized| {
        go_on();
        let first = minimized(&coarse, *mistake, mistake.start(&coarse))?;
        let values = minimized(sample, *mistake, first.as_slice().to_vec())?;
        (mistake.counts(&values) && !mistake.is_like_an_effect(&values))
            .then(|| mistake.change(sample, values.as_slice()))
    };
    parallel::filter_map(&all, at_best)
}

/// Those that, to first order, explain most.
fn promising(sample: &Sample, mistakes: &[Sized]) -> Vec<Sized> {
    let Some(here) = sample.residuals(&[]) else { return Vec::new() };
    let gain = |mistake: &Sized| {
        let there = sample.residuals(&[mistake.change(sample, &[STEP])])?;
        let slope = (there - &here) / STEP;
        Some((slope.dot(&here).powi(2) / slope.norm_squared().max(f64::MIN_POSITIVE), *mistake))
    };
    let mut all: Vec<(f64, Sized)> = parallel::filter_map(mistakes, gain);
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.into_iter().take(MOST_REFINED).map(|(_, mistake)| mistake).collect()
}

/// Factors and zero errors that the columns of a file may have.
fn of_columns(sample: &Sample) -> (Vec<Sized>, Vec<Sized>) {
    let columns = sample.columns();
    let group = |group| Sized::Factor(Columns::Group(group));
    let mut factors: Vec<Sized> = (0..6).map(|k| group(Group::Load(k))).collect();
    if sample.reads_poses {
        factors.extend([Group::Translations, Group::Rotations].map(group));
    }
    let factor = |column: &ReadingColumn| match *column {
        ReadingColumn::Pose(k) => group(Group::Reading(k)),
        ReadingColumn::Sensor(name) => Sized::Factor(Columns::Sensor(Sensors::One(name))),
    };
    factors.extend(columns.iter().map(factor));
    (factors, columns.into_iter().map(|column| Sized::Zero(column, sample.typical(column))).collect())
}

/// True for a load that nobody wrote down and that is no preload.
pub(super) fn is_small(load: &Wrench, sample: &Sample) -> bool {
    let force = typical_force(sample);
    let moment = load.moment / sample.hexapod.platform_radius();
    (load.force.norm_squared() + moment.norm_squared()).sqrt() < LEAST_PRELOAD * force
}

pub(super) fn typical_force(sample: &Sample) -> f64 {
    let rows = &sample.data.observations;
    let sum: f64 = rows.iter().map(|o| o.wrench.force.norm_squared()).sum();
    (sum / rows.len().max(1) as f64).sqrt().max(1e-3)
}

/// The size that leaves least.
fn minimized(sample: &Sample, mistake: Sized, start: Vec<f64>) -> Option<DVector<f64>> {
    let residuals = |values: &DVector<f64>| sample.residuals(&[mistake.change(sample, values.as_slice())]);
    let mut values = DVector::from_vec(start);
    let mut here = residuals(&values)?;
    for _ in 0..MOST_STEPS {
        let mut jacobian = DMatrix::zeros(here.len(), values.len());
        for k in 0..values.len() {
            let mut there = values.clone();
            there[k] += STEP;
            jacobian.set_column(k, &((residuals(&there)? - &here) / STEP));
        }
        let normal = jacobian.tr_mul(&jacobian);
        let damped = &normal + DMatrix::from_diagonal(&(normal.diagonal() * 1e-9).add_scalar(1e-300));
        let step = damped.cholesky()?.solve(&jacobian.tr_mul(&here));
        let before = here.norm_squared();
        let mut shortened = (0..5).map(|n| &values - &step * 0.5_f64.powi(n));
        let better =
            shortened.find_map(|v| residuals(&v).filter(|r| r.norm_squared() < before).map(|r| (r, v)));
        let Some((residual, moved)) = better else { break };
        (here, values) = (residual, moved);
        if before - here.norm_squared() < SETTLED * before {
            break;
        }
    }
    values.iter().all(|v| v.is_finite()).then_some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_that_a_tolerance_is_for_are_no_mistakes() {
        let joint = JointCoordinate { platform: true, leg: 0, axis: 2 };
        for (mistake, least) in [
            (Sized::Turn(Target::Wrench), 0.01),
            (Sized::Height(ReferencePoint::Poses), 0.1),
            (Sized::Joint(joint), 0.06),
            (Sized::Preload, 0.02),
            (Sized::Factor(Columns::Group(Group::Rotations)), 0.05),
            (Sized::Factor(Columns::Group(Group::Load(0))), 0.3),
            (Sized::Zero(ReadingColumn::Pose(2), 1e-5), 0.02),
        ] {
            let counts = |size: f64| mistake.counts(&DVector::from_element(1, size));
            assert!(counts(1.01 * least) && !counts(0.99 * least), "{mistake:?}");
        }
    }

    #[test]
    fn loads_turned_about_the_vertical_are_a_mistake_and_tilted_ones_an_effect() {
        let is_like = |target, upright: f64| {
            let turn = DVector::from_vec(vec![(1.0 - upright * upright).sqrt(), 0.0, upright]);
            Sized::Turn(target).is_like_an_effect(&turn)
        };
        assert!(is_like(Target::Wrench, 0.69) && !is_like(Target::Wrench, 0.71));
        assert!(!is_like(Target::Readings, 0.0));
    }
}
