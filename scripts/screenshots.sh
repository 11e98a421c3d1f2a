#!/usr/bin/env bash
# Takes the pictures kept in docs/guide/screenshots. Needs what scripts/browser.sh needs, and HEXBENCH_BINARY or cargo.
# scripts/screenshots.sh --all FOLDER: every state of the workbench and every page, wide and narrow, light, dark and printed (pdftoppm).
set -euo pipefail
cd "$(dirname "$0")/.."

source crates/workbench/ui/packages.sh
prepare_browser
release_binary
if [[ ${1:-} == --all ]]; then
    node tests/browser/all_states.mjs "${2:?a folder for the pictures}"
else
    node tests/browser/screenshots.mjs docs/guide/screenshots
fi
