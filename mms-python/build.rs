//! Writes a method for each quantity, from the list in `mms-spec`, with what its documentation says: the classes have the same
//! methods, and differ in what is given already.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs, io};

use mms_spec::quantity::{Quantity, Shape};

/// A class with a method for each quantity.
struct Class {
    name: &'static str,
    /// The arguments as Python has them.
    signature: &'static str,
    /// The arguments in Rust.
    arguments: &'static str,
    /// The function that is called for the quantity `QUANTITY`.
    call: &'static str,
    /// The sentences about arguments.
    says: &'static str,
}

const CLASSES: [Class; 3] = [
    Class {
        name: "Field",
        signature: "X, t=None",
        arguments: "X: &Bound<'py, PyAny>, #[pyo3(from_py_with = crate::array::time)] t: Option<f64>",
        call: "self.opened.quantity(py, QUANTITY, &Points::given(X, &self.opened)?, t)",
        says: "X: (..., D) reference positions; for D = 1 also (n,). t: the time, which a static field needs none of.",
    },
    Class {
        name: "Now",
        signature: "X",
        arguments: "X: &Bound<'py, PyAny>",
        call: "self.opened.quantity(py, QUANTITY, &Points::given(X, &self.opened)?, Some(self.time))",
        says: "X: (..., D) reference positions; for D = 1 also (n,).",
    },
    Class {
        name: "AtPoints",
        signature: "t=None",
        arguments: "#[pyo3(from_py_with = crate::array::time)] t: Option<f64>",
        call: "self.stay.quantity(py, &self.opened, QUANTITY, t)",
        says: "t: the time, which a static field needs none of.",
    },
];

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    let mut text = String::new();
    for class in &CLASSES {
        write(&mut text, class).expect("writing to a string");
    }
    fs::write(out.join("quantities.rs"), text)
}

fn write(text: &mut String, class: &Class) -> Result<(), std::fmt::Error> {
    let Class { name, signature, arguments, call, says } = class;
    writeln!(text, "#[pymethods]\n#[allow(non_snake_case)]\nimpl {name} {{")?;
    for quantity in Quantity::evaluated().filter(|it| !it.takes_normal()) {
        let shape = match quantity.shape() {
            Shape::Scalar => "(...,)",
            Shape::Vector => "(..., D)",
            Shape::Tensor => "(..., D, D), rows first",
        };
        let doc = format!(
            "{} The unit is {}.\n\n{says}\nReturns {shape}, in the precision of X.\nRaises MmsError where a number is not \
             finite, or a shape is not the field's.",
            quantity.doc(),
            quantity.unit(),
        );
        writeln!(text, "    #[doc = {doc:?}]")?;
        writeln!(text, "    #[pyo3(signature = ({signature}))]")?;
        let call = call.replace("QUANTITY", &format!("Quantity::{quantity:?}"));
        writeln!(
            text,
            "    fn {}<'py>(&self, py: Python<'py>, {arguments}) -> PyResult<Bound<'py, PyAny>> {{\n        {call}\n    }}",
            quantity.name(),
        )?;
    }
    writeln!(text, "}}")
}
