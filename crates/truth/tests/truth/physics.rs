//! Laws that any equilibrium obeys, checked by routes of their own.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Approach, Hexapod, Matrix3, Matrix6, Pose, Vector3, Vector6, Wrench};
use hexbench_truth::{
    LegMemory, Mechanism, Situation, TruthError, World,
    campaign::machines,
    mechanisms::{
        BaseCompliance, Creep, CreepLaw, JointFriction, JointRotationStiffness, LegBacklash,
        LegLengthCompliance, LegNonlinearity, PlatformCompliance, REGISTRY, Shows, TargetOffset,
    },
};

const STIFFNESS: [f64; 6] = [4.2e6, 3.8e6, 2.8e6, 4.3e6, 3.7e6, 3.6e6];

fn ring() -> World {
    World::new(machines::RING_A.hexapod("ring_a"), &STIFFNESS)
}

fn pose() -> Pose {
    Pose::from_array([0.02, -0.013, 0.006, 0.09, -0.06, 0.11])
}

fn wrench() -> Wrench {
    Wrench::from_array([80.0, -50.0, -330.0, 6.0, -4.0, 3.0])
}

fn situation() -> Situation {
    Situation {
        reference: Wrench::from_array([0.0, 0.0, -119.682, 0.0, 0.0, 0.0]),
        delta_t: 0.4,
        elapsed: 250.0,
        ..Situation::new(pose(), wrench())
    }
}

/// Leg rates from the geometric twist, written down anew.
fn leg_jacobian(hexapod: &Hexapod, pose: &Pose) -> Matrix6 {
    let r = pose.rotation();
    Matrix6::from_fn(|i, j| {
        let arm = r * hexapod.platform_joints[i];
        let n = (pose.translation + arm - hexapod.base_joints[i]).normalize();
        if j < 3 { n[j] } else { arm.cross(&n)[j - 3] }
    })
}

/// Euler differences of a small rotation vector at a pose.
fn euler_differences(pose: &Pose, rotation: &Vector3) -> Vector3 {
    let turn = |beta: f64, gamma: f64| Pose::from_array([0.0, 0.0, 0.0, 0.0, beta, gamma]).rotation();
    let columns = [
        turn(pose.angles.y, pose.angles.z) * Vector3::x(),
        turn(0.0, pose.angles.z) * Vector3::y(),
        Vector3::z(),
    ];
    Matrix3::from_columns(&columns).try_inverse().unwrap() * rotation
}

fn scaled(wrench: &Wrench, factor: f64) -> Wrench {
    Wrench { force: wrench.force * factor, moment: wrench.moment * factor }
}

#[test]
fn small_loads_give_the_linear_answer_and_the_error_falls_with_the_load() {
    let world = ring();
    let l = leg_jacobian(&world.hexapod, &pose());
    let inverse = l.try_inverse().unwrap();
    let compliance =
        inverse * Matrix6::from_diagonal(&Vector6::from(STIFFNESS.map(f64::recip))) * inverse.transpose();
    for factor in [1.0, 0.1, 0.01] {
        let load = scaled(&wrench(), factor);
        let twist = compliance * load.to_vector();
        let angles = euler_differences(&pose(), &twist.fixed_rows::<3>(3).into_owned());
        let found = world.deflection(&Situation::new(pose(), load)).unwrap();
        let error = (found.fixed_rows::<3>(0) - twist.fixed_rows::<3>(0)).norm()
            / twist.fixed_rows::<3>(0).norm()
            + (found.fixed_rows::<3>(3) - angles).norm() / angles.norm();
        // Order load / (k q), with k q = 2.8e6 N/m * 0.19 m.
        let order = 330.0 * factor / (2.8e6 * 0.19);
        assert!(error < 5.0 * order && error > 0.01 * order, "{factor}: {error:e} against {order:e}");
    }
}

