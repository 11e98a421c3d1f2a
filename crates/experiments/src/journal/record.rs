//! One shard as bytes.
//!
//! ```text
//! 16 B  magic                    32 B  origin
//!  8 B  number of the shard      16 B  first trial, end of the trials
//!  then its content
//! 32 B  SHA-256 of all before                       (little-endian)
//! ```

use std::ops::Range;

use sha2::{Digest, Sha256};

pub(super) const MAGIC: &[u8; 16] = b"hexbench-shard/1";
const DIGEST: usize = 32;
/// Bytes before the content.
pub(super) const HEAD: usize = MAGIC.len() + DIGEST + 3 * size_of::<u64>();

/// What a record begins with.
pub(super) fn head(origin: [u8; DIGEST], number: u64, trials: &Range<u64>) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(origin);
    for number in [number, trials.start, trials.end] {
        bytes.extend(number.to_le_bytes());
    }
    bytes
}

/// Number of the shard that a record says it is of; none for what does not begin like one.
pub(super) fn number_of(bytes: &[u8]) -> Option<u64> {
    let behind = bytes.strip_prefix(MAGIC.as_slice())?.get(DIGEST..HEAD - MAGIC.len())?;
    Some(u64::from_le_bytes(*behind.first_chunk()?))
}

/// The record of a shard.
pub(super) fn encode(head: &[u8], content: &[u8]) -> Vec<u8> {
    let mut bytes = [head, content].concat();
    let digest = Sha256::digest(&bytes);
    bytes.extend(digest);
    bytes
}

/// The content of a record; none when it is cut, changed, or has another head.
pub(super) fn decode<'a>(bytes: &'a [u8], head: &[u8]) -> Option<&'a [u8]> {
    let (whole, digest) = bytes.split_at_checked(bytes.len().checked_sub(DIGEST)?)?;
    let content = whole.strip_prefix(head)?;
    (Sha256::digest(whole).as_slice() == digest).then_some(content)
}

/// True for the whole record of a last shard from when the experiment had fewer trials.
pub(super) fn is_of_fewer_trials(bytes: &[u8], head: &[u8]) -> bool {
    let (same, end) = head.split_at(head.len() - size_of::<u64>());
    let there = bytes.strip_prefix(same).and_then(|rest| rest.first_chunk());
    let other = [same, there.map_or(end, <[u8; 8]>::as_slice)].concat();
    other != head && decode(bytes, &other).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTENT: [u8; 21] = *b"all of sixteen trials";

    fn record() -> (Vec<u8>, Vec<u8>) {
        let head = head([3; 32], 7, &(14..16));
        let bytes = encode(&head, &CONTENT);
        (head, bytes)
    }

    #[test]
    fn a_record_that_is_cut_or_changed_anywhere_is_refused() {
        let (head, bytes) = record();
        assert_eq!(decode(&bytes, &head), Some(CONTENT.as_slice()));
        for end in 0..bytes.len() {
            assert!(decode(&bytes[..end], &head).is_none(), "cut at {end}");
        }
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 0x10;
            assert!(decode(&changed, &head).is_none(), "changed at {at}");
        }
    }

    #[test]
    fn a_record_of_another_study_or_place_is_refused() {
        let (_, bytes) = record();
        assert!(decode(&bytes, &head([4; 32], 7, &(14..16))).is_none());
        assert!(decode(&bytes, &head([3; 32], 8, &(16..18))).is_none());
        let grown = head([3; 32], 7, &(14..18));
        assert!(decode(&bytes, &grown).is_none() && is_of_fewer_trials(&bytes, &grown));
        assert!(!is_of_fewer_trials(&bytes[1..], &grown) && !is_of_fewer_trials(&bytes[..40], &grown));
    }
}
