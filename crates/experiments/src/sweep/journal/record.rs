//! One shard as bytes.
//!
//! ```text
//! 16 B  magic                    32 B  origin
//!  8 B  number of the shard      16 B  first trial, end of the trials
//!  then column after column: numbers as 8 B each, codes as 1 B each
//! 32 B  SHA-256 of all before                       (little-endian)
//! ```

use sha2::{Digest, Sha256};

use crate::sweep::shard::{Shard, Values};

const MAGIC: &[u8; 16] = b"hexbench-shard/1";
const DIGEST: usize = 32;

/// The bytes of a shard.
pub(super) fn encode(shard: &Shard, origin: [u8; DIGEST]) -> Vec<u8> {
    let mut bytes = head(shard, origin);
    for column in &shard.columns {
        match column {
            Values::Numbers(values) => values.iter().for_each(|x| bytes.extend(x.to_le_bytes())),
            Values::Codes(codes) => bytes.extend(codes),
        }
    }
    let digest = Sha256::digest(&bytes);
    bytes.extend(digest);
    bytes
}

fn head(shard: &Shard, origin: [u8; DIGEST]) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(origin);
    for number in [shard.number, shard.trials.start, shard.trials.end] {
        bytes.extend(number.to_le_bytes());
    }
    bytes
}

/// The shard that the bytes hold, given what it must be (`empty`); none when they are cut, changed or of another study.
pub(super) fn decode(bytes: &[u8], mut empty: Shard, origin: [u8; DIGEST]) -> Option<Shard> {
    let (content, digest) = bytes.split_at_checked(bytes.len().checked_sub(DIGEST)?)?;
    let mut rest = content.strip_prefix(head(&empty, origin).as_slice())?;
    if Sha256::digest(content).as_slice() != digest {
        return None;
    }
    let rows = usize::try_from(empty.trials.end - empty.trials.start).ok()?;
    for column in &mut empty.columns {
        let size = if matches!(column, Values::Numbers(_)) { 8 } else { 1 };
        let (own, others) = rest.split_at_checked(rows.checked_mul(size)?)?;
        match column {
            Values::Numbers(values) => {
                values.extend(own.as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b)));
            }
            Values::Codes(codes) => codes.extend(own),
        }
        rest = others;
    }
    rest.is_empty().then_some(empty)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::columns::{Status, columns};
    use crate::sweep::shard::Value;
    use crate::sweep::study::Task;

    fn shard() -> Shard {
        let mut shard = Shard::empty(7, 14..16, &columns(Task::Springs));
        let numbers = [0.25, -1.0, 3.0, 1e-9, 5.0, 6.0].map(Value::Number);
        shard.push(numbers.into_iter().chain([Value::Code(5)]).chain([0.1, 0.2, 0.3].map(Value::Number)));
        shard.push_failed(Status::NotVisible);
        shard
    }

    fn empty() -> Shard {
        Shard::empty(7, 14..16, &columns(Task::Springs))
    }

    #[test]
    fn a_shard_comes_back_bit_by_bit() {
        let bytes = encode(&shard(), [3; 32]);
        let back = decode(&bytes, empty(), [3; 32]).unwrap();
        assert_eq!(encode(&back, [3; 32]), bytes);
        assert_eq!(back.columns[1].numbers()[0].to_bits(), 0.25_f64.to_bits());
        assert!(back.columns[1].numbers()[1].is_nan());
    }

    #[test]
    fn a_record_that_is_cut_or_changed_anywhere_is_refused() {
        let bytes = encode(&shard(), [3; 32]);
        for end in 0..bytes.len() {
            assert!(decode(&bytes[..end], empty(), [3; 32]).is_none(), "cut at {end}");
        }
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 0x10;
            assert!(decode(&changed, empty(), [3; 32]).is_none(), "changed at {at}");
        }
    }

    #[test]
    fn a_record_of_another_study_or_place_is_refused() {
        let bytes = encode(&shard(), [3; 32]);
        assert!(decode(&bytes, empty(), [4; 32]).is_none());
        let elsewhere = Shard::empty(8, 16..18, &columns(Task::Springs));
        assert!(decode(&bytes, elsewhere, [3; 32]).is_none());
    }
}
