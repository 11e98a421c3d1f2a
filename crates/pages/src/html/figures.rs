//! Charts that several sections share.

use hexbench_report::plot::{Axis, Chart, Series};

/// Look of what was measured, of the springs alone, and of the final model: the same on the whole page.
pub(crate) const MEASURED: usize = 6;
pub(crate) const SPRINGS: usize = 1;
pub(crate) const FINAL: usize = 0;

/// Residual elongations over something, with what the added effects explain of them.
pub(crate) struct Cloud {
    pub(crate) left: Vec<[f64; 2]>,
    pub(crate) explained: Vec<[f64; 2]>,
}

impl Cloud {
    /// Collects `(x, residual, explained)`.
    pub(crate) fn of(points: impl Iterator<Item = (f64, f64, Option<f64>)>) -> Self {
        let (mut left, mut explained) = (Vec::new(), Vec::new());
        for (x, y, fit) in points {
            left.push([x, y]);
            explained.extend(fit.map(|f| [x, f]));
        }
        Self { left, explained }
    }

    /// The chart.
    pub(crate) fn chart(self, title: impl Into<String>, x: Axis, y: Axis) -> Chart {
        let chart = Chart::new(title, x, y)
            .with(Series::markers("springs alone leave", self.left).with_look(SPRINGS));
        if self.explained.is_empty() {
            return chart;
        }
        chart.with(Series::markers("the added effects explain", self.explained).with_look(FINAL))
    }
}
