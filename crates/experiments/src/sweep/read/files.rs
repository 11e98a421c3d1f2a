//! The files that a study names.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use hexbench_core::Hexapod;
use hexbench_core::files::{
    Fault, FileError, FilePlace, FileProblem, content_hash, read_conditions, read_hexapod, text_hash,
};
use hexbench_core::streams::{Purpose, stream};
use hexbench_design::space_file::read_space;
use hexbench_truth::campaign::{PlanRow, machines};
use hexbench_truth::scene::Scene;

use super::axes::{AxesTable, GeometryName, PlanName};
use crate::sweep::axes::{Axes, Drawings, Geometry, PlanChoice, PlanSource};

/// What was read, under the names in the study.
#[derive(Default)]
pub(super) struct Inputs {
    /// SHA-256 of it.
    pub(super) digests: BTreeMap<String, String>,
    /// The files among it, those that a file names included.
    pub(super) files: BTreeSet<String>,
}

impl Inputs {
    /// Notes a file beside the study and tells where it is.
    fn file(&mut self, folder: &Path, name: &str) -> Result<PathBuf, FileError> {
        let path = folder.join(name);
        self.digests.insert(name.to_owned(), content_hash(&path)?);
        self.files.insert(name.to_owned());
        Ok(path)
    }
}

/// The axes with everything their files say.
pub(super) fn complete(
    table: AxesTable,
    space: Option<&str>,
    folder: &Path,
    inputs: &mut Inputs,
) -> Result<Axes, FileError> {
    let geometry: Result<_, _> =
        table.geometry.into_iter().map(|name| geometry(name, space, folder, inputs)).collect();
    let geometry = geometry?;
    let plan: Result<_, _> = table.plan.into_iter().map(|name| plan(name, folder, inputs)).collect();
    Ok(Axes {
        geometry,
        plan: plan?,
        poses: table.poses,
        repeats: table.repeats,
        estimator: table.estimator,
        effect: table.effect,
        size: table.size,
        noise: table.noise,
        laboratory: table.laboratory,
        tolerance: table.tolerance,
        points: table.points,
    })
}

fn geometry(
    name: GeometryName,
    space: Option<&str>,
    folder: &Path,
    inputs: &mut Inputs,
) -> Result<Geometry, FileError> {
    let (name, source) = match name {
        GeometryName::Family(family) => (family.to_owned(), Drawings::Family(family)),
        GeometryName::File(file) => {
            let hexapod = read_hexapod(&inputs.file(folder, &file)?)?;
            (file, Drawings::File(Box::new(hexapod)))
        }
    };
    let Some(file) = space else { return Ok(Geometry { name, source, space: None }) };
    let path = inputs.file(folder, file)?;
    let space = match &source {
        Drawings::File(hexapod) => read_space(&path, hexapod)?,
        // The space asks the machine for its stroke only, which no family states.
        Drawings::Family(family) => read_space(&path, &example(family))?,
    };
    // Plans that are compared have the same loads.
    Ok(Geometry { name, source, space: Some(space.at_corners().with_loads_fixed()) })
}

fn example(family: &str) -> Hexapod {
    machines::draw(family, &mut stream(0, Purpose::Example, []))
}

fn plan(name: PlanName, folder: &Path, inputs: &mut Inputs) -> Result<PlanChoice, FileError> {
    Ok(match name {
        PlanName::Known(name, source) => PlanChoice { name, source },
        PlanName::Table(name) => {
            let reading = read_conditions(&inputs.file(folder, &name)?)?;
            let rows = reading.dataset.observations.iter().map(PlanRow::from).collect();
            PlanChoice { name, source: PlanSource::Rows(rows) }
        }
        PlanName::Scene(name) => PlanChoice { source: of_scene(&name, folder, inputs)?, name },
    })
}

/// The readings to learn from of a scene; its machine and its hidden effects are left aside.
fn of_scene(name: &str, folder: &Path, inputs: &mut Inputs) -> Result<PlanSource, FileError> {
    let file = format!("{}/scene.toml", name.trim_end_matches('/'));
    let path = inputs.file(folder, &file)?;
    let scene = Scene::read(&folder.join(name))?;
    if scene.measurand() == hexbench_core::Measurand::AbsolutePose {
        let problem = FileProblem::Rule {
            rule: "studies measure deflections, but this scene measures absolute poses".into(),
            next: "Choose another scene.".into(),
        };
        return Err(Fault::new(FilePlace::file(), problem).in_file(&path));
    }
    let rows = scene.plan().training;
    // The rows come from several files: what counts is what they say together.
    inputs.digests.insert(format!("{name} (rows)"), text_hash(&format!("{rows:?}")));
    inputs.files.extend(scene.files.iter().map(|file| format!("{}/{file}", name.trim_end_matches('/'))));
    Ok(PlanSource::Rows(rows))
}
