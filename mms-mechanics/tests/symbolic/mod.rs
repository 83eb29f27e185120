//! Properties of the symbolic core over random expressions, each compared with a second way: plain arithmetic on the recipe of
//! the expression, finite differences in 77 digits, dual numbers, interval arithmetic.

mod canonical;
mod curvatures;
mod derivatives;
mod differences;
mod evaluation;
mod intervals;
mod passes;
mod read;
mod recipe;
mod sorted;
