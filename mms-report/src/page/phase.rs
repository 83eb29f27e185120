//! Amplitude and phase of a study's levels.

use maud::{Markup, html};
use mms_documents::study::Phase;

use super::mark::{number, numbers, order, table, words};

/// A table for each period. Its rows are the levels; the head `what` names the length that distinguishes them.
pub fn phase(phase: &Phase, what: &'static str, levels: &[Markup]) -> Markup {
    let columns = [
        words(what),
        numbers("amplitude error"),
        numbers("order"),
        numbers("phase lag"),
        numbers("order"),
    ];
    let signed = |value| number(value, |value| format!("{value:+.2e}"));
    html! {
        p {
            "A period takes " (number(Some(phase.period), |it| format!("{it:.4e}"))) ". Amplitude errors are relative "
            "to the exact amplitude; phase lags are in radians, and negative where the run is ahead."
        }
        @for measured in &phase.measured {
            @let rows = measured.levels.iter().zip(levels).map(|(level, name)| vec![
                html! { (name) },
                signed(level.amplitude_error),
                order(level.order_amplitude),
                signed(level.phase_lag),
                order(level.order_phase),
            ]);
            (table(&format!("Amplitude and phase in period {}", measured.number), &columns, rows))
        }
    }
}
