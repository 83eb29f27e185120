//! Checks the numbers of a body: boxes have edges of positive length, radii and angles ascend, edges of polygons do not cross.

use std::f64::consts::TAU;

use mms_math::Scalar as _;
use mms_math::coordinates::System;
use mms_math::polygon::{self, Mistake};
use mms_mechanics::axisymmetric::{Pole, poles};
use mms_mechanics::extent::{Block, Extent, Region};
use mms_program::precise::Precise;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::{BalanceLaw, BodySpec, Claim, Face, Formula, Polygon, Round};
use mms_symbolic::expr::Expr;

use super::{Bound, Declared, digits, evaluate};

impl<'a> Declared<'a> {
    /// The body in numbers; `None` if it is wrong, or if there is none.
    pub(super) fn body(&mut self) -> Option<Extent<Precise>> {
        let model = self.model;
        match (&self.field.domain.body, &model.domain.body) {
            (BodySpec::Box { lower, upper }, Region::Block(block)) => {
                self.cuboid([lower, upper], &block.bounds)
            }
            (BodySpec::Round(round), Region::Block(block)) => self.round(round, block),
            (BodySpec::Polygon(polygon), Region::Polygon(vertices)) => {
                self.polygon(polygon, vertices)
            }
            _ => None,
        }
    }

