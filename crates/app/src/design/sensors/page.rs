//! The page of `hexbench design --sensors`.

use hexbench_core::{SensorKind, Tolerances, Vector3};
use hexbench_design::power::EffectPower;
use hexbench_design::sensors::{CandidateSensor, Found};
use hexbench_experiments::power::PlanReport;
use hexbench_report::number::{counted, significant, stated};
use hexbench_report::{Page, PageColumn, Section, Table};

use super::super::page::determined;
use super::{ChosenSensors, SensorNumber, ValuedSet};

/// Decimals of a component of a unit vector.
const UNIT_DIGITS: usize = 3;

impl ChosenSensors {
    /// The page.
    pub fn page(&self) -> Page {
        let own = &self.hexapod.sensors[..self.had];
        let names: Vec<&str> = own.iter().map(|s| s.name.as_str()).collect();
        let beside = (!names.is_empty())
            .then(|| format!("In addition to the sensors of the machine: {}.", names.join(", ")))
            .map(hexbench_report::Block::paragraph);
        let chosen = Section::new("Sensors")
            .remark("points in the mobile frame, mm; directions in fixed axes")
            .table(sensors(&self.chosen))
            .with(beside)
            .paragraph(self.total())
            .paragraph(self.how());
        let report = PlanReport { plan: &self.power.0, power: &self.power.1, only: &[], verbose: false };
        Page::default()
            .with(chosen)
            .with(self.buys())
            .with(self.uncertainties())
            .with(self.shown(report.assumptions()))
            .with(
                report
                    .blind()
                    .map(|s| Section { title: "Not detectable with these sensors".to_owned(), ..s }),
            )
    }

    /// The set that is chosen, with what it determines.
    pub(super) fn set(&self) -> Option<&ValuedSet> {
        self.numbers.iter().find(|n| n.limits == self.limits).and_then(|n| n.set.as_ref())
    }

    /// From which size on effects are seen.
    fn shown(&self, assumptions: String) -> Option<Section> {
        let effects = self.power.1.study.effects.iter().filter(|e| e.shows());
        let row = |e: &EffectPower| {
            let seen = e.size_seen().map_or(String::new(), |size| significant(size, 2));
            [e.term.to_owned(), seen, significant(e.usual_size, 2), e.unit.to_owned()]
        };
        let columns = [
            PageColumn::words("effect"),
            PageColumn::number("smallest"),
            PageColumn::number("usual size"),
            PageColumn::words("unit"),
        ];
        let table = Table::new(columns).rows(effects.map(row));
        let any = !table.rows.is_empty();
        let tested = "all numbers of an effect together, beside springs";
        Section::new("Smallest detectable size").remark(tested).table(table).paragraph(assumptions).when(any)
    }

    fn total(&self) -> String {
        let [readings, poses] = self.plan;
        let cost: f64 = self.chosen.iter().map(|c| c.cost).sum();
        let paid = self
            .limits
            .budget
            .map_or(String::new(), |most| format!(" They cost {} of {}.", plain(cost), plain(most)));
        format!(
            "{} of {} sensors to choose from, for {readings} readings at {}.{paid}",
            self.chosen.len(),
            self.candidates,
            counted(poses, "pose")
        )
    }

    fn how(&self) -> String {
        let value = self.set().map_or(0.0, |s| s.value);
        let what = match &self.see {
            None => format!("{} = {}", self.goal, significant(value, 6)),
            Some(term) => format!(
                "{term} of usual size is {} standard deviations beyond what the springs explain",
                significant(value, 3)
            ),
        };
        match self.found {
            Found::OfAll(sets) => format!("{what}: the best of all {sets} sets."),
            Found::ByExchange { starts, agreeing } => format!(
                "{what}: found by exchange; {agreeing} of {starts} starts reached it to four digits (seed {}).",
                self.seed
            ),
        }
    }

    fn buys(&self) -> Section {
        let columns = [
            PageColumn::number(if self.limits.budget.is_some() { "at most" } else { "sensors" }),
            PageColumn::number(if self.see.is_some() { "sigma seen" } else { self.goal }),
            PageColumn::number("uncertainty"),
            PageColumn::number("worst"),
            PageColumn::words("against those chosen"),
        ];
        Section::new("What one more or less buys")
            .remark("standard uncertainty of the stiffnesses, k = 1: root mean square of the legs, and the worst leg")
            .table(Table::new(columns).rows(self.numbers.iter().map(|n| self.row(n))))
    }

