//! How `commission` compiles the controllers.

use super::*;

/// Of public items without a description there are many.
#[test]
fn flags_that_make_warnings_errors_are_those_of_the_user_s_own_code() {
    let folder = folder("flags_of_rustc");
    for (name, flags) in
        [("RUSTFLAGS", "-D missing_docs"), ("CARGO_ENCODED_RUSTFLAGS", "-D\u{1f}missing_docs")]
    {
        let output = Command::new(env!("CARGO_BIN_EXE_autogen"))
            .args(["commission", &example("scenes/lifting_table.json"), "-o", name])
            .current_dir(&folder)
            .env("XDG_CACHE_HOME", folder.join(format!("cache of {name}")))
            .env(name, flags)
            .output()
            .expect("autogen can be started");
        assert_eq!(status(&output), 0, "{name}: {}", errors(&output));
    }
}
