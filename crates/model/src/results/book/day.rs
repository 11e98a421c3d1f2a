//! The date of a campaign.

use std::fmt;
use std::str::FromStr;

use hexbench_core::calendar::{civil, days};
use serde::{Serialize, Serializer};

/// A date of the Gregorian calendar, as days after 1970-01-01.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct CampaignDay(i64);

impl CampaignDay {
    /// Days from another one to this one.
    pub fn days_after(self, other: Self) -> f64 {
        (self.0 - other.0) as f64
    }
}

impl FromStr for CampaignDay {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const WRONG: &str = "a date is written as 2026-01-31";
        let parts: Vec<&str> = text.trim().split('-').collect();
        let [year, month, day] = parts[..] else { return Err(WRONG) };
        let is_number = |s: &str, digits: usize| s.len() == digits && s.bytes().all(|b| b.is_ascii_digit());
        if !(is_number(year, 4) && is_number(month, 2) && is_number(day, 2)) {
            return Err(WRONG);
        }
        let number = |s: &str| s.parse::<i64>().map_err(|_| WRONG);
        let found = Self(days([number(year)?, number(month)?, number(day)?]));
        // A day that no month has comes back as another one.
        if found.to_string() == text.trim() { Ok(found) } else { Err("no month has this day") }
    }
}

impl fmt::Display for CampaignDay {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [year, month, day] = civil(self.0);
        write!(out, "{year:04}-{month:02}-{day:02}")
    }
}

impl Serialize for CampaignDay {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::CampaignDay;

    #[test]
    fn days_are_counted_across_months_and_leap_years() {
        let day = |text: &str| text.parse::<CampaignDay>().unwrap();
        let since = |a: &str, b: &str| day(b).0 - day(a).0;
        assert_eq!(since("1970-01-01", "2000-02-29"), 11_016);
        assert_eq!(since("2023-12-31", "2024-03-01"), 61);
        assert_eq!(since("2026-03-01", "2026-02-28"), -1);
        assert!((day("2026-02-01").days_after(day("2026-01-01")) - 31.0).abs() < 1e-12);
        for text in ["1970-01-01", "1999-12-31", "2000-02-29", "2026-11-26"] {
            assert_eq!(day(text).to_string(), text);
        }
    }

    #[test]
    fn what_is_no_date_is_refused() {
        for text in
            ["", "2026", "2026-1-1", "26-01-01", "2026-02-30", "2026-13-01", "2026-00-10", "2026-01-0x"]
        {
            assert!(text.parse::<CampaignDay>().is_err(), "{text}");
        }
    }
}
