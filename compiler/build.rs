//! Lists the sources of the simulator, which the binary carries and writes beside the controllers, and names the
//! target for which it is compiled.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime-sim");
    println!("cargo:rerun-if-changed={}", root.join("src").display());
    let mut files = Vec::new();
    collect(&root.join("src"), &mut files);
    files.sort();
    let mut table = String::from("&[\n");
    for file in files {
        let name =
            file.strip_prefix(&root).expect("a file of the crate").to_string_lossy().replace('\\', "/");
        let path = fs::canonicalize(&file).expect("a file that exists");
        writeln!(table, "    ({name:?}, include_str!({path:?})),").expect("a text grows");
    }
    table.push(']');
    println!("cargo:rustc-env=AUTOGEN_TARGET={}", env::var("TARGET").expect("set by cargo"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by cargo"));
    fs::write(out.join("runtime_sim.rs"), table).expect("the build folder can be written");
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the crate") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}
