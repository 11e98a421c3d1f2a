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
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# HEXBENCH_MUTANTS_REACHED is a file to which every mutant whose line is run adds its number.
GATE = """
/// Mutants of this build; none is at work unless HEXBENCH_MUTANT names it.
#[allow(missing_docs, dead_code, clippy::all)]
pub(crate) mod mutants {
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
    static REACHED: [AtomicBool; 4096] = [const { AtomicBool::new(false) }; 4096];
    fn watch(k: u32) {
        static FILE: OnceLock<Option<std::ffi::OsString>> = OnceLock::new();
        let Some(file) = FILE.get_or_init(|| std::env::var_os("HEXBENCH_MUTANTS_REACHED")) else { return };
        let reached = &REACHED[k as usize];
        if !reached.load(Relaxed) && !reached.swap(true, Relaxed) {
            let mut file = std::fs::OpenOptions::new().append(true).create(true).open(file).unwrap();
            std::io::Write::write_all(&mut file, format!("{k}\\n").as_bytes()).unwrap();
        }
    }
    pub(crate) fn on(k: u32) -> bool {
        static CHOSEN: OnceLock<u32> = OnceLock::new();
        watch(k);
        k == *CHOSEN.get_or_init(|| std::env::var("HEXBENCH_MUTANT").ok().and_then(|k| k.parse().ok()).unwrap_or(0))
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
MOST_SECONDS = 1.0
# Tests are asked in groups that take about so long; after a group that notices, no other is asked.
GROUP_SECONDS = 2.0
# A mutant that makes a group of tests or a page take so much longer is noticed: it hangs.
LIMIT_SECONDS = 40
# What runs at once.
WORKERS = 2
# Pages about a case, by the shell: `h` is the command, `files` its two files, `d` a folder that is gone afterwards.
COMMANDS = 'd=$(mktemp -d); trap "rm -r $d" EXIT; h=$0; files="hexapod.toml measurements.csv"; '
PAGES = [
    "$h check $files",
    "$h diagnose $files --holdout holdout.csv",
    "$h diagnose $files --holdout holdout.csv --html -",
    "$h diagnose $files --exclude 4 --keep-all",
    "$h compare $files --holdout holdout.csv --html -",
    "$h compare $files --table $d/t.csv --gltf $d/m.glb > $d/page; cat $d/t.csv $d/m.glb",
    "$h discover $files --html -",
    "$h fit $files -q -o $d/m.toml; $h stiffness $d/m.toml -v; $h stiffness $d/m.toml --map 20 --load 0,0,-200,0,0,0 --html -",
    """$h diagnose $files -q --json $d/a.json; $h diagnose hexapod.toml holdout.csv -q --json $d/b.json
    $h diagnose $files -q --exclude 4 --json $d/c.json; cd $d; $h runs a.json b.json; $h runs a.json b.json c.json
    $h runs a.json b.json c.json --dates 2026-01-12,2026-02-09,2026-03-10 --html -""",
]
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
        is_whole = found and " let " not in f" {found[2]}" and found[2].count("(") == found[2].count(")")
        if is_whole and "mutants::" not in lines[at]:
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
        plain = re.sub(r"crate::mutants::of\(\d+, (\w+)\)", r"\1", expression)
        if found[1] == "bool":
            changed, what = f"crate::mutants::on({number}) != ({expression})", "negated"
        else:
            name = "minus" if number % 2 else "of"
            changed, what = f"crate::mutants::{name}({number}, {expression})", "negative" if number % 2 else "doubled"
        lines[at + 1] = changed
        mutants.append(Mutant(number, file, at + 2, f"{plain} {what}"))


def sources(crate: str) -> list[Path]:
    """Files of a crate that are no tests."""
    return [path for path in sorted((ROOT / "crates" / crate / "src").rglob("*.rs")) if path.name != "tests.rs"]


def plant(crates: list[str], tree: Path, dropped: set[tuple[str, int]]) -> list[Mutant]:
    """Plants all mutants of some crates in the copy of their sources; a line that does not compile is left as it is."""
    mutants: list[Mutant] = []
    for path in (path for crate in crates for path in sources(crate)):
        file = str(path.relative_to(ROOT))
        old = path.read_text().split("\n")
        lines = list(old)
        for plant_kind in (constants, conditions, results):
            plant_kind(file, lines, mutants)
        lines = [old[k] if (file, k + 1) in dropped else line for k, line in enumerate(lines)]
        (tree / file).write_text("\n".join(lines) + (GATE if path.name == "lib.rs" else ""))
    return mutants


def copy_sources(crates: list[str], tree: Path, with_pages: bool, quick: list[str]) -> None:
    """Copies the sources, so that of all tests only those of the crates are built; and the command, where its pages are asked."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in filter(None, listed.stdout.split("\0")):
        if (ROOT / name).is_file() and not name.startswith("crates/cli/tests/"):
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, tree / name)
    for crate in quick:
        workspace, package = tree / "Cargo.toml", tree / f"crates/{crate}/Cargo.toml"
        level = f"hexbench-{crate}.opt-level ="
        workspace.write_text(workspace.read_text().replace(f"{level} 3", f"{level} 1\nhexbench-{crate}.debug = false"))
        package.write_text(package.read_text().replace("[package]", "[package]\nautotests = false"))
    for manifest in [*tree.glob("crates/*/Cargo.toml"), tree / "fuzz/Cargo.toml"]:
        if manifest.parent.name not in crates:
            words = manifest.read_text().replace("[package]", "[package]\nautotests = false").replace("test = true", "test = false")
            manifest.write_text(words if "[lib]" in words else f"{words}\n[lib]\ntest = false\n")
    if not with_pages:
        return
    # The command is built for the tests of its crate, though there are none.
    (tree / "crates/cli/no_tests.rs").write_text("")
    with (tree / "crates/cli/Cargo.toml").open("a") as manifest:
        manifest.write('\n[[test]]\nname = "no_tests"\npath = "no_tests.rs"\n')


