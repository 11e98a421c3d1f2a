#!/usr/bin/env bash
# The Python package: put together from the library that `cargo test` has built, then its tests, types and style.
# Exit code 77: skipped, the reason on standard output. crates/python/README.md says more.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 5
repository=$PWD
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
work=$target/python
python=$work/venv/bin/python
sources=$repository/crates/python

skip() {
    printf 'skipped: %s\n' "$1"
    exit 77
}

fail() {
    printf 'FAILED: %s\n' "$1" >&2
    exit 1
}

prepare_python() {
    local requirements=$repository/scripts/python-requirements.txt
    cmp --silent "$requirements" "$work/venv/installed.txt" && return
    command -v python3 >/dev/null || skip "python3 is not installed"
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' || skip "the tests need Python 3.11; this is $(python3 --version)"
    python3 -m venv --clear "$work/venv" >"$work/venv.log" 2>&1 ||
        skip "python3 -m venv does not work here (Debian has it in python3-venv); see $work/venv.log"
    "$python" -m pip install --quiet --disable-pip-version-check -r "$requirements" >"$work/pip.log" 2>&1 ||
        skip "pip cannot install the pinned packages, no network perhaps; see $work/pip.log"
    cp "$requirements" "$work/venv/installed.txt"
}

# The library of the whole workspace: built by the tests, and up to date at once after them. Built alone it would choose other
# features of its dependencies, and build those again.
build() {
    cargo test --workspace --example hexbench_module --no-run --locked --quiet || fail "cargo test --example hexbench_module"
    export HEXBENCH_BINARY=${HEXBENCH_BINARY:-$target/debug/hexbench}
    [[ -x $HEXBENCH_BINARY ]] || cargo test --workspace --test cli --no-run --locked --quiet || fail "cargo test --test cli"
}

# What the wheel holds, as a folder.
assemble() {
    rm -rf "$work/package"
    mkdir -p "$work/package"
    cp -r "$sources/python/hexbench" "$work/package/hexbench"
    rm -rf "$work/package/hexbench/__pycache__" "$work"/package/hexbench/_native.*.so
    local library=$target/debug/deps/libhexbench_native.so
    [[ -f $library ]] || library=${library%.so}.dylib
    cp "$library" "$work/package/hexbench/_native.abi3.so" || fail "the library is not where it should be"
}

mkdir -p "$work"
prepare_python
build
assemble
export PYTHONPATH=$work/package MYPYPATH=$work/package
cd "$work" || exit 5
"$python" -m pytest --quiet -p no:cacheprovider "$sources/tests" "$@" || fail "pytest"
types=("$python" -m mypy --config-file "$sources/pyproject.toml" --no-error-summary --cache-dir "$work/mypy")
"${types[@]}" -p hexbench || fail "mypy"
"${types[@]}" "$sources"/examples/*.py || fail "mypy of the examples"
"$python" -m ruff check --quiet --no-cache --config "$sources/ruff.toml" "$sources/python" "$sources/examples" ||
    fail "ruff"
