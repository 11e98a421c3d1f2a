//! Numbers of arguments, with commas between.

use hexbench_core::{Pose, Vector3, Wrench};

/// A finite number.
pub(crate) fn finite(text: &str) -> Result<f64, String> {
    let value = text.trim().parse().map_err(|_| format!("`{text}` is not a number"))?;
    if f64::is_finite(value) { Ok(value) } else { Err(format!("`{text}` is not finite")) }
}

/// So many numbers.
fn several<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Vec<f64> = text.split(',').map(finite).collect::<Result<_, _>>()?;
    let count = numbers.len();
    numbers.try_into().map_err(|_| format!("{count} numbers; {N} with commas between are needed"))
}

/// Force (N) and moment (N m): `fx,fy,fz,mx,my,mz`.
pub(crate) fn wrench(text: &str) -> Result<Wrench, String> {
    several(text).map(Wrench::from_array)
}

/// `a,b,c,alpha,beta,gamma` in mm and deg.
pub(crate) fn pose(text: &str) -> Result<Pose, String> {
    let [a, b, c, x, y, z] = several(text)?;
    let [a, b, c] = [a, b, c].map(|mm| mm * 1e-3);
    let [x, y, z] = [x, y, z].map(f64::to_radians);
    Ok(Pose::from_array([a, b, c, x, y, z]))
}

/// `x,y,z` in mm.
pub(crate) fn point(text: &str) -> Result<Vector3, String> {
    several(text).map(|mm: [f64; 3]| Vector3::from(mm) * 1e-3)
}
