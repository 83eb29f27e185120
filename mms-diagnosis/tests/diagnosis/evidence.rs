//! Results of large meshes.

use mms_diagnosis::evidence::{Mesh, Snapshot};
use mms_diagnosis::exact::Quantity;

use super::points;

/// Large meshes of any point order are thinned evenly and keep their values.
#[test]
fn large_meshes_are_thinned_evenly() {
    for count in [300, 331, 256] {
        let all = points(count);
        let reference: Vec<f64> = all.iter().flat_map(|x| x.as_slice().to_vec()).collect();
        let u = reference.iter().map(|x| 2.0 * x).collect();
        let values = vec![(Quantity::Displacement, u)];
        let volumes = Some(vec![1.0; all.len()]);
        let snapshot = Snapshot { time: 0.1, reference, values, volumes, degree: None };
        let mesh = Mesh { cell_size: 0.01, time_step: None, snapshots: vec![snapshot] };
        let thinned = mesh.thinned::<2>(4000);
        let found = &thinned.snapshots[0];
        let kept = found.reference.len() / 2;
        assert!((3600..=4400).contains(&kept), "{count}: {kept}");
        assert_eq!(found.volumes.as_ref().map(Vec::len), Some(kept));
        let doubled: Vec<f64> = found.reference.iter().map(|x| 2.0 * x).collect();
        assert_eq!(found.values[0].1, doubled);
        for quarter in 0..4 {
            let is_in = |x: &&[f64]| (x[0] > 0.5) as usize + 2 * ((x[1] > 0.5) as usize) == quarter;
            let part = found.reference.chunks(2).filter(is_in).count() as f64 / kept as f64;
            assert!((part - 0.25).abs() < 0.03, "{count}: {part}");
        }
        assert_eq!(mesh.thinned::<2>(100_000 + all.len()), mesh);
    }
}
