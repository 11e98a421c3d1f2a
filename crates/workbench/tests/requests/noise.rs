//! Bytes that mean nothing.

use std::io::Write;
use std::net::Shutdown;
use std::sync::LazyLock;

use proptest::prelude::*;

use crate::site::{Site, answer, get, post};

static SITE: LazyLock<Site> = LazyLock::new(Site::start);

/// What comes back to bytes from a client that says nothing more after them.
fn answer_to(bytes: &[u8]) -> String {
    let mut stream = SITE.connect();
    // A server that has said no may stop listening.
    let _ = stream.write_all(bytes);
    let _ = stream.shutdown(Shutdown::Write);
    answer(&mut stream).answer
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn bytes_without_meaning_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let answer = answer_to(&bytes);
        prop_assert!(["closed", "400"].contains(&answer.as_str()), "{answer}");
        prop_assert_eq!(SITE.send(&get("/api/catalogue")).answer, "200");
    }

    #[test]
    fn damaged_requests_never_stop_the_server(place in any::<prop::sample::Index>(), byte in any::<u8>()) {
        let mut bytes = SITE.bytes(&post("/api/benches", r#"{"from":"given"}"#));
        let place = place.index(bytes.len());
        bytes[place] = byte;
        let answer = answer_to(&bytes);
        let known = ["closed", "200", "201", "400", "401", "403", "404", "405", "408", "413", "415"];
        prop_assert!(known.contains(&answer.as_str()), "{answer} to {:?}", String::from_utf8_lossy(&bytes));
        prop_assert_eq!(SITE.send(&get("/api/catalogue")).answer, "200");
    }
}
