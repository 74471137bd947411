//! RON text as a tree that knows where everything stands.
//!
//! The `ron` crate decides what is RON and reports the first syntax error; its values have no places, and it stops at the
//! first wrong one. This tree carries a line and a column for each value, keeps double keys, and so lets a loader report every
//! mistake of meaning at once. It reads what `ron` has accepted and is lenient beyond that.

/// Line and column of a character, both from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// From 1.
    pub line: u32,
    /// From 1, in characters.
    pub column: u32,
}

/// A value and where it begins.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub place: Place,
    pub item: Item,
}

/// The forms of values.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Item {
    /// May be infinite or NaN.
    Number(f64),
    Text(String),
    Bool(bool),
    /// A bare word: `None`, or a variant without fields.
    Word(String),
    List(Vec<Node>),
    /// `(a, b)` or `Name(a, b)`.
    Tuple(Option<String>, Vec<Node>),
    /// `(key: a)` or `Name(key: a)`; keys are [`Item::Text`].
    Record(Option<String>, Vec<Entry>),
    /// `{key: a}`; keys are any value.
    Map(Vec<Entry>),
    /// A character, bytes, a range, a number in a form we do not read.
    Other(&'static str),
}

/// A key and its value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub key: Node,
    pub value: Node,
}

impl Item {
    /// The form in words, for messages.
    pub fn form(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::Bool(_) => "true or false",
            Self::Word(word) if word == "None" => "None",
            Self::Word(_) => "a bare word",
            Self::List(_) => "a list",
            Self::Tuple(..) => "a tuple",
            Self::Record(..) => "a record",
            Self::Map(_) => "a map",
            Self::Other(form) => form,
        }
    }
}

/// Parses text, after `ron` has accepted it. The error is a place and what was expected there.
pub(super) fn parse(name: &str, text: &str) -> Result<Node, super::LoadErrors> {
    let syntax = |place, message: String| super::LoadErrors {
        name: name.to_owned(),
        problems: vec![super::Problem { place, kind: super::ProblemKind::Syntax(message) }],
    };
    if let Err(error) = ron::from_str::<ron::Value>(text) {
        let start = error.span.start;
        let place = Place { line: start.line.max(1) as u32, column: start.col.max(1) as u32 };
        return Err(syntax(place, error.code.to_string()));
    }
    let mut parser = Parser { rest: text, place: Place { line: 1, column: 1 }, depth: 0 };
    parser.document().map_err(|expected| syntax(parser.place, format!("expected {expected}")))
}

/// Deeper nesting than any file of ours has; `ron` itself stops at a similar depth.
const MAX_DEPTH: u32 = 200;

struct Parser<'a> {
    rest: &'a str,
    place: Place,
    depth: u32,
}

type Parsed<T> = Result<T, &'static str>;

impl<'a> Parser<'a> {
    fn document(&mut self) -> Parsed<Node> {
        self.space()?;
        while self.rest.starts_with("#![") {
            self.take_while(|c| c != ']');
            self.bump();
            self.space()?;
        }
        let node = self.value()?;
        self.space()?;
        if self.rest.is_empty() { Ok(node) } else { Err("the end of the file") }
    }

    fn value(&mut self) -> Parsed<Node> {
        if self.depth >= MAX_DEPTH {
            return Err("less nesting");
        }
        self.depth += 1;
        let place = self.place;
        let item = match self.peek() {
            None => Err("a value"),
            Some('[') => self.list('[', ']').map(Item::List),
            Some('{') => self.map(),
            Some('(') => self.tuple_or_record(None),
            Some('"') => self.quoted().map(Item::Text),
            Some('\'') => self.character(),
            Some(c) if c.is_ascii_digit() || matches!(c, '+' | '-' | '.') => Ok(self.number()),
            Some(c) if is_word_start(c) => self.word_or_named(),
            Some(_) => Err("a value"),
        }?;
        self.depth -= 1;
        Ok(Node { place, item })
    }

