//! Legs numbered one way at the base and another way at the platform; the two sides exchanged.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;

use super::{Misstatement, MisstatementEntry};

const ORDER: &[&str] = &["leg-order"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Machine "platform-joints-shifted-1" "Numbers of the platform joints begin one joint further on.", ORDER
        => Order::Platform([1, 2, 3, 4, 5, 0]);
    Machine "platform-joints-shifted-2" "Numbers of the platform joints begin two joints further on.", ORDER
        => Order::Platform([2, 3, 4, 5, 0, 1]);
    Machine "base-joints-shifted-1" "Numbers of the base joints begin one joint further on.", ORDER
        => Order::Base([1, 2, 3, 4, 5, 0]);
    Machine "platform-joints-reversed" "Platform joints are numbered clockwise, base joints counterclockwise.",
        &["leg-order", "axes"] => Order::Platform([5, 4, 3, 2, 1, 0]);
    Machine "platform-joints-1-2-exchanged" "Platform joints 1 and 2 are exchanged.", ORDER
        => Order::Platform([1, 0, 2, 3, 4, 5]);
    Machine "base-joints-3-4-exchanged" "Base joints 3 and 4 are exchanged.", ORDER
        => Order::Base([0, 1, 3, 2, 4, 5]);
    Machine "platform-mirrored" "The platform is drawn from below: its joints have the opposite y.",
        &["axes", "leg-order", "geometry"] => Sides::PlatformMirrored;
    Machine "joints-exchanged" "Joints of the base stand as joints of the platform, and the other way round.",
        &["joints-exchanged"] => Sides::Exchanged;
];

/// Joints of one side in another order: leg `i` gets the joint of leg `order[i]`.
#[derive(Debug)]
enum Order {
    Base([usize; 6]),
    Platform([usize; 6]),
}

impl Misstatement for Order {
    fn describe(&self, hexapod: &mut Hexapod, _: &mut Pcg64) {
        let (joints, order) = match self {
            Self::Base(order) => (&mut hexapod.base_joints, order),
            Self::Platform(order) => (&mut hexapod.platform_joints, order),
        };
        let drawn = *joints;
        *joints = order.map(|leg| drawn[leg]);
    }
}

/// The two sides.
#[derive(Debug)]
enum Sides {
    Exchanged,
    PlatformMirrored,
}

impl Misstatement for Sides {
    fn describe(&self, hexapod: &mut Hexapod, _: &mut Pcg64) {
        match self {
            Self::Exchanged => std::mem::swap(&mut hexapod.base_joints, &mut hexapod.platform_joints),
            Self::PlatformMirrored => {
                hexapod.platform_joints = hexapod.platform_joints.map(|b| Vector3::new(b.x, -b.y, b.z));
            }
        }
    }
}
