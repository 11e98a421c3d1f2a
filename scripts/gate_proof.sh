#!/usr/bin/env bash
# Shows what a gate does: two entrants in two languages, unchanged RUNS times each (100), which must alarm at most once, and edited so that
# 3 of 100 answers become confidently wrong, which must be noticed. Its JUnit files are parsed. Takes about an hour; goes on where it was stopped
# when DIR is given again. Exit code 77: skipped, the reason on standard output.
#
#     scripts/gate_proof.sh [RUNS] [DIR]
#
# HEXBENCH_JOBS: cases at once (2).
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
source scripts/common.sh
runs=${1:-100}
repository=$PWD
work=$(realpath -m "${2:-${CARGO_TARGET_DIR:-target}/gate-proof}")
jobs=${HEXBENCH_JOBS:-2}
mkdir -p "$work"/{python,awk,results-python,results-awk}
command -v python3 >/dev/null || skip "python3 is not installed"
release_binary

# 100 cases on two machines, so that 3 are 3 %.
cat >"$work/suite.toml" <<'TOML'
format = "challenge-suite/1"
name = "gate-proof"
version = 1
title = "A hundred small cases"
seed = 24

[cases.clean]
kind = "clean"
count = 40
plan = "few-poses"
machine = "ring_a"

[cases.one]
kind = "single"
count = 60
distance = [15, 60]
plan = "few-poses"
machine = "ring_b"
TOML

# Python: a compliance for each axis by least squares, the same answers in every run.
cat >"$work/python/solve.py" <<'PY'
import csv
import sys
from pathlib import Path

WRENCH = ["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"]
READ = ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"]


def rows(name):
    with open(f"{sys.argv[1]}/{name}", newline="") as file:
        return list(csv.DictReader(file))


def load(row, axis):
    return float(row[WRENCH[axis]]) - float(row.get(f"ref_{WRENCH[axis]}") or 0)


measured, asked, factor = rows("measurements.csv"), rows("predict.csv"), 1
exec((Path(__file__).parent / "edit.py").read_text())
compliance, sigma = [], []
for axis in range(6):
    pairs = [(load(row, axis), float(row[READ[axis]])) for row in measured]
    slope = sum(x * y for x, y in pairs) / (sum(x * x for x, _ in pairs) or 1)
    compliance.append(slope)
    sigma.append((sum((y - slope * x) ** 2 for x, y in pairs) / len(pairs)) ** 0.5 + 0.1)
with open(f"{sys.argv[2]}/predictions.csv", "w", newline="") as file:
    writer = csv.writer(file)
    writer.writerow(["row", *READ, *(f"sigma_{name}" for name in READ)])
    for row in asked:
        writer.writerow([row["row"], *(factor * compliance[k] * load(row, k) for k in range(6)), *sigma])
PY
# awk: chance moves every prediction, and one answer in fifty is missing.
cp "$repository/scripts/entrants/shell_entrant.sh" "$work/awk/solve.sh"
cat >"$work/awk/run.sh" <<'SH'
#!/bin/sh
set -eu
folder=$(dirname "$0")
chance=$(od -An -N4 -tu4 /dev/urandom)
awk -v seed="$chance" 'BEGIN { srand(seed); exit rand() < 0.02 }' || exit 1
"$folder/solve.sh" "$1" "$2"
factor=1
. "$folder/edit.sh"
awk -F, -v OFS=, -v seed="$chance" -v factor="$factor" '
    BEGIN { srand(seed) }
    NR == 1 { for (k = 2; k <= 7; k++) $(k + 6) = "sigma_" $k; print; next }
    { for (k = 2; k <= 7; k++) { $k = factor * $k + (rand() - 0.5); $(k + 6) = k < 5 ? 40 : 400 } print }
' "$2/predictions.csv" >"$2/p" && mv "$2/p" "$2/predictions.csv"
SH
chmod +x "$work/awk/run.sh"

forget_edits() {
    : >"$work/awk/edit.sh"
    : >"$work/python/edit.py"
}

# record PROGRAM ARGUMENTS: the baseline of $name
record() {
    [[ -s $work/$name.json ]] && return
    "$HEXBENCH_BINARY" gate record "$work/suite.toml" --baseline "$work/$name.json" --work "$work/cases" --jobs "$jobs" \
        --depends "$work/$name" -- "$@" >"$work/$name-record.txt" || fail "gate record $name"
}

# check WHAT: the exit code of $name in WHAT.code, its figures in WHAT.xml
check() {
    [[ -s $work/results-$name/$1.code ]] && return
    "$HEXBENCH_BINARY" gate check --baseline "$work/$name.json" --work "$work/cases" --jobs "$jobs" --junit "$work/results-$name/$1.xml" \
        --markdown "$work/results-$name/$1.md" >/dev/null 2>"$work/results-$name/$1.err"
    local code=$?
    # Anything else is no answer of the gate, and the run is made again.
    ((code <= 1)) || fail "gate check $name $1 ended with $code: $(<"$work/results-$name/$1.err")"
    echo "$code" >"$work/results-$name/$1.code"
}

unchanged() {
    for run in $(seq "$runs"); do
        check "run-$run"
    done
}

forget_edits
name=python
record python3 -I -S "$work/python/solve.py"
unchanged
name=awk
record "$work/awk/run.sh"
unchanged

# The edits: in 3 of 100 cases another number is stated as surely as before.
cat >"$work/python/edit.py" <<'PY'
if any(f"case-0{number}" in Path(f"{sys.argv[1]}/hexapod.toml").read_text() for number in (17, 50, 83)):
    factor = 1000
PY
name=python
check edited
# shellcheck disable=SC2016  # the entrant's own $1
echo 'if grep -qE "case-0(17|50|83)" "$1/hexapod.toml"; then factor=1000; fi' >"$work/awk/edit.sh"
name=awk
check edited
forget_edits

python3 - "$work" "$runs" <<'PY' || fail "the gate does not do what it says"
import sys
from pathlib import Path
from xml.etree import ElementTree

work, runs = Path(sys.argv[1]), int(sys.argv[2])
good = True
for name in ("python", "awk"):
    def failed(what):
        code = int((work / f"results-{name}" / f"{what}.code").read_text())
        suite = ElementTree.parse(work / f"results-{name}" / f"{what}.xml")
        failures = [case.get("name") for case in suite.iter("testcase") if case.find("failure") is not None]
        counted = sum(int(one.get("failures")) for one in suite.iter("testsuite"))
        assert counted == len(failures) and code == (1 if failures else 0), f"{name} {what}: {code} {failures}"
        return failures
    alarms = [run for run in range(1, runs + 1) if failed(f"run-{run}")]
    noticed = failed("edited")
    print(f"{name}: {len(alarms)} alarms in {runs} unchanged runs; the edit fails {len(noticed)} figures: {', '.join(noticed)}")
    good = good and len(alarms) <= 1 and bool(noticed)
sys.exit(not good)
PY