def build(tree: Path) -> tuple[dict[str, Path], set[tuple[str, int]]]:
    """Test programs, each with the folder of its crate, or the lines that do not compile."""
    programs, wrong = {}, set()
    command = ["cargo", "test", "--workspace", "--tests", "--no-run", "--offline", "--message-format=json"]
    done = subprocess.run(command, cwd=tree, capture_output=True, text=True)
    for line in done.stdout.splitlines():
        message = json.loads(line)
        if message.get("executable"):
            programs[message["executable"]] = Path(message["manifest_path"]).parent
        if message.get("reason") == "compiler-message" and message["message"]["level"] == "error":
            wrong |= {(s["file_name"], s["line_start"]) for s in message["message"]["spans"]}
    if done.returncode and not wrong:
        sys.exit(done.stderr)
    return programs, wrong


@dataclass
class Question:
    """A test, or a page of the command, and the mutants whose lines it runs."""

    command: list[str]
    folder: Path
    name: str = ""
    seconds: float = 0.0
    reached: set[int] = field(default_factory=set)
    answer: bytes = b""


def questions(programs: dict[str, Path], tree: Path) -> tuple[list[Question], list[Question]]:
    """All tests of the programs, and the pages of the command about the demo and every bundled case."""
    tests = []
    for program, folder in programs.items():
        if Path(program).name != "hexbench" and folder.name != "cli":
            told = subprocess.run([program, "--list", "--format", "terse"], cwd=folder, capture_output=True, text=True, check=True)
            tests += [Question([program], folder, name) for name in re.findall(r"^(\S+): test$", told.stdout, re.MULTILINE)]
    command = next((p for p in programs if Path(p).name == "hexbench"), None)
    if command is None:
        return tests, []
    cases = [path.parent for path in sorted(tree.glob("data/cases/*/truth.json"))]
    pages = [Question(["sh", "-c", COMMANDS + page, command], case) for page in PAGES for case in cases]
    return tests, [Question([command, "demo", "--no-report"], tree), *pages]


def run(question: Question, words: list[str], limit: float, **more: str) -> subprocess.CompletedProcess:
    environment = {**os.environ, "RUST_BACKTRACE": "0", "INSTA_UPDATE": "no", **more}
    return subprocess.run([*question.command, *words], cwd=question.folder, env=environment, capture_output=True, timeout=limit)


def without_mutant(question: Question) -> bool:
    """Asks a question alone, notes what it takes, runs and answers; False if that takes too long, or fails."""
    words, limit = (["--exact", question.name], MOST_SECONDS) if question.name else ([], LIMIT_SECONDS)
    with tempfile.TemporaryDirectory() as folder:
        reached = Path(folder) / "reached"
        begun = time.monotonic()
        try:
            done = run(question, words, limit, HEXBENCH_MUTANTS_REACHED=str(reached))
        except subprocess.TimeoutExpired:
            return False
        question.seconds = time.monotonic() - begun
        question.reached = {int(k) for k in reached.read_text().split()} if reached.exists() else set()
        question.answer = done.stdout
    return done.returncode == 0


