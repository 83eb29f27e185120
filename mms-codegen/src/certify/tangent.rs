//! dP/dF over a box of states, by dual numbers over intervals, all columns at once.

use mms_math::Scalar as _;

use crate::bounds::chart::{Chart, ChartProgram};
use mms_mechanics::invariant::SUPPLIED_VOLUME;
use mms_program::Program;
use mms_program::dual::Dual;
use mms_program::interpret::Number;
use mms_program::interval::Interval;
use mms_program::multi_dual::MultiDual;
use mms_program::schedule::schedule_plainly;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::sorted::SortedMap;

/// dP/dF by dual numbers, and its derivatives by dual numbers over these.
pub struct Tangent<'a> {
    first: ChartProgram<'a, MultiDual<Interval>, ()>,
    second: ChartProgram<'a, MultiDual<Dual<Interval>>, ()>,
}

/// A mean-value form of dP/dF: its value in the middle plus, for each entry of H that varies, the slope times the distance from
/// the middle.
pub struct MeanValue {
    /// The value in the middle of H.
    pub centre: Vec<Interval>,
    /// The largest distance of an entry from the middle, and bounds of the slopes.
    pub slopes: Vec<(f64, Vec<Interval>)>,
}

/// The largest number of varying entries of H by which dP/dF is differentiated: with more, that does not pay.
const DIRECTIONS: usize = 4;

impl<'a> Tangent<'a> {
    /// The program of P at a supplied gradient.
    pub fn program(graph: &Graph, stress: &[Expr]) -> Program<()> {
        schedule_plainly(graph, &SortedMap::from([((), stress.to_vec())]))
    }

    /// Prepares the tangent of the stress of such a program.
    pub fn new(chart: &'a Chart, stress: &'a Program<()>) -> Self {
        Tangent { first: chart.run(stress), second: chart.run(stress) }
    }

    /// dP_iJ/dH_kL, row-major in (i, J) and (k, L), over a box where J lies within bounds.
    pub fn enclose(
        &mut self,
        gradient: &[Interval],
        jacobian: Interval,
        place: &[Interval],
    ) -> Vec<Interval> {
        let place: Vec<_> = place.iter().copied().map(MultiDual::constant).collect();
        let variable = |(entry, value): (usize, &Interval)| MultiDual::variable(*value, entry);
        let gradient: Vec<_> = gradient.iter().enumerate().map(variable).collect();
        let mut volume = volume(&gradient);
        volume.value = volume.value.meet(jacobian - Interval::from_f64(1.0));
        self.first.charge(gradient.len() as u64);
        let stress = self.first.with(&place, &leaves(&gradient, &volume), &[()]).swap_remove(0);
        matrix(&stress, |it, column| slope_of(it.value, it.slope(column)))
    }

    /// Sharpens known bounds of dP/dF by the mean-value form.
    pub fn sharpen(
        &mut self,
        mut tangent: Vec<Interval>,
        gradient: &[Interval],
        place: &[Interval],
    ) -> Vec<Interval> {
        let whole = tangent.iter().all(|entry| entry.is_defined());
        let Some(form) = whole.then(|| self.mean_value(gradient, place)).flatten() else {
            return tangent;
        };
        let MeanValue { centre: mut entries, slopes } = form;
        for (half, slopes) in slopes {
            let side = Interval::new(-half, half);
            for (entry, slope) in entries.iter_mut().zip(slopes) {
                *entry = *entry + slope * side;
            }
        }
        tangent.iter_mut().zip(entries).for_each(|(entry, form)| *entry = entry.meet(form));
        tangent
    }

    /// The mean-value form about the middle of a gradient; `None` if no entry varies, or too many do.
    pub fn mean_value(&mut self, gradient: &[Interval], place: &[Interval]) -> Option<MeanValue> {
        let varies = |entry: &usize| gradient[*entry].width() > 0.0;
        let directions: Vec<usize> = (0..gradient.len()).filter(varies).collect();
        if directions.is_empty() || directions.len() > DIRECTIONS {
            return None;
        }
        let middle = |entry: &Interval| Interval::from_f64(entry.middle());
        let centre: Vec<Interval> = gradient.iter().map(middle).collect();
        let anywhere = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
        let form = self.enclose(&centre, anywhere, place);
        let slopes = directions.into_iter().map(|direction| {
            let side = gradient[direction] - centre[direction];
            (side.farthest(), self.slopes(gradient, place, direction))
        });
        Some(MeanValue { slopes: slopes.collect(), centre: form })
    }

    /// The derivative of dP/dH by one entry of H.
    fn slopes(
        &mut self,
        gradient: &[Interval],
        place: &[Interval],
        direction: usize,
    ) -> Vec<Interval> {
        let place: Vec<_> =
            place.iter().map(|side| MultiDual::constant(Dual::constant(*side))).collect();
        let variable = |(entry, value): (usize, &Interval)| {
            let unit = Interval::from_f64(f64::from(u8::from(entry == direction)));
            MultiDual::variable(Dual { value: *value, slope: unit }, entry)
        };
        let gradient: Vec<_> = gradient.iter().enumerate().map(variable).collect();
        let volume = volume(&gradient);
        self.second.charge(gradient.len() as u64);
        let stress = self.second.with(&place, &leaves(&gradient, &volume), &[()]).swap_remove(0);
        matrix(&stress, |it, column| slope_of(it.value.value, it.slope(column).slope))
    }
}

/// The leaves of a stress: H, and J - 1 as a leaf of its own.
fn leaves<T: Clone>(gradient: &[T], volume: &T) -> impl Fn(Symbol) -> T {
    let dimension = gradient.len().isqrt();
    move |symbol| match symbol {
        SUPPLIED_VOLUME => volume.clone(),
        Symbol::Gradient(row, column) => gradient[row * dimension + column].clone(),
        _ => unreachable!("a stress is a function of H"),
    }
}

/// The slope of a value; undefined if the value is, for instance since a budget is spent.
fn slope_of(value: Interval, slope: Interval) -> Interval {
    if value.is_defined() { slope } else { Interval::UNDEFINED }
}

/// J - 1 of a gradient that is diagonal up to the entries of derivatives.
fn volume<T: Number>(gradient: &[T]) -> T {
    let one = T::from_f64(1.0);
    let stretches = gradient.iter().step_by(gradient.len().isqrt() + 1);
    let stretches = stretches.map(|entry| one.clone() + entry.clone());
    stretches.fold(one.clone(), |product, stretch| product * stretch) - one.clone()
}

/// A square matrix, row-major, from one item for each row.
fn matrix<T>(rows: &[T], entry: impl Fn(&T, usize) -> Interval) -> Vec<Interval> {
    let entry = &entry;
    rows.iter().flat_map(|row| (0..rows.len()).map(move |column| entry(row, column))).collect()
}
