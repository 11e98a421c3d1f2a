//! Words in color on a terminal, or left as they are.

use anstyle::{AnsiColor, Style};

use crate::page::Mood;

/// Colors words, or leaves them as they are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct TextStyle {
    on: bool,
}

impl TextStyle {
    /// Colors when `on`.
    pub fn new(on: bool) -> Self {
        Self { on }
    }

    /// Headings and names.
    pub fn strong(self, text: &str) -> String {
        self.styled(Style::new().bold(), text)
    }

    /// Side remarks.
    pub fn faint(self, text: &str) -> String {
        self.styled(Style::new().dimmed(), text)
    }

    /// In the color of a mood, if any.
    pub fn mood(self, mood: Option<Mood>, text: &str) -> String {
        let color = match mood {
            None => return text.to_owned(),
            Some(Mood::Good) => AnsiColor::Green,
            Some(Mood::Doubt) => AnsiColor::Yellow,
            Some(Mood::Bad) => AnsiColor::Red,
        };
        self.styled(color.on_default(), text)
    }

    fn styled(self, style: Style, text: &str) -> String {
        if self.on && !text.is_empty() { format!("{style}{text}{style:#}") } else { text.to_owned() }
    }
}
