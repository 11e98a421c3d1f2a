//! The law of one leg: which elongation goes with which force, and what it remembers.
//!
//! ```text
//! e(f) = offset + c s + c_t max(f, 0) + sum kappa sgn(f) |f|^p + (gap / 2) sgn(f)
//! s    = f, held within +-f_c of it by a dry slider beside the spring c (play operator)
//! ```
//!
//! Some of these are not functions of the force (play), others not of the elongation (a stuck slider), but all are monotone.
//! A monotone law is a function of `z = f + k e` (Minty), with both `f(z)` and `e(z)` continuous and rising at most as
//! fast as `z`; so `z` is the unknown of the equilibrium.

/// Elongation law of one leg. SI units; tension and lengthening positive.
#[derive(Debug, Clone, PartialEq)]
pub struct LegLaw {
    /// Compliance `c` of the leg spring, m/N.
    pub compliance: f64,
    /// Force `f_c` up to which the slider beside the spring holds, N.
    pub slider_force: f64,
    /// Further compliance under tension `c_t`, m/N.
    pub tension_compliance: f64,
    /// Contacts in series: `(kappa, p)`, m/N^p.
    pub powers: Vec<(f64, f64)>,
    /// Whole width of the play, m.
    pub gap: f64,
    /// Elongation without force, m.
    pub offset: f64,
}

/// A point on the law: force, elongation and their slopes along the parameter `z`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LawPoint {
    /// Leg force, N.
    pub force: f64,
    /// Elongation, m.
    pub elongation: f64,
    /// `df/dz`, from 0 to 1.
    pub force_slope: f64,
    /// `de/dz`, m/N.
    pub elongation_slope: f64,
}

impl LawPoint {
    /// A point from the slope `de/df` (m/N) and the reference stiffness `k` (N/m).
    ///
    /// Inside the play the true slopes are 0 and 1/k; those of the adjoining branch are kept instead, because six legs
    /// carry six loads: with one leg force frozen Newton's equations have no solution, while a step along the branch
    /// leaves the play and arrives.
    fn new(force: f64, elongation: f64, slope: f64, k: f64) -> Self {
        let force_slope = 1.0 / (1.0 + k * slope);
        Self { force, elongation, force_slope, elongation_slope: (1.0 - force_slope) / k }
    }
}

/// Iterations of the scalar solve; bisection alone needs about 60.
const MOST_ITERATIONS: usize = 100;

impl LegLaw {
    /// A plain spring of the given compliance (m/N).
    pub fn spring(compliance: f64) -> Self {
        Self {
            compliance,
            slider_force: 0.0,
            tension_compliance: 0.0,
            powers: Vec::new(),
            gap: 0.0,
            offset: 0.0,
        }
    }

    /// Force in the leg spring when the leg carries `force` and the spring carried `before` in the last state, N.
    pub fn spring_force(&self, force: f64, before: f64) -> f64 {
        before.clamp(force - self.slider_force, force + self.slider_force)
    }

    /// Point with `f + k e = z` for the reference stiffness `k` (N/m) and the spring force of the last state, N.
    pub fn at(&self, z: f64, k: f64, before: f64) -> LawPoint {
        let (at_zero, slope_at_zero) = self.smooth(0.0, before);
        let from_zero = z - k * at_zero;
        let play = k * self.gap * 0.5;
        if from_zero.abs() <= play {
            return LawPoint::new(0.0, z / k, slope_at_zero, k);
        }
        let side = from_zero.signum();
        let force = self.force_for(z - side * play, from_zero - side * play, k, before);
        let (_, slope) = self.smooth(force, before);
        LawPoint::new(force, (z - force) / k, slope, k)
    }

    /// Parameter `z = f + k e(f)` of the point with the given force (N).
    pub fn parameter(&self, force: f64, k: f64, before: f64) -> f64 {
        force + k * (self.smooth(force, before).0 + 0.5 * self.gap * force.signum())
    }

