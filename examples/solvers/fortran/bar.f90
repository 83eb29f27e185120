! A total-Lagrangian bar of neo-Hookean material in finite volumes: displacements at the nodes, stress
! between them, central differences in time. Stiffness and density vary along it. It runs graded_bar of
! the gallery from the start of its window, and writes X and u of the nodes as a table.
!
! mms emit graded_bar --target fortran -o FOLDER
! gfortran -O2 -ffp-contract=off FOLDER/graded_bar.f90 bar.f90 && ./a.out CELLS STEPS END FILE
program bar
    use graded_bar, only: acceleration, at_time, body_force, default_parameters, density, &
        displacement, field_type, instant_type, parameters_type, prepare, time_window, velocity, wp
    implicit none
    character(4096) :: word
    integer :: n, steps
    real(wp) :: end

    call get_command_argument(1, word)
    read (word, *) n
    call get_command_argument(2, word)
    read (word, *) steps
    call get_command_argument(3, word)
    read (word, *) end
    call get_command_argument(4, word)
    call run(n, steps, end, trim(word))

contains

    ! Runs with n volumes from the start to an end time, and writes the result to a file.
    subroutine run(n, steps, end, path)
        integer, intent(in) :: n, steps
        real(wp), intent(in) :: end
        character(*), intent(in) :: path
        type(parameters_type) :: parameters
        type(field_type) :: field
        type(instant_type) :: now
        real(wp), dimension(0:n) :: X, u, v, a, mass
        real(wp) :: h, dt, window(2), lambda(n), mu(n)
        integer :: i, step, file

        parameters = default_parameters()
        field = prepare(parameters)
        window = time_window(field)
        h = parameters%length/n
        X = [(i*h, i = 0, n)]
        call moduli(parameters, X(1:n) - h/2, lambda, mu)
        ! A volume ends in the middle between two nodes, or at the end of the bar.
        mass = [density(field, X(0:n - 1))*h, density(field, X(n))*h/2]

        dt = (end - window(1))/steps
        now = at_time(field, window(1))
        call displacement(now, X, u)
        call velocity(now, X, v)
        a = accelerations(now, X, u, mass, lambda, mu)
        do step = 1, steps
            v = v + dt/2*a
            u = u + dt*v
            now = at_time(field, window(1) + step*dt)
            a = accelerations(now, X, u, mass, lambda, mu)
            v = v + dt/2*a
        end do
        open (newunit=file, file=path, status='replace', action='write')
        write (file, '(a)') 'X,u'
        write (file, '(es24.16e3, a, es24.16e3)') (X(i), ',', u(i), i = 0, n)
        close (file)
    end subroutine

    ! Accelerations: of node 0, which is held, from the field; of the last node, with a free end, from one side.
    function accelerations(now, X, u, mass, lambda, mu) result(a)
        type(instant_type), intent(in) :: now
        real(wp), intent(in) :: X(0:), u(0:), mass(0:), lambda(:), mu(:)
        real(wp) :: a(0:ubound(u, 1)), b(0:ubound(u, 1)), h
        real(wp), dimension(size(mu)) :: F, P
        integer :: n
        n = size(mu)
        h = X(1) - X(0)
        F = 1 + (u(1:n) - u(0:n - 1))/h
        P = mu*(F - 1/F) + lambda*log(F)/F
        call body_force(now, X, b)
        call acceleration(now, X(0), a(0))
        a(1:n - 1) = b(1:n - 1) + (P(2:n) - P(1:n - 1))/mass(1:n - 1)
        a(n) = b(n) - P(n)/mass(n)
    end function

    ! Lame's moduli at X, from a Young's modulus that grows along the bar.
    elemental subroutine moduli(parameters, X, lambda, mu)
        type(parameters_type), intent(in) :: parameters
        real(wp), intent(in) :: X
        real(wp), intent(out) :: lambda, mu
        real(wp) :: young, nu
        young = parameters%young*(1 + parameters%stiffer*X/parameters%length)
        nu = parameters%nu
        lambda = young*nu/((1 + nu)*(1 - 2*nu))
        mu = young/(2*(1 + nu))
    end subroutine
end program
