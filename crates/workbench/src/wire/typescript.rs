//! `ui/src/wire.ts` is written from the types beside this file, and from what they hold.

mod layout;

use std::any::TypeId;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use ts_rs::{Config, TS, TypeVisitor};

use self::layout::laid_out;
use super::{
    Ask, Catalogue, CheckedFiles, Diagnosed, Discovered, Export, Exported, Followed, Guess, KeepSession,
    Open, Opened, Pictured, PlanReadings, PlannedReadings, Refused, Resumed, Revealed, Selection, Tried, Try,
    View,
};

const BANNER: &str = "\
/**
 * What page and server say to each other. Units are in the names; numbers are in the frames of the files.
 *
 * Written from crates/workbench/src/wire.rs; to change it, change that file and run
 * HEXBENCH_BLESS=1 cargo test -p hexbench-workbench --lib wire
 */
";

/// Rows of numbers that get a name: name, what it is, as the types above write it.
const ROWS: [(&str, &str, &str); 2] = [
    (
        "Six",
        "Six numbers: a coordinate, a load component or a leg each.",
        "[number, number, number, number, number, number]",
    ),
    ("Three", "Three numbers: a point or a direction.", "[number, number, number]"),
];

/// What an exchange consists of.
struct Declarations {
    config: Config,
    known: BTreeMap<String, TypeId>,
    /// Types met since the last root, by name: they are met in an order that differs from build to build.
    met: BTreeMap<String, String>,
    text: String,
}

impl Declarations {
    /// A type, then what it holds that is not yet known.
    fn root<T: TS + 'static>(&mut self) {
        self.visit::<T>();
        let first = self.met.remove(&T::ident(&self.config));
        self.text.extend(first);
        self.text.extend(std::mem::take(&mut self.met).into_values());
    }
}

impl TypeVisitor for Declarations {
    fn visit<T: TS + 'static + ?Sized>(&mut self) {
        if T::output_path().is_none() {
            return;
        }
        let (name, id) = (T::ident(&self.config), TypeId::of::<T>());
        if let Some(known) = self.known.insert(name.clone(), id) {
            assert!(known == id, "two types are called {name}");
            return;
        }
        let docs = T::docs().unwrap_or_default();
        self.met.insert(name, laid_out(&format!("{docs}export {}", T::decl(&self.config))));
        T::visit_dependencies(self);
    }
}

/// The page's half: what each request carries and what each answer holds.
fn page() -> String {
    // Whole numbers stay below 2^53: the page takes no larger seed.
    let config = Config::new().with_large_int("number");
    let (known, met) = (BTreeMap::new(), BTreeMap::new());
    let mut all = Declarations { config, known, met, text: String::new() };
    all.root::<Catalogue>();
    all.root::<Open>();
    all.root::<Selection>();
    all.root::<View>();
    all.root::<Opened>();
    all.root::<Try>();
    all.root::<Tried>();
    all.root::<Followed>();
    all.root::<Pictured>();
    all.root::<Ask>();
    all.root::<CheckedFiles>();
    all.root::<Diagnosed>();
    all.root::<PlanReadings>();
    all.root::<PlannedReadings>();
    all.root::<Discovered>();
    all.root::<Export>();
    all.root::<Exported>();
    all.root::<KeepSession>();
    all.root::<Resumed>();
    all.root::<Guess>();
    all.root::<Revealed>();
    all.root::<Refused>();
    let named = ROWS.iter().fold(all.text, |text, (name, _, row)| text.replace(row, name));
    let row =
        |(name, what, row): &(&str, &str, &str)| format!("\n/** {what} */\nexport type {name} = {row};\n");
    let rows: String = ROWS.iter().map(row).collect();
    format!("{BANNER}{rows}{named}")
}

#[test]
fn the_page_knows_the_shapes_of_the_server() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("ui/src/wire.ts");
    let page = page();
    if std::env::var_os("HEXBENCH_BLESS").is_some() {
        fs::write(&path, &page).unwrap();
    }
    let stored = fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert!(stored == page, "crates/workbench/ui/src/wire.ts is stale: run with HEXBENCH_BLESS=1");
}
