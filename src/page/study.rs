//! Convergence studies.

use std::collections::BTreeMap;

use maud::{Markup, html};
use serde::Deserialize;
use serde_json::Value;

use super::comparison::Comparison;
use super::excluded::{Excluded, exclusions};
use super::mark::{Column, count, number, numbers, order, plain, seconds, small, table, words};
use super::method::Method;
use super::phase::Phases;
use super::plot::{Curve, Line, Plot, short};
use super::{Section, Verdicts};

/// What `mms study` writes.
#[derive(Deserialize)]
pub struct Study {
    field: String,
    method: Method,
    refinement: String,
    levels: Vec<Level>,
    noise: Vec<bool>,
    quantities: BTreeMap<String, Vec<Norms>>,
    differences: Option<Vec<Difference>>,
    expected_order: f64,
    observed_order: Option<f64>,
    order_interval: Option<[f64; 2]>,
    error_constant: Option<f64>,
    expected_error_constant: Option<f64>,
    fit: Option<Fit>,
    phase: Option<Phases>,
    #[serde(default)]
    excluded: Option<Vec<Excluded>>,
    verdict: String,
}

#[derive(Deserialize)]
struct Level {
    cells: Value,
    cell_size: Option<f64>,
    time_step: Option<f64>,
    steps: Option<usize>,
    particles: Option<usize>,
    #[serde(flatten)]
    norms: Norms,
    seconds: Option<f64>,
    failure: Option<String>,
    round_off: Option<f64>,
}

/// Errors and the orders that led to them.
#[derive(Deserialize)]
struct Norms {
    l1: Option<f64>,
    l2: Option<f64>,
    linf: Option<f64>,
    order_l1: Option<f64>,
    order_l2: Option<f64>,
    order_linf: Option<f64>,
}

#[derive(Deserialize)]
struct Difference {
    time_step: f64,
    #[serde(flatten)]
    norms: Norms,
}

#[derive(Deserialize)]
struct Fit {
    space_constant: f64,
    space_order: f64,
    time_constant: f64,
    time_order: f64,
    residual: f64,
}

impl Norms {
    /// Each error and its order.
    fn cells(&self) -> [Markup; 6] {
        [
            small(self.l1),
            order(self.order_l1),
            small(self.l2),
            order(self.order_l2),
            small(self.linf),
            order(self.order_linf),
        ]
    }

    fn errors(&self) -> [(&'static str, Option<f64>); 3] {
        [("l1", self.l1), ("l2", self.l2), ("linf", self.linf)]
    }
}

/// The heads of [`Norms::cells`].
const NORMS: [Column; 6] = [
    numbers("l1"),
    numbers("order"),
    numbers("l2"),
    numbers("order"),
    numbers("linf"),
    numbers("order"),
];

impl Section for Study {
    fn title(&self) -> String {
        let refined = match self.refinement.as_str() {
            "both" => "",
            "space" => ", in space",
            _ => ", in time",
        };
        format!("{}: {}{refined}", self.field, self.method.name())
    }

    fn verdicts(&self) -> Verdicts {
        Verdicts::one(&self.verdict, self.verdict == "pass")
    }

