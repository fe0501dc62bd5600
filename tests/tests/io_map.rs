//! Tables of addresses: what is wrong with them, what the text looks like with one, and that it does the same.

use autogen::backend::{Files, st};
use autogen::diagnostic::render_plain;
use autogen::io_map::{self, Counting, IoMap};
use autogen::ir::System;
use autogen::lower::Project;
use autogen::source::Sources;
use autogen_tests::instances::instantiate;
use autogen_tests::lots::Lots;
use autogen_tests::st::Emitted;
use autogen_tests::wired::{self, Wired};
use autogen_tests::{LAYOUTS, ariac, root, text};
use runtime_sim::scan::Controllers;

fn project(layout: &str) -> (Project, Sources) {
    let outcome = ariac(layout).compile();
    (outcome.project.expect("a layout that can be built"), outcome.sources)
}

/// The files with a table of the fixtures.
fn with_table(system: &System, sources: &Sources, name: &str) -> Result<Files, String> {
    let mut tables = Sources::default();
    let file = tables.add(name, text(&format!("tests/fixtures/io/{name}")));
    match io_map::read(&tables, file, &st::points(system), Counting::Words) {
        Ok(map) => Ok(with_xml(system, sources, &map)),
        Err(found) => Err(render_plain(&tables, &found)),
    }
}

/// Text and PLCopen XML.
fn with_xml(system: &System, sources: &Sources, map: &IoMap) -> Files {
    let (mut files, _) = st::mapped(system, sources, map);
    files.extend(st::plcopen(system, sources, map));
    files
}

/// What differs between two texts, line by line of the second.
fn added(before: &str, after: &str) -> String {
    let mut old: Vec<&str> = before.lines().collect();
    let new = after.lines().filter(|line| match old.iter().position(|o| o == line) {
        Some(at) => {
            old.remove(at);
            false
        }
        None => true,
    });
    new.map(|line| format!("{line}\n")).collect()
}

#[test]
fn wrong_tables_are_explained() {
    let (project, sources) = project("default");
    let mut names: Vec<_> = std::fs::read_dir(root().join("tests/fixtures/io"))
        .expect("the folder of tables")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.starts_with("wrong_"))
        .collect();
    names.sort();
    assert!(!names.is_empty());
    for name in names {
        let found = with_table(&project.system, &sources, &name).expect_err(&name);
        let table = text(&format!("tests/fixtures/io/{name}"));
        insta::assert_snapshot!(name.trim_end_matches(".csv"), format!("{table}\n----\n{found}"));
    }
}

#[test]
fn a_point_of_each_kind_gets_an_address() {
    let (project, sources) = project("default");
    let before = with_xml(&project.system, &sources, &IoMap::default());
    let after = with_table(&project.system, &sources, "each_kind.csv").expect("a table without errors");
    let mut shown = text("tests/fixtures/io/each_kind.csv");
    for (path, text) in &after {
        let old = before.get(path).map_or("", String::as_str);
        let new = added(old, text);
        let is_shown = |line: &&str| !path.ends_with(".xml") || line.contains(" address=");
        if text != old && !["bounds.txt", "codesys/F_rounded.st"].contains(&path.as_str()) {
            let new: String = new.lines().filter(is_shown).map(|line| format!("{line}\n")).collect();
            shown += &format!("\n---- {path}\n{new}");
        }
    }
    insta::assert_snapshot!("each_kind", shown);
}

#[test]
fn the_table_that_is_written_gives_the_same_text() {
    let (project, sources) = project("default");
    let points = st::points(&project.system);
    let again = |files: &Files| {
        let mut tables = Sources::default();
        let file = tables.add("io.csv", files["io.csv"].as_str());
        let map = io_map::read(&tables, file, &points, Counting::Apart).expect("a table without errors");
        st::mapped(&project.system, &sources, &map).0
    };
    let (plain, plain_columns) = st::mapped(&project.system, &sources, &IoMap::default());
    assert_eq!(again(&plain), plain);
    for seed in 1..=3 {
        let map = wired::map(&points, &wired::drawn(&points, seed));
        let (files, columns) = st::mapped(&project.system, &sources, &map);
        // An I/O trace is of the values, not of what stands at the addresses.
        assert_eq!(columns.to_text(), plain_columns.to_text());
        assert_ne!(files["portable/main.st"], plain["portable/main.st"]);
        assert_eq!(again(&files), files);
    }
}

