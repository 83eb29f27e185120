//! The weights of the particles: the only place in a solver that depends on the shape function.
//!
//! The weights of four packs are computed before their sums, so that there is work to do while loads are pending. A pass over
//! the particles is compiled once for all stencils that are products of weights along the axes, and once for the corners of
//! `cpdi`.

use mms_math::dispatch::{IsaLevel, Work, best};
use mms_math::simd::Simd;

use super::g2p::{Advance, IsProvedSound, Residual};
use super::p2g::{SlabError, Sums};
use crate::boundary::traction::{StencilOf, TractionPoint};
use crate::column::PACK;
use crate::column::{Matrices, Pack as _, Packs, Vectors};
use crate::failure::Cause;
use crate::lanes::{positions, vectors};
use crate::lattice::Lattice;
use crate::particle::reorder_packs;
use crate::real::{Matrix, Real, Vector};
use crate::shape::{Shape, place_alone};
use crate::stencil::Stencil as _;
use crate::transfer::Transfer;

/// The distance, in packs, by which data are prefetched: in large bodies the data have left the caches since the last pass.
pub(super) const AHEAD: usize = 3;

/// The number of packs whose weights are computed in one call, before their sums: enough to make the call cheap, and to overlap
/// loads with work.
pub(super) const TOGETHER: usize = 4;

/// Storage for the weights of these packs.
pub(super) type Stencils<St> = [St; TOGETHER];

/// The grid's geometry, and the data that the particles' weights depend on.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a, T: Real, const D: usize> {
    pub lattice: &'a Lattice<T, D>,
    /// Whether weights follow the present positions ([`Formulation::MOVES`](crate::formulation::Formulation)).
    pub moves: bool,
    pub transfer: Transfer,
    pub reference_position: &'a [[Vector<T, D>; PACK]],
    /// The displacement and gradient of every pack that weights depend on, if these are not the present ones; otherwise empty.
    pub kept: &'a [CachedDomains<T, D>],
}

/// The displacements and the displacement gradients of some packs.
pub(super) type Moved<'a, T, const D: usize> = (&'a [Vectors<T, D>], &'a [Matrices<T, D>]);

/// The displacements and the displacement gradients of a pack at another time.
pub(super) type CachedDomains<T, const D: usize> = (Vectors<T, D>, Matrices<T, D>);

/// A shape function as a value: the properties that a solver reads.
#[derive(Clone, Copy)]
pub(super) struct ShapeProperties<T: Real, const D: usize> {
    /// [`Shape::DEGREE`].
    pub degree: usize,
    /// [`Shape::NEAR`].
    pub near: bool,
    /// Whether stencils are products of weights along the axes.
    pub is_product: bool,
    /// [`Shape::ORIGIN`].
    pub origin: f64,
    /// The number of bytes of the domains of a pack.
    pub domain: usize,
    /// [`Shape::point`].
    pub point: StencilOf<T, D>,
    /// Creates the undeformed domains of particles from their half edges.
    pub domains: DomainsOf<T, D>,
}

type DomainsOf<T, const D: usize> = fn(&[Matrix<f64, D>]) -> Box<dyn Domains<T, D>>;

impl<T: Real, const D: usize> ShapeProperties<T, D> {
    pub fn of<S: Shape>() -> Self {
        Self {
            degree: S::DEGREE,
            near: S::NEAR,
            is_product: S::Stencil::<T, D>::default().product().is_some(),
            origin: S::ORIGIN,
            domain: size_of::<S::Domain<T, D>>(),
            point: S::point,
            domains: |half_edges| {
                let domains = half_edges.iter().map(|edges| S::domain(&edges.map(T::of)));
                Box::new(Shaped::<T, D, S>(domains.collect()))
            },
        }
    }

    /// The geometry and stencils of points of a grid.
    pub fn points<'a>(&self, lattice: &'a Lattice<T, D>) -> TractionPoint<'a, T, D> {
        TractionPoint { lattice, stencil: self.point }
    }
}

/// The particles' undeformed domains, and the passes that compute weights from them.
pub(super) trait Domains<T: Real, const D: usize>: Send + Sync {
    /// Moves the domain of particle `order[p]` to place `p`.
    fn reorder(&mut self, order: &mut [u32]);

    /// P2G of some particles.
    fn scatter(&self, sums: Sums<'_, T, D>) -> Result<(), SlabError>;

    /// G2P of some particles.
    fn advance(&self, advance: Advance<'_, '_, T, D>) -> Result<IsProvedSound, (usize, Cause)>;

    /// Computes the residual velocities of some particles: the part that the grid does not represent.
    fn residual(&self, residual: Residual<'_, '_, T, D>) -> Result<IsProvedSound, (usize, Cause)>;
}

/// Computes weights.
pub(super) trait Weigh<T: Real, const D: usize, St> {
    /// Computes the weights of the packs from `first` on, in the kept state, or in the `present` state if none was kept.
    ///
    /// # Errors
    /// A particle has no weights.
    fn weigh(
        &self,
        scene: &Scene<'_, T, D>,
        first: usize,
        present: Moved<'_, T, D>,
        stencils: &mut [St],
    ) -> Result<(), (usize, Cause)>;
}

/// The domains of a shape function.
struct Shaped<T: Real, const D: usize, S: Shape>(Packs<S::Domain<T, D>>);

impl<T: Real, const D: usize, S: Shape> Domains<T, D> for Shaped<T, D, S> {
    fn reorder(&mut self, order: &mut [u32]) {
        reorder_packs(&mut self.0, order);
        self.0.fill_up();
    }

