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

    /// The server has enough to do.
    pub(super) fn busy(error: &str) -> Self {
        Self::new(StatusCode::SERVICE_UNAVAILABLE, error, "Wait for what is running, then ask again.")
    }

    /// Nothing of this name.
    pub(super) fn not_found() -> Self {
        Self::new(StatusCode::NOT_FOUND, "there is nothing at this path", "Begin at /.")
    }

    /// Something there that is asked in another way.
    pub(super) fn wrong_method() -> Self {
        let next = "The header Allow names the methods.";
        Self::new(StatusCode::METHOD_NOT_ALLOWED, "this path knows no such method", next)
    }

    /// A fault of this program.
    pub(super) fn fault() -> Self {
        let next = "The server goes on. Please report what was asked; the terminal it was started in shows where it fell over.";
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, "this question made the program fall over", next)
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
