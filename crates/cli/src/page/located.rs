//! Poses found from balls, in words.

use std::path::Path;

use hexbench_model::machine::registration::{Places, Registered, RegisteredPose};
use hexbench_report::number::significant;
use hexbench_report::{Block, Definition, Page, Section};

/// What the page is about.
pub(crate) struct Located<'a> {
    /// The poses.
    pub(crate) found: &'a Registered,
    /// What they were compared with.
    pub(crate) places: &'a Places,
    /// Noise of a coordinate when it was stated, m.
    pub(crate) stated: Option<f64>,
    /// The program whose layout the balls were in, if it is not that of `balls.csv`.
    pub(crate) layout: Option<&'static str>,
    /// Where the table is.
    pub(crate) output: &'a Path,
}

/// The page.
pub(crate) fn page(about: &Located<'_>) -> Page {
    let Registered { poses, .. } = about.found;
    let moved = poses.iter().filter(|pose| pose.moved).count();
    let moved = if moved == 0 { super::NONE_MOVED.into() } else { format!("a ball, in {moved} of them") };
    let entries = [
        ("records", poses.len().to_string()),
        ("balls", balls(about.places)),
        ("noise", noise(about)),
        ("one pose", one_pose(poses)),
        ("moved", moved),
        ("written", about.output.display().to_string()),
    ];
    let layout = about.layout.map(|name| ("read as", name.to_owned()));
    let entries = layout.into_iter().chain(entries).map(|(label, text)| Definition::new(label, text));
    Page::default().with(Section::new("Poses from balls").with(Block::entries(entries)))
}

fn balls(places: &Places) -> String {
    let platform = format!("{} on the platform", places.platform.len());
    match (places.measured, places.base.len()) {
        (true, _) => format!("{platform}; poses relative to a record, about the center of its balls"),
        (false, 0) => format!("{platform}; poses in the frame of the measuring machine"),
        (false, base) => format!("{platform}, {base} on the base; poses in the frame of the base"),
    }
}

fn noise(about: &Located<'_>) -> String {
    let um = |sigma: f64| significant(sigma * 1e6, 3);
    let estimated = about.found.estimated_sigma;
    match (about.stated, estimated) {
        (Some(stated), Some(found)) => {
            format!("{} um per coordinate as stated; the residuals give {} um", um(stated), um(found))
        }
        (Some(stated), None) => format!("{} um per coordinate as stated", um(stated)),
        (None, Some(found)) => format!("{} um per coordinate, from the residuals", um(found)),
        (None, None) => "unknown: none is stated, and there are no residuals to estimate it".into(),
    }
}

fn one_pose(poses: &[RegisteredPose]) -> String {
    let typical = |first: usize| {
        let sum: f64 = poses.iter().flat_map(|p| (first..first + 3).map(|k| p.covariance[(k, k)])).sum();
        significant((sum / (3 * poses.len().max(1)) as f64).sqrt() * 1e6, 3)
    };
    format!("{} um and {} urad, one standard deviation", typical(0), typical(3))
}
