//! Machines: the three rings of the reference cases in tests/data, and others.

use hexbench_core::{Hexapod, Vector3};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{pick, rounded};

/// Families of machines that [`draw`] knows.
pub const FAMILIES: &[&str] =
    &["ring_a", "ring_b", "ring_c", "random_ring", "cubic", "three_three", "irregular"];

/// Joints in pairs on two rings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Radius of the base joints, mm.
    pub base_radius_mm: f64,
    /// Half the angle between the two base joints of a pair, deg.
    pub base_half_angle_deg: f64,
    /// Radius of the platform joints, mm.
    pub platform_radius_mm: f64,
    /// Half the angle between the two platform joints of a pair, deg.
    pub platform_half_angle_deg: f64,
    /// Height of the platform joints over the base joints at the zero pose, mm.
    pub height_mm: f64,
}

/// Joint rings as the paper's published numbers suggest them.
pub const RING_A: Ring = ring_of(160.0, 10.0, 120.0, 10.0, 165.0);
/// Small platform on a wide base.
pub const RING_B: Ring = ring_of(150.0, 12.0, 85.0, 12.0, 200.0);
/// A flat, compact machine.
pub const RING_C: Ring = ring_of(115.0, 10.0, 90.0, 10.0, 95.0);

const fn ring_of(base: f64, base_half: f64, platform: f64, platform_half: f64, height: f64) -> Ring {
    Ring {
        base_radius_mm: base,
        base_half_angle_deg: base_half,
        platform_radius_mm: platform,
        platform_half_angle_deg: platform_half,
        height_mm: height,
    }
}

impl Ring {
    /// Base pairs about 0, 120 and 240 deg, platform pairs about 60, 180 and 300 deg; leg 1 and 2 start from the first
    /// base pair and part.
    pub fn hexapod(&self, name: &str) -> Hexapod {
        let base = std::array::from_fn(|i| {
            let side = if i % 2 == 0 { -1.0 } else { 1.0 };
            let turn = 120.0 * (i / 2) as f64 + side * self.base_half_angle_deg;
            on_circle(self.base_radius_mm, turn, -self.height_mm)
        });
        let platform = std::array::from_fn(|i| {
            let side = if i % 2 == 0 { -1.0 } else { 1.0 };
            let turn = 120.0 * (i / 2) as f64 + side * (60.0 - self.platform_half_angle_deg);
            on_circle(self.platform_radius_mm, turn, 0.0)
        });
        hexapod(name, base, platform)
    }
}

/// A machine of a family; an unknown name gives a random ring.
pub fn draw(family: &str, rng: &mut Pcg64) -> Hexapod {
    match family {
        "ring_a" => RING_A.hexapod(family),
        "ring_b" => RING_B.hexapod(family),
        "ring_c" => RING_C.hexapod(family),
        "cubic" => cubic(rng.random_range(200.0..500.0)),
        "three_three" => Ring { base_half_angle_deg: 0.0, platform_half_angle_deg: 0.0, ..random_ring(rng) }
            .hexapod(family),
        "irregular" => irregular(rng),
        _ => random_ring(rng).hexapod("random_ring"),
    }
}

fn random_ring(rng: &mut Pcg64) -> Ring {
    let base = rng.random_range(80.0..400.0);
    let platform = base * rng.random_range(0.5..0.95);
    ring_of(
        base,
        rng.random_range(5.0..25.0),
        platform,
        rng.random_range(5.0..25.0),
        base * rng.random_range(0.5..1.6),
    )
}

/// Legs along six edges of a cube that stands on a corner, each the middle 80 % of its edge.
pub fn cubic(edge_mm: f64) -> Hexapod {
    const END: f64 = 0.1;
    let radius = edge_mm * (2.0_f64 / 3.0).sqrt();
    let rise = edge_mm / 3.0_f64.sqrt();
    let ends = |i: usize| {
        let side = if i.is_multiple_of(2) { -60.0 } else { 60.0 };
        let turn = 120.0 * (i / 2) as f64;
        (on_circle(radius, turn, 0.0), on_circle(radius, turn + side, rise))
    };
    let drop = Vector3::new(0.0, 0.0, rise * (1.0 - END));
    let joint = |i: usize, share: f64| {
        let (low, high) = ends(i);
        low + (high - low) * share - drop
    };
    hexapod("cubic", std::array::from_fn(|i| joint(i, END)), std::array::from_fn(|i| joint(i, 1.0 - END)))
}

/// A random ring whose joints have all been moved by some percent.
fn irregular(rng: &mut Pcg64) -> Hexapod {
    const SHARE: f64 = 0.08;
    let ring = random_ring(rng);
    let plain = ring.hexapod("irregular");
    let mut moved = |joint: &Vector3, size: f64| {
        let shift: Vector3 = Vector3::from_fn(|_, _| StandardNormal.sample(rng));
        joint * 1e3 + shift * (SHARE * size)
    };
    let base = plain.base_joints.map(|a| moved(&a, ring.base_radius_mm));
    let platform = plain.platform_joints.map(|b| moved(&b, ring.platform_radius_mm));
    hexapod("irregular", base, platform)
}

/// Leg stiffness as on the paper's machine with 10 % scatter, times a common factor for machines of another make, N/m.
pub fn leg_stiffness(family: &str, rng: &mut Pcg64) -> [f64; 6] {
    const PAPER_N_PER_M: [f64; 6] = [4.1981e6, 3.7898e6, 2.7503e6, 4.32e6, 3.6716e6, 3.7288e6];
    const SCATTER: f64 = 0.1;
    let factor = if family.starts_with("ring_") { 1.0 } else { pick(rng, &[0.5, 1.0, 2.0, 4.0]) };
    PAPER_N_PER_M.map(|k| {
        let scatter: f64 = StandardNormal.sample(rng);
        k * factor * (SCATTER * scatter).exp()
    })
}

fn on_circle(radius: f64, turn_deg: f64, z: f64) -> Vector3 {
    let (s, c) = turn_deg.to_radians().sin_cos();
    Vector3::new(radius * c, radius * s, z)
}

/// A hexapod from joints in mm, rounded to the decimals of its file.
fn hexapod(name: &str, base_mm: [Vector3; 6], platform_mm: [Vector3; 6]) -> Hexapod {
    let metres = |joint: Vector3| joint.map(|x| rounded(x) * 1e-3);
    Hexapod::of_joints(name, base_mm.map(metres), platform_mm.map(metres))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legs_of_the_cubic_machine_are_parallel_or_perpendicular() {
        let machine = cubic(300.0);
        let n: [Vector3; 6] =
            std::array::from_fn(|i| (machine.platform_joints[i] - machine.base_joints[i]).normalize());
        for i in 0..6 {
            for j in 0..i {
                let cosine = n[i].dot(&n[j]).abs();
                assert!(!(1e-7..=1.0 - 1e-7).contains(&cosine), "legs {i} {j}: {cosine}");
            }
        }
    }

    #[test]
    fn ring_b_is_the_machine_of_the_reference_cases() {
        let machine = RING_B.hexapod("ring_b");
        let expected = Vector3::new(0.100_369_591, 0.111_471_724, 0.2) * -1.0;
        assert!((machine.base_joints[4] - expected).amax() < 1e-9);
        let expected = Vector3::new(0.026_266_444_5, -0.080_839_803_9, 0.0);
        assert!((machine.platform_joints[5] - expected).amax() < 1e-9);
    }
}
