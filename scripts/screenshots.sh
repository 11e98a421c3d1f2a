#!/usr/bin/env bash
# Takes the pictures kept in docs/screenshots. Needs what scripts/browser.sh needs, and HEXBENCH_BINARY or cargo.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ -z ${HEXBENCH_BINARY:-} ]]; then
    cargo build --release --locked --quiet
    HEXBENCH_BINARY=$(realpath "${CARGO_TARGET_DIR:-target}")/release/hexbench
fi
export HEXBENCH_BINARY
node tests/browser/screenshots.mjs docs/screenshots
