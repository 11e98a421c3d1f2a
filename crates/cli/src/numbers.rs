//! Numbers of arguments, alone or with commas between.

use std::ops::RangeInclusive;

use hexbench_core::{Pose, Vector3, Wrench};
use hexbench_report::number::counted;

/// A finite number.
pub(crate) fn finite(text: &str) -> Result<f64, String> {
    let value = text.trim().parse().map_err(|_| format!("`{text}` is not a number"))?;
    if f64::is_finite(value) { Ok(value) } else { Err(format!("`{text}` is not finite")) }
}

/// A finite number that is positive.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    finite(text).and_then(|x| if x > 0.0 { Ok(x) } else { Err("this must be positive".into()) })
}

/// A finite number in a range; `words` say which.
pub(crate) fn within(text: &str, range: RangeInclusive<f64>, words: &str) -> Result<f64, String> {
    finite(text).and_then(|x| if range.contains(&x) { Ok(x) } else { Err(format!("this must be {words}")) })
}

/// So many numbers; `word` says how many, and `example` shows them.
fn several<const N: usize>(text: &str, word: &str, example: &str) -> Result<[f64; N], String> {
    let numbers: Vec<f64> = text.split(',').map(finite).collect::<Result<_, _>>()?;
    let given = counted(numbers.len(), "number");
    let refusal = format!("{given}; {word} with commas between are needed, for example {example}");
    numbers.try_into().map_err(|_| refusal)
}

/// Force (N) and moment (N m): `fx,fy,fz,mx,my,mz`.
pub(crate) fn wrench(text: &str) -> Result<Wrench, String> {
    several(text, "six", "0,0,-100,5,0,0 (N, N m)").map(Wrench::from_array)
}

/// `a,b,c,alpha,beta,gamma` in mm and deg.
pub(crate) fn pose(text: &str) -> Result<Pose, String> {
    let [a, b, c, x, y, z] = several(text, "six", "0,0,10,0,2.5,0 (mm, deg)")?;
    let [a, b, c] = [a, b, c].map(|mm| mm * 1e-3);
    let [x, y, z] = [x, y, z].map(f64::to_radians);
    Ok(Pose::from_array([a, b, c, x, y, z]))
}

/// `x,y,z` in mm.
pub(crate) fn point(text: &str) -> Result<Vector3, String> {
    const FARTHEST_MM: f64 = 1e5;
    let mm: [f64; 3] = several(text, "three", "0,0,120 (mm)")?;
    if mm.iter().any(|x| x.abs() > FARTHEST_MM) {
        return Err(format!("a point of the platform is at most {FARTHEST_MM} mm from its origin"));
    }
    Ok(Vector3::from(mm) * 1e-3)
}
