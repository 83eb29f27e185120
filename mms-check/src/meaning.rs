//! The lines of `mms check`, explained.

/// The first word of a line, and the meaning of such lines.
const MEANINGS: [(&str, &str); 14] = [
    (
        "proof",
        "holds at every point, time and value of the parameters in their ranges: by algebra, or by interval arithmetic",
    ),
    (
        "bound",
        "the largest values over the body, the times and the ranges: stretches, strain rates, waves, the stable time step, \
         digits of angles",
    ),
    ("claim", "a claim of the file on a face: its motion or its traction P N"),
    ("name", "a parameter that has the name of a quantity"),
    ("budget", "a proof that ended early: its claim may still hold"),
    (
        "rest",
        "the material at F = I: its moduli as other codes name them, or a stress where there should be none",
    ),
    (
        "extent",
        "the box that contains the moving body, for a background grid; a mesh needs cells well below the wavelength",
    ),
    (
        "waves",
        "short waves in the body: they grow unless the acoustic tensor is positive definite, and then no mesh converges",
    ),
    ("face", "short waves on the surface: they grow where the surface impedance is negative"),
    (
        "corner",
        "disturbances of a corner: they grow where the coercivity is negative, and faster on finer meshes",
    ),
    (
        "growth",
        "long waves: the least squared frequency on a coarse mesh; if it is below 0, a wave grows",
    ),
    ("solve", "whether Newton's method converges to the exact state from zero"),
    ("u", "where the formula of u has no value as it is written"),
    ("check", "a closed form of the file compared with the derived one, in 77 digits"),
];

/// The meanings of the lines in a text, one for each kind of line.
pub fn of(text: &str) -> String {
    let has = |word: &str| text.lines().any(|line| line.split_whitespace().next() == Some(word));
    let lines = MEANINGS.iter().filter(|(word, _)| has(word));
    let lines: String = lines.map(|(word, says)| format!("\n  {word:<6} {says}")).collect();
    format!(
        "\n\nthese lines say:{lines}\n  `mms explain TERM` explains a word; numbers in mu are multiples of the shear \
         modulus at rest"
    )
}
