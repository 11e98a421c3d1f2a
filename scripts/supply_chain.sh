#!/usr/bin/env bash
# Holds the dependencies against deny.toml: advisories, licences, crates that are there twice, sources. Needs cargo-deny
# (cargo install cargo-deny) and, for the advisories, their database, which is fetched or was fetched before.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

cargo deny --version >/dev/null 2>&1 || skip "cargo-deny is not installed (cargo install cargo-deny)"
cargo deny --locked --log-level error check licenses bans sources
if cargo deny --locked fetch db >/dev/null 2>&1; then
    cargo deny --locked --log-level error check advisories
elif compgen -G "${CARGO_HOME:-$HOME/.cargo}/advisory-dbs/advisory-db-*" >/dev/null; then
    echo "the database of advisories could not be fetched: checked against the last one"
    cargo deny --offline --log-level error check advisories
else
    skip "the database of advisories cannot be fetched; licences, duplicates and sources are as they should be"
fi
