#!/usr/bin/env bash
# A study killed at random moments and resumed ends with the bytes of an unbroken run, on any number of threads.
#
#   scripts/kill_study.sh [TRIALS] [KILLS]      default: 100000 trials, 20 kills
#
# Needs a release build (cargo build --release) or HEXBENCH=path; /usr/bin/time where it is installed, for the peak memory.
set -euo pipefail
cd "$(dirname "$0")/.."
trials=${1:-100000}
kills=${2:-20}
hexbench=${HEXBENCH:-${CARGO_TARGET_DIR:-target}/release/hexbench}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Four cells; a new machine every ten trials keeps the run long enough to be hit.
cat > "$work/study.toml" <<TOML
format = "study/1"
title = "A study that is killed"
seed = 7
trials = $((trials / 4))
task = "springs"
redraw = 10
space = "$PWD/data/designs/paper-space.toml"

[axes]
geometry = ["ring_a"]
plan = ["random"]
poses = [3, 4]
noise_scale = [1, 2]
TOML

measured() { # label, command ...
    local label=$1 begun=$EPOCHREALTIME
    shift
    if [ -x /usr/bin/time ]; then
        /usr/bin/time -f "$label: peak memory %M KB, %e s" "$@" > /dev/null
    else
        "$@" > /dev/null
        echo "$label: from $begun to $EPOCHREALTIME" >&2
    fi
}

begun=$EPOCHREALTIME
measured "unbroken, all threads" "$hexbench" study "$work/study.toml" -o "$work/unbroken"
took=$(awk "BEGIN { print $EPOCHREALTIME - $begun }")
measured "unbroken, 1 thread" env RAYON_NUM_THREADS=1 "$hexbench" study "$work/study.toml" -o "$work/one"

hit=0
for ((k = 0; k < kills; k++)); do
    "$hexbench" study "$work/study.toml" -o "$work/killed" > /dev/null &
    pid=$!
    sleep "$(awk -v took="$took" -v kills="$kills" -v r="$RANDOM" 'BEGIN { print 2 * took / kills * r / 32768 }')"
    kill -KILL "$pid" 2> /dev/null && hit=$((hit + 1))
    wait "$pid" 2> /dev/null || true
    echo "kill $((k + 1)): $(find "$work/killed/journal" -name '*.shard' 2> /dev/null | wc -l) records" >&2
done
measured "resumed after $hit kills" "$hexbench" study "$work/study.toml" -o "$work/killed"

for other in one killed; do
    cmp "$work/unbroken/trials.parquet" "$work/$other/trials.parquet"
    cmp "$work/unbroken/cells.csv" "$work/$other/cells.csv"
done
echo "$trials trials, $hit kills: trials.parquet ($(stat -c %s "$work/unbroken/trials.parquet") bytes) and cells.csv are the same bytes; 1 thread too"
sha256sum "$work/unbroken/trials.parquet" | cut -c1-64
