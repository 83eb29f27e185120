! b of the 1-D bar with half its amplitude, at five points and one time; and a mistake.
program forcing
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_loc, c_null_char, &
        c_null_ptr, c_ptr, c_size_t
    use mms_capi
    implicit none
    character(kind=c_char), target :: message(1024)
    integer(c_size_t), parameter :: capacity = size(message)
    character, parameter :: nul = c_null_char
    type(c_ptr) :: bar
    real(c_double) :: lower(1), upper(1), X(5), b(5)
    integer(c_int32_t) :: code
    integer :: i

    call must(mms_field_from_gallery('bar_1d' // nul, bar, message, capacity))
    call must(mms_field_set_parameter(bar, 'amplitude' // nul, 0.1_c_double, message, capacity))
    print '(3a)', c_text(mms_field_name(bar)), ': ', c_text(mms_field_title(bar))

    call must(mms_field_get_bound(bar, 'lower' // nul, 1_c_size_t, lower, message, capacity))
    call must(mms_field_get_bound(bar, 'upper' // nul, 1_c_size_t, upper, message, capacity))
    X = [(lower(1) + (upper(1) - lower(1))*i/4, i = 0, 4)]
    call must(mms_field_evaluate(bar, 'body_force' // nul, 0.013_c_double, 5_c_size_t, X, &
        c_null_ptr, b, message, capacity))
    do i = 1, 5
        print '(f8.4, 1x, f14.6)', X(i), b(i)
    end do

    code = mms_field_set_parameter(bar, 'amplitud' // nul, 0.1_c_double, message, capacity)
    print '(i0, 2a)', code, ': ', c_text(c_loc(message))
    call mms_field_free(bar)

contains

    ! Ends the program where a call fails.
    subroutine must(code)
        integer(c_int32_t), intent(in) :: code
        if (code == mms_code_ok) return
        print '(a)', c_text(c_loc(message))
        error stop
    end subroutine
end program
