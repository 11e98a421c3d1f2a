//! A law as a term file, as a formula and as a sentence.

use hexbench_core::words::to_digits;

use super::block::{Block, CARRIERS, COMPLIANCE, Constant, Family, PRESENCE};
use super::law::{Head, Law};
use super::legs::LegChoice;
use super::tables::thresholds;
use crate::effects::period::period_grid;
use crate::effects::user_term::{MOST_SHAPES, PartKind};
use crate::estimation::linearization::Linearization;

/// Lengths, the longest first, and how many make a meter.
const LENGTHS: [(&str, f64); 6] =
    [("m", 1.0), ("mm", 1e3), ("um", 1e6), ("nm", 1e9), ("pm", 1e12), ("fm", 1e15)];
/// The same of angles.
const ANGLES: [(&str, f64); 4] = [("mrad", 1e3), ("urad", 1e6), ("nrad", 1e9), ("prad", 1e12)];
/// Axes of a body.
const AXES: [&str; 6] = ["along x", "along y", "along z", "about x", "about y", "about z"];

/// A formula of a law with what it acts on.
pub(crate) struct LawLine {
    pub(crate) kind: PartKind,
    pub(crate) formula: String,
    /// Axis of a body from zero.
    axis: usize,
    /// Legs of an elongation from 1; none for all.
    pub(crate) legs: Option<Vec<usize>>,
}

impl LawLine {
    /// As keys of a term file.
    pub(crate) fn toml(&self) -> String {
        let key = self.kind.key();
        if self.kind != PartKind::Elongation {
            let six: [String; 6] = std::array::from_fn(|k| {
                if k == self.axis { format!("\"{}\"", self.formula) } else { "\"\"".to_owned() }
            });
            return format!("{key} = [{}]\n", six.join(", "));
        }
        let legs = self.legs.as_ref().map_or(String::new(), |legs| format!("legs = {legs:?}\n"));
        format!("{key} = \"{}\"\n{legs}", self.formula)
    }

    /// Where it acts, where that is not all legs.
    pub(crate) fn place(&self) -> Option<String> {
        if self.kind != PartKind::Elongation {
            return Some(format!("{} {}", self.kind.key().replace('_', " "), AXES[self.axis]));
        }
        self.legs.as_ref().map(|legs| format!("{legs:?}"))
    }
}

/// Longest id of a term.
const LONGEST_ID: usize = 36;
/// Values of a constant offered on each side of the one found, and how far they go.
const SIDE_STEPS: i32 = 6;
const SIDE_FACTOR: f64 = 2.0;
/// Thresholds offered on each side of the one found; two that differ by less, relative, are one.
const NEAR_THRESHOLDS: usize = 6;
const SAME_THRESHOLD: f64 = 1e-6;
/// A fit may carry a constant this many times as far as the values offered.
const BEYOND: f64 = 2.0;

impl Law {
    /// Kebab-case name.
    pub(crate) fn id(&self) -> String {
        let slugs: Vec<&str> = self.product.blocks().map(|b| b.slug).collect();
        let lead = match self.product.head {
            Head::Length(_) => "length-",
            Head::Pose(_) => "pose-",
            Head::Body(PartKind::Wrench, _) => "wrench-",
            Head::Body(PartKind::BaseMotion, _) => "base-",
            Head::Body(PartKind::PlatformMotion, _) => "platform-",
            _ => "",
        };
        let legs =
            self.axis().map_or_else(|| self.legs.slug(), |axis| format!("-{}", AXES[axis].replace(' ', "-")));
        let mut id = format!("{lead}{}", slugs.join("-"));
        id.truncate(LONGEST_ID - legs.len());
        format!("{}{legs}", id.trim_end_matches('-'))
    }

    /// Names of its sizes; `mark` tells the laws of a sum apart.
    pub(crate) fn size_names(&self, mark: &str) -> Vec<String> {
        let names: &[&str] = if self.product.is_wave() { &["sine", "cosine"] } else { &["size"] };
        names.iter().map(|name| format!("{name}{mark}")).collect()
    }

