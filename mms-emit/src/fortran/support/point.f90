module point_functions
  use, intrinsic :: iso_fortran_env, only: wp => real64
  implicit none

contains

  ! The real cube root, with a step of Newton's method.
  elemental function cubic_root(x) result(y)
    real(wp), intent(in) :: x
    real(wp) :: y
    y = 0.0_wp
    if (abs(x) > 0.0_wp) then
      y = sign(abs(x)**(1.0_wp / 3.0_wp), x)
      y = y - (y - x / (y * y)) / 3.0_wp
    end if
  end function cubic_root

  ! base^power, for a base that is not negative.
  elemental function power(base, exponent_) result(y)
    real(wp), intent(in) :: base, exponent_
    real(wp) :: y
    y = base**exponent_
  end function power

  ! exp(x) - 1 = 2 sinh(x/2) exp(x/2).
  elemental function exp_m1(x) result(y)
    real(wp), intent(in) :: x
    real(wp) :: y
    y = 2.0_wp * sinh(0.5_wp * x) * exp(0.5_wp * x)
  end function exp_m1

  ! ln(1 + x) = 2 artanh(x/(2 + x)), where x is small.
  elemental function ln_1p(x) result(y)
    real(wp), intent(in) :: x
    real(wp) :: y
    if (abs(x) < 0.5_wp) then
      y = 2.0_wp * atanh(x / (2.0_wp + x))
    else
      y = log(1.0_wp + x)
    end if
  end function ln_1p

  ! x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s; beyond s = 1/5 the difference itself.
  elemental function ln_1p_rest(x) result(y)
    real(wp), intent(in) :: x
    real(wp) :: y, s
    integer :: n
    if (x < -1.0_wp / 3.0_wp .or. x > 0.5_wp) then
      y = x - ln_1p(x)
      return
    end if
    s = x / (2.0_wp + x)
    y = 1.0_wp / 25.0_wp
    do n = 23, 3, -2
      y = y * (s * s) + 1.0_wp / real(n, wp)
    end do
    y = s * (x - 2.0_wp * (s * s) * y)
  end function ln_1p_rest

  ! sin(pi x): whole turns, and then quarter turns, are subtracted without error.
  elemental function sin_pi(x) result(y)
    real(wp), intent(in) :: x
    real(wp) :: y, turn, quarters, angle
    turn = x - 2.0_wp * anint(0.5_wp * x)
    quarters = anint(2.0_wp * turn)
    angle = 3.141592653589793_wp * (turn - 0.5_wp * quarters)
    if (abs(quarters) > 1.5_wp) then
      y = -sin(angle)
    else if (abs(quarters) > 0.5_wp) then
      y = sign(cos(angle), quarters)
    else
      y = sin(angle)
    end if
  end function sin_pi

  ! cos(pi x): as sin(pi x).
  elemental function cos_pi(x) result(y)
    real(wp), intent(in) :: x
    real(wp) :: y, turn, quarters, angle
    turn = abs(x - 2.0_wp * anint(0.5_wp * x))
    quarters = anint(2.0_wp * turn)
    angle = 3.141592653589793_wp * (turn - 0.5_wp * quarters)
    if (quarters > 1.5_wp) then
      y = -cos(angle)
    else if (quarters > 0.5_wp) then
      y = -sin(angle)
    else
      y = cos(angle)
    end if
  end function cos_pi

end module point_functions
