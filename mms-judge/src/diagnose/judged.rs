//! The orders of results, judged as `mms judge` does: a diagnosis is never milder.

use mms_convergence::Verdict;
use mms_diagnosis::falls::Falls;
use mms_diagnosis::follow::Unfollowed;
use mms_exact::Exact;
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;

use super::Reading;
use crate::measured::worst;
use crate::results::{Comparison, Over, Reading as Judging, Results, measure};
use crate::table::ExpectedOrders;

/// Finds how the errors of results fall from mesh to mesh; `None` for one mesh.
///
/// # Errors
/// Results that `mms judge` refuses.
pub fn falls(
    all: Vec<Results>,
    wanted: &[Quantity],
    reading: &Reading<'_>,
    orders: &ExpectedOrders,
    exact: &mut Exact,
) -> anyhow::Result<Option<Falls>> {
    if all.len() < 2 {
        return Ok(None);
    }
    let judging = Judging {
        names: reading.names,
        wanted,
        weight: None,
        memory: None,
        files: reading.files,
        is_part: false,
        over: Some(Over::Cells),
    };
    let has_times = all.iter().flat_map(|it| &it.snapshots).all(|it| it.time.is_some());
    let given: Vec<f64> = match reading.times {
        [] => reading.rest.into_iter().collect(),
        times => times.to_vec(),
    };
    let comparison = Comparison {
        sizes: reading.sizes,
        times: if has_times { &[] } else { &given },
        orders,
        has_steps: false,
        tighter: None,
        follow: &Unfollowed,
    };
    let measurement = measure(all, &judging, exact, comparison)?;
    let (_, judged) = measurement.measured.judged(measurement.objection.as_ref())?;
    let Some((at, verdict)) = worst(&judged) else { return Ok(None) };
    let deciding = judged[at].judgement.deciding();
    Ok(Some(Falls {
        quantity: measurement.measured.quantities[at].name.shown(),
        norm: shown(&deciding.norm).to_string(),
        observed: deciding.finding.estimate.map(|it| it.order),
        expected: deciding.expected.order,
        verdict: verdict.to_string(),
        is_right: verdict.is_good() || verdict == Verdict::NoEvidence,
    }))
}
