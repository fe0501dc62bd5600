//! Files by their addresses, `file:///home/me/line.aut`.

use autogen::lsp::protocol::Uri;
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use std::path::{Path, PathBuf};

/// What stands as it is in the path of an address.
const ESCAPED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'.').remove(b'_').remove(b'~');

/// The file of this machine that is meant; none for other addresses.
pub fn path(uri: &Uri) -> Option<PathBuf> {
    let rest = uri.as_ref().strip_prefix("file://")?;
    let rest = &rest[rest.find('/')?..];
    let text = percent_decode_str(rest.split(['?', '#']).next()?).decode_utf8().ok()?;
    if text.contains('\0') {
        return None;
    }
    let text = match cfg!(windows) {
        true => text.strip_prefix('/')?,
        false => text.as_ref(),
    };
    Some(PathBuf::from(text))
}

/// The address of an absolute path.
pub fn of(path: &Path) -> Uri {
    let text = path.display().to_string();
    let text = match cfg!(windows) {
        true => format!("/{}", text.trim_start_matches(r"\\?\").replace('\\', "/")),
        false => text,
    };
    Uri(format!("file://{}", utf8_percent_encode(&text, ESCAPED)))
}

#[cfg(all(test, unix))]
mod tests {
    use super::{of, path};
    use std::path::Path;

    #[test]
    fn paths_come_back() {
        for name in ["/a b/größe #1?.aut", "/lines/100%/x.json", "/~/-_.aut"] {
            assert_eq!(path(&of(Path::new(name))).as_deref(), Some(Path::new(name)));
        }
        assert_eq!(path(&"file:///a%20b.aut".into()).as_deref(), Some(Path::new("/a b.aut")));
        assert_eq!(path(&"untitled:Untitled-1".into()), None);
        assert_eq!(path(&"file:///a%00b".into()), None);
    }
}
