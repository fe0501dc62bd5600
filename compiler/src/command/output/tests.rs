use super::*;
use serde_json::json;

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("autogen-output-{}", std::process::id())).join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn open(folder: &Path) -> Output {
    Output::open(folder, Vec::new(), || panic!("nobody else writes there")).expect("a folder")
}

fn files(texts: &[(&str, &str)]) -> Files {
    texts.iter().map(|(name, text)| (name.to_string(), text.to_string())).collect()
}

fn about() -> Map<String, Value> {
    Map::from_iter([("tool".to_string(), json!("test"))])
}

fn text(path: PathBuf) -> Option<String> {
    fs::read_to_string(path).ok()
}

#[test]
fn what_is_the_same_is_not_written_again() {
    let folder = folder("same");
    let all = files(&[("a/b.txt", "1"), ("c.txt", "2")]);
    open(&folder).write(&all, about(), Overwrite::Own).expect("written");
    let written = folder.join("a/b.txt").metadata().and_then(|m| m.modified()).expect("a time");
    let more = files(&[("a/b.txt", "1"), ("c.txt", "3")]);
    open(&folder).write(&more, about(), Overwrite::Own).expect("written");
    assert_eq!(text(folder.join("c.txt")).as_deref(), Some("3"));
    assert_eq!(folder.join("a/b.txt").metadata().and_then(|m| m.modified()).expect("a time"), written);
    open(&folder).write(&files(&[("c.txt", "3")]), about(), Overwrite::Own).expect("written");
    assert!(!folder.join("a").exists(), "an empty folder goes with its last file");
    fs::remove_dir_all(&folder).expect("a folder");
}

#[test]
fn a_refusal_names_all_and_leaves_no_folder() {
    let folder = folder("refusal");
    fs::create_dir_all(folder.join("a")).expect("a folder");
    fs::write(folder.join("a/b.txt"), "mine").expect("a file");
    fs::write(folder.join("c.txt"), "mine").expect("a file");
    let all = files(&[("a/b.txt", "1"), ("c.txt", "2"), ("d.txt", "3")]);
    let Err(Refusal::NotOurs(found)) = open(&folder).write(&all, about(), Overwrite::Own) else {
        panic!("two files are not ours")
    };
    assert_eq!(found, [folder.join("a/b.txt"), folder.join("c.txt")]);
    assert!(!folder.join("d.txt").exists());
    fs::remove_dir_all(&folder).expect("a folder");
    drop(open(&folder));
    assert!(!folder.exists(), "a folder into which nothing was written");
}

#[test]
fn names_that_lead_out_of_the_folder_are_none() {
    for name in ["", "/a", "../a", "a/../b", ".", "a/.", "C:\\a", "a\\b", "a/"] {
        assert!(!manifest::is_within(name), "{name}");
    }
    assert!(manifest::is_within("rust/controllers/src/robots/agv.rs"));
}

#[test]
fn a_manifest_knows_whether_it_was_changed() {
    let folder = folder("manifest");
    open(&folder).write(&files(&[("c.txt", "2")]), about(), Overwrite::Own).expect("written");
    assert!(Manifest::read(&folder).is_whole);
    let path = folder.join(MANIFEST);
    let whole = fs::read_to_string(&path).expect("a manifest");
    for changed in
        [whole.replace("test", "best"), whole.replace("  ", "    "), whole.replace("c.txt", "d.txt")]
    {
        fs::write(&path, changed).expect("a file");
        assert!(!Manifest::read(&folder).is_whole);
    }
    fs::write(&path, "{").expect("a file");
    assert!(Manifest::read(&folder).files.is_empty());
    fs::remove_dir_all(&folder).expect("a folder");
}
