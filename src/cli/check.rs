//! `londra check`.

use super::args::Check;
use super::rigs::Rigs;
use super::{Failure, output};
use serde_json::{Value, json};

/// Prints every mistake of the files on a line of its own; fails if there is one.
pub(super) fn run(args: &Check) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    let mut lines = Vec::new();
    let mut objects: Vec<Value> = Vec::new();
    let mut unreadable = false;
    for path in &args.files {
        match rigs.check(path) {
            Ok(Ok(())) => {}
            Ok(Err(errors)) => {
                for problem in &errors.problems {
                    lines.push(errors.line_of(problem));
                    objects.push(json!({
                        "path": errors.name, "line": problem.place.line, "column": problem.place.column,
                        "message": problem.kind.to_string(),
                    }));
                }
            }
            Err(error) => {
                unreadable = true;
                output::message(&error.to_string());
                objects.push(json!({ "path": path.display().to_string(), "message": error.to_string() }));
            }
        }
    }
    if args.report.json {
        output::json(&Value::Array(objects))?;
    } else if !lines.is_empty() {
        output::result(&lines.join("\n"))?;
    }
    if unreadable || !lines.is_empty() {
        return Err(Failure::Said);
    }
    let n = args.files.len();
    output::message(&format!("{n} file{} without a mistake", if n == 1 { "" } else { "s" }));
    Ok(())
}
