//! Numbers with the digits that mean something.

use std::fmt::Display;

/// A value and its standard uncertainty, both to the second significant digit of the uncertainty (GUM 7.2.6).
pub fn with_uncertainty(value: f64, std: f64) -> [String; 2] {
    if !(std.is_finite() && std > 0.0) {
        return [significant(value, 4), significant(std, 2)];
    }
    [rounded(value, std), rounded(std, std)]
}

/// A value to the second significant digit of `std`.
pub fn rounded(value: f64, std: f64) -> String {
    let decimals = 1 - exponent(std);
    fixed(value, decimals)
}

/// A value to a number of significant digits, without an exponent.
pub fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    fixed(value, digits - 1 - exponent(value))
}

/// A stated number, without what a change of unit adds beyond so many decimals; zero without a sign.
pub fn stated(value: f64, decimals: i32) -> String {
    let scale = 10f64.powi(decimals);
    ((value * scale).round() / scale + 0.0).to_string()
}

/// So many of something: `1 pose`, `2 poses`.
pub fn counted<N: Display + PartialEq + Copy + From<u8>>(count: N, what: &str) -> String {
    let s = if count == N::from(1) { "" } else { "s" };
    format!("{count} {what}{s}")
}

/// Probability in words that never claim certainty.
pub fn percent(p: f64) -> String {
    match p {
        p if p > 0.995 => "> 99 %".into(),
        p if p < 0.005 => "< 1 %".into(),
        p => format!("{:.0} %", 100.0 * p),
    }
}

/// The chance of a result that is small where something is found, in percent.
pub fn chance(p: f64) -> String {
    match p {
        p if p < 0.001 => "< 0.1 %".into(),
        p if p > 0.99 => "> 99 %".into(),
        p if p < 0.1 => format!("{} %", significant(100.0 * p, 1)),
        p => format!("{:.0} %", 100.0 * p),
    }
}

/// Odds by their decimal logarithm: `15 : 1`. Beyond 10 000 a number says no more.
pub fn odds(log10: f64) -> String {
    const OVERWHELMING: f64 = 4.0;
    let times = |power: f64| significant(10f64.powf(power), 2);
    match log10 {
        x if x > OVERWHELMING => "> 10 000 : 1".into(),
        x if x < -OVERWHELMING => "< 1 : 10 000".into(),
        x if x < 0.0 => format!("1 : {}", times(-x)),
        x => format!("{} : 1", times(x)),
    }
}

/// A share in percent with one decimal, without its sign; a dash for none.
pub fn hundredths(share: f64) -> String {
    if share.is_finite() { format!("{:.1}", 100.0 * share) } else { "-".to_owned() }
}

/// The units um and urad, where they stand as words, with their micro sign: for people who read. Files and terminals keep the letters.
pub(crate) fn with_micro(text: &str) -> String {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_';
    let piece = |piece: &str| match piece.trim_end_matches(|c| !is_of_word(c)) {
        "um" | "urad" => piece.replacen('u', "µ", 1),
        _ => piece.to_owned(),
    };
    text.split_inclusive(|c| !is_of_word(c)).map(piece).collect()
}

/// A multiple of the noise with the digits that matter.
pub fn multiple(times: f64) -> String {
    if times < 10.0 { format!("{times:.2}") } else { format!("{times:.0}") }
}

/// Power of ten of the first digit, after rounding to two digits (9.96 counts as 10).
fn exponent(value: f64) -> i32 {
    let text = format!("{:.1e}", value.abs());
    text.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0)
}

/// Fixed decimals; negative ones round to tens, hundreds, ... Minus zero is zero.
pub fn fixed(value: f64, decimals: i32) -> String {
    let text = if decimals >= 0 {
        format!("{value:.0$}", decimals.unsigned_abs() as usize)
    } else {
        let step = 10f64.powi(-decimals);
        format!("{:.0}", (value / step).round() * step)
    };
    let zero = text.starts_with('-') && text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if zero { text[1..].to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uncertainty_has_two_digits_and_the_value_ends_with_it() {
        assert_eq!(with_uncertainty(3.724_369, 0.021_4), ["3.724", "0.021"]);
        assert_eq!(with_uncertainty(-0.004, 0.99), ["0.00", "0.99"]);
        assert_eq!(with_uncertainty(1234.5, 123.0), ["1230", "120"]);
        assert_eq!(with_uncertainty(5.0, 0.0999), ["5.00", "0.10"]);
    }

    #[test]
    fn no_probability_is_called_certain() {
        assert_eq!(percent(1.0), "> 99 %");
        assert_eq!(percent(0.0), "< 1 %");
        assert_eq!(percent(0.42), "42 %");
    }

    #[test]
    fn odds_and_chances_end_where_numbers_say_no_more() {
        assert_eq!([-0.7, 1.2, 4.1, 66.0].map(odds), ["1 : 5.0", "16 : 1", "> 10 000 : 1", "> 10 000 : 1"]);
        assert_eq!([2e-9, 0.004, 0.31, 0.999].map(chance), ["< 0.1 %", "0.4 %", "31 %", "> 99 %"]);
    }

    #[test]
    fn units_get_their_micro_sign_and_names_of_columns_stay() {
        assert_eq!(with_micro("1.5 um (3 urad), N/um"), "1.5 µm (3 µrad), N/µm");
        assert_eq!(with_micro("da_um, um_per, drum, umbra, mum"), "da_um, um_per, drum, umbra, mum");
    }

    #[test]
    fn significant_digits_need_no_exponent() {
        assert_eq!(significant(0.001_234, 2), "0.0012");
        assert_eq!(significant(98_765.0, 2), "99000");
        assert_eq!(significant(0.0, 2), "0");
    }
}
