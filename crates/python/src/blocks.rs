//! What an identification is built of: legs, regressor, signatures of effects; each over many poses at once.

use std::sync::Arc;

use hexbench_app::{Failure, input};
use hexbench_core::{Dataset, Hexapod, Measurand, Observation, Vector6};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit_named::term_named;
use hexbench_model::estimation::linearization::{Linearization, ModelPoint};
use hexbench_model::estimation::noise::Noise;
use hexbench_model::estimation::paper::block;
use hexbench_model::machine::kinematics::Legs;
use nalgebra::DMatrix;
use numpy::{PyArray2, PyArray3};
use pyo3::prelude::*;

use crate::arrays::{TwoArrays, matrices, matrix, rows};
use crate::campaign::conditions;
use crate::machine::PyHexapod;
use crate::own_term::{OwnTerm, own_terms};
use crate::run::beside;

/// The failure of a row in memory, from 0.
pub(crate) fn of_row(row: u64, cause: ModelError) -> Failure {
    Failure::MemoryRow { table: "poses".into(), row, cause: Box::new(cause) }
}

/// Something of every row of a table of conditions.
fn of_each<T: Send + 'static>(
    py: Python<'_>,
    hexapod: &PyHexapod,
    names: Vec<String>,
    columns: &[Bound<'_, PyAny>],
    of: impl Fn(&Hexapod, &Observation) -> Result<T, ModelError> + Send + 'static,
) -> PyResult<Vec<T>> {
    let data = conditions(py, names, columns, "poses")?;
    let machine = Arc::clone(&hexapod.0);
    beside(py, move || {
        let at = |(row, condition)| of(&machine.hexapod, condition).map_err(|cause| of_row(row, cause));
        (0..).zip(&data.observations).map(at).collect()
    })
}

/// Leg lengths in m (n, 6), geometric leg Jacobians (n, 6, 6), SI.
#[pyfunction]
pub(crate) fn legs<'py>(
    py: Python<'py>,
    hexapod: &PyHexapod,
    names: Vec<String>,
    columns: Vec<Bound<'py, PyAny>>,
) -> PyResult<TwoArrays<'py>> {
    let found = of_each(py, hexapod, names, &columns, |hexapod, row| {
        Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &row.pose)
    })?;
    let lengths = rows(py, found.iter().map(|legs| legs.lengths.into()));
    Ok((lengths, matrices(py, [found.len(), 6], |n, i, j| found[n].leg_jacobian[(i, j)])))
}

/// Blocks (n, 6, 6) of the regressor of the paper, SI.
#[pyfunction]
pub(crate) fn regressor<'py>(
    py: Python<'py>,
    hexapod: &PyHexapod,
    names: Vec<String>,
    columns: Vec<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let found = of_each(py, hexapod, names, &columns, |hexapod, row| {
        block(hexapod, row, Measurand::DeflectionEuler)
    })?;
    Ok(matrices(py, [found.len(), 6], |n, i, j| found[n][(i, j)]))
}

/// What a unit of every parameter of a term adds to the readings: rows 6 n, um and urad; names with units of the parameters; the shape.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "an array and its names")]
#[expect(clippy::too_many_arguments, reason = "arguments from Python")]
pub(crate) fn signatures<'py>(
    py: Python<'py>,
    hexapod: &PyHexapod,
    names: Vec<String>,
    columns: Vec<Bound<'py, PyAny>>,
    term: String,
    own: Vec<OwnTerm>,
    shape: Option<f64>,
    compliances: [f64; 6],
) -> PyResult<(Bound<'py, PyArray2<f64>>, Vec<(String, String)>, Option<f64>)> {
    let data = conditions(py, names, &columns, "poses")?;
    let machine = Arc::clone(&hexapod.0);
    let (columns, named, shape) = beside(py, move || {
        let all = input::catalogue_with(&own_terms(&own)?);
        let failed = Failure::of_model("poses");
        let term = term_named(&term, &all).map_err(failed)?;
        // Readings of um and urad weigh one; each row stands alone, so that repeats stay rows.
        let linearized = |row: &[Observation], at: u64| {
            let alone = Dataset { observations: row.to_vec(), ..data.clone() };
            let campaign = Campaign::with_noise(&machine.hexapod, &alone, Noise::stated(1e-6, 1e-6));
            let campaign = campaign.map_err(|cause| of_row(at, cause))?;
            let point =
                ModelPoint { compliances: Vector6::from(compliances) * 1e-6, ..ModelPoint::start(&campaign) };
            Linearization::at(&campaign, &point).map_err(|cause| of_row(at, cause))
        };
        let each = (0..).zip(data.observations.chunks(1)).map(|(at, row)| linearized(row, at));
        let each = each.collect::<Result<Vec<_>, _>>()?;
        let conditions: Vec<_> = each.iter().flat_map(|lin| lin.conditions.iter().cloned()).collect();
        let info = term.info();
        let grid = term.shape_grid(&conditions);
        let si = info.shape.and_then(|known| {
            shape.map(|shown| shown / known.per_si).or_else(|| grid.get(grid.len() / 2).copied())
        });
        let blocks: Vec<DMatrix<f64>> =
            each.iter().map(|lin| lin.term_block(term.as_ref(), false, si.unwrap_or(1.0))).collect();
        let per_unit = |column: usize| info.parameters[column].per_si.recip();
        let wide = info.parameters.len();
        let all = DMatrix::from_fn(6 * blocks.len(), wide, |i, j| blocks[i / 6][(i % 6, j)] * per_unit(j));
        let named = info.parameters.iter().map(|p| (p.name.to_owned(), p.unit.to_owned())).collect();
        let shown = info.shape.zip(si).map(|(known, si)| si * known.per_si);
        Ok((all, named, shown))
    })?;
    Ok((matrix(py, &columns), named, shape))
}
