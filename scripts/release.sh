#!/usr/bin/env bash
# The command to be handed on: scripts/release.sh [OUTPUT]. Optimised, without the symbols, and without a path of this machine in it.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

output=${1:-target/hexbench}
sources=$(pwd -P)
cargo_home=${CARGO_HOME:-$HOME/.cargo}
toolchain=$(rustc --print sysroot)
# The last one that fits counts.
export RUSTFLAGS="--remap-path-prefix=$HOME=home --remap-path-prefix=$cargo_home=cargo --remap-path-prefix=$toolchain=rust --remap-path-prefix=$sources=hexbench"
export CARGO_PROFILE_RELEASE_STRIP=symbols
cargo build --release --locked --target-dir "${CARGO_TARGET_DIR:-target}"/handed-on || fail "cargo build --release"
cp "${CARGO_TARGET_DIR:-target}"/handed-on/release/hexbench "$output"

for path in "$sources" "$cargo_home" "$toolchain" "$HOME/"; do
    if grep -qaF -- "$path" "$output"; then
        fail "$output names $path"
    fi
done
printf '%s: %s bytes, no path of this machine\n' "$output" "$(stat -c %s "$output")"
