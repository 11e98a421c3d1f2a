//! Where the records of a journal lie: a file for each while they are few, one behind the other in volumes where they are many.
//!
//! ```text
//! 00000042.shard              one record
//! 000000.records              a volume: for each record its length and its number (8 bytes each, little-endian), then the record
//! ```
//!
//! Volumes only grow, and a full one is followed by the next. What a kill leaves at the end of one is passed over, and the next
//! record begins another; a frame that was changed is passed over up to the next record.

use std::collections::{BTreeMap, HashSet};
use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use hexbench_core::files::atomic_write;

use super::record::{MAGIC, number_of};

/// Shards of an experiment whose records lie in files of their own.
const FEW: u64 = 512;
/// Bytes after which a volume is full: 10^8 trials of a study are some hundred volumes.
const FULL: u64 = 64 << 20;
/// Bytes before a record in a volume.
const FRAME: usize = 16;

/// The records in the folder of a journal.
#[derive(Debug)]
pub(super) struct Records {
    journal: PathBuf,
    are_many: bool,
    full: u64,
    places: Mutex<Places>,
}

#[derive(Debug, Default)]
struct Places {
    in_volumes: BTreeMap<u64, Place>,
    /// Records in files of their own, where there are volumes beside them.
    alone: HashSet<u64>,
    /// Number and length of the volume that is written to.
    last: Option<(u32, u64)>,
    /// Number of the next volume.
    next: u32,
}

#[derive(Debug, Clone, Copy)]
struct Place {
    volume: u32,
    begin: u64,
    length: u64,
}

impl Records {
    /// Looks what is in a folder of an experiment of so many shards.
    pub(super) fn open(journal: &Path, shards: u64) -> io::Result<Self> {
        Self::with_volumes_of(journal, shards, FULL)
    }

    fn with_volumes_of(journal: &Path, shards: u64, full: u64) -> io::Result<Self> {
        let mut places = Places::default();
        let mut volumes = Vec::new();
        for entry in fs::read_dir(journal)? {
            let path = entry?.path();
            let Some(number) = path.file_stem().and_then(|stem| stem.to_str()?.parse::<u64>().ok()) else {
                continue;
            };
            match path.extension().and_then(|end| end.to_str()) {
                Some("shard") => places.alone.extend([number]),
                Some("records") => volumes.extend(u32::try_from(number)),
                _ => {}
            }
        }
        volumes.sort_unstable();
        for volume in volumes {
            let (length, is_clean) = places.look(volume, &volume_path(journal, volume))?;
            places.last = (is_clean && length < full).then_some((volume, length));
            places.next = volume + 1;
        }
        Ok(Self { journal: journal.to_owned(), are_many: shards > FEW, full, places: Mutex::new(places) })
    }

    /// The record of a shard, as it was kept; none where there is none.
    pub(super) fn get(&self, number: u64) -> Result<Option<Vec<u8>>, (PathBuf, io::Error)> {
        let (place, may_be_alone) = {
            let places = self.places();
            (places.in_volumes.get(&number).copied(), !self.are_many || places.alone.contains(&number))
        };
        let read = |path: PathBuf, record: io::Result<Vec<u8>>| match record {
            Ok(bytes) => Ok(Some(bytes)),
            Err(cause) if cause.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(cause) => Err((path, cause)),
        };
        if let Some(place) = place {
            let path = volume_path(&self.journal, place.volume);
            return read(path.clone(), place.read(&path));
        }
        let path = self.journal.join(record_name(number));
        if may_be_alone { read(path.clone(), fs::read(&path)) } else { Ok(None) }
    }

