//! The catalogue of effects on the model side: one file each.
//!
//! Adding a term is one file here and its line in `terms!`.

use std::sync::Arc;

use crate::effects::term::Term;

/// Declares the module of every term and registers it.
macro_rules! terms {
    ($($module:ident::$term:ident),+ $(,)?) => {
        $(mod $module;)+

        /// Every term of the catalogue, in the order in which people meet them.
        pub fn catalogue() -> Vec<Arc<dyn Term>> {
            vec![$(Arc::new($module::$term)),+]
        }
    };
}

terms! {
    leg_length_compliance::LegLengthCompliance,
    leg_nonlinearity::LegNonlinearity,
    leg_asymmetry::LegAsymmetry,
    leg_backlash::LEG_BACKLASH,
    joint_friction::JointFriction,
    joint_rotation_stiffness::JointRotationStiffness,
    bracket_compliance::BracketCompliance,
    leg_coupling::LegCoupling,
    base_compliance::BASE_COMPLIANCE,
    platform_compliance::PLATFORM_COMPLIANCE,
    load_offset::LoadOffset,
    load_tilt::LoadTilt,
    thermal_expansion::THERMAL_EXPANSION,
    metrology_drift::MetrologyDrift,
    target_offset::TargetOffset,
    creep::CREEP,
    joint_geometry::JointGeometry,
    leg_offset::LegOffset,
    actuator_scale::ActuatorScale,
    actuator_pitch::ActuatorPitch,
    leg_weight::LegWeight,
}
