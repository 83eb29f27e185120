//! Binding times: the times when values are known.

use super::Symbol;

/// The time when a value is known: the inputs, among {parameters, t, X}, that it needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Parameters only: once.
    Parameter,
    /// Parameters and t: once per time.
    Time,
    /// Parameters and X: once per point, and then for all times.
    Point,
    /// X and t, or an input that a caller supplies at a point: every evaluation.
    PointTime,
}

impl Stage {
    /// Every stage, in the order of evaluation.
    pub const ALL: [Stage; 4] = [Stage::Parameter, Stage::Time, Stage::Point, Stage::PointTime];

    /// The stage of a value that needs values of both.
    pub fn join(self, other: Stage) -> Stage {
        match (self, other) {
            (Stage::Time, Stage::Point) | (Stage::Point, Stage::Time) => Stage::PointTime,
            _ => self.max(other),
        }
    }

    /// Whether X is needed, or an input that a caller supplies at a point.
    pub fn needs_point(self) -> bool {
        matches!(self, Stage::Point | Stage::PointTime)
    }

    /// The stage of a leaf.
    pub fn of(symbol: Symbol) -> Stage {
        match symbol {
            Symbol::Parameter(_) | Symbol::Local(_) => Stage::Parameter,
            Symbol::Time => Stage::Time,
            Symbol::Coordinate(_) => Stage::Point,
            Symbol::Normal(_) | Symbol::Gradient(..) | Symbol::Invariant(_) => Stage::PointTime,
        }
    }

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Parameter => "parameter",
            Stage::Time => "time",
            Stage::Point => "point",
            Stage::PointTime => "point_time",
        }
    }
}
