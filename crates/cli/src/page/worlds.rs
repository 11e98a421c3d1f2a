//! Several worlds beside each other: where the same machine comes to rest in each.

use hexbench_core::Vector6;
use hexbench_report::charts::ReportError;
use hexbench_report::number::significant;
use hexbench_report::plot::{Axis, Chart, Series};
use hexbench_report::{Block, Figure, Mood, Page, Section, Table};
use hexbench_truth::Situation;
use hexbench_truth::equilibrium::Body;

use crate::failure::Failure;

/// Largest difference, as a share of the deflection, of the rotation, of the largest leg force.
pub(crate) const LARGEST_SHARE: f64 = 1e-4;
/// Shares below this are drawn here: rounding.
const ROUNDING: f64 = 1e-16;
const COORDINATES: [&str; 6] = ["a, um", "b, um", "c, um", "rx, urad", "ry, urad", "rz, urad"];
const WHAT: [&str; 3] = ["position", "orientation", "leg forces"];

/// A state of rest in one world. Fixed frame, SI.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RestInWorld {
    /// The platform.
    pub(crate) platform: Body,
    /// Leg forces, N, tension positive.
    pub(crate) forces: [f64; 6],
}

/// A condition, and where each world comes to rest in it.
#[derive(Debug, Clone)]
pub(crate) struct StateOfWorlds {
    /// Pose and loads.
    pub(crate) situation: Situation,
    /// Loaded minus reference in the first world, m and rad.
    pub(crate) deflection: Vector6,
    /// In the order of the worlds.
    pub(crate) rests: Vec<RestInWorld>,
}

/// All of it.
pub(crate) struct Worlds {
    /// Name of the scene.
    pub(crate) scene: String,
    /// Of the platform, m.
    pub(crate) radius: f64,
    /// Names of the worlds.
    pub(crate) names: Vec<String>,
    /// States compared, one at least.
    pub(crate) states: Vec<StateOfWorlds>,
}

impl StateOfWorlds {
    /// Position, orientation, leg forces: how far a world is from the first, as shares of the deflection, of the rotation (with the
    /// deflection over the radius), of the largest force.
    fn shares(&self, world: usize, radius: f64) -> [f64; 3] {
        let [first, other] = [&self.rests[0], &self.rests[world]];
        let size = self.deflection.fixed_rows::<3>(0).norm().max(f64::MIN_POSITIVE);
        let turn = self.deflection.fixed_rows::<3>(3).norm() + size / radius;
        let apart = first.forces.iter().zip(other.forces).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        let largest = first.forces.iter().fold(f64::MIN_POSITIVE, |m, f| m.max(f.abs()));
        let off = other.platform.relative_to(&first.platform);
        [off.fixed_rows::<3>(0).norm() / size, off.fixed_rows::<3>(3).norm() / turn, apart / largest]
    }

    /// From the commanded pose to the rest in a world: um and urad, fixed axes.
    fn moved_in(&self, world: usize) -> [f64; 6] {
        let pose = &self.situation.pose;
        let command = Body { origin: pose.translation, axes: pose.rotation() };
        let moved = self.rests[world].platform.relative_to(&command);
        let fixed = |first: usize| command.axes * moved.fixed_rows::<3>(first);
        let (shift, turn) = (fixed(0), fixed(3));
        std::array::from_fn(|k| 1e6 * if k < 3 { shift[k] } else { turn[k - 3] })
    }
}

impl Worlds {
    /// Numbers of the worlds beside the first.
    fn others(&self) -> std::ops::Range<usize> {
        1..self.names.len()
    }

    /// The largest share of all states, worlds and quantities.
    pub(crate) fn apart(&self) -> f64 {
        let all = self.states.iter().flat_map(|state| self.others().map(|w| state.shares(w, self.radius)));
        // What is no number is no agreement.
        all.flatten().fold(0.0, |most, x| if x.is_finite() { most.max(x) } else { f64::INFINITY })
    }

    /// The page.
    ///
    /// # Errors
    /// A chart that cannot be made.
    pub(crate) fn page(&self) -> Result<Page, Failure> {
        let worlds = match self.names.as_slice() {
            [one, two] => format!("{one} and {two}"),
            [some @ .., last] => format!("{} and {last}", some.join(", ")),
            [] => String::new(),
        };
        let page = Page::new("The worlds side by side")
            .about("scene", self.scene.clone())
            .about("worlds", worlds)
            .about("states", format!("{} of the plan", self.states.len()));
        Ok(page.with(self.verdict()).with(self.differences()?).with(self.rests()).with(self.forces()))
    }

