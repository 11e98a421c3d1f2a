//! `space.toml`: where poses and loads may be chosen.
//!
//! ```toml
//! format = "space/1"
//!
//! [poses]                        # ranges; a coordinate that is left out stays at zero
//! a_mm = [-30, 30]
//! gamma_deg = [-20, 20]
//!
//! [limits]                       # optional, each key too
//! min_length_mm = 150            # default: the stroke in hexapod.toml
//! max_length_mm = 250
//! joint_angle_deg = 30           # a leg against its direction at the zero pose
//! least_dexterity = 0.05         # inverse condition of the leg Jacobian, moments over the platform radius
//!
//! [loads]                        # stacked masses along gravity ...
//! reference_kg = 12.2
//! masses_kg = [34.5]
//! # ... or wrenches [fx, fy, fz (N), mx, my, mz (Nm)]
//! # reference_N_Nm = [0, 0, -120, 0, 0, 0]
//! # wrenches_N_Nm = [[0, 0, -338, 0, 0, 0], [100, 0, -120, 0, 0, 0]]
//!
//! [[loads.between]]              # ... or, or beside them, a load that is chosen together with the poses
//! mass_kg = [12.2, 34.5]         # stacked along gravity, between these bounds
//! fx_N = [-100, 100]             # force and moment in fixed axes; one number is not chosen
//! mz_Nm = 5                      # components that are left out are those of the reference
//! # pull_N = [0, 100]            # instead of mass and forces: on top of the reference ...
//! # along = [0.6, 0.8, 0]        # ... in this direction
//!
//! [conditions]                   # optional, each key too: every load is read under each of them
//! elapsed_s = [5, 300]           # waits from the reference reading to the loaded one; default 0
//! delta_T_K = [-0.5, 0.5]        # change of the temperature between the two; default 0
//! approach = [1, -1]             # loaded from below, or coming back from an overload; default 1
//!
//! [budget]                       # optional: what a plan may cost
//! time_h = 3                     # or readings = 60
//! reading_s = 40                 # to read a deflection: reference and load
//! load_change_s = 60             # once for a reading with approach 1, twice with -1
//! pose_change_s = 120            # once for every pose
//! ```

mod loads;

use std::path::Path;

use hexbench_core::files::{
    Dimension, Fault, FileError, FileProblem, Format, Item, KeyUnit, TomlSection, read_toml,
};
use hexbench_core::{Approach, Hexapod, Measurand};

use self::loads::loads;
use crate::budget::{Amount, Budget};
use crate::space::{Conditions, Space};

const FORMAT: Format = Format {
    name: "space/1",
    keys: &[
        KeyUnit::plain("format"),
        KeyUnit::plain("poses"),
        KeyUnit::plain("limits"),
        KeyUnit::plain("loads"),
        KeyUnit::plain("conditions"),
        KeyUnit::plain("budget"),
    ],
};
const POSES: &[KeyUnit] = &[
    KeyUnit::with_unit("a", Dimension::Length, "mm"),
    KeyUnit::with_unit("b", Dimension::Length, "mm"),
    KeyUnit::with_unit("c", Dimension::Length, "mm"),
    KeyUnit::with_unit("alpha", Dimension::Angle, "deg"),
    KeyUnit::with_unit("beta", Dimension::Angle, "deg"),
    KeyUnit::with_unit("gamma", Dimension::Angle, "deg"),
];
const LIMITS: &[KeyUnit] = &[
    KeyUnit::with_unit("min_length", Dimension::Length, "mm"),
    KeyUnit::with_unit("max_length", Dimension::Length, "mm"),
    KeyUnit::with_unit("joint_angle", Dimension::Angle, "deg"),
    KeyUnit::plain("least_dexterity"),
];
const CONDITIONS: &[KeyUnit] = &[
    KeyUnit::with_unit("elapsed", Dimension::Time, "s"),
    KeyUnit::with_unit("delta_T", Dimension::TemperatureDifference, "K"),
    KeyUnit::plain("approach"),
];
const BUDGET: &[KeyUnit] = &[
    KeyUnit::plain("readings"),
    KeyUnit::with_unit("time", Dimension::Time, "h"),
    KeyUnit::with_unit("reading", Dimension::Time, "s"),
    KeyUnit::with_unit("load_change", Dimension::Time, "s"),
    KeyUnit::with_unit("pose_change", Dimension::Time, "s"),
];

/// Reads `space.toml` for a machine.
///
/// # Errors
/// What the file says that it may not, with its place.
pub fn read_space(path: &Path, hexapod: &Hexapod) -> Result<Space, FileError> {
    read_toml(path, FORMAT, |top| space(top, hexapod))
}

