//! Corners against finite elements of scikit-fem, and against the faces that meet there.

use crate::support::{plane, zero};
use mms_spec::Face;
use mms_stability::judge;

const MODULI: [f64; 2] = [1.5, 1.0];
const ALL: &str = "x_min = 'traction'\nx_max = 'traction'\ny_min = 'traction'\ny_max = 'traction'";

/// A state with F a multiple of I, in equilibrium with dead loads.
fn shrunk(stretch: f64) -> mms_stability::Stability {
    let change = stretch - 1.0;
    judge(&plane([&format!("{change}*X"), &format!("{change}*Y")], MODULI, [1.0, 1.0], ALL))
}

/// The least eigenvalues of the same quadrant, mesh and material, assembled by scikit-fem with complex steps of P.
#[test]
fn a_corner_is_as_soft_as_finite_elements_say() {
    for (stretch, expected) in [(0.98, 0.199468), (0.95, 0.069238), (0.9, -0.190572)] {
        let corners = shrunk(stretch).corners;
        assert_eq!(corners.len(), 4);
        for corner in corners {
            assert!((corner.coercivity - expected).abs() < 2e-6, "{stretch}: {corner:?}");
        }
    }
}

/// Under a pressure for which all faces are stable, a corner of two of them grows.
#[test]
fn a_corner_is_softer_than_its_faces() {
    let found = shrunk(0.9);
    assert!(found.surfaces.iter().all(|surface| surface.least > 0.5), "{found:?}");
    assert!(found.corners.iter().all(|corner| corner.coercivity < -0.1), "{found:?}");
}

/// A motion that is symmetric about a roller is half of a motion of a free face: it is stable if the face is, and close to
/// unstable if the face is unstable.
#[test]
fn a_corner_with_a_roller_is_as_stable_as_the_face() {
    let found = |stretch: f64| {
        let [lambda, mu] = MODULI;
        let stress = |q: f64| lambda * (stretch * q).ln() / q + mu * (q - 1.0 / q);
        let across = zero(0.5, 2.0, stress) - 1.0;
        let u = [format!("{:.17}*X", stretch - 1.0), format!("{across:.17}*Y")];
        let faces = "x_min = 'roller'\ny_max = 'traction'";
        judge(&plane([&u[0], &u[1]], MODULI, [1.0, 1.0], faces))
    };
    let of_face = zero(0.3, 0.9, |stretch| found(stretch).surfaces[1].least);
    assert_eq!(found(0.5).corners[0].faces, [Face::Min(0), Face::Max(1)]);
    let of_corner = |stretch: f64| found(stretch).corners[0].coercivity;
    let [there, beyond] = [of_face, of_face - 0.1].map(of_corner);
    assert!(there > 0.0 && beyond < 0.0, "{there} {beyond}");
}