    fn list(&mut self, open: char, close: char) -> Parsed<Vec<Node>> {
        self.expect(open, "an opening bracket")?;
        let mut items = Vec::new();
        loop {
            self.space()?;
            if self.accept(close) {
                return Ok(items);
            }
            items.push(self.value()?);
            self.separator(close)?;
        }
    }

    fn map(&mut self) -> Parsed<Item> {
        self.expect('{', "{")?;
        let mut entries = Vec::new();
        loop {
            self.space()?;
            if self.accept('}') {
                return Ok(Item::Map(entries));
            }
            let key = self.value()?;
            entries.push(Entry { key, value: self.after_colon()? });
            self.separator('}')?;
        }
    }

    fn tuple_or_record(&mut self, name: Option<String>) -> Parsed<Item> {
        let (rest, place) = (self.rest, self.place);
        self.expect('(', "(")?;
        self.space()?;
        let is_record = self.peek().is_some_and(is_word_start) && {
            self.word();
            self.space()?;
            self.rest.starts_with(':') && !self.rest.starts_with("::")
        };
        (self.rest, self.place) = (rest, place);
        if !is_record {
            return Ok(Item::Tuple(name, self.list('(', ')')?));
        }
        self.bump();
        let mut entries = Vec::new();
        loop {
            self.space()?;
            if self.accept(')') {
                return Ok(Item::Record(name, entries));
            }
            let place = self.place;
            if !self.peek().is_some_and(is_word_start) {
                return Err("the name of a field");
            }
            let key = Node { place, item: Item::Text(self.word().to_owned()) };
            entries.push(Entry { key, value: self.after_colon()? });
            self.separator(')')?;
        }
    }

    fn after_colon(&mut self) -> Parsed<Node> {
        self.space()?;
        self.expect(':', ":")?;
        self.space()?;
        self.value()
    }

    /// A comma, or nothing before the closing bracket.
    fn separator(&mut self, close: char) -> Parsed<()> {
        self.space()?;
        if self.accept(',') || self.peek() == Some(close) { Ok(()) } else { Err("a comma or a closing bracket") }
    }

    fn word_or_named(&mut self) -> Parsed<Item> {
        if self.rest.starts_with("r\"") || self.rest.starts_with("r#\"") || self.rest.starts_with("r##") {
            return self.raw().map(Item::Text);
        }
        if self.rest.starts_with("b\"") || self.rest.starts_with("br\"") || self.rest.starts_with("br#") {
            self.bump();
            if self.rest.starts_with('"') {
                self.quoted()?
            } else {
                self.raw()?
            };
            return Ok(Item::Other("bytes"));
        }
        if self.rest.starts_with("b'") {
            self.bump();
            return self.character();
        }
        let word = self.word().to_owned();
        match word.as_str() {
            "true" => return Ok(Item::Bool(true)),
            "false" => return Ok(Item::Bool(false)),
            "inf" | "inff32" | "inff64" => return Ok(Item::Number(f64::INFINITY)),
            "NaN" | "NaNf32" | "NaNf64" => return Ok(Item::Number(f64::NAN)),
            _ => {}
        }
        let (rest, place) = (self.rest, self.place);
        self.space()?;
        if self.peek() == Some('(') {
            return self.tuple_or_record(Some(word));
        }
        (self.rest, self.place) = (rest, place);
        Ok(Item::Word(word))
    }

