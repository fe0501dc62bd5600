//! Results as XML in the form of JUnit, as servers for continuous integration read it.

use super::{NotRun, OfFile, Outcome, Result, place_text};
use autogen::plain;
use std::fmt::Write;

/// How such a file begins.
pub const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites";

/// No times: the same results are the same bytes.
pub fn text(files: &[OfFile], not_run: &[NotRun]) -> String {
    let count = |file: &OfFile, wanted: fn(&Outcome) -> bool| {
        file.results.iter().filter(|result| wanted(&result.outcome)).count()
    };
    let mut out = format!("{HEAD}>\n");
    for file in files {
        let name = escaped(&file.name);
        let failed = count(file, |outcome| matches!(outcome, Outcome::Failed(_)));
        let skipped = count(file, |outcome| matches!(outcome, Outcome::Skipped(_)));
        let tests = file.results.len();
        let _ = writeln!(
            out,
            "  <testsuite name=\"{name}\" tests=\"{tests}\" failures=\"{failed}\" skipped=\"{skipped}\">"
        );
        for Result { title, engine, outcome, .. } in &file.results {
            let on = engine.suffix();
            let _ = write!(
                out,
                "    <testcase classname=\"{name}\" name=\"{}\"",
                escaped(&format!("{title}{on}"))
            );
            match outcome {
                Outcome::Passed => out += "/>\n",
                Outcome::Skipped(why) => {
                    let _ = writeln!(out, "><skipped message=\"{}\"/></testcase>", escaped(why));
                }
                Outcome::Failed(failures) => {
                    out += ">\n";
                    for failure in failures {
                        let line = file.sources.position(failure.place).0;
                        let message =
                            escaped(&format!("{}:{line}: {}", file.name, place_text(file, failure)));
                        let text = escaped(&failure.text());
                        let _ = writeln!(out, "      <failure message=\"{message}\">{text}</failure>");
                    }
                    out += "    </testcase>\n";
                }
            }
        }
        out += "  </testsuite>\n";
    }
    for NotRun { name, first } in not_run {
        let (name, first) = (escaped(name), escaped(first));
        let _ = writeln!(
            out,
            "  <testsuite name=\"{name}\" tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\">\n    <testcase \
             classname=\"{name}\" name=\"can be run\"><error message=\"{first}\"/></testcase>\n  </testsuite>"
        );
    }
    out + "</testsuites>\n"
}

/// As it may be in XML, in attributes too.
fn escaped(text: &str) -> String {
    plain::xml(&plain::lines(text))
}
