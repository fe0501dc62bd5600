//! The page of a sweep, in a browser: what its charts and its table show.

use autogen::backend::report::sweep::{Column, Fact, Figure, Name, Row, Sweep, Table, Values};
use autogen_tests::browser;
use serde_json::Value;
use std::collections::BTreeMap;

/// Widths of the page for which charts are drawn, of a telephone, a window and a screen.
const WIDTHS: [&str; 3] = ["376", "876", "1576"];
const MIDDLE: &str = "876";

fn texts(values: &[&str]) -> Vec<String> {
    values.iter().map(ToString::to_string).collect()
}

fn words(title: &str, values: &[&str]) -> Name {
    Name { title: title.into(), values: Values::Words(texts(values)) }
}

fn numbers(title: &str, values: &[&str]) -> Name {
    Name { title: title.into(), values: Values::Numbers(texts(values)) }
}

/// Of one run.
fn row(at: &[usize], figure: impl Into<Option<f64>>) -> Row {
    let figure = figure.into();
    let count = usize::from(figure.is_some());
    Row {
        at: at.to_vec(),
        cells: vec![figure.map_or("-".into(), |figure| format!("{figure:.2}"))],
        reason: if count == 1 { "all orders made".into() } else { "time limit: order 8".into() },
        remarks: Vec::new(),
        runs: 1,
        finished_runs: count,
        measured_runs: count,
        figure,
        half_width: None,
    }
}

/// Of ten runs.
fn mean(at: &[usize], figure: f64, half_width: f64) -> Row {
    let half_width = Some(half_width);
    Row { runs: 10, finished_runs: 10, measured_runs: 10, half_width, ..row(at, figure) }
}

fn sweep(names: Vec<Name>, rows: Vec<Row>) -> Sweep {
    let columns = vec![Column { title: "s/order", about: "seconds per order" }];
    Sweep {
        title: "Sweep".into(),
        facts: Vec::new(),
        figure: Figure::SecondsPerOrder,
        names,
        table: Table { columns, rows },
        kept: BTreeMap::new(),
    }
}

/// Rows of one layout, with a value each.
fn by_number(values: &[&str], figures: &[Option<f64>]) -> Sweep {
    let rows = figures.iter().enumerate().map(|(i, figure)| row(&[0, i], *figure)).collect();
    sweep(vec![words("layout", &["a"]), numbers("speed", values)], rows)
}

fn by_word(values: &[&str]) -> Sweep {
    let rows = (0..values.len()).map(|i| row(&[i], 60.0 + i as f64)).collect();
    sweep(vec![words("layout", values)], rows)
}

/// What the page shows; there is no browser to show it in if this is none.
fn shown(name: &str, sweep: &Sweep) -> Option<Value> {
    found(name, sweep, include_str!("../fixtures/report/sweep.js"))
}

/// What a script finds in the page.
fn found(name: &str, sweep: &Sweep, script: &str) -> Option<Value> {
    let browser = browser::browser()?;
    let found = browser::found(browser, &format!("sweep-{name}"), &sweep.html(), script);
    let found: Value = serde_json::from_str(&found).expect("JSON");
    assert_eq!(found["errors"], Value::Array(Vec::new()), "{name}");
    Some(found)
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("no {key}: {value}"))
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_else(|| panic!("no {key}: {value}"))
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("no {key}: {value}"))
}

/// The row of a chart of which the text says this.
fn mark<'a>(chart: &'a Value, about: &str) -> &'a Value {
    let found = list(chart, "rows").iter().find(|row| text(row, "about").contains(about));
    found.unwrap_or_else(|| panic!("no {about}: {chart}"))
}

fn x(mark: &Value) -> f64 {
    mark["at"][0].as_f64().expect("a number")
}

fn y(mark: &Value) -> f64 {
    mark["at"][1].as_f64().expect("a number")
}

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.5
}

/// Two layouts by values that are not in their order; one of them comes to a figure with the last value alone.
fn of_two_layouts() -> Sweep {
    let figures =
        [[Some(67.0), Some(74.0), None, Some(67.0)], [Some(73.0), None, None, None]].into_iter().enumerate();
    let rows = figures.flat_map(|(layout, of)| {
        of.into_iter().enumerate().map(move |(i, figure)| row(&[layout, i], figure))
    });
    let rows = rows.collect();
    sweep(vec![words("layout", &["a", "b"]), numbers("capacity", &["8", "2", "100", "4"])], rows)
}

