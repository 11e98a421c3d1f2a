//! The processes of a program on Linux: what they hold, and those that left its group.
//!
//! Children are found from their parent. One that let its parent die, or began a session of its own, is found by its environment,
//! which names the folder of this run, or by its working directory. A process that leaves both behind is not found; the
//! system's limits on its CPU time, memory and files stay with it.

use std::fs;
use std::path::Path;
use std::process::Child;
use std::thread::sleep;
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};

/// Rounds of ending what is found; each ends all that was there at one moment.
const MOST_ROUNDS: usize = 1000;
/// Time for what was ended to go away.
const PAUSE: Duration = Duration::from_millis(1);

/// What is known of the processes of one run.
#[derive(Debug, Default)]
pub(super) struct Processes {
    strays: Vec<i32>,
    peak: Option<u64>,
}

impl Processes {
    /// Memory that all processes hold now, bytes.
    pub(super) fn look(&mut self, program: &Child) -> u64 {
        let mut found: Vec<i32> =
            i32::try_from(program.id()).into_iter().chain(self.strays.iter().copied()).collect();
        let mut next = 0;
        while let Some(&pid) = found.get(next) {
            next += 1;
            let fresh: Vec<i32> = children(pid).into_iter().filter(|child| !found.contains(child)).collect();
            found.extend(fresh);
        }
        let sizes: Vec<Memory> = found.iter().filter_map(|&pid| Memory::of(pid)).collect();
        let now: u64 = sizes.iter().map(|m| m.now).sum();
        let highest = sizes.iter().map(|m| m.highest).max().unwrap_or(0).max(now);
        self.peak = Some(self.peak.unwrap_or(0).max(highest));
        now
    }

    /// Finds the processes that belong to the folder of this run.
    pub(super) fn look_for_strays(&mut self, root: &Path) {
        self.strays = named(root);
    }

    /// Ends them until there is none.
    pub(super) fn end_strays(root: &Path) {
        for _ in 0..MOST_ROUNDS {
            let found = named(root);
            if found.is_empty() {
                return;
            }
            for pid in found.into_iter().filter_map(Pid::from_raw) {
                // An error means that it has ended.
                let _ = kill_process(pid, Signal::KILL);
            }
            sleep(PAUSE);
        }
    }

    /// Most memory held at a time, bytes.
    pub(super) fn peak(&self) -> Option<u64> {
        self.peak.filter(|&bytes| bytes > 0)
    }
}

struct Memory {
    now: u64,
    highest: u64,
}

impl Memory {
    fn of(pid: i32) -> Option<Self> {
        let status = fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
        let bytes = |key: &str| {
            let line = status.lines().find_map(|line| line.strip_prefix(key))?;
            Some(1024 * line.split_whitespace().next()?.parse::<u64>().ok()?)
        };
        Some(Self { now: bytes("VmRSS:")?, highest: bytes("VmHWM:")? })
    }
}

fn children(pid: i32) -> Vec<i32> {
    let Ok(tasks) = fs::read_dir(format!("/proc/{pid}/task")) else { return Vec::new() };
    let of_task = |task: fs::DirEntry| fs::read_to_string(task.path().join("children")).unwrap_or_default();
    let lists: Vec<String> = tasks.flatten().map(of_task).collect();
    lists.iter().flat_map(|list| list.split_whitespace()).filter_map(|word| word.parse().ok()).collect()
}

/// Living processes that stand in the folder, or with a variable of the environment that names it.
fn named(root: &Path) -> Vec<i32> {
    let wanted = format!("TMPDIR={}/", root.display()).into_bytes();
    let Ok(entries) = fs::read_dir("/proc") else { return Vec::new() };
    let pids = entries.flatten().filter_map(|entry| entry.file_name().to_str()?.parse::<i32>().ok());
    let is_ours = |pid: &i32| {
        let environment = fs::read(format!("/proc/{pid}/environ")).unwrap_or_default();
        let stands_in =
            fs::read_link(format!("/proc/{pid}/cwd")).is_ok_and(|folder| folder.starts_with(root));
        stands_in || environment.split(|byte| *byte == 0).any(|variable| variable.starts_with(&wanted))
    };
    pids.filter(is_ours).collect()
}
