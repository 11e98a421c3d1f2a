//! Places that cannot take an output, and outputs that would destroy something.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use super::bench::{Bench, FEW, Run, Share};
use super::fate::Fate;
use crate::support::complaint;

/// What a file was before.
const OLD: &str = "old";

/// A case of a shell: `$0` is the command, 99 says that the system does not let a test do this.
struct Shell {
    script: &'static str,
    /// Exit code that is right.
    code: i32,
    /// Files that must be as they were: with [`OLD`] in them.
    kept: &'static [&'static str],
}

fn shell(bench: &Bench, script: &str) -> Output {
    Command::new("sh")
        .current_dir(bench.path())
        .args(["-c", script, env!("CARGO_BIN_EXE_hexbench")])
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

impl Shell {
    fn fate(&self) -> Fate {
        let bench = sound();
        self.kept.iter().for_each(|name| bench.write(name, OLD));
        let output = shell(&bench, self.script);
        let said = complaint(&output);
        let code = output.status.code();
        if code == Some(99) {
            return Fate::Skipped;
        }
        let left = remains(bench.path());
        let is_kept =
            self.kept.iter().all(|name| fs::read_to_string(bench.at(name)).is_ok_and(|text| text == OLD));
        if code != Some(self.code) || !is_kept || !left.is_empty() {
            return Fate::Broken(format!("{}: {code:?}, kept {is_kept}, {left:?}: {said}", self.script));
        }
        if self.code == 0 {
            Fate::Survived
        } else {
            Fate::of_refusal(&Run { code, said, shown: output.stdout })
        }
    }
}

fn sound() -> Bench {
    Bench::with(&FEW.machine, FEW.readings.text())
}

/// Temporary files in a folder.
pub(super) fn remains(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    names.filter(|name| Path::new(name).extension().is_some_and(|end| end == "part")).collect()
}

/// A case that has to end with this code, and leave `x` as it was.
const fn kept(code: i32, script: &'static str) -> Shell {
    Shell { script, code, kept: &["x"] }
}

/// A case that has to end with this code.
const fn ends(code: i32, script: &'static str) -> Shell {
    Shell { script, code, kept: &[] }
}

/// Disks, limits, streams.
pub(super) fn disks(share: Share) -> Vec<Fate> {
    let cases = [
        kept(5, "ulimit -f 1; exec \"$0\" fit hexapod.toml measurements.csv --json x"),
        kept(5, "ulimit -f 1; exec \"$0\" compare hexapod.toml measurements.csv --html x"),
        kept(5, "ulimit -f 0; exec \"$0\" fit hexapod.toml measurements.csv -o x"),
        kept(5, "exec \"$0\" fit hexapod.toml measurements.csv -o none/x"),
        kept(5, "exec \"$0\" fit hexapod.toml measurements.csv -o ."),
        kept(5, "exec \"$0\" fit hexapod.toml measurements.csv -o x/y"),
        kept(5, "exec \"$0\" fit hexapod.toml measurements.csv -o x/"),
        kept(5, "exec \"$0\" fit hexapod.toml measurements.csv >/dev/full"),
        kept(5, "exec \"$0\" fit hexapod.toml measurements.csv --json - >/dev/full"),
        ends(0, "\"$0\" fit hexapod.toml measurements.csv 2>said | head -c 1 >shown; test ! -s said"),
        ends(0, "\"$0\" diagnose hexapod.toml measurements.csv --json - 2>said | true; test ! -s said"),
        ends(0, "\"$0\" fit hexapod.toml measurements.csv 2>&-"),
        ends(3, "exec \"$0\" fit hexapod.toml - </dev/null"),
        ends(5, "exec \"$0\" fit hexapod.toml none.csv"),
        ends(5, "exec \"$0\" fit hexapod.toml ."),
        ends(3, "exec \"$0\" fit hexapod.toml /dev/null"),
        ends(5, "ln -s circle circle; exec \"$0\" fit hexapod.toml measurements.csv -o circle"),
        ends(5, "ln -s circle circle; exec \"$0\" fit hexapod.toml circle"),
        ends(
            0,
            "unshare -m sh -c 'mount -t tmpfs -o size=16k none . || exit 99; exit 0' 2>/dev/null || exit 99
            mkdir disk; unshare -m sh -c 'mount -t tmpfs -o size=16k none disk; echo old >disk/x
            \"$0\" compare hexapod.toml measurements.csv --html disk/x 2>said; test $? = 5 && test \"$(cat disk/x)\" = old \
            && test \"$(ls -A disk)\" = x && grep -q next: said' \"$0\"",
        ),
    ];
    share.each(&cases, Shell::fate)
}

/// Devices, pipes, links, inputs.
pub(super) fn outputs(share: Share) -> Vec<Fate> {
    let cases = [
        kept(2, "ln x y; exec \"$0\" fit hexapod.toml measurements.csv -o hexapod.toml"),
        kept(2, "ln measurements.csv y; exec \"$0\" fit hexapod.toml measurements.csv -o y"),
        kept(2, "ln -s measurements.csv y; exec \"$0\" compare hexapod.toml measurements.csv --json y"),
        kept(2, "exec \"$0\" compare hexapod.toml measurements.csv --json ./x --html x"),
        kept(2, "exec \"$0\" compare hexapod.toml measurements.csv --json - --html -"),
        kept(2, "exec \"$0\" compare hexapod.toml measurements.csv --json x >>measurements.csv"),
        kept(0, "\"$0\" fit hexapod.toml measurements.csv -o /dev/null && test -c /dev/null"),
        kept(
            0,
            "\"$0\" compare hexapod.toml measurements.csv --json /dev/stdout >y && grep -q format y && test -c /dev/null",
        ),
        kept(
            0,
            "mkfifo p; cat p >y & \"$0\" compare hexapod.toml measurements.csv --json p && wait && test -p p && grep -q format y",
        ),
        kept(0, "ln -s y l; \"$0\" fit hexapod.toml measurements.csv -o l && test -L l && grep -q model y"),
        kept(
            0,
            "mknod d c 1 3 2>/dev/null || exit 99; \"$0\" fit hexapod.toml measurements.csv -o d && test -c d",
        ),
        kept(
            5,
            "mknod d c 1 7 2>/dev/null || exit 99; \"$0\" fit hexapod.toml measurements.csv -o d; r=$?; test -c d && exit $r",
        ),
        kept(0, "echo half >.hexbench-dead.part; exec \"$0\" fit hexapod.toml measurements.csv -o y"),
    ];
    share.each(&cases, Shell::fate)
}

/// What a user of the system may not do; root, who may do everything, becomes one that is nobody.
struct Forbidden {
    /// Run as the owner of the folder before.
    prepare: &'static str,
    words: &'static str,
    code: i32,
}

/// What a user may not do.
pub(super) fn permissions(share: Share) -> Vec<Fate> {
    let cases = [
        Forbidden { prepare: "chmod 555 .", words: "fit hexapod.toml measurements.csv -o x", code: 5 },
        Forbidden { prepare: "chmod 555 .", words: "fit hexapod.toml measurements.csv -o new", code: 5 },
        Forbidden { prepare: "chmod 444 x", words: "fit hexapod.toml measurements.csv -o x", code: 5 },
        Forbidden {
            prepare: "chmod 444 x; ln -s x l",
            words: "fit hexapod.toml measurements.csv --json l",
            code: 5,
        },
        Forbidden { prepare: "mkdir -m 0 d", words: "fit hexapod.toml measurements.csv -o d/x", code: 5 },
        Forbidden { prepare: "mkdir -m 500 d", words: "simulate scene -o d/out", code: 5 },
        Forbidden { prepare: "mkdir -m 500 out", words: "study study.toml -o out", code: 5 },
        Forbidden {
            prepare: "mkdir -m 500 out",
            words: "challenge make springs-and-effects -o out/suite",
            code: 5,
        },
        Forbidden {
            prepare: "chmod 0 measurements.csv",
            words: "fit hexapod.toml measurements.csv -o x",
            code: 5,
        },
        Forbidden {
            prepare: "chmod 0 hexapod.toml",
            words: "fit hexapod.toml measurements.csv -o x",
            code: 5,
        },
        Forbidden { prepare: "mkfifo -m 400 p", words: "fit hexapod.toml measurements.csv -o p", code: 5 },
    ];
    share.each(&cases, Forbidden::fate)
}

impl Forbidden {
    fn fate(&self) -> Fate {
        let bench = sound();
        bench.write("x", OLD);
        bench.write("study.toml", super::keys::STUDY);
        let Some(user) = User::of(&bench) else { return Fate::Skipped };
        let script =
            format!("cp -r {}/scenes/hidden-1 scene; {}", crate::support::root().display(), self.prepare);
        assert!(user.shell(&script).status.success(), "{}", self.prepare);
        let output = user.shell(&format!("exec ./hexbench {}", self.words));
        let said = complaint(&output);
        let code = output.status.code();
        let after = fs::read_to_string(bench.at("x")).unwrap();
        let left = remains(bench.path());
        // The folder is to be removed, by a user who may be another.
        user.shell("chmod -R u+rwx .");
        if code != Some(self.code) || after != OLD || !left.is_empty() || !said.contains("next: ") {
            return Fate::Broken(format!(
                "{}: {}: {code:?}, {after}, {left:?}: {said}",
                self.prepare, self.words
            ));
        }
        Fate::of_refusal(&Run { code, said, shown: output.stdout })
    }
}

/// Who runs the command in a folder.
struct User<'a> {
    bench: &'a Bench,
    /// What a shell is run by.
    becoming: &'static [&'static str],
}

impl<'a> User<'a> {
    /// An ordinary user with the command in the folder; none where there is no way to become one.
    fn of(bench: &'a Bench) -> Option<Self> {
        let command = Path::new(env!("CARGO_BIN_EXE_hexbench"));
        if std::os::unix::fs::symlink(command, bench.at("hexbench")).is_err() {
            return None;
        }
        let is_root = shell(bench, "test \"$(id -u)\" = 0").status.success();
        let becoming: &[&str] =
            if is_root { &["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] } else { &[] };
        let user = Self { bench, becoming };
        if is_root && !shell(bench, "chown -R 65534:65534 .").status.success() {
            return None;
        }
        // Another user may not reach the folder that the command lies in.
        user.shell("./hexbench --version").status.success().then_some(user)
    }

    fn shell(&self, script: &str) -> Output {
        let words = [self.becoming, &["sh", "-c", script]].concat();
        let ended = Command::new(words[0])
            .args(&words[1..])
            .current_dir(self.bench.path())
            .stdin(Stdio::null())
            .output();
        ended.unwrap_or_else(|_| Command::new("false").output().unwrap())
    }
}