#[test]
fn a_line_joins_rows_that_differ_in_one_value() {
    let Some(found) = shown("lines", &of_two_layouts()) else { return };
    let [by_layout, by_capacity] = list(&found["widths"], MIDDLE) else { panic!("two charts") };
    assert_eq!(text(by_capacity, "title"), "Seconds per order by capacity");
    assert_eq!(by_capacity["legend"], serde_json::json!(["layout a", "layout b"]));
    let mut joined: Vec<usize> =
        list(by_capacity, "lines").iter().map(|d| d.as_str().expect("a text").matches('L').count()).collect();
    joined.sort_unstable();
    assert_eq!(joined, [0, 2], "three values of a, one of b");
    assert_eq!(list(by_layout, "lines").len(), 0, "layouts have no order");
    assert_eq!(list(by_layout, "legend").len(), 4);
}

#[test]
fn a_row_without_a_figure_is_a_cross_at_the_axis() {
    let Some(found) = shown("crosses", &of_two_layouts()) else { return };
    for chart in list(&found["widths"], MIDDLE) {
        assert_eq!(list(chart, "rows").len(), 8);
        let crosses: Vec<&Value> = list(chart, "rows").iter().filter(|row| row["kind"] == "cross").collect();
        assert_eq!(crosses.len(), 4);
        for cross in crosses {
            assert!(is_near(y(cross), number(&chart["axis"], "top")), "{cross}");
            assert!(text(cross, "about").ends_with(": time limit: order 8"), "{cross}");
        }
        assert!(text(chart, "notes").contains("Crosses: 4 of 8 rows without a figure."));
    }
    // One figure is enough for a chart, and none is too.
    for figures in [[Some(1.0), None], [None, None]] {
        let Some(found) = shown("few", &by_number(&["1", "2"], &figures)) else { return };
        let [chart] = list(&found["widths"], MIDDLE) else { panic!("a chart") };
        assert_eq!(list(chart, "rows").len(), 2);
    }
}

#[test]
fn numbers_are_to_scale_and_a_gap_ends_a_line() {
    let figures = [67.0, 74.0, 70.0, 67.0].map(Some);
    let Some(found) = shown("scale", &by_number(&["8", "2", "100", "4"], &figures)) else { return };
    let chart = &found["widths"][MIDDLE][0];
    let at = |value: &str| x(mark(chart, &format!("speed {value}:")));
    assert!(is_near((at("4") - at("2")) / (at("100") - at("2")) * 980.0, 20.0), "{chart}");
    assert!(is_near((at("8") - at("2")) / (at("100") - at("2")) * 980.0, 60.0), "{chart}");
    assert_eq!(text(chart, "axis_name"), "speed");

    let figures = [Some(10.0), None, Some(12.0), Some(13.0)];
    let Some(found) = shown("gap", &by_number(&["1", "2", "3", "4"], &figures)) else { return };
    let line = found["widths"][MIDDLE][0]["lines"][0].as_str().expect("a line");
    assert_eq!((line.matches('M').count(), line.matches('L').count()), (2, 1), "{line}");

    // The figure of 100 times 1 is as far from 10 as 10 is from 1.
    let values = ["1", "2", "5", "10", "20", "50", "100"];
    let figures: Vec<Option<f64>> = (0..7).map(|i| Some(60.0 + f64::from(i))).collect();
    let Some(found) = shown("ratio", &by_number(&values, &figures)) else { return };
    let chart = &found["widths"][MIDDLE][0];
    let at = |value: &str| x(mark(chart, &format!("speed {value}:")));
    assert!(is_near(at("10") - at("1"), at("100") - at("10")), "{chart}");
    assert_eq!(text(chart, "axis_name"), "speed (logarithmic scale)");
}

