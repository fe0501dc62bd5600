//! `autogen new`: a small line to begin with.

use super::copies;
use super::interrupt;
use super::io_error;
use super::options::NewOptions;
use crate::Status;
use autogen::plain;
use std::fs;
use std::io;
use std::path::Path;

/// Names and texts; `{name}` in them is the name of the folder.
const FILES: [(&str, &str); 5] = [
    ("line.json", include_str!("../../templates/new/line.json")),
    ("scenario.json", include_str!("../../templates/new/scenario.json")),
    ("specs/stamp.aut", include_str!("../../templates/new/stamp.aut")),
    ("station.test", include_str!("../../templates/new/station.test")),
    ("README.md", include_str!("../../templates/new/README.md")),
];

pub fn run(options: &NewOptions) -> Status {
    let folder = &options.folder;
    let shown = folder.display();
    if let Err(why) = is_free(folder).and_then(|()| write(folder)) {
        complain!("autogen: {shown}: {why}");
        return Status::WrongCommand;
    }
    if !options.quiet {
        let line = folder.join("line.json");
        say!("{shown} has a line with one machine. The next commands:");
        say!("  autogen test {}", quoted(folder));
        say!("  autogen check {}", quoted(&line));
        say!("  autogen commission {}", quoted(&line));
    }
    Status::Done
}

/// A path as a shell takes it.
fn quoted(path: &Path) -> String {
    copies::quoted(&copies::argument(path.display().to_string()))
}

/// Nothing is written over: the folder is new, or empty.
fn is_free(folder: &Path) -> Result<(), String> {
    match folder.symlink_metadata() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(error.to_string()),
        Ok(there) if !there.is_dir() => return Err("this is not a folder; choose another name".into()),
        Ok(_) => {}
    }
    let mut entries = folder.read_dir().map_err(|e| e.to_string())?;
    match entries.next() {
        None => Ok(()),
        Some(_) => Err("this folder has files, which are not overwritten: choose another name".into()),
    }
}

fn write(folder: &Path) -> Result<(), String> {
    let failed = |e: io::Error| format!("{}; all files of the line were removed", io_error::text(&e));
    let absolute = std::path::absolute(folder).map_err(failed)?;
    let name = absolute.file_name().map_or("line".into(), |name| plain::line(&name.to_string_lossy()));
    let _writing = interrupt::writing();
    let was_there = folder.exists();
    let written = FILES.iter().try_for_each(|(file, text)| {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().unwrap_or(folder))?;
        fs::write(path, text.replace("{name}", &name))
    });
    if written.is_err() {
        for (file, _) in FILES {
            let _ = fs::remove_file(folder.join(file));
        }
        let _ = fs::remove_dir(folder.join("specs"));
        if !was_there {
            let _ = fs::remove_dir(folder);
        }
    }
    written.map_err(failed)
}
