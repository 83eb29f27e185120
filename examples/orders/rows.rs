//! The rows of the tables: fields, methods, levels, and the reason if theory expects another order.

use mms_runtime::{Fill, Method, UnknownName};

/// A row of the table of orders in time: one grid, and the Courant number halved from level to level.
pub struct InTime {
    /// The field.
    pub field: &'static str,
    /// The method, written as in a [`Row`].
    pub method: &'static str,
    /// The grid.
    pub cells: usize,
    /// The formal order.
    pub order: f64,
    /// The reason if the solver does not show that order.
    pub reason: &'static str,
}

/// A row in time.
const fn time(field: &'static str, method: &'static str, cells: usize, order: f64) -> InTime {
    InTime { field, method, cells, order, reason: "" }
}

/// The reason for an error that does not shrink with dt.
const MAPS: &str = "each step loses O(h^2) by the map to the grid and back, which adds up with the number of steps";

/// The orders in time of integrators and transfers.
pub const IN_TIME: &[InTime] = &[
    time("bar_1d", "total linear leapfrog", 64, 2.0),
    time("bar_1d", "total linear usl", 64, 1.0),
    time("bar_1d", "total linear usf", 64, 1.0),
    time("bar_1d", "total linear musl", 64, 1.0),
    time("bar_1d", "updated cpgimp usl", 64, 1.0),
    time("axis_aligned_2d", "total linear leapfrog", 64, 2.0),
    time("axis_aligned_2d", "total linear leapfrog apic", 64, 2.0),
    time("axis_aligned_2d", "total linear usl", 64, 1.0),
    time("axis_aligned_3d", "total linear leapfrog apic", 16, 2.0),
    InTime { reason: MAPS, ..time("axis_aligned_3d", "total linear leapfrog", 16, 2.0) },
    InTime { reason: MAPS, ..time("bar_1d", "total quadratic_bspline leapfrog", 64, 2.0) },
    InTime { reason: MAPS, ..time("bar_1d", "total quadratic_bspline leapfrog xpic2", 64, 2.0) },
];

/// A row of a table.
pub struct Row {
    /// The field.
    pub field: &'static str,
    /// A rigid motion on top, as `--rigid` takes it; empty for none.
    pub twin: &'static str,
    /// Formulation, shape function, integrator, and what else differs from the default.
    pub method: &'static str,
    /// The levels, coarse to fine.
    pub levels: &'static [usize],
    /// The accepted distance of the order from 2, if it is more than usual.
    pub tolerance: f64,
    /// The reason for another verdict or other levels; empty for none.
    pub reason: &'static str,
}

impl Row {
    /// The method of the row.
    pub fn method(&self) -> Result<Method, UnknownName> {
        method(self.method)
    }
}

/// The method described by words, separated by blanks.
pub fn method(words: &str) -> Result<Method, UnknownName> {
    let mut method = Method::default();
    for word in words.split(' ') {
        match word.split_once('=') {
            Some(("courant", value)) => method.setup.courant = value.parse().unwrap_or(f64::NAN),
            Some((_, value)) => {
                method.setup.particles_per_cell =
                    value.parse().unwrap_or(method.setup.particles_per_cell);
            }
            None => match word {
                "updated" | "total" => method.formulation = word.parse()?,
                "usl" | "usf" | "musl" | "leapfrog" => method.integrator = word.parse()?,
                "cartesian" | "fitted" => method.setup.fill = Some(word.parse::<Fill>()?),
                "pic" | "apic" | "xpic2" | "xpic3" => method.setup.transfer = word.parse()?,
                shape => method.shape = shape.parse()?,
            },
        }
    }
    Ok(method)
}

/// A row in space.
const fn space(
    field: &'static str,
    method: &'static str,
    levels: &'static [usize],
    reason: &'static str,
) -> Row {
    Row { field, twin: "", method, levels, tolerance: 0.0, reason }
}

/// A row whose order settles only on finer meshes.
const fn space_within(
    tolerance: f64,
    field: &'static str,
    method: &'static str,
    levels: &'static [usize],
    reason: &'static str,
) -> Row {
    Row { tolerance, ..space(field, method, levels, reason) }
}

/// A row for a rigid twin of a field.
const fn twin(
    field: &'static str,
    twin: &'static str,
    method: &'static str,
    levels: &'static [usize],
    reason: &'static str,
) -> Row {
    Row { twin, tolerance: 0.2, ..space(field, method, levels, reason) }
}

const LINE: &[usize] = &[16, 32, 64, 128];
const PLANE: &[usize] = &[8, 16, 32, 64];
const SPACE: &[usize] = &[4, 8, 16, 32];
const RING: &[usize] = &[16, 32, 64, 128];
const RINGS: &[usize] = &[32, 64, 128, 256];

/// The standard twin: an accelerated translation by three lengths; in two dimensions also a rotation by two radians.
pub const STANDARD: &str = "standard";