    fn verdict(&self) -> Section {
        let apart = self.apart();
        let agree = apart <= LARGEST_SHARE;
        let (mood, said) = if agree { (Mood::Good, "agree") } else { (Mood::Bad, "do not agree") };
        let text = format!(
            "The worlds {said}: at most {} apart, as a share of the deflection, the rotation or the largest leg force; the limit is \
             {LARGEST_SHARE:e}.",
            share(apart)
        );
        let lead = Section::lead().with(Block::colored(mood, text));
        if self.names.len() > 2 {
            return lead;
        }
        lead.paragraph(
            "MuJoCo can be the third: export the same states, bring them to rest with scripts/mujoco_check.py, and add --mujoco FILE.",
        )
    }

    fn differences(&self) -> Result<Section, Failure> {
        let mut section = Section::new("How far apart")
            .id("apart")
            .remark("shares of the deflection, of the rotation, of the largest leg force");
        for w in self.others() {
            let header = ["state", "deflection, um"].into_iter().chain(WHAT);
            let mut table =
                Table::named(header).titled(format!("{} against {}", self.names[w], self.names[0]));
            for (k, state) in self.states.iter().enumerate() {
                let size = significant(1e6 * state.deflection.fixed_rows::<3>(0).norm(), 4);
                let shares = state.shares(w, self.radius).map(share);
                table.row([(k + 1).to_string(), size].into_iter().chain(shares));
            }
            section = section.table(table);
        }
        let place = |k: usize| (k + 1) as f64;
        let all = self.states.iter().flat_map(|state| self.others().map(|w| state.shares(w, self.radius)));
        let least = all.flatten().fold(LARGEST_SHARE, |least, x| least.min(x.max(ROUNDING)));
        let mut decades = vec![LARGEST_SHARE];
        while decades[decades.len() - 1] > least {
            decades.push(decades[decades.len() - 1] / 10.0);
        }
        let shares = Axis::new("Share", "").with_logarithm().with_ticks(decades);
        let mut chart = Chart::new("Distance from hexbench", Axis::new("State", ""), shares);
        for w in self.others() {
            for (q, what) in WHAT.into_iter().enumerate() {
                let points = self.states.iter().enumerate();
                let points = points.map(|(k, s)| [place(k), s.shares(w, self.radius)[q].max(ROUNDING)]);
                chart = chart.with(Series::markers(format!("{}: {what}", self.names[w]), points.collect()));
            }
        }
        let limit = vec![[place(0), LARGEST_SHARE], [place(self.states.len() - 1).max(2.0), LARGEST_SHARE]];
        let chart = chart.with(Series::line("limit", limit));
        let svg = chart.laid_out().map_err(ReportError::from)?;
        let figure = Figure::laid_out(svg, "Each state in each world, against the first.");
        Ok(section.with(Block::Figure(figure.named("apart"))))
    }

    /// The state that deflects most.
    fn largest(&self) -> usize {
        let size = |k: &usize| self.states[*k].deflection.fixed_rows::<3>(0).norm();
        (0..self.states.len()).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(0)
    }

    fn rests(&self) -> Section {
        let k = self.largest();
        let mut table = Table::named(["world"].into_iter().chain(COORDINATES));
        for (w, name) in self.names.iter().enumerate() {
            let numbers = self.states[k].moved_in(w).map(|x| format!("{:.4}", x + 0.0));
            table.row(std::iter::once(name.clone()).chain(numbers));
        }
        Section::new("Where the platform rests")
            .id("rests")
            .remark(format!(
                "state {}, which deflects most: loaded, from the commanded pose, fixed axes",
                k + 1
            ))
            .table(table)
    }

    fn forces(&self) -> Section {
        let k = self.largest();
        let legs = (1..=6).map(|leg| format!("leg {leg}"));
        let mut table = Table::named(std::iter::once("world".to_owned()).chain(legs));
        for (name, rest) in self.names.iter().zip(&self.states[k].rests) {
            let numbers = rest.forces.map(|f| format!("{:.4}", f + 0.0));
            table.row(std::iter::once(name.clone()).chain(numbers));
        }
        Section::new("Forces in the legs")
            .id("forces")
            .remark("the same state: N, tension positive")
            .table(table)
    }
}

fn share(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") }
}
