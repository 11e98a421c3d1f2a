//! Marks within a text.

use minijinja::HtmlEscape;

/// Escaped text; what stands between backticks as code, `+-` as one sign.
pub(super) fn inline(text: &str) -> String {
    let parts = text.split('`').enumerate().map(|(k, part)| {
        let part = HtmlEscape(part).to_string();
        if k % 2 == 1 { format!("<code>{part}</code>") } else { part.replace("+-", "±") }
    });
    parts.collect()
}
