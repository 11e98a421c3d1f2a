//! Scenes and their sealed truth.

use std::path::Path;

use hexbench_truth::Scene;
use hexbench_truth::scene::{PartName, VirtualBench};

use crate::scratch;

pub(super) const HEXAPOD: &str = include_str!("../../../scenes/hidden-1/hexapod.toml");
const SCENE: &str = include_str!("../../../scenes/hidden-1/scene.toml");
const TRUTH: &str = include_str!("../../../scenes/hidden-1/sealed/truth.toml");

/// Rows measured of a scene that is read: an equilibrium each.
const ROWS: u64 = 3;

pub(super) fn scene(bytes: &[u8]) -> bool {
    measured(bytes, TRUTH.as_bytes())
}

pub(super) fn truth(bytes: &[u8]) -> bool {
    measured(SCENE.as_bytes(), bytes)
}

/// What can be read can be measured, or says why not.
fn measured(scene: &[u8], truth: &[u8]) -> bool {
    let files = [("scene.toml", scene), ("hexapod.toml", HEXAPOD.as_bytes()), ("sealed/truth.toml", truth)];
    let Ok(scene) = scratch::folder(&files, |folder: &Path| Scene::read(folder)) else { return false };
    let Ok(rows) = VirtualBench::new(&scene, false).measure(PartName::Training, 0..ROWS) else {
        return false;
    };
    let finite = rows.iter().all(|row| row.observation.measured.iter().all(|x| x.is_finite()));
    assert!(finite, "a reading that is no number");
    true
}
