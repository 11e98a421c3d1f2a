//! Colours, dashes, markers, sizes of text.

use plotters::style::RGBColor;

/// Colours of Okabe and Ito without their yellow, which vanishes on white; the darker ones first.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xB2),
    RGBColor(0xD5, 0x5E, 0x00),
    RGBColor(0x00, 0x9E, 0x73),
    RGBColor(0xCC, 0x79, 0xA7),
    RGBColor(0xE6, 0x9F, 0x00),
    RGBColor(0x56, 0xB4, 0xE9),
    RGBColor(0x00, 0x00, 0x00),
];

/// Text and axes.
pub(super) const INK: RGBColor = RGBColor(0x26, 0x26, 0x26);
/// Second-rank text, reference lines.
pub(super) const GREY: RGBColor = RGBColor(0x70, 0x70, 0x70);
/// Grid lines.
pub(super) const GRID: RGBColor = RGBColor(0xE3, 0xE3, 0xE3);
/// Background.
pub(super) const PAPER: RGBColor = RGBColor(0xFF, 0xFF, 0xFF);
/// Dark end of the shades of a heat map.
pub(super) const DEEP: RGBColor = RGBColor(0x00, 0x5A, 0x8F);

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
    pub(super) colour: RGBColor,
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

    /// Look of a line to compare with: grey, dashed.
    pub(super) fn reference() -> Self {
        Self { colour: GREY, marker: Marker::Ring, dash: Some((4.0, 3.0)) }
    }
}

/// A colour between white (0) and the dark end (1).
pub(super) fn shade(share: f64) -> RGBColor {
    let mix = |from: u8, to: u8| {
        let value = f64::from(from) + share.clamp(0.0, 1.0) * (f64::from(to) - f64::from(from));
        // Between two bytes, hence itself one.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let byte = value.round() as u8;
        byte
    };
    RGBColor(mix(PAPER.0, DEEP.0), mix(PAPER.1, DEEP.1), mix(PAPER.2, DEEP.2))
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
