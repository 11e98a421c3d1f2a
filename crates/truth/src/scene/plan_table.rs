//! Reading `[plan]`.

use hexbench_core::Approach;
use std::path::Path;

use hexbench_core::{
    Dataset, Hexapod, Measurand, Pose, Wrench,
    files::{
        ColumnNames, Dimension, Fault, FileError, FilePlace, FileProblem, Item, KeyUnit, TomlSection,
        instead_of, read_conditions_named,
    },
};

use super::{ScenePlan, ScenePurpose, Streams};
use crate::campaign::{PlanKind, PlanRow, Poses, Scheme, Schemes, Spread, pose_of, usual_half_range_mm_deg};

const KEYS: &[KeyUnit] = &[
    KeyUnit::plain("make"),
    KeyUnit::plain("mode"),
    KeyUnit::plain("conditions"),
    KeyUnit::plain("holdout_conditions"),
    KeyUnit::plain("poses"),
    KeyUnit::plain("holdout_poses"),
    KeyUnit::plain("poses_mm_deg"),
    KeyUnit::plain("holdout_poses_mm_deg"),
    KeyUnit::with_unit("travel", Dimension::Length, "mm"),
    KeyUnit::with_unit("turn", Dimension::Angle, "deg"),
    KeyUnit::plain("loads_N_Nm"),
    KeyUnit::plain("reference_N_Nm"),
    KeyUnit::plain("repeats"),
    KeyUnit::plain("holdout_repeats"),
    KeyUnit::plain("approach"),
    KeyUnit::with_unit("delta_T", Dimension::TemperatureDifference, "K"),
    KeyUnit::with_unit("elapsed", Dimension::Time, "s"),
    KeyUnit::with_unit("ref_age", Dimension::Time, "s"),
    KeyUnit::plain("order"),
];
/// Keys that make sense beside a table of conditions.
const BESIDE_CONDITIONS: [&str; 4] = ["mode", "conditions", "holdout_conditions", "repeats"];

/// `[plan]` before the machine is known.
#[derive(Debug, Default)]
pub(super) struct PlanTable {
    make: Option<PlanKind>,
    absolute: Option<bool>,
    conditions: Option<[Option<String>; 2]>,
    poses: [Option<Poses>; 2],
    travel: Option<[f64; 3]>,
    turn: Option<[f64; 3]>,
    loads: Option<Vec<Wrench>>,
    reference: Option<Wrench>,
    repeats: [Option<u64>; 2],
    approaches: Option<Vec<Approach>>,
    delta_t: Option<Spread>,
    elapsed: Option<Spread>,
    reference_age: Option<Spread>,
    in_sequence: Option<bool>,
}

impl PlanTable {
    /// Reads `[plan]`.
    pub(super) fn read(top: &TomlSection<'_>) -> Result<Self, Fault> {
        let item = top.require("plan")?;
        let t = item.section("[plan]", KEYS)?;
        let table = Self {
            make: t.get("make").map(make).transpose()?,
            absolute: t.get("mode").map(mode).transpose()?,
            conditions: conditions(&t)?,
            poses: [poses(&t, "poses", "poses_mm_deg")?, poses(&t, "holdout_poses", "holdout_poses_mm_deg")?],
            travel: t.get("travel").map(half_ranges).transpose()?,
            turn: t.get("turn").map(half_ranges).transpose()?,
            loads: t.get("loads_N_Nm").map(wrenches).transpose()?,
            reference: t.get("reference_N_Nm").map(wrench).transpose()?,
            repeats: [count(&t, "repeats", 1)?, count(&t, "holdout_repeats", 1)?],
            approaches: t.get("approach").map(approaches).transpose()?,
            delta_t: t.get("delta_T").map(spread).transpose()?,
            elapsed: t.get("elapsed").map(spread).transpose()?,
            reference_age: t.get("ref_age").map(age).transpose()?,
            in_sequence: t.get("order").map(order).transpose()?,
        };
        table.refuse_halves(item, &t)?;
        Ok(table)
    }

