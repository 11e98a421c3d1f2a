//! The page of a check.

use hexbench_model::effects::untestable::Untestable;
use hexbench_model::inference::examination::is_misread;
use hexbench_model::results::check::{Check, MachineCheck, ReadingsCheck};

use super::units::both;
use super::{findings, limits, notes, subject};
use crate::number::{counted, significant};
use crate::page::{Block, Definition, Mood, Page, Section};

/// What is understood of the files, what is wrong with them, what they could show.
pub fn check(machine: &str, c: &Check) -> Page {
    let files_read = c.measurements.iter().chain(&c.holdout).map(|m| Definition::new("data", about(m)));
    let files = [("Measurements", &c.measurements), ("Held-out readings", &c.holdout)];
    let readings = files.into_iter().filter_map(|(title, file)| Some(measurements(title, file.as_ref()?)));
    let page = Page { subject: files_read.collect(), ..Page::new(format!("Check of {machine}")) }
        .with(verdict(c))
        .with(wrong(c))
        .with(
            Section::new("What looks odd")
                .id("remarks")
                .list(c.remarks.iter().map(|r| format!("{r}.")))
                .unless_empty(),
        )
        .with(joints(&c.machine))
        .with_all(readings);
    if !c.ready || c.measurements.is_none() {
        return page.with(notes::conventions());
    }
    let untestable: &[Untestable] = &c.untestable;
    page.with(limits::smallest(&c.detectable, "springs"))
        .with(limits::not_tested(untestable))
        .with(notes::conventions())
}

fn verdict(c: &Check) -> Section {
    let (word, mood, sentence) = match (&c.measurements, c.ready) {
        (None, _) => (
            "READ",
            Mood::Good,
            "The machine is read as shown below. Compare it with the drawing, then add the measurements.",
        ),
        (Some(_), true) if c.remarks.is_empty() => {
            ("READY", Mood::Good, "The files are read as shown below. Next: `hexbench diagnose`.")
        }
        (Some(_), true) => (
            "READY",
            Mood::Doubt,
            "The files are read as shown below. Look first at what looks odd; then: `hexbench diagnose`.",
        ),
        (Some(_), false) => {
            let sentence = if is_misread(&c.findings) {
                "The files do not seem to mean what they say. Correct them, or try another interpretation with --read-as."
            } else {
                "First correct what is wrong, as stated below. `hexbench diagnose` omits single wrong readings by itself."
            };
            ("NOT READY", Mood::Bad, sentence)
        }
    };
    Section::new("Verdict").with(Block::Verdict {
        word: word.to_owned(),
        mood,
        sentences: vec![sentence.to_owned()],
    })
}

fn wrong(c: &Check) -> Option<Section> {
    Section::new("What is wrong")
        .id("findings")
        .with((!c.read_as.is_empty()).then(|| Block::colored(Mood::Doubt, findings::read_as(&c.read_as))))
        .list(c.findings.iter().map(findings::sentence))
        .unless_empty()
}

fn joints(m: &MachineCheck) -> Section {
    let list = |values: &[f64; 6], digits: usize| values.map(|x| format!("{x:.digits$}")).join("  ");
    let stroke = m.stroke_mm.map_or("not stated".to_owned(), |[a, b]| format!("{a:.1} to {b:.1} mm"));
    Section::new("The machine").id("machine").remark("at the zero pose").with(Block::entries([
        Definition::new(
            "joints",
            format!(
                "mean radius {:.1} mm at the base and {:.1} mm at the platform, {:.1} mm above it",
                m.base_radius_mm, m.platform_radius_mm, m.height_mm
            ),
        ),
        Definition::new("leg lengths", format!("{} mm", list(&m.home_lengths_mm, 2))),
        Definition::new("inclination", format!("{} deg from the vertical", list(&m.inclination_deg, 1))),
        Definition::new("stroke", stroke),
        Definition::new(
            "condition",
            format!("{:.1}, moments divided by the radius of the platform", m.condition),
        ),
    ]))
}

fn about(m: &ReadingsCheck) -> String {
    let (poses, conditions) = (counted(m.poses, "pose"), counted(m.conditions, "condition"));
    format!("{}: {} {} at {poses}, {conditions}", m.file, m.rows, m.measurand)
}

fn measurements(title: &str, m: &ReadingsCheck) -> Section {
    let digits = |x: f64| significant(x, 3);
    let mut all = vec![
        Definition::new(
            "poses",
            format!(
                "legs {:.2} to {:.2} mm long, angles up to {} deg",
                m.leg_lengths_mm.least,
                m.leg_lengths_mm.most,
                digits(m.largest_angle_deg)
            ),
        ),
        Definition::new(
            "loads",
            format!(
                "up to {} N and {} N m; in the legs {} to {} N, tension positive",
                digits(m.largest_force_n),
                digits(m.largest_moment_nm),
                digits(m.leg_forces_n.least),
                digits(m.leg_forces_n.most)
            ),
        ),
    ];
    if m.translation_rms_um.or(m.rotation_rms_urad).is_some() {
        let rms = both([m.translation_rms_um, m.rotation_rms_urad], 3);
        all.push(Definition::new("deflections", format!("{rms}, root mean square")));
    }
    let repeats = match (m.repeats, m.repeats_over_noise) {
        (Some(scatter), _) => format!("repeats scatter by {}", both(scatter.map(Some), 3)),
        (None, Some(times)) => format!("repeats scatter by {} times that", digits(times)),
        (None, None) => "no repeats".to_owned(),
    };
    let (noise, origin) = (both(m.noise, 3), subject::origin(m.noise_source));
    all.push(Definition::new("noise", format!("{noise} per reading, {origin}; {repeats}")));
    if let Some(k) = m.stiffness_n_per_um {
        let list = |k: [f64; 6]| k.map(digits).join("  ");
        let nominal = m.nominal_n_per_um.map_or(String::new(), |n| format!("; nominal {}", list(n)));
        all.push(Definition::new("stiffness", format!("{} N/um with springs alone{nominal}", list(k))));
    }
    if let Some(level) = m.springs_level {
        all.push(Definition::new(
            "springs",
            format!("error of the springs alone: {} times the noise", digits(level)),
        ));
    }
    Section::new(title)
        .id(if title.starts_with("Held-out") { "holdout" } else { "measurements" })
        .with(Block::entries(all))
}
