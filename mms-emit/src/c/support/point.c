#include <math.h>

typedef double real;
#define MATH(function) function
#define REAL(number) number

/* sin(pi x): whole turns, and then quarter turns, are subtracted without error. */
static real sin_pi(real x)
{
    const real turn = x - REAL(2.0) * MATH(rint)(REAL(0.5) * x);
    const real quarters = MATH(rint)(REAL(2.0) * turn);
    const real angle = REAL(3.141592653589793) * (turn - REAL(0.5) * quarters);
    if (MATH(fabs)(quarters) > REAL(1.5)) {
        return -MATH(sin)(angle);
    }
    if (MATH(fabs)(quarters) > REAL(0.5)) {
        return MATH(copysign)(MATH(cos)(angle), quarters);
    }
    return MATH(sin)(angle);
}

/* cos(pi x): as sin(pi x). */
static real cos_pi(real x)
{
    const real turn = MATH(fabs)(x - REAL(2.0) * MATH(rint)(REAL(0.5) * x));
    const real quarters = MATH(rint)(REAL(2.0) * turn);
    const real angle = REAL(3.141592653589793) * (turn - REAL(0.5) * quarters);
    if (quarters > REAL(1.5)) {
        return -MATH(cos)(angle);
    }
    return quarters > REAL(0.5) ? -MATH(sin)(angle) : MATH(cos)(angle);
}

/* x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s; beyond s = 1/5 the difference itself. */
static real ln_1p_rest(real x)
{
    const real s = x / (REAL(2.0) + x), q = s * s;
    real sum = REAL(1.0) / REAL(25.0);
    sum = sum * q + REAL(1.0) / REAL(23.0);
    sum = sum * q + REAL(1.0) / REAL(21.0);
    sum = sum * q + REAL(1.0) / REAL(19.0);
    sum = sum * q + REAL(1.0) / REAL(17.0);
    sum = sum * q + REAL(1.0) / REAL(15.0);
    sum = sum * q + REAL(1.0) / REAL(13.0);
    sum = sum * q + REAL(1.0) / REAL(11.0);
    sum = sum * q + REAL(1.0) / REAL(9.0);
    sum = sum * q + REAL(1.0) / REAL(7.0);
    sum = sum * q + REAL(1.0) / REAL(5.0);
    sum = sum * q + REAL(1.0) / REAL(3.0);
    if (x < REAL(-1.0) / REAL(3.0) || x > REAL(0.5)) {
        return x - MATH(log1p)(x);
    }
    return s * (x - REAL(2.0) * q * sum);
}
