//! From the located tree to typed values; every mistake is noted and reading goes on.

use super::locate::{Entry, Item, Node, Place};
use super::{LoadErrors, Problem, ProblemKind, nearest};

/// The mistakes found so far.
#[derive(Default)]
pub(super) struct Problems {
    list: Vec<Problem>,
}

/// The fields of one record, checked for names and doubles.
pub(super) struct Fields<'a> {
    entries: &'a [Entry],
    place: Place,
    path: String,
}

impl Problems {
    pub fn push(&mut self, place: Place, kind: ProblemKind) {
        self.list.push(Problem { place, kind });
    }

    pub fn any(&self) -> bool {
        !self.list.is_empty()
    }

    /// The result, if there was no mistake; otherwise all of them in the order of the file.
    pub fn finish<T>(mut self, name: &str, value: Option<T>) -> Result<T, LoadErrors> {
        match value {
            Some(value) if self.list.is_empty() => Ok(value),
            _ => {
                self.list.sort_by_key(|p| p.place);
                Err(LoadErrors { name: name.to_owned(), problems: self.list })
            }
        }
    }

    pub fn wrong_type(&mut self, node: &Node, field: &str, expected: &'static str) {
        let (field, found) = (field.to_owned(), node.item.form());
        self.push(node.place, ProblemKind::WrongType { field, expected, found });
    }

    /// A record whose fields are all among `allowed`. `record` is the name that may stand before the bracket.
    pub fn fields<'a>(
        &mut self,
        node: &'a Node,
        path: &str,
        record: &'static str,
        allowed: &[&'static str],
    ) -> Option<Fields<'a>> {
        let (name, entries): (&Option<String>, &[Entry]) = match &node.item {
            Item::Record(name, entries) => (name, entries),
            Item::Tuple(name, items) if items.is_empty() => (name, &[]),
            _ => {
                self.wrong_type(node, if path.is_empty() { "the file" } else { path }, "a record (field: value, …)");
                return None;
            }
        };
        if let Some(found) = name.clone().filter(|n| n != record) {
            self.push(node.place, ProblemKind::WrongRecord { expected: record, found });
        }
        let fields = Fields { entries, place: node.place, path: path.to_owned() };
        for entry in entries {
            let Item::Text(key) = &entry.key.item else { continue };
            if !allowed.contains(&key.as_str()) {
                let near = nearest(key, allowed.iter().map(|&a| (a, a))).into_iter().map(str::to_owned).collect();
                let (field, allowed) = (fields.path_of(key), allowed.to_vec());
                self.push(entry.key.place, ProblemKind::UnknownField { field, nearest: near, allowed });
            }
        }
        self.doubles(entries, |key| fields.path_of(key));
        Some(fields)
    }

    /// The entries of a map with text keys, doubles noted.
    pub fn map<'a>(&mut self, node: &'a Node, field: &str) -> Vec<(&'a str, Place, &'a Node)> {
        let entries: &[Entry] = match &node.item {
            Item::Map(entries) => entries,
            _ => {
                self.wrong_type(node, field, "a map { \"id\": value, … }");
                return Vec::new();
            }
        };
        self.doubles(entries, str::to_owned);
        let mut texts = Vec::new();
        for entry in entries {
            match &entry.key.item {
                Item::Text(key) => texts.push((key.as_str(), entry.key.place, &entry.value)),
                _ => self.wrong_type(&entry.key, &format!("each key of {field}"), "a text"),
            }
        }
        texts
    }

    fn doubles(&mut self, entries: &[Entry], path_of: impl Fn(&str) -> String) {
        for (i, entry) in entries.iter().enumerate() {
            let Item::Text(key) = &entry.key.item else { continue };
            if let Some(first) = entries[..i].iter().find(|e| e.key.item == entry.key.item) {
                let kind = ProblemKind::Duplicate { field: path_of(key), first_line: first.key.place.line };
                self.push(entry.key.place, kind);
            }
        }
    }

    /// The elements of a list.
    pub fn list<'a>(&mut self, node: &'a Node, field: &str) -> &'a [Node] {
        match &node.item {
            Item::List(items) => items,
            _ => {
                self.wrong_type(node, field, "a list [ … ]");
                &[]
            }
        }
    }

    pub fn text(&mut self, node: &Node, field: &str) -> Option<String> {
        match &node.item {
            Item::Text(text) => Some(text.clone()),
            _ => {
                self.wrong_type(node, field, "a text in quotes");
                None
            }
        }
    }

    /// A text with at least one visible character.
    pub fn full_text(&mut self, node: &Node, field: &str) -> Option<String> {
        let text = self.text(node, field)?;
        if text.trim().is_empty() {
            self.push(node.place, ProblemKind::Empty { field: field.to_owned() });
            return None;
        }
        Some(text)
    }

    /// A finite number.
    pub fn number(&mut self, node: &Node, field: &str) -> Option<f64> {
        match node.item {
            Item::Number(number) if number.is_finite() => Some(number),
            Item::Number(_) => {
                self.push(node.place, ProblemKind::NotFinite { field: field.to_owned() });
                None
            }
            _ => {
                self.wrong_type(node, field, "a number");
                None
            }
        }
    }

    /// A number from `min` to `max`.
    pub fn number_in(&mut self, node: &Node, field: &str, min: f64, max: f64) -> Option<f64> {
        let value = self.number(node, field)?;
        if !(min..=max).contains(&value) {
            self.push(node.place, ProblemKind::OutOfRange { field: field.to_owned(), value, min, max });
            return None;
        }
        Some(value)
    }

    /// A whole number from `min` to `max`.
    pub fn whole_number_in(&mut self, node: &Node, field: &str, min: u8, max: u8) -> Option<u8> {
        let value = self.number_in(node, field, f64::from(min), f64::from(max))?;
        if value.fract() != 0.0 {
            self.wrong_type(node, field, "a whole number");
            return None;
        }
        Some(value as u8)
    }

    /// The field `version`, from 1 to `newest`. Any other makes the rest unreadable.
    pub fn version(&mut self, fields: &Fields<'_>, newest: u32) -> Option<u32> {
        let node = fields.require("version", self)?;
        let found = self.number(node, "version")?;
        if found.fract() != 0.0 || !(1.0..=f64::from(newest)).contains(&found) {
            self.push(node.place, ProblemKind::Version { found, newest });
            return None;
        }
        Some(found as u32)
    }
}

impl<'a> Fields<'a> {
    /// The field's value if it is there. `None` and `Some(value)` are understood, as RON writes optional fields.
    pub fn get(&self, key: &str) -> Option<&'a Node> {
        let node = self.entries.iter().find(|e| matches!(&e.key.item, Item::Text(k) if k == key)).map(|e| &e.value)?;
        match &node.item {
            Item::Word(word) if word == "None" => None,
            Item::Tuple(Some(name), items) if name == "Some" && items.len() == 1 => items.first(),
            _ => Some(node),
        }
    }

    /// The field's value; its absence is a mistake.
    pub fn require(&self, key: &str, problems: &mut Problems) -> Option<&'a Node> {
        let node = self.get(key);
        if node.is_none() {
            problems.push(self.place, ProblemKind::Missing { field: self.path_of(key) });
        }
        node
    }

    /// Where the record begins.
    pub fn place(&self) -> Place {
        self.place
    }

    /// The field's name with the names of the records around it.
    pub fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }
}