    fn word(&mut self) -> &'a str {
        if let Some(rest) = self.rest.strip_prefix("r#") {
            self.rest = rest;
            self.place.column += 2;
        }
        self.take_while(|c| is_word_start(c) || c.is_ascii_digit())
    }

    fn number(&mut self) -> Item {
        let text = self.take_number();
        let digits: String = text.chars().filter(|&c| c != '_').collect();
        let (negative, body) = match digits.strip_prefix('-') {
            Some(body) => (true, body),
            None => (false, digits.strip_prefix('+').unwrap_or(&digits)),
        };
        let value = ["0x", "0o", "0b"].iter().zip([16, 8, 2]).find_map(|(prefix, radix)| {
            Some(u64::from_str_radix(body.strip_prefix(prefix)?, radix).map_or(f64::NAN, |n| n as f64))
        });
        let value = value.or_else(|| {
            let suffixes = ["f32", "f64", "i8", "i16", "i32", "i64", "u8", "u16", "u32", "u64"];
            let body = suffixes.iter().find_map(|s| body.strip_suffix(s)).unwrap_or(body);
            body.parse::<f64>().ok()
        });
        match value {
            Some(value) => Item::Number(if negative { -value } else { value }),
            None => Item::Other("a range or a number in an unusual form"),
        }
    }

    /// A run of number characters; a sign belongs to it at the start and after an exponent's letter.
    fn take_number(&mut self) -> &'a str {
        let mut before = 'e';
        self.take_while(|c| {
            let belongs = c.is_ascii_alphanumeric()
                || matches!(c, '.' | '_')
                || (matches!(c, '+' | '-') && matches!(before, 'e' | 'E'));
            before = c;
            belongs
        })
    }

    fn quoted(&mut self) -> Parsed<String> {
        self.expect('"', "a quote")?;
        let mut text = String::new();
        loop {
            match self.bump().ok_or("a closing quote")? {
                '"' => return Ok(text),
                '\\' => text.extend(self.escape()?),
                c => text.push(c),
            }
        }
    }

    /// What follows a backslash; `None` for a byte that is not a character of its own.
    fn escape(&mut self) -> Parsed<Option<char>> {
        Ok(match self.bump().ok_or("the rest of an escape")? {
            'n' => Some('\n'),
            'r' => Some('\r'),
            't' => Some('\t'),
            '0' => Some('\0'),
            'x' => {
                let digits: String = [self.bump(), self.bump()].into_iter().flatten().collect();
                u32::from_str_radix(&digits, 16).ok().and_then(char::from_u32)
            }
            'u' => {
                self.expect('{', "{")?;
                let digits = self.take_while(|c| c != '}' && c != '"');
                self.expect('}', "}")?;
                u32::from_str_radix(digits, 16).ok().and_then(char::from_u32)
            }
            c => Some(c),
        })
    }

    fn raw(&mut self) -> Parsed<String> {
        self.bump();
        let hashes = self.take_while(|c| c == '#').len();
        self.expect('"', "a quote")?;
        let end = format!("\"{}", "#".repeat(hashes));
        let length = self.rest.find(&end).ok_or("the end of a raw text")?;
        let text = self.rest[..length].to_owned();
        for _ in 0..text.chars().count() + end.len() {
            self.bump();
        }
        Ok(text)
    }

    fn character(&mut self) -> Parsed<Item> {
        self.expect('\'', "a quote")?;
        if self.bump().ok_or("a character")? == '\\' {
            self.escape()?;
        }
        self.expect('\'', "a closing quote")?;
        Ok(Item::Other("a character"))
    }

    /// White space and comments; block comments nest.
    fn space(&mut self) -> Parsed<()> {
        loop {
            self.take_while(char::is_whitespace);
            if self.rest.starts_with("//") {
                self.take_while(|c| c != '\n');
            } else if self.rest.starts_with("/*") {
                let mut open = 0_u32;
                loop {
                    let step = if self.rest.starts_with("/*") {
                        open += 1;
                        2
                    } else if self.rest.starts_with("*/") {
                        open -= 1;
                        2
                    } else {
                        1
                    };
                    for _ in 0..step {
                        self.bump().ok_or("the end of a comment")?;
                    }
                    if open == 0 {
                        break;
                    }
                }
            } else {
                return Ok(());
            }
        }
    }

    fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    fn bump(&mut self) -> Option<char> {
        let c = self.peek()?;
        self.rest = &self.rest[c.len_utf8()..];
        if c == '\n' {
            self.place = Place { line: self.place.line + 1, column: 1 };
        } else {
            self.place.column += 1;
        }
        Some(c)
    }

    fn accept(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.bump();
        }
        found
    }

    fn expect(&mut self, wanted: char, what: &'static str) -> Parsed<()> {
        if self.accept(wanted) { Ok(()) } else { Err(what) }
    }

    fn take_while(&mut self, mut belongs: impl FnMut(char) -> bool) -> &'a str {
        let start = self.rest;
        while self.peek().is_some_and(&mut belongs) {
            self.bump();
        }
        &start[..start.len() - self.rest.len()]
    }
}

