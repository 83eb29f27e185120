//! `mms check` of every combination of dimension, material, faces and motion: each has a certificate or a refusal.

use super::mms::Folder;
use crate::sampled::sampled;

/// One combination in `SHARE` is tried.
const SHARE: usize = 24;

/// The shipped materials with stable moduli; the last twice, for fibres along an axis and oblique to all.
const MATERIALS: [(&str, &str, bool); 8] = [
    ("neo_hookean", "lambda = 6e5\nmu = 4e5", false),
    ("neo_hookean_isochoric", "kappa = 8e5\nmu = 4e5", false),
    ("saint_venant_kirchhoff", "lambda = 6e5\nmu = 4e5", false),
    ("mooney_rivlin", "c1 = 1e5\nc2 = 1e5\nc3 = 4e5", false),
    ("gent", "kappa = 8e5\nmu = 4e5\nJm = 50", false),
    ("linear_elastic", "lambda = 6e5\nmu = 4e5", false),
    ("transversely_isotropic", "lambda = 6e5\nmu = 4e5\nreinforcement = 5e5", false),
    ("transversely_isotropic", "lambda = 6e5\nmu = 4e5\nreinforcement = 5e5", true),
];

/// The claim of each face; the last are claims that these motions do not keep.
const FACES: [&[&str]; 4] =
    [&[], &["traction"], &["prescribed"], &["free", "fixed", "roller", "traction"]];

/// u, whose first components a field uses: a stretch, a shear, a wave and a twist.
const MOTIONS: [[&str; 3]; 4] = [
    ["0.1*X", "0", "0"],
    ["0.05*Y", "0.02*X", "0.03*X"],
    ["0.1*sin(X)*cos(t)", "0.05*X*Y", "0.02*Z"],
    ["0.05*cos(t)*X*Y", "0.04*sin(Y + t)", "0.03*X*Z + 0.01*Y^2"],
];

/// A field of these choices: a cube, for a second.
fn field(
    dimension: usize,
    (model, moduli, is_oblique): (&str, &str, bool),
    faces: &[&str],
    motion: &[&str],
) -> String {
    // Coordinates that a field lacks are replaced by its last one.
    let last = ["X", "X", "Y", "Z"][dimension];
    let lacking = &["X", "Y", "Z"][dimension..];
    let component = |it: &&str| {
        let own = lacking.iter().fold(it.to_string(), |text, axis| text.replace(axis, last));
        format!("\"{own}\"")
    };
    let components: Vec<_> = motion[..dimension].iter().map(component).collect();
    let fibre = match (model, is_oblique) {
        ("transversely_isotropic", false) => "fibre = [1, 0, 0]\n",
        ("transversely_isotropic", true) if dimension == 3 => {
            "fibre = [\"2/3\", \"2/3\", \"1/3\"]\n"
        }
        ("transversely_isotropic", true) => "fibre = [0.6, 0.8, 0]\n",
        _ => "",
    };
    let names = ["x_min", "x_max", "y_min", "y_max", "z_min", "z_max"];
    let claims = names[..2 * dimension].iter().zip(faces.iter().cycle());
    let claims: String = claims.map(|(face, claim)| format!("{face} = \"{claim}\"\n")).collect();
    format!(
        "[field]\ntitle = \"x\"\ndimension = {dimension}\n[displacement]\nu = [{}]\n\
         [material]\nmodel = \"{model}\"\n{moduli}\n{fibre}density = 1000\n\
         [domain]\nshape = \"box\"\nlower = {:?}\nupper = {:?}\ntime = [0, 1]\n[boundary]\n{claims}",
        components.join(", "),
        vec![0; dimension],
        vec![1; dimension],
    )
}

#[test]
fn every_material_has_a_certificate_in_every_dimension() {
    let folder = Folder::new();
    let sweep = (1..=3).flat_map(|dimension| {
        let materials = MATERIALS.iter().flat_map(|material| FACES.map(|faces| (material, faces)));
        materials.flat_map(move |(material, faces)| {
            MOTIONS.iter().map(move |motion| (dimension, *material, faces, motion))
        })
    });
    let chosen = sampled(sweep, SHARE);
    let name = |index: usize| format!("{index}.toml");
    for (index, (dimension, material, faces, motion)) in chosen.iter().enumerate() {
        folder.write(&name(index), &field(*dimension, *material, faces, &motion[..]));
    }
    let is_refused = |(_, _, faces, _): &(usize, _, &[&str], _)| faces.contains(&"fixed");
    let names: Vec<_> = (0..chosen.len()).map(name).collect();
    let arguments = ["check", "--json"].into_iter().chain(names.iter().map(String::as_str));
    let run = folder.run(&arguments.collect::<Vec<_>>());
    let run = run.exits(i32::from(chosen.iter().any(is_refused)));
    let document = run.json();
    for (choice, file) in chosen.iter().zip(document["files"].as_array().expect("a list")) {
        let (dimension, (.., is_oblique), ..) = choice;
        let certificate = &file["certificate"];
        assert_eq!(certificate["finite"], true, "{choice:?}: {file}");
        // Bounds of the stress of fibres that lie along no axis are wide in space.
        let is_hard = *is_oblique && *dimension == 3;
        assert!(is_hard || certificate["strongly_elliptic"] == true, "{choice:?}: {file}");
        let objections = file["objections"].as_array().expect("a list");
        assert_eq!(!objections.is_empty(), is_refused(choice), "{choice:?}: {file}");
    }
}
