//! The force of a leg at a given elongation: the leg law read the other way round.
//!
//! ```text
//! e - offset = C(length + e) s(f) + c_t max(f, 0) + sum kappa sgn(f) |f|^p + (gap / 2) sgn(f) + sum (gap / 2) tanh(f / width)
//! ```
//!
//! A dynamics engine knows where the bodies are and asks for forces. At a given elongation the compliance `C` is a number,
//! and the rest a monotone function of the force with a jump at zero.

use hexbench_truth::{LegLaw, LegMemory, law::LengthCompliance};

/// Halvings of the bracket before giving up; Newton's steps need about five.
const MOST_ITERATIONS: usize = 200;

/// Force (N, tension positive) of a leg stretched by `elongation` (m), given what it remembers.
pub fn tension(law: &LegLaw, elongation: f64, before: LegMemory) -> f64 {
    let compliance = law.compliance + along_length(law, elongation);
    let target = elongation - law.offset;
    let at_rest = compliance * held(law, 0.0, before).0;
    let play = 0.5 * law.gap;
    if (target - at_rest).abs() <= play {
        return 0.0;
    }
    let side = (target - at_rest).signum();
    root(law, compliance, target - side * play, side, before)
}

/// Stiffness that a leg never exceeds by much, N/m: of its spring, together with a slider that holds.
pub fn stiffest(law: &LegLaw) -> f64 {
    let holding = if law.slider_force == 0.0 { 0.0 } else { law.slider_ratio };
    (1.0 + holding) / law.compliance
}

/// What the compliance gains along the length, m/N.
fn along_length(law: &LegLaw, elongation: f64) -> f64 {
    let q = law.length + elongation;
    let gain = |c: &LengthCompliance| match *c {
        LengthCompliance::Growing { slope, home } => slope * (q - home),
        LengthCompliance::Periodic { amplitude, pitch } => {
            amplitude * (std::f64::consts::TAU * q / pitch).sin()
        }
    };
    law.along_length.iter().map(gain).sum()
}

/// Share of the force in the leg spring, and its slope: the slider follows as a bristle until it gives way.
pub fn held(law: &LegLaw, force: f64, before: LegMemory) -> (f64, f64) {
    if law.slider_force == 0.0 {
        return (force, 1.0);
    }
    let share = 1.0 / (1.0 + law.slider_ratio);
    let slider = (before.force - before.spring_force) + (1.0 - share) * (force - before.force);
    if slider.abs() < law.slider_force {
        (force - slider, share)
    } else {
        (force - slider.signum() * law.slider_force, 1.0)
    }
}

/// Elongation without offset and play, and its slope.
fn stretch(law: &LegLaw, compliance: f64, force: f64, before: LegMemory) -> (f64, f64) {
    let (spring, share) = held(law, force, before);
    let (mut e, mut slope) = (compliance * spring, compliance * share);
    if force > 0.0 {
        e += law.tension_compliance * force;
        slope += law.tension_compliance;
    }
    for &(kappa, p) in &law.powers {
        e += kappa * force.signum() * force.abs().powf(p);
        slope += kappa * p * force.abs().powf(p - 1.0);
    }
    for &(gap, width) in &law.soft_gaps {
        let cosh = (force / width).cosh();
        e += 0.5 * gap * (force / width).tanh();
        slope += 0.5 * gap / (width * cosh * cosh);
    }
    (e, slope)
}

/// Root on one side of zero: the bracket is doubled outwards, then Newton's steps are kept inside it.
fn root(law: &LegLaw, compliance: f64, target: f64, side: f64, before: LegMemory) -> f64 {
    let excess = |f: f64| side * (stretch(law, compliance, f, before).0 - target);
    let mut far = side * (target / compliance).abs().max(f64::MIN_POSITIVE);
    let mut near = 0.0;
    for _ in 0..MOST_ITERATIONS {
        if excess(far) >= 0.0 {
            break;
        }
        (near, far) = (far, 2.0 * far);
    }
    let mut f = 0.5 * (near + far);
    for _ in 0..MOST_ITERATIONS {
        let (e, slope) = stretch(law, compliance, f, before);
        if side * (e - target) > 0.0 {
            far = f;
        } else {
            near = f;
        }
        let newton = f - (e - target) / slope;
        let inside = (newton - near) * (newton - far) <= 0.0;
        let next = if inside { newton } else { 0.5 * (near + far) };
        if (next - f).abs() <= 2.0 * f64::EPSILON * f.abs() {
            return next;
        }
        f = next;
    }
    f
}
