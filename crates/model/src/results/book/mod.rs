//! Many campaigns of one machine over months: control charts of every stiffness, every effect and the error, with alarms.
//!
//! The numbers `x_i` of a chart, with their standard uncertainties `s_i`, follow a level that stays, or one of these changes:
//!
//! | change | level |
//! |---|---|
//! | step | another one from campaign `k` on |
//! | alone | another one in campaign `k` only |
//! | drift | a straight line over the dates, or over the numbers of the campaigns |
//!
//! Each is one more column `c` of a weighted least-squares fit; `T = c / std(c)` is standard normal where nothing changed. A chart
//! alarms where any `|T|` exceeds the limit, or where `sum ((x_i - level) / s_i)^2` is too large for chi-square: then the campaigns
//! scatter more than they state. The limit shares the chance of a false alarm, [`FALSE_ALARM`], among all tests of all charts
//! (Bonferroni): that holds whatever the correlations between charts. The largest `|T|` names the change; what it leaves is tested
//! again, once.
//!
//! Source: recursive and generalized likelihood-ratio charts for few observations with known variance: Hawkins, Qiu and Kang, The
//! changepoint model for statistical process control, Journal of Quality Technology 35 (2003) 355.
//!
//! Limits: campaigns are taken to be independent, their uncertainties as stated. What all campaigns share (the same wrong load cell)
//! cancels.

mod build;
mod change;
mod charts;
mod day;
mod warnings;

pub use build::{BookCampaign, BookRule, CampaignBook, DatedRun, FALSE_ALARM, FEWEST_CAMPAIGNS, book};
pub use change::{ChangeKind, ChartChange};
pub use charts::{ChartPoint, ChartSubject, ControlChart, VisibleChange};
pub use day::CampaignDay;
