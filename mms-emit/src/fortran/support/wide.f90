module wide_arithmetic
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none

  type :: wide
    real(dp) :: high = 0.0_dp, low = 0.0_dp
  end type wide

  interface operator(+)
    procedure wide_add
  end interface
  interface operator(-)
    procedure wide_sub, wide_neg
  end interface
  interface operator(*)
    procedure wide_mul
  end interface
  interface operator(/)
    procedure wide_div
  end interface

contains

  ! A double as a number of twice the digits.
  pure function wide_of(value) result(y)
    real(dp), intent(in) :: value
    type(wide) :: y
    y = wide(value, 0.0_dp)
  end function wide_of

  ! The rounded sum and its error (Knuth, 1969).
  pure function two_sum(a, b) result(y)
    real(dp), intent(in) :: a, b
    type(wide) :: y
    real(dp) :: total, second
    total = a + b
    second = total - a
    y = wide(total, (a - (total - second)) + (b - second))
  end function two_sum

  ! A sum and its smaller correction as a number. A correction that is not finite is dropped.
  pure function settled(total, rest) result(y)
    real(dp), intent(in) :: total, rest
    type(wide) :: y
    real(dp) :: high
    high = total + rest
    if (abs(rest) <= huge(rest) .and. abs(high) <= huge(high)) then
      y = wide(high, rest - (high - total))
    else
      y = wide(total, 0.0_dp)
    end if
  end function settled

  ! The upper half of the digits (Dekker, 1971). In brackets, so that nothing is fused.
  pure function upper_half(value) result(upper)
    real(dp), intent(in) :: value
    real(dp) :: upper, scaled
    scaled = (134217729.0_dp * value)
    upper = scaled - (scaled - value)
  end function upper_half

  ! The rounded product and its error (Dekker, 1971).
  pure function two_product(a, b) result(y)
    real(dp), intent(in) :: a, b
    type(wide) :: y
    real(dp) :: product_, a_upper, a_lower, b_upper, b_lower, crossed
    product_ = (a * b)
    a_upper = upper_half(a)
    b_upper = upper_half(b)
    a_lower = a - a_upper
    b_lower = b - b_upper
    crossed = (((a_upper * b_upper) - product_) + (a_upper * b_lower)) + (a_lower * b_upper)
    y = wide(product_, crossed + (a_lower * b_lower))
  end function two_product

  pure function wide_neg(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = wide(-a%high, -a%low)
  end function wide_neg

  ! Joldes, Muller and Popescu (2017), algorithm 6.
  pure function wide_add(a, b) result(y)
    type(wide), intent(in) :: a, b
    type(wide) :: y, high, low
    high = two_sum(a%high, b%high)
    low = two_sum(a%low, b%low)
    y = settled(high%high, high%low + low%high)
    y = settled(y%high, y%low + low%low)
  end function wide_add

  pure function wide_sub(a, b) result(y)
    type(wide), intent(in) :: a, b
    type(wide) :: y
    y = wide_add(a, wide_neg(b))
  end function wide_sub

  pure function wide_mul(a, b) result(y)
    type(wide), intent(in) :: a, b
    type(wide) :: y
    y = two_product(a%high, b%high)
    y = settled(y%high, y%low + (a%high * b%low + a%low * b%high))
  end function wide_mul

  ! Three quotients of high parts; the second and third divide the remainder of the one before.
  pure function wide_div(a, b) result(y)
    type(wide), intent(in) :: a, b
    type(wide) :: y, rest
    real(dp) :: first, second
    first = a%high / b%high
    rest = wide_sub(a, wide_mul(b, wide_of(first)))
    second = rest%high / b%high
    rest = wide_sub(rest, wide_mul(b, wide_of(second)))
    y = settled(first, second)
    y = settled(y%high, y%low + rest%high / b%high)
  end function wide_div

  pure function wide_scale(a, shift) result(y)
    type(wide), intent(in) :: a
    integer, intent(in) :: shift
    type(wide) :: y
    y = settled(scale(a%high, shift), scale(a%low, shift))
  end function wide_scale

  pure function nearest_integer(value) result(nearest_)
    real(dp), intent(in) :: value
    real(dp) :: nearest_
    nearest_ = anint(value)
  end function nearest_integer

  ! One step of Newton's method from a double.
  pure function wide_sqrt(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y, rest
    real(dp) :: root
    root = sqrt(a%high)
    rest = a - two_product(root, root)
    y = settled(root, rest%high / (2.0_dp * root))
  end function wide_sqrt

  pure function wide_cbrt(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y, rest
    real(dp) :: root
    root = sign(abs(a%high)**(1.0_dp / 3.0_dp), a%high)
    rest = a - two_product(root, root) * wide_of(root)
    y = settled(root, rest%high / (3.0_dp * root * root))
  end function wide_cbrt

  ! exp(a) - 1 for |a| <= 0.4, by its series.
  pure function exp_m1_series(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    integer :: n
    y = wide_of(0.0_dp)
    do n = 26, 1, -1
      y = a * (wide_of(1.0_dp) + y) / wide_of(real(n, dp))
    end do
  end function exp_m1_series

  pure function wide_exp(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    ! ln 2; the first two parts have 42 bits, so that their products with exponents are exact.
    real(dp), parameter :: ln_2_parts(3) = &
      [0.6931471805598903_dp, 5.49792301870721e-14_dp, 1.1612227229362532e-26_dp]
    real(dp) :: count_
    integer :: part
    if (.not. abs(a%high) < 708.0_dp) then
      y = wide_of(exp(a%high))
      return
    end if
    count_ = nearest_integer(a%high / ln_2_parts(1))
    y = a
    do part = 1, 3
      y = y - wide_of(count_ * ln_2_parts(part))
    end do
    y = wide_scale(wide_of(1.0_dp) + exp_m1_series(y), int(count_))
  end function wide_exp

  pure function wide_exp_m1(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    if (abs(a%high) < 0.4_dp) then
      y = exp_m1_series(a)
    else
      y = wide_exp(a) - wide_of(1.0_dp)
    end if
  end function wide_exp_m1

  ! artanh(a)/a - 1 for |a| <= 0.2, by its series.
  pure function artanh_excess(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y, square
    integer :: n
    square = a * a
    y = wide_of(0.0_dp)
    do n = 51, 3, -2
      y = square * (y + wide_of(1.0_dp) / wide_of(real(n, dp)))
    end do
  end function artanh_excess

  ! ln(1 + a) = 2 artanh(a/(2 + a)), for -1/3 <= a <= 1/2.
  pure function ln_1p_series(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = a / (a + wide_of(2.0_dp))
    y = wide_scale(y + y * artanh_excess(y), 1)
  end function ln_1p_series

  pure function wide_ln(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    integer :: count_
    if (.not. (a%high > 0.0_dp .and. a%high <= huge(a%high))) then
      y = wide_of(log(a%high))
      return
    end if
    count_ = exponent(a%high)
    if (fraction(a%high) < 0.7071067811865476_dp) count_ = count_ - 1
    y = ln_1p_series(wide_scale(a, -count_) - wide_of(1.0_dp))
    y = wide(0.6931471805599453_dp, 2.3190468138462996e-17_dp) * wide_of(real(count_, dp)) + y
  end function wide_ln

  pure function wide_ln_1p(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    if (a%high > -0.25_dp .and. a%high < 0.4_dp) then
      y = ln_1p_series(a)
    else
      y = wide_ln(wide_of(1.0_dp) + a)
    end if
  end function wide_ln_1p

  ! a - ln(1 + a): with s = a/(2 + a), a - 2 s = a s.
  pure function wide_ln_1p_rest(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    if (a%high < -1.0_dp / 3.0_dp .or. a%high > 0.5_dp) then
      y = a - wide_ln_1p(a)
    else
      y = a / (a + wide_of(2.0_dp))
      y = y * (a - wide_scale(artanh_excess(y), 1))
    end if
  end function wide_ln_1p_rest

  pure function wide_pi() result(y)
    type(wide) :: y
    y = wide(3.141592653589793_dp, 1.2246467991473532e-16_dp)
  end function wide_pi

  ! -a^2/(m (m - 1)) (1 - a^2/((m - 2)(m - 3)) (1 - ...)), from the term m = last down.
  pure function circular_series(a, last) result(y)
    type(wide), intent(in) :: a
    integer, intent(in) :: last
    type(wide) :: y, square
    integer :: m
    square = -(a * a)
    y = wide_of(0.0_dp)
    do m = last, 2, -2
      y = square * (wide_of(1.0_dp) + y) / wide_of(real(m * (m - 1), dp))
    end do
  end function circular_series

  ! sin(quarters pi/2 + rest), for |rest| <= 0.8.
  pure function sine_of_turn(quarters, rest) result(y)
    real(dp), intent(in) :: quarters
    type(wide), intent(in) :: rest
    type(wide) :: y
    integer :: turn
    turn = modulo(int(mod(quarters, 4.0_dp)), 4)
    if (modulo(turn, 2) == 0) then
      y = rest + rest * circular_series(rest, 31)
    else
      y = wide_of(1.0_dp) + circular_series(rest, 32)
    end if
    if (turn > 1) y = -y
  end function sine_of_turn

  ! angle - count pi/2, for angles up to 2^50.
  pure function less_quarters(angle, count_) result(y)
    type(wide), intent(in) :: angle
    real(dp), intent(in) :: count_
    type(wide) :: y
    real(dp), parameter :: half_pi_parts(4) = [1.5707963267948966_dp, 6.123233995736766e-17_dp, &
                                               -1.4973849048591698e-33_dp, 5.562271104316826e-50_dp]
    integer :: part
    y = angle
    do part = 1, 4
      y = y - two_product(count_, half_pi_parts(part))
    end do
  end function less_quarters

  ! sin(angle + quarters pi/2); NaN for angles beyond 2^50.
  pure function sine_of_angle(angle, quarters) result(y)
    type(wide), intent(in) :: angle
    real(dp), intent(in) :: quarters
    type(wide) :: y
    real(dp) :: count_
    if (.not. abs(angle%high) < 1125899906842624.0_dp) then
      y = wide_of(sqrt(-abs(angle%high)))
      return
    end if
    count_ = nearest_integer(angle%high / 1.5707963267948966_dp)
    y = sine_of_turn(count_ + quarters, less_quarters(angle, count_))
  end function sine_of_angle

  pure function wide_sin(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = sine_of_angle(a, 0.0_dp)
  end function wide_sin

  pure function wide_cos(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = sine_of_angle(a, 1.0_dp)
  end function wide_cos

  pure function wide_tan(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = wide_sin(a) / wide_cos(a)
  end function wide_tan

  ! sin(pi half_turns + quarters pi/2); whole turns are subtracted without error.
  pure function sine_of_half_turns(half_turns, quarters) result(y)
    type(wide), intent(in) :: half_turns
    real(dp), intent(in) :: quarters
    type(wide) :: y
    real(dp) :: count_
    if (.not. abs(half_turns%high) <= huge(half_turns%high)) then
      y = wide_of(sqrt(-abs(half_turns%high)))
      return
    end if
    y = two_sum(mod(half_turns%high, 2.0_dp), mod(half_turns%low, 2.0_dp))
    count_ = nearest_integer(2.0_dp * y%high)
    y = (y - wide_of(0.5_dp * count_)) * wide_pi()
    y = sine_of_turn(count_ + quarters, y)
  end function sine_of_half_turns

  pure function wide_sin_pi(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = sine_of_half_turns(a, 0.0_dp)
  end function wide_sin_pi

  pure function wide_cos_pi(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = sine_of_half_turns(a, 1.0_dp)
  end function wide_cos_pi

  ! An angle without its whole turns; angles up to 25 and beyond 2^50 are returned as they are.
  pure function wide_within_turns(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = a
    if (abs(a%high) > 25.0_dp .and. abs(a%high) < 1125899906842624.0_dp) then
      y = less_quarters(a, 4.0_dp * nearest_integer(a%high / 6.283185307179586_dp))
    end if
  end function wide_within_turns

  ! An angle in half turns without its whole turns, of any size; angles up to 8 are returned as they are.
  pure function wide_within_turns_pi(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = a
    if (abs(a%high) > 8.0_dp .and. abs(a%high) <= huge(a%high)) then
      y = two_sum(mod(a%high, 2.0_dp), mod(a%low, 2.0_dp))
      y = y - wide_of(2.0_dp * nearest_integer(0.5_dp * y%high))
    end if
  end function wide_within_turns_pi

  ! (e^a - e^-a)/2: from e = exp_m1(a) as (e + e/(1 + e))/2 where the difference would cancel.
  pure function wide_sinh(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    if (abs(a%high) < 1.0_dp) then
      y = wide_exp_m1(a)
      y = wide_scale(y + y / (wide_of(1.0_dp) + y), -1)
    else
      y = wide_scale(wide_exp(a), -1)
      y = y - wide_of(0.25_dp) / y
    end if
  end function wide_sinh

  pure function wide_cosh(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = wide_scale(wide_exp(a), -1)
    y = y + wide_of(0.25_dp) / y
  end function wide_cosh

  ! e/(e + 2) with e = exp_m1(2 a).
  pure function wide_tanh(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    if (.not. abs(a%high) < 40.0_dp) then
      y = wide_of(tanh(a%high))
    else
      y = wide_exp_m1(wide_scale(a, 1))
      y = y / (y + wide_of(2.0_dp))
    end if
  end function wide_tanh

  ! The angle of a double, and by how far the point lies off it.
  pure function wide_atan2(y, x) result(angle)
    type(wide), intent(in) :: y, x
    type(wide) :: angle, sine, cosine, across, along
    angle = wide_of(atan2(y%high, x%high))
    sine = wide_sin(angle)
    cosine = wide_cos(angle)
    across = y * cosine - x * sine
    along = x * cosine + y * sine
    angle = settled(angle%high, across%high / along%high)
  end function wide_atan2

  pure function wide_atan(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = wide_atan2(a, wide_of(1.0_dp))
  end function wide_atan

  ! The cosine of asin(a): next to 1 only this product keeps all digits.
  pure function complement(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = wide_sqrt((wide_of(1.0_dp) - a) * (wide_of(1.0_dp) + a))
  end function complement

  pure function wide_asin(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = wide_atan2(a, complement(a))
  end function wide_asin

  pure function wide_acos(a) result(y)
    type(wide), intent(in) :: a
    type(wide) :: y
    y = wide_atan2(complement(a), a)
  end function wide_acos

  ! base^power, for a base that is not negative.
  pure function wide_powf(base, power) result(y)
    type(wide), intent(in) :: base, power
    type(wide) :: y
    if (.not. (base%high > 0.0_dp .and. base%high <= huge(base%high))) then
      y = wide_of(base%high**power%high)
    else
      y = wide_exp(power * wide_ln(base))
    end if
  end function wide_powf

end module wide_arithmetic
