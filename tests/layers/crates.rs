[
    Crate {
        name: "mms-math",
        knows: &[],
        layers: &[
            "defect double lane quick",
            "batch block dispatch float kept machine places structures",
            "bunched generate",
        ],
    },
    Crate {
        name: "mms-symbolic",
        knows: &[],
        layers: &[
            "work",
            "expr",
            "pass",
        ],
    },
    Crate {
        name: "mms-program",
        knows: &["mms-math", "mms-symbolic"],
        layers: &[
            "effort program",
            "fusion interpret loops",
            "block dual interval precise schedule",
            "computed fan precision",
        ],
    },
    Crate {
        name: "mms-spec",
        knows: &[],
        layers: &[
            "brackets foreign quantity suggest",
            "source",
            "diagnostic formula",
            "document form syntax",
            "domain format names study table value",
            "field_name rigid symbols",
            "check",
            "field material moduli",
            "folder twin units",
        ],
    },
    Crate {
        name: "mms-mechanics",
        knows: &["mms-math", "mms-program", "mms-spec", "mms-symbolic"],
        layers: &[
            "defect extent invariant meanings resolve",
            "expansion model",
            "face misread place",
            "amplitude offset rounding",
            "tensor",
            "kinematics",
            "finite material small_strain",
            "derivation",
            "boundary rigid simplify",
            "output",
            "sample",
        ],
    },
    Crate {
        name: "mms-codegen",
        knows: &["mms-math", "mms-mechanics", "mms-program", "mms-spec", "mms-symbolic"],
        layers: &[
            "bounds culprit liveness materials variation",
            "declared",
            "compile selection",
            "certify rust",
            "driver",
        ],
    },
    Crate {
        name: "mms-analysis",
        knows: &["mms-codegen", "mms-math", "mms-mechanics", "mms-program", "mms-spec", "mms-symbolic"],
        layers: &[
            "accuracy operations period visibility",
        ],
    },
    Crate {
        name: "mms-emit",
        knows: &["mms-analysis", "mms-codegen", "mms-math", "mms-mechanics", "mms-program", "mms-spec", "mms-symbolic"],
        layers: &[
            "port target text",
            "c fortran octave python rust rust_mms_math",
            "cpp julia moose numpy sympy ufl",
            "karamelo",
        ],
    },
    Crate {
        name: "mms-show",
        knows: &["mms-analysis", "mms-codegen", "mms-math", "mms-mechanics", "mms-program", "mms-spec", "mms-symbolic"],
        layers: &[
            "name relation sympy",
            "walk",
            "language",
            "abbreviate balance document energy fibres matrix motion page reading rigid small_strain stress text",
            "latex mathml",
        ],
    },
    Crate {
        name: "mms-macros",
        knows: &["mms-codegen", "mms-spec"],
        layers: &[
            "request",
        ],
    },
    Crate {
        name: "mms-convergence",
        knows: &[],
        layers: &[
            "sequence student verdict",
            "least order",
            "grid limit term",
            "finding",
            "judgement",
            "words",
        ],
    },
    Crate {
        name: "mms-results",
        knows: &[],
        layers: &[
            "cell mistake names snapshot",
            "motion norm read",
        ],
    },
    Crate {
        name: "mms-runtime",
        knows: &["mms-convergence", "mms-math"],
        layers: &[
            "defect extension real threads",
            "column nodal tensor transfer",
            "formulation lanes material",
            "field",
            "failure",
            "body integrator lattice",
            "grid particle stencil",
            "boundary gimp shape spline",
            "method",
            "solver",
            "study",
            "scene",
        ],
    },
    Crate {
        name: "mms-gallery",
        knows: &["mms-runtime"],
        layers: &[
        ],
    },
    Crate {
        name: "mms-capi",
        knows: &["mms-codegen", "mms-mechanics", "mms-program", "mms-spec", "mms-symbolic"],
        layers: &[
            "error evaluator settings",
            "memory stop",
            "border",
            "field",
            "gallery",
            "abi",
        ],
    },
    Crate {
        name: "mms",
        knows: &["mms-analysis", "mms-codegen", "mms-convergence", "mms-emit", "mms-gallery", "mms-mechanics", "mms-program", "mms-results", "mms-runtime", "mms-show", "mms-spec", "mms-symbolic"],
        layers: &[
            "gallery interpreted read rows shell",
            "schema workbench",
            "checkpoint cli extremes history judge page report store tradeoff trial verify vtk",
        ],
    },
]
