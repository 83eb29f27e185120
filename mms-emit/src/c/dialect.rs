//! The syntax of numbers, functions and names in C.

use crate::port::body::{Arithmetic, Dialect, Owner, in_c_library};
use crate::port::names::Rules;
use crate::port::number::{decimal, nearest};
use crate::port::support::Calls;
use mms_program::interpret::parts;
use mms_symbolic::expr::{Function, Rational, Symbol};

/// Names that C takes; headers are also read by C++.
pub const RULES: Rules = Rules {
    words: &[C_KEYWORDS, CPP_KEYWORDS, MACROS],
    modules: &[C_KEYWORDS, CPP_KEYWORDS, MACROS, HEADERS],
    folds_case: false,
    longest: 120,
};

/// C23, section 6.4.1.
pub const C_KEYWORDS: &str = "\
    alignas alignof auto bool break case char const constexpr continue default do double else enum \
    extern false float for goto if inline int long nullptr register restrict return short signed \
    sizeof static static_assert struct switch thread_local true typedef typeof typeof_unqual union \
    unsigned void volatile while asm fortran near far";

/// C++23, section 5.11: the keywords that C does not have.
pub const CPP_KEYWORDS: &str = "\
    and and_eq bitand bitor catch char8_t char16_t char32_t class co_await co_return co_yield compl \
    concept const_cast consteval constinit decltype delete dynamic_cast explicit export friend \
    mutable namespace new noexcept not not_eq operator or or_eq private protected public \
    reinterpret_cast requires static_cast template this throw try typeid typename using virtual \
    wchar_t xor xor_eq";

/// Macros of the standard headers and of compilers that are used without brackets.
pub const MACROS: &str = "\
    NULL I complex imaginary noreturn errno stdin stdout stderr unix linux i386 NAN INFINITY \
    HUGE_VAL HUGE_VALF HUGE_VALL EOF RAND_MAX math_errhandling M_PI M_E MATH REAL \
    DBL_EPSILON FLT_EPSILON assert offsetof none";

/// Headers that a file of the same stem would hide.
pub const HEADERS: &str = "\
    assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg \
    stdbool stddef stdint stdio stdlib string tgmath time uchar wchar wctype std main";

/// The syntax of statements in C.
pub struct C;

impl Dialect for C {
    fn literal(&self, number: &Rational, wide: bool, calls: &mut Calls) -> String {
        match (wide, parts(number)) {
            (true, (high, 0.0)) => format!("{}({})", calls.to("wide_of"), decimal(high)),
            (true, (high, low)) => {
                format!("{}({}, {})", calls.to("wide_parts"), decimal(high), decimal(low))
            }
            (false, _) => format!("REAL({})", decimal(nearest(number))),
        }
    }

    fn pi(&self, wide: bool, calls: &mut Calls) -> String {
        if wide { format!("{}()", calls.to("wide_pi")) } else { "REAL(3.141592653589793)".into() }
    }

    fn input(&self, symbol: Symbol, name: &str) -> String {
        if symbol == Symbol::Time { name.into() } else { format!("{name}[i]") }
    }

    fn widened(&self, value: &str, calls: &mut Calls) -> String {
        format!("{}((double){value})", calls.to("wide_of"))
    }

    fn narrowed(&self, value: &str) -> String {
        format!("(real){value}.high")
    }

    fn member(&self, owner: Owner, name: &str) -> String {
        format!("{}->{name}", owner.name())
    }

    fn function(&self, function: Function) -> String {
        in_c_library(function).map_or(function.name().into(), |name| format!("MATH({name})"))
    }

    fn arithmetic(
        &self,
        operation: Arithmetic,
        a: &str,
        b: &str,
        wide: bool,
        calls: &mut Calls,
    ) -> String {
        match wide {
            true => format!("{}({a}, {b})", calls.to(operation.wide_name())),
            false => format!("{a} {} {b}", operation.sign()),
        }
    }

    fn negated(&self, a: &str, wide: bool, calls: &mut Calls) -> String {
        if wide { format!("{}({a})", calls.to("wide_neg")) } else { format!("-{a}") }
    }

    fn statement(&self, name: &str, value: &str, wide: bool) -> String {
        format!("const {} {name} = {value};", if wide { "wide" } else { "real" })
    }
}
