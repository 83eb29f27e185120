//! Arguments of functions: of all magnitudes, and dense where digits could be lost.

use mms_math::{Double, Scalar as _};

/// The range of the arguments of a function. Exponents are binary.
#[derive(Clone, Copy, Debug)]
pub enum Range {
    /// Either sign, with uniform exponents.
    Magnitudes(f64, f64),
    /// Positive, with uniform exponents.
    Positive(f64, f64),
    /// Uniform.
    Between(f64, f64),
    /// A number plus or minus differences with uniform exponents.
    Around(f64, f64, f64),
    /// A number plus differences with uniform exponents.
    Above(f64, f64, f64),
    /// A number minus differences with uniform exponents.
    Below(f64, f64, f64),
    /// Next to up to this many quarter turns of pi/2.
    QuarterTurns(f64),
    /// Next to up to this many quarter turns of 1/2.
    QuartersOfHalves(f64),
}

use Range::{Above, Around, Below, Between, Magnitudes, Positive, QuarterTurns, QuartersOfHalves};

/// A fixed sequence (Steele, Lea and Flood, 2014).
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// A uniformly distributed number.
    pub fn between(&mut self, lower: f64, upper: f64) -> f64 {
        lower + (upper - lower) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A low part for `high`: mostly any, sometimes 0 or much smaller than possible.
    fn completed(&mut self, high: f64) -> Double {
        let low = self.between(-0.5, 0.5) * high / (1_u64 << 53) as f64;
        let low = match self.next() % 8 {
            0 => 0.0,
            1 => low * self.between(-60.0, 0.0).exp2(),
            _ => low,
        };
        Double::new(high, low)
    }

    fn positive(&mut self, lower: f64, upper: f64) -> Double {
        let high = self.between(lower, upper).exp2();
        self.completed(high)
    }

    fn sign(&mut self) -> f64 {
        if self.next().is_multiple_of(2) { 1.0 } else { -1.0 }
    }

    /// An argument of a range.
    pub fn of(&mut self, range: Range) -> Double {
        match range {
            Magnitudes(lower, upper) => self.positive(lower, upper) * self.sign().into(),
            Positive(lower, upper) => self.positive(lower, upper),
            Between(lower, upper) => {
                let high = self.between(lower, upper);
                self.completed(high)
            }
            Around(center, lower, upper) => {
                Double::from(center) + self.of(Magnitudes(lower, upper))
            }
            Above(center, lower, upper) => Double::from(center) + self.positive(lower, upper),
            Below(center, lower, upper) => Double::from(center) - self.positive(lower, upper),
            QuarterTurns(count) => {
                let turns = Double::from(0.5 * self.between(-count, count).round());
                Double::pi() * turns + self.of(Magnitudes(-150.0, -1.0))
            }
            QuartersOfHalves(count) => {
                let turns = Double::from(0.5 * self.between(-count, count).round());
                turns + self.of(Magnitudes(-150.0, -1.0))
            }
        }
    }
}
