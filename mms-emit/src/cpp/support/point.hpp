#include <cmath>

#define FIELD_FUNCTION inline

/// sin(pi x): whole turns, and then quarters, are taken off without error.
template <class T> FIELD_FUNCTION T sin_pi(T x)
{
    const T turn = x - T(2.0) * std::rint(T(0.5) * x);
    const T quarters = std::rint(T(2.0) * turn);
    const T angle = T(3.141592653589793) * (turn - T(0.5) * quarters);
    if (std::fabs(quarters) > T(1.5)) {
        return -std::sin(angle);
    }
    if (std::fabs(quarters) > T(0.5)) {
        return std::copysign(std::cos(angle), quarters);
    }
    return std::sin(angle);
}

/// cos(pi x), in the same way.
template <class T> FIELD_FUNCTION T cos_pi(T x)
{
    const T turn = std::fabs(x - T(2.0) * std::rint(T(0.5) * x));
    const T quarters = std::rint(T(2.0) * turn);
    const T angle = T(3.141592653589793) * (turn - T(0.5) * quarters);
    if (quarters > T(1.5)) {
        return -std::cos(angle);
    }
    return quarters > T(0.5) ? -std::sin(angle) : std::cos(angle);
}

/// x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s; beyond s = 1/5 the difference itself.
template <class T> FIELD_FUNCTION T ln_1p_rest(T x)
{
    if (x < T(-1.0) / T(3.0) || x > T(0.5)) {
        return x - std::log1p(x);
    }
    const T s = x / (T(2.0) + x), q = s * s;
    T sum = T(1.0) / T(25.0);
    for (int n = 23; n > 1; n -= 2) {
        sum = sum * q + T(1.0) / T(n);
    }
    return s * (x - T(2.0) * q * sum);
}
