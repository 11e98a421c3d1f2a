//! The page: files embedded in the program.

use axum::http::header::{ALLOW, CACHE_CONTROL, CONTENT_TYPE, ETAG, IF_NONE_MATCH};
use axum::http::{HeaderMap, Method, StatusCode, Uri};
use axum::response::{IntoResponse, Response};
use rust_embed::{EmbeddedFile, RustEmbed};

use super::refuse::Refuse;
use super::token::hexadecimal;

/// The folder as it was when the program was built.
#[derive(RustEmbed)]
#[folder = "assets"]
struct Assets;

/// The file of exactly this path; `/` is the page. No path is decoded, none reaches a file system.
pub(super) async fn get(method: Method, uri: Uri, headers: HeaderMap) -> Result<Response, Refuse> {
    let name = match uri.path() {
        "/" => "index.html",
        path => path.strip_prefix('/').unwrap_or(path),
    };
    let file = Assets::get(name).ok_or_else(Refuse::not_found)?;
    if !matches!(method, Method::GET | Method::HEAD) {
        return Ok(([(ALLOW, "GET, HEAD")], Refuse::wrong_method()).into_response());
    }
    let tag = format!("\"{}\"", hexadecimal(&file.metadata.sha256_hash()));
    Ok(if is_known(&headers, &tag) {
        (StatusCode::NOT_MODIFIED, cached(tag)).into_response()
    } else {
        sent(name, file, tag)
    })
}

fn sent(name: &str, file: EmbeddedFile, tag: String) -> Response {
    (cached(tag), [(CONTENT_TYPE, media(name))], file.data).into_response()
}

/// Kept by the browser, asked about before each use.
fn cached(tag: String) -> [(axum::http::HeaderName, String); 2] {
    [(CACHE_CONTROL, "no-cache".to_owned()), (ETAG, tag)]
}

/// Does the browser have this very file?
fn is_known(headers: &HeaderMap, tag: &str) -> bool {
    let known = headers.get_all(IF_NONE_MATCH).iter().filter_map(|value| value.to_str().ok());
    known.flat_map(|list| list.split(',')).any(|one| one.trim().trim_start_matches("W/") == tag)
}

fn media(name: &str) -> &'static str {
    match name.rsplit_once('.').map(|(_, kind)| kind) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("txt") => "text/plain; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_there_and_the_kind_of_every_file_is_known() {
        assert!(Assets::get("index.html").is_some());
        for name in Assets::iter() {
            assert_ne!(media(&name), "application/octet-stream", "{name}");
        }
    }
}
