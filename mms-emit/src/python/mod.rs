//! Python: a module for one point at a time that needs `math` alone.

pub(super) mod check;
mod dialect;
pub(super) mod module;

pub(super) use self::dialect::Library;
use crate::port::Port;
use crate::port::names::Rules;
use crate::target::{Bundle, Subject, Target};
use mms_symbolic::expr::Function;

/// Python with `math`.
pub const TARGET: Target = Target {
    name: "python",
    alias: None,
    doc: "Python: a module that needs only the standard library, and a check program",
    emit: |subject| bundle(subject, Library::Math),
    words: RULES.words,
};

/// Rules of Python for names.
const RULES: Rules = Rules {
    words: &[KEYWORDS, "self float sp print match case type"],
    modules: &[KEYWORDS, MODULES],
    folds_case: false,
    longest: 120,
};

/// The Python Language Reference, section 2.3.1.
const KEYWORDS: &str = "\
    False None True and as assert async await break class continue def del elif else except finally \
    for from global if import in is lambda nonlocal not or pass raise return try while with yield";

/// Modules that a file of the same stem would hide.
const MODULES: &str = "\
    math numpy dataclasses sys os abc array ast base64 bisect calendar cmath code collections copy \
    csv ctypes datetime decimal enum errno fractions functools heapq importlib inspect io itertools \
    json keyword logging numbers operator pickle platform random re reprlib select signal site \
    socket stat statistics string struct subprocess tempfile test threading time token traceback \
    types typing unittest uuid warnings weakref zlib scipy sympy ufl basix ffcx dolfinx mpmath";

/// The functions that UFL has.
const IN_UFL: &[Function] = &[
    Function::Sqrt,
    Function::Exp,
    Function::Ln,
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Sinh,
    Function::Cosh,
    Function::Tanh,
    Function::Asin,
    Function::Acos,
    Function::Atan,
    Function::Atan2,
    Function::Powf,
];

/// The module of a library, and the program that checks it.
pub(super) fn bundle(subject: &Subject<'_>, library: Library) -> Bundle {
    let port = match library {
        Library::Math | Library::NumPy => Port::new(subject, &RULES),
        Library::SymPy => Port::once(subject, &RULES, Function::ALL),
        Library::Ufl => Port::once(subject, &RULES, IN_UFL),
    };
    let texts = [(".py", module::text(&port, library)), ("_check.py", check::text(&port, library))];
    port.bundle(texts, "python3 -W error FIELD_check.py")
}
