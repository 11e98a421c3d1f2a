#!/usr/bin/env bash
# Writes docs/results/regress.md: planted faults, which must fail, and unchanged runs with fresh seeds, which must not. Takes an hour and more;
# goes on where it was stopped when DIR is given again.
#
#     scripts/regress_proof.sh [DIR] [RUNS]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-target/regress}
runs=${2:-100}
mkdir -p "$out"
missing=()
for patch in data/regress/faults/*.patch; do
    fault=$(basename "$patch" .patch)
    [[ -s $out/$fault.json ]] || missing+=("$fault")
done
((${#missing[@]} == 0)) || scripts/planted_faults.sh "$out" "${missing[@]}"
# After the faults, whose builds leave a program with the last of them in its place.
cargo build --release --locked --quiet -p hexbench-cli
program=$(realpath -m "${CARGO_TARGET_DIR:-target}")/release/hexbench
"$program" validate regress --runs "$runs" --journal "$out/runs" --faults "$out" --markdown docs/results/regress.md