    /// Its formulas (everything SI), one for each group of legs. `is_fitted`: the constant inside stands by its name, else as a number.
    pub(crate) fn lines(&self, mark: &str, is_fitted: bool) -> Vec<LawLine> {
        let in_turn = if self.legs.alternates() { "(-1)^leg*" } else { "" };
        let fixed = |text: String| match self.product.constant().filter(|_| !is_fitted) {
            Some(constant) => with_number(&text, constant.name(), &self.constant_text(constant)),
            None => text,
        };
        let formula = |sign: i8| {
            let named = self.size_names(mark).into_iter().zip(self.product.formulas());
            let minus = if sign < 0 { "-" } else { "" };
            let terms: Vec<String> =
                named.map(|(name, text)| format!("{minus}{name}*{in_turn}{}", fixed(text))).collect();
            terms.join(" + ").replace("+ -", "- ").trim_end_matches("*1").to_owned()
        };
        let kind = self.product.kind();
        if let Some(axis) = self.axis() {
            return vec![LawLine { kind, formula: formula(1), axis, legs: None }];
        }
        let groups = self.legs.groups().into_iter();
        groups.map(|(sign, legs)| LawLine { kind, formula: formula(sign), axis: 0, legs }).collect()
    }

    fn constant_text(&self, constant: Constant) -> String {
        let (unit, per_si) = constant.unit();
        let number = to_digits(self.constant * per_si, 7);
        if unit == "1" { number.to_string() } else { format!("({number} {unit})") }
    }

    /// Unit of its sizes that makes `scale` (SI) a number people read, and how many of it make one SI unit.
    pub(crate) fn unit(&self, scale: f64) -> (String, f64) {
        let units: &[(&str, f64)] = match (self.product.kind(), self.axis().is_some_and(|axis| axis >= 3)) {
            (PartKind::Wrench, false) => &[("N", 1.0)],
            (PartKind::Wrench, true) => &[("N m", 1.0)],
            (PartKind::BaseMotion | PartKind::PlatformMotion, true) => &ANGLES,
            _ => &LENGTHS,
        };
        let readable = units.iter().find(|(_, per_si)| scale * per_si >= 1.0).or(units.last());
        let (above, per_si) = readable.copied().unwrap_or(("1", 1.0));
        let symbols = ["N", "m", "K", "s"];
        let powers = symbols.into_iter().zip(self.product.powers()).filter(|(_, power)| *power > 0.0);
        let written = |(symbol, power): (&str, f64)| {
            if (power - 1.0).abs() < f64::EPSILON { symbol.to_owned() } else { format!("{symbol}^{power}") }
        };
        let below: Vec<String> = powers.map(written).collect();
        let unit = match below.len() {
            0 => above.to_owned(),
            1 => format!("{above}/{}", below[0]),
            _ => format!("{above}/({})", below.join(" ")),
        };
        (unit, per_si)
    }

