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

fn write(folder: &Path, files: &Files, overwrite: Overwrite) -> Result<Vec<String>, Refusal> {
    let make = |sink: &mut dyn Sink| files.iter().for_each(|(name, text)| sink.file(name, text));
    open(folder).write(&[&make], about(), overwrite)
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
    write(&folder, &all, Overwrite::Own).expect("written");
    let written = folder.join("a/b.txt").metadata().and_then(|m| m.modified()).expect("a time");
    let more = files(&[("a/b.txt", "1"), ("c.txt", "3")]);
    write(&folder, &more, Overwrite::Own).expect("written");
    assert_eq!(text(folder.join("c.txt")).as_deref(), Some("3"));
    assert_eq!(folder.join("a/b.txt").metadata().and_then(|m| m.modified()).expect("a time"), written);
    write(&folder, &files(&[("c.txt", "3")]), Overwrite::Own).expect("written");
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
    let Err(Refusal::NotOurs(found)) = write(&folder, &all, Overwrite::Own) else {
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
    write(&folder, &files(&[("c.txt", "2")]), Overwrite::Own).expect("written");
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

#[test]
fn a_large_file_is_written_if_any_of_its_bytes_is_another_one() {
    let folder = folder("large");
    let large = "0123456789".repeat(250_000);
    let path = folder.join("a/large.txt");
    let write = |text: &str| {
        write(&folder, &files(&[("a/large.txt", text), ("b.txt", "1")]), Overwrite::Own).expect("written");
        assert!(fs::read_to_string(&path).expect("a file") == text);
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 3, "the manifest, `a` and `b.txt`");
    };
    let written = || path.metadata().and_then(|there| there.modified()).expect("a time");
    write(&large);
    let first = written();
    write(&large);
    assert_eq!(written(), first, "the same is not written again");
    let changed = |at: usize| format!("{}x{}", &large[..at], &large[at + 1..]);
    for other in [&large[..2_000_000], &large[..2_499_999], &large, &(large.clone() + "0"), &large[..10]] {
        write(other);
        write(&large);
    }
    for at in [0, 999_999, 1_000_000, 1_700_000, 2_499_999] {
        write(&changed(at));
        write(&large);
    }
    fs::write(&path, changed(1_700_000)).expect("a file");
    let refusal = super::tests::write(&folder, &files(&[("a/large.txt", &large)]), Overwrite::Own);
    assert!(matches!(refusal, Err(Refusal::NotOurs(found)) if found == [path.clone()]));
    assert!(fs::read_to_string(&path).expect("a file") == changed(1_700_000), "as it was");
    fs::remove_dir_all(&folder).expect("a folder");
}
