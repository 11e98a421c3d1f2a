//! `hexbench compare --gltf`: the machine and its residuals as glTF, read again by a library that validates.

use std::fs;

use crate::support::{complaint, hexbench_in, root};

/// Positions within the file are kept to single precision by readers.
const PLACE_MM: f64 = 1e-3;

fn compare(case: &str, file: &std::path::Path) -> std::process::Output {
    let words = ["compare", "hexapod.toml", "measurements.csv", "--gltf"];
    hexbench_in(case).args(words).arg(file).output().unwrap()
}

#[test]
fn a_comparison_in_space_is_valid_and_the_machine_stands_where_its_file_says() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("machine.glb");
    let output = compare("mujoco-foundation", &file);
    assert!(output.status.success(), "{}", complaint(&output));
    let bytes = fs::read(&file).unwrap();
    let scene = gltf::Gltf::from_slice(&bytes).expect("valid glTF");
    let binary = scene.blob.as_ref().unwrap();
    let buffer = scene.buffers().next().unwrap();
    assert_eq!(buffer.length(), binary.len());
    for view in scene.views() {
        assert!(view.offset() + view.length() <= binary.len());
    }
    let named =
        |name: &str| scene.nodes().find(|n| n.name() == Some(name)).unwrap_or_else(|| panic!("no {name}"));
    let groups = [
        "machine",
        "load that the model misses most",
        "residuals at the joints",
        "residuals at the mobile origin",
    ];
    for group in groups {
        assert!(named(group).children().count() > 0, "{group} is empty");
    }
    let names: Vec<_> = scene.materials().filter_map(|m| m.name().map(str::to_owned)).collect();
    for paint in ["as it stands", "measured", "predicted", "residual", "load"] {
        assert!(names.iter().any(|n| n == paint), "{paint}: {names:?}");
    }
    let text = fs::read_to_string(root().join("data/cases/mujoco-foundation/hexapod.toml")).unwrap();
    let hexapod: toml::Table = toml::from_str(&text).unwrap();
    let joints: Vec<[f64; 3]> = hexapod["geometry"]["base_joints_mm"].clone().try_into().unwrap();
    for (leg, joint) in joints.iter().enumerate() {
        let matrix = named(&format!("leg {}", leg + 1)).transform().matrix();
        for axis in 0..3 {
            let found = 1e3 * f64::from(matrix[3][axis]);
            assert!((found - joint[axis]).abs() < PLACE_MM, "leg {leg} begins at {found}, not at {joint:?}");
        }
    }
}

#[test]
fn every_corner_of_a_triangle_is_there_and_every_normal_has_length_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("machine.glb");
    assert!(compare("contact", &file).status.success());
    let bytes = fs::read(&file).unwrap();
    let scene = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = scene.blob.clone().unwrap();
    let slice = |accessor: &gltf::Accessor<'_>| {
        let view = accessor.view().unwrap();
        blob[view.offset()..view.offset() + view.length()].to_vec()
    };
    for primitive in scene.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
        let count = primitive.get(&gltf::Semantic::Positions).unwrap().count();
        let corners = slice(&primitive.indices().unwrap());
        assert_eq!(corners.len() % 6, 0, "three corners a triangle");
        assert!(corners.chunks(2).all(|c| usize::from(u16::from_le_bytes([c[0], c[1]])) < count));
        let normals = slice(&primitive.get(&gltf::Semantic::Normals).unwrap());
        for normal in normals.chunks(12) {
            let squares = normal.chunks(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]).powi(2));
            assert!((squares.sum::<f32>() - 1.0).abs() < 1e-6);
        }
    }
}
