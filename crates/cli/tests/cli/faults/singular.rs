//! Machines ever nearer to a pose in which their legs do not hold them.

use hexbench_core::{Matrix6, Pose, Vector3, Vector6};
use hexbench_model::machine::kinematics::Legs;

use super::bench::{Bench, Share};
use super::chance::Chance;
use super::fate::{Answer, Fate};

/// Stiffness of each leg, N/um.
const STIFFNESS: [f64; 6] = [3.0, 3.5, 4.0, 4.5, 5.0, 5.5];
/// Standard uncertainties by which a printed stiffness may be off.
const HONEST_SIGMAS: f64 = 5.0;
/// Largest motion, m and rad, and as a share of the way to the singular pose: deflections stay linear.
const LARGEST: f64 = 2e-5;
const LARGEST_SHARE: f64 = 1e-3;
const SIGMAS: [f64; 6] = [5e-8, 5e-8, 5e-8, 3e-7, 3e-7, 3e-7];
const REPEATS: usize = 4;

/// Six joints in pairs on a ring.
fn ring(radius: f64, gap_deg: f64, turn_deg: f64, z: f64) -> [Vector3; 6] {
    std::array::from_fn(|k| {
        let side = if k % 2 == 0 { -gap_deg } else { gap_deg };
        let angle = (turn_deg + 120.0 * (k / 2) as f64 + side).to_radians();
        Vector3::new(radius * angle.cos(), radius * angle.sin(), z)
    })
}

/// A machine that is singular when its platform is turned by a right angle, and its readings at `short_deg` before that.
struct Rung {
    base: [Vector3; 6],
    platform: [Vector3; 6],
    pose: Pose,
    /// Largest motion, m and rad.
    largest: f64,
}

impl Rung {
    fn at(short_deg: f64) -> Self {
        let [base, platform] = [ring(0.15, 10.0, 0.0, -0.2), ring(0.1, 50.0, 0.0, 0.0)];
        Self {
            base,
            platform,
            pose: Pose::from_array([0.0, 0.0, 0.0, 0.0, 0.0, (90.0 - short_deg).to_radians()]),
            largest: LARGEST.min(LARGEST_SHARE * short_deg.to_radians()),
        }
    }

    fn machine(&self) -> String {
        let joints = |side: &[Vector3; 6]| {
            side.map(|j| format!("  [{}, {}, {}],\n", j.x * 1e3, j.y * 1e3, j.z * 1e3)).concat()
        };
        format!(
            "format = \"hexapod/1\"\nname = \"near\"\n[geometry]\nbase_joints_mm = [\n{}]\nplatform_joints_mm = [\n{}]\n\
             [metrology]\nsigma_translation_um = {}\nsigma_rotation_urad = {}\n",
            joints(&self.base),
            joints(&self.platform),
            SIGMAS[0] * 1e6,
            SIGMAS[3] * 1e6
        )
    }

    /// Rows under forces along each leg, to first order; none beyond what the model takes for regular.
    fn readings(&self) -> String {
        let head = "a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
                    da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad,repeat\n";
        let legs = Legs::at(&self.base, &self.platform, &self.pose).ok();
        let compliances = Vector6::from_fn(|k, _| 1e-6 / STIFFNESS[k]);
        let mut chance = Chance(8);
        let mut text = head.to_owned();
        for row in 0..12 * REPEATS {
            let force = Vector6::from_fn(
                |k, _| if k == row % 6 { 1.0 } else { 0.2 } * if row / 6 % 2 == 0 { 1.0 } else { -0.7 },
            );
            let (jacobian, inverse) = legs.as_ref().map_or((Matrix6::identity(), Matrix6::identity()), |l| {
                (l.leg_jacobian, l.platform_jacobian)
            });
            let motion = inverse * compliances.component_mul(&force);
            let scale = (self.largest / motion.amax()).min(200.0);
            let wrench = jacobian.transpose() * force * scale;
            // Twelve even numbers make one that is nearly normal.
            let mut noise =
                || (0..12).map(|_| chance.below(1 << 20) as f64 / f64::from(1 << 20)).sum::<f64>() - 6.0;
            let read: Vec<String> =
                (0..6).map(|k| ((motion[k] * scale + SIGMAS[k] * noise()) * 1e6).to_string()).collect();
            let wrench: Vec<String> = wrench.iter().map(f64::to_string).collect();
            let gamma = self.pose.to_array()[5].to_degrees();
            let line =
                format!("0,0,0,0,0,{gamma},{},{},{}\n", wrench.join(","), read.join(","), row / 12 + 1);
            text.push_str(&line);
        }
        text
    }
}

/// Nothing printed is more certain than it is.
fn honest(answer: &Answer) -> Result<(), String> {
    let errors =
        answer.springs().iter().zip(STIFFNESS).map(|([value, std], truth)| (value - truth).abs() / std);
    let largest = errors.fold(0.0, f64::max);
    if largest <= HONEST_SIGMAS {
        Ok(())
    } else {
        Err(format!("{largest} standard uncertainties off: {answer:?}"))
    }
}

/// Sixteen rungs, half a power of ten apart and more.
pub(super) fn ladder(share: Share) -> Vec<Fate> {
    let rungs: Vec<f64> = (0..15).map(|k| 30.0 * 10_f64.powi(-k)).collect();
    let cases: Vec<_> =
        rungs.into_iter().flat_map(|short| ["fit", "diagnose"].map(|command| (short, command))).collect();
    share.each(&cases, |(short, command)| {
        let rung = Rung::at(*short);
        let bench = Bench::with(rung.machine(), rung.readings());
        let run = bench.run(&[command, "hexapod.toml", "measurements.csv", "--json", "-"]);
        if run.code != Some(0) {
            return Fate::of_refusal(&run);
        }
        let answer = Answer::of(&run);
        match honest(&answer) {
            Ok(()) => Fate::Survived,
            Err(_) if answer.is_told() => Fate::Told,
            Err(why) => Fate::Silent(why),
        }
    })
}
