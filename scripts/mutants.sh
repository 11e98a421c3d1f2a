#!/usr/bin/env bash
# Which changes of libraries no test notices: scripts/mutants.sh CRATE... [--within PATH] [--every N] [--survivors FILE] [--no-pages]
# [--page-seconds N] [--quick CRATE], CRATE one of model, core, design, report. Builds once (minutes), then runs for each mutant the tests of
# the crates that reach it and take less than a second, and pages of the command about every bundled case. scripts/mutants.md tells what was
# asked so far.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v python3 >/dev/null || { echo "python3 is not installed" >&2; exit 77; }
exec python3 scripts/mutants.py "$@"