#[test]
fn legs_balance_the_wrench_at_the_deflected_pose() {
    let world = ring();
    let at = world.reading(&Situation::new(pose(), wrench())).unwrap();
    let l = leg_jacobian(&world.hexapod, &at.pose);
    let balance = l.transpose() * Vector6::from(at.equilibrium.forces) - wrench().to_vector();
    assert!(balance.amax() < 1e-7, "{balance}");
}

#[test]
fn work_of_the_load_is_the_energy_of_the_legs() {
    const STEPS: u32 = 2000;
    let world = ring()
        .with(Box::new(LegNonlinearity { kappa: 1e-7, power: 2.0 / 3.0 }))
        .with(Box::new(LegBacklash { gap: 2e-6, width: 0.0 }));
    let (mut work, mut energy) = (0.0, 0.0);
    let state = |step: u32| {
        let load = scaled(&wrench(), f64::from(step) / f64::from(STEPS));
        (load, world.reading(&Situation::new(pose(), load)).unwrap().equilibrium)
    };
    let mut last = state(1);
    for step in 2..=STEPS {
        let now = state(step);
        let moved = now.1.platform.relative_to(&last.1.platform);
        let axes = last.1.platform.axes;
        work += (now.0.force + last.0.force).dot(&(now.1.platform.origin - last.1.platform.origin)) * 0.5;
        work += (now.0.moment + last.0.moment).dot(&(axes * moved.fixed_rows::<3>(3))) * 0.5;
        for leg in 0..6 {
            let mean_force = 0.5 * (now.1.forces[leg] + last.1.forces[leg]);
            energy += mean_force * (now.1.elongations[leg] - last.1.elongations[leg]);
        }
        last = now;
    }
    assert!((work / energy - 1.0).abs() < 1e-5, "work {work:e} J, energy {energy:e} J");
}

/// To first order stiff joints add `k G'G`, `G` the change of direction of the leg in the axes of the body at that end.
#[test]
fn stiff_joints_add_the_stiffness_of_their_bending() {
    let world = ring();
    let l = leg_jacobian(&world.hexapod, &pose());
    let spring = l.transpose() * Matrix6::from_diagonal(&Vector6::from(STIFFNESS)) * l;
    let load = scaled(&wrench(), 0.01);
    let bare = world.reading(&Situation::new(pose(), load)).unwrap().equilibrium.platform;
    for (base, platform) in [(50.0, 0.0), (0.0, 50.0)] {
        let joints = JointRotationStiffness { base, platform };
        let at = ring()
            .with(Box::new(joints))
            .reading(&Situation::new(pose(), load))
            .unwrap()
            .equilibrium
            .platform;
        let mut added = Matrix6::zeros();
        for leg in 0..6 {
            let arm = pose().rotation() * world.hexapod.platform_joints[leg];
            let vector = pose().translation + arm - world.hexapod.base_joints[leg];
            let (q, n) = (vector.norm(), vector.normalize());
            let across = (Matrix3::identity() - n * n.transpose()) / q;
            let mut g = nalgebra::Matrix3x6::zeros();
            g.fixed_columns_mut::<3>(0).copy_from(&across);
            let turned = if platform > 0.0 { n.cross_matrix() } else { Matrix3::zeros() };
            g.fixed_columns_mut::<3>(3).copy_from(&(turned - across * arm.cross_matrix()));
            added += g.transpose() * g * (base + platform);
        }
        let expected = (spring + added).try_inverse().unwrap() * load.to_vector()
            - spring.try_inverse().unwrap() * load.to_vector();
        let shift = at.origin - bare.origin;
        let turn = bare.axes * at.relative_to(&bare).fixed_rows::<3>(3);
        let error = (shift - expected.fixed_rows::<3>(0)).norm() / expected.fixed_rows::<3>(0).norm()
            + (turn - expected.fixed_rows::<3>(3)).norm() / expected.fixed_rows::<3>(3).norm();
        assert!(error < 1e-2, "base {base}, platform {platform}: {error:e}");
    }
}

