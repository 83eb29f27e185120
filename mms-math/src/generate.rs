//! Macros for code that generated modules would otherwise repeat for every quantity. Not meant for other callers: the macros
//! name the structs of a generated module.

/// A function of a point in the scalar of a loop: a struct around the prepared field.
#[doc(hidden)]
#[macro_export]
macro_rules! kernel {
    ($name:ident<$scalar:ident>, $inputs:tt -> $results:tt, |$at:ident, $point:pat_param| $result:block) => {
        struct $name<'a, T: $crate::Real>(&'a AtTime<'a, T>);

        // Coordinates and normals are named as in mathematics.
        #[allow(non_snake_case)]
        impl<$scalar: $crate::Real> $crate::batch::Function<$scalar, $inputs, $results>
            for $name<'_, $scalar>
        {
            #[inline(always)]
            fn at(&self, $point: [$scalar; $inputs]) -> [$scalar; $results] {
                let $at = self.0;
                $result
            }
        }

        impl<T: $crate::batch::Float> $crate::batch::Kernel<T, $inputs, $results> for $name<'_, T> {
            #[inline(always)]
            fn drive<S: $crate::batch::Lift<T>>(
                &self,
                points: &mut impl $crate::batch::Points<S, $inputs, $results>,
            ) {
                let field = self.0.field.standing::<S>();
                points.each(&$name(&self.0.standing(&field)));
            }
        }
    };
}

/// A kernel of two functions, with numbers in between, in separate loops or in one. The second function reads the numbers with
/// the given indices, from the inputs followed by the numbers in between.
#[doc(hidden)]
#[macro_export]
macro_rules! kernels {
    (
        $name:ident = $first:ident, $second:ident $reads:tt, $loops:ident;
        $inputs:tt -> $between:tt -> $results:tt
    ) => {
        struct $name<'a, T: $crate::Real>(&'a AtTime<'a, T>);

        impl<T: $crate::batch::Float> $crate::batch::Kernel<T, $inputs, $results> for $name<'_, T> {
            #[inline(always)]
            fn drive<S: $crate::batch::Lift<T>>(
                &self,
                points: &mut impl $crate::batch::Points<S, $inputs, $results>,
            ) {
                let field = self.0.field.standing::<S>();
                let at = self.0.standing(&field);
                let loops = $crate::batch::Loops::$loops;
                points.each_then::<$between, _>(&$first(&at), &$second(&at), $reads, loops);
            }
        }
    };
}

/// A quantity at many points: from positions in either layout, and from precomputed values. With `normals`, each position has a
/// unit normal.
#[doc(hidden)]
#[macro_export]
macro_rules! batches {
    (
        $name:literal, $dimension:tt -> $results:tt;
        $whole:ident: $batch:ident, $batch_aos:ident;
        $cached:ident: $batch_at:ident, $columns:tt;
    ) => {
        impl<T: $crate::batch::Float> AtTime<'_, T> {
            #[doc = concat!(" As `", $name, "`, at many points: a slice for each coordinate and each component of the result, rows first.")]
            ///
            /// # Panics
            ///
            /// If the slices have different lengths.
            pub fn $batch(&self, points: [&[T]; $dimension], mut out: [&mut [T]; $results]) {
                $crate::batch::run(&$whole(self), &points, &mut out);
            }

            #[doc = concat!(" As `", $name, "_batch`, with the numbers of a point beside each other.")]
            ///
            /// # Panics
            ///
            /// If the slices have different lengths.
            pub fn $batch_aos(&self, points: &[[T; $dimension]], mut out: &mut [[T; $results]]) {
                $crate::batch::run(&$whole(self), &points, &mut out);
            }

            #[doc = concat!(" As `", $name, "_batch`, from what was kept of the points.")]
            ///
            /// # Panics
            ///
            /// If the slices have different lengths.
            pub fn $batch_at(&self, points: &Points<T>, mut out: [&mut [T]; $results]) {
                $crate::batch::run(&$cached(self), &points.kept.columns($columns), &mut out);
            }
        }
    };
    (
        $name:literal, normals, $dimension:tt -> $results:tt;
        $whole:ident: $batch:ident, $batch_aos:ident;
        $cached:ident: $batch_at:ident, $columns:tt;
    ) => {
        impl<T: $crate::batch::Float> AtTime<'_, T> {
            #[doc = concat!(" As `", $name, "`, at many points: a slice for each coordinate and each component of the normals and of the result.")]
            ///
            /// # Panics
            ///
            /// If the slices have different lengths.
            pub fn $batch(
                &self,
                points: [&[T]; $dimension],
                normals: [&[T]; $dimension],
                mut out: [&mut [T]; $results],
            ) {
                $crate::batch::run(&$whole(self), &(points, normals), &mut out);
            }

            #[doc = concat!(" As `", $name, "_batch`, with the numbers of a point beside each other.")]
            ///
            /// # Panics
            ///
            /// If the slices have different lengths.
            pub fn $batch_aos(
                &self,
                points: &[[T; $dimension]],
                normals: &[[T; $dimension]],
                mut out: &mut [[T; $results]],
            ) {
                $crate::batch::run(&$whole(self), &(points, normals), &mut out);
            }

            #[doc = concat!(" As `", $name, "_batch`, from what was kept of the points.")]
            ///
            /// # Panics
            ///
            /// If the slices have different lengths.
            pub fn $batch_at(
                &self,
                points: &Points<T>,
                normals: [&[T]; $dimension],
                mut out: [&mut [T]; $results],
            ) {
                let points = points.kept.columns($columns);
                $crate::batch::run(&$cached(self), &(points, normals), &mut out);
            }
        }
    };
}