#[test]
fn a_row_of_some_of_its_runs_is_hollow_and_not_the_best() {
    let few = Row { finished_runs: 4, measured_runs: 4, ..mean(&[0, 0], 60.0, 2.0) };
    let names = || vec![words("layout", &["a"]), numbers("speed", &["1", "2"])];
    let mut sweep = sweep(names(), vec![few, mean(&[0, 1], 70.0, 3.0)]);
    let Some(found) = shown("hollow", &sweep) else { return };
    let chart = &found["widths"][MIDDLE][0];
    let few = mark(chart, "row 1:");
    assert_eq!(few["kind"], "mark hollow");
    assert!(text(few, "about").ends_with("60.00 ± 2.00 s, 4 of 10 runs"), "{few}");
    assert_eq!(mark(chart, "row 2:")["kind"], "mark");
    let notes = text(chart, "notes");
    assert!(notes.contains("Hollow: 1 of 2 rows") && notes.contains("mostly too small"), "{notes}");
    assert_eq!(
        found["figures"],
        serde_json::json!([
            ["rows", "2"],
            ["all orders made", "1 of 2"],
            ["least seconds per order of rows with all runs", "70.00, row 2"],
        ])
    );
    sweep.figure = Figure::ItemsPerHour;
    let Some(found) = shown("hollow-items", &sweep) else { return };
    let notes = text(&found["widths"][MIDDLE][0], "notes");
    assert!(notes.contains("Hollow: 1 of 2 rows") && !notes.contains("too small"), "{notes}");
}

#[test]
fn rows_with_the_same_figure_are_all_the_best() {
    let figures = [70.0, 67.001, 67.0, 80.0].map(Some);
    let Some(found) = shown("best", &by_number(&["1", "2", "3", "4"], &figures)) else { return };
    assert_eq!(found["figures"][2], serde_json::json!(["least seconds per order", "67.00, rows 2, 3"]));
}

#[test]
fn intervals_stay_in_the_chart_and_stand_beside_one_another() {
    let names = vec![words("layout", &["a", "b"]), numbers("capacity", &["2", "4"])];
    let rows = vec![
        mean(&[0, 0], 49.0, 420.0),
        mean(&[0, 1], 60.0, 20.0),
        mean(&[1, 0], 52.0, 8.0),
        mean(&[1, 1], 55.0, 3.0),
    ];
    let Some(found) = shown("whiskers", &sweep(names, rows)) else { return };
    for width in WIDTHS {
        for chart in list(&found["widths"], width) {
            for row in list(chart, "rows") {
                let whisker = &row["whisker"];
                let is_inside = number(whisker, "top") >= number(&chart["drawing"], "top")
                    && number(whisker, "bottom") <= number(&chart["axis"], "bottom") + 1.0;
                assert!(is_inside, "{width}: {row}");
            }
            let arrows = |about| text(&mark(chart, about)["whisker"], "d").matches('L').count();
            assert_eq!((arrows("± 420.00"), arrows("± 20.00")), (4, 0), "{width}");
            assert!(text(chart, "notes").contains("An arrow: "));
            // Half of it is as far above as the mean of 60 s is under it.
            let whole = &mark(chart, "± 20.00")["whisker"];
            assert!(number(whole, "bottom") - number(whole, "top") > 50.0, "{whole}");
        }
        let by_capacity = &found["widths"][width][1];
        let apart = x(mark(by_capacity, "± 420.00")) - x(mark(by_capacity, "± 8.00"));
        assert!(apart.abs() > 4.0, "{width}: {apart}");
    }
}

/// Round numbers, all different, and none over another or outside of the drawing.
fn check_ticks(name: &str, chart: &Value) {
    let ticks = list(chart, "ticks");
    assert!((2..=8).contains(&ticks.len()), "{name}: {ticks:?}");
    for pair in ticks.windows(2) {
        let [low, high] = [0, 1].map(|i| text(&pair[i], "text").parse::<f64>().expect("a number"));
        assert!(low < high, "{name}: {pair:?}");
        let step = high - low;
        let digit = step / 10_f64.powf((step * 1.000_001).log10().floor());
        assert!([1.0, 2.0, 5.0].iter().any(|round| (digit - round).abs() < 1e-3), "{name}: {pair:?}");
        assert!(number(&pair[0], "top") > number(&pair[1], "bottom") - 4.0, "{name}: {pair:?}");
    }
    for tick in ticks {
        assert!(number(tick, "left") >= number(&chart["drawing"], "left"), "{name}: {tick}");
    }
}

