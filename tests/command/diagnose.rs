//! `mms diagnose`: mistakes made here by hand, in numbers from `mms eval`.

use std::fmt::Write as _;

use serde_json::Value;

use super::mms::{Folder, Run};

/// Quantities of the field at points of an even grid, from `mms eval`.
fn grid(folder: &Folder, count: usize, time: f64) -> Vec<Value> {
    let middle = |k: usize| (k as f64 + 0.5) / count as f64;
    let points = (0..count * count).map(|k| [middle(k % count), middle(k / count)]);
    let asked: String = points.map(|[x, y]| format!(" --at {x},{y}")).collect();
    let arguments = format!("eval travelling_wave_2d --time {time} --json{asked}");
    let document = folder.mms(&arguments).exits(0).json();
    document["points"].as_array().unwrap().clone()
}

/// The numbers of a quantity.
fn numbers(point: &Value, quantity: &str) -> Vec<f64> {
    point[quantity].as_array().unwrap().iter().map(|it| it.as_f64().unwrap()).collect()
}

/// A table with these columns, made of points.
fn table(header: &str, points: &[Value], row: impl Fn(&Value) -> Vec<f64>) -> String {
    let mut text = format!("{header}\n");
    for point in points {
        let cells: Vec<_> = row(point).iter().map(|it| format!("{it:e}")).collect();
        let _ = writeln!(text, "{}", cells.join(","));
    }
    text
}

fn diagnose(folder: &Folder, text: &str, options: &str) -> Run {
    folder.write("data.csv", text);
    folder.mms(&format!("diagnose travelling_wave_2d data.csv {options}"))
}

#[test]
fn a_law_alone_is_named() {
    let folder = Folder::new();
    let points = grid(&folder, 4, 0.005);
    let header = "F11,F12,F21,F22,P11,P12,P21,P22";
    let with = |stress: &dyn Fn(&Value) -> Vec<f64>| {
        table(header, &points, |point| {
            [numbers(point, "deformation_gradient"), stress(point)].concat()
        })
    };
    let first = |point: &Value| numbers(point, "first_piola_kirchhoff");
    let options = "--quantity stress";
    diagnose(&folder, &with(&first), options).exits(0).prints("nothing");
    let transposed = with(&|point| {
        let p = first(point);
        vec![p[0], p[2], p[1], p[3]]
    });
    diagnose(&folder, &transposed, options).exits(1).prints("named: stress_transposed (mistake)");
    let cauchy = with(&|point| numbers(point, "cauchy_stress"));
    diagnose(&folder, &cauchy, options).exits(1).prints("named: stress_cauchy");
    // F in single precision is visible through the tangent.
    let single = table(header, &points, |point| {
        let f = numbers(point, "deformation_gradient");
        [f.iter().map(|it| f64::from(*it as f32)).collect(), first(point)].concat()
    });
    diagnose(&folder, &single, options).exits(0).prints("nothing");
    // P12 is missing; S/J is given as S.
    let missing = with(&|point| {
        let p = first(point);
        vec![p[0], 0.0, p[2], p[3]]
    });
    let run = diagnose(&folder, &missing, options).exits(1);
    run.prints("named: stress_component_missing [P12]");
    let over = table("F11,F12,F21,F22,S11,S12,S21,S22", &points, |point| {
        let (f, p) = (numbers(point, "deformation_gradient"), first(point));
        let j = f[0] * f[3] - f[1] * f[2];
        let inverse = [f[3] / j, -f[1] / j, -f[2] / j, f[0] / j];
        let entry = |i: usize, k: usize| inverse[2 * i] * p[k] + inverse[2 * i + 1] * p[2 + k];
        let s = [entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)].map(|it| it / j);
        [f, s.to_vec()].concat()
    });
    diagnose(&folder, &over, options).exits(1).prints("named: stress_volume [over J]");
    let unit = with(&|point| first(point).iter().map(|it| it * 1e-6).collect());
    diagnose(&folder, &unit, options).exits(1).prints("another unit: 10^-6");
    // The rounding to six digits is no mistake.
    let header = "F11,F12,F21,F22,sigma11,sigma12,sigma21,sigma22";
    let rounded = table(header, &points, |point| {
        [numbers(point, "deformation_gradient"), numbers(point, "cauchy_stress")].concat()
    });
    diagnose(&folder, &rounded, options).exits(0).prints("nothing");
}