    /// A plan is a make, a table of conditions, or loads with poses.
    fn refuse_halves(&self, item: &Item<'_>, table: &TomlSection<'_>) -> Result<(), Fault> {
        if self.conditions.is_some() {
            let stray = KEYS
                .iter()
                .map(KeyUnit::name)
                .find(|key| table.get(key).is_some() && !BESIDE_CONDITIONS.contains(key));
            return stray.and_then(|key| table.get(key)).map_or(Ok(()), |stray| {
                Err(stray.breaks("rows of a table of conditions are taken as they are", "Remove this key."))
            });
        }
        if self.make.is_some() || (self.loads.is_some() && self.poses[0].is_some()) {
            return Ok(());
        }
        let makes = PlanKind::ALL.map(PlanKind::name).join(", ");
        Err(item.breaks(
            "a plan needs a make, or a table of conditions, or poses and loads",
            format!("Add make (one of {makes}), or conditions = \"FILE\", or poses and loads_N_Nm."),
        ))
    }

    /// The plan for a machine.
    pub(super) fn complete(
        self,
        folder: &Path,
        file: &Path,
        hexapod: &Hexapod,
        streams: Streams,
    ) -> Result<ScenePlan, FileError> {
        let plan = match &self.conditions {
            Some(files) => self.rows(folder, files, hexapod)?,
            None => ScenePlan::Schemes(Box::new(self.schemes(hexapod, streams))),
        };
        plan.refuse_repeated_order().map_err(|fault| fault.in_file(file))?;
        plan.checked().map_err(|wrong| {
            let problem =
                FileProblem::Rule { rule: wrong.to_string(), next: "Change poses, loads or repeats.".into() };
            Fault::new(FilePlace::file().with_name("[plan]"), problem).in_file(file)
        })
    }

    /// Files it names.
    pub(super) fn files(&self) -> impl Iterator<Item = &str> {
        self.conditions.iter().flatten().flatten().map(String::as_str)
    }

    fn rows(
        &self,
        folder: &Path,
        files: &[Option<String>; 2],
        machine: &Hexapod,
    ) -> Result<ScenePlan, FileError> {
        let read = |file: &Option<String>| match file {
            Some(name) => read_conditions_named(&folder.join(name), &ColumnNames::default(), Some(machine))
                .map(|reading| rows_of(&reading.dataset)),
            None => Ok(Vec::new()),
        };
        Ok(ScenePlan::Rows {
            measurand: self.measurand().unwrap_or(Measurand::DeflectionEuler),
            training: read(&files[0])?,
            holdout: read(&files[1])?,
            repeats: self.repeats[0].unwrap_or(1),
        })
    }

    fn measurand(&self) -> Option<Measurand> {
        self.absolute.map(|yes| if yes { Measurand::AbsolutePose } else { Measurand::DeflectionEuler })
    }

    fn schemes(self, hexapod: &Hexapod, streams: Streams) -> Schemes {
        let base = match self.make {
            Some(make) => make.schemes(hexapod, &mut streams.of(ScenePurpose::Loads, 0)),
            None => plain(),
        };
        let measurand = self.measurand().unwrap_or(base.training.measurand);
        let half = self.half_ranges(hexapod);
        let [training_poses, holdout_poses] = self.poses;
        let [repeats, holdout_repeats] = self.repeats;
        let part = |base: Scheme, poses: Option<Poses>, repeats: Option<u64>| Scheme {
            measurand,
            poses: with_half_range(poses.unwrap_or(base.poses), half),
            loads: self.loads.clone().unwrap_or(base.loads),
            reference: self.reference.unwrap_or(base.reference),
            repeats: repeats.unwrap_or(base.repeats),
            approaches: self.approaches.clone().unwrap_or(base.approaches),
            delta_t: self.delta_t.unwrap_or(base.delta_t),
            elapsed: self.elapsed.unwrap_or(base.elapsed),
            reference_age: self.reference_age.or(base.reference_age),
            anew: base.anew,
            in_sequence: self.in_sequence.unwrap_or(base.in_sequence) && measurand != Measurand::AbsolutePose,
        };
        Schemes {
            training: part(base.training, training_poses, repeats),
            holdout: part(base.holdout, holdout_poses, holdout_repeats),
        }
    }

    fn half_ranges(&self, hexapod: &Hexapod) -> [f64; 6] {
        let mut half = usual_half_range_mm_deg(hexapod);
        for k in 0..3 {
            half[k] = self.travel.map_or(half[k], |travel| travel[k] * 1e3);
            half[k + 3] = self.turn.map_or(half[k + 3], |turn| turn[k].to_degrees());
        }
        half
    }
}

/// What a plan without a make has unless it says otherwise.
fn plain() -> Schemes {
    Schemes { training: Scheme::plain(), holdout: Scheme::plain() }
}