/// Names of values, none over another or outside of the drawing, and no two the same.
fn check_values(name: &str, chart: &Value) {
    let values = list(chart, "values");
    assert!(!values.is_empty(), "{name}");
    for value in values {
        for (side, sign) in [("left", 1.0), ("right", -1.0), ("bottom", -1.0)] {
            let inside = sign * (number(value, side) - number(&chart["drawing"], side));
            assert!(inside >= -1.0, "{name}: {side} of {value} in {}", chart["drawing"]);
        }
    }
    for pair in values.windows(2) {
        // Turned ones end at their value.
        let is_clear = if pair[0]["turn"] == true {
            number(&pair[1], "right") - number(&pair[0], "right") > 12.0
        } else {
            number(&pair[1], "left") > number(&pair[0], "right")
        };
        assert!(is_clear, "{name}: {pair:?}");
        assert_ne!(text(&pair[0], "text"), text(&pair[1], "text"), "{name}");
    }
}

#[test]
fn axes_can_be_read_at_any_width() {
    let close = ["30.123457", "33.4", "36.723457", "40.023457", "43.3", "46.62", "49.9", "53.22", "56.5"];
    let many: Vec<String> = (1..=400).map(|n| n.to_string()).collect();
    let many: Vec<&str> = many.iter().map(String::as_str).collect();
    let all = |count: usize| (0..count).map(|i| Some(60.0 + i as f64)).collect::<Vec<_>>();
    let long = ["A", "B"].map(|end| format!("a_very_long_name_of_a_layout_{end}_that_goes_on_and_on.json"));
    let variants: Vec<String> = (1..=12).map(|n| format!("line_variant_of_a_vehicle_{n:02}")).collect();
    let variants: Vec<&str> = variants.iter().map(String::as_str).collect();
    for (name, sweep) in [
        ("large", by_number(&["1", "2"], &[Some(1_234_567.8), Some(987_654.3)])),
        ("small", by_number(&["1", "2"], &[Some(0.12), Some(0.06)])),
        ("zeros", by_number(&["1", "2"], &[Some(0.0), Some(0.0)])),
        ("close", by_number(&["90", "90.0002", "90.0005"], &[Some(90.0), Some(90.0002), Some(90.0005)])),
        ("long numbers", by_number(&close, &all(9))),
        ("many", by_number(&many, &all(400))),
        ("uneven", by_number(&["0.01", "1", "1000", "10000", "24000"], &all(5))),
        ("long words", by_word(&[&long[0], &long[1], "default"])),
        ("variants", by_word(&variants)),
        ("many words", by_word(&many)),
    ] {
        let Some(found) = shown(&name.replace(' ', "-"), &sweep) else { return };
        for width in WIDTHS {
            let name = format!("{name} at {width}");
            let [chart] = list(&found["widths"], width) else { panic!("{name}: a chart") };
            check_ticks(&name, chart);
            check_values(&name, chart);
            assert!(text(chart, "label").starts_with("Seconds per order by "), "{name}");
        }
    }
}

/// Values near the ends of what a double holds.
#[test]
fn numbers_without_a_common_measure_have_a_chart_too() {
    let figures = [Some(60.0), Some(61.0), Some(62.0)];
    for (name, values) in [
        ("tiny", ["1e-150", "2e-150", "1e-148"]),
        ("without_distance", ["1.5e308", "0", "-1.5e308"]),
        ("tiny_and_large", ["1e-150", "1", "1e150"]),
    ] {
        let Some(found) = shown(name, &by_number(&values, &figures)) else { return };
        for width in WIDTHS {
            let [chart] = list(&found["widths"], width) else { panic!("{name} at {width}: a chart") };
            assert_eq!(list(chart, "rows").len(), 3, "{name} at {width}: {chart}");
            assert!(!chart.to_string().contains("NaN"), "{name} at {width}: {chart}");
        }
    }
}

#[test]
fn of_many_combinations_eight_have_a_colour() {
    let names = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j"];
    let rows = (0..20).map(|i| row(&[i / 2, i % 2], 60.0 + i as f64)).collect();
    let sweep = sweep(vec![words("layout", &names), numbers("speed", &["1", "2"])], rows);
    let Some(found) = shown("colours", &sweep) else { return };
    let by_speed = &found["widths"][MIDDLE][1];
    let legend = list(by_speed, "legend");
    assert_eq!(legend.len(), 9);
    assert_eq!(legend[8], "grey: 2 more combinations");
    assert_eq!(list(by_speed, "lines").len(), 10);
}

