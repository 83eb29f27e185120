//! A program that runs one scene contains the code of that scene and of no other: a test of its symbols.

mod common;

use common::Bar;
use mms_runtime::integrator::Leapfrog;
use mms_runtime::shape::Cpgimp;
use mms_runtime::{FormulationName, ManufacturedField, Setup, Solver};
use object::{Object as _, ObjectSymbol as _};

/// The functions of this program, and their sizes.
fn functions() -> Vec<(String, u64)> {
    let path = std::env::current_exe().expect("this program");
    let bytes = std::fs::read(path).expect("its file");
    let file = object::File::parse(&*bytes).expect("an object file");
    let symbols = file.symbols().filter(|symbol| symbol.kind() == object::SymbolKind::Text);
    symbols.filter_map(|it| Some((it.name().ok()?.to_owned(), it.size()))).collect()
}

/// Takes one step of a field with the shape function and the integrator of the scene.
fn step<const D: usize>(field: &dyn ManufacturedField<f64, D>) {
    let (updated, setup) = (FormulationName::Updated, Setup::default());
    let solver = Solver::<f64, D, _>::new::<Cpgimp>(field, updated, &setup, &16.into());
    solver.expect("a field to run").step::<Leapfrog>().expect("a step");
}

/// One precision, one shape function: its weights, P2G, G2P and the residual of XPIC. Only in release builds, and only in two or
/// three dimensions, there are versions for more instructions, also of the sums over three and four nodes (onto them with slopes
/// and without; of values, gradients and slopes). No spline or parallelogram.
#[test]
#[cfg(target_os = "linux")]
fn a_bar_needs_the_solver_of_a_bar() {
    step::<1>(&Bar::default());
    #[cfg(not(debug_assertions))]
    step::<2>(&common::wave::Wave::on(mms_runtime::Body::Box {
        lower: mms_runtime::Vector::zeros(),
        upper: mms_runtime::Vector::repeat(1.0),
    }));

    let all = functions();
    let named = |parts: &[&str]| -> Vec<&str> {
        let names = all.iter().map(|(name, _)| name.as_str());
        names.filter(|name| parts.iter().all(|part| name.contains(part))).collect()
    };
    assert!(!named(&["mms_runtime"]).is_empty(), "names are there");
    // In the names of symbols, the length of a part is before it.
    let (passes, sums) = (4, 2 * (2 + 3));
    // With more optimisation the passes are inlined.
    if cfg!(debug_assertions) {
        let kernels = named(&["8dispatch8baseline"]);
        assert_eq!(kernels.len(), passes, "{kernels:?}");
        // One sum onto nodes, and one over them.
        let kernels = named(&["7stencil5alone", "_alone"]);
        assert_eq!(kernels.len(), 2, "{kernels:?}");
    }
    let kernels = named(&["Plain", "5apart"]);
    assert!(kernels.is_empty(), "{kernels:?}");
    if cfg!(all(target_arch = "x86_64", debug_assertions)) {
        let kernels = named(&["8dispatch", "avx"]);
        assert!(kernels.is_empty(), "{kernels:?}");
    } else if cfg!(target_arch = "x86_64") {
        let kernels = named(&["8dispatch4avx2"]);
        assert_eq!(kernels.len(), passes + sums, "{kernels:?}");
    }
    // Closures that are not inlined under the dispatch are compiled without the processor's instructions, and call each of
    // them.
    for numbers in ["_pd", "_ps"] {
        let called = named(&["core_arch", "_mm", numbers]);
        assert!(called.is_empty(), "{called:?}");
    }
    for other in ["set_near_ends", "cpdi", "Musl", "Usf"] {
        let mut found = named(&["mms_runtime", other]);
        // Identical functions are merged, under the name of any of them.
        found.retain(|name| !name.contains("drop_in_place"));
        assert!(found.is_empty(), "{found:?}");
    }
}
