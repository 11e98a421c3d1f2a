//! The model linearized at one point: whitened residuals and columns for springs, frames and terms.

use std::ops::Range;
use std::sync::Arc;

use hexbench_core::{Matrix6, Observation, Vector3, Vector6, spread};
use nalgebra::{DMatrix, DVector};

use crate::effects::chain::{Action, Link};
use crate::effects::term::{Rich, Term};
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, Condition, ConditionReadings};
use crate::estimation::equilibrium::{LegsOfPose, Tangents, YieldingMachine};
use crate::estimation::foresight;
use crate::estimation::parallel::{try_map, try_take_in_order};
use crate::estimation::parameters::common_count;
use crate::estimation::whitening::{Inexact, Whitening};
use crate::machine::geometry::{Machine, exponential};

/// Conditions whose columns are made together.
const PART: usize = 256;

/// So many conditions in ranges of those whose columns are made together.
pub(crate) fn parts_of(conditions: usize) -> Vec<Range<usize>> {
    (0..conditions).step_by(PART).map(|first| first..(first + PART).min(conditions)).collect()
}

/// A term in a model, with its values. SI.
#[derive(Clone)]
pub struct Active {
    /// The effect.
    pub term: Arc<dyn Term>,
    /// True when the richer form is used.
    pub rich: bool,
    /// Shape value; 1 when the term has none.
    pub shape: f64,
    /// Values of the parameters, ideal ones first.
    pub values: Vec<f64>,
}

impl Active {
    /// A term with all values zero.
    pub fn new(term: Arc<dyn Term>, rich: bool, shape: f64) -> Self {
        let count = parameter_count(term.as_ref(), rich);
        Self { term, rich, shape, values: vec![0.0; count] }
    }

    /// Id of the term.
    pub fn id(&self) -> &'static str {
        self.term.info().id
    }
}

impl std::fmt::Debug for Active {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}({:.3e}) {:?}", self.id(), if self.rich { "+" } else { "" }, self.shape, self.values)
    }
}

/// Number of linear parameters of a term in one of its forms.
pub fn parameter_count(term: &dyn Term, rich: bool) -> usize {
    let ideal = term.info().parameters.len();
    match (rich, term.info().rich) {
        (true, Rich::PerLeg) => ideal + 6,
        (true, Rich::Full) => ideal + 15,
        _ => ideal,
    }
}

/// Actions of a term in one of its forms at a condition.
pub fn actions(
    term: &dyn Term,
    rich: bool,
    shape: f64,
    machine: &Machine,
    at: &Condition,
    out: &mut Vec<Action>,
) {
    out.clear();
    term.actions(machine, at, shape, out);
    if rich {
        term.rich_actions(machine, at, shape, out);
    }
}

/// Values of everything the model contains. SI.
#[derive(Debug, Clone)]
pub struct ModelPoint {
    /// Compliance of each leg, m/N.
    pub compliances: Vector6,
    /// Terms with their values.
    pub active: Vec<Active>,
    /// Metrology and target frame motions found so far live in the machine.
    pub machine: Machine,
}

impl ModelPoint {
    /// No springs, no terms, machine as drawn, standing where the campaign finds it in its instrument.
    pub fn start(campaign: &Campaign) -> Self {
        let mut machine = Machine::nominal(&campaign.hexapod);
        machine.metrology_frame = campaign.frames.metrology;
        machine.target_frame = campaign.frames.target;
        Self { compliances: Vector6::zeros(), active: Vec::new(), machine }
    }

    /// The machine with the geometry that calibrating terms have found.
    pub fn calibrated_machine(&self) -> Machine {
        let mut machine = self.machine.clone();
        for a in self.active.iter().filter(|a| a.term.calibrates()) {
            a.term.calibrate(&a.values, &mut machine);
        }
        machine
    }

    /// Move the metrology and target frames by small motions `[metrology; target]`.
    pub fn move_frames(&mut self, motion: &[f64]) {
        let (m, t) = (Vector6::from_column_slice(&motion[..6]), Vector6::from_column_slice(&motion[6..12]));
        self.machine.metrology_frame *= exponential(&m);
        self.machine.target_frame = exponential(&t) * self.machine.target_frame;
    }
}

