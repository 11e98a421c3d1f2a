//! Colors, dashes, markers, sizes of text.

/// Red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Colour(u8, u8, u8);

impl std::fmt::Display for Colour {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "#{:02X}{:02X}{:02X}", self.0, self.1, self.2)
    }
}

/// Colors of Okabe and Ito without their yellow, which vanishes on white; the darker ones first.
const COLOURS: [Colour; 7] = [
    Colour(0x00, 0x72, 0xB2),
    Colour(0xD5, 0x5E, 0x00),
    Colour(0x00, 0x9E, 0x73),
    Colour(0xCC, 0x79, 0xA7),
    Colour(0xE6, 0x9F, 0x00),
    Colour(0x56, 0xB4, 0xE9),
    Colour(0x00, 0x00, 0x00),
];

/// Text and axes.
pub(super) const INK: Colour = Colour(0x26, 0x26, 0x26);
/// Second-rank text, reference lines.
pub(super) const GREY: Colour = Colour(0x70, 0x70, 0x70);
/// Grid lines.
pub(super) const GRID: Colour = Colour(0xE3, 0xE3, 0xE3);
/// Background.
pub(super) const PAPER: Colour = Colour(0xFF, 0xFF, 0xFF);
/// Full shade of a heat map.
pub(super) const DEEP: Colour = Colour(0x00, 0x5A, 0x8F);

/// Full shade of the other side of a signed map.
pub(super) const RUST: Colour = Colour(0xB3, 0x4A, 0x00);

/// Width of a drawing for a phone, px: it is shown as it is, not shrunk.
pub(super) const NARROW_PX: f64 = 340.0;

/// Title of a chart, px.
pub(super) const TITLE_PX: f64 = 14.0;
/// Axis titles, legend, px.
pub(super) const LABEL_PX: f64 = 12.0;
/// Tick labels, px.
pub(super) const TICK_PX: f64 = 11.0;

/// Shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Ring,
    Cross,
}

/// On and off lengths of a dashed line, px; none: solid.
pub(super) type Dash = Option<(f64, f64)>;

const MARKERS: [Marker; 6] =
    [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond, Marker::Ring, Marker::Cross];
const DASHES: [Dash; 5] = [None, Some((7.0, 4.0)), Some((2.5, 3.0)), Some((11.0, 4.0)), Some((4.5, 2.5))];

/// How a series looks: the same number gives the same look everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Look {
    pub(super) colour: Colour,
    pub(super) marker: Marker,
    pub(super) dash: Dash,
}

impl Look {
    /// The `index`-th look, from zero.
    pub(super) fn nth(index: usize) -> Self {
        Self {
            colour: COLOURS[index % COLOURS.len()],
            marker: MARKERS[index % MARKERS.len()],
            dash: DASHES[index % DASHES.len()],
        }
    }

    /// Look of a line to compare with: gray, dashed.
    pub(super) fn reference() -> Self {
        Self { colour: GREY, marker: Marker::Ring, dash: Some((4.0, 3.0)) }
    }
}

/// Width of a text in px, from the widths of letters in common sans-serif fonts.
pub(super) fn text_width(text: &str, px: f64) -> f64 {
    text.chars().map(letter_em).sum::<f64>() * px
}

fn letter_em(letter: char) -> f64 {
    match letter {
        'i' | 'j' | 'l' | '\'' | '|' => 0.24,
        ' ' | '.' | ',' | ':' | 'f' | 't' | 'r' | 'I' | '(' | ')' | '-' | '/' => 0.31,
        'm' | 'M' | 'W' | 'w' | '%' | '@' => 0.84,
        'A'..='Z' => 0.69,
        _ => 0.56,
    }
}