    fn cuboid(
        &mut self,
        [lower, upper]: [&'a Vec<Formula>; 2],
        ends: &[[Expr; 2]],
    ) -> Option<Extent<Precise>> {
        let mut corners = [Vec::new(), Vec::new()];
        for (axis, (formulas, ends)) in lower.iter().zip(upper).zip(ends).enumerate() {
            let bounds = self.bounds([formulas.0, formulas.1], *ends);
            let Some([least, greatest]) = bounds else { continue };
            let name = self.field.space.axes()[axis];
            let message = format!("the box is empty along {name}");
            self.ascending(&message, "its `lower` is", &least, &greatest);
            if axis == 0 && self.field.space.is_axisymmetric() {
                self.about_the_axis(&least);
            }
            corners[0].push(least.value);
            corners[1].push(greatest.value);
        }
        let [from, to] = corners;
        (from.len() == lower.len()).then(|| Region::cuboid(from, to))
    }

    /// Reports a body beyond the axis, and formulas without a value on an axis that the body reaches.
    fn about_the_axis(&mut self, inner: &Bound<'_>) {
        let zero = Precise::from_f64(0.0);
        if !zero.at_most(&inner.value) {
            let message = "the body reaches beyond the axis";
            let diagnostic = Diagnostic::error(inner.formula.span, message)
                .label(format!("this is {}", digits(&inner.value)));
            let diagnostic = self.with_parameters(diagnostic, &[inner.expr]);
            self.report(diagnostic.help("R is the distance from the axis: it is not negative"));
            return;
        }
        if !inner.value.at_most(&zero) {
            return;
        }
        for claim in &self.field.boundary {
            if claim.face.value == Face::RadialMin && claim.claim.value != Claim::Axis {
                let diagnostic = Diagnostic::error(claim.claim.span, "the axis is no face")
                    .label("`lower` is 0 along R");
                self.diagnostics.push(diagnostic.help("claim `axis`, or remove this claim"));
            }
        }
        for pole in poles(&mut self.graph, self.model) {
            let (formula, divided, help) = self.divided(pole);
            let Some(formula) = formula else { continue };
            let message = format!("{divided} is not known to be finite on the axis");
            let diagnostic = Diagnostic::error(formula.span, message)
                .label("R cannot be taken out of this, as it is written");
            self.report(diagnostic.help(help));
        }
    }

    /// The formula that has a pole, the quotient that has it, and a way to write it without the pole.
    fn divided(&self, pole: Pole) -> (Option<&'a Formula>, String, &'static str) {
        const TIMES_R: &str = "write it as R times another formula, or let the body begin at R > 0";
        let displacement = &self.field.displacement;
        match pole {
            Pole::Displacement(1) => (
                displacement.get(1),
                "(du_Z/dR)/R".into(),
                "write u_Z in R^2, or let the body begin at R > 0",
            ),
            Pole::Displacement(2) => (displacement.get(2), "swirl/R".into(), TIMES_R),
            Pole::Displacement(_) => (displacement.first(), "u_R/R".into(), TIMES_R),
            Pole::Fibre(index) => {
                let fibre = self.field.material.fibre.as_ref();
                (fibre.and_then(|it| it.get(index)), "the turning of the fibres".into(), TIMES_R)
            }
            Pole::Flux(own) => {
                let balance = self.field.balances.iter().find(|it| it.name.value == own.of);
                let flux = balance.and_then(|it| match &it.law {
                    BalanceLaw::Flow { flux, .. } => flux.as_ref()?.first(),
                    BalanceLaw::Constraint { .. } => None,
                });
                (flux, "Q_R/R".into(), TIMES_R)
            }
        }
    }

    fn round(&mut self, round: &'a Round, block: &Block<Expr>) -> Option<Extent<Precise>> {
        let [from, to] = block.bounds[0];
        let zero = || Precise::from_f64(0.0);
        let inner = match &round.inner {
            Some(inner) => self.bound(inner, from),
            None => None,
        };
        let outer = self.bound(&round.outer, to);
        if let (Some(inner), Some(outer)) = (&inner, &outer) {
            self.radii(round, inner, outer);
        } else if let (None, Some(outer)) = (&round.inner, &outer)
            && outer.value.at_most(&zero())
        {
            let message = format!("the {} is empty", round.shape.name);
            let diagnostic = Diagnostic::error(outer.formula.span, message)
                .label(format!("the outer radius is {}", digits(&outer.value)));
            let diagnostic = self.with_parameters(diagnostic, &[outer.expr]);
            self.report(diagnostic);
        }
        let mut bounds = Vec::new();
        let third = match block.system {
            System::Spherical => &round.phi,
            _ => &round.z,
        };
        for (at, pair) in [&round.theta, third].into_iter().enumerate() {
            let Some(exprs) = block.bounds.get(at + 1) else { continue };
            let Some(pair) = pair else {
                // These bounds go all around, or from pole to pole.
                bounds.push(evaluate(&self.graph, &self.parameters, exprs).try_into().ok()?);
                continue;
            };
            let [first, last] = self.bounds(pair.each_ref(), *exprs)?;
            match (at, block.system) {
                (0, _) => self.angles(&first, &last),
                (_, System::Spherical) => self.polar_angles(&first, &last),
                _ => {
                    let message = "the cylinder is empty along Z";
                    self.ascending(message, "its lower end is", &first, &last);
                }
            }
            bounds.push([first.value, last.value]);
        }
        let inner = if round.inner.is_some() { inner?.value } else { zero() };
        bounds.insert(0, [inner, outer?.value]);
        Some(Region::Block(Block { system: block.system, bounds }))
    }

    fn radii(&mut self, round: &Round, inner: &Bound<'_>, outer: &Bound<'_>) {
        let zero = Precise::from_f64(0.0);
        let name = round.shape.name;
        if !zero.at_most(&inner.value) {
            let diagnostic = Diagnostic::error(inner.formula.span, "the inner radius is negative")
                .label(format!("this is {}", digits(&inner.value)));
            let diagnostic = self.with_parameters(diagnostic, &[inner.expr]);
            self.report(diagnostic);
        } else if inner.value.at_most(&zero) {
            let noun = if name == "annulus" { "disc".into() } else { format!("full {name}") };
            let message = format!("a {noun} has no inner face");
            self.refuse_claims(&[Face::Inner], &message, "`inner` is 0");
        }
        self.ascending(&format!("the {name} is empty"), "the inner radius is", inner, outer);
    }

    fn angles(&mut self, first: &Bound<'_>, last: &Bound<'_>) {
        self.ascending("the sector is empty", "its first angle is", first, last);
        let turn = Precise::from_f64(2.0) * Precise::pi();
        let length = last.value.clone() - first.value.clone();
        // Angles that differ by a turn do so to at least 60 of the 77 digits.
        let rounding = turn.clone() * Precise::from_f64(1e-60);
        if !length.at_most(&(turn.clone() + rounding.clone())) {
            let label = format!("{} from the first angle, more than {TAU}", digits(&length));
            let message = "the sector is longer than a full turn";
            let diagnostic = Diagnostic::error(last.formula.span, message).label(label);
            let diagnostic = self.with_parameters(diagnostic, &[first.expr, last.expr]);
            self.report(diagnostic.help("angles are in radians"));
        } else if (turn - rounding).at_most(&length) {
            let edges = [Face::ThetaMin, Face::ThetaMax];
            let noun = match self.field.dimension {
                2 => "ring has no edges",
                _ => "turn has no faces at its ends",
            };
            self.refuse_claims(&edges, &format!("a full {noun}"), "`theta` is a full turn");
        }
    }

    /// The angles of a sphere from +Z lie between 0 and pi; if they are 0 or pi, the axis is no face.
    fn polar_angles(&mut self, first: &Bound<'_>, last: &Bound<'_>) {
        self.ascending("the part of the sphere is empty", "its first angle is", first, last);
        let (zero, half) = (Precise::from_f64(0.0), Precise::pi());
        let rounding = half.clone() * Precise::from_f64(1e-60);
        let below = Precise::from_f64(0.0) - rounding.clone();
        let above = half.clone() + rounding.clone();
        for bound in [first, last] {
            if below.at_most(&bound.value) && bound.value.at_most(&above) {
                continue;
            }
            let message = "an angle from +Z is not between 0 and pi";
            let diagnostic = Diagnostic::error(bound.formula.span, message)
                .label(format!("this is {}", digits(&bound.value)));
            let diagnostic = self.with_parameters(diagnostic, &[bound.expr]);
            self.report(
                diagnostic.help("`phi` is the angle from +Z, in radians; `theta` goes around"),
            );
        }
        let message = "the axis of a sphere is no face";
        if first.value.at_most(&(zero + rounding.clone())) {
            self.refuse_claims(&[Face::PhiMin], message, "`phi` starts at 0");
        }
        if (half - rounding).at_most(&last.value) {
            self.refuse_claims(&[Face::PhiMax], message, "`phi` ends at pi");
        }
    }

    fn polygon(&mut self, polygon: &'a Polygon, vertices: &[[Expr; 2]]) -> Option<Extent<Precise>> {
        let mut found = Vec::new();
        for (formulas, exprs) in polygon.vertices.iter().zip(vertices) {
            found.push(self.bounds(formulas.each_ref(), *exprs));
        }
        let found: Vec<[Bound<'a>; 2]> = found.into_iter().collect::<Option<_>>()?;
        let near: Vec<[f64; 2]> =
            found.iter().map(|vertex| vertex.each_ref().map(|it| it.value.to_f64())).collect();
        let (message, [first, second], label) = match polygon::mistake(&near) {
            None => {
                let vertices = found.into_iter().map(|vertex| vertex.map(|bound| bound.value));
                return Some(Region::Polygon(vertices.collect()));
            }
            Some(Mistake::Repeated(first, second)) => {
                let label = format!("the same point as vertex {}", first + 1);
                ("a vertex of the polygon is repeated".to_string(), [first, second], label)
            }
            Some(Mistake::Crossing(first, second)) => {
                let names = [first, second].map(|edge| polygon.names[edge]);
                let message = format!("the edges `{}` and `{}` meet", names[0], names[1]);
                (message, [first, second], format!("`{}` starts here", names[1]))
            }
        };
        let span = polygon.vertices[second][0].span;
        let exprs = [vertices[first], vertices[second]].concat();
        let diagnostic = Diagnostic::error(span, message).label(label);
        let diagnostic = self.with_parameters(diagnostic, &exprs);
        self.report(diagnostic.help(
            "edges of a polygon may meet in its vertices only, and no vertex may be repeated",
        ));
        None
    }
}