    fn scatter(&self, sums: Sums<'_, T, D>) -> Result<(), SlabError> {
        sums.with::<S::Stencil<T, D>>(self)
    }

    fn advance(&self, advance: Advance<'_, '_, T, D>) -> Result<IsProvedSound, (usize, Cause)> {
        advance.with::<S::Stencil<T, D>>(self)
    }

    fn residual(&self, residual: Residual<'_, '_, T, D>) -> Result<IsProvedSound, (usize, Cause)> {
        residual.with::<S::Stencil<T, D>>(self)
    }
}

impl<T: Real, const D: usize, S: Shape> Weigh<T, D, S::Stencil<T, D>> for Shaped<T, D, S> {
    fn weigh(
        &self,
        scene: &Scene<'_, T, D>,
        first: usize,
        present: Moved<'_, T, D>,
        stencils: &mut [S::Stencil<T, D>],
    ) -> Result<(), (usize, Cause)> {
        let domains = self.0.packs();
        best(&mut Weights::<T, D, S> { scene, domains, first, present, stencils })
    }
}

/// The weights of some packs.
struct Weights<'a, T: Real, const D: usize, S: Shape> {
    scene: &'a Scene<'a, T, D>,
    /// The domains of all packs.
    domains: &'a [S::Domain<T, D>],
    first: usize,
    present: Moved<'a, T, D>,
    stencils: &'a mut [S::Stencil<T, D>],
}

impl<T: Real, const D: usize, S: Shape> Work<T> for &mut Weights<'_, T, D, S> {
    type Output = Result<(), (usize, Cause)>;
    const WIDEST: IsaLevel = S::Stencil::<T, D>::WIDEST;

    #[inline(always)]
    fn on<M: Simd<T>>(self, simd: M) -> Self::Output {
        let Weights { scene, domains, first, present: (displacements, gradients), stencils } = self;
        for (k, stencil) in stencils.iter_mut().enumerate() {
            let pack = *first + k;
            simd.fetch(scene.reference_position, pack + AHEAD);
            simd.fetch(domains, pack + AHEAD);
            let (displacement, gradient) = match scene.kept.get(pack) {
                Some((displacement, gradient)) => (displacement, gradient),
                None => (&displacements[k], &gradients[k]),
            };
            let reference = &scene.reference_position[pack];
            let position = positions(simd, reference, displacement, scene.moves);
            if D == 2 && scene.lattice.is_meridian {
                off_the_axis(simd, position[0]).map_err(|(p, cause)| (PACK * pack + p, cause))?;
            }
            let unmoved;
            let h = if scene.moves {
                gradient
            } else {
                unmoved = Matrices::zeros();
                &unmoved
            };
            let domain = &domains[pack];
            let placed = if M::ALONE {
                let position = &vectors(simd, position);
                place_alone::<T, D, S>(stencil, scene.lattice, position, domain, h)
            } else {
                S::place(simd, stencil, scene.lattice, &position, domain, h)
            };
            if let Err(cause) = placed {
                let positions = vectors(simd, position);
                let (p, cause) = blamed::<T, D, S>(scene.lattice, &positions, domain, h, cause);
                return Err((PACK * pack + p, cause));
            }
        }
        Ok(())
    }
}

/// Refuses particles whose distance from the axis of revolution is not positive.
#[inline(always)]
fn off_the_axis<T: Real, M: Simd<T>>(simd: M, radius: M::Eight) -> Result<(), (usize, Cause)> {
    let least = T::of(f64::from(f32::MIN_POSITIVE));
    if simd.all_at_most(simd.splat(least), radius) {
        return Ok(());
    }
    let radius = simd.numbers(radius);
    let is_beyond = |r: &T| *r < least || !r.is_finite();
    let p = radius.iter().position(is_beyond).unwrap_or_default();
    Err((p, Cause::BeyondAxis { radius: radius[p].to_f64() }))
}

/// The first particle of a pack that cannot be placed alone, and the cause; the first particle of the pack if each can be.
#[cold]
fn blamed<T: Real, const D: usize, S: Shape>(
    lattice: &Lattice<T, D>,
    positions: &Vectors<T, D>,
    domains: &S::Domain<T, D>,
    displacement_gradients: &Matrices<T, D>,
    cause: Cause,
) -> (usize, Cause) {
    for p in 0..PACK {
        let h = &displacement_gradients.get(p);
        if let Err(cause) = S::stencil(lattice, &positions.get(p), &domains.get(p), h) {
            return (p, cause);
        }
    }
    (0, cause)
}
