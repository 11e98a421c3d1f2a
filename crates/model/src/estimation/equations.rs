//! A campaign linearized at a point, as equations: what a fit keeps of it.
//!
//! A condition with its chain takes kilobytes, its equations hundreds of bytes. So the conditions of a part of the campaign are made,
//! turned into equations, and forgotten.

use std::ops::Range;

use hexbench_core::Vector6;
use nalgebra::{DMatrix, DVector};

use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, rows_of};
use crate::estimation::fit::own_columns;
use crate::estimation::linearization::{Linearization, ModelPoint};
use crate::estimation::lsq::Triangle;
use crate::estimation::nuisance::InputsAfterFit;
use crate::estimation::parameters::Parameters;
use crate::estimation::whitening::{Inexact, Whitening};

/// Change of a leg force below which nothing pulls, N.
const NO_FORCE: f64 = 1e-9;

/// Six equations for each condition, over the standard deviation of what is a reading's own.
pub(crate) struct Equations {
    /// `[A y]`: columns of the parameters of a fit, and what the model at the point leaves of the readings.
    own: DMatrix<f64>,
    /// What makes errors of readings independent.
    whitening: Whitening,
    /// True when some load changes the force in some leg.
    pub(crate) is_loaded: bool,
}

/// Those of some of the conditions of a campaign.
pub(crate) struct PartOfEquations {
    first: usize,
    columns: DMatrix<f64>,
    residuals: DVector<f64>,
    is_loaded: bool,
}

impl PartOfEquations {
    /// By a linearization of these conditions alone; inputs taken as exact, errors as independent.
    pub(crate) fn of(lin: &Linearization, range: &Range<usize>, point: &ModelPoint) -> Self {
        let is_loaded = lin.conditions.iter().any(|c| c.force_change().amax() >= NO_FORCE);
        Self {
            first: 6 * range.start,
            columns: own_columns(lin, point),
            residuals: lin.residuals(),
            is_loaded,
        }
    }
}

impl Equations {
    /// Of a campaign at a point, for the parameters of a fit that starts there.
    ///
    /// # Errors
    /// As [`Linearization::at`].
    pub(crate) fn at(campaign: &Campaign, point: &ModelPoint) -> Result<Self, ModelError> {
        Self::at_in(DMatrix::zeros(0, 0), campaign, point)
    }

    /// The same in the place of others that are no longer needed.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub(crate) fn at_in(
        place: DMatrix<f64>,
        campaign: &Campaign,
        point: &ModelPoint,
    ) -> Result<Self, ModelError> {
        let mut all = Self::awaited_in(place, campaign, point);
        let part = |lin: &Linearization, range: Range<usize>| PartOfEquations::of(lin, &range, point);
        Linearization::in_parts(campaign, point, part, |part| all.put(part))?;
        Ok(all)
    }

    /// Before any part of them is put in its place.
    pub(crate) fn awaited(campaign: &Campaign, point: &ModelPoint) -> Self {
        Self::awaited_in(DMatrix::zeros(0, 0), campaign, point)
    }

    fn awaited_in(place: DMatrix<f64>, campaign: &Campaign, point: &ModelPoint) -> Self {
        let unknowns = Parameters::at(point, campaign.is_absolute()).len();
        let shape = (6 * campaign.groups.len(), unknowns + 1);
        let own = if place.shape() == shape { place } else { DMatrix::zeros(shape.0, shape.1) };
        Self { own, whitening: Whitening::of(campaign), is_loaded: false }
    }

    /// Puts those of some of the conditions in their place.
    pub(crate) fn put(&mut self, part: PartOfEquations) {
        let PartOfEquations { first, columns, residuals, is_loaded } = part;
        let unknowns = columns.ncols();
        self.own.view_mut((first, 0), columns.shape()).copy_from(&columns);
        self.own.view_mut((first, unknowns), (residuals.len(), 1)).copy_from(&residuals);
        self.is_loaded |= is_loaded;
    }

    /// Those of a part of the campaign, of which these are the groups.
    pub(crate) fn choose_of(&self, part: &Campaign, groups: &[usize]) -> Self {
        Self { own: self.own_of(groups), whitening: Whitening::of(part), is_loaded: self.is_loaded }
    }

    /// The same with all that the readings of a campaign share.
    pub(crate) fn within(self, campaign: &Campaign) -> Self {
        Self { whitening: Whitening::of(campaign), ..self }
    }

    /// Their place, for others.
    pub(crate) fn into_place(self) -> DMatrix<f64> {
        self.own
    }

    /// `[A y]`.
    pub(crate) fn own(&self) -> &DMatrix<f64> {
        &self.own
    }

    /// `[A y]` of some groups.
    pub(crate) fn own_of(&self, groups: &[usize]) -> DMatrix<f64> {
        self.own.select_rows(&rows_of(groups.iter().copied()))
    }

    /// What the model leaves of one condition, over the standard deviation of what is a reading's own.
    pub(crate) fn residual(&self, condition: usize) -> Vector6 {
        self.own.fixed_view::<6, 1>(6 * condition, self.own.ncols() - 1).into_owned()
    }

    /// What the model leaves, whitened.
    pub(crate) fn residuals(&self) -> DVector<f64> {
        let mut left = self.own.column(self.own.ncols() - 1).into_owned();
        self.whitening.apply_to(&mut left);
        left
    }

    /// Columns, and what the model leaves, whitened.
    pub(crate) fn whitened(&self) -> (DMatrix<f64>, DVector<f64>) {
        let mut all = self.own.clone();
        self.whitening.apply(&mut all);
        sides(all)
    }

    /// Columns, and what the model leaves, over all of the noise of each number, as if readings shared none of it.
    pub(crate) fn over_all_noise(self, campaign: &Campaign) -> (DMatrix<f64>, DVector<f64>) {
        sides(by_rows(self.own, &campaign.own_shares()))
    }

    /// Inputs that are known to a tolerance only.
    pub(crate) fn inexact(&self) -> Option<&Inexact> {
        self.whitening.inexact()
    }

    /// Sum of squared whitened residuals.
    pub(crate) fn lack_of_fit(&self) -> f64 {
        self.residuals().norm_squared()
    }

    /// What these readings tell of them after a fit that ends here.
    pub(crate) fn inputs_after_fit(&self) -> Option<InputsAfterFit> {
        self.whitening.inputs_after_fit(&self.own)
    }

    /// The same less a share of them, of readings whose inputs a fit has told of.
    pub(crate) fn without(mut self, share: &DMatrix<f64>, campaign: &Campaign) -> Self {
        self.own -= share;
        self.within(campaign)
    }

    /// True when errors of the readings are independent, but for inputs that are known to a tolerance only.
    pub(crate) fn noise_is_independent(&self) -> bool {
        self.whitening.noise_is_independent()
    }

    /// All of them, whitened, in triangular form.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`].
    pub(crate) fn triangle(&self) -> Result<Triangle, ModelError> {
        let mut triangle = Triangle::new(self.own.ncols() - 1);
        triangle.push_strips(self.own.nrows(), self.whitening.rows_of(&self.own))?;
        Ok(triangle)
    }
}

/// `A` and `y` of `[A y]`.
fn sides(all: DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let last = all.ncols() - 1;
    let residuals = all.column(last).into_owned();
    (all.remove_column(last), residuals)
}

/// A matrix with every row times a factor.
pub(crate) fn by_rows(mut columns: DMatrix<f64>, factors: &DVector<f64>) -> DMatrix<f64> {
    columns.column_iter_mut().for_each(|mut column| column.component_mul_assign(factors));
    columns
}
