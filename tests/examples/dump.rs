fn main() {
    let args: Vec<String> = std::env::args().collect();
    let outcome = autogen_tests::ariac(&args[1]).compile();
    let p = outcome.project.unwrap();
    let w = autogen_tests::workspace::Workspace::write(&args[1], &p.system, &outcome.sources);
    w.put("line.txt", &p.plant.to_text());
    println!("{}", w.folder.display());
    std::mem::forget(w);
}
