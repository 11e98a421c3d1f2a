#!/usr/bin/env bash
# Holds the dependencies against deny.toml. Needs cargo-deny (cargo install cargo-deny).
#
#     scripts/supply_chain.sh crates        licenses, crates that are there twice, sources
#     scripts/supply_chain.sh advisories    known holes; their database is fetched, or was fetched before
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/common.sh

cargo deny --version >/dev/null 2>&1 || skip "cargo-deny is not installed (cargo install cargo-deny)"
check() { cargo deny "$1" --log-level error check "${@:2}"; }

case ${1:-} in
crates) check --locked licenses bans sources ;;
advisories)
    if cargo deny --locked fetch db >/dev/null 2>&1; then
        check --locked advisories
    elif compgen -G "${CARGO_HOME:-$HOME/.cargo}/advisory-dbs/advisory-db-*" >/dev/null; then
        echo "the database of advisories could not be fetched: checked against the last one"
        check --offline advisories
    else
        skip "the database of advisories cannot be fetched"
    fi
    ;;
*)
    echo "usage: scripts/supply_chain.sh crates|advisories" >&2
    exit 2
    ;;
esac
