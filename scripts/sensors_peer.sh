#!/usr/bin/env bash
# Sensors chosen by hexbench beside those of PySensors, out of the same candidates; fails where ours are worse. Exit code 77: skipped,
# the reason on standard output.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
source scripts/common.sh
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/sensors
mkdir -p "$work"
prepare_python "$work" sensors
cargo build --locked --quiet --release -p hexbench-cli || exit 1
exec "$work/venv/bin/python" scripts/sensors_peer.py "$target/release/hexbench" --work "$work" "$@"
