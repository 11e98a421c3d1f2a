#!/usr/bin/env bash
# Every experiment, killed (SIGKILL) at random moments and resumed, ends with the bytes of an unbroken run, on any number of threads.
#
#   scripts/kill_experiments.sh [KILLS] [EXPERIMENT...]      default: 3 kills of each of all experiments
#
# HEXBENCH=path of the program (default: the release build), STUDY_TRIALS=trials of the study (default 100000). /usr/bin/time, where
# it is installed, tells the peak memory of the unbroken run.
set -euo pipefail
cd "$(dirname "$0")/.."
kills=${1:-3}
shift || true
experiments=("${@:-}")
[[ -n ${experiments[0]} ]] || experiments=(recovery interactions calibration robustness sensors misread discover discriminate power paper regress validate-regress study challenge)
hexbench=$(realpath "${HEXBENCH:-${CARGO_TARGET_DIR:-target}/release/hexbench}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

prepare() {
    cat > "$work/study.toml" <<TOML
format = "study/1"
title = "A study that is killed"
seed = 7
trials = $((${STUDY_TRIALS:-100000} / 4))
task = "springs"
redraw = 10
space = "$PWD/data/designs/paper-space.toml"

[axes]
geometry = ["ring_a"]
plan = ["random"]
poses = [3, 4]
noise_scale = [1, 2]
TOML
    cat > "$work/entrant.sh" <<'SH'
#!/bin/sh
# An answer without physics: no deflection at all.
sleep 0.05
awk -F, 'NR == 1 { print "row,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad"; next } { print $1 ",0,0,0,0,0,0" }' \
    "$1/predict.csv" > "$2/predictions.csv"
SH
    chmod +x "$work/entrant.sh"
    "$hexbench" challenge make springs-and-effects -o "$work/suite" > "$work/made.txt"
    "$hexbench" regress --quick --update --reason "a run that is killed" --runs 2 --baseline "$work/baseline.json" > "$work/made.txt"
}

# The command of an experiment; its results go to folder $2, what it keeps to folder $2-kept.
command_of() {
    local to=$2 kept=(--journal "$2-kept" --table "$2/trials.csv")
    case $1 in
    recovery) line=(validate recovery --campaigns 115 --diagnoses 1 --json "$to/all.json" --markdown "$to/page.md" "${kept[@]}") ;;
    interactions) line=(validate interactions --triples 1 --markdown "$to/page.md" "${kept[@]}") ;;
    calibration) line=(validate calibration --trials 100 -o "$to/files" --markdown "$to/page.md" "${kept[@]}") ;;
    robustness) line=(validate robustness --trials 2 -o "$to/files" --markdown "$to/page.md" "${kept[@]}") ;;
    sensors) line=(validate sensors --trials 2 --alike 2 -o "$to/files" --markdown "$to/page.md" "${kept[@]}") ;;
    misread) line=(validate misread --trials 1 --sound 14 -o "$to/files" --markdown "$to/page.md" "${kept[@]}") ;;
    discover) line=(validate discover --outside 9 --listed 4 --clean 12 -o "$to/files" --markdown "$to/page.md" "${kept[@]}") ;;
    discriminate) line=(validate discriminate --trials 8 --markdown "$to/page.md" "${kept[@]}") ;;
    power) line=(validate power --campaigns 6 --markdown "$to/page.md" "${kept[@]}") ;;
    paper) line=(validate paper -o "$to/files" "${kept[@]}") ;;
    regress) line=(regress --quick --seed 5 --baseline "$work/baseline.json" --json "$to/all.json" "${kept[@]}") ;;
    validate-regress) line=(validate regress --quick --runs 3 --baseline "$work/baseline.json" --markdown "$to/page.md" "${kept[@]}") ;;
    study) line=(study "$work/study.toml" -o "$2-kept" --markdown "$to/page.md") ;;
    challenge) line=(challenge run "$work/suite" -o "$2-kept" --name none -- "$work/entrant.sh") ;;
    *) echo "there is no experiment $1" >&2 && exit 2 ;;
    esac
}

# What is compared: everything written, without what is measured by the clock. The first line of a challenge counts what was known.
results() {
    case $1 in
    study) cp "$2-kept/trials.parquet" "$2-kept/cells.csv" "$2/" ;;
    challenge) (cd "$2-kept/cases" && sha256sum -- */predictions.csv) > "$2/answers.txt" ;;
    esac
}

once() { # experiment, folder of the results, what to put before the command ...
    local name=$1 to=$2
    shift 2
    mkdir -p "$to"
    command_of "$name" "$to"
    "$@" "$hexbench" "${line[@]}" > "$work/printed.txt" || [[ $? == 1 ]]
    results "$name" "$to"
}

kill_at_random() { # experiment, folder of the results, longest time until the kill
    mkdir -p "$2"
    command_of "$1" "$2"
    "$hexbench" "${line[@]}" > "$work/printed.txt" 2>&1 &
    local pid=$!
    sleep "$(awk -v most="$3" -v r="$RANDOM" 'BEGIN { print most * (0.5 + 0.5 * r / 32768) }')"
    kill -KILL "$pid" 2> "$work/killed.txt" || true
    local code=0
    wait "$pid" 2> "$work/killed.txt" || code=$?
    # 128 + SIGKILL: it did not end before.
    [[ $code != 137 ]] || hit=$((hit + 1))
}

prepare
timed=()
[[ ! -x /usr/bin/time ]] || timed=(/usr/bin/time -f "  unbroken: peak memory %M KB, %e s")
for name in "${experiments[@]}"; do
    echo "$name" >&2
    begun=$EPOCHREALTIME
    once "$name" "$work/$name" "${timed[@]}"
    took=$(awk "BEGIN { print $EPOCHREALTIME - $begun }")
    # A page names the folder of its charts: the results of both runs have the same path.
    mv "$work/$name" "$work/$name-unbroken"
    rm -rf "$work/$name-kept"
    hit=0
    kept=0
    for ((k = 0; k < kills; k++)); do
        # The later, the less is left to be done.
        kill_at_random "$name" "$work/$name" "$(awk "BEGIN { print $took * 0.9 * ($kills - $k) / $kills }")"
        kept=$(find "$work/$name-kept" \( -name '*.shard' -o -name run.json \) 2> "$work/printed.txt" | wc -l || true)
        echo "  kill $((k + 1)): $kept records" >&2
    done
    ((hit && kept)) || { echo "$name: $hit kills and $kept records show nothing" >&2 && exit 1; }
    once "$name" "$work/$name" env RAYON_NUM_THREADS=1
    diff -r "$work/$name-unbroken" "$work/$name"
    echo "$name: $hit kills, resumed on 1 thread: the same bytes"
done
