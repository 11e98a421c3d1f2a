//! Whether the memory that is free will do for a computation, told before it begins instead of by the system that ends it.
//!
//! ```text
//! needed = 0.6 KB * rows + conditions * (what the computation keeps of each)
//! free   = the least of what the system and every control group above this program have left
//! ```
//!
//! What is kept of a condition was measured: `docs/results/scaling.md`, 24 000 rows.

use std::fs;
use std::path::Path;

use hexbench_core::Dataset;
use hexbench_model::estimation::campaign::count_conditions;

use crate::Failure;

/// What a reading takes as it stands in its table, bytes.
const BYTES_PER_ROW: u64 = 600;
/// The program itself, bytes.
const PROGRAM_BYTES: u64 = 20 << 20;

/// What is computed of readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Computation {
    /// A fit of springs and terms.
    Fit,
    /// A comparison with a model.
    Comparison,
    /// A diagnosis, or a search for a law.
    Diagnosis,
}

impl Computation {
    fn words(self) -> &'static str {
        match self {
            Self::Fit => "a fit",
            Self::Comparison => "a comparison",
            Self::Diagnosis => "a diagnosis",
        }
    }

    /// What is kept of each condition, bytes: of a deflection, of an absolute pose.
    fn bytes_per_condition(self, is_absolute: bool) -> u64 {
        match (self, is_absolute) {
            (Self::Fit, false) => 5_500,
            (Self::Fit, true) => 3_400,
            (Self::Comparison, _) => 15_000,
            (Self::Diagnosis, _) => 40_000,
        }
    }

    /// What it takes of so many rows under so many conditions, bytes.
    pub fn bytes(self, rows: usize, conditions: usize, is_absolute: bool) -> u64 {
        let each = self.bytes_per_condition(is_absolute);
        PROGRAM_BYTES + (rows as u64) * BYTES_PER_ROW + (conditions as u64) * each
    }

    /// Refuses a computation that needs more memory than there is: `most` where it is given, else what is free.
    ///
    /// # Errors
    /// [`Failure::Memory`].
    pub fn refuse_beyond(self, data: &Dataset, most: Option<u64>) -> Result<(), Failure> {
        let [rows, conditions] = [data.observations.len(), count_conditions(data)];
        let needed_bytes = self.bytes(rows, conditions, data.is_absolute());
        let Some(free_bytes) = most.or_else(|| free_bytes(Path::new("/"))) else { return Ok(()) };
        if needed_bytes <= free_bytes {
            return Ok(());
        }
        Err(Failure::Memory { what: self.words(), rows, conditions, needed_bytes, free_bytes })
    }
}

/// What the system and the control groups of this program have left, bytes; none where neither says. `root` has `proc` and `sys`.
fn free_bytes(root: &Path) -> Option<u64> {
    let system = fs::read_to_string(root.join("proc/meminfo")).ok().and_then(|text| available_in(&text));
    system.into_iter().chain(left_in_groups(root)).min()
}

/// The line `MemAvailable:  1234 kB`.
fn available_in(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// What each control group with a limit has left: of version 2 the group of this program and those above it, of version 1 its own.
fn left_in_groups(root: &Path) -> Vec<u64> {
    let own = fs::read_to_string(root.join("proc/self/cgroup")).unwrap_or_default();
    let mounted = root.join("sys/fs/cgroup");
    let path = own.lines().find_map(|line| line.strip_prefix("0::/")).unwrap_or_default();
    let groups = Path::new(path).ancestors().map(|group| mounted.join(group));
    let second =
        groups.filter_map(|group| left_in(&group, ["memory.max", "memory.current", "inactive_file"]));
    let names = ["memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"];
    second.chain(left_in(&mounted.join("memory"), names)).collect()
}

/// Limit less use of a group, files that it would let go not counted as used.
fn left_in(group: &Path, [limit, used, reclaimable]: [&str; 3]) -> Option<u64> {
    let number = |name: &str| fs::read_to_string(group.join(name)).ok()?.trim().parse::<u64>().ok();
    let stat = fs::read_to_string(group.join("memory.stat")).unwrap_or_default();
    let files = stat.lines().find_map(|line| line.strip_prefix(reclaimable)?.trim().parse::<u64>().ok());
    Some(number(limit)?.saturating_sub(number(used)?.saturating_sub(files.unwrap_or(0))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(files: &[(&str, &str)]) -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = root.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        root
    }

    const MEMINFO: (&str, &str) = ("proc/meminfo", "MemTotal:  9000 kB\nMemAvailable:    8000 kB\n");

    #[test]
    fn what_is_free_is_the_least_of_system_and_groups() {
        let root = written(&[MEMINFO]);
        assert_eq!(free_bytes(root.path()), Some(8000 << 10));
        let root = written(&[
            MEMINFO,
            ("proc/self/cgroup", "0::/user/work\n"),
            ("sys/fs/cgroup/user/work/memory.max", "max\n"),
            ("sys/fs/cgroup/user/work/memory.current", "5\n"),
            ("sys/fs/cgroup/user/memory.max", "3000000\n"),
            ("sys/fs/cgroup/user/memory.current", "1000000\n"),
            ("sys/fs/cgroup/user/memory.stat", "anon 7\ninactive_file 400000\n"),
        ]);
        assert_eq!(free_bytes(root.path()), Some(2_400_000));
        let root = written(&[
            MEMINFO,
            ("sys/fs/cgroup/memory/memory.limit_in_bytes", "1000"),
            ("sys/fs/cgroup/memory/memory.usage_in_bytes", "1500"),
        ]);
        assert_eq!(free_bytes(root.path()), Some(0), "a group above its limit has nothing left");
        assert_eq!(free_bytes(written(&[]).path()), None);
    }

    /// Rows, and megabytes by command and kind of readings, as `docs/results/scaling.md` has them.
    fn measured(title: &str, command: &str) -> Vec<(usize, f64)> {
        let page = include_str!("../../../docs/results/scaling.md");
        let section = page.split("\n## ").find(|s| s.starts_with(title)).unwrap();
        let row = section.lines().find(|l| l.starts_with(&format!("| `{command}` |"))).unwrap();
        let cells = row.split('|').skip(2).zip([240, 2400, 24_000, 240_000]);
        let megabytes = |cell: &str| cell.split_once(',')?.1.trim().strip_suffix(" MB")?.parse().ok();
        cells.filter_map(|(cell, rows)| Some((rows, megabytes(cell)?))).collect()
    }

    /// How often every condition of that page is read.
    const READS: usize = 2;

    #[test]
    fn what_is_said_to_be_needed_is_what_was_measured() {
        let commands = [
            ("fit", Computation::Fit),
            ("compare", Computation::Comparison),
            ("diagnose", Computation::Diagnosis),
        ];
        for (title, is_absolute) in [("Deflections, sound", false), ("Absolute poses, sound", true)] {
            for (command, computation) in commands {
                let all = measured(title, command);
                assert!(all.len() >= 3, "{title} {command}: {all:?}");
                for (rows, megabytes) in all.into_iter().filter(|(rows, _)| *rows >= 24_000) {
                    let said = computation.bytes(rows, rows / READS, is_absolute) as f64 / 1e6;
                    assert!(
                        (0.9..1.6).contains(&(said / megabytes)),
                        "{title} {command} {rows}: {said} {megabytes}"
                    );
                }
            }
        }
    }
}
