% What the language lacks, element by element.

function y = cubic_root(x)
  y = nthroot(x, 3);
end

function y = sign_after(half_turns)
  % -1 to the power of a whole number.
  y = 1 - 2 * (half_turns - 2 * floor(half_turns / 2));
end

function y = sin_pi(x)
  % sin(pi x): half turns are subtracted without error, each of which changes the sign.
  half_turns = floor(x + 0.5);
  y = sin(pi * (x - half_turns)) .* sign_after(half_turns);
end

function y = cos_pi(x)
  % cos(pi x): half turns are subtracted likewise; for the remainder r it is sin(pi (1/2 - |r|)).
  half_turns = floor(x + 0.5);
  y = sin(pi * (0.5 - abs(x - half_turns))) .* sign_after(half_turns);
end

function y = ln_1p_rest(x)
  % x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s; beyond s = 1/5 the difference itself.
  s = x ./ (2 + x);
  total = 1 / 25;
  for n = 23:-2:3
    total = total .* (s .* s) + 1 / n;
  end
  y = x - log1p(x);
  near = x >= -1 / 3 & x <= 0.5;
  series = s .* (x - 2 * (s .* s) .* total);
  y(near) = series(near);
end

function y = shaped(value, like)
  % A value that may be constant, expanded to each of the points.
  y = value + zeros(size(like), class(like));
end
