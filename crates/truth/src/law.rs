//! The law of one leg: which elongation goes with which force, and what it remembers.
//!
//! ```text
//! e(f) = offset + C(q + e) s + c_t max(f, 0) + sum kappa sgn(f) |f|^p + (gap / 2) sgn(f) + sum (gap / 2) tanh(f / width) + formulas
//! C(q) = c + sum of what grows with, or varies along, the length
//! s    = the share of f that the spring C carries; a dry slider beside it takes the rest, at most f_c
//! ```
//!
//! Until it gives way the slider is an elastic bristle, `rho` times as stiff as the leg spring (play operator for an
//! infinite `rho`; in general the Prandtl element of plasticity).
//!
//! Some of these are not functions of the force (play), others not of the elongation (a stuck slider), but all are monotone.
//! A leg without force may rest anywhere within its play; the unloaded machine is taken to rest in the middle.
//!
//! A monotone law is a function of `z = f + k e` (Minty), with both `f(z)` and `e(z)` continuous and rising at most as
//! fast as `z`; so `z` is the unknown of the equilibrium.

use crate::own_law::OwnElongation;

/// Elongation law of one leg. SI units; tension and lengthening positive.
#[derive(Debug, Clone, PartialEq)]
pub struct LegLaw {
    /// Compliance `c` of the leg spring, m/N.
    pub compliance: f64,
    /// Leg length without force, m.
    pub length: f64,
    /// What adds to the compliance, depending on the present leg length.
    pub along_length: Vec<LengthCompliance>,
    /// Force `f_c` up to which the slider beside the spring holds, N.
    pub slider_force: f64,
    /// Stiffness `rho` of the slider while it holds, over that of the leg spring.
    pub slider_ratio: f64,
    /// Further compliance under tension `c_t`, m/N.
    pub tension_compliance: f64,
    /// Contacts in series: `(kappa, p)`, m/N^p.
    pub powers: Vec<(f64, f64)>,
    /// Whole width of the play, m.
    pub gap: f64,
    /// Plays whose contact closes gradually: `(gap, width)`, m and N.
    pub soft_gaps: Vec<(f64, f64)>,
    /// Elongation without force, m.
    pub offset: f64,
    /// Elongations that scenes state as formulas.
    pub own: Vec<OwnElongation>,
}

/// A compliance that depends on the present length q of the leg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LengthCompliance {
    /// `slope (q - home)`.
    Growing {
        /// Compliance per length, 1/N.
        slope: f64,
        /// Length at which it vanishes, m.
        home: f64,
    },
    /// `amplitude sin(2 pi q / pitch)`.
    Periodic {
        /// Amplitude, m/N.
        amplitude: f64,
        /// Period, m.
        pitch: f64,
    },
}

impl LengthCompliance {
    /// Value (m/N) and derivative (1/N) at a length (m).
    fn at(&self, q: f64) -> (f64, f64) {
        match *self {
            Self::Growing { slope, home } => (slope * (q - home), slope),
            Self::Periodic { amplitude, pitch } => {
                let per_length = std::f64::consts::TAU / pitch;
                let (sine, cosine) = (per_length * q).sin_cos();
                (amplitude * sine, amplitude * per_length * cosine)
            }
        }
    }
}

