//! Faces that no check program tests in the language itself: Fortran from C, C++ for a device.

use std::fs;

use mms_emit::port::callable::{Callable, callables};
use mms_emit::{Subject, Target};

use super::build::{is_installed, is_installed_optionally, scratch, shell, write};
use super::gallery::field;
use super::sampled::sampled;

fn target(name: &str) -> &'static Target {
    Target::find(name).expect("a target of that name")
}

/// The number of points, each with different inputs, close to points of a body.
const POINTS: usize = 5;

/// A program in C that calls every function of the C and of the Fortran bundle of one field, and prints the
/// greatest difference in eps of the greatest value.
fn caller(name: &str, functions: &[Callable], dimension: usize, parameters: usize) -> String {
    let mut text = format!(
        "#include \"{name}.h\"\n#include <float.h>\n#include <math.h>\n#include <stdio.h>\n\n\
         enum {{ COUNT = {POINTS} }};\nstatic double worst;\n\n\
         static void compare(const char *name, int count, const double *a, const double *b)\n{{\n    \
         double most = 0, least = DBL_MIN;\n    for (int k = 0; k < count; k++) {{\n        \
         most = fmax(most, fabs(a[k] - b[k]));\n        least = fmax(least, fabs(a[k]));\n    }}\n    \
         worst = fmax(worst, most / least / DBL_EPSILON);\n    \
         if (!(most <= 64 * DBL_EPSILON * least)) {{\n        printf(\"%s: %g\\n\", name, most);\n        worst = HUGE_VAL;\n    }}\n}}\n\n\
         void {name}_default_parameters_c(double parameters[{parameters}]);\n"
    );
    let mut calls = String::new();
    for callable in functions {
        let (function, count) = (&callable.name, callable.components.len());
        let subject = if callable.time { "&now" } else { "&field" };
        let mut fortran = vec!["parameters".to_string()];
        let mut declared = vec!["const double *parameters".to_string()];
        if callable.is_of_points() {
            fortran.insert(0, "COUNT".into());
            declared.insert(0, "size_t n".into());
        }
        if callable.time {
            fortran.push("t".into());
            declared.push("double t".into());
        }
        let mut columns = Vec::new();
        for (array, count) in callable.arrays() {
            fortran.push(format!("&{array}s[0][0]"));
            declared.push(format!("const double *{array}"));
            columns.extend((0..count).map(|axis| format!("{array}[{axis}]")));
        }
        declared.push("double *out".into());
        text += &format!("void {name}_{function}_c({});\n", declared.join(", "));
        let given = fortran.join(", ");
        calls += &match (callable.is_of_points(), callable.is_scalar()) {
            (true, _) => {
                let results: Vec<String> = (0..count).map(|k| format!("a[{k}]")).collect();
                format!(
                    "    {{\n        double a[{count}][COUNT], b[COUNT][{count}], c[COUNT][{count}];\n        \
                     {name}_{function}_batch({subject}, COUNT, {}, {});\n        \
                     for (int i = 0; i < COUNT; i++) for (int k = 0; k < {count}; k++) c[i][k] = a[k][i];\n        \
                     {name}_{function}_c({given}, &b[0][0]);\n        \
                     compare(\"{function}\", COUNT * {count}, &c[0][0], &b[0][0]);\n    }}\n",
                    columns.join(", "),
                    results.join(", ")
                )
            }
            (false, is_scalar) => {
                let call = match is_scalar {
                    true => format!("a[0] = {name}_{function}({subject})"),
                    false => format!("{name}_{function}({subject}, a)"),
                };
                format!(
                    "    {{\n        double a[{count}], b[{count}];\n        {call};\n        \
                     {name}_{function}_c({given}, b);\n        \
                     compare(\"{function}\", {count}, a, b);\n    }}\n"
                )
            }
        };
    }
    let squared = dimension * dimension;
    text + &format!(
        "\nint main(void)\n{{\n    const double t = 0.3125;\n    double parameters[{parameters}];\n    \
         double Xs[COUNT][{dimension}], Ns[COUNT][{dimension}], Hs[COUNT][{squared}];\n    \
         double X[{dimension}][COUNT], N[{dimension}][COUNT], H[{squared}][COUNT];\n    \
         const {name}_parameters defaults = {name}_default_parameters();\n    \
         const {name}_field field = {name}_prepare(&defaults);\n    \
         const {name}_instant now = {name}_at_time(&field, t);\n    \
         {name}_default_parameters_c(parameters);\n    \
         for (int i = 0; i < COUNT; i++) {{\n        for (int k = 0; k < {dimension}; k++) {{\n            \
         X[k][i] = Xs[i][k] = 0.9 - 0.05 * i + 0.0625 * k;\n            N[k][i] = Ns[i][k] = cos(i + k);\n        }}\n        \
         for (int k = 0; k < {squared}; k++) H[k][i] = Hs[i][k] = 0.01 * (1 + i) - 0.015625 * k;\n    }}\n\
         {calls}    printf(\"%g eps\\n\", worst);\n    return worst <= 64 ? 0 : 1;\n}}\n"
    )
}

