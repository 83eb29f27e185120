//! Arbitrary bytes as a file of results: reading them ends, with results or with a mistake, and so does what is made of
//! them. The seeds are the files in `mms-results/tests/data`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use mms_results::motion::resolve;
use mms_results::names::recognise;
use mms_results::{Contents, parse};

fuzz_target!(|bytes: &[u8]| {
    let Ok(Contents::Snapshots(found)) = parse(bytes) else { return };
    for snapshot in found {
        if let Ok(meanings) = recognise(&snapshot, &[], &|_| true) {
            let _ = resolve(&snapshot, &meanings, 2, &|_| 0.0);
        }
    }
});