    /// Root of `f + k g(f) = target` between zero and `far`, where `g` is the law without play.
    fn force_for(&self, target: f64, far: f64, k: f64, before: f64) -> f64 {
        let (mut low, mut high) = if far < 0.0 { (far, 0.0) } else { (0.0, far) };
        let mut f = far / (1.0 + k * (self.compliance + self.tension_compliance));
        for _ in 0..MOST_ITERATIONS {
            let (g, slope) = self.smooth(f, before);
            let excess = f + k * g - target;
            if excess > 0.0 {
                high = f
            } else {
                low = f
            }
            let step = excess / (1.0 + k * slope);
            let newton = f - step;
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            if (next - f).abs() <= f64::EPSILON * target.abs() || next == f {
                return next;
            }
            f = next;
        }
        f
    }

    /// The law without play and its slope at a force.
    fn smooth(&self, f: f64, before: f64) -> (f64, f64) {
        let s = self.spring_force(f, before);
        let sliding = self.slider_force == 0.0 || (s - before).abs() > 0.0;
        let mut elongation = self.offset + self.compliance * s;
        let mut slope = if sliding { self.compliance } else { 0.0 };
        if f > 0.0 {
            elongation += self.tension_compliance * f;
            slope += self.tension_compliance;
        }
        for &(kappa, p) in &self.powers {
            let magnitude = f.abs();
            elongation += kappa * f.signum() * magnitude.powf(p);
            slope += kappa * p * magnitude.powf(p - 1.0);
        }
        (elongation, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const K: f64 = 4e6;

    fn rich() -> LegLaw {
        LegLaw {
            slider_force: 3.0,
            tension_compliance: 2e-8,
            powers: vec![(3e-7, 2.0 / 3.0), (1e-10, 2.0)],
            gap: 4e-6,
            offset: 1e-6,
            ..LegLaw::spring(2.5e-7)
        }
    }

    #[test]
    fn the_law_passes_through_its_own_points() {
        let law = rich();
        for step in -200..=200 {
            let (z, before) = (f64::from(step) * 1.7, 11.0);
            let point = law.at(z, K, before);
            assert!((point.force + K * point.elongation - z).abs() < 1e-10 * (1.0 + z.abs()));
            if point.force != 0.0 {
                let (g, _) = law.smooth(point.force, before);
                let play = law.gap * 0.5 * point.force.signum();
                assert!((g + play - point.elongation).abs() < 1e-16, "z = {z}");
            }
        }
    }

    #[test]
    fn slopes_agree_with_differences() {
        let law = rich();
        for z in [-300.0, -20.0, 40.0, 77.0, 300.0] {
            let (h, before) = (1e-4, -8.0);
            let (plus, minus) = (law.at(z + h, K, before), law.at(z - h, K, before));
            let point = law.at(z, K, before);
            assert!(((plus.force - minus.force) / (2.0 * h) - point.force_slope).abs() < 1e-6, "z = {z}");
        }
    }

    #[test]
    fn a_friction_loop_closes_and_has_the_area_of_its_parallelogram() {
        let law = LegLaw { slider_force: 3.0, ..LegLaw::spring(2.5e-7) };
        let (mut before, mut area, mut last) = (0.0, 0.0, (0.0, 0.0));
        let path = (0..=400).map(|i| 100.0 * (f64::from(i) * std::f64::consts::TAU / 200.0).sin());
        for (i, force) in path.enumerate() {
            before = law.spring_force(force, before);
            let now = (force, law.compliance * before);
            if i > 200 {
                area += 0.5 * (now.0 + last.0) * (now.1 - last.1);
            }
            last = now;
        }
        // The spring's force swings between -97 and 97 N while the slider takes 3 N either way.
        let parallelogram = 2.0 * 3.0 * law.compliance * 2.0 * 97.0;
        assert!((area - parallelogram).abs() < 1e-3 * parallelogram, "{area} {parallelogram}");
    }
}
