//! What is hidden: an effect by its name, in a size of its own, or a law of one's own.
//!
//! ```text
//! "creep"
//! { id = "creep", size_percent = 10 }                                       a size of its own, or bounds
//! { id = "out:formula", elongation = "size*tanh(f/width)", size = 2e-7, width = 40 }      keys as in a truth file
//! ```

use hexbench_core::Hexapod;
use hexbench_core::files::{Fault, FileProblem, Item, KeyUnit};
use hexbench_truth::campaign::resized;
use hexbench_truth::mechanisms::{self, REGISTRY};
use hexbench_truth::own_law::OWN_LAW;
use hexbench_truth::scene::stated_effect;
use hexbench_truth::{Mechanism, TruthError};
use rand_pcg::Pcg64;
use serde_json::Value;

use super::sizes::{self, SizeRange};
use super::unknown;

/// An effect that is hidden in a machine.
#[derive(Debug, Clone, PartialEq)]
pub struct HiddenEffect {
    /// Its id in the simulated world.
    pub id: &'static str,
    /// A size of its own.
    pub size: Option<SizeRange>,
    /// Parameters of a law of one's own.
    law: Option<Value>,
}

/// Effects that are hidden together, in the order of the file.
pub type EffectSet = Vec<HiddenEffect>;

/// Name of a set of effects; `none` for an empty one.
pub fn set_name(effects: &[HiddenEffect]) -> String {
    if effects.is_empty() {
        return "none".to_owned();
    }
    let name = |effect: &HiddenEffect| match effect.size {
        Some(size) => format!("{} {}", effect.id, size.text()),
        None => effect.id.to_owned(),
    };
    effects.iter().map(name).collect::<Vec<_>>().join("+")
}

impl HiddenEffect {
    /// An effect of usual size.
    pub fn usual(id: &'static str) -> Self {
        Self { id, size: None, law: None }
    }

    /// True when the file says how large it is.
    pub fn has_size(&self) -> bool {
        self.size.is_some() || self.law.is_some()
    }

    /// The effect on a machine, its shape sampled, in its own size where it has one.
    ///
    /// # Errors
    /// [`TruthError::TooLarge`].
    pub fn sampled(&self, hexapod: &Hexapod, rng: &mut Pcg64) -> Result<Box<dyn Mechanism>, TruthError> {
        let usual = match &self.law {
            Some(law) => mechanisms::build(self.id, law.clone())?,
            None => (mechanisms::effect(self.id)?.draw)(hexapod, rng),
        };
        let Some(size) = self.size else { return Ok(usual) };
        let wanted = size.sampled(rng);
        resized(&*usual, size.factor(wanted, &*usual, hexapod))
    }
}

const KEYS: &[KeyUnit] = &KeyUnit::all_plain(sizes::names_behind::<1, { 1 + sizes::COUNT }>(["id"]));

/// An effect, by its name or in a table.
pub(crate) fn read(item: &Item<'_>) -> Result<HiddenEffect, Fault> {
    if !item.is_table() {
        return known(item, item.string()?).map(HiddenEffect::usual);
    }
    let entries = item.entries()?;
    let Some(id) = entries.iter().find(|entry| entry.key() == "id") else {
        return Err(item.fault(FileProblem::MissingKey { key: "id".into() }));
    };
    if id.string()? == OWN_LAW {
        let (_, law) = stated_effect(item)?;
        return Ok(HiddenEffect { id: OWN_LAW, size: None, law: Some(law) });
    }
    let table = item.section("an effect", KEYS)?;
    let effect = HiddenEffect::usual(known(id, id.string()?)?);
    let Some((size, place)) = sizes::read(|key| table.get(key))? else { return Ok(effect) };
    if let Some(unit) = size.unit {
        sizes::refuse_other_unit(place, effect.id, unit)?;
    }
    Ok(HiddenEffect { size: Some(size), ..effect })
}

