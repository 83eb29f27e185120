  implicit none

  integer, parameter :: sets_count = SETS, points_count = POINTS
  real(real64) :: worst = 0.0_real64
  integer :: failures = 0, set
  ! The file of test vectors, and the error that it accepts in the precision of the module.
  integer :: check_unit, check_accepted
  type(field_type) :: field
  type(instant_type), allocatable :: now(:)
  ! Parameters; t, X, N and H of each point.
  real(real64) :: given(PARAMETERS)
  real(real64), allocatable :: at(:, :)

  allocate (now(points_count), at(WIDTH, points_count))
  call check_open()
  call check_defaults()
  do set = 1, sets_count
    call prepare_all()
    FUNCTIONS
  end do
  print '(a, es9.3, a)', 'NAME: worst error ', worst, ' eps'
  if (failures > 0) error stop 1

contains

  ! Opens the test vectors: in this folder, or at the path in the first argument.
  subroutine check_open()
    character(1024) :: path
    integer :: status
    path = 'VECTORS'
    if (command_argument_count() > 0) call get_command_argument(1, path)
    open (newunit=check_unit, file=path, status='old', action='read', iostat=status)
    if (status == 0) return
    print '(3a)', 'cannot open ', trim(path), ': run this in its folder, or give its path'
    error stop 2
  end subroutine check_open

  ! Reads the next table with a name.
  subroutine check_table(name, numbers)
    character(*), intent(in) :: name
    real(real64), intent(out) :: numbers(:, :)
    character(256) :: line
    integer :: rows, columns, row, accepted(2), status
    do
      read (check_unit, '(a)', iostat=status) line
      if (status /= 0) exit
      if (index(line, name // ' ') /= 1) cycle
      read (line(len(name) + 1:), *, iostat=status) rows, columns, accepted
      if (status /= 0 .or. any([columns, rows] /= shape(numbers))) exit
      check_accepted = accepted(merge(1, 2, wp == real64))
      do row = 1, rows
        if (status == 0) read (check_unit, *, iostat=status) numbers(:, row)
      end do
      if (status == 0) return
    end do
    print '(3a)', 'the test vectors have no table ', name, ' of that size: emit them anew'
    error stop 2
  end subroutine check_table

  ! Compares the results of a function with a set of parameters.
  subroutine compare(name, expected, found)
    character(*), intent(in) :: name
    real(real64), intent(in) :: expected(:, :)
    real(wp), intent(in) :: found(:, :)
    real(real64) :: error
    error = maxval(abs(real(found, real64) - expected))
    if (.not. all(abs(found) <= huge(found))) error = huge(error)
    error = error / max(maxval(abs(expected)), real(tiny(1.0_wp), real64))
    error = error / real(epsilon(1.0_wp), real64)
    worst = max(worst, error)
    if (error > check_accepted) then
      print '(a, a, es9.3, a, i0)', name, ': ', error, ' eps, accepted ', check_accepted
      failures = failures + 1
    end if
  end subroutine compare

  subroutine check_defaults()
    type(parameters_type) :: defaults
    real(real64) :: expected(PARAMETERS, 1)
    defaults = default_parameters()
    call check_table('defaults', expected)
    DEFAULTS
  end subroutine check_defaults

  ! Prepares a set of parameters and its points.
  subroutine prepare_all()
    type(parameters_type) :: parameters
    real(real64) :: values(PARAMETERS, 1)
    integer :: point
    parameters = default_parameters()
    call check_table('set', values)
    given = values(:, 1)
    GIVEN
    field = prepare(parameters)
    call check_table('at', at)
    do point = 1, size(now)
      now(point) = at_time(field, real(at(1, point), wp))
    end do
  end subroutine prepare_all

