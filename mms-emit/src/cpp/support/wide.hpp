/// A number of twice the digits of a double: the unevaluated sum of two.
struct wide {
    double high, low;
};

using std::atan2, std::cbrt, std::exp, std::fabs, std::floor, std::fmod, std::frexp, std::isfinite;
using std::ldexp, std::log, std::pow, std::sqrt, std::tanh;

FUNCTIONS

FIELD_FUNCTION wide operator-(wide a)
{
    return wide_neg(a);
}

FIELD_FUNCTION wide operator+(wide a, wide b)
{
    return wide_add(a, b);
}

FIELD_FUNCTION wide operator-(wide a, wide b)
{
    return wide_sub(a, b);
}

FIELD_FUNCTION wide operator*(wide a, wide b)
{
    return wide_mul(a, b);
}

FIELD_FUNCTION wide operator/(wide a, wide b)
{
    return wide_div(a, b);
}
