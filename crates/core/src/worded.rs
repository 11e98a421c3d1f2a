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
///
/// Behind the word there may be a text:
///
/// ```
/// # #[derive(Clone, Copy)]
/// # enum Side { Left, Right }
/// hexbench_core::worded! {
///     /// In files.
///     Side::word,
///     /// In messages.
///     text {
///         Left => "left", "on the left side";
///         Right => "right", "on the right side";
///     }
/// }
/// assert_eq!(Side::Left.text(), "on the left side");
/// ```
#[macro_export]
macro_rules! worded {
    (
        $(#[$doc:meta])* $kind:ident::$word:ident, $(#[$also:meta])* $text:ident
        { $($case:ident => $named:literal, $said:literal;)+ }
    ) => {
        $crate::worded! { $(#[$doc])* $kind::$word { $($case => $named),+ } }

        impl $kind {
            $(#[$also])*
            pub const fn $text(self) -> &'static str {
                match self {
                    $(Self::$case => $said,)+
                }
            }
        }
    };
    ($(#[$doc:meta])* $kind:ident::$word:ident { $($case:ident => $text:literal),+ $(,)? }) => {
        impl $kind {
            /// All of them.
            pub const ALL: [Self; [$($text),+].len()] = [$(Self::$case),+];

            $(#[$doc])*
            pub const fn $word(self) -> &'static str {
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
