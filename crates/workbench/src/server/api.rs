//! Paths and their answers.

use std::io;
use std::sync::Arc;

use axum::Router;
use axum::body::Bytes;
use axum::extract::rejection::PathRejection;
use axum::extract::{DefaultBodyLimit, Path, Request, State};
use axum::http::StatusCode;
use axum::middleware::{from_fn_with_state, map_response};
use axum::response::{IntoResponse, Response};
use axum::routing::{MethodRouter, get, post};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::guard::{self, Names};
use super::refuse::Refuse;
use super::store::Store;
use super::token::Token;
use super::work::{Place, Work};
use super::{Desk, ServerSettings, assets, body, headers};
use crate::bench::{Given, Refusal};
use crate::wire::Open;

/// What all requests share.
pub(super) struct Shared<D> {
    settings: ServerSettings,
    given: Option<Given>,
    catalogue: Bytes,
    store: Store<D>,
    work: Work,
}

impl<D: Desk> Shared<D> {
    /// The catalogue is made once.
    pub(super) fn new(settings: &ServerSettings, given: Option<Given>) -> io::Result<Self> {
        let limits = settings.limits;
        let catalogue = serde_json::to_vec(&D::catalogue(limits, given.as_ref()))?.into();
        let store = Store::new(Token::random()?, limits.benches, settings.kept_bytes);
        Ok(Self { settings: *settings, given, catalogue, store, work: Work::of(settings) })
    }
}

type Of<D> = State<Arc<Shared<D>>>;
type Id = Result<Path<String>, PathRejection>;

/// Everything the server answers, behind its guards.
pub(super) fn app<D: Desk>(shared: Arc<Shared<D>>, names: Names, token: Token) -> Router {
    let most = shared.settings.limits.bytes;
    Router::new()
        .route("/api/catalogue", get(catalogue::<D>))
        .route("/api/benches", post(open::<D>))
        .nest("/api/benches/{id}", questions::<D>())
        .fallback(assets::get)
        .method_not_allowed_fallback(async || Refuse::wrong_method())
        .layer(DefaultBodyLimit::max(most))
        .layer(from_fn_with_state(Arc::new(token), guard::with_token))
        .layer(from_fn_with_state(Arc::new(names), guard::own_names))
        .layer(map_response(headers::add))
        .with_state(shared)
}

/// What a bench is asked.
fn questions<D: Desk>() -> Router<Arc<Shared<D>>> {
    Router::new()
        .route("/view", question(D::view))
        .route("/trials", question(D::try_each))
        .route("/followed", question(D::followed))
        .route("/picture", question(D::picture))
        .route("/check", question(D::check))
        .route("/diagnosis", question(D::diagnose))
        .route("/plan", question(D::plan))
        .route("/discovery", question(D::discover))
        .route("/export", question(D::export))
        .route("/session", question(D::keep))
        .route("/resume", question(D::resume))
        .route("/reveal", question(D::reveal))
}

/// A question with its answer.
fn question<D: Desk, Q, A>(
    answer: impl Fn(&D, &Q) -> Result<A, Refusal> + Copy + Send + Sync + 'static,
) -> MethodRouter<Arc<Shared<D>>>
where
    Q: DeserializeOwned + 'static,
    A: Serialize + 'static,
{
    post(move |shared: Of<D>, id: Id, request: Request| ask(shared, id, request, answer))
}

async fn catalogue<D: Desk>(State(shared): Of<D>) -> Response {
    body::answer(shared.catalogue.clone())
}

/// Makes a bench, and keeps it when its client is still there.
async fn open<D: Desk>(State(shared): Of<D>, request: Request) -> Result<Response, Refuse> {
    let (place, bytes) = received(&shared, request).await?;
    let name = shared.store.name();
    let id = name.id.clone();
    let job = {
        let shared = Arc::clone(&shared);
        move || {
            let request: Open = body::parse(&bytes)?;
            drop(bytes);
            let bench = D::open(&request, shared.given.as_ref(), &shared.settings.limits)?;
            let text = body::json(&bench.opened(&id)?)?;
            Ok((Arc::new(bench), text))
        }
    };
    let (bench, text) = shared.work.run(place, job).await?;
    let bytes = bench.bytes();
    shared.store.keep(&name, bench, bytes);
    Ok((StatusCode::CREATED, body::answer(text)).into_response())
}

/// Asks a bench.
async fn ask<D: Desk, Q: DeserializeOwned, A: Serialize>(
    State(shared): Of<D>,
    id: Id,
    request: Request,
    question: impl FnOnce(&D, &Q) -> Result<A, Refusal> + Send + 'static,
) -> Result<Response, Refuse> {
    let Path(id) = id.map_err(|_| Refuse::not_found())?;
    let (place, bytes) = received(&shared, request).await?;
    let job = {
        let shared = Arc::clone(&shared);
        move || {
            let asked = body::parse(&bytes)?;
            body::json(&question(&*shared.store.find(&id)?, &asked)?)
        }
    };
    Ok(body::answer(shared.work.run(place, job).await?))
}

/// A place in the queue, then the body: no more bodies are held than there are places.
async fn received<D: Desk>(shared: &Shared<D>, request: Request) -> Result<(Place, Bytes), Refuse> {
    let most = shared.settings.limits.bytes;
    body::check(&request, most)?;
    let place = shared.work.admit()?;
    Ok((place, body::read(request, most, shared.settings.body).await?))
}
