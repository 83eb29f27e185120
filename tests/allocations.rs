//! No evaluation allocates, as counted by the allocator of the thread.

use std::sync::Arc;

use allocation_counter::measure;
use mms_exact::gallery::find;
use mms_gallery::axis_aligned_3d;
use mms_mechanics::Output;
use mms_program::block::{BlockMode, BlockPlan, Inputs, Outputs, Prepared, ScratchPool};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Symbol;
use mms_symbolic::sorted::SortedMap;

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

    let counted = measure(|| {
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
    });
    assert_eq!(counted.count_total, 0);
    assert!(out[0][500] != 0.0 && rows[500][0] != 0.0);
    no_evaluation_in_blocks_allocates(&points, &mut rows);

    // The count includes memory that is allocated and freed.
    assert_eq!(measure(|| drop(std::hint::black_box(vec![0_u8; 4096]))).bytes_max, 4096);
}

/// Once a cache has been used, with any number of points, neither other times nor other parameters allocate.
fn no_evaluation_in_blocks_allocates(points: &[[f64; 3]], rows: &mut [[f64; 3]]) {
    let entry = find("axis_aligned_3d").expect("a field of the gallery");
    let compiled = entry.compile().expect("a right field");
    let parameters = compiled.parameters::<f64>(&SortedMap::new());
    let plan = BlockPlan::new(
        &compiled.program,
        &[Output::Quantity(Quantity::BodyForce)],
        Output::is_quantity,
    );
    let mut prepared = Prepared::new(Arc::new(plan), BlockMode::fused(), &parameters);
    let pool = ScratchPool::default();
    let mut evaluate = |prepared: &Prepared<f64>, time: f64, count: usize| {
        let mut write_inputs = |start: usize, inputs: &mut Inputs<'_, f64>| {
            for (symbol, column) in inputs.columns() {
                let Symbol::Coordinate(axis) = symbol else { unreachable!("positions alone") };
                column.iter_mut().zip(&points[start..]).for_each(|(to, point)| *to = point[axis]);
            }
        };
        let mut read_outputs = |start: usize, outputs: &Outputs<'_, f64>| {
            for (axis, component) in outputs.components(0).enumerate() {
                component
                    .write(rows[start..start + outputs.count()].iter_mut().map(|it| &mut it[axis]));
            }
        };
        pool.with(|scratch| {
            prepared.run(scratch, time, count, &mut write_inputs, &mut read_outputs)
        });
        rows[0][0]
    };
    let first = evaluate(&prepared, 0.01, 1);
    let counted = measure(|| {
        for step in 0..3 {
            evaluate(&prepared, 0.01 * f64::from(step), points.len());
            prepared.set(&parameters);
        }
    });
    assert_eq!(counted.count_total, 0);
    assert_eq!(evaluate(&prepared, 0.01, points.len()), first);
}