fn space(top: &TomlSection<'_>, hexapod: &Hexapod) -> Result<Space, Fault> {
    let (low, high) = ranges(&top.section("poses", "[poses]", POSES)?)?;
    let (loads, load_ranges) = loads(top)?;
    let mut space = Space {
        low,
        high,
        stroke: hexapod.stroke,
        joint_angle: None,
        least_dexterity: 0.0,
        loads,
        load_ranges,
        conditions: conditions(&top.section("conditions", "[conditions]", CONDITIONS)?)?,
        budget: budget(&top.section("budget", "[budget]", BUDGET)?)?,
    };
    if top.get("limits").is_some() {
        limits(&top.section("limits", "[limits]", LIMITS)?, &mut space)?;
    }
    Ok(space)
}

fn ranges(table: &TomlSection<'_>) -> Result<([f64; 6], [f64; 6]), Fault> {
    let (mut low, mut high) = ([0.0; 6], [0.0; 6]);
    for (k, name) in Measurand::AbsolutePose.names().iter().enumerate() {
        let Some(item) = table.get(name) else { continue };
        [low[k], high[k]] = item.numbers("two numbers, the lowest and the highest")?;
        if low[k] > high[k] {
            return Err(item.breaks("the lowest comes first", "Swap the two numbers."));
        }
    }
    Ok((low, high))
}

fn limits(table: &TomlSection<'_>, space: &mut Space) -> Result<(), Fault> {
    let positive = |name: &str| table.get(name).map(|item| item.positive("a limit")).transpose();
    let (shortest, longest) = (positive("min_length")?, positive("max_length")?);
    if shortest.is_some() || longest.is_some() {
        let [known_shortest, known_longest] = space.stroke.unwrap_or([1e-6, 1e6]);
        space.stroke = Some([shortest.unwrap_or(known_shortest), longest.unwrap_or(known_longest)]);
    }
    space.joint_angle = positive("joint_angle")?;
    space.least_dexterity = positive("least_dexterity")?.unwrap_or(0.0);
    Ok(())
}

fn conditions(table: &TomlSection<'_>) -> Result<Conditions, Fault> {
    let mut conditions = Conditions::default();
    let places = [
        ("elapsed", &mut conditions.waits, wait as fn(&Item<'_>) -> Result<f64, Fault>),
        ("delta_T", &mut conditions.delta_t, |item| item.number()),
    ];
    for (name, place, read) in places {
        if let Some(item) = table.get(name) {
            *place = different(item, read, |a, b| a.total_cmp(b).is_eq())?;
        }
    }
    if let Some(item) = table.get("approach") {
        conditions.approaches = different(item, approach, Approach::eq)?;
    }
    Ok(conditions)
}

fn wait(item: &Item<'_>) -> Result<f64, Fault> {
    let seconds = item.number()?;
    if seconds >= 0.0 {
        Ok(seconds)
    } else {
        Err(item.breaks("time does not run backwards", "Remove the sign."))
    }
}

fn approach(item: &Item<'_>) -> Result<Approach, Fault> {
    Approach::of_sign(item.number()?).ok_or_else(|| item.fault(FileProblem::Approach))
}

/// The members of a list, at least one and no two alike.
fn different<T>(
    item: &Item<'_>,
    read: fn(&Item<'_>) -> Result<T, Fault>,
    same: fn(&T, &T) -> bool,
) -> Result<Vec<T>, Fault> {
    let mut values: Vec<T> = Vec::new();
    for member in item.list()? {
        let value = read(&member)?;
        if values.iter().any(|v| same(v, &value)) {
            return Err(member.breaks(
                "each condition is listed once",
                "Remove the second one; a plan repeats what is worth it.",
            ));
        }
        values.push(value);
    }
    if values.is_empty() {
        return Err(item.breaks("at least one condition", "Remove the key, or list one."));
    }
    Ok(values)
}

fn budget(table: &TomlSection<'_>) -> Result<Budget, Fault> {
    let seconds = |name: &str| table.get(name).map_or(Ok(0.0), wait);
    let limit = match (table.get("readings"), table.get("time")) {
        (Some(_), Some(time)) => {
            return Err(time.breaks("a budget is in readings or in time", "Remove one of the two keys."));
        }
        (Some(item), None) => Some(Amount::Readings(usize::try_from(item.whole(1)?).unwrap_or(usize::MAX))),
        (None, Some(item)) => Some(Amount::Time(item.positive("a budget")?)),
        (None, None) => None,
    };
    Ok(Budget {
        limit,
        reading: seconds("reading")?,
        load_change: seconds("load_change")?,
        pose_change: seconds("pose_change")?,
    })
}