/// sigma = C:eps for every name of the measure, and P F^T/J is another stress; the tangent is C.
#[test]
fn the_law_of_the_small_strain_has_one_stress() {
    let folder = Folder::new();
    let (young, nu) = (1e6, 0.3);
    let (lambda, mu) = (young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), young / (2.0 * (1.0 + nu)));
    let number = |k: usize| 0.15 * (1.3 * k as f64 + 0.4).sin();
    let states: Vec<[f64; 4]> =
        (0..12).map(|at| [0, 1, 2, 3].map(|k| number(4 * at + k))).collect();
    let stress = |h: &[f64; 4]| {
        let (pressure, shear) = (lambda * (h[0] + h[3]), mu * (h[1] + h[2]));
        [pressure + 2.0 * mu * h[0], shear, shear, pressure + 2.0 * mu * h[3]]
    };
    let law = |name: &str, of: &dyn Fn(&[f64; 4]) -> [f64; 4]| {
        let mut text = format!("F11,F12,F21,F22,{name}11,{name}12,{name}21,{name}22\n");
        for h in &states {
            let f = [1.0 + h[0], h[1], h[2], 1.0 + h[3]];
            let cells: Vec<_> = f.iter().chain(&of(h)).map(|it| format!("{it:e}")).collect();
            let _ = writeln!(text, "{}", cells.join(","));
        }
        folder.write("law.csv", &text);
        folder.mms("diagnose plane_strain_linear_elastic law.csv --quantity stress")
    };
    for name in ["sigma", "P", "S", "tau"] {
        law(name, &stress).exits(0).prints("nothing");
    }
    let pushed = |h: &[f64; 4]| {
        let (p, f) = (stress(h), [1.0 + h[0], h[1], h[2], 1.0 + h[3]]);
        let volume = f[0] * f[3] - f[1] * f[2];
        let entry =
            |i: usize, j: usize| (p[2 * i] * f[2 * j] + p[2 * i + 1] * f[2 * j + 1]) / volume;
        [entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)]
    };
    law("sigma", &pushed).exits(1).prints("named: stress_cauchy");

    let stiffness =
        [[lambda + 2.0 * mu, lambda, 0.0], [lambda, lambda + 2.0 * mu, 0.0], [0.0, 0.0, mu]];
    let names: Vec<_> = (0..9).map(|k| format!("DDSDDE{}{}", k / 3 + 1, k % 3 + 1)).collect();
    let mut text = format!("F11,F12,F21,F22,{}\n", names.join(","));
    for h in &states {
        let f = [1.0 + h[0], h[1], h[2], 1.0 + h[3]];
        let all = f.iter().chain(stiffness.as_flattened());
        let cells: Vec<_> = all.map(|it| format!("{it:e}")).collect();
        let _ = writeln!(text, "{}", cells.join(","));
    }
    folder.write("tangent.csv", &text);
    let run = folder.mms("diagnose plane_strain_linear_elastic tangent.csv --quantity tangent");
    run.exits(0).prints("nothing");
}

#[test]
fn a_tangent_alone_is_named() {
    let folder = Folder::new();
    let points = grid(&folder, 4, 0.005);
    let (young, poisson) = (1e6, 0.3);
    let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let mu = young / (2.0 * (1.0 + poisson));
    // 11, 22, 33, 12 of neo-Hookean material in plane strain; the components that are not read are nonsense.
    let with = |of_stress: f64| {
        let names: Vec<_> = (0..16).map(|k| format!("DDSDDE{}{}", k / 4 + 1, k % 4 + 1)).collect();
        table(&format!("F11,F12,F21,F22,{}", names.join(",")), &points, |point| {
            let f = numbers(point, "deformation_gradient");
            let j = f[0] * f[3] - f[1] * f[2];
            let g = (mu - lambda * j.ln()) / j;
            let sigma = |a: usize, b: usize| {
                let left = f[a] * f[b] + f[a + 1] * f[b + 1];
                let unit = if a == b { 1.0 } else { 0.0 };
                of_stress * (mu * (left - unit) + unit * lambda * j.ln()) / j
            };
            let (x, y, xy) = (sigma(0, 0), sigma(2, 2), sigma(0, 2));
            let l = lambda / j;
            let rows = [
                [l + 2.0 * (g + x), l, 7.0, xy],
                [l, l + 2.0 * (g + y), 7.0, xy],
                [7.0; 4],
                [xy, xy, 7.0, g + (x + y) / 2.0],
            ];
            [f, rows.concat()].concat()
        })
    };
    let options = "--quantity tangent";
    diagnose(&folder, &with(1.0), options).exits(0).prints("nothing");
    diagnose(&folder, &with(0.0), options).exits(1).prints("named: tangent_truesdell (mistake)");
    let few = "F11,F12,F21,F22,DDSDDE11\n1,0,0,1,2\n";
    diagnose(&folder, few, options)
        .exits(2)
        .complains("has 1 component(s)")
        .complains("and of 2 dimension(s) 9 are expected");
    diagnose(&folder, "F11,F12,F21,F22\n1,0,0,1\n", options).exits(2).complains("no tangent");
}

