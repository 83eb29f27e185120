//! Decides which products are fused with the sum that they are added to: one instruction on processors that multiply and add in
//! one step.
//!
//! A fused product is `mul_add`: a product and a sum in `f64`, with the interpreter's bits, and one instruction if a loop over
//! points is compiled for a processor that has it.

use crate::program::{Instr, Op, Value};
use mms_symbolic::expr::Stage;

/// `±a b ± c`.
#[derive(Clone, Copy, Debug)]
pub struct Fused {
    /// a and b.
    pub factors: [Value; 2],
    /// c.
    pub term: Value,
    /// Whether the product is subtracted.
    pub minus_product: bool,
    /// Whether the term is subtracted.
    pub minus_term: bool,
}

/// The fused operations, by position in a program.
pub struct Fusion {
    /// The sums with which a product is fused.
    pub fused: Vec<Option<Fused>>,
    /// The products that are fused with every sum that reads them: they need not be computed separately.
    pub absorbed: Vec<bool>,
}

impl Fusion {
    /// No product is fused.
    pub fn none(instrs: &[Instr]) -> Self {
        Fusion { fused: vec![None; instrs.len()], absorbed: vec![false; instrs.len()] }
    }

    /// Fuses each sum that a function computes with a product that it computes too. If both operands are products, the one with
    /// fewer readers is fused.
    pub fn new(instrs: &[Instr], roots: &[Value], needed: &[bool], own: &[Stage]) -> Self {
        let mut fusion = Fusion::none(instrs);
        let mut readers = vec![0_usize; instrs.len()];
        roots.iter().for_each(|root| readers[root.index()] += 1);
        let computed = |index: usize| needed[index] && own.contains(&instrs[index].stage);
        for index in (0..instrs.len()).filter(|index| computed(*index)) {
            instrs[index].op.operands().for_each(|operand| readers[operand.index()] += 1);
        }
        let mut plain = readers.clone();
        for index in (0..instrs.len()).filter(|index| computed(*index)) {
            let (a, b, minus) = match instrs[index].op {
                Op::Add(a, b) => (a, b, false),
                Op::Subtract(a, b) => (a, b, true),
                _ => continue,
            };
            let factors = |value: Value| match instrs[value.index()].op {
                Op::Multiply(a, b) if computed(value.index()) => Some([a, b]),
                _ => None,
            };
            let few = |value: Value| readers[value.index()];
            let (product, fused) = match (factors(a), factors(b)) {
                (Some(factors), other) if other.is_none() || few(a) < few(b) => {
                    let (minus_product, minus_term) = (false, minus);
                    (a, Fused { factors, term: b, minus_product, minus_term })
                }
                (_, Some(factors)) => {
                    let (minus_product, minus_term) = (minus, false);
                    (b, Fused { factors, term: a, minus_product, minus_term })
                }
                _ => continue,
            };
            fusion.fused[index] = Some(fused);
            plain[product.index()] -= 1;
            fusion.absorbed[product.index()] = plain[product.index()] == 0;
        }
        fusion
    }
}
