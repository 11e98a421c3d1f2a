//! Masses, damping and time steps: what a static structure does not know.

use hexbench_core::{Matrix3, Matrix6, Vector3};

/// Mass of a body and its inertia about its own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    /// Mass, kg.
    pub mass: f64,
    /// Principal moments about the origin of the body, along its axes, kg m^2.
    pub principal: [f64; 3],
}

impl Inertia {
    /// A uniform disc about its axis z'.
    pub fn disc(mass: f64, radius: f64) -> Self {
        let across = 0.25 * mass * radius.powi(2);
        Self { mass, principal: [across, across, 2.0 * across] }
    }

    /// The same body, heavier by a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { mass: self.mass * factor, principal: self.principal.map(|x| x * factor) }
    }

    /// Mass matrix about the origin of the body, for its axes in the fixed frame.
    pub fn matrix(&self, axes: &Matrix3) -> Matrix6 {
        let mut matrix = Matrix6::identity() * self.mass;
        let turning = axes * Matrix3::from_diagonal(&Vector3::from(self.principal)) * axes.transpose();
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&turning);
        matrix
    }
}

/// Masses and damping of the bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dynamics {
    /// The body that the legs hold.
    pub plate: Inertia,
    /// The loaded platform, where the plate yields.
    pub loaded: Inertia,
    /// The base, where it yields.
    pub base: Inertia,
    /// Mass of half a leg, kg.
    pub half_leg: f64,
    /// Damping of a spring per stiffness, s.
    pub per_stiffness: f64,
    /// Damping of a body per mass, 1/s.
    pub per_mass: f64,
}

/// How the engine steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    /// Time step, s.
    pub dt: f64,
    /// Sweeps over the joints in a step.
    pub sweeps: usize,
}

impl Stepping {
    /// Damping (N s/m) to ask of a motor whose spring of stiffness `k` (N/m) shall be damped by `damping`.
    ///
    /// A motor takes its spring at the end of the step, which damps it by `k dt` more than told.
    pub fn motor_damping(&self, k: f64, damping: f64) -> f64 {
        damping - k * self.dt
    }
}