/// What a leg remembers of its last state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LegMemory {
    /// Leg force, N.
    pub force: f64,
    /// Share of it in the leg spring, N.
    pub spring_force: f64,
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
            length: 0.0,
            along_length: Vec::new(),
            slider_force: 0.0,
            slider_ratio: f64::INFINITY,
            tension_compliance: 0.0,
            powers: Vec::new(),
            gap: 0.0,
            soft_gaps: Vec::new(),
            offset: 0.0,
            own: Vec::new(),
        }
    }

    /// Compliance of the spring at the commanded length, with what depends on the length, m/N.
    pub fn compliance_at_length(&self) -> f64 {
        self.along_length.iter().fold(self.compliance, |sum, c| sum + c.at(self.length).0)
    }

    /// Force in the leg spring when the leg carries `force`, N.
    pub fn spring_force(&self, force: f64, before: LegMemory) -> f64 {
        self.share_of_spring(force, before).0
    }

    /// Spring force and its slope along the leg force.
    fn share_of_spring(&self, force: f64, before: LegMemory) -> (f64, f64) {
        let slope = 1.0 / (1.0 + self.slider_ratio);
        let held = before.spring_force + slope * (force - before.force);
        let (low, high) = (force - self.slider_force, force + self.slider_force);
        if held > low && held < high { (held, slope) } else { (held.max(low).min(high), 1.0) }
    }

    /// Point with `f + k e = z` for the reference stiffness `k` (N/m) and what the leg remembers.
    pub fn at(&self, z: f64, k: f64, before: LegMemory) -> LawPoint {
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

    /// Parameter `z = f + k e(f)` of the point with the given force (N); without force, of the middle of the play.
    pub fn parameter(&self, force: f64, k: f64, before: LegMemory) -> f64 {
        // Zero has a sign of its own, which says nothing about the side of the play.
        let side = if force == 0.0 { 0.0 } else { force.signum() };
        force + k * (self.smooth(force, before).0 + 0.5 * self.gap * side)
    }

    /// Root of `f + k g(f) = target` between zero and `far`, where `g` is the law without play.
    fn force_for(&self, target: f64, far: f64, k: f64, before: LegMemory) -> f64 {
        let (mut low, mut high) = if far < 0.0 { (far, 0.0) } else { (0.0, far) };
        let mut f = far / (1.0 + k * (self.compliance + self.tension_compliance));
        for _ in 0..MOST_ITERATIONS {
            let (g, slope) = self.smooth(f, before);
            let excess = f + k * g - target;
            if excess > 0.0 {
                high = f;
            } else {
                low = f;
            }
            let step = excess / (1.0 + k * slope);
            let newton = f - step;
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            if (next - f).abs() <= 2.0 * f64::EPSILON * target.abs() {
                return next;
            }
            f = next;
        }
        f
    }

    /// The law without play and its slope at a force.
    fn smooth(&self, f: f64, before: LegMemory) -> (f64, f64) {
        let (spring, spring_slope) = self.share_of_spring(f, before);
        let (mut others, mut others_slope) = (self.offset, 0.0);
        if f > 0.0 {
            others += self.tension_compliance * f;
            others_slope += self.tension_compliance;
        }
        for &(kappa, p) in &self.powers {
            let magnitude = f.abs();
            others += kappa * f.signum() * magnitude.powf(p);
            others_slope += kappa * p * magnitude.powf(p - 1.0);
        }
        for own in &self.own {
            let (elongation, slope) = own.at(f);
            others += elongation;
            others_slope += slope;
        }
        for &(gap, width) in &self.soft_gaps {
            let closed = (f / width).tanh();
            others += 0.5 * gap * closed;
            others_slope += 0.5 * gap / width * (1.0 - closed * closed);
        }
        let plain = others + self.compliance * spring;
        if self.along_length.is_empty() {
            return (plain, others_slope + self.compliance * spring_slope);
        }
        self.along(plain, spring, others_slope, spring_slope)
    }

    /// Solves `e = plain + C'(q + e) spring` for the compliances along the length. Each pass multiplies the error by force times
    /// change of compliance per length, 0.01 at most on a usable machine.
    fn along(&self, plain: f64, spring: f64, others_slope: f64, spring_slope: f64) -> (f64, f64) {
        const PASSES: usize = 8;
        let at = |e: f64| {
            self.along_length
                .iter()
                .map(|c| c.at(self.length + e))
                .fold((0.0, 0.0), |s, c| (s.0 + c.0, s.1 + c.1))
        };
        let elongation = (0..PASSES).fold(plain, |e, _| plain + at(e).0 * spring);
        let (extra, growth) = at(elongation);
        let slope = (others_slope + (self.compliance + extra) * spring_slope) / (1.0 - growth * spring);
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
            slider_ratio: 20.0,
            length: 0.2,
            along_length: vec![
                LengthCompliance::Growing { slope: 4e-7, home: 0.19 },
                LengthCompliance::Periodic { amplitude: 1e-8, pitch: 8e-3 },
            ],
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
            let (z, before) = (f64::from(step) * 1.7, LegMemory { force: 12.0, spring_force: 11.0 });
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
    fn an_unloaded_leg_with_play_rests_in_the_middle_whatever_the_sign_of_its_zero_force() {
        let law = LegLaw { gap: 4e-6, ..LegLaw::spring(2.5e-7) };
        for zero in [0.0, -0.0] {
            let z = law.parameter(zero, K, LegMemory::default());
            assert!(law.at(z, K, LegMemory::default()).elongation.abs() < 1e-20, "zero force {zero:?}");
        }
    }

    #[test]
    fn slopes_agree_with_differences() {
        let law = rich();
        for z in [-300.0, -20.0, 40.0, 77.0, 300.0] {
            let (h, before) = (1e-4, LegMemory { force: -7.0, spring_force: -8.0 });
            let (plus, minus) = (law.at(z + h, K, before), law.at(z - h, K, before));
            let point = law.at(z, K, before);
            assert!(((plus.force - minus.force) / (2.0 * h) - point.force_slope).abs() < 1e-6, "z = {z}");
        }
    }

    #[test]
    fn a_friction_loop_closes_and_has_the_area_of_its_parallelogram() {
        let law = LegLaw { slider_force: 3.0, ..LegLaw::spring(2.5e-7) };
        let (mut before, mut area, mut last) = (LegMemory::default(), 0.0, (0.0, 0.0));
        let path = (0..=400).map(|i| 100.0 * (f64::from(i) * std::f64::consts::TAU / 200.0).sin());
        for (i, force) in path.enumerate() {
            before = LegMemory { force, spring_force: law.spring_force(force, before) };
            let now = (force, law.compliance * before.spring_force);
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
