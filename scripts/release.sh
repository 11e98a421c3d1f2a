#!/usr/bin/env bash
# Builds the command for a release: scripts/release.sh [OUTPUT]. The profile `dist` of Cargo.toml, and no path of this machine in it.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

output=${1:-target/hexbench}
sources=$(pwd -P)
cargo_home=${CARGO_HOME:-$HOME/.cargo}
toolchain=$(rustc --print sysroot)
target=${CARGO_TARGET_DIR:-target}/handed-on
# Of the prefixes, the last one that fits counts. Why the symbols are stripped here: [profile.dist] in Cargo.toml.
export RUSTFLAGS="-C strip=symbols --remap-path-prefix=$HOME=home --remap-path-prefix=$cargo_home=cargo --remap-path-prefix=$toolchain=rust --remap-path-prefix=$sources=hexbench"
cargo build --profile dist --locked --target-dir "$target" || fail "cargo build --profile dist"
mkdir -p "$(dirname "$output")"
cp "$target/dist/hexbench" "$output"

for path in "$sources" "$cargo_home" "$toolchain" "$HOME/"; do
    if grep -qaF -- "$path" "$output"; then
        fail "$output names $path"
    fi
done
printf '%s: %s bytes, no path of this machine\n' "$output" "$(wc -c <"$output" | tr -d ' ')"