#[test]
fn six_columns_of_a_stress_need_names() {
    let folder = Folder::new();
    folder.write("law.csv", "F11,F12,F21,F22,s0,s1,s2,s3,s4,s5\n1,0,0,1,0,0,0,0,0,0\n");
    let run = folder
        .mms("diagnose travelling_wave_2d law.csv --quantity stress --map sigma=s0,s1,s2,s3,s4,s5");
    run.exits(2).complains("if they are 11, 22, 33, 12, .., say `--map sigma=s0,s3,s3,s1`");
}

#[test]
fn accelerations_at_an_exact_state_name_a_term() {
    let folder = Folder::new();
    let points = grid(&folder, 16, 0.005);
    let with = |of_a: f64, of_b: f64| {
        table("X,Y,time,a_x,a_y", &points, |point| {
            let pairs =
                numbers(point, "acceleration").into_iter().zip(numbers(point, "body_force"));
            let a = pairs.map(|(a, b)| of_a * a + of_b * b).collect();
            [numbers(point, "at"), vec![0.005], a].concat()
        })
    };
    diagnose(&folder, &with(1.0, 0.0), "").exits(0).prints("accelerations at an exact state");
    diagnose(&folder, &with(1.0, -1.0), "").exits(1).prints("named: force_missing");
    let sign = diagnose(&folder, &with(3.0, -2.0), "--json").exits(1).json();
    assert_eq!(sign["finding"], "named");
    let best = &sign["ranked"][0];
    assert_eq!(best["hypothesis"], "force_sign");
    let same: Vec<_> = best["equivalent_always"].as_array().unwrap().iter().collect();
    assert!(same.contains(&&Value::from("moduli_factor")), "{same:?}");
    // An omitted body force is not reported as missing.
    diagnose(&folder, &with(1.0, -1.0), "--without body_force").exits(0).prints("nothing");
    let residual = table("X,Y,time,r_x,r_y", &points, |point| {
        let b = numbers(point, "body_force");
        [numbers(point, "at"), vec![0.005, -1000.0 * b[0], -1000.0 * b[1]]].concat()
    });
    // r = rho0 a - Div P - 2 rho0 b.
    let named = diagnose(&folder, &residual, "").exits(1);
    named.prints("residuals at an exact state").prints("named: force_twice");
    diagnose(&folder, &residual, "--residual-sign -").exits(1).prints("named: force_missing");
    // The same residual as forces: each point represents one of 16 x 16 parts of the square.
    let forces = table("X,Y,time,r_x,r_y", &points, |point| {
        let b = numbers(point, "body_force");
        let part = -1000.0 / 256.0;
        [numbers(point, "at"), vec![0.005, part * b[0], part * b[1]]].concat()
    });
    let nodal = diagnose(&folder, &forces, "--residual nodal").exits(1);
    nodal.prints("residuals at nodes at an exact state").prints("named: force_twice");
    let accelerations = forces.replace("r_x,r_y", "a_x,a_y");
    diagnose(&folder, &accelerations, "--residual nodal").exits(2).complains("no residuals");
}

#[test]
fn accelerations_beside_another_motion_are_among_results() {
    let folder = Folder::new();
    let points = grid(&folder, 16, 0.005);
    let with = |factor: f64| {
        table("X,Y,time,u_x,u_y,a_x,a_y", &points, |point| {
            let u = numbers(point, "displacement").into_iter().map(|u| factor * u).collect();
            let a = numbers(point, "acceleration");
            [numbers(point, "at"), vec![0.005], u, a].concat()
        })
    };
    let exact = diagnose(&folder, &with(1.0), "").exits(0);
    exact.prints("travelling_wave_2d: accelerations at an exact state");
    let millimetres = diagnose(&folder, &with(1000.0), "").exits(1);
    millimetres.prints("travelling_wave_2d: results").prints("named: units");
}

