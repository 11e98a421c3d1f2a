//! Marks within a text.

use minijinja::HtmlEscape;

use crate::number::with_micro;

/// Escaped text; what stands between backticks as code, `+-` as one sign, units with their µ.
pub(super) fn inline(text: &str) -> String {
    let parts = text.split('`').enumerate().map(|(k, part)| {
        let part = HtmlEscape(part).to_string();
        if k % 2 == 1 { format!("<code>{part}</code>") } else { with_micro(&part).replace("+-", "±") }
    });
    parts.collect()
}
