# Definitions of every module.

# Numbers of so many bits that cancellation loses no digit of a double.
wide(value) = BigFloat(value)

wide(high, low) = BigFloat(high) + BigFloat(low)

# x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s; beyond s = 1/5 the difference itself.
function ln_1p_rest(x)
    -1 / 3 <= x <= 1 / 2 || return x - log1p(x)
    s = x / (2 + x)
    total = one(s) / 25
    for n in 23:-2:3
        total = total * (s * s) + one(s) / n
    end
    return s * (x - 2 * (s * s) * total)
end

ln_1p_rest(x::BigFloat) = x - log1p(x)

# An angle of more than a few radians less whole turns, and one in half turns.
within_turns(x) = abs(x) <= 25 ? x : x - 2 * BigFloat(pi) * round(x / (2 * BigFloat(pi)))
within_turns_pi(x) = abs(x) <= 8 ? x : x - 2 * round(x / 2)

# Broadcasting treats a prepared field as a scalar.
Base.broadcastable(field::Field) = Ref(field)
Base.broadcastable(now::Instant) = Ref(now)