    /// What it says, without a sign: `the compliance of all legs changes with temperature`.
    pub(crate) fn sentence(&self, rises: Option<bool>) -> String {
        let with: Vec<&Block> = self.product.blocks().filter(|b| !b.words.is_empty()).collect();
        let what = match self.product.head {
            Head::Length(_) | Head::Pose(_) => "length",
            Head::Compliance(_) | Head::Loaded(_) | Head::Carrier(COMPLIANCE) => "compliance",
            Head::Carrier(_) | Head::Body(..) => "elongation",
        };
        let body = self.axis().map(|axis| {
            let (axis, turns) = (AXES[axis], axis >= 3);
            match self.product.kind() {
                PartKind::Wrench => {
                    format!("a {} {axis} on the platform", if turns { "moment" } else { "force" })
                }
                PartKind::BaseMotion => {
                    format!("the {} of the base {axis}", if turns { "turn" } else { "place" })
                }
                _ => format!("the {} of the measured platform {axis}", if turns { "turn" } else { "place" }),
            }
        });
        let subject = body.unwrap_or_else(|| format!("the {what} of {}", self.legs.words()));
        if let Some(wave) = with.iter().find(|b| b.twin.is_some()) {
            let more: Vec<&str> = with.iter().filter(|b| b.slug != wave.slug).map(|b| b.words).collect();
            let and =
                if more.is_empty() { String::new() } else { format!(", more with {}", more.join(" and ")) };
            return format!("{subject} repeats every {:.2} mm of leg length{and}", self.constant * 1e3);
        }
        if let Some(jump) = with.iter().find(|b| b.slug == "jump") {
            let more: Vec<&str> = with.iter().filter(|b| b.slug != jump.slug).map(|b| b.words).collect();
            let and =
                if more.is_empty() { String::new() } else { format!(", more with {}", more.join(" and ")) };
            return format!("{subject} jumps after {:.0} s{and}", self.constant);
        }
        if let Head::Body(_, PRESENCE) = self.product.head {
            return format!("{subject} is applied with every load");
        }
        let verb = match rises {
            Some(true) => "grows",
            Some(false) => "falls",
            None => "changes",
        };
        if self.product.constant() == Some(Constant::Length) {
            let verb = if self.product.is_length_of_pose() { "jumps at" } else { &format!("{verb} beyond") };
            return format!("{subject} {verb} a leg length of {:.1} mm", self.constant * 1e3);
        }
        let things: Vec<&str> = with.iter().map(|b| b.words).collect();
        format!("{subject} {verb} with {}{}", things.join(" times "), self.constant_words())
    }

    fn constant_words(&self) -> String {
        match self.product.constant() {
            Some(Constant::Force) => format!(" (from about {:.0} N)", self.constant),
            Some(Constant::Time) => format!(" (time constant {:.0} s)", self.constant),
            Some(Constant::Exponent) => format!(" (exponent {:.2})", self.constant),
            Some(Constant::Period | Constant::Instant | Constant::Length) | None => String::new(),
        }
    }

    /// What an engineer would look at, three things.
    pub(crate) fn look_at(&self) -> [&'static str; 3] {
        let families: Vec<Family> = self.product.blocks().map(|b| b.family).collect();
        let has = |family: Family| families.contains(&family);
        if let Head::Body(_, PRESENCE) = self.product.head {
            return [
                "a shackle, tray, adapter or hook that is applied with the load but missing in the list of loads",
                "the zero of the load cell, read without the load and with it",
                "a hose or cable that tightens when the load is applied",
            ];
        }
        if self.axis().is_some() {
            return [
                "foundation, frame and platform: anything that yields, warms or slips between the joints and the floor",
                "the instrument: its mount, its warm-up, its distance from the machine",
                "cables, hoses and covers that pull on the platform",
            ];
        }
        if let Head::Pose(_) = self.product.head {
            [
                "the screw or scale of the leg: its error over the whole stroke, beside a laser or gauge blocks",
                "what the controller corrects: a table or a factor that stands for another machine",
                "joints whose centers move as they turn, and guides that are not straight",
            ]
        } else if self.product.is_wave() {
            [
                "the lead of the screw, its half and its third, compared with this period: nut, ball return, gear",
                "the bearing of the screw and its preload: turn it once by hand under load",
                "the coupling and the encoder, if the period is one turn of the motor",
            ]
        } else if has(Family::Time) {
            [
                "parts that warm up under load: motor, brake, room",
                "joints and threads that settle: apply the same load again without unloading",
                "adhesive or plastic parts in the leg, which creep",
            ]
        } else if has(Family::Temperature) {
            [
                "parts of the leg with a different thermal expansion, or warmed on one side",
                "where the temperature is measured, compared with where the leg is warm",
                "the preload of bearings and nuts, both warm and cold",
            ]
        } else if has(Family::Approach) {
            [
                "play and friction in nut and joints: load and unload in small steps",
                "a clamp or brake that slips when the load is exceeded",
                "whether the order of the loads was kept in every row",
            ]
        } else if self
            .product
            .blocks()
            .any(|b| b.slug.ends_with("-leg") || b.slug.ends_with("-legs") || b.slug == "both-neighbors")
        {
            [
                "parts that the legs share: mount, bracket, plate or beam between their joints",
                "bolts and welds of that part, and its stiffness between the joints",
                "the two joints while only one of the legs is loaded",
            ]
        } else if has(Family::Length) {
            [
                "the free length of screw or tube at both ends of the stroke, and its guides",
                "nut and bearing along the stroke: wear in the most used range",
                "supports that touch only at one end of the stroke",
            ]
        } else if has(Family::Direction) || has(Family::Pose) {
            [
                "joints that bind or yield sideways when they are turned: play, cross springs, forks",
                "mounts that are softer in one direction than in the other",
                "cables and hoses that pull in this part of the workspace",
            ]
        } else if has(Family::Wrench) {
            [
                "the part through which the load is applied",
                "the plate between the joints under this component of the load",
                "the load cell's axes and its crosstalk",
            ]
        } else {
            [
                "contacts and bearings of these legs that stiffen, open or yield with the force",
                "threads, bolts and preload along the leg: which part unloads at this force",
                "the leg alone in a testing machine over the same range of force",
            ]
        }
    }

