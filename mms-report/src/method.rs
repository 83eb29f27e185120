//! A method in a report.

use mms_documents as documents;
use mms_options::method::Arithmetic;
use mms_runtime::{Division, FormulationName, Method, Setup, Transfer};

/// The method as a part of a document.
pub fn document(method: &Method, arithmetic: Arithmetic) -> documents::study::Method {
    let Setup { transfer, particles_per_cell, fill, jitter, seed, offset, .. } = &method.setup;
    let axes = ["x", "y", "z"].into_iter().zip(method.setup.periodic);
    let periodic: Vec<_> =
        axes.filter_map(|(name, periodic)| periodic.then_some(name.to_owned())).collect();
    let flip_fraction = match transfer {
        Transfer::Flip { fraction } => Some(*fraction),
        _ => None,
    };
    documents::study::Method {
        shape: method.shape.name().to_owned(),
        integrator: method.integrator.name().to_owned(),
        formulation: method.formulation.name().to_owned(),
        transfer: transfer.to_string(),
        flip_fraction,
        precision: arithmetic.precision.name().to_owned(),
        form: arithmetic.form.name().to_owned(),
        particles_per_cell: division(particles_per_cell),
        fill: fill.map(|fill| fill.to_string()),
        jitter: *jitter,
        seed: *seed,
        offset: offset.to_vec(),
        periodic,
        courant: method.setup.courant,
        time_step: method.setup.time_step,
        end_time: method.setup.end_time,
        relax: method.setup.relax,
    }
}

/// A number, or a text such as `32x16`.
pub fn division(division: &Division) -> documents::Division {
    match *division {
        Division::Uniform(number) => documents::Division::Uniform(number),
        Division::PerAxis(..) => documents::Division::ByAxis(division.to_string()),
    }
}

/// The method in words; defaults are left out.
pub fn line(method: &Method, arithmetic: Arithmetic) -> String {
    let Setup { transfer, particles_per_cell, fill, jitter, offset, courant, .. } = &method.setup;
    let formulation = match method.formulation {
        FormulationName::Updated => "",
        FormulationName::Total => "total ",
    };
    let mut words = vec![
        format!("{formulation}{} {}", method.shape, method.integrator),
        arithmetic.to_string(),
        format!("{particles_per_cell} particles per cell and direction"),
    ];
    match transfer {
        Transfer::Flip { fraction: 1.0 } => {}
        Transfer::Flip { fraction } => words.push(format!("flip {fraction}")),
        other => words.push(other.to_string()),
    }
    words.extend(fill.map(|fill| format!("{fill} fill")));
    if *jitter > 0.0 {
        words.push(format!("jitter {jitter}"));
    }
    if *offset != [0.0; 3] {
        words.push("grid offset".to_owned());
    }
    if method.setup.periodic != [false; 3] {
        words.push("periodic".to_owned());
    }
    if method.setup.relax {
        words.push("relaxed".to_owned());
    }
    words.push(match method.setup.time_step {
        Some(step) => format!("time step {step:e}"),
        None => format!("Courant {courant}"),
    });
    words.join(", ")
}
