//! The loads that stood on the machine before the one of a reading.
//!
//! A file with the column `order` says in which sequence its loads were put on. Readings at one commanded pose that follow each other are
//! one way of loads: the unloaded machine, the reference load, the load of the first reading, that of the second, and so on, with nothing
//! taken off in between. A reading of its own reference goes back to the reference load first; readings with one number in `ref_record`
//! share theirs. Another pose begins a new way from the unloaded machine.
//!
//! Times follow from `elapsed_s`, counted from the reference reading: the first load after it is put on at once, each further one right
//! after the reading before. What came before the reference reading is dated back from `ref_age_s`; without it nobody knows when.

use std::collections::HashMap;
use std::sync::Arc;

use crate::{Approach, Observation, Wrench};

/// Earlier loads that count: those further back matter only where they were larger than all since.
const MOST_LOADS: usize = 64;

/// A load that stood on the machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PastLoad {
    /// The wrench.
    pub wrench: Wrench,
    /// When it was put on, s from the reference reading; none: nobody knows, long before.
    pub put_on: Option<f64>,
    /// True when it came before the reference reading.
    pub before_reference: bool,
}

/// Loads between the unloaded machine and the load of a reading, without its own reference load; in the order in which they came.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LoadSequence {
    /// The loads; those before the reference reading first.
    pub past: Vec<PastLoad>,
    /// When the load of the reading was put on, s from the reference reading.
    pub put_on: f64,
}

impl LoadSequence {
    /// The way to a reading after `earlier` ones at its pose, in the order of time; none where only its own reference load came before.
    pub fn to(earlier: &[Observation], reading: &Observation) -> Option<Self> {
        let earlier = &earlier[earlier.len().saturating_sub(MOST_LOADS)..];
        let is_shared = |one: &Observation| {
            one.reference_record.is_some() && one.reference_record == reading.reference_record
        };
        let shared = earlier.iter().rev().take_while(|one| is_shared(one)).count();
        let (before, since) = earlier.split_at(earlier.len() - shared);
        if earlier.is_empty() {
            return None;
        }
        let mut way = Self { past: loads_before(before, reading), put_on: 0.0 };
        for one in since {
            way.past.extend(loads_of(one, Some(way.put_on), false));
            way.put_on = one.elapsed;
        }
        Some(way)
    }

    /// All its numbers, bit by bit: equal for equal ways.
    pub fn bits(&self) -> Vec<u64> {
        let of_load = |load: &PastLoad| {
            let time = [f64::from(u8::from(load.before_reference)), load.put_on.unwrap_or(f64::NEG_INFINITY)];
            load.wrench.to_array().into_iter().chain(time)
        };
        let all = self.past.iter().flat_map(of_load).chain([self.put_on]);
        all.map(|x| (x + 0.0).to_bits()).collect()
    }

    /// The ways to all readings of a file in the sequence that it states; none where only the own reference load came before.
    pub fn of_all(readings: &[Observation]) -> Vec<Option<Self>> {
        let mut by_order: Vec<usize> = (0..readings.len()).filter(|&i| readings[i].order.is_some()).collect();
        by_order.sort_by_key(|&i| readings[i].order);
        let pose = |i: usize| readings[i].pose.bits();
        let mut ways = vec![None; readings.len()];
        for series in by_order.chunk_by(|&a, &b| pose(a) == pose(b)) {
            let mut earlier: Vec<Observation> = Vec::new();
            // The numbers of one row are read at once.
            for row in series.chunk_by(|&a, &b| readings[a].order == readings[b].order) {
                let way = Self::to(&earlier, &readings[row[0]]);
                for &i in row {
                    ways[i].clone_from(&way);
                }
                earlier.push(readings[row[0]]);
            }
        }
        ways
    }
}

/// The ways to the readings of a file by their place in the sequence, whichever readings are kept.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LoadSequences(Arc<HashMap<i64, Arc<LoadSequence>>>);

impl LoadSequences {
    /// Of all readings of a file.
    pub fn of(readings: &[Observation]) -> Self {
        let ways = readings.iter().zip(LoadSequence::of_all(readings));
        Self(Arc::new(ways.filter_map(|(one, way)| Some((one.order?, Arc::new(way?)))).collect()))
    }

    /// With those of another file, whose places in the sequence are `later` by so many.
    pub(crate) fn and(&self, other: &Self, later: i64) -> Self {
        let further = other.0.iter().map(|(place, way)| (place + later, Arc::clone(way)));
        Self(Arc::new(self.0.iter().map(|(place, way)| (*place, Arc::clone(way))).chain(further).collect()))
    }

