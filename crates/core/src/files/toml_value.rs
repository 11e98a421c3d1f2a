//! TOML values with their places, and keys that carry units.

use super::error::Fault;
use super::nearest::nearest;
use super::number::{parse_number, usable};
use super::stated_unit::stated_unit;
use super::units::{PLAIN, Unit};
use super::{Dimension, FilePlace, FileProblem};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

type Value<'t> = Spanned<DeValue<'t>>;

/// A key a section may have, without its unit, and the unit it is usually written in.
#[derive(Debug, Clone, Copy)]
pub struct KeyUnit {
    pub(crate) name: &'static str,
    pub(crate) kind: Dimension,
    pub(crate) unit: &'static str,
}

impl KeyUnit {
    /// A key without unit.
    pub const fn plain(name: &'static str) -> Self {
        Self { name, kind: Dimension::Number, unit: "" }
    }

    /// Keys without units.
    pub const fn all_plain<const N: usize>(names: [&'static str; N]) -> [Self; N] {
        let mut keys = [Self::plain(""); N];
        let mut k = 0;
        while k < N {
            keys[k] = Self::plain(names[k]);
            k += 1;
        }
        keys
    }

    /// A key with a unit.
    pub const fn with_unit(name: &'static str, kind: Dimension, unit: &'static str) -> Self {
        Self { name, kind, unit }
    }

    /// Its name without the unit.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// The unit that `spelled` adds to this key (empty for none); none when it is another key.
    fn unit_in<'s>(&self, spelled: &'s str) -> Option<&'s str> {
        let rest = spelled.strip_prefix(self.name)?;
        let unit = rest.strip_prefix('_').filter(|_| self.kind != Dimension::Number);
        if rest.is_empty() { Some("") } else { unit }
    }

    fn usual_name(&self) -> String {
        if self.unit.is_empty() { self.name.to_owned() } else { format!("{}_{}", self.name, self.unit) }
    }
}

/// A table whose keys are all known.
#[derive(Debug)]
pub struct TomlSection<'t> {
    text: &'t str,
    title: &'static str,
    keys: &'static [KeyUnit],
    items: Vec<(&'static KeyUnit, Item<'t>)>,
}

/// A value with the unit its key states.
#[derive(Debug, Clone)]
pub struct Item<'t> {
    text: &'t str,
    key: String,
    unit: &'static Unit,
    value: &'t Value<'t>,
}

impl<'t> TomlSection<'t> {
    /// Reads the keys of a table; an unknown or repeated one is a fault.
    pub(crate) fn open(
        text: &'t str,
        title: &'static str,
        table: &'t DeTable<'t>,
        keys: &'static [KeyUnit],
    ) -> Result<Self, Fault> {
        let mut section = Self { text, title, keys, items: Vec::new() };
        for (name, value) in in_file_order(table) {
            section.add(name, value)?;
        }
        Ok(section)
    }

    /// The known keys of a table, whatever else it holds.
    pub(crate) fn peek(
        text: &'t str,
        table: &'t DeTable<'t>,
        keys: &'static [KeyUnit],
    ) -> Result<Self, Fault> {
        let mut section = Self { text, title: "", keys, items: Vec::new() };
        for (name, value) in in_file_order(table) {
            if known_key(name.get_ref(), keys).is_ok() {
                section.add(name, value)?;
            }
        }
        Ok(section)
    }

    fn add(&mut self, name: &Spanned<DeString<'t>>, value: &'t Value<'t>) -> Result<(), Fault> {
        let spelled = name.get_ref().as_ref();
        let place = || place_of(self.text, &name.span()).with_name(spelled);
        let (key, unit) = known_key(spelled, self.keys).map_err(|problem| Fault::new(place(), problem))?;
        if self.items.iter().any(|(other, _)| other.name == key.name) {
            return Err(Fault::new(place(), FileProblem::DuplicateKey { quantity: key.name.into() }));
        }
        self.items.push((key, Item { text: self.text, key: spelled.to_owned(), unit, value }));
        Ok(())
    }