fn with_half_range(poses: Poses, half_mm_deg: [f64; 6]) -> Poses {
    match poses {
        Poses::Drawn { count, .. } => Poses::Drawn { count, half_mm_deg },
        listed @ Poses::Listed(_) => listed,
    }
}

fn rows_of(conditions: &Dataset) -> Vec<PlanRow> {
    conditions.observations.iter().map(PlanRow::from).collect()
}

fn make(item: &Item<'_>) -> Result<PlanKind, Fault> {
    let (word, names) = (item.string()?, PlanKind::ALL.map(PlanKind::name));
    PlanKind::ALL
        .into_iter()
        .find(|kind| kind.name() == word)
        .ok_or_else(|| item.breaks("there is no make of plans with this name", instead_of(word, &names)))
}

fn mode(item: &Item<'_>) -> Result<bool, Fault> {
    match item.string()? {
        "absolute" => Ok(true),
        "deflections" => Ok(false),
        _ => Err(item.breaks("the mode is \"deflections\" or \"absolute\"", "Write one of the two.")),
    }
}

fn order(item: &Item<'_>) -> Result<bool, Fault> {
    match item.string()? {
        "sequence" => Ok(true),
        "separate" => Ok(false),
        _ => Err(item.breaks("the order of loads is \"separate\" or \"sequence\"", "Write one of the two.")),
    }
}

fn conditions(table: &TomlSection<'_>) -> Result<Option<[Option<String>; 2]>, Fault> {
    let file = |key| table.get(key).map(|item| item.string().map(str::to_owned)).transpose();
    Ok(match file("conditions")? {
        Some(training) => Some([Some(training), file("holdout_conditions")?]),
        None => None,
    })
}

fn count(table: &TomlSection<'_>, key: &str, least: u64) -> Result<Option<u64>, Fault> {
    table.get(key).map(|item| item.whole(least)).transpose()
}

fn poses(table: &TomlSection<'_>, number: &str, list: &str) -> Result<Option<Poses>, Fault> {
    if let Some(item) = table.get(list) {
        let six =
            |pose: &Item<'_>| pose.numbers::<6>("six numbers [a, b, c, alpha, beta, gamma], mm and deg");
        let listed = item.list()?;
        let poses: Result<Vec<Pose>, Fault> = listed.iter().map(|pose| six(pose).map(pose_of)).collect();
        return poses.map(|poses| Some(Poses::Listed(poses)));
    }
    let drawn = |count| Poses::Drawn { count, half_mm_deg: [0.0; 6] };
    Ok(count(table, number, 0)?.map(drawn))
}

fn half_ranges(item: &Item<'_>) -> Result<[f64; 3], Fault> {
    let half = item.numbers::<3>("three half ranges")?;
    if half.iter().all(|x| *x >= 0.0) {
        return Ok(half);
    }
    Err(item.breaks("half ranges are not negative", "Write how far poses go from zero on either side."))
}

fn wrenches(item: &Item<'_>) -> Result<Vec<Wrench>, Fault> {
    item.list()?.iter().map(wrench).collect()
}

fn wrench(item: &Item<'_>) -> Result<Wrench, Fault> {
    item.numbers::<6>("six numbers [fx, fy, fz, mx, my, mz], N and N m").map(Wrench::from_array)
}

fn approaches(item: &Item<'_>) -> Result<Vec<Approach>, Fault> {
    let one =
        |way: &Item<'_>| Approach::of_sign(way.number()?).ok_or_else(|| way.fault(FileProblem::Approach));
    item.list()?.iter().map(one).collect()
}

/// A spread of times that are not negative.
fn age(item: &Item<'_>) -> Result<Spread, Fault> {
    let ages = spread(item)?;
    if matches!(ages, Spread::Fixed(least) | Spread::Even([least, _]) if least < 0.0) {
        return Err(item.breaks("the age of a load cannot be negative", "Write zero or more."));
    }
    Ok(ages)
}

/// One number, or two limits.
fn spread(item: &Item<'_>) -> Result<Spread, Fault> {
    if !item.is_list() {
        return item.number().map(Spread::Fixed);
    }
    match item.numbers::<2>("two limits [low, high]")? {
        [low, high] if low < high => Ok(Spread::Even([low, high])),
        _ => Err(item.breaks("the first limit is below the second", "Exchange them, or write one number.")),
    }
}
