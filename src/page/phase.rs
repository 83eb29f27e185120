//! Amplitude and phase of a study's levels.

use maud::{Markup, html};
use serde::Deserialize;

use super::mark::{number, numbers, order, table, words};

/// What `mms study --periods` adds to its document.
#[derive(Deserialize)]
pub struct Phases {
    period: f64,
    measured: Vec<Measured>,
}

#[derive(Deserialize)]
struct Measured {
    number: usize,
    levels: Vec<Level>,
}

#[derive(Deserialize)]
struct Level {
    amplitude_error: Option<f64>,
    order_amplitude: Option<f64>,
    phase_lag: Option<f64>,
    order_phase: Option<f64>,
}

impl Phases {
    /// A table for each period, whose rows are the levels, told apart by `what` they have.
    pub fn html(&self, what: &'static str, levels: &[Markup]) -> Markup {
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
                "A period takes " (number(Some(self.period), |it| format!("{it:.4e}"))) ". Amplitude errors are relative "
                "to the exact amplitude; phase lags are in radians, and negative where the run is ahead."
            }
            @for measured in &self.measured {
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
}
