//! Faults of laboratories: one file for each, some in several sizes.
//!
//! A campaign of a careful laboratory has independent Gaussian errors of exactly the stated size, a machine that matches its drawing, and every
//! number in its place. A [`LaboratoryFault`] breaks one of these and leaves the rest: machine, plan, effects and the noise drawn stay, number
//! by number, so that a campaign with a fault can be compared with the same campaign without.
//!
//! ```text
//! alter   the machine is not the one of the file         joints, temperature
//! state   the file says something else of the noise      sigma
//! err     errors of readings have another law            tails, drift, shared reference, ...
//! write   everything is written down wrongly             rounding, a load gain, a missing column
//! slip    one entry to learn from is written wrongly     a blunder, a swapped row, a pose, a load
//! ```
//!
//! Adding one: a file with its doc, a struct, [`LaboratoryFault`] for it and `FAULTS`, and its line in `faults!`.

mod pick;

use std::collections::HashMap;
use std::fmt::Debug;

use hexbench_core::{Dataset, Metrology, Vector6, Wrench};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use crate::{World, campaign::PlanRow};

/// One fault of a given size. Whatever it draws comes from a stream of its own, the same for all faults: sizes of one fault hit
/// the same number.
pub trait LaboratoryFault: Debug + Send + Sync {
    /// Changes the true machine; its file keeps the drawing.
    fn alter(&self, _world: &mut World, _rng: &mut Pcg64) {}

    /// Changes what the file states of the instrument.
    fn state(&self, _metrology: &mut Metrology) {}

    /// Changes the errors of the readings of a part; `sigma` (m, rad) is the instrument's, the errors are Gaussian of that size.
    fn err(&self, _rows: &[PlanRow], _sigma: &Vector6, _errors: &mut [Vector6], _rng: &mut Pcg64) {}

    /// Changes all that is written down, of both parts alike.
    fn write(&self, _data: &mut Dataset, _rng: &mut Pcg64) {}

    /// Changes a few entries of the part to learn from; `sigma` in m and rad.
    fn slip(&self, _data: &mut Dataset, _sigma: &Vector6, _rng: &mut Pcg64) {}
}

/// Entry of the registry.
#[derive(Debug, Clone, Copy)]
pub struct FaultEntry {
    /// Its id: kebab-case, with its size.
    pub id: &'static str,
    /// A few words, with its size.
    pub title: &'static str,
    /// Words of `findings[].kind` by which a report may call it, the best first; none when the format has no word for it.
    pub findings: &'static [&'static str],
    /// The fault.
    pub fault: &'static dyn LaboratoryFault,
}

impl FaultEntry {
    /// True when a report may call it by a word of `findings[].kind`.
    pub fn is_called(&self, kind: &str) -> bool {
        self.findings.contains(&kind)
    }
}

/// Entries of a file, a line each: id, title, words by which a report may call it, the fault.
macro_rules! entries {
    ($($id:literal $title:literal, $findings:expr => $fault:expr;)+) => {
        &[$(FaultEntry { id: $id, title: $title, findings: $findings, fault: &$fault }),+]
    };
}

/// Declares the module of every fault and registers its sizes.
macro_rules! faults {
    ($($module:ident),+ $(,)?) => {
        $(mod $module;)+

        const FILES: &[&[FaultEntry]] = &[$($module::FAULTS),+];
    };
}

faults! {
    careful,
    stated_sigma,
    heavy_tails,
    correlated,
    uneven_axis,
    drift,
    shared_reference,
    reference_records,
    setup_error,
    rounding,
    dead_band,
    outlier,
    unit_slip,
    sign_slip,
    rows_swapped,
    knocked_condition,
    pose_misrecorded,
    load_misrecorded,
    load_component,
    moment_arm,
    load_point,
    load_noise,
    load_share,
    joints,
    temperature,
}

/// No fault at all.
pub const CAREFUL: FaultEntry = careful::FAULTS[0];

/// All faults, the careful laboratory first.
pub fn registry() -> impl Iterator<Item = &'static FaultEntry> + Clone {
    FILES.iter().copied().flatten()
}

/// Entry of an id; none of an unknown one.
pub fn entry(id: &str) -> Option<&'static FaultEntry> {
    registry().find(|e| e.id == id)
}

/// Writes other loads, by what is drawn once for every condition.
fn rewrite_loads<T>(
    data: &mut Dataset,
    mut draw: impl FnMut() -> T,
    written: impl Fn([f64; 6], &T) -> [f64; 6],
) {
    let mut drawn: HashMap<[[u64; 6]; 2], T> = HashMap::new();
    for o in &mut data.observations {
        let load = o.wrench.to_array();
        let of_condition = drawn.entry([o.pose.bits(), load.map(f64::to_bits)]).or_insert_with(&mut draw);
        o.wrench = Wrench::from_array(written(load, of_condition));
    }
}

/// Six independent standard normal values.
fn normal6(rng: &mut Pcg64) -> Vector6 {
    Vector6::from_fn(|_, _| StandardNormal.sample(rng))
}