/// Whitened model at a point.
#[derive(Debug, Clone)]
pub struct Linearization {
    /// Machine with calibrated geometry.
    pub machine: Machine,
    /// Conditions on that machine.
    pub conditions: Vec<Condition>,
    links: Vec<Link>,
    whitening: Whitening,
    absolute: bool,
}

impl Linearization {
    /// Linearize a campaign at a point.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn at(campaign: &Campaign, point: &ModelPoint) -> Result<Self, ModelError> {
        Self::with(campaign, point, Tangents::ForAll, |_, _| (), drop)
    }

    /// The same where no columns of other terms than those at the point will be asked for. Hands over, in order, what is made of some of
    /// the conditions at a time; inputs taken as exact, errors as independent.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub(crate) fn at_fit<R: Send>(
        campaign: &Campaign,
        point: &ModelPoint,
        make: impl Fn(&Self, Range<usize>) -> R + Sync + Send,
        take: impl FnMut(R),
    ) -> Result<Self, ModelError> {
        Self::with(campaign, point, Tangents::ForFit, make, take)
    }

    fn with<R: Send>(
        campaign: &Campaign,
        point: &ModelPoint,
        tangents: Tangents,
        make: impl Fn(&Self, Range<usize>) -> R + Sync + Send,
        mut take: impl FnMut(R),
    ) -> Result<Self, ModelError> {
        let count = campaign.groups.len();
        let (mut conditions, mut links) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let part = |some: Self, range| {
            let made = make(&some, range);
            (some, made)
        };
        // A part at a time: a condition takes kilobytes, and each is moved to its place but once.
        Self::each_part(campaign, point, tangents, part, |(mut some, made)| {
            conditions.append(&mut some.conditions);
            links.append(&mut some.links);
            take(made);
        })?;
        let (machine, whitening) = (point.calibrated_machine(), Whitening::of(campaign));
        Ok(Self { machine, conditions, links, whitening, absolute: campaign.is_absolute() })
    }

    /// Hands over, in order, what is made of some of the conditions at a time, for the terms at the point; inputs taken as exact, errors
    /// as independent. Nothing is kept of the conditions, each of which takes kilobytes.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub(crate) fn in_parts<R: Send>(
        campaign: &Campaign,
        point: &ModelPoint,
        make: impl Fn(&Self, Range<usize>) -> R + Sync + Send,
        take: impl FnMut(R),
    ) -> Result<(), ModelError> {
        Self::each_part(campaign, point, Tangents::ForFit, |some, range| make(&some, range), take)
    }

    /// Hands over, in order, what is made of each part of the conditions.
    fn each_part<R: Send>(
        campaign: &Campaign,
        point: &ModelPoint,
        tangents: Tangents,
        make: impl Fn(Self, Range<usize>) -> R + Sync + Send,
        take: impl FnMut(R),
    ) -> Result<(), ModelError> {
        let machine = point.calibrated_machine();
        let structure = YieldingMachine::of(&machine, &point.compliances, &point.active, tangents);
        let part = |range: &Range<usize>| {
            foresight::of_campaign(campaign, point, tangents, range.clone(), |_, o| *o);
            let (conditions, links) = linked_part(campaign, &structure, point, range.clone())?;
            let (machine, whitening) = (machine.clone(), Whitening::nothing());
            let some = Self { machine, conditions, links, whitening, absolute: campaign.is_absolute() };
            Ok(make(some, range.clone()))
        };
        try_take_in_order(&parts_of(campaign.groups.len()), part, take)
    }

    /// Ranges of conditions small enough for all columns of all candidates to fit in the cache, where inputs are taken as exact; all
    /// conditions in one where they share errors.
    pub(crate) fn parts_of_noise(&self) -> Vec<Range<usize>> {
        let n = self.conditions.len();
        if !self.whitening.noise_is_independent() {
            return std::iter::once(0..n).collect();
        }
        parts_of(n)
    }

    /// Some of the conditions, inputs taken as exact.
    pub(crate) fn part_of_noise(&self, range: &Range<usize>) -> Self {
        self.picked(range.clone(), self.whitening.of_noise_alone().choose(range.clone()))
    }

    /// True when errors of the readings are independent, but for inputs that are known to a tolerance only.
    pub(crate) fn noise_is_independent(&self) -> bool {
        self.whitening.noise_is_independent()
    }

    /// Inputs that are known to a tolerance only.
    pub(crate) fn inexact(&self) -> Option<&Inexact> {
        self.whitening.inexact()
    }

    /// Some of the conditions, at most `most`, spread over all of them.
    #[must_use]
    pub fn thinned(&self, most: usize) -> Self {
        self.choose(spread(self.conditions.len(), most))
    }

    /// Some of the conditions, in this order.
    #[must_use]
    pub fn choose(&self, which: impl Iterator<Item = usize> + Clone) -> Self {
        self.picked(which.clone(), self.whitening.choose(which))
    }

    /// Those of a part of the campaign, of which these are the groups.
    #[must_use]
    pub(crate) fn choose_of(&self, part: &Campaign, groups: &[usize]) -> Self {
        self.picked(groups.iter().copied(), Whitening::of(part))
    }

    fn picked(&self, which: impl Iterator<Item = usize> + Clone, whitening: Whitening) -> Self {
        Self {
            machine: self.machine.clone(),
            conditions: which.clone().map(|i| self.conditions[i].clone()).collect(),
            links: which.map(|i| self.links[i]).collect(),
            whitening,
            absolute: self.absolute,
        }
    }

    /// Number of whitened equations.
    pub fn equations(&self) -> usize {
        6 * self.conditions.len()
    }

    /// Averaged numbers that were read: six for each condition, unless something else was read than full poses.
    pub fn numbers(&self) -> f64 {
        self.conditions.iter().map(|c| c.numbers).sum::<usize>() as f64
    }

    /// Number of columns every model has: six springs, in absolute mode also two frames.
    pub fn common_columns(&self) -> usize {
        common_count(self.absolute)
    }

    /// Residual of one condition over the standard deviation of what is its own.
    pub fn residual(&self, condition: usize) -> Vector6 {
        let c = &self.conditions[condition];
        c.weights.of(c.reading) - self.links[condition].prediction()
    }

    /// Motion of the platform at one condition: geometric twist at the mobile origin, m and rad.
    pub fn motion(&self, condition: usize) -> Vector6 {
        self.links[condition].motion()
    }

    /// Prediction at one condition in measured coordinates, m and rad.
    pub fn predicted(&self, condition: usize) -> Vector6 {
        let c = &self.conditions[condition];
        c.reading - c.weights.numbers(self.residual(condition))
    }

    /// Whitened residuals, six per condition.
    pub fn residuals(&self) -> DVector<f64> {
        self.stacked(|i| self.residual(i))
    }

    /// Whitened predictions, six per condition.
    pub fn predictions(&self) -> DVector<f64> {
        self.stacked(|i| self.links[i].prediction())
    }

    fn stacked(&self, of: impl Fn(usize) -> Vector6) -> DVector<f64> {
        let mut out = DVector::zeros(self.equations());
        for i in 0..self.conditions.len() {
            out.fixed_rows_mut::<6>(6 * i).copy_from(&of(i));
        }
        self.whitened_column(out)
    }

    /// Whitened reading per leg elongation, at every condition.
    pub fn elongation_readers(&self) -> Vec<Matrix6> {
        self.links.iter().map(Link::by_elongation).collect()
    }

    /// Whitened reading per unit of six actions, at every condition.
    pub fn readers_of(&self, action: impl Fn(&Condition, usize) -> Action) -> Vec<Matrix6> {
        let of = |(c, link): (&Condition, &Link)| {
            let columns: [Vector6; 6] = std::array::from_fn(|k| link.by_action(c, &action(c, k)));
            Matrix6::from_columns(&columns)
        };
        self.conditions.iter().zip(&self.links).map(of).collect()
    }

    /// Motion of the platform per component of the load, at every condition: geometric twist at the mobile origin.
    pub(crate) fn motions_by_load(&self) -> Vec<Matrix6> {
        let of = |(c, link): (&Condition, &Link)| {
            let columns: [Vector6; 6] =
                std::array::from_fn(|k| link.motion_by_wrench(c, &Vector6::ith(k, 1.0)));
            Matrix6::from_columns(&columns)
        };
        self.conditions.iter().zip(&self.links).map(of).collect()
    }

    /// Whitened reading per component of the load, at every condition: of each force, N, and of each moment, N m.
    pub fn load_readers(&self) -> Vec<Matrix6> {
        self.readers_of(|_, k| Action::Wrench(Vector6::ith(k, 1.0)))
    }

    /// Columns of springs and frames.
    pub fn common_block(&self) -> DMatrix<f64> {
        self.whitened(self.own_common_block())
    }

    /// The same over the standard deviation of what is a reading's own.
    pub(crate) fn own_common_block(&self) -> DMatrix<f64> {
        let mut block = DMatrix::zeros(self.equations(), self.common_columns());
        let mut actions = Vec::new();
        for (i, (c, link)) in self.conditions.iter().zip(&self.links).enumerate() {
            for leg in 0..6 {
                block.fixed_view_mut::<6, 1>(6 * i, leg).copy_from(&link.by_spring(leg));
            }
            if self.absolute {
                frame_actions(c, &mut actions);
                write_actions(&mut block, i, 6, c, link, &actions);
            }
        }
        block
    }

    /// Columns of the inputs that are known to a tolerance only, per tolerance; none when all are taken as exact.
    pub fn input_block(&self) -> Option<DMatrix<f64>> {
        self.whitening.inputs()
    }

    /// Columns of reading over the standard deviation of what is its own, whitened as all others.
    #[must_use]
    pub fn whitened(&self, mut columns: DMatrix<f64>) -> DMatrix<f64> {
        self.whitening.apply(&mut columns);
        columns
    }

    /// `T` with which whitening twice is `I - T T'`; none where errors of readings are correlated.
    pub(crate) fn whitened_out(&self) -> Option<DMatrix<f64>> {
        self.whitening.taken_out(self.equations())
    }

    /// Columns of a term.
    pub fn term_block(&self, term: &dyn Term, rich: bool, shape: f64) -> DMatrix<f64> {
        self.whitened(self.own_term_block(term, rich, shape))
    }

    /// The same over the standard deviation of what is a reading's own.
    pub(crate) fn own_term_block(&self, term: &dyn Term, rich: bool, shape: f64) -> DMatrix<f64> {
        foresight::of_conditions(term, rich, shape, &self.machine, &self.conditions);
        self.own_term_rows(term, rich, shape, 0..self.conditions.len())
    }

    /// The same of some conditions, without foresight of what the term will be asked.
    pub(crate) fn own_term_rows(
        &self,
        term: &dyn Term,
        rich: bool,
        shape: f64,
        range: Range<usize>,
    ) -> DMatrix<f64> {
        let mut block = DMatrix::zeros(6 * range.len(), parameter_count(term, rich));
        let mut out = Vec::new();
        for (i, (c, link)) in self.conditions[range.clone()].iter().zip(&self.links[range]).enumerate() {
            actions(term, rich, shape, &self.machine, c, &mut out);
            write_actions(&mut block, i, 0, c, link, &out);
        }
        block
    }

    /// What an active term with another shape adds to the prediction, over the standard deviation of what is a reading's own.
    pub(crate) fn own_share(&self, active: &Active, shape: f64) -> DVector<f64> {
        let block = self.own_term_block(active.term.as_ref(), active.rich, shape);
        block * DVector::from_column_slice(&active.values)
    }

    /// One column of reading over the standard deviation of what is its own, whitened as all others.
    #[must_use]
    pub(crate) fn whitened_column(&self, mut column: DVector<f64>) -> DVector<f64> {
        self.whitening.apply_to(&mut column);
        column
    }

    /// Columns of any actions, one per element of what `actions_of` pushes.
    pub fn block_of(
        &self,
        columns: usize,
        actions_of: impl Fn(&Condition, &mut Vec<Action>),
    ) -> DMatrix<f64> {
        let mut block = DMatrix::zeros(self.equations(), columns);
        let mut out = Vec::with_capacity(columns);
        for (i, (c, link)) in self.conditions.iter().zip(&self.links).enumerate() {
            out.clear();
            actions_of(c, &mut out);
            write_actions(&mut block, i, 0, c, link, &out);
        }
        self.whitening.apply(&mut block);
        block
    }
}

