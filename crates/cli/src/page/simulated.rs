//! What was simulated, and what to do with it.

use std::path::Path;

use hexbench_report::number::{counted, significant};
use hexbench_report::words::as_word;
use hexbench_report::{Block, Definition, Page, Section};
use hexbench_truth::Scene;
use hexbench_truth::scene::{Instrument, PartName};

/// What the page is about.
pub(crate) struct Simulated<'a> {
    /// The scene.
    pub(crate) scene: &'a Scene,
    /// Where its files are.
    pub(crate) folder: &'a Path,
    /// Without noise.
    pub(crate) noise_free: bool,
    /// Tell what is hidden.
    pub(crate) reveal: bool,
}

/// The page. What is hidden stays hidden unless asked for.
pub(crate) fn page(about: &Simulated<'_>) -> Page {
    let scene = about.scene;
    let entries = [
        ("machine", scene.hexapod.name.clone()),
        ("plan", plan(scene)),
        ("noise", noise(about)),
        ("seed", scene.seed.to_string()),
        ("written", format!("{} in {}", files(scene), about.folder.display())),
        ("hidden", hidden(about)),
    ];
    let entries = entries.map(|(label, text)| Definition::new(label, text));
    let commands = format!("cd {}\n{}", as_word(about.folder), next(scene));
    Page::default()
        .with(Section::new("Simulated").remark(&scene.title).with(Block::entries(entries)))
        .with(Section::new("Next").with(Block::code(commands)))
}

fn plan(scene: &Scene) -> String {
    let [training, holdout] = [PartName::Training, PartName::Holdout].map(|name| scene.part(name));
    let what = scene.measurand().readings();
    format!(
        "{what}: {} at {} to learn from, {} at {} held out",
        counted(training.len(), "row"),
        counted(training.poses(), "pose"),
        counted(holdout.len(), "row"),
        counted(holdout.poses(), "pose"),
    )
}

fn noise(about: &Simulated<'_>) -> String {
    if about.noise_free {
        return "none".into();
    }
    let stated = about.scene.hexapod.metrology.map_or_else(String::new, |m| {
        let [um, urad] = [m.sigma_translation, m.sigma_rotation].map(|s| significant(s * 1e6, 3));
        format!("{um} um and {urad} urad per reading")
    });
    match &about.scene.instrument {
        Instrument::Numbers(_) => stated,
        Instrument::Sensors(_) => {
            let sensors = about.scene.hexapod.sensors.iter().map(|s| s.name.as_str()).collect::<Vec<_>>();
            let own = format!("of {} as hexapod.toml states", sensors.join(", "));
            if stated.is_empty() { own } else { format!("{own}; {stated} of pose numbers") }
        }
        Instrument::Balls(cmm) => {
            let um = significant(cmm.platform.sigma * 1e6, 3);
            format!("{um} um per ball coordinate, that is {stated}")
        }
    }
}

fn files(scene: &Scene) -> String {
    let mut names = vec!["hexapod.toml", "measurements.csv"];
    if !scene.part(PartName::Holdout).is_empty() {
        names.push("holdout.csv");
    }
    if matches!(scene.instrument, Instrument::Balls(_)) {
        names.extend(["balls.csv", "balls.toml", "loads.csv"]);
    }
    format!("{} and sealed/truth.json", names.join(", "))
}

fn hidden(about: &Simulated<'_>) -> String {
    if !about.reveal {
        return "sealed; --reveal shows it".into();
    }
    let effects = about.scene.hidden_effects();
    let list = if effects.is_empty() { "nothing".into() } else { effects.join(" and ") };
    format!("{list}. {}", about.scene.shows)
}

/// From the new folder, so that the command fits the page wherever the folder is.
fn next(scene: &Scene) -> String {
    let holdout = match scene.part(PartName::Holdout).len() {
        0 => "",
        _ => " --holdout holdout.csv",
    };
    format!("hexbench diagnose hexapod.toml measurements.csv{holdout}")
}
