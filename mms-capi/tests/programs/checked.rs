//! Programs in C that misuse the library: each alone, with memory that ends at an inaccessible page, and with AddressSanitizer
//! and valgrind. More calls: `MMS_RANDOM_CALLS=1000000 cargo test -p mms-capi --test suite random`.

use super::{PREFIX, is_installed, quoted, root, run, scratch};
use crate::sampled::sampled_count;

/// valgrind makes one in this number of random calls: it takes 50 times as long.
const SHARE_OF_VALGRIND: u32 = 16;

/// The outputs of the program `NAME.c` of this folder, run in every way; `calls` makes its arguments for a number of calls,
/// which is smaller for valgrind.
fn every_way(name: &str, calls: impl Fn(u32) -> String) -> Vec<String> {
    let source = quoted(&root().join("tests/programs").join(name).with_extension("c"));
    let prefix = quoted(&PREFIX);
    let linked = format!(
        "-I{prefix}/include -L{prefix}/lib -lmms_capi -lpthread -lm -Wl,-rpath,{prefix}/lib"
    );
    let strict = "-std=c11 -g -O1 -Wall -Wextra -pedantic -Werror";
    let sanitized = "-DHEAP -fsanitize=address,undefined -fno-sanitize-recover=all";
    let valgrind = "valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite \
                    --errors-for-leak-kinds=definite";
    let mut said = Vec::new();
    for (kind, tools, options, runner, share) in [
        ("fenced", &["cc"][..], "", "", 1),
        ("sanitized", &["cc"], sanitized, "", 1),
        ("valgrind", &["cc", "valgrind"], "-DHEAP", valgrind, SHARE_OF_VALGRIND),
    ] {
        if tools.iter().all(|tool| is_installed(tool)) {
            let program = format!("{name}_{kind}");
            let build = format!("cc {strict} {options} {source} {linked} -o {program}");
            said.push(run(&format!("{build} && {runner} ./{program} {}", calls(share)), scratch()));
        }
    }
    said
}

#[test]
fn what_can_be_seen_to_be_wrong_is_refused() {
    for said in every_way("misuse", |_| String::new()) {
        assert!(said.ends_with(" calls\n"), "{said}");
    }
}

#[test]
fn random_calls_touch_nothing_that_is_not_theirs() {
    let number = |calls: String| calls.parse().expect("MMS_RANDOM_CALLS is a number");
    let calls =
        std::env::var("MMS_RANDOM_CALLS").map_or_else(|_| sampled_count(4000, 4) as u32, number);
    for said in every_way("random", |share| format!("{} 1", calls / share)) {
        println!("{said}");
        assert!(said.ends_with(" did what they are for\n"), "{said}");
    }
}