/// Some of the conditions of a campaign, and their chains.
fn linked_part(
    campaign: &Campaign,
    structure: &YieldingMachine<'_>,
    point: &ModelPoint,
    range: Range<usize>,
) -> Result<(Vec<Condition>, Vec<Link>), ModelError> {
    let (mut conditions, mut links) = (Vec::with_capacity(range.len()), Vec::with_capacity(range.len()));
    let mut last = LegsOfPose::default();
    for group in &campaign.groups[range] {
        let (at, link) = linked(campaign, structure, point, (group, &group.mean), &mut last)?;
        conditions.push(*at);
        links.push(link);
    }
    Ok((conditions, links))
}

/// A condition of readings taken under the inputs of `o`, and its chain; `last`: legs at the pose before.
fn linked(
    campaign: &Campaign,
    structure: &YieldingMachine<'_>,
    point: &ModelPoint,
    (group, o): (&ConditionReadings, &Observation),
    last: &mut LegsOfPose,
) -> Result<(Box<Condition>, Link), ModelError> {
    let (at, load) = campaign.condition(structure, group, o, last)?;
    let link = Link::at(&at, &point.compliances, &load);
    Ok((at, link))
}

/// Blocks of columns side by side.
pub fn beside(blocks: &[DMatrix<f64>]) -> DMatrix<f64> {
    let rows = blocks.first().map_or(0, DMatrix::nrows);
    let mut all = DMatrix::zeros(rows, blocks.iter().map(DMatrix::ncols).sum());
    let mut at = 0;
    for block in blocks {
        all.columns_mut(at, block.ncols()).copy_from(block);
        at += block.ncols();
    }
    all
}

