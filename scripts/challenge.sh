#!/usr/bin/env bash
# Makes the bundled challenge, runs four entrants in three languages over it and writes docs/challenge.md. Exit code 77: skipped, the
# reason on standard output. --keep: what was answered before is not answered again. HEXBENCH_JOBS: cases at once, instead of one; times
# are then less comparable.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
suite=springs-and-effects
repository=$PWD
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/challenge
python=$work/venv/bin/python
requirements=$repository/scripts/entrants/requirements.txt
jobs=${HEXBENCH_JOBS:-1}
hexbench=${HEXBENCH_BINARY:-$target/release/hexbench}

skip() {
    printf 'skipped: %s\n' "$1"
    exit 77
}

fail() {
    printf 'FAILED: %s\n' "$1" >&2
    exit 1
}

prepare_python() {
    cmp --silent "$requirements" "$work/venv/installed.txt" && return
    command -v python3 >/dev/null || skip "python3 is not installed"
    python3 -m venv --clear "$work/venv" >"$work/venv.log" 2>&1 ||
        skip "python3 -m venv does not work here (Debian has it in python3-venv); see $work/venv.log"
    "$python" -m pip install --quiet --disable-pip-version-check -r "$requirements" >"$work/pip.log" 2>&1 ||
        skip "pip cannot install the pinned packages, no network perhaps; see $work/pip.log"
    cp "$requirements" "$work/venv/installed.txt"
}

run() {
    local name=$1
    shift
    "$hexbench" challenge run "$work/$suite" -o "$work/answers/$name" --name "$name" --jobs "$jobs" -- "$@" || fail "challenge run $name"
}

mkdir -p "$work"
prepare_python
[[ -n ${HEXBENCH_BINARY:-} ]] || cargo build --locked --quiet --release || fail "cargo build"
[[ ${1:-} == --keep ]] || rm -rf "${work:?}/answers"
rm -rf "${work:?}/$suite"
"$hexbench" challenge make "$suite" -o "$work/$suite" || fail "challenge make"
run hexbench "$hexbench" challenge answer
run paper "$hexbench" challenge answer --method paper
# NumPy would start a thread for each core; one is enough for matrices of this size.
run scipy env OPENBLAS_NUM_THREADS=1 "$python" "$repository/scripts/entrants/scipy_entrant.py"
run shell "$repository/scripts/entrants/shell_entrant.sh"
"$hexbench" challenge score "$work/$suite" "$work"/answers/{hexbench,paper,scipy,shell} \
    --json "$work/scores.json" --markdown "$work/challenge.md" || fail "challenge score"
{
    cat "$work/challenge.md"
    printf '\n## Again\n\n`scripts/challenge.sh` makes the challenge, runs the entrants and writes this page; do not edit it.\n'
    printf 'Versions: %s, %s; %s. Wall times with %s case(s)\n' "$("$hexbench" --version)" "$("$python" --version)" \
        "$(paste -sd ' ' "$requirements")" "$jobs"
    printf 'at once on %s cores. What the figures mean and what they show is in [challenges.md](challenges.md).\n' "$(nproc)"
} >docs/challenge.md