    /// Keeps the record of a shard, in place of one that was there.
    pub(super) fn put(&self, number: u64, bytes: &[u8]) -> Result<(), (PathBuf, io::Error)> {
        if !self.are_many {
            let path = self.journal.join(record_name(number));
            return atomic_write(&path, |out| out.write_all(bytes)).map_err(|cause| (path, cause));
        }
        let mut places = self.places();
        let (volume, length) = places.last.unwrap_or((places.next, 0));
        let path = volume_path(&self.journal, volume);
        let length_of_record = (bytes.len() as u64).to_le_bytes();
        let frame = [length_of_record.as_slice(), &number.to_le_bytes(), bytes].concat();
        // Whatever happens, nothing is written behind a frame that is not whole.
        places.last = None;
        places.next = places.next.max(volume + 1);
        append(&path, length, &frame).map_err(|cause| (path, cause))?;
        let end = length + frame.len() as u64;
        let place = Place { volume, begin: length + FRAME as u64, length: bytes.len() as u64 };
        places.in_volumes.insert(number, place);
        places.last = (end < self.full).then_some((volume, end));
        Ok(())
    }

    fn places(&self) -> std::sync::MutexGuard<'_, Places> {
        self.places.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Places {
    /// Finds the records of a volume; its length, and whether nothing but whole frames is in it.
    fn look(&mut self, volume: u32, path: &Path) -> io::Result<(u64, bool)> {
        let mut file = File::open(path)?;
        let size = file.metadata()?.len();
        let (mut at, mut is_clean) = (0, true);
        // Behind the beginning of the last record: its length may be what was changed.
        let mut from = 0;
        while at < size {
            if let Some((number, length)) = frame_at(&mut file, at, size)? {
                let begin = at + FRAME as u64;
                self.in_volumes.insert(number, Place { volume, begin, length });
                (at, from) = (begin + length, begin + 1);
                continue;
            }
            is_clean = false;
            let Some(record) = next_record(&mut file, from)? else { break };
            (at, from) = (record.saturating_sub(FRAME as u64), record + 1);
        }
        Ok((size, is_clean))
    }
}

impl Place {
    fn read(self, volume: &Path) -> io::Result<Vec<u8>> {
        let mut file = File::open(volume)?;
        file.seek(SeekFrom::Start(self.begin))?;
        let mut bytes = Vec::new();
        file.take(self.length).read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}

/// Number and length of the record whose frame begins here; none where no whole one does.
fn frame_at(file: &mut File, at: u64, size: u64) -> io::Result<Option<(u64, u64)>> {
    let mut head = Vec::new();
    file.seek(SeekFrom::Start(at))?;
    file.take((FRAME + super::record::HEAD) as u64).read_to_end(&mut head)?;
    let Some((frame, record)) = head.split_at_checked(FRAME) else { return Ok(None) };
    let word = |k: usize| frame[8 * k..].first_chunk().map_or(0, |word| u64::from_le_bytes(*word));
    let [length, number] = [word(0), word(1)];
    let fits = length.checked_add(at + FRAME as u64).is_some_and(|end| end <= size);
    Ok((fits && number_of(record) == Some(number)).then_some((number, length)))
}

/// Where the next record begins, at this place or behind it.
fn next_record(file: &mut File, from: u64) -> io::Result<Option<u64>> {
    let mut rest = Vec::new();
    file.seek(SeekFrom::Start(from))?;
    file.read_to_end(&mut rest)?;
    let found = rest.windows(MAGIC.len()).position(|window| window == MAGIC);
    Ok(found.map(|behind| from + behind as u64))
}

/// Writes a frame at the end of a volume, which has this length; one that is not written whole is taken off again where that is possible.
fn append(path: &Path, length: u64, frame: &[u8]) -> io::Result<()> {
    let mut file = File::options().create(true).append(true).open(path)?;
    let written = file.write_all(frame).and_then(|()| file.sync_data());
    if written.is_err() {
        // What cannot be taken off is passed over by the next look.
        let _ = file.set_len(length);
    }
    written
}

fn record_name(number: u64) -> String {
    format!("{number:08}.shard")
}

fn volume_path(journal: &Path, number: u32) -> PathBuf {
    journal.join(format!("{number:06}.records"))
}

#[cfg(test)]
mod tests {
    use super::super::record::{encode, head};
    use super::*;

