#!/usr/bin/env bash
# Makes the bundled challenge, runs four entrants in three languages over it and writes docs/results/entrants.md. Exit code 77: skipped, the
# reason on standard output. --keep: what was answered before is not answered again. HEXBENCH_JOBS: cases at once, instead of one; times
# are then less comparable.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
source scripts/common.sh
suite=springs-and-effects
repository=$PWD
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/challenge
python=$work/venv/bin/python
jobs=${HEXBENCH_JOBS:-1}

run() {
    local name=$1
    shift
    "$HEXBENCH_BINARY" challenge run "$work/$suite" -o "$work/answers/$name" --name "$name" --jobs "$jobs" -- "$@" || fail "challenge run $name"
}

mkdir -p "$work"
prepare_python "$work" scipy
release_binary
[[ ${1:-} == --keep ]] || rm -rf "${work:?}/answers"
rm -rf "${work:?}/$suite"
"$HEXBENCH_BINARY" challenge make "$suite" -o "$work/$suite" || fail "challenge make"
run hexbench "$HEXBENCH_BINARY" challenge answer
run paper "$HEXBENCH_BINARY" challenge answer --method paper
# NumPy would start a thread for each core; one is enough for matrices of this size.
run scipy env OPENBLAS_NUM_THREADS=1 "$python" "$repository/scripts/entrants/scipy_entrant.py"
run shell "$repository/scripts/entrants/shell_entrant.sh"
"$HEXBENCH_BINARY" challenge score "$work/$suite" "$work"/answers/{hexbench,paper,scipy,shell} \
    --json "$work/scores.json" --markdown "$work/challenge.md" || fail "challenge score"
{
    awk '{ print } NR == 1 { print "\nWritten by `scripts/challenge.sh`; do not edit." }' "$work/challenge.md"
    printf '\n## Again\n\n`scripts/challenge.sh` makes the challenge, runs the entrants and writes this page.\n'
    printf 'Versions: %s, %s; %s. Wall times with %s case(s)\n' "$("$HEXBENCH_BINARY" --version)" "$("$python" --version)" \
        "$(paste -sd ' ' scripts/requirements/scipy.in)" "$jobs"
    printf 'at once on %s cores. What the figures mean and what they show is in [challenges.md](../guide/challenges.md).\n' "$(nproc)"
} >docs/results/entrants.md