#[test]
fn the_table_has_the_cells_of_the_text_and_a_total_order() {
    let values = ["8", "NaN", "true", "two", "1", "2", "4", "100"];
    let cells = ["+0.10", "-", "same", "-0.20", "4 of 10", "10 of 10", "-", "1000.00"];
    let rows = cells.iter().enumerate().map(|(i, cell)| Row { cells: texts(&[cell]), ..row(&[i], 60.0) });
    let mut rows: Vec<Row> = rows.collect();
    let hostile = "<img src=x onerror=errors.push(1)>";
    rows[7].reason = format!("E0503: {hostile}");
    rows[7].remarks = texts(&["help: write a whole number from 1 to 12"]);
    let mut sweep = sweep(vec![words(hostile, &values)], rows);
    sweep.facts = vec![Fact { name: "scenario", value: hostile.into() }];
    sweep.title = hostile.into();
    sweep.kept.insert(2, "./runs/row-2.html".into());
    let Some(found) = shown("table", &sweep) else { return };
    assert_eq!(found["heads"], serde_json::json!(["row", hostile, "s/order", "reason"]));
    assert_eq!(found["abouts"][2], "seconds per order");
    assert_eq!(found["rows"][1], serde_json::json!(["2: report", "NaN", "-", "all orders made"]));
    assert_eq!(found["links"], serde_json::json!(["./runs/row-2.html"]));
    assert_eq!(
        found["rows"][7][3],
        format!("E0503: {hostile}help: write a whole number from 1 to 12").as_str()
    );
    let sorted = &found["sorted"];
    assert_eq!(sorted[hostile], serde_json::json!(["1", "2", "4", "8", "100", "NaN", "true", "two"]));
    let cells = ["-0.20", "same", "+0.10", "4 of 10", "10 of 10", "1000.00", "-", "-"];
    assert_eq!(sorted["s/order"], serde_json::json!(cells));
    assert_eq!((&found["title"], &found["facts"]["scenario"]), (&hostile.into(), &hostile.into()));
    assert_eq!(found["images"], 0);
}

#[test]
fn paper_has_all_rows() {
    let values: Vec<String> = (1..=400).map(|n| n.to_string()).collect();
    let values: Vec<&str> = values.iter().map(String::as_str).collect();
    let figures = vec![Some(60.0); 400];
    let Some(found) = shown("paper", &by_number(&values, &figures)) else { return };
    assert_eq!((list(&found, "rows").len(), &found["printed"]), (100, &400.into()));
}

#[test]
fn a_page_of_many_rows_is_shown() {
    const ROWS: usize = 140_000;
    let values: Vec<String> = (0..ROWS).map(|n| n.to_string()).collect();
    let values: Vec<&str> = values.iter().map(String::as_str).collect();
    let figures: Vec<Option<f64>> =
        (0..ROWS).map(|n| (n % 50 != 7).then_some(60.0 + (n % 977) as f64)).collect();
    let script = "const found = document.createElement('pre');
        found.id = 'found';
        found.textContent = JSON.stringify({
            errors,
            rows: document.querySelectorAll('#rows tbody tr').length,
            figures: document.getElementById('figures').textContent,
            drawn: document.querySelector('.chart .mark').getAttribute('d').length,
            notes: document.querySelector('.notes-of-chart').textContent,
        });
        document.body.append(found);";
    let Some(found) = found("many-rows", &by_number(&values, &figures), script) else { return };
    assert!(text(&found, "figures").starts_with("rows140000"), "{found}");
    assert_eq!(found["rows"], 100);
    assert!(number(&found, "drawn") > ROWS as f64);
    assert!(text(&found, "notes").contains("too many rows for texts at the marks"), "{found}");
}

/// Nothing is fetched, and nothing that could be is named.
#[test]
fn the_page_of_a_sweep_names_nothing_outside_of_it() {
    let page = of_two_layouts().html();
    // The name of a namespace is no address.
    let page = page.replace("'http://www.w3.org/2000/svg'", "");
    for outside in ["http:", "https:", "src=", "href=", "@import", "url(", "fetch(", "import("] {
        assert!(!page.contains(outside), "{outside}");
    }
}
