//! `docs/parameters.md` says what `rigs/anatomy.ron` says, `docs/breeds.md` what `rigs/breeds` says, `docs/markings.md` which
//! markings there are, `docs/dogfacs.md` what `rigs/units.ron` says; `UPDATE_DOCS=1` rewrites them. No page has a place left open.
#![cfg(feature = "head")]

#[path = "support/known_breeds.rs"]
mod known_breeds;
#[path = "support/settings.rs"]
mod settings;

use known_breeds::{LIVE_AND_BONE, is_class, live_ratio};
use londra::anatomy::{MarkingField, MarkingKind, ParamSpec, ParamTable, Reference, Region, Status, Unit};
use londra::motion::{Channel, Library, Sides, Status as Known, Target};
use settings::World;
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
        Unit::Week => " weeks",
        Unit::Kilogram => " kg",
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
         A value that nobody has set may follow another one: value = default × (other / other's default) ^ exponent, within its range.\n\n\
         The pictures show a Labrador with each measure at the low end, in the middle and at the high end of its range, all others as they are, from where it is seen best.\n\
         `londra atlas --split -o docs/atlas.png` draws them; `londra atlas -o atlas.png` draws them in one picture.\n\n",
        table.specs.len()
    );
    let mut group = "";
    for spec in &table.specs {
        if spec.group != group {
            group = &spec.group;
            let slug = group.to_lowercase().replace(' ', "-");
            let _ =
                writeln!(out, "## {group}\n\n![Each measure of this group, low, middle and high](atlas_{slug}.png)\n");
        }
        out.push_str(&entry(table, spec));
    }
    let end = out.trim_end().len();
    out.truncate(end);
    out.push('\n');
    out
}

/// Compares a page with what the program makes of it, or rewrites it.
fn keep(page: &str, made: &str, source: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(page);
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(&path, made).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        return;
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    let line = made.lines().zip(committed.lines()).position(|(a, b)| a != b);
    let at = line.map_or("its end".to_owned(), |l| format!("line {}", l + 1));
    assert!(made == committed, "{page} is not what {source} says, from {at}: run UPDATE_DOCS=1 cargo test --test docs");
}

#[test]
fn manual_of_parameters_is_stale() {
    let table = ParamTable::embedded().unwrap_or_else(|e| panic!("{e}"));
    keep("docs/parameters.md", &text(&table), "rigs/anatomy.ron");
}

// ---- markings ----

fn markings_text() -> String {
    let mut out = String::from(
        "# Markings\n\n\
         <!-- Written from src/anatomy/marking.rs by `UPDATE_DOCS=1 cargo test --test docs`. -->\n\n\
         Every kind has `colour`, which must be there, and `amount`, 0 to 1 and 1 without it: `Mask(colour: Eumelanin, extent: 0.6)`.\n\
         [The coat](coat.md) tells where they stand in a breed's file.\n",
    );
    for kind in MarkingKind::ALL {
        let _ = write!(out, "\n## {}\n\n{}\n\n", kind.name(), kind.tells());
        if *kind == MarkingKind::Patch {
            let regions: Vec<String> = Region::ALL.iter().map(|r| format!("`{}`", r.name())).collect();
            let _ = writeln!(out, "`regions` must be there, a list of {}.\n", regions.join(", "));
        }
        out.push_str("| Field | Range | Without it | What it does |\n| --- | --- | --- | --- |\n");
        for field in kind.fields() {
            let MarkingField { name, min, max, default, tells } = field;
            let _ = writeln!(out, "| `{name}` | {min} to {max} | {default} | {tells} |");
        }
    }
    out
}

#[test]
fn manual_of_markings_is_stale() {
    keep("docs/markings.md", &markings_text(), "src/anatomy/marking.rs");
}

// ---- breeds ----

/// The letter of a reference's standing, as the page explains them.
fn standing(reference: &Reference) -> &'static str {
    match reference.status {
        Status::Measured => "m",
        Status::Computed => "c",
        Status::Estimated => "e",
    }
}