def groups(tests: list[Question]) -> list[list[Question]]:
    """Tests in groups of one program, the fastest first."""
    made: list[list[Question]] = []
    for test in sorted(tests, key=lambda t: (t.command, t.seconds)):
        is_room = made and made[-1][0].command == test.command and sum(t.seconds for t in made[-1]) < GROUP_SECONDS
        made[-1].append(test) if is_room else made.append([test])
    return sorted(made, key=lambda group: sum(t.seconds for t in group))


def fate(mutant: Mutant, tests: list[Question], pages: list[Question]) -> str:
    """What notices a mutant."""
    number = {"HEXBENCH_MUTANT": str(mutant.number)}
    able = [t for t in tests if mutant.number in t.reached]
    read = sorted((p for p in pages if mutant.number in p.reached), key=lambda p: p.seconds)
    try:
        for group in groups(able):
            done = run(group[0], ["--exact", "--test-threads=1", *(t.name for t in group)], LIMIT_SECONDS, **number)
            if done.returncode:
                failed = re.search(r"^test (\S+).* FAILED$", done.stdout.decode(errors="replace"), re.MULTILINE)
                return f"killed by {failed[1] if failed else 'the end of the program'}"
        for page in read:
            if run(page, [], LIMIT_SECONDS, **number).stdout != page.answer:
                return f"killed by a page of {page.folder.name}"
    except subprocess.TimeoutExpired:
        return "killed, hangs"
    return f"survived {len(able)} tests and {len(read)} pages"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("crates", nargs="+", metavar="CRATE")
    parser.add_argument("--within", default="", help="only files whose path this regular expression finds")
    parser.add_argument("--every", type=int, default=1, help="every so many mutants")
    parser.add_argument("--survivors", type=Path, help="only those that survived in this output of an earlier run")
    parser.add_argument("--no-pages", action="store_true", help="without the command: half the time to build")
    parser.add_argument("--page-seconds", type=float, default=LIMIT_SECONDS, help="pages that take longer are not asked")
    parser.add_argument("--quick", action="append", default=[], metavar="CRATE", help="hardly optimized, and unit tests only")
    parser.add_argument("--work", type=Path, default=ROOT / "target/mutants")
    arguments = parser.parse_args()
    tree = arguments.work / "tree"
    shutil.rmtree(tree, ignore_errors=True)
    copy_sources(arguments.crates, tree, not arguments.no_pages, arguments.quick)
    os.environ.setdefault("CARGO_TARGET_DIR", str(arguments.work / "target"))
    dropped: set[tuple[str, int]] = set()
    while True:
        mutants = plant(arguments.crates, tree, dropped)
        programs, wrong = build(tree)
        if not wrong:
            break
        if wrong <= dropped:
            sys.exit(f"lines that do not compile: {sorted(wrong)}")
        dropped |= wrong
    chosen = [m for m in mutants if (m.file, m.line) not in dropped and re.search(arguments.within, m.file)][:: arguments.every]
    if arguments.survivors:
        before = {tuple(line.split("\t")[1:]) for line in arguments.survivors.read_text().splitlines() if line.startswith("survived")}
        chosen = [m for m in mutants if (f"{m.file}:{m.line}", m.what) in before]
    tests, pages = questions(programs, tree)
    with ThreadPoolExecutor(WORKERS) as pool:
        fast = [t for t, is_fast in zip(tests, pool.map(without_mutant, tests)) if is_fast]
        if not fast or not all(pool.map(without_mutant, pages)):
            sys.exit("tests or pages fail without a mutant")
        pages = [page for page in pages if page.seconds <= arguments.page_seconds]
        print(f"{len(fast)} of {len(tests)} tests; {sum(p.seconds for p in pages):.0f} s of pages", flush=True)
        print(f"{' '.join(arguments.crates)}: {len(chosen)} of {len(mutants)} mutants", flush=True)
        for mutant, became in zip(chosen, pool.map(lambda m: fate(m, fast, pages), chosen)):
            mutant.fate = became
            print(f"{mutant.fate}\t{mutant.file}:{mutant.line}\t{mutant.what}", flush=True)
    killed = sum(m.fate.startswith("killed") for m in chosen)
    print(f"{' '.join(arguments.crates)}: {killed} of {len(chosen)} killed")


if __name__ == "__main__":
    main()
