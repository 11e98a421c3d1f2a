//! glTF 2.0 in one binary file (.glb): tubes and cones, each a node with a name, in a few colors.
//!
//! Meters; z is up in our frames and y in glTF, so that everything hangs on a node that turns. Source: Khronos Group 2021, glTF 2.0
//! Specification (ISO/IEC 12113:2022).

use hexbench_core::Vector3;
use serde_json::{Value, json};

/// Sides of a tube and of a cone.
const SIDES: u16 = 16;
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;
/// Component types and targets of glTF.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;

/// Shape of a node: of unit radius, along z from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Solid {
    Tube,
    Cone,
}

/// A color with its name: red, green, blue, linear, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Paint {
    pub(super) name: &'static str,
    pub(super) color: [f64; 3],
}

/// A scene that grows.
#[derive(Debug, Default)]
pub(super) struct Glb {
    paints: Vec<Paint>,
    nodes: Vec<Value>,
    groups: Vec<Value>,
}

impl Glb {
    /// Opens a group: everything until the next one is in it.
    pub(super) fn group(&mut self, name: &str, extras: &Value) {
        self.groups.push(json!({ "name": name, "children": [], "extras": extras }));
    }

    /// A tube between two points.
    pub(super) fn tube(&mut self, name: &str, paint: Paint, ends: [Vector3; 2], radius: f64) {
        self.solid(name, Solid::Tube, paint, ends, radius);
    }

    /// An arrow from one point to another; one without length is left out.
    pub(super) fn arrow(&mut self, name: &str, paint: Paint, [from, to]: [Vector3; 2], radius: f64) {
        const HEAD: f64 = 2.6;
        let along = to - from;
        let Some(direction) = along.try_normalize(f64::MIN_POSITIVE) else { return };
        let neck = to - direction * (6.0 * radius).min(0.5 * along.norm());
        self.solid(name, Solid::Tube, paint, [from, neck], radius);
        self.solid(&format!("{name}, head"), Solid::Cone, paint, [neck, to], HEAD * radius);
    }

    fn solid(&mut self, name: &str, solid: Solid, paint: Paint, [from, to]: [Vector3; 2], radius: f64) {
        let along = to - from;
        let Some(z) = along.try_normalize(f64::MIN_POSITIVE) else { return };
        let aside = if z.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
        let x = aside.cross(&z).normalize();
        let y = z.cross(&x);
        let columns = [(x * radius, 0.0), (y * radius, 0.0), (along, 0.0), (from, 1.0)];
        let matrix: Vec<f64> = columns.iter().flat_map(|(v, w)| [v.x, v.y, v.z, *w]).collect();
        let paint = self.place_of(paint);
        let mesh = 2 * paint + usize::from(solid == Solid::Cone);
        let node = self.nodes.len();
        self.nodes.push(json!({ "name": name, "mesh": mesh, "matrix": matrix }));
        if let Some(children) = self.groups.last_mut().and_then(|g| g["children"].as_array_mut()) {
            children.push(json!(node));
        }
    }

    fn place_of(&mut self, paint: Paint) -> usize {
        self.paints.iter().position(|known| *known == paint).unwrap_or_else(|| {
            self.paints.push(paint);
            self.paints.len() - 1
        })
    }

    /// The file.
    pub(super) fn bytes(self, program: &str) -> Vec<u8> {
        let shapes = [shape(Solid::Tube), shape(Solid::Cone)];
        let (binary, views, accessors) = packed(&shapes);
        let first_group = self.nodes.len();
        let root = first_group + self.groups.len();
        let children: Vec<usize> = (first_group..root).collect();
        // A quarter about x: z becomes y.
        let turn = [-std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f64::consts::FRAC_1_SQRT_2];
        let upright = json!({ "name": "fixed frame, z up", "rotation": turn, "children": children });
        let nodes: Vec<Value> = self.nodes.into_iter().chain(self.groups).chain([upright]).collect();
        let meshes: Vec<Value> = (0..2 * self.paints.len()).map(|k| mesh(k / 2, k % 2)).collect();
        let document = json!({
            "asset": { "version": "2.0", "generator": program },
            "scene": 0,
            "scenes": [{ "nodes": [root] }],
            "nodes": nodes,
            "meshes": meshes,
            "materials": self.paints.iter().map(material).collect::<Vec<_>>(),
            "accessors": accessors,
            "bufferViews": views,
            "buffers": [{ "byteLength": binary.len() }],
        });
        file(&document.to_string(), binary)
    }
}

