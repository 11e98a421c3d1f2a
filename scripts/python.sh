#!/usr/bin/env bash
# The Python package: put together from the library that `cargo test` has built, then its tests, types and style.
# Exit code 77: skipped, the reason on standard output. crates/python/README.md says more.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
source scripts/common.sh
repository=$PWD
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/python
python=$work/venv/bin/python
sources=$repository/crates/python

# The library of the whole workspace: built by the tests, and up to date at once after them. Built alone it would choose other
# features of its dependencies, and build those again.
build() {
    cargo test --workspace --example hexbench_module --no-run --locked --quiet || fail "cargo test --example hexbench_module"
    export HEXBENCH_BINARY=${HEXBENCH_BINARY:-$target/debug/hexbench}
    [[ -x $HEXBENCH_BINARY ]] || cargo test --workspace --test cli --no-run --locked --quiet || fail "cargo test --test cli"
}

mkdir -p "$work"
! command -v python3 >/dev/null || python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
    skip "the tests need Python 3.11; this is $(python3 --version)"
prepare_python "$work" python
build
assemble_package "$work/package" "$target/debug/deps"
export PYTHONPATH=$work/package MYPYPATH=$work/package
cd "$work" || exit 5
"$python" -m pytest --quiet -p no:cacheprovider --timeout 300 --durations 10 "$sources/tests" "$@" || fail "pytest"
types=("$python" -m mypy --config-file "$sources/pyproject.toml" --no-error-summary --cache-dir "$work/mypy")
"${types[@]}" -p hexbench || fail "mypy"
"${types[@]}" "$sources"/examples/*.py || fail "mypy of the examples"
"$python" -m ruff check --quiet --no-cache --config "$sources/ruff.toml" "$sources/python" "$sources/examples" ||
    fail "ruff"
