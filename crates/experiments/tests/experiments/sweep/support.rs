//! Studies from text.

use hexbench_experiments::sweep::SweepStudy;

/// A study with the usual head before `rest`.
pub(crate) fn study(rest: &str) -> SweepStudy {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    std::fs::write(&path, format!("format = \"study/1\"\ntitle = \"test\"\nseed = 1\n{rest}")).unwrap();
    SweepStudy::read(&path).unwrap()
}
