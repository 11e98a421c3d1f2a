//! Who may send requests: a page of this server, with its token.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header::{AUTHORIZATION, HOST, HeaderName, ORIGIN};
use axum::http::{HeaderMap, StatusCode};
use axum::middleware::Next;
use axum::response::Response;

use super::refuse::Refuse;
use super::token::{Token, same};

/// Under this begins what needs the token.
const API: &str = "/api";

/// Names under which a browser on this machine reaches the server.
#[derive(Debug, Clone)]
pub(super) struct Names {
    hosts: [String; 3],
}

impl Names {
    /// Of a server on this port of the loopback address. Browsers leave port 80 out.
    pub(super) fn of(port: u16) -> Self {
        let tail = if port == 80 { String::new() } else { format!(":{port}") };
        Self { hosts: ["127.0.0.1", "localhost", "[::1]"].map(|name| format!("{name}{tail}")) }
    }

    fn is_host(&self, text: &str) -> bool {
        self.hosts.iter().any(|host| host.eq_ignore_ascii_case(text))
    }

    fn is_origin(&self, text: &str) -> bool {
        text.strip_prefix("http://").is_some_and(|host| self.is_host(host))
    }
}

/// Refuses names of other hosts, which a foreign page may have pointed at this machine, and requests of foreign pages.
pub(super) async fn own_names(
    State(names): State<Arc<Names>>,
    request: Request,
    next: Next,
) -> Result<Response, Refuse> {
    let host = only(request.headers(), &HOST).is_some_and(|host| names.is_host(host));
    let target = request.uri().authority().is_none_or(|authority| names.is_host(authority.as_str()));
    if !(host && target) {
        let error = "the request is for another host";
        return Err(Refuse::new(
            StatusCode::FORBIDDEN,
            error,
            "Open the address that was printed at the start.",
        ));
    }
    let foreign = request.headers().contains_key(ORIGIN)
        && !only(request.headers(), &ORIGIN).is_some_and(|origin| names.is_origin(origin));
    if foreign {
        let error = "the request comes from a page of another origin";
        return Err(Refuse::new(
            StatusCode::FORBIDDEN,
            error,
            "Open the address that was printed at the start.",
        ));
    }
    Ok(next.run(request).await)
}

/// Refuses everything under `/api` without the token.
pub(super) async fn with_token(
    State(token): State<Arc<Token>>,
    request: Request,
    next: Next,
) -> Result<Response, Refuse> {
    let under_api =
        request.uri().path().strip_prefix(API).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'));
    if under_api && !bears(request.headers(), &token) {
        let error = "the token is missing or does not belong to this server";
        let next = "Open the address that `hexbench workbench` printed, including everything after #token=.";
        return Err(Refuse::new(StatusCode::UNAUTHORIZED, error, next));
    }
    Ok(next.run(request).await)
}

fn bears(headers: &HeaderMap, token: &Token) -> bool {
    let Some((scheme, given)) = only(headers, &AUTHORIZATION).and_then(|text| text.split_once(' ')) else {
        return false;
    };
    scheme.eq_ignore_ascii_case("bearer") && same(given.as_bytes(), token.text().as_bytes())
}

/// The value of a header that is there once.
fn only<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    let mut values = headers.get_all(name).iter();
    values.next().filter(|_| values.next().is_none())?.to_str().ok()
}
