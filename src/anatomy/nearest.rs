//! Which known name somebody may have meant.

/// Up to three answers whose spelling is near the query, nearest first.
///
/// `names` are pairs of an answer and one spelling of it (its own name, a label, a synonym). A spelling is near when the
/// query is a part of it, or when at most a third of the query's letters (but always one, and two from five letters on) must
/// change. Case, spaces, `-` and `_` do not count. Ties keep the order of `names`.
pub fn nearest<'a>(query: &str, names: impl IntoIterator<Item = (&'a str, &'a str)>) -> Vec<&'a str> {
    let query = plain(query);
    if query.is_empty() {
        return Vec::new();
    }
    let limit = match query.len() {
        1 => 0,
        2..=4 => 1,
        n => (n / 3).max(2),
    };
    let mut found: Vec<(usize, &str)> = Vec::new();
    for (answer, spelling) in names {
        let spelling = plain(spelling);
        let distance = edit_distance(&query, &spelling);
        let is_part = query.len() >= 3 && spelling.windows(query.len()).any(|w| w == query);
        let score = if is_part { distance.min(1) } else { distance };
        if score > limit {
            continue;
        }
        match found.iter_mut().find(|(_, known)| *known == answer) {
            Some(entry) => entry.0 = entry.0.min(score),
            None => found.push((score, answer)),
        }
    }
    found.sort_by_key(|&(score, _)| score);
    found.into_iter().map(|(_, answer)| answer).take(3).collect()
}

fn plain(name: &str) -> Vec<char> {
    name.chars().filter(|c| !matches!(c, ' ' | '-' | '_')).flat_map(char::to_lowercase).take(64).collect()
}

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one word into the other (the "optimal string
/// alignment" form of Damerau 1964, Levenshtein 1966).
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before = vec![0; b.len() + 1];
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for (i, &ca) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, &cb) in b.iter().enumerate() {
            let mut best = (above[j + 1] + 1).min(row[j] + 1).min(above[j] + usize::from(ca != cb));
            if i > 0 && j > 0 && ca == b[j - 1] && a[i - 1] == cb {
                best = best.min(before[j - 1] + 1);
            }
            row.push(best);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn among(query: &str) -> Vec<&'static str> {
        let names = ["labrador", "pug", "borzoi", "german_shepherd"];
        nearest(query, names.into_iter().map(|n| (n, n)).chain([("german_shepherd", "Alsatian")]))
    }

    #[test]
    fn slips_parts_and_synonyms_are_understood() {
        assert_eq!(among("labardor"), ["labrador"]);
        assert_eq!(among("Lab"), ["labrador"]);
        assert_eq!(among("German-Shepard"), ["german_shepherd"]);
        assert_eq!(among("alsatian"), ["german_shepherd"]);
        assert_eq!(among("pgu"), ["pug"]);
        assert!(among("velociraptor").is_empty());
        assert!(among("").is_empty());
        assert!(among("x").is_empty());
    }
}