fn write_actions(
    block: &mut DMatrix<f64>,
    i: usize,
    first: usize,
    c: &Condition,
    link: &Link,
    actions: &[Action],
) {
    for (k, action) in actions.iter().enumerate() {
        block.fixed_view_mut::<6, 1>(6 * i, first + k).copy_from(&link.by_action(c, action));
    }
}

/// Residuals of a campaign whose readings were taken under other inputs (by number of the condition), each over the standard deviation of what is its own; six per
/// condition. Nothing is kept of the conditions.
///
/// # Errors
/// As [`Linearization::at`].
pub(crate) fn own_residuals(
    campaign: &Campaign,
    point: &ModelPoint,
    inputs: impl Fn(usize, &Observation) -> Observation + Sync,
) -> Result<DVector<f64>, ModelError> {
    let machine = point.calibrated_machine();
    // What other terms would do is not asked for.
    let structure = YieldingMachine::of(&machine, &point.compliances, &point.active, Tangents::ForFit);
    foresight::of_campaign(campaign, point, Tangents::ForFit, 0..campaign.groups.len(), &inputs);
    let residual = |&i: &usize| {
        let group = &campaign.groups[i];
        let inputs = inputs(i, &group.mean);
        let (at, link) = linked(campaign, &structure, point, (group, &inputs), &mut LegsOfPose::default())?;
        Ok(at.weights.of(at.reading) - link.prediction())
    };
    let groups: Vec<usize> = (0..campaign.groups.len()).collect();
    let all: Vec<Vector6> = try_map(&groups, residual)?;
    Ok(DVector::from_iterator(6 * all.len(), all.iter().flat_map(|r| r.iter().copied())))
}

