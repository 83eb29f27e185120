! A total-Lagrangian bar of neo-Hookean material in finite volumes: displacements at the nodes, stress
! between them, central differences in time. Stiffness and density vary along it. It runs graded_bar of
! the gallery on finer and finer meshes, and stops with an error where the order in L2 is not 2.
!
! mms emit graded_bar --target fortran -o FOLDER
! gfortran -O2 -ffp-contract=off FOLDER/graded_bar.f90 bar.f90 && ./a.out
program bar
    use graded_bar, only: acceleration, at_time, body_force, default_parameters, density, &
        displacement, field_type, instant_type, parameters_type, prepare, time_window, velocity, wp
    implicit none
    real(wp), parameter :: expected = 2, tolerance = 0.15_wp
    real(wp) :: coarser, finer, order
    integer :: n

    print '(a)', 'central differences, finite volumes, order 2 expected'
    coarser = run(16)
    print '(i6, es11.3)', 16, coarser
    order = huge(order)
    n = 32
    do while (n <= 256)
        finer = run(n)
        order = log(coarser/finer)/log(2.0_wp)
        print '(i6, es11.3, f7.2)', n, finer, order
        coarser = finer
        n = 2*n
    end do
    if (.not. abs(order - expected) <= tolerance) error stop 'the order is not the expected one'

contains

    ! A run over the time window with n volumes; the error of u at its end, in L2.
    function run(n) result(error)
        integer, intent(in) :: n
        real(wp) :: error
        type(parameters_type) :: parameters
        type(field_type) :: field
        type(instant_type) :: now
        real(wp), dimension(0:n) :: X, u, v, a, mass, exact
        real(wp) :: h, dt, window(2), lambda(n), mu(n)
        integer :: i, step, steps

        parameters = default_parameters()
        field = prepare(parameters)
        window = time_window(field)
        h = parameters%length/n
        X = [(i*h, i = 0, n)]
        call moduli(parameters, X(1:n) - h/2, lambda, mu)
        ! A volume reaches to the middle between nodes, and ends with the bar.
        mass = [density(field, X(0:n - 1))*h, density(field, X(n))*h/2]

        steps = 4*n
        dt = (window(2) - window(1))/steps
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
        call displacement(now, X, exact)
        error = sqrt(h*sum((u - exact)**2))
    end function

    ! Of node 0, which is held, the field's; of the last, whose outer end is free, from one side.
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

    ! Lame's moduli at X, of a Young's modulus that grows along the bar.
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
