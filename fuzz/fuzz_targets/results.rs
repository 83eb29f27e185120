//! Reads any bytes as a file of results: reading must end, with results or a mistake, and so must the functions on these
//! results, and their comparison with themselves. The number of bytes decides which arrays are read, and the memory limit.
//! The seeds are the files in `mms-results/tests/data`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use mms_results::mesh::Mesh;
use mms_results::motion::{resolve, validate_distinct};
use mms_results::names::{KNOWN, Role, everything, recognise, wanted};
use mms_results::own;
use mms_results::pairing::{cells, points};
use mms_results::{Contents, parse};

/// The memory limit in bytes, if memory is scarce.
const SCARCE: u64 = 1 << 12;

fuzz_target!(|bytes: &[u8]| {
    let wants = |role: Role| bytes.len() % 2 == 0 || role == Role::Displacement;
    let read = match bytes.len() % 3 {
        0 => everything(&KNOWN),
        1 => wanted(&KNOWN, &wants),
        _ => wanted(&KNOWN, &wants).within(SCARCE, ""),
    };
    let Ok(Contents::Snapshots(found)) = parse(bytes, &read) else { return };
    for snapshot in &found {
        let _ = own::keep(&mut snapshot.clone());
        if let Ok(meanings) = recognise(snapshot, &KNOWN, &wants) {
            let mut half = |x: &[f64], _: f64| Ok(Some(x.iter().map(|x| x / 2.0).collect()));
            for back in [None, Some(&mut half as _)] {
                let Ok(motion) = resolve(snapshot, &meanings, 2, &|_: &[f64]| 0.0, back) else {
                    continue;
                };
                let _ = validate_distinct(snapshot, &motion.reference);
                let places = &motion.reference.numbers;
                let mesh = Mesh {
                    cells: &snapshot.cells,
                    points: places,
                    dimension: 2,
                    is_meridian: false,
                };
                let _ = (mesh.sizes(), mesh.middles(), mesh.volumes());
                let _ = (mesh.free_edges(&|_| true), mesh.imbalance(&|_| true));
            }
        }
    }
    let twice: Vec<_> = found.iter().take(1).cycle().take(2).cloned().collect();
    for pair in found.windows(2).chain(std::iter::once(&twice[..])) {
        let [one, other] = pair else { continue };
        if let Ok((pairs, _)) = points(one, other, &KNOWN) {
            let _ = cells(one, other, &pairs);
        }
    }
});
