//! A page in a real browser without a window.

use std::path::PathBuf;
use std::process::{Command, Stdio};

/// The browser's names where packages put it.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
/// Milliseconds that pass for the page; they pass as fast as it can work.
const PASSES_MS: u32 = 20_000;
/// Before all scripts of the page.
const WATCH: &str = "<script>window.errors = [];
addEventListener('error', (event) => errors.push(`${event.message} in line ${event.lineno}`));
addEventListener('unhandledrejection', (event) => errors.push(String(event.reason)));
addEventListener('securitypolicyviolation', (event) => errors.push(`${event.violatedDirective}: ${event.blockedURI}`));
</script>";

/// A browser that can be started; in a run of CI there has to be one.
pub fn browser() -> Option<&'static str> {
    let answers = |name: &&str| {
        let quiet = Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        quiet.is_ok_and(|status| status.success())
    };
    let found = NAMES.into_iter().find(|name| answers(name));
    let is_required = std::env::var("AUTOGEN_JUDGES").is_ok_and(|judges| judges == "required");
    assert!(found.is_some() || !is_required, "no browser is installed: see .ci/run");
    if found.is_none() {
        println!("skipped: no browser is installed (chromium)");
    }
    found
}

/// What stands in the element `found` of the page when its script and then this one have run.
pub fn found(browser: &str, name: &str, page: &str, script: &str) -> String {
    let folder = std::env::temp_dir().join(format!("autogen-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder that can be written");
    let path: PathBuf = folder.join("report.html");
    let page = page.replacen("<head>", &format!("<head>{WATCH}"), 1);
    let page = page.replacen("</body>", &format!("<script>{script}</script></body>"), 1);
    std::fs::write(&path, page).expect("a file that can be written");
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--window-size=1280,900", "--dump-dom"])
        .arg(format!("--virtual-time-budget={PASSES_MS}"))
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg(format!("file://{}", path.display()))
        .output()
        .expect("the browser can be started");
    let _ = std::fs::remove_dir_all(&folder);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let found = text.split_once("<pre id=\"found\">").and_then(|(_, rest)| rest.split_once("</pre>"));
    match found {
        Some((found, _)) => found.to_string(),
        None => panic!("{name}: the page has no result: {}", String::from_utf8_lossy(&output.stderr)),
    }
}
