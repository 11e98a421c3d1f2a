//! Words for types of plain cases.

/// Gives a type of plain cases the list of all of them, in this order, a word for each, and the way back.
///
/// ```
/// #[derive(Clone, Copy)]
/// enum Side { Left, Right }
/// hexbench_core::worded! {
///     /// In messages.
///     Side::word { Left => "left", Right => "right" }
/// }
/// assert_eq!(Side::ALL.map(Side::word), ["left", "right"]);
/// assert!(matches!(Side::named("right"), Some(Side::Right)));
/// ```
#[macro_export]
macro_rules! worded {
    ($(#[$doc:meta])* $kind:ident::$word:ident { $($case:ident => $text:literal),+ $(,)? }) => {
        impl $kind {
            /// All of them.
            pub const ALL: [Self; [$($text),+].len()] = [$(Self::$case),+];

            $(#[$doc])*
            pub fn $word(self) -> &'static str {
                match self {
                    $(Self::$case => $text,)+
                }
            }

            /// The one with a word; none of any other.
            pub fn named(word: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|one| one.$word() == word)
            }
        }
    };
}
