//! The header equals the output of cbindgen. After a change, `MMS_BLESS=1 cargo test -p mms-capi --test header` writes it.

use std::fs;
use std::path::Path;

#[test]
fn the_header_is_that_of_the_functions() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("a configuration");
    let bindings = cbindgen::Builder::new()
        .with_config(config)
        .with_src(root.join("src/abi.rs"))
        .with_src(root.join("src/error.rs"))
        .with_src(root.join("src/field.rs"))
        .with_src(root.join("src/stop.rs"))
        .generate()
        .expect("sources that can be read");
    let mut header = Vec::new();
    bindings.write(&mut header);
    let path = root.join("include/mms_capi.h");
    if std::env::var_os("MMS_BLESS").is_some() {
        fs::write(&path, &header).expect("a written file");
    }
    let header = String::from_utf8(header).expect("text");
    assert!(
        fs::read_to_string(&path).is_ok_and(|written| written == header),
        "include/mms_capi.h is not what src/abi.rs says: MMS_BLESS=1 cargo test -p mms-capi --test suite header"
    );
}
