//! What an error of the system means for somebody who does not know its words.

use std::io::{self, ErrorKind};

/// The error, and what to do about it if that is known.
pub fn text(error: &io::Error) -> String {
    let help = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            "the disk is full: delete files, or name a folder on another disk"
        }
        ErrorKind::PermissionDenied => {
            "you have no permission for this here: change the permissions, or name another folder"
        }
        ErrorKind::ReadOnlyFilesystem => "nothing can be written here: name a folder on another disk",
        _ => return error.to_string(),
    };
    format!("{error}; {help}")
}

#[cfg(test)]
mod tests {
    use super::text;
    use std::io;

    #[test]
    fn what_can_be_done_is_said() {
        assert!(text(&io::ErrorKind::StorageFull.into()).contains("delete files"));
        assert!(text(&io::ErrorKind::PermissionDenied.into()).contains("change the permissions"));
        assert_eq!(text(&io::Error::other("no more")), "no more");
    }
}