    fn body(&self, id: &str) -> Markup {
        let plot = self.plot();
        html! {
            p {
                @match self.observed_order {
                    Some(observed) => {
                        "The observed order is " (order(Some(observed))) " in l2"
                        @if let Some([low, high]) = self.order_interval {
                            ", between " (order(Some(low))) " and " (order(Some(high)))
                        }
                        "; expected is " (self.expected_order) "."
                        @if let Some(largest) = self.norms().last().and_then(|(_, norms)| norms.order_linf) {
                            " On the finest pair it is " (order(Some(largest))) " in linf."
                        }
                    }
                    None => { "No observed order; expected " (self.expected_order) "." }
                }
                @if let Some(constant) = self.error_constant {
                    " On the finest level l2 = " (small(Some(constant))) " " i { (self.length()) } sup { (self.expected_order) }
                    @match self.expected_error_constant {
                        Some(expected) => { "; expected is " (number(Some(expected), |it| format!("{it:e}"))) ", within 1 %." }
                        None => { "; no constant is expected, so that the order alone is judged." }
                    }
                }
                @if let Some(fit) = &self.fit { (fit.html()) }
            }
            @if let Some(svg) = plot.svg(&format!("{id}-plot")) {
                figure { (svg) figcaption { (self.caption(&plot)) } }
            }
            (self.levels())
            @if let Some(differences) = &self.differences { (steps(differences)) }
            @else { (self.others()) }
            @if let Some(phases) = &self.phase { (self.in_phase(phases)) }
            @if let Some(all) = &self.excluded { (exclusions(all)) }
            (self.method.html())
        }
    }
}

/// Reads a study, or that of several methods.
pub fn read(document: &Value) -> serde_json::Result<Box<dyn Section>> {
    Ok(match document.get("studies") {
        Some(_) => Box::new(Comparison::deserialize(document)?),
        None => Box::new(Study::deserialize(document)?),
    })
}

impl Study {
    /// h or dt, and l2 of what is judged.
    pub fn l2(&self) -> Vec<(Option<f64>, Option<f64>)> {
        self.norms().into_iter().map(|(at, norms)| (at, norms.l2)).collect()
    }

    /// What tells the levels of what is judged from each other.
    pub fn names_of_levels(&self) -> Vec<String> {
        match &self.differences {
            Some(steps) => steps.iter().map(|it| format!("dt {}", short(it.time_step))).collect(),
            None => self.levels.iter().map(|it| format!("{} cells", plain(&it.cells))).collect(),
        }
    }

    /// The order that is expected.
    pub fn expected_order(&self) -> f64 {
        self.expected_order
    }

    /// The order of l2.
    pub fn observed_order(&self) -> Option<f64> {
        self.observed_order
    }

    /// C of l2 = C h^p.
    pub fn error_constant(&self) -> Option<f64> {
        self.error_constant
    }

    fn length(&self) -> &'static str {
        if self.refinement == "time" { "dt" } else { "h" }
    }

    /// What is refined, on a level.
    fn refined(&self, level: &Level) -> Option<f64> {
        if self.refinement == "time" { level.time_step } else { level.cell_size }
    }

    /// What is judged: the errors, or in time the differences to the next level.
    fn norms(&self) -> Vec<(Option<f64>, &Norms)> {
        match &self.differences {
            Some(steps) => steps.iter().map(|it| (Some(it.time_step), &it.norms)).collect(),
            None => self.levels.iter().map(|it| (self.refined(it), &it.norms)).collect(),
        }
    }

    fn plot(&self) -> Plot {
        let rows = self.norms();
        let curve = |(style, name): (usize, &str)| {
            let points =
                rows.iter().filter_map(|(at, norms)| Some([(*at)?, norms.errors()[style].1?]));
            let points = points.collect();
            Curve { name: name.to_owned(), points, style, is_hollow: false, line: Line::Solid }
        };
        let curves: Vec<_> = ["l1", "l2", "linf"].into_iter().enumerate().map(curve).collect();
        let floor = match self.differences {
            Some(_) => Vec::new(),
            None => self
                .levels
                .iter()
                .filter_map(|it| Some([self.refined(it)?, it.round_off?]))
                .collect(),
        };
        let what = if self.differences.is_some() {
            "difference to the next level"
        } else if self.method.relaxes() {
            "error of u at equilibrium"
        } else {
            "largest error of u over time"
        };
        let described = rows.iter().filter_map(|(at, norms)| {
            Some(format!("{} {}: l2 {:.2e}", self.length(), short((*at)?), norms.l2?))
        });
        Plot {
            title: format!("Convergence of {}", self.title()),
            description: format!("{}.", described.collect::<Vec<_>>().join("; ")),
            axes: [if self.refinement == "time" { "time step dt" } else { "cell size h" }, what],
            curves,
            slope: Some(self.expected_order),
            floor,
            marks_points: true,
        }
    }

