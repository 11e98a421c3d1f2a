//! Inputs that are known to a tolerance only: joints, loads, axes.
//!
//! What a small error of an input does to the readings is linear in it and follows from the model: a column per input, a
//! standard deviation long. With a Gaussian for the errors the covariance of the readings is that of the noise plus the
//! columns times their transpose; [`whitening`](crate::estimation::whitening) takes it out of everything that is fitted,
//! weighed or predicted.

use std::ops::Range;
use std::sync::Arc;

use hexbench_core::{Channel, Sensor, SensorInput, SensorKind, Tolerances, Vector3, Vector6};
use nalgebra::{DMatrix, DVector};

use crate::effects::term::{Chapter, Term};
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, Condition};
use crate::estimation::fit::{Fit, fit};
use crate::estimation::fit_named::{Added, fit_wanted};
use crate::estimation::input_slopes::by_springs;
use crate::estimation::linearization::{Linearization, ModelPoint, beside, parts_of};
use crate::estimation::parallel::try_take_in_order;
use crate::estimation::starts::some_of;
use crate::terms::catalogue;

/// Share of themselves by which errors of inputs bend springs before it matters.
const BENT: f64 = 0.05;
/// Springs that miss the readings by so many times the noise say nothing better a second time.
const FAR_OFF: f64 = 30.0;

/// Inputs of one kind, which share a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputKind {
    /// Coordinates of the joints in deflection mode: base joints in the fixed frame, then platform joints in the mobile frame.
    Joints,
    /// Scale of each component of the loads.
    LoadGain,
    /// Direction of the loads about each fixed axis.
    LoadDirection,
    /// Point at which the loads act, mobile frame.
    LoadPoint,
    /// Axes of the readings about each fixed axis.
    Frame,
}

impl InputKind {
    /// All of them, in the order of their columns.
    pub const ALL: [Self; 5] =
        [Self::Joints, Self::LoadGain, Self::LoadDirection, Self::LoadPoint, Self::Frame];
    /// Columns of all of them.
    pub const COLUMNS: usize = 51;

    /// Number of inputs.
    pub fn count(self) -> usize {
        match self {
            Self::Joints => 36,
            Self::LoadGain => 6,
            Self::LoadDirection | Self::LoadPoint | Self::Frame => 3,
        }
    }

    /// Columns of these inputs among all.
    pub fn columns(self) -> Range<usize> {
        let first = Self::ALL.iter().take_while(|kind| **kind != self).map(|kind| kind.count()).sum();
        first..first + self.count()
    }

    /// Standard deviation of one input, SI.
    pub fn standard_deviation(self, tolerances: &Tolerances) -> f64 {
        *self.of(&mut tolerances.clone())
    }

    /// States another standard deviation, SI.
    pub fn set(self, tolerances: &mut Tolerances, standard_deviation: f64) {
        *self.of(tolerances) = standard_deviation;
    }

    fn of(self, tolerances: &mut Tolerances) -> &mut f64 {
        match self {
            Self::Joints => &mut tolerances.joints,
            Self::LoadGain => &mut tolerances.load_gain,
            Self::LoadDirection => &mut tolerances.load_direction,
            Self::LoadPoint => &mut tolerances.load_point,
            Self::Frame => &mut tolerances.frame,
        }
    }
}

/// Reading over the standard deviation of what is its own, per standard deviation of every input, on the springs of a point; six rows for each condition,
/// [`InputKind::COLUMNS`] columns, and those of the sensors where there are any. Of absolute poses only the loads are inputs: there joints
/// are an effect of the catalogue, and frames are estimated.
///
/// # Errors
/// As [`Linearization::at`].
pub fn input_columns(
    campaign: &Campaign,
    point: &ModelPoint,
    tolerances: &Tolerances,
) -> Result<DMatrix<f64>, ModelError> {
    let of = |range: &Range<usize>| {
        let groups: Vec<usize> = range.clone().collect();
        columns_of(&campaign.unwhitened_part(&groups), point, tolerances).map(|block| (range.start, block))
    };
    // A part at a time: a condition in hand takes more memory than its columns.
    let mut parts = parts_of(campaign.groups.len());
    if parts.is_empty() {
        parts.push(0..0);
    }
    let mut all = DMatrix::zeros(0, 0);
    try_take_in_order(&parts, of, |(first, block)| {
        if first == 0 {
            all = DMatrix::zeros(6 * campaign.groups.len(), block.ncols());
        }
        all.rows_mut(6 * first, block.nrows()).copy_from(&block);
    })?;
    Ok(all)
}

