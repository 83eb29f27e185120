//! A field of any dimension, ready for a solver.

use mms_runtime::{ManufacturedField, Real};

/// A field of one, two or three dimensions in the precision `T`.
pub enum Scene<T> {
    /// A bar.
    Line(Box<dyn ManufacturedField<T, 1>>),
    /// A plane body.
    Plane(Box<dyn ManufacturedField<T, 2>>),
    /// A body in space.
    Space(Box<dyn ManufacturedField<T, 3>>),
}

impl<T: Real> From<Box<dyn ManufacturedField<T, 1>>> for Scene<T> {
    fn from(field: Box<dyn ManufacturedField<T, 1>>) -> Self {
        Scene::Line(field)
    }
}

impl<T: Real> From<Box<dyn ManufacturedField<T, 2>>> for Scene<T> {
    fn from(field: Box<dyn ManufacturedField<T, 2>>) -> Self {
        Scene::Plane(field)
    }
}

impl<T: Real> From<Box<dyn ManufacturedField<T, 3>>> for Scene<T> {
    fn from(field: Box<dyn ManufacturedField<T, 3>>) -> Self {
        Scene::Space(field)
    }
}