#[test]
fn tables_of_spreadsheets_are_read_alike() {
    let (project, sources) = project("default");
    let points = st::points(&project.system);
    let read = |text: String| {
        let mut tables = Sources::default();
        let file = tables.add("io.csv", text);
        io_map::read(&tables, file, &points, Counting::Words)
            .unwrap_or_else(|found| panic!("{}", render_plain(&tables, &found)))
    };
    let commas = text("tests/fixtures/io/each_kind.csv");
    let wanted = read(commas.clone());
    assert_eq!(read(commas.replace('\n', "\r\n")), wanted);
    assert_eq!(read(commas.replace(',', ";").replace("0.001", "\"0,001\"")), wanted);
    assert_eq!(read(commas.replace(',', "\t").replace("0.001", "0,001")), wanted);
    let mut lines: Vec<&str> = commas.lines().collect();
    lines[1..].reverse();
    assert_eq!(read(lines.join("\n")), wanted);
    assert_eq!(
        st::mapped(
            &project.system,
            &sources,
            &read(String::from("name,robot,address,raw type,scale,offset,inversion,cabinet\n"))
        )
        .0,
        st::files(&project.system, &sources)
    );
}

/// The text of a system with a table drawn by lot, beside the executor.
fn beside<'s>(system: &'s System, sources: &Sources, seed: u64) -> Wired<'s> {
    let points = st::points(system);
    let rows = wired::drawn(&points, seed);
    let (files, _) = st::mapped(system, sources, &wired::map(&points, &rows));
    Wired::new(system, &Emitted::of(&files), &points, &rows)
        .unwrap_or_else(|error| panic!("table {seed}: {error}"))
}

fn drawn(wired: &mut Wired, system: &System, seed: u64, scans: usize) {
    let mut lots = Lots::new(system, seed);
    let mut outputs = vec![Vec::new(); system.instances.len()];
    for _ in 0..scans {
        let given = lots.next(system, &outputs);
        wired.scan(given, &lots.images, &mut outputs);
    }
}

fn same(wired: &Wired, name: &str) -> u64 {
    println!(
        "{name}: {} scans, {} words, {} raw values",
        wired.beside.scans, wired.beside.words, wired.compared
    );
    assert_eq!(wired.difference, None, "{name}");
    assert!(wired.compared > 0, "{name}");
    wired.beside.scans
}

#[test]
fn layouts_with_a_table_are_the_same_to_one_raw_step() {
    let mut scans = 0;
    for layout in LAYOUTS {
        let (project, sources) = project(layout);
        for seed in 1..=3 {
            let mut wired = beside(&project.system, &sources, seed);
            drawn(&mut wired, &project.system, seed, 2000);
            scans += same(&wired, &format!("{layout}, table {seed}, drawn inputs"));
        }
        let mut wired = beside(&project.system, &sources, 4);
        runtime_sim::run::run(&project.plant, &mut wired, runtime_sim::run::Stepping::EveryScan, &mut |_| {})
            .expect("a line that can be run");
        scans += same(&wired, &format!("{layout}, table 4, simulator"));
    }
    println!("{scans} scans");
}

#[test]
fn fixtures_with_a_table_are_the_same_to_one_raw_step() {
    let mut files: Vec<_> = std::fs::read_dir(root().join("tests/fixtures/rust"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    files.sort();
    for name in files {
        let (system, sources) = instantiate(&[(name.clone(), text(&format!("tests/fixtures/rust/{name}")))]);
        for seed in 1..=3 {
            let mut wired = beside(&system, &sources, seed);
            drawn(&mut wired, &system, seed, 1000);
            same(&wired, &format!("{name}, table {seed}"));
        }
    }
}
