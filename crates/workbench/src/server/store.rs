//! The benches kept: the least recently used one is dropped.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use axum::http::StatusCode;
use sha2::{Digest, Sha256};

use super::refuse::Refuse;
use super::token::{Token, hexadecimal, same};

/// Bytes of the digest in an id: 128 bits.
const DIGEST: usize = 16;

/// Benches by their ids.
pub(super) struct Store<B> {
    key: Token,
    most: usize,
    most_bytes: usize,
    kept: Mutex<Kept<B>>,
}

/// In the order of use, the last used at the end.
struct Kept<B> {
    next: u64,
    benches: Vec<Entry<B>>,
}

struct Entry<B> {
    number: u64,
    bench: Arc<B>,
    bytes: usize,
}

impl<B> Store<B> {
    /// For this many benches of this many bytes together.
    pub(super) fn new(key: Token, most: usize, most_bytes: usize) -> Self {
        Self { key, most, most_bytes, kept: Mutex::new(Kept { next: 1, benches: vec![] }) }
    }

    /// A name for a bench to come: its number, and a digest that only this process can make.
    pub(super) fn name(&self) -> Name {
        let mut kept = self.lock();
        let number = kept.next;
        kept.next += 1;
        Name { number, id: self.id(number) }
    }

    /// Keep a bench.
    pub(super) fn keep(&self, name: &Name, bench: Arc<B>, bytes: usize) {
        let mut kept = self.lock();
        kept.benches.push(Entry { number: name.number, bench, bytes });
        let too_much = |all: &[Entry<B>]| {
            all.len() > self.most || all.iter().map(|entry| entry.bytes).sum::<usize>() > self.most_bytes
        };
        while kept.benches.len() > 1 && too_much(&kept.benches) {
            kept.benches.remove(0);
        }
    }

    /// The bench of an id.
    pub(super) fn find(&self, id: &str) -> Result<Arc<B>, Refuse> {
        let number = self.number(id).ok_or_else(unknown)?;
        let mut kept = self.lock();
        let place = kept.benches.iter().position(|entry| entry.number == number).ok_or_else(gone)?;
        let entry = kept.benches.remove(place);
        let bench = Arc::clone(&entry.bench);
        kept.benches.push(entry);
        Ok(bench)
    }

    /// Of an id this process has given.
    fn number(&self, id: &str) -> Option<u64> {
        let number = id.split_once('-')?.0.parse().ok()?;
        same(self.id(number).as_bytes(), id.as_bytes()).then_some(number)
    }

    fn id(&self, number: u64) -> String {
        let digest =
            Sha256::new().chain_update(self.key.bytes()).chain_update(number.to_le_bytes()).finalize();
        format!("{number}-{}", hexadecimal(&digest[..DIGEST]))
    }

    fn lock(&self) -> MutexGuard<'_, Kept<B>> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Name of a bench.
#[derive(Debug)]
pub(super) struct Name {
    number: u64,
    /// What the page gets.
    pub(super) id: String,
}

fn unknown() -> Refuse {
    Refuse::new(StatusCode::NOT_FOUND, "there is no bench with this id", "Load the measurements again.")
}

fn gone() -> Refuse {
    let error = "this bench was dropped because others were opened since";
    Refuse::new(StatusCode::GONE, error, "Load the measurements again.")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn store(most: usize, most_bytes: usize) -> Store<u32> {
        Store::new(Token::random().unwrap(), most, most_bytes)
    }

    fn open(store: &Store<u32>, bench: u32, bytes: usize) -> String {
        let name = store.name();
        store.keep(&name, Arc::new(bench), bytes);
        name.id
    }

    fn status(found: Result<Arc<u32>, Refuse>) -> u16 {
        use axum::response::IntoResponse;
        found.map_or_else(|refuse| refuse.into_response().status().as_u16(), |_| 200)
    }

    #[test]
    fn the_bench_unused_for_longest_gives_way() {
        let store = store(2, usize::MAX);
        let (first, second) = (open(&store, 1, 0), open(&store, 2, 0));
        assert_eq!(*store.find(&first).unwrap(), 1);
        let third = open(&store, 3, 0);
        assert_eq!(status(store.find(&second)), 410);
        assert_eq!((*store.find(&first).unwrap(), *store.find(&third).unwrap()), (1, 3));
    }

    #[test]
    fn large_benches_give_way_sooner_and_the_newest_stays() {
        let store = store(8, 100);
        let (small, large) = (open(&store, 1, 60), open(&store, 2, 60));
        assert_eq!(status(store.find(&small)), 410);
        assert_eq!(*store.find(&large).unwrap(), 2);
        let huge = open(&store, 3, 1000);
        assert_eq!(*store.find(&huge).unwrap(), 3);
    }

    #[test]
    fn ids_of_another_process_or_made_up_are_unknown() {
        let (store, other) = (store(2, 100), store(2, 100));
        let (own, foreign) = (open(&store, 1, 0), open(&other, 1, 0));
        let number = own.split_once('-').unwrap().0;
        for id in
            ["", "-", "1", "1-", "x-y", &foreign, &format!("{number}-{}", "0".repeat(32)), &format!("+{own}")]
        {
            assert_eq!(status(store.find(id)), 404, "{id}");
        }
        assert_eq!(status(store.find(&own)), 200);
    }
}
