//! Arrays of numbers for Python.

use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray2, PyArray3};
use pyo3::prelude::*;

/// A row and a matrix of every condition.
pub(crate) type TwoArrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray3<f64>>);

/// An array of shape (n, N).
pub(crate) fn rows<const N: usize>(
    py: Python<'_>,
    rows: impl ExactSizeIterator<Item = [f64; N]>,
) -> Bound<'_, PyArray2<f64>> {
    let mut array = Array2::zeros((rows.len(), N));
    for (mut to, from) in array.rows_mut().into_iter().zip(rows) {
        to.iter_mut().zip(from).for_each(|(to, from)| *to = from);
    }
    array.into_pyarray(py)
}

/// An array of shape (n, m, m).
pub(crate) fn matrices(
    py: Python<'_>,
    [count, size]: [usize; 2],
    element: impl Fn(usize, usize, usize) -> f64,
) -> Bound<'_, PyArray3<f64>> {
    Array3::from_shape_fn((count, size, size), |(n, i, j)| element(n, i, j)).into_pyarray(py)
}

/// A square array.
pub(crate) fn matrix<'py>(py: Python<'py>, matrix: &nalgebra::DMatrix<f64>) -> Bound<'py, PyArray2<f64>> {
    Array2::from_shape_fn(matrix.shape(), |at| matrix[at]).into_pyarray(py)
}