    /// The value of a key that may be absent.
    pub fn get(&self, name: &str) -> Option<&Item<'t>> {
        self.items.iter().find(|(key, _)| key.name == name).map(|(_, item)| item)
    }

    /// The value of a key that must be there.
    ///
    /// # Errors
    /// A [`Fault`] when it is absent.
    pub fn require(&self, name: &str) -> Result<&Item<'t>, Fault> {
        self.get(name).ok_or_else(|| {
            let usual = self.keys.iter().find(|key| key.name == name).map(KeyUnit::usual_name);
            let key = usual.unwrap_or_else(|| name.to_owned());
            let place = if self.title.is_empty() {
                FilePlace::file()
            } else {
                FilePlace::file().with_name(self.title)
            };
            Fault::new(place, FileProblem::MissingKey { key })
        })
    }

    /// A table inside this one; absent means empty.
    ///
    /// # Errors
    /// A [`Fault`] at a value that is no table, or at an unknown or repeated key.
    pub fn section(
        &self,
        name: &'static str,
        title: &'static str,
        keys: &'static [KeyUnit],
    ) -> Result<TomlSection<'t>, Fault> {
        match self.get(name) {
            None => Ok(TomlSection { text: self.text, title, keys, items: Vec::new() }),
            Some(item) => item.section(title, keys),
        }
    }
}

fn in_file_order<'t>(table: &'t DeTable<'t>) -> Vec<(&'t Spanned<DeString<'t>>, &'t Value<'t>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(name, _)| name.span().start);
    entries
}

/// The key that is meant and its unit.
fn known_key(
    spelled: &str,
    keys: &'static [KeyUnit],
) -> Result<(&'static KeyUnit, &'static Unit), FileProblem> {
    let unit = |key: &KeyUnit| stated_unit(key.name, key.kind, key.usual_name(), key.unit_in(spelled));
    // A key may be listed for several kinds of quantity: the unit decides.
    let mut meant = keys.iter().filter(|key| key.unit_in(spelled).is_some());
    let first = meant.next().ok_or_else(|| unknown_key(spelled, keys))?;
    match unit(first) {
        Ok(unit) => Ok((first, unit)),
        Err(problem) => meant.find_map(|key| Some((key, unit(key).ok()?))).ok_or(problem),
    }
}

fn unknown_key(spelled: &str, keys: &[KeyUnit]) -> FileProblem {
    let known: Vec<String> = keys.iter().map(KeyUnit::usual_name).collect();
    let suggestion = nearest(spelled, known.iter().map(String::as_str)).map(str::to_owned);
    FileProblem::UnknownKey { suggestion, known }
}

impl<'t> Item<'t> {
    /// A fault at this value.
    pub fn fault(&self, problem: FileProblem) -> Fault {
        self.fault_at(self.value, problem)
    }

    /// A rule of the format that this value breaks, and what to write instead.
    pub fn breaks(&self, rule: impl Into<String>, next: impl Into<String>) -> Fault {
        self.fault(FileProblem::Rule { rule: rule.into(), next: next.into() })
    }

    fn fault_at(&self, value: &Value<'_>, problem: FileProblem) -> Fault {
        let span = value.span();
        let place = place_of(self.text, &span).with_name(&self.key);
        let text = self.text.get(span).unwrap_or_default();
        Fault::new(
            if text.contains('\n') { place } else { place.with_value(text.trim_matches('"')) },
            problem,
        )
    }

    fn wrong_type(&self, expected: &'static str, value: &Value<'_>) -> Fault {
        self.fault_at(value, FileProblem::WrongType { expected, found: value.get_ref().type_str() })
    }

    /// A string.
    ///
    /// # Errors
    /// A [`Fault`] at a value of another kind.
    pub fn string(&self) -> Result<&str, Fault> {
        self.value
            .get_ref()
            .as_str()
            .ok_or_else(|| self.wrong_type("a string in quotation marks", self.value))
    }

    /// A finite number in SI.
    ///
    /// # Errors
    /// A [`Fault`] at a value of another kind.
    pub fn number(&self) -> Result<f64, Fault> {
        let digits = match self.value.get_ref() {
            DeValue::Float(float) => float.as_str(),
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str(),
            _ => return Err(self.wrong_type("a number", self.value)),
        };
        let parsed = parse_number(&digits.replace('_', "")).map_err(|problem| self.fault(problem))?;
        usable(self.unit.to_si(parsed.value)).map_err(|problem| self.fault(problem))
    }

    /// The key as the file spells it.
    pub fn key(&self) -> &str {
        &self.key
    }

