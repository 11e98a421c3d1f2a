//! Charts as PNG, drawn from their SVG.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// Pixels of the picture per pixel of the chart.
const SCALE: f32 = 2.0;

/// The chart as PNG, at twice its size. Letters are those of the system's sans-serif font; none where it has no font, so that
/// no chart goes without its numbers.
pub fn png(svg: &str) -> Option<Vec<u8>> {
    let mut options = Options::default();
    options.fontdb_mut().load_system_fonts();
    let family = sans_serif(&options)?;
    options.fontdb_mut().set_sans_serif_family(family);
    let tree = Tree::from_str(svg, &options).ok()?;
    let size = tree.size().to_int_size().scale_by(SCALE)?;
    let mut picture = Pixmap::new(size.width(), size.height())?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut picture.as_mut());
    picture.encode_png().ok()
}

/// A usual one, else any.
fn sans_serif(options: &Options<'_>) -> Option<String> {
    const USUAL: [&str; 5] = ["Helvetica", "Arial", "Liberation Sans", "DejaVu Sans", "Noto Sans"];
    let known: Vec<&str> = options
        .fontdb
        .faces()
        .filter_map(|face| face.families.first())
        .map(|(name, _)| name.as_str())
        .collect();
    let usual = USUAL.into_iter().find(|name| known.contains(name));
    usual.or(known.first().copied()).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::png;
    use crate::plot::{Axis, Chart, Series};

    #[test]
    fn a_chart_becomes_a_png_of_twice_its_size() {
        let line = Series::line("line", vec![[0.0, 0.0], [1.0, 1.0]]);
        let svg = Chart::new("Title", Axis::new("x", ""), Axis::new("y", "")).with(line).to_svg();
        // A system without fonts has no picture to test.
        let Some(bytes) = png(&svg.unwrap_or_default()) else { return };
        assert!(bytes.starts_with(b"\x89PNG"));
        let number = |at: usize| u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        assert_eq!([number(16), number(20)], [1440, 800]);
    }
}
