#!/usr/bin/env bash
# Takes the pictures kept in docs/guide/screenshots. Needs what scripts/browser.sh needs, and HEXBENCH_BINARY or cargo.
set -euo pipefail
cd "$(dirname "$0")/.."

source scripts/common.sh
release_binary
node tests/browser/screenshots.mjs docs/guide/screenshots
