//! What of the structure MJCF can express, as numbers; anything else is refused here.

use hexbench_core::{Matrix6, Vector3};

use super::inexpressible;
use crate::{LegLaw, Setup, TruthError, equilibrium::Body, setup::Cable};

/// Weight of a kilogram, N; along -z.
pub(super) const GRAVITY_M_PER_S2: f64 = 9.81;

/// One leg at the commanded pose. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LegPart {
    /// Number, from 1.
    pub number: usize,
    /// Base joint relative to the base center, fixed axes.
    pub base_joint: Vector3,
    /// Platform joint, mobile frame.
    pub platform_joint: Vector3,
    /// Direction from base to platform joint, fixed axes, unit length.
    pub direction: Vector3,
    /// Distance of the joints.
    pub length: f64,
    /// Length without force minus that distance.
    pub relaxed: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Mass, kg; none: weightless.
    pub mass: Option<f64>,
}

/// A body on springs: stiffness along and about three axes, none where it is rigid. N/m, N m/rad.
pub(super) type Springs = [Option<f64>; 6];

/// The structure at the commanded pose.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Parts {
    /// The legs.
    pub legs: [LegPart; 6],
    /// Center at which the base yields, fixed frame, m.
    pub base_centre: Vector3,
    /// What the base rests on, none: rigid.
    pub base: Option<Springs>,
    /// What is between plate and loaded platform, none: rigid.
    pub plate: Option<Springs>,
    /// Bending stiffness of each base and platform joint, N m/rad.
    pub joint_stiffness: [f64; 2],
    /// Cables.
    pub cables: Vec<Cable>,
}

impl Parts {
    /// Takes a structure apart.
    ///
    /// # Errors
    /// [`TruthError::Inexpressible`].
    pub(super) fn of(setup: &Setup) -> Result<Self, TruthError> {
        if !setup.brackets.is_empty() {
            return Err(inexpressible("base joints that yield under leg forces (brackets, coupled legs)"));
        }
        let mut legs = [LegPart::placed(setup, 0); 6];
        for (i, part) in legs.iter_mut().enumerate() {
            plain(&setup.laws[i])?;
            *part = LegPart { mass: mass(&setup.joint_weights[i])?, ..LegPart::placed(setup, i) };
        }
        Ok(Self {
            legs,
            base_centre: setup.base_centre,
            base: springs(setup.base_compliance.as_ref(), "a foundation whose directions are coupled")?,
            plate: springs(setup.plate_compliance.as_ref(), "a plate whose directions are coupled")?,
            joint_stiffness: [setup.base_joint_stiffness, setup.platform_joint_stiffness],
            cables: setup.cables.clone(),
        })
    }

    /// True when legs have weight.
    pub(super) fn has_weight(&self) -> bool {
        self.legs.iter().any(|leg| leg.mass.is_some())
    }

    /// Largest leg stiffness, N/m.
    pub(super) fn stiffest_leg(&self) -> f64 {
        self.legs.iter().map(|leg| leg.stiffness).fold(0.0, f64::max)
    }
}

impl LegPart {
    fn placed(setup: &Setup, i: usize) -> Self {
        let platform = Body::at(&setup.pose);
        let vector = platform.origin + platform.axes * setup.platform_joints[i] - setup.base_joints[i];
        let length = vector.norm();
        Self {
            number: i + 1,
            base_joint: setup.base_joints[i] - setup.base_centre,
            platform_joint: setup.platform_joints[i],
            direction: vector / length,
            length,
            relaxed: setup.leg_lengths[i] + setup.laws[i].offset - length,
            stiffness: 1.0 / setup.laws[i].compliance,
            mass: None,
        }
    }
}

/// Refuses what is not a linear spring.
fn plain(law: &LegLaw) -> Result<(), TruthError> {
    let refused = [
        (!law.along_length.is_empty(), "a leg whose compliance depends on its length"),
        (law.slider_force != 0.0, "dry friction beside a leg spring"),
        (law.tension_compliance != 0.0, "a leg that is softer under tension"),
        (!law.powers.is_empty(), "a contact in series with a leg spring"),
        (!law.own.is_empty(), "a leg whose law is a formula"),
        (law.gap != 0.0 || !law.soft_gaps.is_empty(), "play in a leg"),
    ];
    match refused.iter().find(|(found, _)| *found) {
        Some((_, what)) => Err(inexpressible(what)),
        None => Ok(()),
    }
}

/// Mass of a leg that puts this weight on either of its joints, kg.
fn mass(weight: &Vector3) -> Result<Option<f64>, TruthError> {
    if weight.x != 0.0 || weight.y != 0.0 || weight.z > 0.0 {
        return Err(inexpressible("leg weight that does not act along -z"));
    }
    Ok((weight.z < 0.0).then_some(-2.0 * weight.z / GRAVITY_M_PER_S2))
}

/// Six springs in series with the axes, if the compliance has no coupling.
fn springs(compliance: Option<&Matrix6>, coupled: &'static str) -> Result<Option<Springs>, TruthError> {
    let Some(compliance) = compliance else { return Ok(None) };
    let diagonal = compliance.diagonal();
    if *compliance != Matrix6::from_diagonal(&diagonal) {
        return Err(inexpressible(coupled));
    }
    Ok(Some(std::array::from_fn(|k| (diagonal[k] != 0.0).then(|| 1.0 / diagonal[k]))))
}
