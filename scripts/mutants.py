"""Mutants of the libraries: constants doubled, conditions negated, results scaled, one at a time, and which of them no test notices.

`scripts/mutants.sh` calls this. All mutants of a crate are in one build, each behind a number that HEXBENCH_MUTANT names: a mutant costs
a run of the tests, not a compilation.

    const NAME: f64            uses of NAME in its file become  of(k, NAME)      twice as large
    if CONDITION {             becomes                          if on(k) != (CONDITION) {
    -> f64 { EXPRESSION }      becomes                          of(k, EXPRESSION), or its negative
    -> bool { EXPRESSION }     becomes                          on(k) != (EXPRESSION)
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
GATE = """
/// Mutants of this build; none is at work unless HEXBENCH_MUTANT names it.
#[allow(missing_docs, dead_code)]
pub(crate) mod mutants {
    fn chosen() -> u32 {
        static CHOSEN: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
        *CHOSEN.get_or_init(|| std::env::var("HEXBENCH_MUTANT").ok().and_then(|k| k.parse().ok()).unwrap_or(0))
    }
    pub(crate) fn on(k: u32) -> bool {
        chosen() == k
    }
    pub(crate) fn of(k: u32, x: f64) -> f64 {
        if on(k) { 2.0 * x } else { x }
    }
    pub(crate) fn minus(k: u32, x: f64) -> f64 {
        if on(k) { -x } else { x }
    }
}
"""
# A test that takes longer without a mutant is not asked of every mutant.
MOST_SECONDS = 0.6
# Tests of the command that are asked of every mutant: what it says of every bundled case.
PAGES = ["pages::", "score::"]
# A mutant that makes the tests take so much longer is noticed: it hangs.
LIMIT_SECONDS = 120
CONSTANT = re.compile(r"^\s*(?:pub(?:\([a-z]+\))? )?const ([A-Z][A-Z0-9_]*): f64 = .*;")
CONDITION = re.compile(r"^(\s*)if (?!let\b)([^{}]+) \{$")
RESULT = re.compile(r"\) -> (f64|bool) \{$")


@dataclass
class Mutant:
    """One change, and what became of it."""

    number: int
    file: str
    line: int
    what: str
    fate: str = "not run"


def body(lines: list[str]) -> int:
    """How many lines stand before the tests of a file."""
    return next((k for k, line in enumerate(lines) if line.startswith("#[cfg(test)]")), len(lines))


def is_code(line: str) -> bool:
    """False for comments, attributes and declarations of constants, which are computed by the compiler."""
    bare = line.strip()
    return not bare.startswith(("//", "#", "const ", "pub const ", "pub(crate) const ", "pub(super) const ", "static ", "use "))


def constants(file: str, lines: list[str], mutants: list[Mutant]) -> None:
    for at in range(body(lines)):
        found = CONSTANT.match(lines[at])
        if not found or not lines[at].startswith(("const", "pub")):
            continue
        use = re.compile(rf"(?<![\w:.]){found[1]}\b(?!\s*[:(!])")
        uses = [k for k in range(body(lines)) if is_code(lines[k]) and use.search(lines[k]) and '"' not in lines[k]]
        if not uses:
            continue
        number = len(mutants) + 1
        for k in uses:
            lines[k] = use.sub(f"crate::mutants::of({number}, {found[1]})", lines[k])
        mutants.append(Mutant(number, file, at + 1, f"{found[1]} twice as large"))


def conditions(file: str, lines: list[str], mutants: list[Mutant]) -> None:
    for at in range(body(lines)):
        found = CONDITION.match(lines[at])
        if found and " let " not in f" {found[2]}" and "mutants::" not in lines[at]:
            number = len(mutants) + 1
            lines[at] = f"{found[1]}if crate::mutants::on({number}) != ({found[2]}) {{"
            mutants.append(Mutant(number, file, at + 1, f"if not ({found[2]})"))


def results(file: str, lines: list[str], mutants: list[Mutant]) -> None:
    for at in range(body(lines) - 2):
        found = RESULT.search(lines[at])
        expression = lines[at + 1].strip()
        is_same = expression in ("0.0", "f64::INFINITY", "f64::NEG_INFINITY", "f64::NAN")
        if not found or is_same or lines[at + 2].strip() != "}" or expression.endswith(";") or "const fn" in lines[at]:
            continue
        number = len(mutants) + 1
        if found[1] == "bool":
            changed, what = f"crate::mutants::on({number}) != ({expression})", "negated"
        else:
            name = "minus" if number % 2 else "of"
            changed, what = f"crate::mutants::{name}({number}, {expression})", "negative" if number % 2 else "doubled"
        lines[at + 1] = changed
        mutants.append(Mutant(number, file, at + 2, f"{expression} {what}"))


def plant(crate: str, tree: Path, dropped: set[tuple[str, int]]) -> list[Mutant]:
    """Plants all mutants of a crate in the copy of its sources; a line that does not compile is left as it is."""
    mutants: list[Mutant] = []
    source = ROOT / "crates" / crate / "src"
    for path in sorted(source.rglob("*.rs")):
        file = str(path.relative_to(ROOT))
        old = path.read_text().split("\n")
        lines = list(old)
        for plant_kind in (constants, conditions, results):
            plant_kind(file, lines, mutants)
        lines = [old[k] if (file, k + 1) in dropped else line for k, line in enumerate(lines)]
        (tree / file).write_text("\n".join(lines) + (GATE if path.name == "lib.rs" else ""))
    return mutants


def build(crate: str, tree: Path) -> tuple[list[str], set[tuple[str, int]]]:
    """Test programs of a crate, or the lines that do not compile."""
    programs, wrong = [], set()
    for words in (["-p", f"hexbench-{crate}", "--lib"], ["--workspace", "--test", crate], ["--workspace", "--test", "cli"]):
        command = ["cargo", "test", *words, "--no-run", "--offline", "--message-format=json"]
        done = subprocess.run(command, cwd=tree, capture_output=True, text=True)
        for line in done.stdout.splitlines():
            message = json.loads(line)
            if message.get("executable") and message["target"]["name"] in (crate, f"hexbench_{crate}", "cli"):
                programs.append(message["executable"])
            if message.get("reason") == "compiler-message" and message["message"]["level"] == "error":
                wrong |= {(s["file_name"], s["line_start"]) for s in message["message"]["spans"]}
        if done.returncode and not wrong:
            sys.exit(done.stderr)
        if wrong:
            break
    return sorted(set(programs)), wrong


def fast_tests(program: str, folder: Path) -> list[str]:
    """Tests of a program that take little time."""
    told = ["-Z", "unstable-options", "--report-time", "--test-threads=2"]
    environment = {**os.environ, "RUSTC_BOOTSTRAP": "1", "RUST_BACKTRACE": "0"}
    done = subprocess.run([program, *told], cwd=folder, env=environment, capture_output=True, text=True)
    found = re.findall(r"^test (\S+)(?: - .*)? \.\.\. ok <([0-9.]+)s>", done.stdout, re.MULTILINE)
    if not found:
        sys.exit(f"{program}: no test without a mutant passes\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return [name for name, seconds in found if float(seconds) <= MOST_SECONDS]


@dataclass
class Asked:
    """A test program, and what of it is asked about every mutant."""

    program: str
    words: list[str]
    folder: Path


def fate(mutant: Mutant, programs: list[Asked]) -> str:
    """Whether a program notices a mutant."""
    environment = {**os.environ, "HEXBENCH_MUTANT": str(mutant.number), "RUST_BACKTRACE": "0", "INSTA_UPDATE": "no"}
    for asked in programs:
        try:
            words = [asked.program, "--quiet", *asked.words]
            done = subprocess.run(words, cwd=asked.folder, env=environment, capture_output=True, timeout=LIMIT_SECONDS)
        except subprocess.TimeoutExpired:
            return "killed (hangs)"
        if done.returncode:
            return "killed"
    return "survived"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("crate")
    parser.add_argument("--within", default="", help="only files whose path holds this")
    parser.add_argument("--every", type=int, default=1, help="every so many mutants")
    parser.add_argument("--survivors", type=Path, help="only those that survived in this output of an earlier run")
    parser.add_argument("--work", type=Path, default=ROOT / "target/mutants")
    arguments = parser.parse_args()
    tree = arguments.work / "tree"
    shutil.rmtree(tree, ignore_errors=True)
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in filter(None, listed.stdout.split("\0")):
        if (ROOT / name).is_file():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, tree / name)
    os.environ.setdefault("CARGO_TARGET_DIR", str(arguments.work / "target"))
    dropped: set[tuple[str, int]] = set()
    while True:
        mutants = plant(arguments.crate, tree, dropped)
        programs, wrong = build(arguments.crate, tree)
        if not wrong:
            break
        if wrong <= dropped:
            sys.exit(f"lines that do not compile: {sorted(wrong)}")
        dropped |= wrong
    chosen = [m for m in mutants if (m.file, m.line) not in dropped and arguments.within in m.file][:: arguments.every]
    if arguments.survivors:
        before = {tuple(line.split("\t")[1:]) for line in arguments.survivors.read_text().splitlines() if line.startswith("survived")}
        chosen = [m for m in mutants if (f"{m.file}:{m.line}", m.what) in before]
    asked = []
    for program in sorted(programs, key=lambda p: ("/cli-" in p, "hexbench_" not in p)):
        folder = tree / "crates" / ("cli" if "/cli-" in program else arguments.crate)
        words = PAGES if "/cli-" in program else ["--exact", *fast_tests(program, folder)]
        asked.append(Asked(program, words, folder))
    print(f"{arguments.crate}: {len(chosen)} of {len(mutants)} mutants", flush=True)
    for mutant in chosen:
        mutant.fate = fate(mutant, asked)
        print(f"{mutant.fate}\t{mutant.file}:{mutant.line}\t{mutant.what}", flush=True)
    killed = sum(m.fate.startswith("killed") for m in chosen)
    print(f"{arguments.crate}: {killed} of {len(chosen)} killed")


if __name__ == "__main__":
    main()
