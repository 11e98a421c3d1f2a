//! Reading the folder of a scene.

use std::path::Path;

use hexbench_core::{
    Hexapod, Measurand, Sensor,
    files::{
        Fault, FileError, FilePlace, FileProblem, Format, Item, KeyUnit, TomlSection, read_hexapod,
        read_toml, sensors,
    },
};

use super::{Instrument, Scene, Streams, plan_table::PlanTable, sealed::read_truth};

/// Name of the description in the folder.
const SCENE_FILE: &str = "scene.toml";

const SCENE: Format = Format {
    name: "scene/1",
    keys: &KeyUnit::all_plain([
        "format",
        "title",
        "shows",
        "source",
        "seed",
        "hexapod",
        "truth",
        "plan",
        "instrument",
        "sensor",
    ]),
};

/// `scene.toml` before the files it names are read.
struct Description {
    title: String,
    shows: String,
    source: String,
    seed: u64,
    hexapod: String,
    truth: String,
    plan: PlanTable,
    instrument: Instrument,
    sensors: Vec<Sensor>,
}

impl Scene {
    /// Reads the scene in a folder.
    ///
    /// # Errors
    /// The first thing that is wrong in `scene.toml` or in a file it names, with line, column, value and next step.
    pub fn read(folder: &Path) -> Result<Self, FileError> {
        Self::read_with_seed(folder, None)
    }

    /// The same with another seed than the scene's own.
    ///
    /// # Errors
    /// As [`Scene::read`].
    pub fn read_with_seed(folder: &Path, seed: Option<u64>) -> Result<Self, FileError> {
        let file = folder.join(SCENE_FILE);
        let d = read_toml(&file, SCENE, description)?;
        let mut hexapod = read_hexapod(&folder.join(&d.hexapod))?;
        hexapod.sensors.extend(d.sensors);
        let sealed = read_truth(&folder.join(&d.truth))?;
        let seed = seed.unwrap_or(d.seed);
        let mut files = vec![SCENE_FILE.to_owned(), d.hexapod, d.truth];
        files.extend(d.plan.files().map(str::to_owned));
        let plan = d.plan.complete(folder, &file, &hexapod, Streams::new(seed))?;
        if plan.measurand() == Measurand::AbsolutePose && matches!(d.instrument, Instrument::Sensors(_)) {
            let problem = FileProblem::Rule {
                rule: "sensors read deflections, and this plan measures absolute poses".into(),
                next: "Choose another plan, or an instrument of the kind \"numbers\" or \"balls\".".into(),
            };
            return Err(Fault::new(FilePlace::file(), problem).in_file(&file));
        }
        if plan.states_order() && !matches!(d.instrument, Instrument::Numbers(_)) {
            let problem = FileProblem::Rule {
                rule: "loads of a sequence are read in numbers: their reference reading is shared".into(),
                next: "Choose an instrument of the kind \"numbers\", or loads of their own reference.".into(),
            };
            return Err(Fault::new(FilePlace::file(), problem).in_file(&file));
        }
        // Balls that determine no pose are refused while reading: only other instruments state nothing here.
        let hexapod =
            Hexapod { metrology: d.instrument.metrology(plan.measurand()).ok().flatten(), ..hexapod };
        Ok(Self {
            name: name_of(folder),
            files,
            title: d.title,
            shows: d.shows,
            source: d.source,
            seed,
            hexapod,
            plan,
            instrument: d.instrument,
            leg_stiffness: sealed.leg_stiffness,
            mechanisms: sealed.mechanisms,
        })
    }
}

fn description(top: &TomlSection<'_>) -> Result<Description, Fault> {
    let text = |key: &str| top.require(key)?.string().map(str::to_owned);
    let file = |key: &str, usual: &str| top.get(key).map_or(Ok(usual), Item::string).map(str::to_owned);
    Ok(Description {
        title: text("title")?,
        shows: text("shows")?,
        source: text("source")?,
        seed: top.require("seed")?.whole(0)?,
        hexapod: file("hexapod", "hexapod.toml")?,
        truth: file("truth", "sealed/truth.toml")?,
        plan: PlanTable::read(top)?,
        sensors: top.get("sensor").map_or(Ok(Vec::new()), sensors)?,
        instrument: instrument(top)?,
    })
}

/// The instrument; sensors belong to one of their kind, which has at least one, and read deflections.
fn instrument(top: &TomlSection<'_>) -> Result<Instrument, Fault> {
    let instrument = Instrument::read(top)?;
    let reads_sensors = matches!(&instrument, Instrument::Sensors(_));
    match (top.get("sensor"), top.get("instrument")) {
        (Some(sensors), _) if !reads_sensors => Err(sensors.breaks(
            "the instrument reads no sensors",
            "Write kind = \"sensors\" in [instrument], or remove the [[sensor]] tables.",
        )),
        (None, Some(table)) if reads_sensors => {
            Err(table.breaks("there is no sensor to read", "Add [[sensor]] tables, as in hexapod.toml."))
        }
        _ => Ok(instrument),
    }
}

fn name_of(folder: &Path) -> String {
    let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    whole.file_name().map_or_else(|| "scene".into(), |name| name.to_string_lossy().into_owned())
}