/// Small motions of the metrology frame (fixed axes, fixed origin) and of the target frame (mobile axes).
fn frame_actions(c: &Condition, out: &mut Vec<Action>) {
    out.clear();
    let axis = |k: usize| Vector3::ith(k % 3, 1.0);
    let (rotation, none) = (c.place.rotation, Vector3::zeros());
    let parts = |k: usize| match k {
        0..3 => [axis(k), none],
        3..6 => [axis(k).cross(&c.place.translation), axis(k)],
        6..9 => [rotation * axis(k), none],
        _ => [none, rotation * axis(k)],
    };
    let by_twist = Matrix6::from_columns(&std::array::from_fn::<Vector6, 6, _>(|k| {
        force_of_frame(c, &Vector6::ith(k, 1.0))
    }));
    out.extend((0..12).map(parts).map(|[v, w]| {
        let twist = Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        Action::Frame { twist, force: by_twist * twist }
    }));
}

/// Change of the leg forces when a frame moves the reading by a twist: it puts the platform behind a given reading back by the same.
fn force_of_frame(c: &Condition, twist: &Vector6) -> Vector6 {
    let [v, w] = [0, 3].map(|first| Vector3::from(twist.fixed_rows::<3>(first)));
    let back = |leg: usize| {
        let arm = -w.cross(&c.legs.arms[leg]);
        c.wrench_of_turn(leg, &(arm - v), &arm)
    };
    let turned: Vector6 = (0..6).map(back).sum();
    -c.legs.forces(&turned)
}
