#!/usr/bin/env bash
# MuJoCo as a witness: states of rest of the simulated world compared with MuJoCo's, the comparison itself put to the test, and
# measurements made by MuJoCo diagnosed. Exit code 77: skipped, the reason on standard output. docs/guide/cross-checks.md says more.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
source scripts/common.sh
repository=$PWD
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/mujoco
artefacts=$(realpath -m "${HEXBENCH_ARTEFACTS:-target/artefacts}")
hexbench=${HEXBENCH_BINARY:-$target/debug/hexbench}
python=$work/venv/bin/python
witness=$repository/data/witness
states_per_set=36
# Scenes of other machines whose effects MJCF can express.
scenes=(paper paper-rich rubin-camera rubin-m2)
states_per_scene=12

# Models and states of a scene: export_states SCENE COUNT FOLDER
export_states() {
    "$hexbench" export "$1" --mjcf --states "$2" -o "$3/$(basename "$1")" || fail "hexbench export $1"
}

compare() {
    local scene
    rm -rf "$work/states"
    for scene in "$witness"/*/scene.toml; do
        export_states "$(dirname "$scene")" "$states_per_set" "$work/states"
    done
    for scene in "${scenes[@]}"; do
        export_states "$repository/scenes/$scene" "$states_per_scene" "$work/states"
    done
    "$python" "$repository/scripts/mujoco_check.py" "$work"/states/* ||
        fail "MuJoCo comes to rest elsewhere"
}

# The comparison must notice a fault: must_fail ARGUMENTS
must_fail() {
    HEXBENCH_ARTEFACTS=$work/injected "$python" "$repository/scripts/mujoco_check.py" "$@" "$work/states/legs-alone" \
        >"$work/injected.log" 2>&1
    local code=$?
    ((code == 1)) && grep -q '^FAILED legs-alone' "$work/injected.log" ||
        fail "the comparison with $* ended with exit code $code, not with a failed set; see $work/injected.log"
    printf 'noticed: %s\n' "$*"
}

# A case from MuJoCo: make_case SCENE MACHINE HIDDEN; an empty effect is the clean machine.
make_case() {
    "$python" "$repository/scripts/mujoco_measure.py" make "$work/plans/$1" --machine "$witness/machines/$2.toml" \
        --hidden "$3" --seed 1 -o "$work/cases/${3:-clean}" || fail "no measurements with ${3:-nothing} hidden"
}

# The two that follow the load along its path take longest: one on each core.
make_cases() {
    make_case legs-alone wide-base leg-backlash &
    local first=$!
    make_case legs-alone wide-base joint-friction &
    local second=$!
    wait "$first" && wait "$second" || fail "no measurements along the path of the load"
    make_case legs-alone wide-base ""
    make_case legs-alone wide-base leg-nonlinearity
    make_case foundation flat base-compliance
    make_case bending-joints wide-base joint-rotation-stiffness
    make_case load-offset cubic load-offset
}

diagnose() {
    local scene
    rm -rf "$work/plans" "$work/cases"
    for scene in legs-alone foundation bending-joints load-offset; do
        export_states "$witness/$scene" 100000 "$work/plans"
    done
    make_cases
    "$python" "$repository/scripts/mujoco_measure.py" diagnose "$work"/cases/* --hexbench "$hexbench" |
        tee "$artefacts/mujoco-diagnoses.txt" || fail "a hidden effect was not called by its name"
}

mkdir -p "$work" "$artefacts"
export HEXBENCH_ARTEFACTS=$artefacts
prepare_python "$work" mujoco
[[ -n ${HEXBENCH_BINARY:-} ]] || cargo build --locked --quiet || fail "cargo build"
# MuJoCo leaves a log where it runs.
cd "$work" || exit 5
compare
must_fail --inject-nan
must_fail --inject-stiffness 1.001
diagnose
