//! `docs/parameters.md` says what `rigs/anatomy.ron` says; `UPDATE_DOCS=1` rewrites it. No page has a place left open.
#![cfg(feature = "head")]

use londra::anatomy::{ParamSpec, ParamTable, Unit};
use std::fmt::Write as _;
use std::path::Path;

fn sentence(text: &str) -> String {
    let mut letters = text.trim().chars();
    let first = letters.next().map(|c| c.to_uppercase().collect::<String>()).unwrap_or_default();
    let end = if text.trim_end().ends_with('.') { "" } else { "." };
    format!("{first}{}{end}", letters.as_str())
}

/// One sentence per line.
fn lines(text: &str) -> String {
    sentence(text).replace(". ", ".\n")
}

fn entry(table: &ParamTable, spec: &ParamSpec) -> String {
    let unit = match spec.unit {
        Unit::Millimetre => " mm",
        Unit::Degree => " degrees",
        Unit::Ratio => "",
    };
    let mut out = format!("### `{}`\n\n", spec.id);
    let _ = writeln!(out, "{}: {} to {}{unit}, default {}.", spec.label, spec.min, spec.max, spec.default);
    let _ = writeln!(out, "Moves {}.", spec.moves.trim_end_matches('.'));
    let _ = writeln!(out, "{}", lines(&spec.help));
    if let Some(follow) = &spec.follows {
        let label = table.get(&follow.id).map_or(follow.id.as_str(), |s| s.label.as_str());
        let _ = writeln!(
            out,
            "While nobody sets it, it follows {} (`{}`), exponent {}.",
            label, follow.id, follow.exponent
        );
    }
    let _ = writeln!(out, "Source: {}.\n", spec.source.trim_end_matches('.'));
    out
}

fn text(table: &ParamTable) -> String {
    let mut out = format!(
        "# Parameters\n\n\
         <!-- Written from rigs/anatomy.ron by `UPDATE_DOCS=1 cargo test --test docs`. Edit that file, not this. -->\n\n\
         A head has {} measures.\n\
         Their ids are the keys of breed files and of `--set`, in the unit that the id ends in.\n\
         A value that nobody has set may follow another one: value = default × (other / other's default) ^ exponent, within its range.\n\n",
        table.specs.len()
    );
    let mut group = "";
    for spec in &table.specs {
        if spec.group != group {
            group = &spec.group;
            let _ = writeln!(out, "## {group}\n");
        }
        out.push_str(&entry(table, spec));
    }
    let end = out.trim_end().len();
    out.truncate(end);
    out.push('\n');
    out
}

#[test]
fn manual_of_parameters_is_stale() {
    let table = ParamTable::embedded().unwrap_or_else(|e| panic!("{e}"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/parameters.md");
    let made = text(&table);
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(&path, &made).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        return;
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    let line = made.lines().zip(committed.lines()).position(|(a, b)| a != b);
    let at = line.map_or("its end".to_owned(), |l| format!("line {}", l + 1));
    assert!(
        made == committed,
        "docs/parameters.md is not what rigs/anatomy.ron says, from {at}: run UPDATE_DOCS=1 cargo test --test docs"
    );
}

/// A figure that was to be filled in: capitals between two at-signs.
fn open_places(text: &str) -> Vec<&str> {
    let is_open = |word: &&str| !word.is_empty() && word.bytes().all(|b| b.is_ascii_uppercase());
    // What stands between two signs is every piece but the first and the last.
    let pieces: Vec<&str> = text.split('@').collect();
    let between = pieces.get(1..pieces.len() - 1).unwrap_or_default();
    between.iter().copied().filter(is_open).collect()
}

#[test]
fn a_page_has_a_place_that_was_to_be_filled_in() {
    let sign = '@';
    assert_eq!(open_places(&format!("a {sign}P{sign} b {sign}HEAD{sign}, me{sign}home")), ["P", "HEAD"]);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let pages = [root, &root.join("docs")].map(|folder| std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{e}")));
    let pages = pages.into_iter().flatten().flatten().map(|entry| entry.path());
    for page in pages.filter(|path| path.extension().is_some_and(|e| e == "md")) {
        let text = std::fs::read_to_string(&page).unwrap_or_else(|e| panic!("{}: {e}", page.display()));
        assert_eq!(open_places(&text), [""; 0], "{}", page.display());
    }
}
