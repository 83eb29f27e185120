//! The body, the time window and the rigid motion of a field: formulas without X.

use super::{Body, Domain, Reader, RigidMotion, Rotation, is_parameter};
use crate::region::{Block, Region};
use mms_math::coordinates::System;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::{FieldSpec, Formula, RigidSpec, Space};
use mms_symbolic::expr::{Expr, Symbol};

impl Reader<'_> {
    pub(super) fn domain(
        &mut self,
        domain: &mms_spec::DomainSpec,
        dimension: usize,
    ) -> Option<Domain> {
        // Every formula is resolved before anything is found missing, so that each reports its mistakes.
        let [first, last] = match &domain.time {
            Some(time) => time.each_ref().map(|time| self.constant(time)),
            None => [0, 1].map(|time| Some(self.graph.number(time))),
        };
        let body = self.body(&domain.body, dimension)?;
        Some(Domain { body, time: [first?, last?], is_static: domain.time.is_none() })
    }

    fn body(&mut self, body: &mms_spec::BodySpec, dimension: usize) -> Option<Body> {
        match body {
            mms_spec::BodySpec::Box { lower, upper } => {
                let (lower, upper) = (self.constants(lower), self.constants(upper));
                Some(Region::cuboid(lower?, upper?))
            }
            mms_spec::BodySpec::Round(round) => self.round(round),
            mms_spec::BodySpec::Polygon(polygon) => {
                let vertices: Vec<_> =
                    polygon.vertices.iter().map(|vertex| self.constants(vertex)).collect();
                let pair = |vertex: Option<Vec<Expr>>| <[Expr; 2]>::try_from(vertex?).ok();
                let vertices = vertices.into_iter().map(pair).collect::<Option<Vec<_>>>()?;
                (vertices.len() >= 3).then_some(Region::Polygon(vertices))
            }
            mms_spec::BodySpec::Nothing => Some(Region::Nothing(dimension)),
        }
    }

    fn round(&mut self, round: &mms_spec::Round) -> Option<Body> {
        let zero = self.graph.number(0);
        let pi = self.graph.pi();
        let turn = self.graph.scale(pi, 2);
        let inner = round.inner.as_ref().map_or(Some(zero), |inner| self.constant(inner));
        let outer = self.constant(&round.outer);
        let mut pair = |pair: &Option<[Formula; 2]>, otherwise: [Expr; 2]| match pair {
            Some(pair) => {
                let [first, last] = pair.each_ref().map(|it| self.constant(it));
                Some([first?, last?])
            }
            None => Some(otherwise),
        };
        let theta = pair(&round.theta, [zero, turn]);
        let (z, phi) = (pair(&round.z, [zero; 2]), pair(&round.phi, [zero, pi]));
        let mut bounds = vec![[inner?, outer?], theta?];
        let is_ball = round.shape.name == "sphere";
        if is_ball || round.z.is_some() {
            bounds.push(if is_ball { phi? } else { z? });
        }
        let system = if is_ball { System::Spherical } else { System::Polar };
        Some(Region::Block(Block { system, bounds }))
    }

    fn constants(&mut self, formulas: &[Formula]) -> Option<Vec<Expr>> {
        let values: Vec<_> = formulas.iter().map(|formula| self.constant(formula)).collect();
        values.into_iter().collect()
    }

    /// Resolves a formula of the domain, which may use parameters only.
    pub(super) fn constant(&mut self, formula: &Formula) -> Option<Expr> {
        let help = self.fixed();
        self.limited(formula, "the domain must be fixed", help, is_parameter)
    }

    /// The advice on a formula that may depend on parameters alone.
    fn fixed(&self) -> &'static str {
        match self.space {
            Space::Cartesian(_) => "use parameters, and definitions that contain no X, Y, Z or t",
            Space::Axisymmetric { .. } => {
                "use parameters, and definitions that contain no R, Z or t"
            }
        }
    }

    /// Resolves a formula that may use some symbols only.
    fn limited(
        &mut self,
        formula: &Formula,
        message: &str,
        help: &str,
        allowed: impl Fn(&Symbol) -> bool,
    ) -> Option<Expr> {
        let value = self.formula(formula)?;
        let intruder = self.graph.symbols(value).into_iter().find(|symbol| !allowed(symbol));
        let Some(intruder) = intruder else { return Some(value) };
        let name = self.names().symbol(intruder);
        self.diagnostics.push(
            Diagnostic::error(formula.span, message).label(format!("depends on {name}")).help(help),
        );
        None
    }

    pub(super) fn rigid(&mut self, rigid: &RigidSpec, dimension: usize) -> Option<RigidMotion> {
        const MESSAGE: &str = "a rigid motion moves all points alike";
        let help = match self.space {
            Space::Cartesian(_) => "use parameters, t, and definitions that contain no X, Y or Z",
            Space::Axisymmetric { .. } => {
                "use parameters, t, and definitions that contain no R or Z"
            }
        };
        let of_time = |symbol: &Symbol| is_parameter(symbol) || *symbol == Symbol::Time;
        let angle = rigid.angle().map(|angle| self.limited(angle, MESSAGE, help, of_time));
        let axis = match &rigid.rotation {
            Some(mms_spec::Rotation::Space { axis, .. }) => Some(self.axis(axis)),
            _ => None,
        };
        let translation: Option<Vec<Expr>> = match &rigid.translation {
            Some(components) => {
                let components: Vec<_> = components
                    .iter()
                    .map(|component| self.limited(component, MESSAGE, help, of_time))
                    .collect();
                components.into_iter().collect()
            }
            None => Some(vec![self.graph.number(0); dimension]),
        };
        let rotation = match (axis, angle) {
            (Some(axis), angle) => Some(Rotation::Space { axis: axis?, angle: angle?? }),
            (None, Some(angle)) => Some(Rotation::Plane { angle: angle? }),
            (None, None) => None,
        };
        Some(RigidMotion { rotation, translation: translation? })
    }

    /// The three components of an axisymmetric displacement, including its rigid motion, which must be along the axis.
    pub(super) fn around_the_axis(
        &mut self,
        field: &FieldSpec,
        mut displacement: Vec<Expr>,
        rigid: Option<&RigidMotion>,
    ) -> Vec<Expr> {
        displacement.resize(3, self.graph.number(0));
        let Some(RigidMotion { translation, .. }) = rigid else { return displacement };
        let written = field.rigid.as_ref().and_then(|rigid| rigid.translation.as_ref());
        if let Some(formula) = written.filter(|_| !self.graph.is_zero(translation[0])) {
            self.diagnostics.push(
                Diagnostic::error(
                    formula[0].span,
                    "an axisymmetric body moves along its axis alone",
                )
                .label("expected 0")
                .help("the second component of the translation is that along Z"),
            );
        }
        displacement[1] = self.graph.add(displacement[1], translation[1]);
        displacement
    }

    fn axis(&mut self, formulas: &[Formula]) -> Option<[Expr; 3]> {
        let help = self.fixed();
        let components: Vec<_> = formulas
            .iter()
            .map(|formula| self.limited(formula, "the axis must be fixed", help, is_parameter))
            .collect();
        components.into_iter().collect::<Option<Vec<_>>>()?.try_into().ok()
    }
}
