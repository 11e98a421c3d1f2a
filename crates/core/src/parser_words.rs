//! What a parser of JSON or TOML found, in the words of those who write the files: it names types of the program and not what to write.

/// A fault of a JSON file: its place, and what is wrong there.
pub fn of_json(found: &serde_json::Error) -> String {
    let text = found.to_string();
    let what = text.rsplit_once(" at line ").map_or(text.as_str(), |(what, _)| what);
    let said = if found.is_eof() {
        "not valid JSON: the file ends too early".to_owned()
    } else if found.is_syntax() {
        format!("not valid JSON: {what}")
    } else {
        of_value(what)
    };
    match found.line() {
        0 => said,
        line => format!("line {line}, column {}: {said}", found.column()),
    }
}

/// A fault of a TOML file: its place, and what is wrong there.
pub fn of_toml(text: &str, found: &toml::de::Error) -> String {
    let said = of_value(found.message());
    let before = found.span().and_then(|span| text.get(..span.start));
    match before {
        // A key that is missing has no place: the parser names the table in which it should be, the whole file as a rule.
        Some(before) if !found.message().starts_with("missing field") => {
            let line = before.matches('\n').count() + 1;
            let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
            format!("line {line}, column {column}: {said}")
        }
        _ => said,
    }
}

/// What is wrong with a value, by the message of the parser.
pub fn of_value(message: &str) -> String {
    let of = |start: &str| message.strip_prefix(start);
    let key = |rest: &str| rest.split('`').next().unwrap_or_default().to_owned();
    if let Some(rest) = of("missing field `") {
        return format!("the key `{}` is missing", key(rest));
    }
    if let Some(rest) = of("duplicate field `") {
        return format!("the key `{}` is there twice", key(rest));
    }
    if let Some(rest) = of("unknown field `") {
        return format!("unknown key `{}`{}", key(rest), possible(rest));
    }
    if let Some(rest) = of("unknown variant `") {
        return format!("`{}` is not a possible value{}", key(rest), possible(rest));
    }
    if message.starts_with("data did not match any variant") {
        return "the value has none of the possible forms".to_owned();
    }
    let wrong = ["invalid type: ", "invalid value: "].into_iter().find_map(of);
    let wrong = wrong.map(str::to_owned).or_else(|| of("invalid length ").map(|n| format!("{n} of them")));
    match wrong.as_deref().and_then(|rest| rest.split_once(", expected ")) {
        Some((found, wanted)) => {
            let [wanted, extra] = [wanted.strip_suffix(" of them").unwrap_or(wanted), found];
            format!("expected {}, found {}", type_of(wanted), found_value(extra))
        }
        None => message.to_owned(),
    }
}

/// What may be there instead.
fn possible(rest: &str) -> String {
    let listed = rest.split_once(", expected ").map_or("", |(_, listed)| listed);
    let listed = listed.strip_prefix("one of ").unwrap_or(listed);
    if listed.is_empty() { String::new() } else { format!("; possible: {listed}") }
}

/// A value that was found.
fn found_value(found: &str) -> String {
    for kind in ["floating point ", "integer ", "boolean ", "string ", "character "] {
        if let Some(value) = found.strip_prefix(kind) {
            return value.trim_matches('`').to_owned();
        }
    }
    match found {
        "sequence" => "a list".to_owned(),
        "map" => "an object".to_owned(),
        "unit" | "null" | "Option value" => "nothing".to_owned(),
        other => other.to_owned(),
    }
}

/// What should be there.
fn type_of(wanted: &str) -> String {
    let list = ["an array of length ", "a tuple of size ", "an array with "]
        .iter()
        .find_map(|s| wanted.strip_prefix(s));
    if let Some(length) = list {
        return format!("a list of {length}");
    }
    match wanted {
        "f64" | "f32" => "a number",
        "i8" | "i16" | "i32" | "i64" | "i128" | "isize" => "a whole number",
        "u8" | "u16" | "u32" | "u64" | "u128" | "usize" => "a whole number that is not negative",
        "a string" | "string" | "a borrowed string" | "str" => "text in quotation marks",
        "a boolean" | "bool" => "true or false",
        "a sequence" => "a list",
        "a map" => "an object",
        "variant identifier" | "field identifier" => "a known word",
        other if other.starts_with("struct ") || other.starts_with("map") => "an object",
        other => other,
    }
    .to_owned()
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Inner {
        #[expect(dead_code, reason = "read to see what the parser says")]
        size: f64,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields, rename_all = "lowercase")]
    enum Way {
        Up,
        Down,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "read to see what the parser says")]
    struct Outer {
        name: String,
        count: u64,
        three: [f64; 3],
        inner: Inner,
        way: Option<Way>,
    }

    fn said(text: &str) -> String {
        of_json(&serde_json::from_str::<Outer>(text).unwrap_err())
    }

    #[test]
    fn a_fault_of_a_file_is_told_in_the_words_of_who_writes_it() {
        let file = |name: &str, count: &str, three: &str, inner: &str, more: &str| {
            format!("{{\"name\": {name}, \"count\": {count},\n\"three\": {three}, \"inner\": {inner}{more}}}")
        };
        let good = ["\"a\"", "1", "[1, 2, 3]", "{\"size\": 1}", ""];
        let with = |place: usize, text: &str| {
            let mut parts = good;
            parts[place] = text;
            let [name, count, three, inner, more] = parts;
            said(&file(name, count, three, inner, more))
        };
        for (place, text, expected) in [
            (0, "3", "line 1, column 10: expected text in quotation marks, found 3"),
            (1, "-1", "expected a whole number that is not negative, found -1"),
            (1, "1.5", "expected a whole number that is not negative, found 1.5"),
            (2, "[1, 2]", "expected a list of 3, found 2"),
            (2, "{}", "expected a list of 3, found an object"),
            (3, "{}", "the key `size` is missing"),
            (3, "{\"size\": null}", "expected a number, found nothing"),
            (3, "{\"size\": \"x\"}", "expected a number, found \"x\""),
            (3, "{\"seize\": 1}", "unknown key `seize`; possible: `size`"),
            (3, "{\"size\": 1, \"size\": 2}", "the key `size` is there twice"),
            (4, ", \"way\": \"left\"", "`left` is not a possible value; possible: `up` or `down`"),
            (4, ",", "not valid JSON: trailing comma"),
        ] {
            let said = with(place, text);
            assert!(said.ends_with(expected) && said.starts_with("line "), "{text}: {said}");
        }
        let toml = "name = \"a\"\ncount = 1\nthree = [1, \"x\", 3]\ninner.size = 1";
        let found = of_toml(toml, &toml::from_str::<Outer>(toml).unwrap_err());
        assert_eq!(found, "line 3, column 13: expected a number, found \"x\"");
        let found = of_toml("", &toml::from_str::<Outer>("").unwrap_err());
        assert_eq!(found, "the key `name` is missing");
        assert_eq!(said("{\"name\""), "line 1, column 7: not valid JSON: the file ends too early");
    }
}
