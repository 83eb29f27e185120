//! Formulations: the configuration in which the grid lies.

use crate::column::Matrices;
use crate::extension::extension_list;
use crate::real::Real;

extension_list! {
    /// The formulations.
    FormulationName, FormulationVisitor: Formulation, "formulation";
    updated::Updated,
    total::Total,
}

/// The configuration in which weights and stresses are evaluated.
pub trait Formulation: Send + Sync + 'static {
    /// Whether weights follow the present positions, and dF/dt = L F with L = sum_i v_i (x) grad w. Otherwise weights are
    /// evaluated at the reference positions, and dF/dt is that sum.
    const MOVES: bool;

    /// Computes, from tau and H of some packs of particles, the stresses that multiply grad w per reference volume.
    ///
    /// # Errors
    /// The index of the first particle where F is singular.
    fn stress<T: Real, const D: usize>(
        displacement_gradient: &[Matrices<T, D>],
        stress: &mut [Matrices<T, D>],
    ) -> Result<(), usize>;
}

/// A function that replaces tau of some packs by the stresses, given H; or returns where F is singular.
type StressOf<M> = fn(&[M], &mut [M]) -> Result<(), usize>;

/// A formulation as a value, so that solvers are compiled once for all formulations.
#[derive(Clone, Copy)]
pub(crate) struct Configuration<T, const D: usize> {
    /// [`Formulation::MOVES`].
    pub moves: bool,
    /// [`Formulation::stress`].
    pub stress: StressOf<Matrices<T, D>>,
}

impl FormulationName {
    /// The formulation of this name.
    pub(crate) fn configuration<T: Real, const D: usize>(self) -> Configuration<T, D> {
        self.visit(Configure(std::marker::PhantomData))
    }
}

/// Visitor that makes a value of a formulation.
struct Configure<T, const D: usize>(std::marker::PhantomData<T>);

impl<T: Real, const D: usize> FormulationVisitor for Configure<T, D> {
    type Output = Configuration<T, D>;

    fn visit<L: Formulation>(self) -> Self::Output {
        Configuration { moves: L::MOVES, stress: L::stress }
    }
}