#[test]
fn c_reads_fortran_at_many_points_as_it_reads_c() {
    if !is_installed("cc --version") || !is_installed("gfortran --version") {
        return;
    }
    for name in sampled(["conformal_sector_2d", "twisted_column"], 2) {
        let field = field(name);
        let subject = Subject::new(&field);
        let folder = scratch(&format!("faces/{name}"));
        for language in ["c", "fortran"] {
            write(&(target(language).emit)(&subject), &folder);
        }
        let (dimension, parameters) = (field.field.dimension, field.field.parameters.len());
        let text = caller(name, &callables(&field), dimension, parameters);
        fs::write(folder.join("caller.c"), text).expect("a written file");
        let line = format!(
            "gfortran -std=f2008 -O1 -ffp-contract=off -c {name}.f90 {name}_c.f90 && \
             cc -std=c99 -O1 -Wall -Wextra -Werror -ffp-contract=off caller.c {name}.c {name}.o {name}_c.o -lgfortran -lm -o caller && ./caller"
        );
        let run = shell(&line, &folder);
        let [out, err] = [&run.stdout, &run.stderr].map(|text| String::from_utf8_lossy(text));
        assert!(run.status.success(), "{}: {line}\n{out}{err}", folder.display());
        println!("{name}: {out}");
    }
}

/// Kernels that compute everything on the device, and a function at each point.
const KERNELS: &str = r#"
#include "generalized_vortex.hpp"

namespace field = generalized_vortex;

template <class T>
__global__ void force(field::Instant<T> now, std::size_t n, const T *x, const T *y, T *b1, T *b2)
{
    const std::size_t i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < n) {
        const T X[] = {x[i], y[i]};
        T b[2];
        field::body_force(now, X, b);
        b1[i] = b[0];
        b2[i] = b[1];
    }
}

template <class T> __global__ void everything(T t, T *out)
{
    const auto now = field::at_time(field::prepare(field::default_parameters<T>()), t);
    field::cauchy_stress_batch(now, 1, out, out + 1, out + 2, out + 3, out + 4, out + 5);
}

template __global__ void force(field::Instant<double>, std::size_t, const double *, const double *, double *, double *);
template __global__ void force(field::Instant<float>, std::size_t, const float *, const float *, float *, float *);
template __global__ void everything(double, double *);
template __global__ void everything(float, float *);
"#;

#[test]
fn cpp_compiles_for_a_device() {
    // Debian has no free package of it.
    if !is_installed_optionally("nvcc --version") {
        return;
    }
    let folder = scratch("faces/device");
    write(&(target("cpp").emit)(&Subject::new(&field("generalized_vortex"))), &folder);
    fs::write(folder.join("kernels.cu"), KERNELS).expect("a written file");
    let run = shell(
        "nvcc -std=c++17 --fmad=false -Werror all-warnings -c kernels.cu -o kernels.o",
        &folder,
    );
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}
