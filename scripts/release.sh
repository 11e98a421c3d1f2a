# Sourced by scripts that need the optimised program: HEXBENCH_BINARY as given, or built. Runs in the root of the repository.

if [[ -z ${HEXBENCH_BINARY:-} ]]; then
    cargo build --release --locked --quiet
    HEXBENCH_BINARY=$(realpath "${CARGO_TARGET_DIR:-target}")/release/hexbench
fi
export HEXBENCH_BINARY
