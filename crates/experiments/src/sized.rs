//! Sizes of effects of the simulated world in the units of the catalogue.
//!
//! The size of an effect is the root mean square of those of its parameters that have the unit of the first: of the three
//! translational compliances of a base, of the three coordinates of an offset.

use hexbench_core::Hexapod;
use hexbench_core::streams::{Purpose, stream};
use hexbench_design::power::effect_size;
use hexbench_model::terms::catalogue;
use hexbench_truth::Mechanism;
use hexbench_truth::campaign::machines;
use hexbench_truth::mechanisms::{REGISTRY, Shows};

use crate::power::usual;
use crate::recovery::correspondence::equivalent;

/// A unit in which sizes are stated, and the key of a file that states them in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SizeUnit {
    /// Key of a study file.
    pub key: &'static str,
    /// Unit, as the catalogue writes it.
    pub unit: &'static str,
}

const fn unit(key: &'static str, unit: &'static str) -> SizeUnit {
    SizeUnit { key, unit }
}

/// The units of the effects that show in deflections.
pub const SIZE_UNITS: [SizeUnit; 10] = [
    unit("size_nm_per_N", "nm/N"),
    unit("size_um", "um"),
    unit("size_mm", "mm"),
    unit("size_mrad", "mrad"),
    unit("size_N", "N"),
    unit("size_percent", "%"),
    unit("size_nm_per_s", "nm/s"),
    unit("size_um_per_m_K", "um/(m K)"),
    unit("size_N_m_per_rad", "N m/rad"),
    unit("size_nm_per_N_mm", "nm/(N mm)"),
];

impl SizeUnit {
    /// The unit in which the catalogue has the size of an effect; none for effects outside it.
    pub fn of(effect: &str) -> Option<Self> {
        let term = catalogue().into_iter().find(|term| term.info().id == effect)?;
        let own = term.info().parameters.first()?.unit;
        SIZE_UNITS.into_iter().find(|known| known.unit == own)
    }
}

/// Size of an effect in the unit of its kind; none outside the catalogue.
pub fn size_of(mechanism: &dyn Mechanism, hexapod: &Hexapod) -> Option<f64> {
    let term = catalogue().into_iter().find(|term| term.info().id == mechanism.id())?;
    let found = equivalent(mechanism.id(), &mechanism.parameters(), hexapod)?;
    let values: Vec<f64> = found.values.into_iter().collect::<Option<_>>()?;
    Some(effect_size(term.info().parameters, &values)).filter(|size| *size > 0.0)
}

/// The effect with the same direction and shape, so large in the unit of its kind; none when it would not be called by its name.
pub fn with_size(mechanism: &dyn Mechanism, size: f64, hexapod: &Hexapod) -> Option<Box<dyn Mechanism>> {
    let factor = size / size_of(mechanism, hexapod)?;
    (factor <= mechanism.largest_factor()).then(|| mechanism.scaled(factor))
}

/// How large an effect usually is in simulations of a machine of the family `ring_a`, in the unit of its kind.
pub fn usual_size(effect: &str) -> Option<(f64, SizeUnit)> {
    const SEED: u64 = 1;
    let shows = |entry: &&hexbench_truth::mechanisms::MechanismEntry| entry.shows == Shows::Deflection;
    REGISTRY.iter().filter(shows).find(|entry| entry.id == effect)?;
    let term = catalogue().into_iter().find(|term| term.info().id == effect)?;
    let hexapod = machines::draw(machines::FAMILIES[0], &mut stream(SEED, Purpose::Example, []));
    let sizes = usual(&term, &hexapod, SEED)?.subject;
    Some((sizes.size(sizes.examples.first()?), SizeUnit::of(effect)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_effect_of_the_catalogue_that_shows_in_deflections_takes_a_size_in_its_unit() {
        const SIZE: f64 = 0.37;
        const ROUNDING: f64 = 1e-12;
        let mut rng = stream(3, Purpose::Example, []);
        for family in machines::FAMILIES {
            let hexapod = machines::draw(family, &mut rng);
            for entry in REGISTRY.iter().filter(|entry| entry.shows == Shows::Deflection) {
                assert!(SizeUnit::of(entry.id).is_some(), "{}", entry.id);
                let usual = (entry.draw)(&hexapod, &mut rng);
                let sized = usual.scaled(SIZE / size_of(&*usual, &hexapod).unwrap());
                let found = size_of(&*sized, &hexapod).unwrap();
                assert!((found / SIZE - 1.0).abs() < ROUNDING, "{}: {found}", entry.id);
            }
        }
    }

    #[test]
    fn a_base_of_two_nanometers_per_newton_yields_by_the_root_mean_square_of_its_axes() {
        let hexapod = machines::draw("ring_a", &mut stream(1, Purpose::Example, []));
        let entry = REGISTRY.iter().find(|entry| entry.id == "base-compliance").unwrap();
        let drawn = (entry.draw)(&hexapod, &mut stream(2, Purpose::Example, []));
        let base = with_size(&*drawn, 2.0, &hexapod).unwrap();
        let stiffness = base.parameters()["base"].clone();
        let square = (0..3).map(|k| stiffness[k].as_f64().unwrap().powi(-2)).sum::<f64>() / 3.0;
        assert!((square.sqrt() * 1e9 - 2.0).abs() < 1e-9, "{square}");
        assert!(with_size(&*drawn, 1e9, &hexapod).is_none());
    }

    #[test]
    fn the_usual_base_yields_by_some_nanometers_per_newton_and_what_is_outside_has_no_size() {
        let (size, unit) = usual_size("base-compliance").unwrap();
        assert!((1.0..20.0).contains(&size), "{size}");
        assert_eq!(unit.unit, "nm/N");
        assert!(usual_size("out:cable").is_none() && usual_size("leg-offset").is_none());
    }
}
