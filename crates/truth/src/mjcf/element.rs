//! A small tree of XML elements.

use std::fmt::Write;

use quick_xml::{
    Writer,
    events::{BytesEnd, BytesStart, Event},
};

use crate::TruthError;

/// An element with its attributes and children.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
}

impl Element {
    pub(super) fn new(name: &'static str) -> Self {
        Self { name, attributes: Vec::new(), children: Vec::new() }
    }

    /// With a text as attribute.
    pub(super) fn text(mut self, key: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((key, value.into()));
        self
    }

    /// With numbers as attribute, each with all its digits.
    pub(super) fn numbers(self, key: &'static str, values: &[f64]) -> Self {
        let text = values.iter().fold(String::new(), |mut text, value| {
            let gap = if text.is_empty() { "" } else { " " };
            // Adding zero turns -0 into 0.
            let _ = write!(text, "{gap}{}", value + 0.0);
            text
        });
        self.text(key, text)
    }

    /// With a number as attribute.
    pub(super) fn number(self, key: &'static str, value: f64) -> Self {
        self.numbers(key, &[value])
    }

    /// With a child.
    pub(super) fn child(mut self, child: Self) -> Self {
        self.children.push(child);
        self
    }

    /// With several children.
    pub(super) fn children(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children.extend(children);
        self
    }

    /// The element as an indented document.
    ///
    /// # Errors
    /// [`TruthError::File`].
    pub(super) fn document(&self) -> Result<String, TruthError> {
        let failed = |why: String| TruthError::File { path: super::FORMAT.to_owned(), why };
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        self.write(&mut writer).map_err(|e| failed(e.to_string()))?;
        let text = String::from_utf8(writer.into_inner()).map_err(|e| failed(e.to_string()))?;
        Ok(text + "\n")
    }

    fn write(&self, writer: &mut Writer<Vec<u8>>) -> std::io::Result<()> {
        let mut start = BytesStart::new(self.name);
        for (key, value) in &self.attributes {
            start.push_attribute((*key, value.as_str()));
        }
        if self.children.is_empty() {
            return writer.write_event(Event::Empty(start));
        }
        writer.write_event(Event::Start(start))?;
        for child in &self.children {
            child.write(writer)?;
        }
        writer.write_event(Event::End(BytesEnd::new(self.name)))
    }
}