/// The same of some conditions, all of them in hand at once.
fn columns_of(
    bare: &Campaign,
    point: &ModelPoint,
    tolerances: &Tolerances,
) -> Result<DMatrix<f64>, ModelError> {
    let start = Linearization::at(bare, point)?;
    let mut columns =
        by_springs(bare, &point.compliances, &start).resize_horizontally(InputKind::COLUMNS, 0.0);
    for kind in InputKind::ALL.into_iter().filter(|kind| *kind != InputKind::Frame) {
        columns.columns_range_mut(kind.columns()).scale_mut(kind.standard_deviation(tolerances));
    }
    if bare.is_absolute() {
        return Ok(columns);
    }
    for (k, column) in InputKind::Frame.columns().enumerate() {
        columns.set_column(column, &(turned_readings(bare, &start, k) * tolerances.frame));
    }
    if bare.reads_poses {
        return Ok(columns);
    }
    let sensors: Vec<DVector<f64>> = of_sensors(bare, &start, tolerances);
    Ok(beside(&std::iter::once(columns).chain(sensors.iter().map(column_matrix)).collect::<Vec<_>>()))
}

fn column_matrix(column: &DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_column_slice(column.len(), 1, column.as_slice())
}

/// A campaign whose inputs are as good as the tolerances of its machine; as it is where springs cannot be fitted.
#[must_use]
pub fn within_tolerances(campaign: Campaign) -> Campaign {
    if campaign.is_absolute() {
        return match with_joints(&campaign) {
            Ok(fitted) => within_tolerances_at(campaign, &fitted.point),
            Err(_) => campaign,
        };
    }
    let Ok(exact) = fit(&campaign, &[], None) else { return campaign };
    let within = within_tolerances_at(campaign, &exact.point);
    if within.inexact.is_none() || exact.chi2_reduced() > FAR_OFF * FAR_OFF {
        return within;
    }
    // Springs that take inputs for exact are bent by their errors, and what an error does follows from the springs.
    let Some(known) = fit(&within, &[], Some(&exact.point)).ok().filter(|known| differ(&exact, known)) else {
        return within;
    };
    // Columns are most of what a large campaign takes: those of the first springs go before the others come.
    let mut bare = within;
    bare.inexact = None;
    match finite_columns(&bare, &known.point) {
        Some(columns) => bare.with_inexact(columns, Arc::new(known.point)),
        None => within_tolerances_at(bare, &exact.point),
    }
}

/// True where springs beside tolerances are not those beside exact inputs.
fn differ(exact: &Fit, known: &Fit) -> bool {
    let [exact, known] = [exact, known].map(|fit| fit.point.compliances);
    (known - exact).amax() > BENT * exact.amax()
}

/// Springs beside the places of the joints: in absolute poses the errors of joints are larger than deflections, and what springs alone
/// would be there says nothing of what loads do. Of many readings some tell the places well enough.
fn with_joints(campaign: &Campaign) -> Result<Fit, ModelError> {
    let some = some_of(campaign);
    let campaign = some.as_ref().unwrap_or(campaign);
    let places = |term: &Arc<dyn Term>| places_joints(term.as_ref());
    let joints: Vec<Added> = catalogue().into_iter().filter(places).map(Added::from).collect();
    match fit_wanted(campaign, &joints) {
        Ok((_, fitted)) => Ok(fitted),
        Err(_) => fit(campaign, &[], None),
    }
}

/// True for the effect that finds the places of the joints.
pub(crate) fn places_joints(term: &dyn Term) -> bool {
    term.info().chapter == Chapter::AbsolutePoses && term.calibrates()
}

/// The same for springs that are known, in absolute poses with the places of the joints; what else yields at the point does not count.
#[must_use]
pub fn within_tolerances_at(campaign: Campaign, point: &ModelPoint) -> Campaign {
    match finite_columns(&campaign, point) {
        Some(columns) => campaign.with_inexact(columns, Arc::new(point.clone())),
        None => campaign,
    }
}

fn finite_columns(campaign: &Campaign, point: &ModelPoint) -> Option<DMatrix<f64>> {
    let columns = input_columns(campaign, point, &campaign.hexapod.tolerances).ok()?;
    columns.iter().all(|x| x.is_finite()).then_some(columns)
}

/// Other readings of the machine of a campaign, their inputs as good as those of the campaign. What an error of an input does depends on
/// how the machine yields as a whole, not on what the yielding is put down to.
#[must_use]
pub fn within_tolerances_of(campaign: &Campaign, others: Campaign) -> Campaign {
    match &campaign.inexact {
        Some(known) => within_tolerances_at(others, &known.machine),
        None => others,
    }
}

fn axis(k: usize) -> Vector3 {
    Vector3::ith(k, 1.0)
}

/// What the readings would gain if their axes were turned by one radian, to first order.
fn turned_readings(campaign: &Campaign, lin: &Linearization, k: usize) -> DVector<f64> {
    let mut column = DVector::zeros(lin.equations());
    for (i, (group, at)) in campaign.groups.iter().zip(&lin.conditions).enumerate() {
        let turned = if group.channels == Channel::POSE {
            cross_both(k, &lin.predicted(i))
        } else {
            at.observer * cross_both(k, &lin.motion(i))
        };
        column.fixed_rows_mut::<6>(6 * i).copy_from(&at.weights.of(turned));
    }
    column
}

