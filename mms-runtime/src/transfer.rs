//! Transfers: the update of the particles' velocity from the grid.

use std::fmt;
use std::str::FromStr;

use crate::defect::{Defect, on};
use crate::extension::UnknownName;

/// The highest order of XPIC that has a name.
pub const MOST_XPIC: u32 = 5;

/// The update of a particle's velocity from the grid's velocity v_i and acceleration a_i. S q = sum_i w_ip q_i is the
/// interpolation to particles, and S+ v = sum_p w m v / m_i the map to the grid.
///
/// Positions always follow S v_i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transfer {
    /// v = `fraction` (v + dt S a) + (1 - `fraction`) S v.
    ///
    /// Brackbill, Ruppel, "FLIP: a method for adaptively zoned, particle-in-cell calculations of fluid
    /// flows in two dimensions", J. Comput. Phys. 65 (1986).
    Flip {
        /// From 0, which is PIC, to 1, which loses nothing to the grid.
        fraction: f64,
    },
    /// v = S v. The part of the velocity that the grid cannot represent is lost after one step: of first order in time.
    ///
    /// Harlow, "The particle-in-cell computing method for fluid dynamics", Methods Comput. Phys. 3 (1964).
    Pic,
    /// PIC with a linear velocity on each particle, v + C (x - x_p).
    ///
    /// Jiang, Schroeder, Selle, Teran, Stomakhin, "The affine particle-in-cell method", ACM Trans. Graph.
    /// 34 (2015). C is the velocity gradient for shape functions of degree 1 and
    /// (sum w v (x) (x_i - x_p)) (sum w (x_i - x_p) (x) (x_i - x_p))^-1 for splines.
    Apic,
    /// FLIP without the part of the velocity that the grid does not represent, (I - S S+)^m v, which m maps to the grid and
    /// back compute: v = v - (I - S S+)^m v + dt S a. With m = 1 it is PIC, except for the acceleration on the boundary.
    ///
    /// Hammerquist, Nairn, "A new method for material point method particle updates that reduces noise and
    /// enhances stability", Comput. Methods Appl. Mech. Engrg. 318 (2017), doi 10.1016/j.cma.2017.01.035.
    Xpic {
        /// m, from 1.
        order: u32,
    },
}

impl Transfer {
    /// FLIP with the fraction 1, the default.
    pub const FLIP: Self = Transfer::Flip { fraction: 1.0 };

    /// The nodal data that particles read in addition to v_i after its kick.
    #[inline(always)]
    pub(crate) fn reads(self) -> Reads {
        match self {
            Transfer::Pic | Transfer::Apic => Reads::Nothing,
            Transfer::Flip { .. } => Reads::Acceleration,
            Transfer::Xpic { .. } => Reads::VelocityBefore,
        }
    }

    /// The transfer that a solver uses: itself, unless a defect is selected.
    pub(crate) fn taken(self) -> Self {
        match self {
            Transfer::Flip { .. } if on(Defect::FlipIsPic) => Transfer::Pic,
            Transfer::Flip { fraction } if on(Defect::FlipFraction) => {
                Transfer::Flip { fraction: 1.0 - fraction }
            }
            Transfer::Xpic { order } if on(Defect::XpicOrder) => {
                Transfer::Xpic { order: order - 1 }
            }
            right => right,
        }
    }

    /// The names that users write.
    pub const NAMES: &'static [&'static str] =
        &["flip", "pic", "apic", "xpic2", "xpic3", "xpic4", "xpic5"];
}

/// The nodal data that particles read in addition to v_i after its kick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reads {
    Nothing,
    /// a_i.
    Acceleration,
    /// a_i, and v_i before the kick.
    VelocityBefore,
}

impl Default for Transfer {
    fn default() -> Self {
        Self::FLIP
    }
}

impl fmt::Display for Transfer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Transfer::Flip { .. } => f.write_str("flip"),
            Transfer::Pic => f.write_str("pic"),
            Transfer::Apic => f.write_str("apic"),
            Transfer::Xpic { order } => write!(f, "xpic{order}"),
        }
    }
}

impl FromStr for Transfer {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let order = |digits: &str| {
            let order = digits.parse().ok()?;
            (2..=MOST_XPIC).contains(&order).then_some(Transfer::Xpic { order })
        };
        let named = match text {
            "flip" => Some(Self::FLIP),
            "pic" => Some(Transfer::Pic),
            "apic" => Some(Transfer::Apic),
            _ => text.strip_prefix("xpic").and_then(order),
        };
        let unknown =
            || UnknownName { what: "transfer", given: text.to_owned(), known: Self::NAMES };
        named.ok_or_else(unknown)
    }
}
