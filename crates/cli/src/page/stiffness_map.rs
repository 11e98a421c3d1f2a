//! Maps over the workspace: how stiff the platform is, how well that is known, what a load moves.

use std::path::Path;

use hexbench_core::{Observation, Pose, Vector3};
use hexbench_model::application::model_file::Model;
use hexbench_model::application::predict::predict_with_covariance;
use hexbench_model::application::stiffness::{CartesianStiffness, StiffnessPoint};
use hexbench_report::number::significant;
use hexbench_report::plot::HeatMap;
use hexbench_report::words::{Wide, about_stiffness, lopsided_stiffness};
use hexbench_report::{Block, Figure, Page, Section};

use crate::failure::Failure;

/// Places along each side.
const SIDE: usize = 9;
/// Where an uncertainty comes from.
const OF_MODEL: &str = "From the covariance of the model.";
const UNCERTAINTY: &str = "Its uncertainty, percent";

/// Poses of a square in x and y around a pose, row by row from the largest y.
pub(crate) fn square(centre: &Pose, half: f64) -> Vec<Pose> {
    let place = |k: usize| half * (2.0 * k as f64 / (SIDE - 1) as f64 - 1.0);
    let at = |k: usize| Vector3::new(place(k % SIDE), -place(k / SIDE), 0.0);
    (0..SIDE * SIDE).map(|k| Pose { translation: centre.translation + at(k), ..*centre }).collect()
}

/// What the maps show.
pub(crate) struct Mapped<'a> {
    /// The model.
    pub(crate) model: &'a Model,
    /// The places of [`square`] under the load.
    pub(crate) rows: &'a [Observation],
    /// Stiffness at each.
    pub(crate) found: &'a [CartesianStiffness],
    /// The point and its axes.
    pub(crate) at: &'a StiffnessPoint,
    /// How wide the uncertainties are.
    pub(crate) wide: &'a Wide,
}

impl Mapped<'_> {
    /// The page.
    ///
    /// # Errors
    /// A place at which the model does not settle; a chart that cannot be made.
    pub(crate) fn page(&self) -> Result<Page, Failure> {
        let [a, b, c] = self.rows[SIDE * SIDE / 2].pose.translation.map(|m| significant(m * 1e3, 4)).into();
        let middle = &self.rows[SIDE * SIDE / 2];
        let machine = self.model.hexapod.name.clone();
        let page = Page::new("Stiffness over the workspace").about("machine", machine);
        let page = about_stiffness(page, &middle.pose, &middle.wrench, self.at)
            .about(
                "places",
                format!("{SIDE} by {SIDE} in x and y of the fixed frame around {a}, {b}, {c} mm"),
            )
            .about("uncertainty", self.wide.words.clone())
            .with(lopsided_stiffness(self.found, self.at))
            .with(self.softest()?)
            .with(self.vertical()?);
        Ok(page.with(self.deflection()?))
    }

    fn softest(&self) -> Result<Section, Failure> {
        let of = |k: &CartesianStiffness| k.of_forces[0];
        let stiffness = self.map("Softest direction, N/um", 2, |k| of(k).stiffness * 1e-6)?;
        let known = self.map(UNCERTAINTY, 2, |k| 1e2 * self.wide.factor * of(k).std / of(k).stiffness)?;
        let captions = ["A force through the point, the platform free to turn.", OF_MODEL];
        Ok(both(("Softest direction", "softest"), "stiffness", [stiffness, known], captions))
    }

    fn vertical(&self) -> Result<Section, Failure> {
        let along = |k: &CartesianStiffness| [k.compliance[(2, 2)].recip(), k.compliance_std[(2, 2)]];
        let stiffness = self.map("Along z, N/um", 2, |k| along(k)[0] * 1e-6)?;
        let known = self.map(UNCERTAINTY, 2, |k| 1e2 * self.wide.factor * along(k)[1] * along(k)[0])?;
        let captions = ["A force along z, the platform free to turn.", OF_MODEL];
        Ok(both(("Along z of the axes stated", "along-z"), "stiffness", [stiffness, known], captions))
    }

    /// None without a load, and for absolute poses, whose reading is no deflection.
    fn deflection(&self) -> Result<Option<Section>, Failure> {
        if self.model.is_absolute() || self.rows[0].wrench == self.rows[0].reference {
            return Ok(None);
        }
        let found =
            predict_with_covariance(self.model, self.rows).map_err(Failure::in_file(Path::new("map")))?;
        let all = found.iter().map(|(reading, covariance)| {
            let shift = Vector3::from_row_slice(&reading.value[..3]);
            let along = shift.try_normalize(0.0).unwrap_or_default();
            let variance = (along.transpose() * covariance.fixed_view::<3, 3>(0, 0) * along)[(0, 0)];
            [shift.norm() * 1e6, variance.max(0.0).sqrt() * 1e6]
        });
        let all: Vec<[f64; 2]> = all.collect();
        let size = self.cells("Shift of the mobile origin, um", 2, |k| all[k][0])?;
        let known = self.cells("Its uncertainty, um", 3, |k| self.wide.factor * all[k][1])?;
        let captions = [
            "From no load to the load, all effects of the model counted.",
            "Along the shift, from the covariance of the model and the tolerances of joints and loads.",
        ];
        Ok(Some(both(("Deflection under the load", "deflection"), "shift", [size, known], captions)))
    }

    fn map(
        &self,
        title: &str,
        decimals: usize,
        of: impl Fn(&CartesianStiffness) -> f64,
    ) -> Result<[String; 2], Failure> {
        self.cells(title, decimals, |k| of(&self.found[k]))
    }

    fn cells(&self, title: &str, decimals: usize, of: impl Fn(usize) -> f64) -> Result<[String; 2], Failure> {
        let mm = |k: usize, axis: usize| significant(self.rows[k].pose.translation[axis] * 1e3, 3);
        let columns = (0..SIDE).map(|k| mm(k, 0)).collect();
        let rows = (0..SIDE).map(|k| mm(k * SIDE, 1)).collect();
        let values: Vec<Vec<f64>> =
            (0..SIDE).map(|row| (0..SIDE).map(|k| of(row * SIDE + k)).collect()).collect();
        let [least, most] = values
            .iter()
            .flatten()
            .fold([f64::INFINITY, 0.0], |[least, most], x| [least.min(*x), x.max(most)]);
        let map = HeatMap::new(title, rows, columns, values).with_axis_titles("b, mm", "a, mm");
        // Half of the spread below the least: maps whose numbers differ by little have light and dark places all the same.
        let paper = least - 0.5 * (most - least);
        Ok(map
            .with_decimals(decimals)
            .with_no_shade_at(paper.max(0.0))
            .with_cell_size(52.0, 26.0)
            .laid_out()?)
    }
}

/// The map of something, by its name, and that of its uncertainty.
fn both(
    (title, id): (&str, &str),
    name: &str,
    [of_it, known]: [[String; 2]; 2],
    [caption, of_known]: [&str; 2],
) -> Section {
    Section::new(title)
        .id(id)
        .with(Block::Figure(Figure::laid_out(of_it, caption).named(name)))
        .with(Block::Figure(Figure::laid_out(known, of_known).named("uncertainty")))
}