fn breeds_text(world: &World) -> String {
    let mut out = format!(
        "# Breeds\n\n\
         <!-- Written from rigs/breeds by `UPDATE_DOCS=1 cargo test --test docs`. -->\n\n\
         {} heads are part of the program.\n\
         Each file in `rigs/breeds` has the references that it is held against, each with its status and source, and sets what matters for the breed; the rest follows.\n\
         `londra measure` prints them beside what it measures, and [heads.png](heads.png) shows all heads at one scale (`make heads`).\n\n\
         Beside each number stands what it is held against: m measured, c computed from other numbers by a stated rule, e estimated.\n\
         Estimates are by laws of size and breed standards, not by measured breed means, of which hardly any could be had; they are uncertain by some 10 % in length, 5 points of index and 0.07 in the ratio.\n\n\
         - Skull length on bone: facial and cranial length, which meet at the nasion under 148 degrees. Held to 3 %.\n\
         - Zygomatic width on bone, as the file has it. Held to 3 %.\n\
         - Cephalic index on bone: 100 width / length. Held to 3 points.\n\
         - F/C: facial over cranial length on bone, as the file has them.\n\
         - Craniofacial ratio: the reference's is of live dogs, muzzle over cranium with the stop between them and a tape over the vault, which is another number than F/C.\n  \
         F/C is turned into it by a curve of ours, through the class averages and the first eight breeds; no ratio was measured on the skin. Held to 0.03.\n\n\
         | Breed | FCI | Skull, mm | Reference | Off | Width, mm | Reference | Off | Index | Reference | Off | F/C | Ratio | Reference | Off |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        world.breeds.len()
    );
    for breed in world.breeds.iter().filter(|b| !is_class(b)) {
        let value = |id: &str| breed.values[world.row(id)];
        let known = |id: &str| breed.reference(id).unwrap_or_else(|| panic!("{}: no reference for {id}", breed.id));
        let (skull, width) = (1e3 * world.skull_length(&breed.values), 1e3 * value("zygomatic_width_mm"));
        let bone = value("facial_length_mm") / value("cranial_length_mm");
        let (index, ratio) = (100.0 * width / skull, live_ratio(bone));
        let group = breed.fci_group.map_or(String::new(), |group| group.to_string());
        let _ = write!(out, "| {} | {group} |", breed.label);
        for (found, id) in [(skull, "skull_length"), (width, "zygomatic_width")] {
            let (reference, value) = (known(id), known(id).value as f32);
            let off = 100.0 * (found / value - 1.0);
            let _ = write!(out, " {found:.0} | {value:.0} {} | {off:+.1} % |", standing(reference));
        }
        let reference = known("skull_index");
        let off = index - reference.value as f32;
        let _ = write!(out, " {index:.1} | {:.1} {} | {off:+.1} | {bone:.2} |", reference.value, standing(reference));
        let reference = known("craniofacial_ratio");
        let off = ratio - reference.value as f32;
        let _ = writeln!(out, " {ratio:.2} | {:.2} {} | {off:+.2} |", reference.value, standing(reference));
    }
    out.push_str(
        "\nTwo ratios are not met: the Pekingese's facial length stands at the end of its range, and a shorter muzzle folds the pug's stop.\n\n\
         ## The curve between the two ratios\n\n| Live | F/C |\n| --- | --- |\n",
    );
    for (live, bone) in LIVE_AND_BONE {
        let _ = writeln!(out, "| {live:.2} | {bone:.3} |");
    }
    out.push_str(
        "\n## The three classes\n\n\
         The class averages of cranial and facial index were recalled, not sourced, and lengths differ with the size of the dogs, so indices alone are compared, within 5 %.\n\
         Skull index: width over skull length; cranial index: braincase width over cranial length; facial index: width over facial length; all times 100, on bone.\n\n\
         | Head | Skull index | Class | Cranial index | Class | Facial index | Class |\n| --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for breed in world.breeds.iter().filter(|b| is_class(b)) {
        let value = |id: &str| breed.values[world.row(id)];
        let width = value("zygomatic_width_mm");
        let found = [
            ("skull_index", width / world.skull_length(&breed.values)),
            ("cranial_index", value("cranial_width_mm") / value("cranial_length_mm")),
            ("facial_index", width / value("facial_length_mm")),
        ];
        let _ = write!(out, "| {} |", breed.label);
        for (id, found) in found {
            let reference = breed.reference(id).unwrap_or_else(|| panic!("{}: no reference for {id}", breed.id));
            let _ = write!(out, " {:.1} | {} {} |", 100.0 * found, reference.value, standing(reference));
        }
        out.push('\n');
    }
    out
}