    /// What the picture does not say by itself.
    fn caption(&self, plot: &Plot) -> String {
        let mut text = format!(
            "Both axes are logarithmic; the triangle has the expected slope, {}.",
            self.expected_order
        );
        let highest = plot.floor.iter().map(|[_, floor]| *floor).fold(0.0, f64::max);
        if highest > 0.0 {
            text += &match plot.shows_floor() {
                true => format!(
                    " Below the dashed line, at most {highest:.1e}, an error may be nothing but round-off."
                ),
                false => format!(
                    " The predicted round-off floor, at most {highest:.1e}, lies far below the picture."
                ),
            };
        }
        text
    }

    fn in_phase(&self, phases: &Phases) -> Markup {
        let levels = self.levels.iter();
        match self.refinement.as_str() {
            "time" => {
                phases.html("time step", &levels.map(|it| small(it.time_step)).collect::<Vec<_>>())
            }
            _ => phases
                .html("cells", &levels.map(|it| html! { (plain(&it.cells)) }).collect::<Vec<_>>()),
        }
    }

    fn levels(&self) -> Markup {
        let mut columns = vec![words("cells"), numbers("particles"), numbers("steps")];
        columns.extend(NORMS);
        // A page that is the same everywhere has no times.
        let is_timed = self.levels.iter().any(|level| level.seconds.is_some());
        columns.push(numbers("round-off"));
        columns.extend(is_timed.then_some(numbers("time")));
        columns.push(words("remark"));
        let rows = self.levels.iter().enumerate().map(|(at, level)| {
            let mut cells =
                vec![html! { (plain(&level.cells)) }, count(level.particles), count(level.steps)];
            cells.extend(level.norms.cells());
            let noise = self.noise.get(at).is_some_and(|noise| *noise).then_some("noise");
            let remark = level.failure.as_deref().or(noise).unwrap_or_default();
            cells.push(small(level.round_off));
            cells.extend(is_timed.then(|| seconds(level.seconds)));
            cells.push(html! { (remark) });
            cells
        });
        let when = if self.method.relaxes() { "at equilibrium" } else { "the largest over time" };
        table(&format!("Errors of the displacement, {when}"), &columns, rows)
    }

    /// The errors of v, F and P.
    fn others(&self) -> Markup {
        let others = self.quantities.iter().filter(|(name, _)| *name != "displacement");
        let mut columns = vec![words("cells")];
        columns.extend(NORMS);
        html! {
            details {
                summary { "Errors of other quantities" }
                @for (name, levels) in others {
                    @let rows = levels.iter().zip(&self.levels).map(|(norms, level)| {
                        let mut cells = vec![html! { (plain(&level.cells)) }];
                        cells.extend(norms.cells());
                        cells
                    });
                    (table(&format!("Errors of the {}", name), &columns, rows))
                }
            }
        }
    }
}

fn steps(differences: &[Difference]) -> Markup {
    let mut columns = vec![numbers("time step")];
    columns.extend(NORMS);
    let rows = differences.iter().map(|difference| {
        let mut cells = vec![small(Some(difference.time_step))];
        cells.extend(difference.norms.cells());
        cells
    });
    table("Differences of displacements to the next level", &columns, rows)
}

impl Fit {
    fn html(&self) -> Markup {
        html! {
            " Over all runs, l2 = " (small(Some(self.space_constant))) " " i { "h" } sup { (order(Some(self.space_order))) }
            " + " (small(Some(self.time_constant))) " " i { "dt" } sup { (order(Some(self.time_order))) }
            ", within " (format!("{:.1}", 100.0 * self.residual)) " %."
        }
    }
}
