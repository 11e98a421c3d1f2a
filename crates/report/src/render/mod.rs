//! A page in every medium.

mod grid;
mod html;
mod layout;
mod markdown;
mod style;
mod terminal;

pub(crate) use html::themed;
pub use html::{PROGRAM, PageError, html, is_own};
pub use layout::WIDTH;
pub use markdown::markdown;
pub use style::TextStyle;
pub use terminal::{Terminal, plain, terminal};