    const MANY: u64 = 100_000;

    fn record(number: u64) -> Vec<u8> {
        encode(&head([7; 32], number, &(number..number + 1)), format!("of shard {number}").as_bytes())
    }

    fn keep(folder: &Path, numbers: impl IntoIterator<Item = u64>) -> Records {
        let records = Records::with_volumes_of(folder, MANY, 4096).unwrap();
        numbers.into_iter().for_each(|n| records.put(n, &record(n)).unwrap());
        records
    }

    fn files(folder: &Path) -> usize {
        fs::read_dir(folder).unwrap().count()
    }

    #[test]
    fn many_records_lie_in_few_files_and_are_all_found_again() {
        let folder = tempfile::tempdir().unwrap();
        keep(folder.path(), (0..300).rev());
        // 300 records of some 170 bytes in volumes of 4096.
        assert!((10..20).contains(&files(folder.path())), "{}", files(folder.path()));
        let again = keep(folder.path(), [500]);
        for number in (0..300).chain([500]) {
            assert_eq!(again.get(number).unwrap(), Some(record(number)), "{number}");
        }
        assert_eq!(again.get(300).unwrap(), None);
    }

    #[test]
    fn a_volume_cut_anywhere_loses_its_last_records_only_and_goes_on_in_another() {
        let whole = tempfile::tempdir().unwrap();
        keep(whole.path(), 0..5);
        let bytes = fs::read(volume_path(whole.path(), 0)).unwrap();
        let frame = bytes.len() / 5;
        for end in 0..bytes.len() {
            let folder = tempfile::tempdir().unwrap();
            fs::write(volume_path(folder.path(), 0), &bytes[..end]).unwrap();
            let records = keep(folder.path(), [9]);
            let found: Vec<u64> = (0..5).filter(|n| records.get(*n).unwrap() == Some(record(*n))).collect();
            assert_eq!(found, (0..(end / frame) as u64).collect::<Vec<_>>(), "cut at {end}");
            assert_eq!(records.get(9).unwrap(), Some(record(9)), "cut at {end}");
            let again = Records::open(folder.path(), MANY).unwrap();
            assert_eq!(again.get(9).unwrap(), Some(record(9)), "cut at {end}");
        }
    }

    #[test]
    fn a_changed_byte_costs_one_record_and_a_later_one_of_the_shard_takes_its_place() {
        let whole = tempfile::tempdir().unwrap();
        keep(whole.path(), 0..5);
        let bytes = fs::read(volume_path(whole.path(), 0)).unwrap();
        for at in 0..bytes.len() {
            let folder = tempfile::tempdir().unwrap();
            let mut changed = bytes.clone();
            changed[at] ^= 0x10;
            fs::write(volume_path(folder.path(), 0), &changed).unwrap();
            let records = Records::with_volumes_of(folder.path(), MANY, 4096).unwrap();
            let lost: Vec<u64> = (0..5).filter(|n| records.get(*n).unwrap() != Some(record(*n))).collect();
            assert_eq!(lost, [(at / (bytes.len() / 5)) as u64], "changed at {at}");
            keep(folder.path(), lost);
            let again = Records::open(folder.path(), MANY).unwrap();
            assert!((0..5).all(|n| again.get(n).unwrap() == Some(record(n))), "changed at {at}");
        }
    }

    #[test]
    fn few_records_have_files_of_their_own_and_are_found_beside_volumes() {
        let folder = tempfile::tempdir().unwrap();
        let few = Records::open(folder.path(), FEW).unwrap();
        (0..3).for_each(|n| few.put(n, &record(n)).unwrap());
        assert_eq!(files(folder.path()), 3);
        // The same experiment with more trials.
        let more = keep(folder.path(), [3, 4]);
        assert_eq!(files(folder.path()), 4);
        assert!((0..5).all(|n| more.get(n).unwrap() == Some(record(n))));
    }
}