    /// Values of its constant worth trying when it is fitted elsewhere, SI, ascending; and the limits.
    fn constant_range(&self, lin: &Linearization) -> (Vec<f64>, [f64; 2]) {
        if self.product.constant() == Some(Constant::Period) {
            let grid = near_periods(&period_grid(&lin.conditions), self.constant);
            let limits = [self.constant / (BEYOND * SIDE_FACTOR), self.constant * BEYOND * SIDE_FACTOR];
            return (grid, limits);
        }
        if let Some(all) = self.product.constant().and_then(|c| thresholds(c, &lin.conditions)) {
            let at = all.partition_point(|t| *t < self.constant);
            let near = &all[at.saturating_sub(NEAR_THRESHOLDS)..(at + NEAR_THRESHOLDS).min(all.len())];
            let mut grid: Vec<f64> = near.iter().copied().chain([self.constant]).collect();
            grid.sort_unstable_by(f64::total_cmp);
            grid.dedup_by(|a, b| (*a - *b).abs() < SAME_THRESHOLD * b.abs());
            let limits = [grid[0] / BEYOND, grid[grid.len() - 1] * BEYOND];
            return (grid, limits);
        }
        let step = |k: i32| self.constant * SIDE_FACTOR.powf(f64::from(k) / f64::from(SIDE_STEPS));
        let grid = (-SIDE_STEPS..=SIDE_STEPS).map(step).collect();
        (grid, [step(-SIDE_STEPS) / BEYOND, step(SIDE_STEPS) * BEYOND])
    }

    /// `[[parameters]]` of its sizes; `scale`: their physically sensible size, SI.
    pub(crate) fn parameters_text(&self, scale: f64, mark: &str) -> String {
        let (unit, per_si) = self.unit(scale);
        let per_leg = if self.legs == LegChoice::Each { "per_leg = true\n" } else { "" };
        let of = |name: String| {
            let scale = to_digits(scale * per_si, 2);
            format!(
                "\n[[parameters]]\nname = \"{name}\"\nunit = \"{unit}\"\nper_si = {per_si:e}\nscale = {scale}\n{per_leg}"
            )
        };
        self.size_names(mark).into_iter().map(of).collect()
    }

    /// `[shape]` of its constant.
    pub(crate) fn shape_text(&self, lin: &Linearization) -> String {
        let Some(constant) = self.product.constant() else { return String::new() };
        let (grid, limits) = self.constant_range(lin);
        let (unit, per_si) = constant.unit();
        let shown = |values: &[f64]| {
            values.iter().map(|v| to_digits(v * per_si, 7).to_string()).collect::<Vec<_>>().join(", ")
        };
        let (name, limits, grid) = (constant.name(), shown(&limits), shown(&grid));
        format!("\n[shape]\nname = \"{name}\"\nunit = \"{unit}\"\nbounds = [{limits}]\ngrid = [{grid}]\n")
    }

