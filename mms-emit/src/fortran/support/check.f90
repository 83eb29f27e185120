contains

  ! Compares what a function gives with a set of parameters.
  subroutine compare(name, accepted, expected, found)
    character(*), intent(in) :: name
    integer, intent(in) :: accepted
    real(real64), intent(in) :: expected(:, :)
    real(wp), intent(in) :: found(:, :)
    real(real64) :: error
    error = maxval(abs(real(found, real64) - expected))
    if (.not. all(abs(found) <= huge(found))) error = huge(error)
    error = error / max(maxval(abs(expected)), real(tiny(1.0_wp), real64))
    error = error / real(epsilon(1.0_wp), real64)
    worst = max(worst, error)
    if (error > accepted) then
      print '(a, a, es9.3, a, i0)', name, ': ', error, ' eps, accepted ', accepted
      failures = failures + 1
    end if
  end subroutine compare

