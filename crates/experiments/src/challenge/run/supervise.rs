//! Watching a program until it ends or must end, and ending all it started.

use std::io;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus};
use std::thread::sleep;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process_group, waitid};

use super::RunLimits;
use super::one::Watched;
use super::record::End;
use super::scratch::bytes_in;

/// Pauses between two looks grow from the first to the second, so that a short program is timed well and a long one in peace.
const PAUSES: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(20)];
/// Time between two looks at what was written, and at processes that left the group.
const SLOW: Duration = Duration::from_millis(250);
/// Signal of the system's own limit of the size of a file.
const SIGXFSZ: i32 = 25;

/// Starts a program in a group of its own and watches it; `root` is the folder it may write to. When this returns, neither the
/// program nor anything it started is running.
pub(super) fn watch(mut command: Command, limits: &RunLimits, root: &Path) -> io::Result<Watched> {
    let begun = Instant::now();
    let child = command.process_group(0).spawn()?;
    let mut watch = Watch { child, root, limits, begun, processes: Processes::default(), looked: begun };
    let broken = watch.until_it_ends();
    let wall_s = begun.elapsed().as_secs_f64();
    let status = watch.end()?;
    let broken = broken?.or_else(|| watch.has_written_too_much().then_some(End::OutputLimit));
    let (end, code) = ended(broken, status);
    Ok(Watched { end, code, wall_s, peak_memory_bytes: watch.processes.peak(), refused: None })
}

struct Watch<'a> {
    child: Child,
    root: &'a Path,
    limits: &'a RunLimits,
    begun: Instant,
    processes: Processes,
    looked: Instant,
}

impl Watch<'_> {
    /// The limit that was broken; none when the program ended by itself.
    fn until_it_ends(&mut self) -> io::Result<Option<End>> {
        let mut pause = PAUSES[0];
        loop {
            if let Some(broken) = self.broken() {
                return Ok(Some(broken));
            }
            if self.has_ended()? {
                return Ok(None);
            }
            sleep(pause);
            pause = (2 * pause).min(PAUSES[1]);
        }
    }

    /// Without reaping it: its number stays its own until all of its group is ended.
    fn has_ended(&self) -> io::Result<bool> {
        let only_look = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        Ok(waitid(WaitId::Pid(Pid::from_child(&self.child)), only_look)?.is_some())
    }

    fn broken(&mut self) -> Option<End> {
        let held = self.processes.look(&self.child);
        if self.begun.elapsed() > self.limits.time() {
            return Some(End::TimeLimit);
        }
        if held > self.limits.memory_bytes() {
            return Some(End::MemoryLimit);
        }
        if self.looked.elapsed() < SLOW {
            return None;
        }
        self.looked = Instant::now();
        self.processes.look_for_strays(self.root);
        self.has_written_too_much().then_some(End::OutputLimit)
    }

    /// A file stops at the limit, so that reaching it counts.
    fn has_written_too_much(&self) -> bool {
        bytes_in(self.root) >= self.limits.output_bytes()
    }

    /// Ends the group, what left it, and reaps the program.
    fn end(&mut self) -> io::Result<ExitStatus> {
        // An error means that there is no group any more.
        let _ = kill_process_group(Pid::from_child(&self.child), Signal::KILL);
        let status = self.child.wait();
        Processes::end_strays(self.root);
        status
    }
}

fn ended(broken: Option<End>, status: ExitStatus) -> (End, Option<i32>) {
    match (broken, status.code(), status.signal()) {
        (Some(end), ..) => (end, None),
        (None, _, Some(SIGXFSZ)) => (End::OutputLimit, None),
        (None, None, Some(signal)) => (End::Killed, Some(signal)),
        (None, code, _) => (End::Exited, code),
    }
}

#[cfg(target_os = "linux")]
use super::tree::Processes;

/// Where the system does not list processes: the group is ended, memory is limited for each process alone.
#[cfg(not(target_os = "linux"))]
#[derive(Debug, Default)]
struct Processes;

#[cfg(not(target_os = "linux"))]
impl Processes {
    fn look(&mut self, _: &Child) -> u64 {
        0
    }

    fn look_for_strays(&mut self, _: &Path) {}

    fn end_strays(_: &Path) {}

    fn peak(&self) -> Option<u64> {
        None
    }
}