    /// The way to a reading; none where only its own reference load came before.
    pub fn to(&self, reading: &Observation) -> Option<&Arc<LoadSequence>> {
        self.0.get(&reading.order?)
    }
}

/// Two rows to which a file gives one place in the sequence.
pub(crate) fn doubled_order(readings: &[Observation]) -> Option<[&Observation; 2]> {
    let mut first: HashMap<i64, &Observation> = HashMap::new();
    readings.iter().find_map(|one| {
        let other = *first.entry(one.order?).or_insert(one);
        (other.line != one.line).then_some([other, one])
    })
}

/// Loads before the reference reading, dated back from the age of the reference load.
fn loads_before(earlier: &[Observation], reading: &Observation) -> Vec<PastLoad> {
    let mut past = Vec::new();
    // When what stood last was taken off.
    let mut until = reading.reference_age.map(|age| -age);
    for (k, one) in earlier.iter().enumerate().rev() {
        let follows = k.checked_sub(1).map(|i| &earlier[i]).filter(|before| {
            before.reference_record.is_some() && before.reference_record == one.reference_record
        });
        let stood = one.elapsed - follows.map_or(0.0, |before| before.elapsed);
        let since = until.map(|until| until - stood.max(0.0));
        past.extend(loads_of(one, since, true).into_iter().rev());
        until = since;
        if follows.is_none() {
            let put_on = until.zip(one.reference_age).map(|(until, age)| until - age);
            past.push(PastLoad { wrench: one.reference, put_on, before_reference: true });
            until = put_on;
        }
    }
    past.reverse();
    past
}

/// The load of a reading, after what exceeded it.
fn loads_of(one: &Observation, put_on: Option<f64>, before_reference: bool) -> Vec<PastLoad> {
    let load = |wrench| PastLoad { wrench, put_on, before_reference };
    let exceeded =
        (one.approach == Approach::Overloaded).then(|| one.reference.beyond(&one.wrench, one.overload));
    exceeded.into_iter().chain([one.wrench]).map(load).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pose;

    fn reading(order: i64, record: Option<i64>, newtons: f64, elapsed: f64) -> Observation {
        let along_z = |force| Wrench::from_array([0.0, 0.0, force, 0.0, 0.0, 0.0]);
        Observation {
            line: order.unsigned_abs(),
            elapsed,
            reference_age: Some(7.0),
            reference_record: record,
            order: Some(order),
            ..Observation::unread(Pose::default(), along_z(newtons), along_z(1.0))
        }
    }

    /// Forces along z and times of the loads of a way.
    fn told(way: &LoadSequence) -> Vec<(f64, Option<f64>)> {
        way.past.iter().map(|load| (load.wrench.force.z, load.put_on)).collect()
    }

    #[test]
    fn loads_under_one_reference_follow_each_other() {
        let rows = [
            reading(30, Some(1), 30.0, 25.0),
            reading(10, Some(1), 10.0, 5.0),
            reading(20, Some(1), 20.0, 15.0),
        ];
        let ways = LoadSequence::of_all(&rows);
        assert_eq!(ways[1], None);
        let last = ways[0].as_ref().unwrap();
        assert_eq!(told(last), [(10.0, Some(0.0)), (20.0, Some(5.0))]);
        assert!((last.put_on - 15.0).abs() < 1e-12 && last.past.iter().all(|load| !load.before_reference));
    }

    #[test]
    fn a_reading_with_a_reference_of_its_own_returns_to_the_reference_load() {
        let mut rows = [reading(1, None, 10.0, 5.0), reading(2, None, 20.0, 6.0)];
        rows[0].approach = Approach::Overloaded;
        let way = LoadSequence::of_all(&rows)[1].clone().unwrap();
        // Reference at -19 s, loaded at -12 s (over 1 + 1.4 * 9), back at -7 s.
        assert_eq!(told(&way), [(1.0, Some(-19.0)), (13.6, Some(-12.0)), (10.0, Some(-12.0))]);
        assert!(way.put_on == 0.0 && way.past.iter().all(|load| load.before_reference));
        rows[1].reference_age = None;
        assert!(
            LoadSequence::of_all(&rows)[1].clone().unwrap().past.iter().all(|load| load.put_on.is_none())
        );
    }

    #[test]
    fn another_pose_begins_at_the_unloaded_machine() {
        let mut rows =
            [reading(1, Some(1), 10.0, 5.0), reading(2, Some(1), 20.0, 6.0), reading(3, Some(1), 30.0, 7.0)];
        rows[1].pose.translation.x = 0.01;
        assert_eq!(LoadSequence::of_all(&rows), [None, None, None]);
    }
}
