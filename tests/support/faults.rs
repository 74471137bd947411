//! Faults that are known, by setting and place, in a file beside the tests: what is not in it, fails.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

/// What is wrong, where, and how often.
pub type Faults = BTreeMap<String, usize>;

/// The known faults of one kind of setting.
pub struct Known {
    path: PathBuf,
    settings: BTreeMap<String, Faults>,
}

impl Known {
    /// Reads `tests/faults/NAME.txt`; a line is a setting, a colon, and faults with their numbers and commas between.
    pub fn of(name: &str) -> Known {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/faults").join(format!("{name}.txt"));
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let line = |line: &str| {
            let (setting, faults) = line.split_once(": ")?;
            let fault = |f: &str| f.rsplit_once(' ').and_then(|(what, n)| Some((what.to_owned(), n.parse().ok()?)));
            Some((setting.to_owned(), faults.split(", ").filter_map(fault).collect()))
        };
        Known { settings: text.lines().filter_map(line).collect(), path }
    }

    /// Holds what was found against what is known: a fault that is new, or more often than it was, fails. With
    /// `UPDATE_FAULTS=1` the file is written anew for these settings instead.
    pub fn check(mut self, found: BTreeMap<String, Faults>) {
        let faulty = found.values().filter(|f| !f.is_empty()).count();
        println!("{}: {faulty} of {} settings have a fault", self.path.display(), found.len());
        let mut total: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
        for (what, n) in found.values().flatten() {
            let [settings, times] = total.entry(what).or_default();
            (*settings, *times) = (*settings + 1, *times + n);
        }
        for (what, [settings, times]) in total {
            println!("  {what}: {times} in {settings} settings");
        }
        if std::env::var("UPDATE_FAULTS").is_ok_and(|v| v == "1") {
            for (setting, faults) in found {
                self.settings.remove(&setting);
                if !faults.is_empty() {
                    self.settings.insert(setting, faults);
                }
            }
            let mut text = String::new();
            for (setting, faults) in &self.settings {
                let _ = writeln!(text, "{}", line(setting, faults));
            }
            std::fs::write(&self.path, text).unwrap_or_else(|e| panic!("{}: {e}", self.path.display()));
            return;
        }
        let none = Faults::new();
        let is_new = |(setting, faults): &(&String, &Faults)| {
            let known = self.settings.get(*setting).unwrap_or(&none);
            faults.iter().any(|(what, n)| known.get(what).is_none_or(|k| n > k))
        };
        let new: Vec<String> = found.iter().filter(is_new).map(|(s, f)| line(s, f)).collect();
        let gone = found.iter().filter(|(s, f)| f.is_empty() && self.settings.contains_key(*s)).count();
        println!("{gone} settings of the list have no fault any more");
        assert!(
            new.is_empty(),
            "{} settings have faults that {} does not tell; where they are meant, run again with UPDATE_FAULTS=1, \
             which writes:\n{}",
            new.len(),
            self.path.display(),
            new.join("\n")
        );
    }
}

fn line(setting: &str, faults: &Faults) -> String {
    let words: Vec<String> = faults.iter().map(|(what, n)| format!("{what} {n}")).collect();
    format!("{setting}: {}", words.join(", "))
}