    fn row(&self, alternative: &SensorNumber) -> Vec<String> {
        let number = alternative.limits.number.to_string();
        let Some(set) = &alternative.set else {
            let none = "not determined".to_owned();
            return vec![number, none, String::new(), String::new(), String::new()];
        };
        let percent = |share: f64| format!("{} %", significant(100.0 * share, 2));
        let [mean, worst] = set.of_stiffnesses();
        vec![number, significant(set.value, 4), percent(mean), percent(worst), self.changes(set)]
    }

    /// What is in another set and not among those chosen, and the other way round.
    fn changes(&self, set: &ValuedSet) -> String {
        let Some(chosen) = self.set() else { return String::new() };
        let beyond = |a: &ValuedSet, b: &ValuedSet, sign: &str| {
            let more = a.names.iter().filter(|n| !b.names.contains(n));
            more.map(|n| format!("{sign}{n}")).collect::<Vec<_>>()
        };
        let changes = [beyond(set, chosen, "+"), beyond(chosen, set, "-")].concat();
        if changes.is_empty() { "the same".to_owned() } else { changes.join(" ") }
    }

    fn uncertainties(&self) -> Option<Section> {
        let shares = &self.set()?.shares;
        let springs = if self.see.is_some() { "By springs alone. " } else { "" };
        let Tolerances { sensor_point, sensor_direction, sensor_gain, .. } = self.hexapod.tolerances;
        Some(determined(&self.parameters, shares).paragraph(format!(
            "{springs}Tolerances: {}, points of sensors {} mm, their directions {} deg, their gains {} %.",
            self.tolerances,
            plain(sensor_point * 1e3),
            plain(sensor_direction.to_degrees()),
            plain(100.0 * sensor_gain)
        )))
    }
}

impl ValuedSet {
    /// Root mean square and largest share of the uncertainties of the six stiffnesses.
    pub(super) fn of_stiffnesses(&self) -> [f64; 2] {
        let legs = &self.shares[..self.shares.len().min(6)];
        let mean = hexbench_core::statistics::root_mean_square(legs.iter().copied()).unwrap_or(f64::NAN);
        [mean, legs.iter().copied().fold(0.0, f64::max)]
    }
}

fn sensors(chosen: &[CandidateSensor]) -> Table {
    let columns = [
        PageColumn::words("name"),
        PageColumn::words("kind"),
        PageColumn::words("point"),
        PageColumn::words("along"),
        PageColumn::number("sigma"),
        PageColumn::words("unit"),
        PageColumn::number("cost"),
    ];
    Table::new(columns).rows(chosen.iter().map(sensor))
}

fn sensor(candidate: &CandidateSensor) -> [String; 7] {
    let kind = &candidate.sensor.kind;
    let sigma = |number: usize| plain(1e6 * kind.sigma(number));
    let mut sigmas: Vec<String> = (0..kind.numbers()).map(sigma).collect();
    if sigmas.iter().all(|one| *one == sigmas[0]) {
        sigmas.truncate(1);
    }
    let along = match kind {
        SensorKind::Distance { direction, .. } => list(direction, UNIT_DIGITS),
        SensorKind::Inclination { axis, .. } => format!("about {}", list(axis, UNIT_DIGITS)),
        SensorKind::LegLength { leg, .. } => format!("leg {}", leg + 1),
        SensorKind::Point { .. } => "all axes".to_owned(),
        SensorKind::Function { .. } => "function".to_owned(),
    };
    [
        candidate.sensor.name.clone(),
        kind.word().to_owned(),
        kind.point().map_or(String::new(), |p| list(&(p * 1e3), 1)),
        along,
        sigmas.join(", "),
        if kind.is_angle() { "urad" } else { "um" }.to_owned(),
        plain(candidate.cost),
    ]
}

fn plain(x: f64) -> String {
    const DECIMALS: i32 = 6;
    stated(x, DECIMALS)
}

/// `1, 0, -0.5`, zeros without sign.
fn list(v: &Vector3, digits: usize) -> String {
    let number = |x: f64| {
        let text = format!("{x:.digits$}");
        let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
        if text == "-0" { "0".to_owned() } else { text }
    };
    [v.x, v.y, v.z].map(number).join(", ")
}