/// The effect of the simulated world with a name.
pub(crate) fn known(item: &Item<'_>, word: &str) -> Result<&'static str, Fault> {
    if word == OWN_LAW {
        let next = "Write a table: { id = \"out:formula\", elongation = \"...\" }.";
        return Err(item.breaks("a law of your own needs its formula", next));
    }
    let names: Vec<&'static str> = REGISTRY.iter().map(|effect| effect.id).collect();
    names.iter().copied().find(|id| *id == word).ok_or_else(|| unknown(item, word, &names, "effect"))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use hexbench_core::files::{Format, read_toml_text};
    use hexbench_core::streams::{Purpose, stream};
    use hexbench_truth::campaign::machines;

    use super::*;
    use crate::sized::size_of;

    const FORMAT: Format = Format { name: "test/1", keys: &KeyUnit::all_plain(["format", "effects"]) };

    fn all(effects: &str) -> Result<EffectSet, String> {
        let text = format!("format = \"test/1\"\neffects = {effects}\n");
        let of_top = |top: &hexbench_core::files::TomlSection<'_>| {
            top.require("effects")?.list()?.iter().map(read).collect::<Result<EffectSet, Fault>>()
        };
        read_toml_text(&text, Path::new("test.toml"), FORMAT, of_top).map_err(|why| why.to_string())
    }

    #[test]
    fn members_of_a_set_are_as_large_as_they_say_each_in_its_unit() {
        const ROUNDING: f64 = 1e-12;
        let set = all(
            "[\"creep\", { id = \"base-compliance\", size_nm_per_N = 2 }, { id = \"load-offset\", size_mm = [1, 4] }, \
             { id = \"leg-coupling\", size_factor = 3 }]",
        )
        .unwrap();
        assert_eq!(
            set_name(&set),
            "creep+base-compliance 2 nm/N+load-offset 1 to 4 mm+leg-coupling 3 times its usual size"
        );
        assert_eq!(set.iter().map(HiddenEffect::has_size).collect::<Vec<_>>(), [false, true, true, true]);
        let hexapod = machines::draw("ring_a", &mut stream(1, Purpose::Example, []));
        let sizes = |seed| {
            let mut rng = stream(seed, Purpose::Example, []);
            let mut size = |effect: &HiddenEffect| {
                size_of(&*effect.sampled(&hexapod, &mut rng).unwrap(), &hexapod).unwrap()
            };
            set.iter().map(&mut size).collect::<Vec<f64>>()
        };
        let sampled: Vec<Vec<f64>> = (0..40).map(sizes).collect();
        for sizes in &sampled {
            assert!((sizes[1] - 2.0).abs() < ROUNDING && (1.0..=4.0).contains(&sizes[2]), "{sizes:?}");
        }
        let below = sampled.iter().filter(|sizes| sizes[2] < 2.0).count();
        assert!((8..=32).contains(&below), "half of the sizes lie below the geometric middle: {below} of 40");
        let alone = HiddenEffect::usual("leg-coupling");
        let usual = alone.sampled(&hexapod, &mut stream(7, Purpose::Example, [])).unwrap();
        let thrice = set[3].sampled(&hexapod, &mut stream(7, Purpose::Example, [])).unwrap();
        let [usual, thrice] = [usual, thrice].map(|effect| size_of(&*effect, &hexapod).unwrap());
        assert!((thrice / usual - 3.0).abs() < ROUNDING, "{usual} {thrice}");
    }

    #[test]
    fn a_law_of_ones_own_has_the_keys_of_a_truth_file() {
        let set = all(
            "[{ id = \"out:formula\", elongation = \"size_um*tanh(f/width)\", legs = [2], size_um = 2e-7, width = 40 }]",
        )
        .unwrap();
        let hexapod = machines::draw("ring_a", &mut stream(1, Purpose::Example, []));
        let law = set[0].sampled(&hexapod, &mut stream(1, Purpose::Example, [])).unwrap();
        assert_eq!(law.parameters()["formula"]["numbers"]["size_um"], 2e-7);
        assert!(set[0].has_size() && set[0].size.is_none());
    }

    #[test]
    fn what_is_no_effect_is_told_with_its_place() {
        for (effects, wanted) in [
            ("[{ size_um = 2 }]", "the key \"id\" is missing"),
            ("[{ id = \"crep\" }]", "(id): \"crep\": there is no effect with this name"),
            ("[\"out:formula\"]", "needs its formula"),
            ("[{ id = \"out:formula\", elongation = \"f*(2\" }]", "not closed"),
            ("[{ id = \"out:cable\", size_um = 2 }]", "out:cable is outside the catalogue"),
            ("[{ id = \"creep\", size_um = 2, size_mm = 3 }]", "there is a size_um too"),
            ("[{ id = \"creep\", size_percent = 0 }]", "sizes rise and are positive"),
        ] {
            let told = all(effects).unwrap_err();
            assert!(told.contains(wanted) && told.contains("line 2, column"), "{effects}: {told}");
        }
    }
}
