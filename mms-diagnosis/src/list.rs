//! The list of hypotheses for people.

use crate::exact::Exact;
use crate::hypothesis::{
    Change, Hypothesis, HypothesisKind, Of, Size, all, of_tangent, voigt_orders,
};
use crate::patterns;

/// A hypothesis, or a size of one that has a name of its own.
#[derive(Clone, Debug)]
pub struct Listed {
    /// The name, with the face and the variant.
    pub title: String,
    /// The description of the mistake.
    pub says: String,
    /// Whether it is a mistake or a choice.
    pub kind: HypothesisKind,
    /// The part of the problem that it changes.
    pub changes: &'static str,
    /// The steps of the ladder that show it.
    pub shown_by: &'static str,
    /// If this is a name of a size: the hypothesis, and that size.
    pub size_of: Option<(&'static str, f64)>,
}

/// All hypotheses about a field, each followed by its named sizes.
pub fn listed<const D: usize>(exact: &Exact<'_, D>) -> Vec<Listed> {
    let of_laws = if exact.space.is_some() { Vec::new() } else { of_tangent() };
    let orders = if exact.space.is_some() { Vec::new() } else { voigt_orders() };
    let all = [all(exact), of_laws, orders];
    let mut found: Vec<Listed> = all.iter().flatten().flat_map(|it| names(exact, it)).collect();
    found.extend(patterns::LISTED.iter().map(|(title, says)| Listed {
        title: (*title).into(),
        says: (*says).into(),
        kind: HypothesisKind::Mistake,
        changes: "output",
        shown_by: "results",
        size_of: None,
    }));
    found
}

fn names<const D: usize>(exact: &Exact<'_, D>, it: &Hypothesis<D>) -> Vec<Listed> {
    let own = Listed {
        title: it.title(),
        says: it.says.into(),
        kind: it.kind,
        changes: it.change.name(),
        shown_by: shown_by(it),
        size_of: None,
    };
    let named = |name: &str, says: String, size: f64| Listed {
        title: crate::hypothesis::title(name, it.which.as_deref(), it.face),
        says,
        size_of: Some((it.name, size)),
        ..own.clone()
    };
    let below = match &it.size {
        Size::Any { right, .. } => {
            it.below.map(|name| named(name, format!("{}: below the right size", it.says), right[0]))
        }
        Size::Fixed => None,
    };
    let known = it.known(exact).into_iter().filter(|it| it.size.is_finite());
    let known = known.map(|it| named(it.name, it.says, it.size));
    let all = known.chain(below).collect::<Vec<_>>();
    std::iter::once(own).chain(all).collect()
}

fn shown_by<const D: usize>(it: &Hypothesis<D>) -> &'static str {
    match it.change {
        Change::Stress(Of::Motion, _) => "exact state, step, results",
        Change::Stress(..) => "law, exact state, step, results",
        Change::Force(_) | Change::Surface(_) | Change::Loads(..) | Change::Density => {
            "exact state, step, results"
        }
        Change::Mass => "exact state, results",
        Change::Start(_) => "step, results",
        Change::Tangent(_) | Change::Order(_) => "law",
        Change::Condition(_) | Change::Output(_) | Change::Wall(_) => "results",
        Change::InSpace(_) | Change::Ring(_) => "results",
    }
}