/// `e_k x v` and `e_k x w` of a twist.
fn cross_both(k: usize, twist: &Vector6) -> Vector6 {
    let turn = |first: usize| axis(k).cross(&twist.fixed_rows::<3>(first).into_owned());
    let (v, w) = (turn(0), turn(3));
    Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
}

/// Reading over the standard deviation of its noise, per tolerance of the point, of the direction and of the gain of every sensor.
///
/// With the motion `[v; w]` of the platform and the arm `r` of the point:
///
/// ```text
/// distance      d y = (w x R dp) . u + (v + w x r) . (e x u)      e: small turn of the direction
/// point         d y =  w x R dp
/// inclination   d y =  w . (e x a)
/// gain          d y =  y
/// ```
fn of_sensors(campaign: &Campaign, lin: &Linearization, tolerances: &Tolerances) -> Vec<DVector<f64>> {
    let each = (0..campaign.hexapod.sensors.len()).flat_map(|index| {
        let sensor = &campaign.hexapod.sensors[index];
        sensor_inputs(sensor).flat_map(move |input| {
            let unit = input.standard_deviation(tolerances) * sensor.looseness_of(input);
            (0..input.count()).map(move |k| sensor_column(campaign, lin, index, (input, k)) * unit)
        })
    });
    each.collect()
}

/// What a sensor has of the inputs.
fn sensor_inputs(sensor: &Sensor) -> impl Iterator<Item = SensorInput> {
    SensorInput::ALL.into_iter().filter(|input| sensor.has(*input))
}

/// Columns of what is known of every sensor to a tolerance, among those of all inputs; there are none where full poses are read.
pub(crate) fn columns_of_sensors(sensors: &[Sensor]) -> Vec<(usize, SensorInput, Range<usize>)> {
    let mut next = InputKind::COLUMNS;
    let mut range = |input: SensorInput| {
        next += input.count();
        next - input.count()..next
    };
    let each = sensors.iter().enumerate();
    each.flat_map(|(index, sensor)| sensor_inputs(sensor).map(move |input| (index, input)))
        .map(|(index, input)| (index, input, range(input)))
        .collect()
}

/// Reading over the standard deviation of its noise, per unit of one number of an input of a sensor: a meter, a radian, or all of it.
pub(crate) fn sensor_column(
    campaign: &Campaign,
    lin: &Linearization,
    index: usize,
    (input, k): (SensorInput, usize),
) -> DVector<f64> {
    let sensor = &campaign.hexapod.sensors[index];
    let spin = |motion: &Vector6| -> Vector3 { motion.fixed_rows::<3>(3).into_owned() };
    let moved =
        |at: &Condition, motion: &Vector6, by: &Vector3| spin(motion).cross(&(at.place.rotation * by));
    let unit = axis(k);
    numbers_of_sensor(campaign, lin, index, |at, motion, channel, number| match (input, &sensor.kind) {
        (SensorInput::Gain, _) => at.observer.row(channel).transpose().dot(motion),
        (SensorInput::Point, SensorKind::Distance { direction, .. }) => {
            sensor.gain * direction.dot(&moved(at, motion, &unit))
        }
        (SensorInput::Point, SensorKind::Point { .. }) => sensor.gain * moved(at, motion, &unit)[number],
        (SensorInput::Direction, SensorKind::Distance { point, direction, .. }) => {
            let shift: Vector3 = motion.fixed_rows::<3>(0).into_owned();
            sensor.gain * (shift + moved(at, motion, point)).dot(&unit.cross(direction))
        }
        (SensorInput::Direction, SensorKind::Inclination { axis, .. }) => {
            sensor.gain * spin(motion).dot(&unit.cross(axis))
        }
        _ => 0.0,
    })
}

/// A column that acts on the numbers of one sensor.
fn numbers_of_sensor(
    campaign: &Campaign,
    lin: &Linearization,
    index: usize,
    value: impl Fn(&Condition, &Vector6, usize, usize) -> f64,
) -> DVector<f64> {
    let mut column = DVector::zeros(lin.equations());
    for (i, (group, at)) in campaign.groups.iter().zip(&lin.conditions).enumerate() {
        let motion = lin.motion(i);
        let of_number = |k: usize, _| match group.channels[k] {
            Channel::Sensor { sensor, number } if sensor == index && group.reads[k] > 0 => {
                value(at, &motion, k, number)
            }
            _ => 0.0,
        };
        column.fixed_rows_mut::<6>(6 * i).copy_from(&at.weights.of(Vector6::from_fn(of_number)));
    }
    column
}

#[cfg(test)]
mod tests;
