//! No evaluation allocates. One test alone, since it counts what the whole process does.

use mms_gallery::axis_aligned_3d;
use peak_alloc::PeakAlloc;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

#[test]
fn no_evaluation_allocates() {
    const COUNT: usize = 1_000;
    let points: Vec<[f64; 3]> = (0..COUNT).map(|index| [index as f64 / 1e3, 0.3, 0.7]).collect();
    let columns: [Vec<f64>; 3] =
        core::array::from_fn(|axis| points.iter().map(|point| point[axis]).collect());
    let mut rows = vec![[0.0; 3]; COUNT];
    let mut out: [Vec<f64>; 3] = core::array::from_fn(|_| vec![0.0; COUNT]);
    let field = axis_aligned_3d::prepare(&axis_aligned_3d::Parameters::<f64>::default());
    let kept = field.at_points(columns.each_ref().map(|column| &column[..]));

    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    for step in 0..3 {
        let at = field.at_time(0.01 * f64::from(step));
        for (row, point) in rows.iter_mut().zip(&points) {
            *row = at.body_force(*point);
        }
        at.body_force_batch_aos(&points, &mut rows);
        let points = columns.each_ref().map(|column| &column[..]);
        at.body_force_batch(points, out.each_mut().map(|column| &mut column[..]));
        at.body_force_batch_at(&kept, out.each_mut().map(|column| &mut column[..]));
    }
    assert_eq!((MEMORY.current_usage(), MEMORY.peak_usage()), (before, before));
    assert!(out[0][500] != 0.0 && rows[500][0] != 0.0);

    // The count sees what is allocated and given back.
    drop(vec![0_u8; 4096]);
    assert!(MEMORY.peak_usage() >= before + 4096);
}