/// Maxwell and Betti: the deflection at one place by a unit load at another is that with places exchanged.
#[test]
fn structures_that_store_energy_have_a_symmetric_compliance() {
    const NOT_LINEAR: &[&str] = &["leg-nonlinearity", "leg-asymmetry", "leg-backlash", "joint-friction"];
    const LOAD_IS_ELSEWHERE: &[&str] = &["load-offset", "load-tilt"];
    for effect in
        REGISTRY.iter().filter(|e| !NOT_LINEAR.contains(&e.id) && !LOAD_IS_ELSEWHERE.contains(&e.id))
    {
        let world =
            ring().with((effect.draw)(&ring().hexapod, &mut stream(5, Purpose::Test, [9])).scaled(3.0));
        let at = |wrench: [f64; 6]| {
            let rest = Situation::new(pose(), Wrench::from_array(wrench));
            world.reading(&rest).unwrap().equilibrium.platform
        };
        // Small loads, so that dead moments turn no further than the tolerance; radius for one unit throughout.
        let unit = [1.0, 1.0, 1.0, 0.12, 0.12, 0.12].map(|u| 5.0 * u);
        let columns: [Vector6; 6] = std::array::from_fn(|k| {
            let load = |sign: f64| std::array::from_fn(|j| if j == k { sign * unit[k] } else { 0.0 });
            let (plus, minus) = (at(load(1.0)), at(load(-1.0)));
            let turn = minus.axes * plus.relative_to(&minus).fixed_rows::<3>(3);
            let shift = plus.origin - minus.origin;
            Vector6::from_fn(|j, _| unit[j] * if j < 3 { shift[j] } else { turn[j - 3] })
        });
        let compliance = Matrix6::from_columns(&columns);
        let asymmetry = (compliance - compliance.transpose()).amax() / compliance.amax();
        assert!(asymmetry < 3e-4, "{}: {asymmetry:e}", effect.id);
    }
}

#[test]
fn a_yielding_base_or_plate_moves_by_force_over_stiffness() {
    let load = Wrench::from_array([0.0, 0.0, -300.0, 0.0, 0.0, 0.0]);
    let home = Situation::new(Pose::default(), load);
    let stiffness = [2e8, 2e8, 4e8, 4e6, 4e6, 4e6];
    let bare = ring().deflection(&home).unwrap();
    let mechanisms: [Box<dyn Mechanism>; 2] =
        [Box::new(BaseCompliance { stiffness }), Box::new(PlatformCompliance { stiffness })];
    for mechanism in mechanisms {
        let added = ring().with(mechanism).deflection(&home).unwrap() - bare;
        assert!((added.z / (-300.0 / 4e8) - 1.0).abs() < 1e-3, "{added}");
    }
}

