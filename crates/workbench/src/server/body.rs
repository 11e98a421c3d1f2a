//! Bodies: JSON in, JSON out.

use std::time::Duration;

use axum::body::{Body, Bytes, HttpBody};
use axum::extract::{FromRequest, Request};
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use hexbench_core::parser_words::of_json;
use serde::Serialize;
use serde::de::DeserializeOwned;
use tokio::time::timeout;

use super::refuse::Refuse;

/// The media type of every body.
const JSON: &str = "application/json";

/// A value as JSON.
pub(super) fn json(value: &impl Serialize) -> Result<Vec<u8>, Refuse> {
    serde_json::to_vec(value).map_err(|_| Refuse::fault())
}

/// JSON as an answer.
pub(super) fn answer(text: impl Into<Body>) -> Response {
    ([(CONTENT_TYPE, JSON)], text.into()).into_response()
}

/// A value from JSON.
pub(super) fn parse<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, Refuse> {
    serde_json::from_slice(bytes).map_err(|error| {
        let next = "Reload the page: its version and that of the server differ.";
        Refuse::new(
            StatusCode::BAD_REQUEST,
            format!("the request does not have the expected form: {}", of_json(&error)),
            next,
        )
    })
}

/// Refuses what is not sent as JSON, and what says itself that it is too long.
pub(super) fn check(request: &Request, most: usize) -> Result<(), Refuse> {
    if !is_json(request.headers()) {
        let error = format!("the content type must be {JSON}");
        return Err(Refuse::new(
            StatusCode::UNSUPPORTED_MEDIA_TYPE,
            error,
            "Send JSON with this content type.",
        ));
    }
    if request.body().size_hint().lower() > most as u64 { Err(too_large(most)) } else { Ok(()) }
}

/// All of a body.
pub(super) async fn read(request: Request, most: usize, limit: Duration) -> Result<Bytes, Refuse> {
    match timeout(limit, Bytes::from_request(request, &())).await {
        Ok(Ok(bytes)) => Ok(bytes),
        Ok(Err(error)) if error.status() == StatusCode::PAYLOAD_TOO_LARGE => Err(too_large(most)),
        Ok(Err(_)) => {
            Err(Refuse::new(StatusCode::BAD_REQUEST, "the request is incomplete", "Send it again."))
        }
        Err(_) => {
            let error = format!("the request did not arrive within {} s", limit.as_secs_f64());
            Err(Refuse::new(StatusCode::REQUEST_TIMEOUT, error, "Send it again."))
        }
    }
}

fn too_large(most: usize) -> Refuse {
    let error = format!("the request is larger than {most} bytes");
    Refuse::new(StatusCode::PAYLOAD_TOO_LARGE, error, "Use the command line for files of this size.")
}

/// Parameters such as a charset are allowed.
fn is_json(headers: &HeaderMap) -> bool {
    let Some(kind) = headers.get(CONTENT_TYPE).and_then(|value| value.to_str().ok()) else { return false };
    let kind = kind.split(';').next().unwrap_or_default();
    kind.trim().eq_ignore_ascii_case(JSON)
}
