//! A file of readings as it is understood.

use hexbench_core::words::to_digits;
use hexbench_core::{Dataset, Hexapod, Observation};
use serde::Serialize;

use super::machine::MachineCheck;
use super::stated::far_ratio;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::Fit;
use crate::estimation::noise::{NoiseSource, scatter};
use crate::machine::geometry::Machine;

/// Repeats may scatter by this factor more or less than stated without a remark.
const SCATTER_OFF: f64 = 1.5;
/// Springs alone that leave less than this share of the stated noise are no luck: with six degrees of freedom that has a chance of 1 %.
const BELOW_NOISE: f64 = 0.35;
/// Temperatures of a room, and those in kelvin, are above this, K; machines are seldom as much warmer than at their reference.
const ROOM_K: f64 = 10.0;
/// They differ by less than this share of the lowest.
const ROOM_SPREAD: f64 = 0.5;

/// A number of a remark.
fn three_digits(value: f64) -> f64 {
    to_digits(value, 3)
}

/// Smallest and largest of something.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Extent {
    /// The smallest.
    pub least: f64,
    /// The largest.
    pub most: f64,
}

impl Extent {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let none = Self { least: f64::INFINITY, most: f64::NEG_INFINITY };
        values.fold(none, |r, x| Self { least: r.least.min(x), most: r.most.max(x) })
    }
}

/// Readings and what they were taken at.
#[derive(Debug, Clone, Serialize)]
pub struct ReadingsCheck {
    /// Name of the file.
    pub file: String,
    /// What was read: `deflections` or `absolute poses`.
    pub measurand: &'static str,
    /// Rows.
    pub rows: usize,
    /// Different poses.
    pub poses: usize,
    /// Different conditions: pose, loads, approach, temperature, time.
    pub conditions: usize,
    /// Lengths of the legs over all poses, mm.
    pub leg_lengths_mm: Extent,
    /// Largest angle of a pose, degrees.
    pub largest_angle_deg: f64,
    /// Largest force, N.
    pub largest_force_n: f64,
    /// Largest moment, N m.
    pub largest_moment_nm: f64,
    /// Forces in the legs, tension positive, N.
    pub leg_forces_n: Extent,
    /// Root mean square of the lengths read, um; of deflections only, and none where none is read.
    pub translation_rms_um: Option<f64>,
    /// Root mean square of the angles read, urad; likewise.
    pub rotation_rms_urad: Option<f64>,
    /// Noise used: of one length, um, and of one angle, urad, each where such numbers are read.
    pub noise: [Option<f64>; 2],
    /// Where it comes from.
    pub noise_source: NoiseSource,
    /// Scatter of repeats of full poses, um and urad, where there are any.
    pub repeats: Option<[f64; 2]>,
    /// Scatter of repeats over the noise of each number, where something else than full poses is read.
    pub repeats_over_noise: Option<f64>,
    /// Error of the springs alone over the noise.
    pub springs_level: Option<f64>,
    /// Stiffness of each leg by springs alone, N/um.
    pub stiffness_n_per_um: Option<[f64; 6]>,
    /// Nominal stiffness, N/um, where stated.
    pub nominal_n_per_um: Option<[f64; 6]>,
}

