% Numbers of twice the digits of a double: rows of two, the unevaluated sum of which they are.

function r = wide_of(value)
  % A double as a number of twice the digits.
  r = [value, 0];
end

function r = two_sum(a, b)
  % The rounded sum and its error (Knuth, 1969).
  total = a + b;
  second = total - a;
  r = [total, (a - (total - second)) + (b - second)];
end

function r = settled(total, rest)
  % A sum and its smaller correction as a number. A correction that is not finite is dropped.
  high = total + rest;
  if isfinite(rest) && isfinite(high)
    r = [high, rest - (high - total)];
  else
    r = [total, 0];
  end
end

function r = two_product(a, b)
  % The rounded product and its error, from the upper halves of the digits (Dekker, 1971).
  product = a * b;
  scaled = 134217729 * a;
  a_upper = scaled - (scaled - a);
  scaled = 134217729 * b;
  b_upper = scaled - (scaled - b);
  a_lower = a - a_upper;
  b_lower = b - b_upper;
  crossed = (a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper;
  r = [product, crossed + a_lower * b_lower];
end

function r = wide_add(a, b)
  % Joldes, Muller and Popescu (2017), algorithm 6.
  high = two_sum(a(1), b(1));
  low = two_sum(a(2), b(2));
  first = settled(high(1), high(2) + low(1));
  r = settled(first(1), first(2) + low(2));
end

function r = wide_sub(a, b)
  r = wide_add(a, -b);
end

function r = wide_mul(a, b)
  product = two_product(a(1), b(1));
  r = settled(product(1), product(2) + (a(1) * b(2) + a(2) * b(1)));
end

function r = wide_div(a, b)
  % Three quotients of high parts; the second and third divide the remainder of the one before.
  first = a(1) / b(1);
  rest = wide_sub(a, wide_mul(b, [first, 0]));
  second = rest(1) / b(1);
  rest = wide_sub(rest, wide_mul(b, [second, 0]));
  quotient = settled(first, second);
  r = settled(quotient(1), quotient(2) + rest(1) / b(1));
end

function r = wide_pow2(a, shift)
  % 2^shift times the number.
  r = settled(pow2(a(1), shift), pow2(a(2), shift));
end

function r = wide_sqrt(a)
  % One step of Newton's method from a double.
  root = sqrt(a(1));
  rest = wide_sub(a, two_product(root, root));
  r = settled(root, rest(1) / (2 * root));
end

function r = wide_cbrt(a)
  root = sign(a(1)) * abs(a(1))^(1 / 3);
  rest = wide_sub(a, wide_mul(two_product(root, root), [root, 0]));
  r = settled(root, rest(1) / (3 * root * root));
end

function r = exp_m1_series(a)
  % exp(a) - 1 for |a| <= 0.4, by its series.
  r = [0, 0];
  for n = 26:-1:1
    r = wide_div(wide_mul(a, wide_add([1, 0], r)), [n, 0]);
  end
end

function r = wide_exp(a)
  % ln 2 in three parts; the first two have 42 bits, so that their products with exponents are exact.
  parts = [0.6931471805598903, 5.49792301870721e-14, 1.1612227229362532e-26];
  if ~(abs(a(1)) < 708)
    r = [exp(a(1)), 0];
    return
  end
  count = round(a(1) / parts(1));
  for part = parts
    a = wide_sub(a, [count * part, 0]);
  end
  r = wide_pow2(wide_add([1, 0], exp_m1_series(a)), count);
end

function r = wide_exp_m1(a)
  if abs(a(1)) < 0.4
    r = exp_m1_series(a);
  else
    r = wide_sub(wide_exp(a), [1, 0]);
  end
end

function r = artanh_excess(a)
  % artanh(a)/a - 1 for |a| <= 0.2, by its series.
  square = wide_mul(a, a);
  r = [0, 0];
  for n = 51:-2:3
    r = wide_mul(square, wide_add(r, wide_div([1, 0], [n, 0])));
  end
end

function r = ln_1p_series(a)
  % ln(1 + a) = 2 artanh(a/(2 + a)), for -1/3 <= a <= 1/2.
  ratio = wide_div(a, wide_add(a, [2, 0]));
  r = wide_pow2(wide_add(ratio, wide_mul(ratio, artanh_excess(ratio))), 1);
end

function r = wide_ln(a)
  if ~(a(1) > 0 && isfinite(a(1)))
    r = [log(a(1)), 0];
    return
  end
  [fraction, count] = log2(a(1));
  if fraction < 0.7071067811865476
    count = count - 1;
  end
  ln_2 = [0.6931471805599453, 2.3190468138462996e-17];
  rest = wide_sub(wide_pow2(a, -count), [1, 0]);
  r = wide_add(wide_mul(ln_2, [count, 0]), ln_1p_series(rest));
end

function r = wide_ln_1p(a)
  if a(1) > -0.25 && a(1) < 0.4
    r = ln_1p_series(a);
  else
    r = wide_ln(wide_add([1, 0], a));
  end
end

function r = wide_ln_1p_rest(a)
  % a - ln(1 + a): with s = a/(2 + a), a - 2 s = a s.
  if a(1) < -1 / 3 || a(1) > 0.5
    r = wide_sub(a, wide_ln_1p(a));
    return
  end
  ratio = wide_div(a, wide_add(a, [2, 0]));
  r = wide_mul(ratio, wide_sub(a, wide_pow2(artanh_excess(ratio), 1)));
end

function r = wide_pi()
  r = [3.141592653589793, 1.2246467991473532e-16];
end

function r = circular_series(a, n)
  % -a^2/(m (m - 1)) (1 - a^2/((m - 2)(m - 3)) (1 - ...)), from the term m = n down.
  square = -wide_mul(a, a);
  r = [0, 0];
  for m = n:-2:2
    r = wide_div(wide_mul(square, wide_add([1, 0], r)), [m * (m - 1), 0]);
  end
end

function r = sine_of_turn(quarters, rest)
  % sin(quarters pi/2 + rest), for |rest| <= 0.8.
  turn = mod(quarters, 4);
  if mod(turn, 2) == 0
    r = wide_add(rest, wide_mul(rest, circular_series(rest, 31)));
  else
    r = wide_add([1, 0], circular_series(rest, 32));
  end
  if turn >= 2
    r = -r;
  end
end

function angle = less_quarters(angle, count)
  % angle - count pi/2, for angles up to 2^50.
  parts = [1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33, 5.562271104316826e-50];
  for part = parts
    angle = wide_sub(angle, two_product(count, part));
  end
end

function r = sine_of_angle(angle, quarters)
  % sin(angle + quarters pi/2); NaN for angles beyond 2^50.
  if ~(abs(angle(1)) < 1125899906842624)
    r = [NaN, 0];
    return
  end
  count = round(angle(1) / 1.5707963267948966);
  r = sine_of_turn(count + quarters, less_quarters(angle, count));
end

function r = wide_sin(a)
  r = sine_of_angle(a, 0);
end

function r = wide_cos(a)
  r = sine_of_angle(a, 1);
end

function r = wide_tan(a)
  r = wide_div(wide_sin(a), wide_cos(a));
end

function r = sine_of_half_turns(half_turns, quarters)
  % sin(pi half_turns + quarters pi/2); whole turns are subtracted without error.
  if ~isfinite(half_turns(1))
    r = [NaN, 0];
    return
  end
  turn = two_sum(rem(half_turns(1), 2), rem(half_turns(2), 2));
  count = round(2 * turn(1));
  rest = wide_sub(turn, [0.5 * count, 0]);
  r = sine_of_turn(count + quarters, wide_mul(rest, wide_pi()));
end

function r = wide_sin_pi(a)
  r = sine_of_half_turns(a, 0);
end

function r = wide_cos_pi(a)
  r = sine_of_half_turns(a, 1);
end

function r = wide_within_turns(a)
  % An angle without its whole turns; angles up to 25 and beyond 2^50 are returned as they are.
  r = a;
  if abs(a(1)) > 25 && abs(a(1)) < 1125899906842624
    r = less_quarters(a, 4 * round(a(1) / 6.283185307179586));
  end
end

function r = wide_within_turns_pi(a)
  % An angle in half turns without its whole turns, of any size; angles up to 8 are returned as they are.
  r = a;
  if abs(a(1)) > 8 && isfinite(a(1))
    turn = two_sum(rem(a(1), 2), rem(a(2), 2));
    r = wide_sub(turn, [2 * round(0.5 * turn(1)), 0]);
  end
end

function r = wide_sinh(a)
  % (e^a - e^-a)/2: from e = exp_m1(a) as (e + e/(1 + e))/2 where the difference would cancel.
  if abs(a(1)) < 1
    e = wide_exp_m1(a);
    r = wide_pow2(wide_add(e, wide_div(e, wide_add([1, 0], e))), -1);
  else
    half = wide_pow2(wide_exp(a), -1);
    r = wide_sub(half, wide_div([0.25, 0], half));
  end
end

function r = wide_cosh(a)
  half = wide_pow2(wide_exp(a), -1);
  r = wide_add(half, wide_div([0.25, 0], half));
end

function r = wide_tanh(a)
  % e/(e + 2) with e = exp_m1(2 a).
  if ~(abs(a(1)) < 40)
    r = [tanh(a(1)), 0];
    return
  end
  e = wide_exp_m1(wide_pow2(a, 1));
  r = wide_div(e, wide_add(e, [2, 0]));
end

function r = wide_atan2(y, x)
  % The angle of a double, and by how far the point lies off it.
  angle = atan2(y(1), x(1));
  sine = wide_sin([angle, 0]);
  cosine = wide_cos([angle, 0]);
  across = wide_sub(wide_mul(y, cosine), wide_mul(x, sine));
  along = wide_add(wide_mul(x, cosine), wide_mul(y, sine));
  r = settled(angle, across(1) / along(1));
end

function r = wide_atan(a)
  r = wide_atan2(a, [1, 0]);
end

function r = complement(a)
  % The cosine of asin(a): next to 1 only this product keeps all digits.
  r = wide_sqrt(wide_mul(wide_sub([1, 0], a), wide_add([1, 0], a)));
end

function r = wide_asin(a)
  r = wide_atan2(a, complement(a));
end

function r = wide_acos(a)
  r = wide_atan2(complement(a), a);
end

function r = wide_powf(base, exponent)
  % base^exponent, for a base that is not negative.
  if ~(base(1) > 0 && isfinite(base(1)))
    r = [base(1)^exponent(1), 0];
    return
  end
  r = wide_exp(wide_mul(exponent, wide_ln(base)));
end
