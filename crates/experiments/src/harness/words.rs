//! Names that stand in the program itself, read back from a journal: machines, effects of the simulated world, faults of its
//! laboratories, what those read.

use hexbench_truth::campaign::machines::FAMILIES;
use hexbench_truth::campaign::{SensorFault, SensorSet};
use hexbench_truth::laboratory;
use hexbench_truth::mechanisms::REGISTRY;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A name of the program. By this name the derivation of `Deserialize` does not take it for borrowed text.
pub(crate) type Word = &'static str;

fn known<E: Error>(name: &str) -> Result<Word, E> {
    let faults = laboratory::registry().map(|fault| fault.id);
    let sensors =
        SensorSet::ALL.map(SensorSet::word).into_iter().chain(SensorFault::ALL.map(SensorFault::word));
    let effects = REGISTRY.iter().map(|effect| effect.id);
    let mut all = FAMILIES.iter().copied().chain(effects).chain(faults).chain(sensors);
    all.find(|known| *known == name)
        .ok_or_else(|| E::custom(format!("\"{name}\" is not a machine, effect, fault or way of reading")))
}

pub(crate) fn serialize<S: Serializer>(name: &str, to: S) -> Result<S::Ok, S::Error> {
    name.serialize(to)
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Word, D::Error> {
    known(&String::deserialize(from)?)
}

/// Several of them.
pub(crate) mod list {
    use super::{Deserialize, Deserializer, Serialize, Serializer, Word, known};

    pub(crate) fn serialize<S: Serializer>(names: &[Word], to: S) -> Result<S::Ok, S::Error> {
        names.serialize(to)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Word>, D::Error> {
        Vec::<String>::deserialize(from)?.iter().map(|name| known(name)).collect()
    }
}
