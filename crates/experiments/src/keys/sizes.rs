//! How large an effect is: one value, or bounds between which it is sampled.

use hexbench_core::Hexapod;
use hexbench_core::files::{Fault, Item};
use hexbench_truth::Mechanism;
use rand::RngExt;
use rand_pcg::Pcg64;

use crate::sized::{SIZE_UNITS, SizeUnit, size_of};

/// Key of sizes relative to the usual one.
pub(crate) const FACTOR: &str = "size_factor";
/// Number of keys.
pub(crate) const COUNT: usize = 1 + SIZE_UNITS.len();

/// A size, or bounds between which it is sampled evenly in the logarithm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeRange {
    /// Unit of the catalogue; none for factors of the usual size.
    pub unit: Option<SizeUnit>,
    /// Smallest and largest.
    pub bounds: [f64; 2],
}

impl SizeRange {
    /// The size at a share of the way from the smallest to the largest.
    pub fn at(self, share: f64) -> f64 {
        let [low, high] = self.bounds;
        low * (high / low).powf(share)
    }

    /// A size; nothing is sampled where there is one.
    pub fn sampled(self, rng: &mut Pcg64) -> f64 {
        let [low, high] = self.bounds;
        if low < high { self.at(rng.random()) } else { low }
    }

    /// By how much an effect is scaled to be so large; none for one without a size in this unit.
    pub fn factor(self, size: f64, effect: &dyn Mechanism, hexapod: &Hexapod) -> Option<f64> {
        match self.unit {
            None => Some(size),
            Some(_) => Some(size / size_of(effect, hexapod)?),
        }
    }

    /// In words.
    pub fn text(self) -> String {
        let [low, high] = self.bounds;
        let numbers = if low < high { format!("{low} to {high}") } else { format!("{low}") };
        match self.unit {
            Some(unit) => format!("{numbers} {}", unit.unit),
            None => format!("{numbers} times its usual size"),
        }
    }
}

/// Every key, with the unit that it states sizes in.
pub(crate) fn keys() -> impl Iterator<Item = (&'static str, Option<SizeUnit>)> {
    std::iter::once((FACTOR, None)).chain(SIZE_UNITS.map(|unit| (unit.key, Some(unit))))
}

/// Their names behind those of other keys.
pub(crate) const fn names_behind<const OTHERS: usize, const ALL: usize>(
    others: [&'static str; OTHERS],
) -> [&'static str; ALL] {
    let mut all = [FACTOR; ALL];
    let mut k = 0;
    while k < OTHERS {
        all[k] = others[k];
        k += 1;
    }
    let mut unit = 0;
    while unit < SIZE_UNITS.len() {
        all[OTHERS + 1 + unit] = SIZE_UNITS[unit].key;
        unit += 1;
    }
    all
}

/// The one size that is stated, with its place; none without.
pub(crate) fn read<'i, 't: 'i>(
    get: impl Fn(&str) -> Option<&'i Item<'t>>,
) -> Result<Option<(SizeRange, &'i Item<'t>)>, Fault> {
    let mut stated = keys().filter_map(|(key, unit)| Some((key, unit, get(key)?)));
    let Some((key, unit, item)) = stated.next() else { return Ok(None) };
    if let Some((_, _, other)) = stated.next() {
        return Err(two_ways(other, key));
    }
    let [low, high] = if item.is_list() {
        item.numbers::<2>("a smallest and a largest size")?
    } else {
        [item.number()?; 2]
    };
    if low > 0.0 && low <= high {
        return Ok(Some((SizeRange { unit, bounds: [low, high] }, item)));
    }
    Err(item.breaks("sizes rise and are positive", "Write for example 2, or [1, 4] to draw in between."))
}

/// Two keys for one thing.
pub(crate) fn two_ways(item: &Item<'_>, other: &str) -> Fault {
    item.breaks(format!("there is a {other} too"), "Keep one of the two.")
}

/// Another size for an effect that has one of its own.
pub(crate) fn own_size(item: &Item<'_>, effect: &str) -> Fault {
    let next = format!("Remove one of the two; {FACTOR} multiplies sizes of their own.");
    item.breaks(format!("{effect} has a size of its own"), next)
}

/// Refuses a size in the unit of another effect.
pub(crate) fn refuse_other_unit(item: &Item<'_>, effect: &str, stated: SizeUnit) -> Result<(), Fault> {
    match SizeUnit::of(effect) {
        Some(own) if own == stated => Ok(()),
        Some(own) => Err(item.breaks(
            format!("the size of {effect} is in {}, not in {}", own.unit, stated.unit),
            format!("Give this effect a size of its own: {{ id = \"{effect}\", {} = ... }}.", own.key),
        )),
        None => Err(item.breaks(
            format!("{effect} is outside the catalogue and has no size in a unit"),
            format!("Write {FACTOR}, or how visible it is."),
        )),
    }
}
