//! Several methods beside each other.

use maud::{Markup, html};
use mms_documents::study::Studies;

use super::mark::{Column, numbers, order, small, table, verdict, words};
use super::method::written;
use super::study::{self, judged, l2, names_of_levels, stopped};
use super::{Section, Verdicts};
use crate::plot::{Axis, Curve, Plot};

impl Section for Studies {
    fn title(&self) -> String {
        let refined = match self.refinement.as_str() {
            "both" => "",
            "space" => ", in space",
            _ => ", in time",
        };
        format!("{}: {} methods{refined}", self.field, self.studies.len())
    }

    fn verdicts(&self) -> Verdicts {
        let each = || self.studies.iter().map(|it| it.study.verdicts());
        let (all, expected) =
            (each().map(|it| it.all).sum(), each().map(|it| it.expected).sum::<usize>());
        Verdicts::several(expected, all, "pass")
    }

    fn plots(&self) -> Vec<Plot> {
        vec![plot(self)]
    }

    fn body(&self, id: &str) -> Markup {
        html! {
            @if let Some(svg) = plot(self).svg(&format!("{id}-plot")) {
                figure {
                    (svg)
                    figcaption { "A line for each method. Both axes are logarithmic; the triangle has the expected slope." }
                }
            }
            (methods(self))
            @for (at, it) in self.studies.iter().enumerate() {
                details {
                    summary { (it.name) ": " (it.study.verdicts().word) }
                    (it.study.body(&format!("{id}-{}", at + 1)))
                }
            }
        }
    }
}

/// l2 of each method over h or dt.
pub fn plot(studies: &Studies) -> Plot {
    let curves: Vec<Curve> = studies
        .studies
        .iter()
        .enumerate()
        .map(|(at, it)| {
            let points = l2(&it.study).into_iter().filter_map(|(at, l2)| Some([at?, l2?]));
            let (name, points) = (written(&it.name), points.collect());
            Curve { name, points, order: it.study.observed_order, ..Curve::default() }.styled(at)
        })
        .collect();
    let described = curves.iter().map(|curve| {
        let last = curve.points.last().map_or("no error".into(), |[_, l2]| format!("{l2:.2e}"));
        format!("{}: {last} on the finest level", curve.name)
    });
    let first = studies.studies.first().map(|it| &it.study);
    let what = match studies.refinement == "time" {
        true => "difference to the next level, l2",
        false => "largest l2 error of u over time",
    };
    Plot {
        title: format!("Convergence of {}", studies.title()),
        description: format!("{}.", described.collect::<Vec<_>>().join("; ")),
        axes: [
            first.map(study::axis).unwrap_or_default(),
            Axis::of(what, first.and_then(|it| study::unit(it, "displacement"))),
        ],
        head: shared(studies),
        slope: first.map(|it| it.expected_order),
        curves,
        stopped: studies.studies.iter().flat_map(|it| stopped(&judged(&it.study))).collect(),
        marks_points: true,
        ..Plot::default()
    }
}

/// The formulation, if all methods share it.
fn shared(studies: &Studies) -> String {
    let mut all = studies.studies.iter().map(|it| it.study.method.formulation.as_str());
    let first = all.next().unwrap_or_default();
    if all.all(|it| it == first) { written(first) } else { String::new() }
}

fn methods(studies: &Studies) -> Markup {
    let levels = studies.studies.first().map(|it| names_of_levels(&it.study)).unwrap_or_default();
    let ends = [numbers("order"), numbers("constant"), words("verdict")];
    let columns: Vec<Column> = std::iter::once(words("method"))
        .chain(levels.into_iter().map(|name| Column::Number(name.into())))
        .chain(ends)
        .collect();
    let rows = studies.studies.iter().map(|it| {
        let mut cells = vec![html! { (it.name) }];
        cells.extend(l2(&it.study).into_iter().map(|(_, l2)| small(l2)));
        let verdicts = it.study.verdicts();
        cells.extend([
            order(it.study.observed_order),
            small(it.study.error_constant),
            verdict(&verdicts.word, verdicts.are_expected()),
        ]);
        cells
    });
    table("l2 of each method", &columns, rows)
}