fn is_word_start(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number_at(text: &str, path: &[&str]) -> (u32, u32, f64) {
        let root = parse("t", text).unwrap();
        let mut node = &root;
        for step in path {
            let (Item::Record(_, entries) | Item::Map(entries)) = &node.item else { panic!("{node:?}") };
            node = &entries.iter().find(|e| e.key.item == Item::Text((*step).to_owned())).unwrap().value;
        }
        let Item::Number(n) = node.item else { panic!("{node:?}") };
        (node.place.line, node.place.column, n)
    }

    #[test]
    fn places_count_lines_and_characters() {
        let text =
            "// a comment\nBreed(\n  a: { \"ä\": 1.5, /* x /* y */ */ \"b\": -2e-3 },\n  c: (d: 0x10, e: 1_000u32),\n)";
        assert_eq!(number_at(text, &["a", "ä"]), (3, 13, 1.5));
        assert_eq!(number_at(text, &["a", "b"]), (3, 39, -2e-3));
        assert_eq!(number_at(text, &["c", "d"]), (4, 10, 16.0));
        assert_eq!(number_at(text, &["c", "e"]), (4, 19, 1000.0));
    }

    #[test]
    fn texts_escapes_and_odd_forms_are_read() {
        let text = r####"#![enable(implicit_some)] ("a\n\u{e4}\x41\\", r#"x"y"#, 'c', '\'', b"z", true, None, Some(3), -inf, .5, Word, ())"####;
        let Item::Tuple(None, items) = parse("t", text).unwrap().item else { panic!() };
        let items: Vec<Item> = items.into_iter().map(|n| n.item).collect();
        assert_eq!(items[0], Item::Text("a\näA\\".into()));
        assert_eq!(items[1], Item::Text("x\"y".into()));
        assert_eq!(items[2], Item::Other("a character"));
        assert_eq!(items[3], Item::Other("a character"));
        assert_eq!(items[4], Item::Other("bytes"));
        assert_eq!(items[5], Item::Bool(true));
        assert_eq!(items[6], Item::Word("None".into()));
        assert!(
            matches!(&items[7], Item::Tuple(Some(name), some) if name == "Some" && some[0].item == Item::Number(3.0))
        );
        assert_eq!(items[8], Item::Number(f64::NEG_INFINITY));
        assert_eq!(items[9], Item::Number(0.5));
        assert_eq!(items[10], Item::Word("Word".into()));
        assert_eq!(items[11], Item::Tuple(None, vec![]));
    }

    #[test]
    fn double_keys_are_kept() {
        let Item::Map(entries) = parse("t", "{\"a\": 1, \"a\": 2}").unwrap().item else { panic!() };
        assert_eq!(entries.len(), 2);
    }

    #[test]
    fn the_first_syntax_error_has_its_place() {
        let error = parse("x.ron", "Breed(\n  label: \"a\",\n  anatomy: { \"a\" 1 },\n)").unwrap_err();
        assert_eq!(error.problems.len(), 1);
        assert_eq!(error.problems[0].place.line, 3);
        assert!(error.to_string().starts_with("x.ron:3:"), "{error}");
        for text in ["", "(", "[1, 2", "\"abc", "/* x", "r#\"abc\"", "'", "(a: )", "{1 2}"] {
            assert!(parse("t", text).is_err(), "{text}");
        }
        let deep = "[".repeat(5000);
        assert!(parse("t", &deep).is_err());
    }
}
