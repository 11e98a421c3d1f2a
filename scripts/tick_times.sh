#!/usr/bin/env bash
# Times ticks on the workbench in a real browser and writes docs/results/tick-times.md. Needs what scripts/browser.sh needs; means something
# on a quiet machine only.
set -euo pipefail
cd "$(dirname "$0")/.."

source crates/workbench/ui/packages.sh
prepare_browser
release_binary
node tests/browser/tick_times.mjs docs/results/tick-times.md
