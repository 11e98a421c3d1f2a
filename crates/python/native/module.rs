//! The native module as a target of its own, so that `cargo test` builds it with the workspace: a library that only Python can
//! load is neither a test nor needed by one.

use hexbench_native as _;
