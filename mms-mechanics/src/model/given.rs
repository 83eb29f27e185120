//! Given fields and further balances of a field file, as expressions of X and t.

use super::{Reader, RigidMotion};
use crate::axisymmetric;
use crate::tensor::{Tensor, dot};
use mms_spec::diagnostic::Diagnostic;
use mms_spec::own::{Own, Part};
use mms_spec::source::Span;
use mms_spec::syntax::{self, NodeKind};
use mms_spec::{BalanceLaw, BalanceSpec, FieldSpec, Formula, MaterialSpec, Space, own_quantities};
use mms_symbolic::expr::{Expr, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::sorted::SortedMap;

/// The quantities that a field file defines.
pub type OwnQuantities = SortedMap<Own, Vec<Expr>>;

/// The names that formulas of balances may use beside the names of the file, for the help of a message.
const LANGUAGE: &str = "a balance may also use u_x, v_x, H11, F11, Finv11, C11, Cinv11 and similar names, J, and derivatives \
                        such as T_X and T_t of names in [let] and [given]";

/// The names that a balance of an axisymmetric field may use, for a message.
const LANGUAGE_OF_R: &str = "a balance may also use u_r, v_r, H11, F11, Finv11, C11, Cinv11 and similar names in the order R, Z, \
                             theta, J, and derivatives such as T_R and T_t of names in [let] and [given]";

/// The motion whose parts the names of a balance mean.
struct Moved {
    /// u, including the rigid motion.
    displacement: Vec<Expr>,
    /// H of this displacement, in three dimensions.
    gradient: Tensor,
    /// C in three dimensions, which a rotation does not change.
    right: Tensor,
    /// J, which a rotation does not change.
    jacobian: Expr,
}

impl Reader<'_> {
    /// The given fields of the material, in the order of its file.
    pub(super) fn givens(
        &mut self,
        field: &FieldSpec,
        material: &MaterialSpec,
    ) -> Vec<Option<Expr>> {
        let find = |name: &str| field.material.givens.iter().find(|(it, _)| it.value == name);
        let mut values = Vec::new();
        for given in &material.givens {
            let found = find(&given.name.value);
            if found.is_none() && !field.incomplete && !material.incomplete {
                self.missing(field, "given field", &given.name.value, given.doc.as_ref());
            }
            let value = found.and_then(|(_, formula)| self.formula(formula));
            if let (Some((name, _)), Some(value)) = (found, value) {
                self.validate_one_meaning(field, &name.value, name.span, value);
            }
            values.push(value);
        }
        for (given, value) in material.givens.iter().zip(&values) {
            self.scope.define(&given.name.value, *value);
        }
        values
    }

    /// Reports the name of a given field that the field file uses for something else.
    fn validate_one_meaning(&mut self, field: &FieldSpec, name: &str, span: Span, value: Expr) {
        let is_parameter = field.parameters.iter().any(|it| it.name.value == name);
        let differs = self.scope.known(name).is_some_and(|known| known != value);
        if is_parameter || differs {
            let message = format!("the name `{name}` has two meanings");
            self.diagnostics.push(
                Diagnostic::error(span, message)
                    .label("a given field of the material, and another value in this file")
                    .help("rename the parameter or the definition: the name means the given field"),
            );
        }
    }

    /// Reads the file's own given fields: each may use the names above it.
    pub(super) fn own_givens(&mut self, field: &FieldSpec) {
        for given in &field.givens {
            let value = self.formula(&given.value);
            self.scope.define(&given.name.value, value);
        }
    }

    /// The quantities of the given fields and of the balances.
    pub(super) fn own(
        &mut self,
        field: &FieldSpec,
        material: Option<&MaterialSpec>,
        displacement: &[Expr],
        rigid: Option<&RigidMotion>,
    ) -> Option<OwnQuantities> {
        let mut parts = Vec::new();
        if !field.balances.is_empty() {
            let moved = self.moved(displacement, rigid);
            for balance in &field.balances {
                parts.push(self.balance(field, material, balance, &moved));
            }
        }
        let parts = parts.into_iter().collect::<Option<Vec<_>>>();
        let mut own = OwnQuantities::new();
        for quantity in own_quantities(field, material) {
            let value = || self.scope.known(&quantity.of);
            let components = match quantity.part {
                Part::Value => vec![value()?],
                Part::Gradient => {
                    let value = value()?;
                    self.slopes(value, self.space.vector())
                }
                Part::Rate => differentiate(self.graph, &[value()?], Symbol::Time),
                part => {
                    let balances = field.balances.iter().zip(parts.as_ref()?);
                    let mut of_name = balances.filter(|(it, _)| it.name.value == quantity.of);
                    of_name.find_map(|(_, parts)| parts.get(&part))?.clone()
                }
            };
            own.insert(quantity, components);
        }
        Some(own)
    }

    fn slopes(&mut self, value: Expr, dimension: usize) -> Vec<Expr> {
        let axes = 0..dimension;
        axes.map(|axis| differentiate(self.graph, &[value], Symbol::Coordinate(axis))[0]).collect()
    }

    /// H of a displacement.
    fn gradient(&mut self, displacement: &[Expr]) -> Tensor {
        if let Some(radius) = self.radius() {
            return axisymmetric::gradient(self.graph, radius, displacement);
        }
        let slopes =
            displacement.iter().map(|component| self.slopes(*component, displacement.len()));
        let slopes: Vec<_> = slopes.collect();
        Tensor::from_fn(displacement.len(), |row, column| slopes[row][column])
    }

    fn moved(&mut self, displacement: &[Expr], rigid: Option<&RigidMotion>) -> Moved {
        let inner = self.gradient(displacement);
        let identity = Tensor::identity(self.graph, displacement.len());
        let jacobian = identity.add(self.graph, &inner).determinant(self.graph);
        let stretched = inner.transpose().mul(self.graph, &inner);
        let transposed = inner.transpose();
        let linear = inner.add(self.graph, &transposed);
        let excess = linear.add(self.graph, &stretched);
        let right = padded(self, &excess, true);
        let displacement = match rigid {
            Some(rigid) => rigid.displacement(self.graph, displacement),
            None => displacement.to_vec(),
        };
        let gradient = match rigid {
            Some(_) => self.gradient(&displacement),
            None => inner,
        };
        Moved { gradient: padded(self, &gradient, false), displacement, right, jacobian }
    }

    /// The parts of a balance.
    fn balance(
        &mut self,
        field: &FieldSpec,
        material: Option<&MaterialSpec>,
        balance: &BalanceSpec,
        moved: &Moved,
    ) -> Option<SortedMap<Part, Vec<Expr>>> {
        let outer = self.scope.clone();
        self.scope.hint(match self.space {
            Space::Cartesian(_) => LANGUAGE,
            Space::Axisymmetric { .. } => LANGUAGE_OF_R,
        });
        for formula in balance.formulas() {
            self.define_used(field, material, formula, moved);
        }
        let parts = match &balance.law {
            BalanceLaw::Constraint { residual } => {
                let residual = self.formula(residual);
                residual.map(|residual| SortedMap::from([(Part::Residual, vec![residual])]))
            }
            BalanceLaw::Flow { storage, flux } => {
                let storage = storage.as_ref().map(|storage| self.formula(storage));
                let flux = flux.as_ref().map(|flux| self.formulas(flux));
                self.flow(storage, flux)
            }
        };
        self.scope = outer;
        parts
    }

    /// source = d(storage)/dt + Div(flux), the flux and its normal component; omits parts that failed.
    fn flow(
        &mut self,
        storage: Option<Option<Expr>>,
        flux: Option<Option<Vec<Expr>>>,
    ) -> Option<SortedMap<Part, Vec<Expr>>> {
        let mut terms = Vec::new();
        if let Some(storage) = storage {
            terms.extend(differentiate(self.graph, &[storage?], Symbol::Time));
        }
        let mut parts = SortedMap::new();
        if let Some(flux) = flux {
            let flux = flux?;
            for (axis, component) in flux.iter().enumerate() {
                terms.extend(differentiate(self.graph, &[*component], Symbol::Coordinate(axis)));
            }
            terms.extend(self.radius().map(|it| axisymmetric::spreading(self.graph, it, &flux)));
            let normal: Vec<_> = (0..self.space.coordinates())
                .map(|axis| (flux[axis], self.graph.symbol(Symbol::Normal(axis))))
                .collect();
            parts.insert(Part::NormalFlux, vec![dot(self.graph, normal)]);
            parts.insert(Part::Flux, flux);
        }
        let one = self.graph.number(1);
        let source = dot(self.graph, terms.into_iter().map(|term| (term, one)));
        parts.insert(Part::Source, vec![source]);
        Some(parts)
    }

    /// Defines the names of the language of balances that a formula uses and the file does not define.
    fn define_used(
        &mut self,
        field: &FieldSpec,
        material: Option<&MaterialSpec>,
        formula: &Formula,
        moved: &Moved,
    ) {
        let Some(ast) = syntax::parse(formula, &mut Vec::new()) else { return };
        for node in &ast.nodes {
            let NodeKind::Name(name) = &node.kind else { continue };
            if self.scope.has(name) {
                continue;
            }
            match self.built_in(field, name, moved) {
                Some(value) => self.scope.define(name, Some(value)),
                None => self.define_derivative(field, material, name),
            }
        }
    }

    /// The value of a name such as u_x, v_x, H11, F11, Finv11, C11 or Cinv11, or of J.
    fn built_in(&mut self, field: &FieldSpec, name: &str, moved: &Moved) -> Option<Expr> {
        if name == "J" {
            return Some(moved.jacobian);
        }
        let directions = &self.space.directions()[..self.space.vector()];
        let axis = |axis: &str| directions.iter().position(|it| *it == axis);
        if let Some(axis) = name.strip_prefix("u_").and_then(axis) {
            return moved.displacement.get(axis).copied();
        }
        if let Some(axis) = name.strip_prefix("v_").and_then(axis) {
            let component = *moved.displacement.get(axis).filter(|_| !field.is_static())?;
            return Some(differentiate(self.graph, &[component], Symbol::Time)[0]);
        }
        let letters = name.trim_end_matches(|it: char| it.is_ascii_digit());
        let [row, column] = &name.as_bytes()[letters.len()..] else { return None };
        let place =
            |digit: u8| usize::from(digit).checked_sub(usize::from(b'1')).filter(|it| *it < 3);
        let (row, column) = (place(*row)?, place(*column)?);
        let tensor = match letters {
            "H" => moved.gradient.clone(),
            "F" => self.deformation(moved),
            "Finv" => self.deformation(moved).inverse(self.graph),
            "C" => moved.right.clone(),
            "Cinv" => moved.right.inverse(self.graph),
            _ => return None,
        };
        Some(tensor.at(row, column))
    }

    fn deformation(&mut self, moved: &Moved) -> Tensor {
        Tensor::identity(self.graph, 3).add(self.graph, &moved.gradient)
    }

    /// Defines a name such as T_X or T_t as the derivative of a name of `[let]` or `[given]`, or reports why it does not exist.
    fn define_derivative(
        &mut self,
        field: &FieldSpec,
        material: Option<&MaterialSpec>,
        name: &str,
    ) {
        let Some((of, by)) = name.rsplit_once('_') else { return };
        let is_defined = field.lets.iter().any(|it| it.name.value == of)
            || field.givens.iter().any(|it| it.name.value == of)
            || material.is_some_and(|material| material.given(of).is_some());
        if !is_defined {
            return;
        }
        let symbol = match self.space.axes().iter().position(|axis| *axis == by) {
            Some(axis) if axis < field.dimension => Symbol::Coordinate(axis),
            Some(_) => {
                let plural = if field.dimension == 1 { "dimension" } else { "dimensions" };
                let reason = format!("the field has {} {plural}", field.dimension);
                return self.scope.withhold(name, reason);
            }
            None if by != "t" => return,
            None if field.is_static() => {
                return self.scope.withhold(name, "the field is static: nothing has a rate");
            }
            None => Symbol::Time,
        };
        let value =
            self.scope.known(of).map(|value| differentiate(self.graph, &[value], symbol)[0]);
        self.scope.define(name, value);
    }
}

/// Pads a tensor to three dimensions with zeros, and adds I if `of_identity`.
fn padded(reader: &mut Reader<'_>, tensor: &Tensor, of_identity: bool) -> Tensor {
    let (zero, dimension) = (reader.graph.number(0), tensor.dimension());
    let padded = Tensor::from_fn(3, |row, column| match row.max(column) < dimension {
        true => tensor.at(row, column),
        false => zero,
    });
    if !of_identity {
        return padded;
    }
    Tensor::identity(reader.graph, 3).add(reader.graph, &padded)
}
