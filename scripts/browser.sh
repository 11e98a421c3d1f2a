#!/usr/bin/env bash
# Tests in a real browser: the pages of the report, and the workbench. Needs node 20, npm with a package index, and Chromium;
# without them it exits with 77, the reason on standard output.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
repository=$PWD
ui=$repository/crates/workbench/ui
source "$ui/packages.sh"
artefacts=$(realpath -m "${HEXBENCH_ARTEFACTS:-target/artefacts}")

prepare_browser

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