impl ReadingsCheck {
    /// Of a file, averaged, and the springs fitted to it.
    pub(super) fn of(hexapod: &Hexapod, data: &Dataset, campaign: &Campaign, springs: Option<&Fit>) -> Self {
        let machine = Machine::nominal(hexapod);
        let rows = &data.observations;
        let mut poses: Vec<[u64; 6]> = rows.iter().map(|o| o.pose.bits()).collect();
        poses.sort_unstable();
        poses.dedup();
        let legs: Vec<_> = campaign
            .groups
            .iter()
            .filter_map(|g| Some((&g.mean, machine.legs(&g.mean.pose).ok()?)))
            .collect();
        let repeated = scatter(data, &campaign.axes);
        let rms = |angles: bool| {
            let of_row = |o: &Observation| {
                let (o, channels) = (*o, data.channels(o));
                let is_it =
                    move |k: &usize| channels[*k].is_angle(&hexapod.sensors) == angles && o.is_read(*k);
                (0..6).filter(is_it).map(move |k| o.measured[k])
            };
            let (sum, count) =
                rows.iter().flat_map(of_row).fold((0.0, 0.0), |(sum, n), x| (sum + x * x, n + 1.0));
            (count > 0.0).then(|| 1e6 * (sum / count).sqrt())
        };
        let of_numbers = (!campaign.reads_poses && campaign.pure_error_dof > 0.0)
            .then(|| (campaign.pure_error / campaign.pure_error_dof).sqrt());
        let deflections = !data.is_absolute();
        let largest = |of: &dyn Fn(&Observation) -> f64| rows.iter().map(of).fold(0.0, f64::max);
        Self {
            file: data.source.clone(),
            measurand: data.measurand.readings(),
            rows: rows.len(),
            poses: poses.len(),
            conditions: campaign.groups.len(),
            leg_lengths_mm: Extent::of(
                legs.iter().flat_map(|(_, l)| l.lengths.iter().map(|q| 1e3 * q).collect::<Vec<_>>()),
            ),
            largest_angle_deg: largest(&|o| o.pose.angles.amax().to_degrees()),
            largest_force_n: largest(&|o| o.wrench.force.norm()),
            largest_moment_nm: largest(&|o| o.wrench.moment.norm()),
            leg_forces_n: Extent::of(
                legs.iter()
                    .flat_map(|(o, l)| l.forces(&o.wrench.to_vector()).iter().copied().collect::<Vec<_>>()),
            ),
            translation_rms_um: rms(false).filter(|_| deflections),
            rotation_rms_urad: rms(true).filter(|_| deflections),
            noise: campaign.noise_read().map(|sigma| sigma.map(|s| 1e6 * s)),
            noise_source: campaign.noise.source,
            repeats: (repeated.dof > 0.0)
                .then(|| [repeated.variance_translation, repeated.variance_rotation].map(|v| 1e6 * v.sqrt())),
            repeats_over_noise: of_numbers,
            springs_level: springs
                .filter(|_| campaign.noise.allows_verdict())
                .map(|fit| fit.chi2_reduced().sqrt()),
            stiffness_n_per_um: springs.map(|fit| fit.point.compliances.map(|c| 1e-6 / c).into()),
            nominal_n_per_um: hexapod.nominal_stiffness.map(|k| k.map(|k| 1e-6 * k)),
        }
    }

    /// What looks odd.
    pub(super) fn remarks(&self, machine: &MachineCheck, data: &Dataset) -> Vec<String> {
        let mut all = Vec::new();
        let q = self.leg_lengths_mm;
        if let Some([short, long]) = machine.stroke_mm.filter(|s| q.least < s[0] || q.most > s[1]) {
            all.push(format!(
                "the legs would be {:.1} to {:.1} mm long at these poses, outside the stated stroke of {short:.1} to {long:.1} mm: check \
                 the poses, the joints and the home height",
                q.least, q.most
            ));
        }
        let stated = !matches!(self.noise_source, NoiseSource::Repeats | NoiseSource::Residuals);
        if let (Some([shift, turn]), [Some(length), Some(angle)]) =
            (self.repeats.filter(|_| stated), self.noise)
        {
            let off = |seen: f64, stated: f64| (seen / stated).max(stated / seen) > SCATTER_OFF;
            if off(shift, length) || off(turn, angle) {
                all.push(format!(
                    "repeats scatter by {} um and {} urad, but {} um and {} urad are stated: correct [metrology], or look for what \
                     disturbs the readings",
                    three_digits(shift),
                    three_digits(turn),
                    three_digits(length),
                    three_digits(angle)
                ));
            }
        }
        if let Some(times) = self.repeats_over_noise.filter(|x| x.max(x.recip()) > SCATTER_OFF) {
            let times = three_digits(times);
            all.push(format!("repeats scatter by {times} times the stated noise: correct the noise, or look for what disturbs the readings"));
        }
        if let Some(level) = self.springs_level.filter(|level| stated && *level < BELOW_NOISE) {
            all.push(format!(
                "springs alone leave {} times the stated noise, less than noise of that size allows: check the unit of the noise",
                three_digits(level)
            ));
        }
        if let Some(ratio) = self.far_from_nominal() {
            all.push(format!(
                "the legs are {} times as stiff as stated: check the units of loads and readings, and the nominal stiffness",
                three_digits(ratio)
            ));
        }
        all.extend(absolute_temperatures(data));
        all
    }

    /// How many times as stiff as nominal the legs come out, where that is no property of legs.
    fn far_from_nominal(&self) -> Option<f64> {
        let (found, nominal) = (self.stiffness_n_per_um?, self.nominal_n_per_um?);
        far_ratio((0..6).map(|leg| found[leg] / nominal[leg]))
    }
}

/// That a column of differences seems to hold temperatures.
fn absolute_temperatures(data: &Dataset) -> Option<String> {
    let Extent { least, most } = Extent::of(data.observations.iter().map(|o| o.delta_t));
    (least > ROOM_K && most - least < ROOM_SPREAD * least).then(|| {
        format!(
            "delta_T_K is {least:.1} to {most:.1} K: these look like absolute temperatures; the column states how much warmer the \
             structure was at the loaded reading than at the reference reading"
        )
    })
}
