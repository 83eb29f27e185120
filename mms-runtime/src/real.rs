//! The numbers of the solver, and vectors and matrices of them.

/// A vector with `D` components.
pub type Vector<T, const D: usize> = nalgebra::SVector<T, D>;

/// A second-order tensor with `D` x `D` components.
pub type Matrix<T, const D: usize> = nalgebra::SMatrix<T, D, D>;

/// The precision a solver computes in: `f32` or `f64`.
///
/// Implemented for every type that has the arithmetic; no manual implementation is needed.
pub trait Real:
    mms_math::Scalar<Wide: Copy + Send + Sync>
    + mms_math::batch::Float
    + nalgebra::RealField
    + bytemuck::Pod
    + serde::Serialize
    + serde::de::DeserializeOwned
    + Send
    + Sync
{
    /// The nearest value of this precision.
    fn of(value: f64) -> Self {
        <Self as mms_math::Scalar>::from_f64(value)
    }

    /// The value converted to double precision.
    fn to_f64(self) -> f64 {
        nalgebra::convert_unchecked(self)
    }
}

impl<T> Real for T where
    T: mms_math::Scalar<Wide: Copy + Send + Sync>
        + mms_math::batch::Float
        + nalgebra::RealField
        + bytemuck::Pod
        + serde::Serialize
        + serde::de::DeserializeOwned
        + Send
        + Sync
{
}

/// Vectors or matrices as arrays of their `N` numbers, matrices by columns.
///
/// # Panics
/// If the number of entries of a value is not `N`.
pub fn arrays<T: Real, V: bytemuck::Pod, const N: usize>(values: &[V]) -> &[[T; N]] {
    bytemuck::cast_slice(values)
}

/// Mutable vectors or matrices as arrays of their `N` numbers, matrices by columns.
///
/// # Panics
/// If the number of entries of a value is not `N`.
pub fn arrays_mut<T: Real, V: bytemuck::Pod, const N: usize>(values: &mut [V]) -> &mut [[T; N]] {
    bytemuck::cast_slice_mut(values)
}
