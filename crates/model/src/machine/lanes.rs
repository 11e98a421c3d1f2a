//! Four poses abreast: rotation, rows of the leg Jacobian, solution of symmetric systems.

use hexbench_core::Vector3;
use wide::f64x4;

/// Poses handled side by side.
pub(crate) const LANES: usize = 4;

/// A point or direction of four poses.
pub(crate) type Point = [f64x4; 3];
/// Six numbers of four poses.
pub(crate) type Six = [f64x4; 6];
/// A 6x6 matrix of four poses, rows.
pub(crate) type Matrix = [Six; 6];

/// `Rz(gamma) Ry(beta) Rx(alpha)`, rows.
#[inline]
pub(crate) fn rotation(angles: &Point) -> [Point; 3] {
    let [(sa, ca), (sb, cb), (sg, cg)] = angles.map(f64x4::sin_cos);
    [
        [cg * cb, cg * sb * sa - sg * ca, cg * sb * ca + sg * sa],
        [sg * cb, sg * sb * sa + cg * ca, sg * sb * ca - cg * sa],
        [-sb, cb * sa, cb * ca],
    ]
}

/// The same point in every lane.
#[inline]
pub(crate) fn splat(point: &Vector3) -> Point {
    [f64x4::splat(point.x), f64x4::splat(point.y), f64x4::splat(point.z)]
}

/// `[n', (R B x n)']` of a leg from base joint `a` to platform joint `b`.
#[inline]
pub(crate) fn jacobian_row(a: &Point, b: &Point, translation: &Point, rotation: &[Point; 3]) -> Six {
    let arm: Point =
        std::array::from_fn(|i| rotation[i][0] * b[0] + rotation[i][1] * b[1] + rotation[i][2] * b[2]);
    let span: Point = std::array::from_fn(|i| translation[i] + arm[i] - a[i]);
    let length = (span[0] * span[0] + span[1] * span[1] + span[2] * span[2]).sqrt();
    let inverse = f64x4::ONE / length;
    let n = span.map(|s| s * inverse);
    [
        n[0],
        n[1],
        n[2],
        arm[1] * n[2] - arm[2] * n[1],
        arm[2] * n[0] - arm[0] * n[2],
        arm[0] * n[1] - arm[1] * n[0],
    ]
}

/// Adds `weight row row'` to the lower triangle of a symmetric matrix.
#[inline]
pub(crate) fn add_square(matrix: &mut Matrix, row: &Six, weight: f64x4) {
    for i in 0..6 {
        let scaled = row[i] * weight;
        for j in 0..=i {
            matrix[i][j] = scaled.mul_add(row[j], matrix[i][j]);
        }
    }
}

/// Cholesky factor of a symmetric positive definite matrix given by its lower triangle; the diagonal is stored inverted.
#[inline]
pub(crate) fn factor(mut a: Matrix) -> Matrix {
    for j in 0..6 {
        for k in 0..j {
            for i in j..6 {
                a[i][j] -= a[i][k] * a[j][k];
            }
        }
        let inverse = f64x4::ONE / a[j][j].sqrt();
        for i in j + 1..6 {
            a[i][j] *= inverse;
        }
        a[j][j] = inverse;
    }
    a
}

/// Solution of `A x = b` with the factor of `A`.
#[inline]
pub(crate) fn substitute(factor: &Matrix, mut b: Six) -> Six {
    for j in 0..6 {
        for k in 0..j {
            b[j] -= factor[j][k] * b[k];
        }
        b[j] *= factor[j][j];
    }
    for j in (0..6).rev() {
        for k in j + 1..6 {
            b[j] -= factor[k][j] * b[k];
        }
        b[j] *= factor[j][j];
    }
    b
}

/// Lower triangle of the inverse of `A` from its factor.
#[inline]
pub(crate) fn inverse(factor: &Matrix) -> Matrix {
    let mut lower = *factor;
    for j in 0..6 {
        for i in j + 1..6 {
            let mut sum = f64x4::ZERO;
            for k in j..i {
                sum += factor[i][k] * lower[k][j];
            }
            lower[i][j] = -sum * factor[i][i];
        }
    }
    let mut inverse = [[f64x4::ZERO; 6]; 6];
    for i in 0..6 {
        for j in 0..=i {
            for k in i..6 {
                inverse[i][j] += lower[k][i] * lower[k][j];
            }
        }
    }
    inverse
}

/// Scalar product.
#[inline]
pub(crate) fn dot(a: &Six, b: &Six) -> f64x4 {
    let mut sum = a[0] * b[0];
    for k in 1..6 {
        sum += a[k] * b[k];
    }
    sum
}
