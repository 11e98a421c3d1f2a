#!/usr/bin/env bash
# hexbench against NumPy and SciPy on the same tasks; writes docs/benchmarks.md. Exit code 77: skipped, the reason on standard
# output. Arguments go to scripts/benchmark.py, for example --starts 100 --campaigns 100000 for a quick look.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/benchmark
python=$work/venv/bin/python
requirements=scripts/benchmark-requirements.txt

skip() {
    printf 'skipped: %s\n' "$1"
    exit 77
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

build() {
    cargo build --locked --quiet --release -p hexbench-design --example benchmark "$@" || exit 1
}

mkdir -p "$work"
prepare_python
build
RUSTFLAGS="-C target-cpu=native" build --target-dir "$work/native"
# One thread on both sides.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1
exec "$python" scripts/benchmark.py "$target/release/examples/benchmark" \
    --native "$work/native/release/examples/benchmark" --work "$work" --page docs/benchmarks.md "$@"
