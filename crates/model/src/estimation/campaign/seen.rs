//! Numbers of things by what makes them equal, which is kept where it stands and not once more in a table.

use std::hash::{BuildHasher, Hash};

use hashbrown::{DefaultHashBuilder, HashTable};

/// Numbers of different things.
pub(super) struct Seen {
    hashes: DefaultHashBuilder,
    numbers: HashTable<u32>,
}

impl Seen {
    /// Nothing yet; room for so many things.
    pub(super) fn with_room(things: usize) -> Self {
        Self { hashes: DefaultHashBuilder::default(), numbers: HashTable::with_capacity(things) }
    }

    /// The number of the thing with this key: a known one, or `next`; `key_of` makes the key of a thing by its number.
    pub(super) fn number<K: Hash + Eq>(
        &mut self,
        key: &K,
        next: usize,
        key_of: impl Fn(usize) -> K,
    ) -> usize {
        let (hashes, of) = (&self.hashes, |number: &u32| key_of(*number as usize));
        let same = |number: &u32| of(number) == *key;
        let entry = self.numbers.entry(hashes.hash_one(key), same, |number| hashes.hash_one(of(number)));
        *entry.or_insert(u32::try_from(next).unwrap_or(u32::MAX)).get() as usize
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.numbers.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_things_have_the_number_of_the_first_whatever_the_room() {
        let things: Vec<u64> = (0..200).map(|k| k * k % 23).collect();
        for room in [0, 200] {
            let mut seen = Seen::with_room(room);
            for (i, thing) in things.iter().enumerate() {
                let first = things.iter().position(|one| one == thing);
                assert_eq!(Some(seen.number(thing, i, |number| things[number])), first);
            }
            assert_eq!(seen.len(), 12, "squares modulo 23");
        }
    }
}
