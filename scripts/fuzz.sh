#!/usr/bin/env bash
# Looks for inputs that break a reader: scripts/fuzz.sh TARGET SECONDS. Needs a nightly compiler and cargo-fuzz (cargo install cargo-fuzz);
# `cargo test -p hexbench-fuzz` runs the same targets without. New inputs gather in target/fuzz/TARGET; the committed ones are read, not changed.
# RUNS=N ends after so many inputs too. What breaks a target is left in fuzz/artifacts/TARGET: copy it to fuzz/corpus/TARGET, mend, and it is a test.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

if (($# != 2)) || [[ ! -d fuzz/corpus/$1 ]] || ! [[ $2 =~ ^[0-9]+$ ]]; then
    echo "usage: scripts/fuzz.sh TARGET SECONDS, TARGET one of: $(cd fuzz/corpus && echo *)" >&2
    exit 2
fi
cargo +nightly fuzz --version >/dev/null 2>&1 || skip "no nightly compiler with cargo-fuzz here"

# Not optimised across crates, which would take minutes; no sanitizer: the code of this program is safe Rust.
export CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16
export RAYON_NUM_THREADS=1
found=target/fuzz/$1
mkdir -p "$found"
cargo +nightly fuzz run --fuzz-dir fuzz --sanitizer none --features libfuzzer "$1" "$found" "fuzz/corpus/$1" -- \
    -max_total_time="$2" -runs="${RUNS:--1}" -timeout=20 -rss_limit_mb=4096 -max_len=65536 -print_final_stats=1
