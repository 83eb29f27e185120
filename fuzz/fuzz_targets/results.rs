//! Arbitrary bytes as a file of results: reading them ends, with results or with a mistake, and so does what is made of
//! them, and their comparison with themselves. The seeds are the files in `mms-results/tests/data`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use mms_results::motion::{hold_distinct, resolve};
use mms_results::names::recognise;
use mms_results::norm::Mesh;
use mms_results::pairing::{cells, points};
use mms_results::{Contents, parse};

fuzz_target!(|bytes: &[u8]| {
    let Ok(Contents::Snapshots(found)) = parse(bytes) else { return };
    for snapshot in &found {
        if let Ok(meanings) = recognise(snapshot, &[], &|_| true)
            && let Ok(motion) = resolve(snapshot, &meanings, 2, &|_| 0.0)
        {
            let _ = hold_distinct(snapshot, &motion.reference);
            let places = &motion.reference.numbers;
            let mesh = Mesh { cells: &snapshot.cells, points: places, dimension: 2 };
            let _ = (mesh.sizes(), mesh.middles(), mesh.volumes());
        }
    }
    let twice: Vec<_> = found.iter().take(1).cycle().take(2).cloned().collect();
    for pair in found.windows(2).chain(std::iter::once(&twice[..])) {
        let [one, other] = pair else { continue };
        if let Ok((pairs, _)) = points(one, other, &[]) {
            let _ = cells(one, other, &pairs);
        }
    }
});
