#!/usr/bin/env bash
# What files of more and more rows cost, beside pandas and NumPy; writes docs/results/scaling.md. Exit code 77: skipped, the reason on standard
# output. Arguments go to scripts/scaling.py, for example --rows 240 2400 for a quick look.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
source scripts/common.sh
work=$(realpath -m "${CARGO_TARGET_DIR:-target}")/scaling

mkdir -p "$work"
prepare_python "$work" pandas
release_binary
exec "$work/venv/bin/python" scripts/scaling.py "$HEXBENCH_BINARY" --work "$work" --page docs/results/scaling.md "$@"