    /// A table whose keys are all known.
    ///
    /// # Errors
    /// A [`Fault`] at a value that is no table, or at an unknown or repeated key.
    pub fn section(&self, title: &'static str, keys: &'static [KeyUnit]) -> Result<TomlSection<'t>, Fault> {
        TomlSection::open(self.text, title, self.table()?, keys)
    }

    /// The entries of a table with any keys, in the order of the file; their values have no unit.
    ///
    /// # Errors
    /// A [`Fault`] at a value that is no table.
    pub fn entries(&self) -> Result<Vec<Item<'t>>, Fault> {
        let entry = |(name, value): (&Spanned<DeString<'t>>, &'t Value<'t>)| Item {
            text: self.text,
            key: name.get_ref().as_ref().to_owned(),
            unit: &PLAIN,
            value,
        };
        Ok(in_file_order(self.table()?).into_iter().map(entry).collect())
    }

    fn table(&self) -> Result<&'t DeTable<'t>, Fault> {
        match self.value.get_ref() {
            DeValue::Table(table) => Ok(table),
            _ => Err(self.wrong_type("a table", self.value)),
        }
    }

    /// `true` or `false`.
    ///
    /// # Errors
    /// A [`Fault`] at any other value.
    pub fn boolean(&self) -> Result<bool, Fault> {
        match self.value.get_ref() {
            DeValue::Boolean(value) => Ok(*value),
            _ => Err(self.wrong_type("true or false", self.value)),
        }
    }

    /// A whole number from `least` to 2^53.
    ///
    /// # Errors
    /// A [`Fault`] at any other value.
    pub fn whole(&self, least: u64) -> Result<u64, Fault> {
        let DeValue::Integer(integer) = self.value.get_ref() else {
            return Err(self.wrong_type("a whole number", self.value));
        };
        let digits = integer.as_str().replace('_', "");
        let number = u64::from_str_radix(&digits, integer.radix()).ok();
        number.filter(|n| (least..=1 << 53).contains(n)).ok_or_else(|| {
            let rule = format!("must be a whole number from {least} to 2^53");
            self.breaks(rule, format!("Write for example {}.", least.max(7)))
        })
    }

    /// True for a number without decimal point.
    pub fn is_integer(&self) -> bool {
        self.value.get_ref().is_integer()
    }

    /// True for a table.
    pub fn is_table(&self) -> bool {
        self.value.get_ref().is_table()
    }

    /// True for text in quotation marks.
    pub fn is_string(&self) -> bool {
        self.value.get_ref().is_str()
    }

    /// True for a list, false for a single value.
    pub fn is_list(&self) -> bool {
        self.value.get_ref().is_array()
    }

    /// The members of a list, each with the key and unit of the list.
    ///
    /// # Errors
    /// A [`Fault`] at a value of another kind.
    pub fn list(&self) -> Result<Vec<Item<'t>>, Fault> {
        let DeValue::Array(array) = self.value.get_ref() else {
            return Err(self.wrong_type("a list in square brackets", self.value));
        };
        let member = |value| Item { text: self.text, key: self.key.clone(), unit: self.unit, value };
        Ok(array.iter().map(member).collect())
    }

    /// Exactly `N` members; `expected` says what they are, for example `six joints`.
    ///
    /// # Errors
    /// A [`Fault`] at a value of another kind.
    pub fn exactly<const N: usize>(&self, expected: &'static str) -> Result<[Item<'t>; N], Fault> {
        let count = |found: Vec<Item<'t>>| self.fault(FileProblem::Count { expected, found: found.len() });
        self.list()?.try_into().map_err(count)
    }

    /// Exactly `N` numbers in SI.
    ///
    /// # Errors
    /// A [`Fault`] at a value of another kind.
    pub fn numbers<const N: usize>(&self, expected: &'static str) -> Result<[f64; N], Fault> {
        let mut numbers = [0.0; N];
        for (number, item) in numbers.iter_mut().zip(self.exactly::<N>(expected)?) {
            *number = item.number()?;
        }
        Ok(numbers)
    }

    /// A positive number in SI.
    ///
    /// # Errors
    /// A [`Fault`] at a value of another kind.
    pub fn positive(&self, quantity: &'static str) -> Result<f64, Fault> {
        let number = self.number()?;
        if number > 0.0 { Ok(number) } else { Err(self.fault(FileProblem::NotPositive { quantity })) }
    }
}

/// Line and character of a byte range.
pub(crate) fn place_of(text: &str, span: &Range<usize>) -> FilePlace {
    let before = text.get(..span.start).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = 1 + before.bytes().filter(|byte| *byte == b'\n').count();
    FilePlace {
        line: u64::try_from(line).ok(),
        column: Some(before[line_start..].chars().count() + 1),
        span: Some(span.clone()),
        ..FilePlace::file()
    }
}
