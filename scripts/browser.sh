#!/usr/bin/env bash
# Tests in a real browser: the pages of the report, and the workbench. Needs node 20, npm with a package index, and Chromium;
# without them it exits with 77, the reason on standard output.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
source scripts/common.sh
repository=$PWD
ui=$repository/crates/workbench/ui
artefacts=$(realpath -m "${HEXBENCH_ARTEFACTS:-target/artefacts}")

find_chromium() {
    local name
    for name in "${HEXBENCH_CHROMIUM:-}" chromium chromium-browser google-chrome; do
        [[ -n $name ]] && command -v "$name" && return
    done
    return 1
}

HEXBENCH_CHROMIUM=$(find_chromium) || skip "Chromium is not installed (HEXBENCH_CHROMIUM may name one)"
export HEXBENCH_CHROMIUM
# The driver of browsers is among what the page of the workbench needs.
source "$ui/packages.sh"
(cd "$ui" && packages) || exit

if [[ -z ${HEXBENCH_BINARY:-} ]]; then
    cargo build --locked --quiet || fail "cargo build"
    HEXBENCH_BINARY=$(realpath -m "${CARGO_TARGET_DIR:-target}")/debug/hexbench
fi
export HEXBENCH_BINARY HEXBENCH_ARTEFACTS=$artefacts/browser

# All of them unless some are named.
tests=("$@")
if ((${#tests[@]} == 0)); then
    shopt -s nullglob
    tests=("$repository"/tests/browser/*.test.mjs "$ui"/tests/*.test.mjs)
fi
ended=0
for file in "${tests[@]}"; do
    node "$file"
    case $? in
    0) ;;
    77) ((ended == 0)) && ended=77 ;;
    *) ended=1 ;;
    esac
done
exit "$ended"