fn material(paint: &Paint) -> Value {
    let [r, g, b] = paint.color;
    let surface = json!({ "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8 });
    json!({ "name": paint.name, "pbrMetallicRoughness": surface })
}

/// Accessors of a shape come in threes: places, normals, corners of triangles.
fn mesh(paint: usize, shape: usize) -> Value {
    let first = 3 * shape;
    let attributes = json!({ "POSITION": first, "NORMAL": first + 1 });
    json!({ "primitives": [{ "attributes": attributes, "indices": first + 2, "material": paint }] })
}

/// Places, normals, corners of triangles.
type Shape = (Vec<[f32; 3]>, Vec<[f32; 3]>, Vec<u16>);

/// A closed side; a cone has a foot too.
fn shape(solid: Solid) -> Shape {
    let (mut places, mut normals, mut corners): Shape = Default::default();
    let top = if solid == Solid::Tube { 1.0 } else { 0.0 };
    for k in 0..SIDES {
        let (s, c) = (std::f32::consts::TAU * f32::from(k) / f32::from(SIDES)).sin_cos();
        places.extend([[c, s, 0.0], [top * c, top * s, 1.0]]);
        normals.extend([[c, s, 0.0]; 2]);
        let next = 2 * ((k + 1) % SIDES);
        corners.extend([2 * k, next, next + 1, 2 * k, next + 1, 2 * k + 1]);
    }
    if solid == Solid::Cone {
        let first = 2 * SIDES;
        for k in 0..SIDES {
            places.push(places[usize::from(2 * k)]);
            normals.push([0.0, 0.0, -1.0]);
            if k > 1 {
                corners.extend([first, first + k, first + k - 1]);
            }
        }
    }
    (places, normals, corners)
}

/// All shapes in one buffer, with its views and accessors.
fn packed(shapes: &[Shape]) -> (Vec<u8>, Vec<Value>, Vec<Value>) {
    let (mut binary, mut views, mut accessors) = (Vec::new(), Vec::new(), Vec::new());
    for (places, normals, corners) in shapes {
        for (list, has_range) in [(places, true), (normals, false)] {
            let bytes: Vec<u8> = list.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
            views.push(view(&mut binary, &bytes, ARRAY_BUFFER));
            let mut accessor = json!({
                "bufferView": views.len() - 1, "componentType": FLOAT, "count": list.len(), "type": "VEC3"
            });
            if has_range {
                let ends = |pick: fn(f32, f32) -> f32, from: f32| {
                    [0, 1, 2].map(|axis| list.iter().map(|p| p[axis]).fold(from, pick))
                };
                accessor["min"] = json!(ends(f32::min, f32::INFINITY));
                accessor["max"] = json!(ends(f32::max, f32::NEG_INFINITY));
            }
            accessors.push(accessor);
        }
        let bytes: Vec<u8> = corners.iter().flat_map(|k| k.to_le_bytes()).collect();
        views.push(view(&mut binary, &bytes, ELEMENT_ARRAY_BUFFER));
        accessors.push(json!({
            "bufferView": views.len() - 1, "componentType": UNSIGNED_SHORT, "count": corners.len(), "type": "SCALAR"
        }));
    }
    (binary, views, accessors)
}

/// A view of bytes, which are put behind those that are there, at a multiple of four.
fn view(binary: &mut Vec<u8>, bytes: &[u8], target: u32) -> Value {
    let offset = binary.len();
    binary.extend(bytes);
    binary.resize(binary.len().next_multiple_of(4), 0);
    json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len(), "target": target })
}

/// Header, JSON, binary.
fn file(document: &str, binary: Vec<u8>) -> Vec<u8> {
    let mut text = document.as_bytes().to_vec();
    text.resize(text.len().next_multiple_of(4), b' ');
    let whole = HEADER_BYTES + 2 * CHUNK_HEADER_BYTES + text.len() + binary.len();
    let mut out = Vec::with_capacity(whole);
    // A scene of some thousand nodes is far below 4 GB.
    let length = |n: usize| u32::try_from(n).unwrap_or(u32::MAX).to_le_bytes();
    out.extend(b"glTF");
    out.extend(2u32.to_le_bytes());
    out.extend(length(whole));
    for (kind, chunk) in [(b"JSON", text), (b"BIN\0", binary)] {
        out.extend(length(chunk.len()));
        out.extend(kind);
        out.extend(chunk);
    }
    out
}