    /// True when a positive size means that what it describes grows; none where it has no such sense.
    pub(crate) fn has_direction(&self) -> bool {
        let is_carrier = match self.product.head {
            Head::Carrier(k) => k == COMPLIANCE || CARRIERS[k].family == Family::Force,
            Head::Length(_) | Head::Pose(_) | Head::Compliance(_) | Head::Loaded(_) | Head::Body(..) => true,
        };
        is_carrier && !self.legs.differs() && !self.product.is_wave()
    }
}

/// A period and those near it, ascending; `all` descend. Over a long travel more are near a short period than a term may offer.
fn near_periods(all: &[f64], period: f64) -> Vec<f64> {
    let most = (MOST_SHAPES - 1) / 2;
    let at = all.partition_point(|p| *p > period);
    let near = &all[at.saturating_sub(most)..(at + most).min(all.len())];
    let is_near = |p: &&f64| (period / SIDE_FACTOR..period * SIDE_FACTOR).contains(*p);
    let mut grid: Vec<f64> = near.iter().filter(is_near).copied().chain([period]).collect();
    grid.sort_unstable_by(f64::total_cmp);
    grid
}

/// A formula with a number in the place of a name.
fn with_number(text: &str, name: &str, number: &str) -> String {
    let mut out = String::new();
    let mut word = String::new();
    for c in text.chars().chain([' ']) {
        if c.is_ascii_alphanumeric() || c == '_' {
            word.push(c);
            continue;
        }
        out.push_str(if word == name { number } else { &word });
        word.clear();
        out.push(c);
    }
    out.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_of_a_body_stands_in_its_axis_and_one_of_legs_with_their_numbers() {
        let line = |kind, legs| LawLine { kind, formula: "size*t".to_owned(), axis: 2, legs };
        let body = line(PartKind::Wrench, None);
        assert_eq!(body.toml(), "wrench = [\"\", \"\", \"size*t\", \"\", \"\", \"\"]\n");
        assert_eq!(body.place().as_deref(), Some("wrench along z"));
        let legs = line(PartKind::Elongation, Some(vec![1, 4]));
        assert_eq!(legs.toml(), "elongation = \"size*t\"\nlegs = [1, 4]\n");
        assert_eq!(legs.place().as_deref(), Some("[1, 4]"));
        assert_eq!(line(PartKind::Elongation, None).place(), None);
    }

    #[test]
    fn no_more_periods_are_offered_than_a_term_may_have_and_those_nearest_to_the_one_found() {
        // Equally spaced in frequency: 0.2 m of travel, from 0.2 m down to half a millimeter.
        let all: Vec<f64> = (4..1600).map(|k| 0.8 / f64::from(k)).collect();
        let grid = near_periods(&all, 1.003e-3);
        assert!(grid.len() <= MOST_SHAPES && grid.len() > MOST_SHAPES - 3, "{}", grid.len());
        let near = all.iter().filter(|p| (0.8e-3..1.2e-3).contains(*p));
        assert!(
            grid.contains(&1.003e-3) && near.clone().count() > 100 && near.clone().all(|p| grid.contains(p))
        );
        assert_eq!(
            near_periods(&all[..8], 0.1),
            [0.8 / 11.0, 0.08, 0.8 / 9.0, 0.1, 0.1, 0.8 / 7.0, 0.8 / 6.0, 0.16]
        );
    }

    #[test]
    fn a_constant_is_written_with_seven_digits_and_a_size_with_two() {
        assert_eq!(to_digits(0.123_456_789, 7).to_string(), "0.1234568");
        assert_eq!(to_digits(0.012_34, 2).to_string(), "0.012");
        assert_eq!(with_number("exp(-t/tau)*taut", "tau", "(3 s)"), "exp(-t/(3 s))*taut");
    }
}