#[test]
fn a_tall_base_tips_under_a_lateral_force() {
    let load = Wrench::from_array([100.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let base = BaseCompliance { stiffness: [1e12, 1e12, 1e12, 4e6, 4e6, 4e6] };
    let home = Situation::new(Pose::default(), load);
    let added = ring().with(Box::new(base)).deflection(&home).unwrap() - ring().deflection(&home).unwrap();
    // The mobile origin is 165 mm above the base center: moment 16.5 N m about y.
    assert!((added[4] / (16.5 / 4e6) - 1.0).abs() < 1e-3, "{added}");
    assert!((added[0] / (0.165 * 16.5 / 4e6) - 1.0).abs() < 1e-3, "{added}");
}

#[test]
fn an_offset_target_sees_the_rotation_between_the_states() {
    let point = [0.01, -0.02, 0.03];
    let world = ring().with(Box::new(TargetOffset { point }));
    let bare = ring();
    let at = |w: Wrench| bare.pose(&Situation::new(pose(), w)).unwrap().rotation();
    let expected = (at(situation().wrench) - at(situation().reference)) * Vector3::from(point);
    let added = world.deflection(&situation()).unwrap() - bare.deflection(&situation()).unwrap();
    assert!((added.fixed_rows::<3>(0) - expected).norm() < 1e-15);
    assert!(added.fixed_rows::<3>(3).norm() < 1e-15);
}

#[test]
fn only_friction_remembers_the_path() {
    for effect in REGISTRY {
        let world = ring().with((effect.draw)(&ring().hexapod, &mut stream(3, Purpose::Test, [5])));
        let up = world.deflection(&situation()).unwrap();
        let down = world.deflection(&Situation { approach: Approach::Overloaded, ..situation() }).unwrap();
        let change = (up - down).amax();
        if effect.id == "joint-friction" {
            assert!(change > 1e-8, "{}: {change:e}", effect.id);
        } else {
            assert!(change < 1e-14, "{}: {change:e}", effect.id);
        }
    }
}

#[test]
fn coming_back_leaves_the_springs_behind_by_twice_the_friction() {
    let slider_force = 2.0;
    let world = ring().with(Box::new(JointFriction { slider_force, stick_ratio: None }));
    let springs = |approach: Approach| {
        let load = Situation { approach, ..Situation::new(pose(), scaled(&wrench(), 3.0)) };
        world.reading(&load).unwrap().equilibrium.memory
    };
    // The overshoot is 0.4 of the leg force; below 10 N it does not push a slider all the way to the other side.
    let reversed = |up: &LegMemory| up.force.abs() > 10.0;
    for (up, down) in
        springs(Approach::Direct).iter().zip(springs(Approach::Overloaded)).filter(|(up, _)| reversed(up))
    {
        let (lag_up, lag_down) = (up.force - up.spring_force, down.force - down.spring_force);
        assert!(((lag_up - lag_down).abs() - 2.0 * slider_force).abs() < 1e-9, "{up:?} {down:?}");
    }
}

#[test]
fn a_mirrored_load_on_a_mirror_symmetric_machine_gives_the_mirrored_deflection() {
    const SIGNS: [f64; 6] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
    const PARTNERS: [usize; 6] = [1, 0, 5, 4, 3, 2];
    const WITHOUT_A_SIDE: [&str; 9] = [
        "leg-length-compliance",
        "leg-nonlinearity",
        "leg-asymmetry",
        "leg-backlash",
        "joint-friction",
        "joint-rotation-stiffness",
        "bracket-compliance",
        "leg-coupling",
        "thermal-expansion",
    ];
    let flip = |x: [f64; 6]| std::array::from_fn(|k| SIGNS[k] * x[k]);
    let mirrored = Situation {
        pose: Pose::from_array(flip(pose().to_array())),
        wrench: Wrench::from_array(flip(wrench().to_array())),
        ..situation()
    };
    for id in WITHOUT_A_SIDE {
        let with = |stiffness: [f64; 6]| {
            let hexapod = machines::RING_A.hexapod("ring_a");
            let effect = hexbench_truth::mechanisms::effect(id).unwrap();
            let mechanism = (effect.draw)(&hexapod, &mut stream(2, Purpose::Test, [2])).scaled(3.0);
            World::new(hexapod, &stiffness).with(mechanism)
        };
        let one = with(STIFFNESS).deflection(&situation()).unwrap();
        let other = with(PARTNERS.map(|i| STIFFNESS[i])).deflection(&mirrored).unwrap();
        // Joints are rounded to a nanometre on either side alike, so only rounding is left.
        let difference = (Vector6::from(flip(other.into())) - one).amax();
        assert!(difference < 1e-13, "{id}: {difference:e}");
    }
}

#[test]
fn the_choice_of_the_fixed_frame_does_not_matter() {
    let q = Pose::from_array([0.0, 0.0, 0.0, 0.4, -0.7, 1.9]).rotation();
    let world = ring().with(Box::new(LegNonlinearity { kappa: 1e-7, power: 1.5 }));
    let mut turned = World { hexapod: world.hexapod.clone(), ..ring() };
    turned.mechanisms.push(world.mechanisms[0].scaled(1.0));
    turned.hexapod.base_joints = world.hexapod.base_joints.map(|a| q * a);
    turned.hexapod.platform_joints = world.hexapod.platform_joints.map(|b| q * b);
    let one = world.pose(&Situation::new(pose(), wrench())).unwrap();
    let load = Wrench { force: q * wrench().force, moment: q * wrench().moment };
    let commanded = Pose::from_rotation(q * pose().translation, &(q * pose().rotation() * q.transpose()));
    let other = turned.pose(&Situation::new(commanded, load)).unwrap();
    assert!((q * one.translation - other.translation).norm() < 1e-14);
    assert!((q * one.rotation() * q.transpose() - other.rotation()).amax() < 1e-13);
}

#[test]
fn an_effect_of_no_size_leaves_the_baseline_and_one_of_usual_size_does_not() {
    let bare = ring();
    for effect in REGISTRY {
        let usual = (effect.draw)(&bare.hexapod, &mut stream(7, Purpose::Test, [7]));
        let read = |world: &World| match effect.shows {
            Shows::Absolute => world.pose(&situation()).unwrap().to_vector(),
            _ => world.deflection(&situation()).unwrap(),
        };
        let none = (read(&ring().with(usual.scaled(0.0))) - read(&bare)).amax();
        let some = (read(&ring().with(usual)) - read(&bare)).amax();
        assert!(none < 1e-15, "{}: {none:e}", effect.id);
        assert!(some > 1e-9, "{}: {some:e}", effect.id);
    }
}

#[test]
fn a_platform_similar_to_its_base_is_singular() {
    let mut world = ring();
    world.hexapod.platform_joints =
        world.hexapod.base_joints.map(|a| Vector3::new(0.7 * a.x, 0.7 * a.y, 0.0));
    let result = world.deflection(&Situation::new(Pose::default(), wrench()));
    assert!(matches!(result, Err(TruthError::Singular { .. })), "{result:?}");
}

#[test]
fn a_load_that_pushes_the_platform_away_is_an_error() {
    let result = ring().deflection(&Situation::new(pose(), scaled(&wrench(), 1e4)));
    assert!(result.is_err(), "{result:?}");
}

#[test]
fn a_leg_that_would_lengthen_under_compression_is_refused() {
    let with_slope = |slope: f64| {
        let mut world = ring();
        world.mechanisms.push(Box::new(LegLengthCompliance { slope }));
        world.reading(&situation())
    };
    assert!(with_slope(4e-7).is_ok());
    assert!(matches!(with_slope(4e-4), Err(TruthError::NoSpring { .. })));
}

#[test]
fn lengths_outside_the_stroke_are_unreachable() {
    let mut world = ring();
    world.hexapod.stroke = Some([0.18, 0.21]);
    let result =
        world.deflection(&Situation::new(Pose::from_array([0.0, 0.0, 0.03, 0.0, 0.0, 0.0]), wrench()));
    assert!(matches!(result, Err(TruthError::Unreachable { .. })), "{result:?}");
}

#[test]
fn numbers_that_are_none_are_refused() {
    let mut bad_pose = situation();
    bad_pose.pose.translation.x = f64::NAN;
    let mut bad_load = situation();
    bad_load.wrench.force.z = f64::INFINITY;
    for bad in [bad_pose, bad_load] {
        let result = ring().deflection(&bad);
        assert!(matches!(result, Err(TruthError::NotFinite { .. })), "{result:?}");
    }
}

#[test]
fn newton_takes_few_steps() {
    const MOST: [(&str, usize); 4] =
        [("leg-nonlinearity", 4), ("joint-friction", 4), ("base-compliance", 5), ("bracket-compliance", 5)];
    for (id, most) in MOST {
        let effect = hexbench_truth::mechanisms::effect(id).unwrap();
        let world = ring().with((effect.draw)(&ring().hexapod, &mut stream(1, Purpose::Test, [1])));
        let steps = world.reading(&Situation::new(pose(), wrench())).unwrap().equilibrium.iterations;
        assert!(steps <= most, "{id}: {steps}");
    }
}

/// Legs in the middle of their play: the platform is where it was commanded, and each leg gives half its play to either
/// side.
#[test]
fn the_unloaded_machine_rests_in_the_middle_of_its_play() {
    const GAP_M: f64 = 4e-6;
    const ROUNDING_M: f64 = 1e-15;
    let loose = ring().with(Box::new(LegBacklash { gap: GAP_M, width: 0.0 }));
    let unloaded = loose.reading(&Situation::new(pose(), Wrench::default())).unwrap();
    let off = (unloaded.pose.to_vector() - pose().to_vector()).amax();
    assert!(off < ROUNDING_M, "{off} m or rad from the command");
    let situation = Situation::new(pose(), wrench());
    let [tight, loose] = [ring(), loose].map(|world| world.deflection(&situation).unwrap());
    let forces = ring().reading(&situation).unwrap().equilibrium.forces;
    let expected = forces.map(|f| 0.5 * GAP_M * f.signum());
    let legs = leg_jacobian(&machines::RING_A.hexapod("ring_a"), &pose()) * twist(&(loose - tight));
    for (leg, (found, expected)) in legs.iter().zip(expected).enumerate() {
        // Second order: deflections of 1e-4 of the leg length turn the legs by as much.
        assert!((found - expected).abs() < 1e-3 * GAP_M, "leg {}: {found} not {expected}", leg + 1);
    }
}

/// Rotation vector instead of Euler differences, first order.
fn twist(deflection: &Vector6) -> Vector6 {
    let angles = pose().angles;
    let ((sb, cb), (sg, cg)) = (angles.y.sin_cos(), angles.z.sin_cos());
    let axes = Matrix3::new(cg * cb, -sg, 0.0, sg * cb, cg, 0.0, -sb, 0.0, 1.0);
    let turn = axes * deflection.fixed_rows::<3>(3);
    Vector6::new(deflection.x, deflection.y, deflection.z, turn.x, turn.y, turn.z)
}

/// Superposition: what a preload of an age yields after the reference reading is what it yields from its own beginning on, less what it
/// had yielded by then.
#[test]
fn creep_of_a_preload_goes_on_where_it_was() {
    const TAU_S: f64 = 120.0;
    let creep = |age, law| Creep { age, law, ..Creep::new(0.05, TAU_S) };
    let held = |elapsed| Situation { wrench: situation().reference, elapsed, ..situation() };
    for law in [CreepLaw::Exponential, CreepLaw::Logarithmic] {
        let moved = |age: f64, elapsed: f64| {
            ring().with(Box::new(creep(Some(age), law))).deflection(&held(elapsed)).unwrap()
        };
        let (whole, first, then) = (moved(0.0, 250.0), moved(0.0, 100.0), moved(100.0, 150.0));
        let size = whole.amax();
        assert!(
            (whole - first - then).amax() < 1e-4 * size,
            "{law:?}: {}",
            (whole - first - then).amax() / size
        );
        assert!(size > 1e-8 && then.amax() < whole.amax(), "{law:?}");
    }
    // Settled, as ever: nothing happens under the reference load.
    let settled = ring().with(Box::new(Creep::new(0.05, TAU_S))).deflection(&held(250.0)).unwrap();
    assert!(settled.amax() < 1e-15, "{}", settled.amax());
    // A plan that states the age has the last word.
    let stated = Situation { reference_age: Some(1e9), ..held(250.0) };
    let fresh = ring().with(Box::new(creep(Some(0.0), CreepLaw::Exponential)));
    assert!(fresh.deflection(&stated).unwrap().amax() < 1e-15);
}

/// A contact of no width is the ideal one, a wide one moves the platform less.
#[test]
fn a_soft_contact_closes_over_its_width() {
    let moved = |width: f64| {
        let play = Box::new(LegBacklash { gap: 4e-6, width });
        (ring().with(play).deflection(&situation()).unwrap() - ring().deflection(&situation()).unwrap())
            .amax()
    };
    assert!((moved(1e-6) - moved(0.0)).abs() < 1e-12);
    assert!(moved(300.0) < 0.9 * moved(0.0), "{} {}", moved(300.0), moved(0.0));
}
