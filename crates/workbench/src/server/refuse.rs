//! Refusals as answers of the server.

use axum::http::header::{CONNECTION, RETRY_AFTER, WWW_AUTHENTICATE};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};

use crate::bench::{Refusal, RefusalKind};
use crate::wire::Refused;

use super::body;

/// After how many seconds a busy server is worth asking again.
const RETRY_AFTER_S: &str = "2";

/// Why a request gets no answer.
#[derive(Debug)]
pub(super) struct Refuse {
    status: StatusCode,
    body: Refused,
}

impl Refuse {
    /// With this status.
    pub(super) fn new(status: StatusCode, error: impl Into<String>, next: impl Into<String>) -> Self {
        Self { status, body: Refused { error: error.into(), next: next.into() } }
    }

    /// The server is busy.
    pub(super) fn busy(error: &str) -> Self {
        Self::new(
            StatusCode::SERVICE_UNAVAILABLE,
            error,
            "Wait until running computations finish, then try again.",
        )
    }

    /// Nothing of this name.
    pub(super) fn not_found() -> Self {
        Self::new(StatusCode::NOT_FOUND, "there is nothing at this path", "Open the page at /.")
    }

    /// A path that takes other methods.
    pub(super) fn wrong_method() -> Self {
        let next = "The header Allow lists the allowed methods.";
        Self::new(StatusCode::METHOD_NOT_ALLOWED, "this path does not support the method", next)
    }

    /// A fault of this program.
    pub(super) fn fault() -> Self {
        let next = "The server keeps running. Please report the request; the terminal in which it was started shows where it failed.";
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, "this request caused an internal error", next)
    }
}

impl From<Refusal> for Refuse {
    fn from(refusal: Refusal) -> Self {
        let status = match refusal.kind {
            RefusalKind::BadInput => StatusCode::UNPROCESSABLE_ENTITY,
            RefusalKind::Unknown => StatusCode::NOT_FOUND,
            RefusalKind::TooLarge => StatusCode::PAYLOAD_TOO_LARGE,
            RefusalKind::Conflict => StatusCode::CONFLICT,
        };
        Self::new(status, refusal.message, refusal.next)
    }
}

impl IntoResponse for Refuse {
    fn into_response(self) -> Response {
        let mut headers = HeaderMap::new();
        match self.status {
            StatusCode::UNAUTHORIZED => {
                headers.insert(WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"));
            }
            StatusCode::SERVICE_UNAVAILABLE => {
                headers.insert(RETRY_AFTER, HeaderValue::from_static(RETRY_AFTER_S));
            }
            StatusCode::REQUEST_TIMEOUT => {
                headers.insert(CONNECTION, HeaderValue::from_static("close"));
            }
            _ => {}
        }
        match body::json(&self.body) {
            Ok(text) => (self.status, headers, body::answer(text)).into_response(),
            Err(_) => self.status.into_response(),
        }
    }
}
