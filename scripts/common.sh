# Sourced by scripts: how they say that they cannot run, a Python of their own, the Python package, the optimised program.

# A step that cannot run here ends with 77, the reason on standard output.
skip() {
    printf 'skipped: %s\n' "$1"
    exit 77
}

fail() {
    printf 'FAILED: %s\n' "$1" >&2
    exit 1
}

# An environment in WORK/venv with the packages of scripts/requirements/NAME.txt, made when those change: prepare_python WORK NAME
prepare_python() {
    local work=$1 requirements
    requirements=$(dirname "${BASH_SOURCE[0]}")/requirements/$2.txt
    cmp --silent "$requirements" "$work/venv/installed.txt" && return
    command -v python3 >/dev/null || skip "python3 is not installed"
    python3 -m venv --clear "$work/venv" >"$work/venv.log" 2>&1 ||
        skip "python3 -m venv does not work here (Debian has it in python3-venv); see $work/venv.log"
    "$work/venv/bin/python" -m pip install --quiet --disable-pip-version-check --require-hashes -r "$requirements" >"$work/pip.log" 2>&1 ||
        skip "pip cannot install the pinned packages, no network perhaps; see $work/pip.log"
    cp "$requirements" "$work/venv/installed.txt"
}

# What the wheel holds, as a folder: assemble_package FOLDER DEPS, where DEPS has the library that cargo built
assemble_package() {
    local sources library=$2/libhexbench_native.so
    sources=$(dirname "${BASH_SOURCE[0]}")/../crates/python/python/hexbench
    [[ -f $library ]] || library=${library%.so}.dylib
    rm -rf "$1"
    mkdir -p "$1"
    cp -r "$sources" "$1/hexbench"
    rm -rf "$1/hexbench/__pycache__" "$1"/hexbench/_native.*.so
    cp "$library" "$1/hexbench/_native.abi3.so" || fail "the library is not where it should be"
}

# HEXBENCH_BINARY as given, or built with optimisation. Runs in the root of the repository.
release_binary() {
    if [[ -z ${HEXBENCH_BINARY:-} ]]; then
        cargo build --release --locked --quiet || fail "cargo build --release"
        HEXBENCH_BINARY=$(realpath "${CARGO_TARGET_DIR:-target}")/release/hexbench
    fi
    export HEXBENCH_BINARY
}
