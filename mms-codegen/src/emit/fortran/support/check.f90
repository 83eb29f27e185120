contains

  subroutine compare(set, expected, found)
    integer, intent(in) :: set
    real(real64), intent(in) :: expected(:)
    real(wp), intent(in) :: found(:)
    integer :: k
    do k = 1, size(expected)
      if (abs(found(k)) <= huge(found)) then
        errors(set) = max(errors(set), abs(real(found(k), real64) - expected(k)))
      else
        errors(set) = huge(errors)
      end if
      magnitudes(set) = max(magnitudes(set), abs(expected(k)))
    end do
  end subroutine compare

  ! Ends the comparison of a function.
  subroutine settle(name, accepted)
    character(*), intent(in) :: name
    integer, intent(in) :: accepted
    real(real64) :: error
    integer :: set
    do set = 1, sets_count
      error = errors(set) / max(magnitudes(set), real(tiny(1.0_wp), real64))
      error = error / real(epsilon(1.0_wp), real64)
      if (error > accepted) then
        print '(a, a, es9.3, a, i0)', name, ': ', error, ' eps, accepted ', accepted
        failures = failures + 1
      end if
      if (error > worst) then
        worst = error
        worst_name = name
      end if
    end do
    errors = 0.0_real64
    magnitudes = 0.0_real64
  end subroutine settle

