#!/usr/bin/env bash
# Time and peak memory of one study on one process, on two, and on a Dask cluster of two workers; writes docs/results/cluster-times.md.
# For a quiet machine with two cores or more. The command and the Python package are built for release.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/common.sh
study=${1:-data/studies/many-springs.toml}
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/study-times
# The library of the whole workspace, so that nothing is built twice.
cargo build --release --locked --quiet --workspace --bins --example hexbench_module
mkdir -p "$work"
prepare_python "$work" python
assemble_package "$work/package" "$target/release/deps"
PYTHONPATH=$work/package "$work/venv/bin/python" scripts/study_times.py "$study" "$target/release/hexbench" docs/results/cluster-times.md