#[test]
fn table_of_breeds_is_stale() {
    keep("docs/breeds.md", &breeds_text(&World::embedded()), "rigs/breeds");
}

// ---- DogFACS units ----

fn units_text(library: &Library) -> String {
    let (units, muscles) = (&library.units, &library.muscles);
    let mut out = String::from(
        "# DogFACS units\n\n\
         <!-- Written from rigs/units.ron, rigs/muscles.ron and rigs/skeleton.ron by `UPDATE_DOCS=1 cargo test --test docs`. Edit those files, not this. -->\n\n\
         DogFACS (Waller, Caeiro, Peirce, Burrows and Kaminski 2013) codes what a dog's face does, not what the dog feels.\n\
         Its units are Londra's controls: each has a value from 0 to 1, and one that a dog can do on one side has one for the left and one for the right.\n\
         Codes of movements are the manual's; where the manual was not at hand, the code follows the human system and the row says so.\n\
         The motions of landmarks are Londra's own: what a unit at 1 does on a head with a skull of 200 mm, scaled by the head.\n\
         `cargo test --test units` holds them against nine breeds; they do not claim to be measured on dogs.\n\n\
         `londra render --unit AU101=0.7 --unit EAD103L=1 -o dog.png` sets units, `--facs 101+12B+EAD103` reads the notation: codes joined by `+`, a side as `L` or `R`, an intensity as `A` (0.2) to `E` (1).\n\
         `londra list units` prints them.\n\n\
         The pictures show a German shepherd from the front and at three quarters with the unit at 0, 0.5 and 1, arrows from where landmarks were to where they are.\n\
         `londra atlas --units --breed german_shepherd --size 56x56 -o docs/dogfacs` draws them.\n\n",
    );
    let _ = writeln!(
        out,
        "## Rules\n\nWhat cannot be at once is resolved before a pose is made; the panel shows what was overruled.\n"
    );
    for rule in &units.rules {
        let names: Vec<&str> = rule.units().iter().map(|&u| units.units[u].label.as_str()).collect();
        let _ = writeln!(
            out,
            "- {}: {} Source: {}.",
            names.join(", "),
            sentence(&rule.why),
            rule.source.trim_end_matches('.')
        );
    }
    let mut group = None;
    for unit in &units.units {
        if group != Some(unit.group) {
            let _ = writeln!(out, "\n## {}", sentence(unit.group.label()).trim_end_matches('.'));
            group = Some(unit.group);
        }
        let _ = writeln!(out, "\n### {}: {}\n", unit.label, unit.name);
        if !unit.drives.is_empty() {
            let _ = writeln!(out, "![{} at 0, 0.5 and 1](dogfacs/{}.png)\n", unit.label, unit.id);
        }
        let _ = writeln!(
            out,
            "Id `{}`, {}.",
            unit.id,
            match unit.sides {
                Sides::Each => "each side on its own",
                Sides::Together => "both sides together",
                Sides::Median => "one for the head",
            }
        );
        if !unit.criterion.is_empty() {
            let _ = writeln!(out, "Coded when {}.", unit.criterion.trim_end_matches('.'));
        }
        let of_muscles: Vec<String> = unit
            .drives
            .iter()
            .filter_map(|d| match d.target {
                Target::Muscle(m) => Some(format!("{} to {}", muscles.muscles[m].name, d.value)),
                Target::Channel(_) => None,
            })
            .collect();
        if !of_muscles.is_empty() {
            let _ = writeln!(out, "Muscles: {}.", of_muscles.join(", "));
        }
        let of_joints: Vec<String> = unit
            .drives
            .iter()
            .filter_map(|d| match d.target {
                Target::Channel(c) => Some(format!("`{}` {}", c.id(), d.value)),
                Target::Muscle(_) => None,
            })
            .collect();
        if !of_joints.is_empty() {
            let _ = writeln!(out, "Joints and soft parts: {}.", of_joints.join(", "));
        }
        if let Some(cycle) = &unit.cycle {
            let _ = writeln!(out, "In time it swings {} times a second.", cycle.hz);
        }
        if !unit.clip.is_empty() {
            let _ = writeln!(out, "As a clip: `{}`.", unit.clip);
        }
        let moves: Vec<String> = unit
            .landmarks
            .iter()
            .map(|m| format!("{} {:?} {} to {} mm", m.0, m.1, m.2, m.3))
            .chain(unit.gaps.iter().map(|g| format!("{} and {} {} to {} mm apart", g.0, g.1, g.2, g.3)))
            .chain(
                unit.opening_deg
                    .map(|(least, most)| format!("the ear's opening turns outwards by {least} to {most} degrees")),
            )
            .collect();
        if !moves.is_empty() {
            let _ = writeln!(out, "Landmarks at 1: {}.", moves.join("; "));
        }
        if !unit.lacks.is_empty() {
            let _ = writeln!(out, "What this rig does not do: {}.", unit.lacks.trim_end_matches('.'));
        }
        let status = if unit.status == Known::Sourced { "sourced" } else { "constructed" };
        let _ = writeln!(out, "Source ({status}): {}.", unit.source.trim_end_matches('.'));
    }
    let _ = writeln!(
        out,
        "\n## Limits of joints and soft parts\n\n| channel | joint | least | most | source |\n| --- | --- | ---: | ---: | --- |"
    );
    for &channel in Channel::ALL {
        let spec = library.limits.of(channel);
        let _ = writeln!(
            out,
            "| `{}` | {} | {} | {} | {} |",
            channel.id(),
            spec.joint,
            spec.range.0,
            spec.range.1,
            spec.source
        );
    }
    let _ = writeln!(out, "\n## Muscles\n\n| muscle | from | to | source |\n| --- | --- | --- | --- |");
    let path = |anchors: &[Vec<String>]| anchors.iter().map(|a| a.join(" ")).collect::<Vec<_>>().join(", ");
    for m in &muscles.muscles {
        let _ = writeln!(out, "| {} | {} | {} | {} |", m.name, path(&m.path), m.insertion.join(" "), m.source);
    }
    out
}

#[test]
fn manual_of_units_is_stale() {
    let library = Library::embedded().unwrap_or_else(|e| panic!("{e}"));
    keep("docs/dogfacs.md", &units_text(&library), "rigs/units.ron");
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

#[test]
fn a_page_shows_a_picture_that_is_not_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for page in [
        root.join("README.md"),
        root.join("docs/head.md"),
        root.join("docs/parameters.md"),
        root.join("docs/breeds.md"),
        root.join("docs/dogfacs.md"),
    ] {
        let text = std::fs::read_to_string(&page).unwrap_or_else(|e| panic!("{}: {e}", page.display()));
        for link in text.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next()) {
            let is_here = !link.is_empty() && !link.contains("://");
            let target = page.parent().map(|folder| folder.join(link)).unwrap_or_default();
            assert!(!is_here || target.exists(), "{} links to {link}", page.display());
        }
    }
}
