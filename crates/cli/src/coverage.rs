//! `--coverage`: how wide every plus-minus is.

use clap::Args;
use hexbench_report::words::{PlusMinus, Wide};

/// How wide every plus-minus is.
#[derive(Debug, Clone, Copy, Default, Args)]
pub(crate) struct Coverage {
    /// Show uncertainties as intervals with this coverage probability, %, instead of standard uncertainties; JSON always has
    /// standard uncertainties
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    coverage: Option<f64>,
}

impl Coverage {
    /// What was asked for.
    pub(crate) fn plus_minus(self) -> PlusMinus {
        self.coverage.map_or(PlusMinus::Standard, PlusMinus::Percent)
    }

    /// The same where the noise is known from so many degrees of freedom.
    pub(crate) fn of(self, dof: f64) -> Wide {
        self.plus_minus().of(dof)
    }

    /// What the name of a column of uncertainties begins with: standard ones are `sigma_`.
    pub(crate) fn beginning(self) -> String {
        self.coverage.map_or_else(|| "sigma_".to_owned(), |percent| format!("u{percent}_"))
    }
}

fn percent(text: &str) -> Result<f64, String> {
    let fits = |p: &f64| (1.0..=99.99).contains(p);
    text.parse().ok().filter(fits).ok_or_else(|| "this must be 1 to 99.99, for example 95".into())
}
