#!/usr/bin/env bash
# hexbench against NumPy and SciPy on the same tasks; writes docs/results/benchmarks.md. Exit code 77: skipped, the reason on standard
# output. Arguments go to scripts/benchmark.py, for example --starts 100 --campaigns 100000 for a quick look.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
source scripts/common.sh
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/benchmark
python=$work/venv/bin/python

build() {
    cargo build --locked --quiet --release -p hexbench-design --example benchmark "$@" || exit 1
}

mkdir -p "$work"
prepare_python "$work" scipy
build
RUSTFLAGS="-C target-cpu=native" build --target-dir "$work/native"
# One thread on both sides.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1
exec "$python" scripts/benchmark.py "$target/release/examples/benchmark" \
    --native "$work/native/release/examples/benchmark" --work "$work" --page docs/results/benchmarks.md "$@"