#[test]
fn velocities_after_one_step_name_a_term() {
    let folder = Folder::new();
    let (points, step) = (grid(&folder, 16, 0.0), 2e-4);
    let with = |of_b: f64| {
        table("X,Y,time,v_x,v_y", &points, |point| {
            let [v, a, b] = ["velocity", "acceleration", "body_force"].map(|it| numbers(point, it));
            let v = (0..2).map(|i| v[i] + step * (a[i] + of_b * b[i])).collect();
            [numbers(point, "at"), vec![step], v].concat()
        })
    };
    diagnose(&folder, &with(0.0), "").exits(0).prints("one step from an exact state");
    diagnose(&folder, &with(-1.0), "").exits(1).prints("named: force_missing");
}

#[test]
fn an_affine_state_is_compared_with_the_affine_part() {
    let folder = Folder::new();
    folder.mms("state travelling_wave_2d --cells 8 --time 0.01 --affine -o affine.csv").exits(0);
    folder.mms("diagnose travelling_wave_2d affine.csv --affine").exits(0).prints("nothing");
    folder.mms("diagnose travelling_wave_2d affine.csv").exits(1);
}

#[test]
fn results_of_a_method_are_like_it_and_go_to_the_page() {
    let folder = Folder::new();
    folder.mms("run axis_aligned_2d --cells 16 --vtk right --frames 2").exits(0);
    let like = "diagnose axis_aligned_2d right --h 0.0625 --like shape=cpgimp --output out";
    folder.mms(like).exits(0).prints("like shape=cpgimp,integrator=leapfrog").prints("to do: ");
    let document: Value = serde_json::from_str(&folder.read("out/diagnosis.json")).unwrap();
    let number = |key: &str| document["like"][key].as_f64().unwrap();
    // The reported method is right, on its grid.
    assert!((number("factor") - 1.0).abs() < 0.02, "{}", number("factor"));
    assert!(number("apart") < 0.03, "{}", number("apart"));
    folder.mms("report out").exits(0);
    let page = folder.read("out/report.html");
    assert!(page.contains("The user's error") && page.contains("Diagnoses"), "{page}");
    let run = folder.mms("diagnose axis_aligned_2d right --like shape=none").exits(2);
    run.complains("shape");
}

#[test]
fn files_that_say_too_little_are_refused() {
    let folder = Folder::new();
    let run = diagnose(&folder, "X,Y,time\n0.5,0.5,0\n0.2,0.3,0\n", "").exits(2);
    run.complains("nothing to diagnose; expected u, v, F, accelerations or residuals");
    let run = diagnose(&folder, "X,Y,u_x,u_y\n0.5,0.5,0,0\n0.2,0.3,0,0\n", "").exits(2);
    run.complains("it has no time; give it with `--time`");
    let run =
        diagnose(&folder, "X,Y,u_x,u_y,time\n0.5,0.5,0,0,0.005\n0.2,0.3,0,0,0.005\n", "").exits(2);
    run.complains("2 points are too few");
    let rows: String = (1..9).map(|k| format!("0.{k},0.{k},0,0,0\n")).collect();
    let run = diagnose(&folder, &format!("X,Y,u_x,u_y,time\n{rows}"), "").exits(2);
    run.complains("all results are at the start of the time window");
    let run = diagnose(&folder, "F11,F12,F21,F22\n1,0,0,1\n", "--quantity stress").exits(2);
    run.complains("no stress: name its columns with `--map P=..`");
    folder.mms("diagnose travelling_wave_2d").exits(2);
}

#[test]
fn hypotheses_are_listed() {
    let listed = Folder::new().mms("diagnose twisted_column --list --json").exits(0).json();
    let names = listed["hypotheses"].as_array().unwrap().iter();
    let names: Vec<_> = names.map(|it| it["hypothesis"].as_str().unwrap()).collect();
    for name in ["force_sign", "stress_transposed", "moduli_swapped", "points_permuted"] {
        assert!(names.contains(&name), "{name}");
    }
    // Without a field, with the names of sizes.
    let listed = Folder::new().mms("diagnose --list").exits(0);
    listed
        .prints("force_missing")
        .prints("traction_sign on x_max")
        .prints("law, exact state, step");
}
