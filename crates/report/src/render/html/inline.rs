//! Marks within a text.

use minijinja::HtmlEscape;

use crate::number::with_micro;

/// The heading of a multiple.
const MULTIPLE: &str = "x noise";

/// The title of a column, for an attribute, which the template escapes.
pub(super) fn title(text: &str) -> String {
    if text == MULTIPLE { MULTIPLE.replacen('x', "×", 1) } else { with_micro(text) }
}

/// Escaped text; what stands between backticks as code, `+-` as one sign, units with their µ, `x noise` with a sign.
pub(super) fn inline(text: &str) -> String {
    if text == MULTIPLE {
        return title(text);
    }
    let parts = text.split('`').enumerate().map(|(k, part)| {
        let part = HtmlEscape(part).to_string();
        if k % 2 == 1 { format!("<code>{part}</code>") } else { with_micro(&part).replace("+-", "±") }
    });
    parts.collect()
}
