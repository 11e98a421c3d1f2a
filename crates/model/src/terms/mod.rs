//! The catalogue of effects on the model side: one file each.
//!
//! Adding a term is one file here, its `mod` line and its line in [`catalogue`].

mod actuator_pitch;
mod actuator_scale;
mod base_compliance;
mod bracket_compliance;
mod creep;
mod joint_friction;
mod joint_geometry;
mod joint_rotation_stiffness;
mod leg_asymmetry;
mod leg_backlash;
mod leg_coupling;
mod leg_length_compliance;
mod leg_nonlinearity;
mod leg_offset;
mod leg_weight;
mod load_offset;
mod load_tilt;
mod metrology_drift;
mod platform_compliance;
mod target_offset;
mod thermal_expansion;

use std::sync::Arc;

use crate::term::Term;

/// Every term of the catalogue, in the order in which people meet them.
pub fn catalogue() -> Vec<Arc<dyn Term>> {
    vec![
        Arc::new(leg_length_compliance::LegLengthCompliance),
        Arc::new(leg_nonlinearity::LegNonlinearity),
        Arc::new(leg_asymmetry::LegAsymmetry),
        Arc::new(leg_backlash::LegBacklash),
        Arc::new(joint_friction::JointFriction),
        Arc::new(joint_rotation_stiffness::JointRotationStiffness),
        Arc::new(bracket_compliance::BracketCompliance),
        Arc::new(leg_coupling::LegCoupling),
        Arc::new(base_compliance::BaseCompliance),
        Arc::new(platform_compliance::PlatformCompliance),
        Arc::new(load_offset::LoadOffset),
        Arc::new(load_tilt::LoadTilt),
        Arc::new(thermal_expansion::ThermalExpansion),
        Arc::new(metrology_drift::MetrologyDrift),
        Arc::new(target_offset::TargetOffset),
        Arc::new(creep::Creep),
        Arc::new(joint_geometry::JointGeometry),
        Arc::new(leg_offset::LegOffset),
        Arc::new(actuator_scale::ActuatorScale),
        Arc::new(actuator_pitch::ActuatorPitch),
        Arc::new(leg_weight::LegWeight),
    ]
}