/// The tables: titles, texts, rows.
pub const GROUPS: &[(&str, &str, &[Row])] = &[
    (
        "Aligned motion, contiguous particles",
        "Second order in space and time: the domains of particles stay boxes without gaps.",
        &[
            space("bar_1d", "updated cpgimp leapfrog", LINE, ""),
            space("axis_aligned_1d", "updated cpgimp leapfrog", LINE, ""),
            space("axis_aligned_2d", "updated cpgimp leapfrog", PLANE, ""),
            space("axis_aligned_3d", "updated cpgimp leapfrog", SPACE, ""),
            space("bar_1d", "updated cpdi leapfrog", LINE, ""),
            space("axis_aligned_2d", "updated cpdi leapfrog", PLANE, ""),
        ],
    ),
    (
        "Total Lagrangian",
        "No particle crosses a cell. The lumped mass caps the order at 2.",
        &[
            space("bar_1d", "total linear leapfrog", LINE, ""),
            space("bar_1d", "total ugimp leapfrog", LINE, ""),
            space("bar_1d", "total quadratic_bspline leapfrog", LINE, ""),
            space(
                "bar_1d",
                "total cubic_bspline leapfrog",
                LINE,
                "lumped mass where the knots end",
            ),
            space("axis_aligned_1d", "total linear leapfrog", LINE, ""),
            space("axis_aligned_2d", "total linear leapfrog", PLANE, ""),
            space("axis_aligned_3d", "total linear leapfrog", SPACE, ""),
            space("axis_aligned_1d", "total quadratic_bspline leapfrog", LINE, ""),
            space("axis_aligned_2d", "total quadratic_bspline leapfrog", PLANE, ""),
            space("axis_aligned_3d", "total quadratic_bspline leapfrog", SPACE, ""),
        ],
    ),
    (
        "Rigid twins",
        "The same stresses, in a body that moves and turns. In the updated formulation it does so through the \
         grid.",
        &[
            twin("bar_1d", STANDARD, "total linear leapfrog", LINE, ""),
            twin("bar_1d", STANDARD, "total quadratic_bspline leapfrog", LINE, ""),
            twin("bar_1d", STANDARD, "updated cpgimp leapfrog", LINE, ""),
            twin("quiet_boundary_2d", STANDARD, "total linear leapfrog", PLANE, ""),
            twin("quiet_boundary_2d", STANDARD, "total quadratic_bspline leapfrog", PLANE, ""),
            twin(
                "quiet_boundary_2d",
                STANDARD,
                "updated cpdi leapfrog",
                &[24, 34, 48, 68],
                "coarser grids have nodes where the bump, continued beyond the body, folds",
            ),
        ],
    ),
    (
        "Curved bodies",
        "Particles lie along the circles. With splines, cells that the faces cut may have few particles; more \
         particles restore the order.",
        &[
            space_within(
                0.25,
                "generalized_vortex",
                "total quadratic_bspline leapfrog courant=0.05",
                RINGS,
                "",
            ),
            space(
                "generalized_vortex_third",
                "total quadratic_bspline leapfrog",
                RINGS,
                "the maximum, where the faces cut cells",
            ),
            space("generalized_vortex_third", "updated cpdi leapfrog", RINGS, ""),
            space(
                "generalized_vortex_third",
                "updated cpgimp leapfrog",
                RINGS,
                "boxes do not follow shear: no order 2",
            ),
            space("expanding_ring", "updated cpdi leapfrog", RING, ""),
            space(
                "expanding_ring",
                "total quadratic_bspline leapfrog",
                RING,
                "few particles in the cells that the faces cut",
            ),
            space(
                "expanding_ring",
                "total quadratic_bspline leapfrog particles=4",
                RING,
                "the maximum, on the finest grid",
            ),
            space(
                "expanding_ring",
                "updated cpgimp leapfrog",
                RING,
                "boxes overlap and gap along a circle",
            ),
            space(
                "expanding_ring",
                "updated cpgimp leapfrog cartesian",
                RING,
                "boxes overlap and gap, and edges are ragged",
            ),
        ],
    ),
    (
        "Moved and loaded faces",
        "Nodes at a face follow the field, or the traction of the field acts on the face.",
        &[
            space("uniform_stretch", "total linear leapfrog", LINE, ""),
            space("uniform_stretch", "updated cpdi leapfrog", LINE, ""),
            space(
                "uniform_stretch",
                "updated cpgimp leapfrog",
                LINE,
                "a particle's box gets as wide as a cell",
            ),
            space("travelling_wave_2d", "updated cpgimp leapfrog", PLANE, ""),
            space_within(0.2, "cyclic_shear_3d", "total linear leapfrog", SPACE, ""),
            space(
                "sheared_block_2d",
                "updated cpdi leapfrog particles=3",
                PLANE,
                "the maximum is at the corner of two loaded faces, which is unstable under them: see `mms check`",
            ),
            space(
                "sheared_block_2d",
                "total linear leapfrog",
                PLANE,
                "likewise; with amplitude=0.15, where the corner is stable, orders 1.57, 1.81, 1.89 and a pass",
            ),
            space("plane_strain_mooney_rivlin", "total linear leapfrog", PLANE, ""),
        ],
    ),
    (
        "Methods that must fail",
        "These methods are judged against order 2 as well.",
        &[
            space(
                "bar_1d",
                "updated cpgimp usl courant=0.27",
                LINE,
                "velocities half a step off: order 1",
            ),
            space("bar_1d", "updated cpgimp usf courant=0.27", LINE, "order 1"),
            space("bar_1d", "updated cpgimp musl courant=0.27", LINE, "order 1"),
            space("bar_1d", "updated cpgimp leapfrog pic", LINE, "order 1"),
            space("bar_1d", "updated linear leapfrog", LINE, "particles cross cells"),
            space("bar_1d", "updated ugimp leapfrog", LINE, "gaps and overlaps"),
            space("bar_1d", "updated quadratic_bspline leapfrog", LINE, "a free end between knots"),
        ],
    ),
    (
        "Other transfers",
        "They keep the order.",
        &[
            space("bar_1d", "updated cpgimp leapfrog apic", LINE, ""),
            space("bar_1d", "updated cpgimp leapfrog xpic2", LINE, ""),
            space("bar_1d", "total quadratic_bspline leapfrog apic", LINE, ""),
            space("bar_1d", "total quadratic_bspline leapfrog xpic3", LINE, ""),
        ],
    ),
];
