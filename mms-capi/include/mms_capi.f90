! The interface of mms_capi.h for Fortran 2003 and later; the header documents the functions.
! Texts are passed as `'bar_1d' // c_null_char`; `c_text` converts a returned text.
module mms_capi
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_int32_t, c_null_char, c_ptr, &
        c_size_t, c_associated, c_f_pointer
    implicit none
    private

    integer(c_int32_t), parameter, public :: mms_code_ok = 0
    integer(c_int32_t), parameter, public :: mms_code_invalid_argument = 1
    integer(c_int32_t), parameter, public :: mms_code_unknown_name = 2
    integer(c_int32_t), parameter, public :: mms_code_invalid_field = 3
    integer(c_int32_t), parameter, public :: mms_code_invalid_parameter = 4
    integer(c_int32_t), parameter, public :: mms_code_not_finite = 5
    integer(c_int32_t), parameter, public :: mms_code_defect = 6
    integer(c_int32_t), parameter, public :: mms_code_no_thread = 7
    integer(c_int32_t), parameter, public :: mms_code_stopped = 8

    public :: c_text
    public :: mms_version, mms_gallery_size, mms_gallery_name, mms_quantity_count, mms_quantity_name
    public :: mms_field_from_gallery, mms_field_from_text, mms_field_free
    public :: mms_stop_new, mms_stop_request, mms_stop_is_requested, mms_stop_free
    public :: mms_field_from_text_stoppable, mms_field_evaluate_stoppable
    public :: mms_field_name, mms_field_title, mms_field_dimension
    public :: mms_field_parameter_count, mms_field_parameter_name
    public :: mms_field_face_count, mms_field_face_name
    public :: mms_field_own_quantity_count, mms_field_own_quantity_name
    public :: mms_field_get_parameter, mms_field_set_parameter, mms_field_set_parameters
    public :: mms_field_components, mms_field_evaluate, mms_field_normals
    public :: mms_field_bound_components, mms_field_get_bound, mms_field_bound

    interface
        function mms_version() result(text) bind(c)
            import :: c_ptr
            type(c_ptr) :: text
        end function

        function mms_gallery_size() result(count) bind(c)
            import :: c_size_t
            integer(c_size_t) :: count
        end function

        ! From 0, as in C.
        function mms_gallery_name(index) result(text) bind(c)
            import :: c_ptr, c_size_t
            integer(c_size_t), value :: index
            type(c_ptr) :: text
        end function

        function mms_quantity_count() result(count) bind(c)
            import :: c_size_t
            integer(c_size_t) :: count
        end function

        function mms_quantity_name(index) result(text) bind(c)
            import :: c_ptr, c_size_t
            integer(c_size_t), value :: index
            type(c_ptr) :: text
        end function

        function mms_field_from_gallery(name, field, message, capacity) result(code) bind(c)
            import :: c_char, c_int32_t, c_ptr, c_size_t
            character(kind=c_char), intent(in) :: name(*)
            type(c_ptr), intent(out) :: field
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        ! `material` is `c_null_ptr`, or `c_loc` of a text.
        function mms_field_from_text(name, toml, material, field, message, capacity) &
            result(code) bind(c)
            import :: c_char, c_int32_t, c_ptr, c_size_t
            character(kind=c_char), intent(in) :: name(*), toml(*)
            type(c_ptr), value :: material
            type(c_ptr), intent(out) :: field
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        ! `stop` is `c_null_ptr`, or a result of `mms_stop_new`.
        function mms_field_from_text_stoppable(name, toml, material, stop, field, message, &
            capacity) result(code) bind(c)
            import :: c_char, c_int32_t, c_ptr, c_size_t
            character(kind=c_char), intent(in) :: name(*), toml(*)
            type(c_ptr), value :: material, stop
            type(c_ptr), intent(out) :: field
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        function mms_stop_new() result(stop) bind(c)
            import :: c_ptr
            type(c_ptr) :: stop
        end function

        subroutine mms_stop_request(stop) bind(c)
            import :: c_ptr
            type(c_ptr), value :: stop
        end subroutine

        function mms_stop_is_requested(stop) result(requested) bind(c)
            import :: c_int, c_ptr
            type(c_ptr), value :: stop
            integer(c_int) :: requested
        end function

        subroutine mms_stop_free(stop) bind(c)
            import :: c_ptr
            type(c_ptr), value :: stop
        end subroutine

        subroutine mms_field_free(field) bind(c)
            import :: c_ptr
            type(c_ptr), value :: field
        end subroutine

        function mms_field_name(field) result(text) bind(c)
            import :: c_ptr
            type(c_ptr), value :: field
            type(c_ptr) :: text
        end function

        function mms_field_title(field) result(text) bind(c)
            import :: c_ptr
            type(c_ptr), value :: field
            type(c_ptr) :: text
        end function

        function mms_field_dimension(field) result(dimension) bind(c)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: field
            integer(c_size_t) :: dimension
        end function

        function mms_field_parameter_count(field) result(count) bind(c)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: field
            integer(c_size_t) :: count
        end function

        function mms_field_parameter_name(field, index) result(text) bind(c)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: field
            integer(c_size_t), value :: index
            type(c_ptr) :: text
        end function

        function mms_field_own_quantity_count(field) result(count) bind(c)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: field
            integer(c_size_t) :: count
        end function

        function mms_field_own_quantity_name(field, index) result(text) bind(c)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: field
            integer(c_size_t), value :: index
            type(c_ptr) :: text
        end function

        function mms_field_face_count(field) result(count) bind(c)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: field
            integer(c_size_t) :: count
        end function

        function mms_field_face_name(field, index) result(text) bind(c)
            import :: c_ptr, c_size_t
            type(c_ptr), value :: field
            integer(c_size_t), value :: index
            type(c_ptr) :: text
        end function

        function mms_field_get_parameter(field, name, value, message, capacity) result(code) bind(c)
            import :: c_char, c_double, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: name(*)
            real(c_double), intent(out) :: value
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        function mms_field_set_parameter(field, name, value, message, capacity) result(code) bind(c)
            import :: c_char, c_double, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: name(*)
            real(c_double), value :: value
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        ! `names` are `c_loc` of texts.
        function mms_field_set_parameters(field, count, names, values, message, capacity) &
            result(code) bind(c)
            import :: c_char, c_double, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            integer(c_size_t), value :: count
            type(c_ptr), intent(in) :: names(*)
            real(c_double), intent(in) :: values(*)
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        function mms_field_components(field, quantity, components, message, capacity) &
            result(code) bind(c)
            import :: c_char, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: quantity(*)
            integer(c_size_t), intent(out) :: components
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        ! `points(D, count)`, `values(C, count)`, and for a tensor `values(J, i, count)`: the first index of an array is the
        ! fastest. `normals` is `c_null_ptr`, or `c_loc` of an array(D, count).
        function mms_field_evaluate(field, quantity, time, count, points, normals, values, &
            message, capacity) result(code) bind(c)
            import :: c_char, c_double, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: quantity(*)
            real(c_double), value :: time
            integer(c_size_t), value :: count
            real(c_double), intent(in) :: points(*)
            type(c_ptr), value :: normals
            real(c_double), intent(out) :: values(*)
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        function mms_field_evaluate_stoppable(field, quantity, time, count, points, normals, stop, &
            values, message, capacity) result(code) bind(c)
            import :: c_char, c_double, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: quantity(*)
            real(c_double), value :: time
            integer(c_size_t), value :: count
            real(c_double), intent(in) :: points(*)
            type(c_ptr), value :: normals, stop
            real(c_double), intent(out) :: values(*)
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        function mms_field_normals(field, face, count, points, normals, message, capacity) &
            result(code) bind(c)
            import :: c_char, c_double, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: face(*)
            integer(c_size_t), value :: count
            real(c_double), intent(in) :: points(*)
            real(c_double), intent(out) :: normals(*)
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        function mms_field_bound_components(field, name, components, message, capacity) &
            result(code) bind(c)
            import :: c_char, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: name(*)
            integer(c_size_t), intent(out) :: components
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        function mms_field_get_bound(field, name, room, values, message, capacity) result(code) bind(c)
            import :: c_char, c_double, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: name(*)
            integer(c_size_t), value :: room
            real(c_double), intent(out) :: values(*)
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function

        function mms_field_bound(field, name, values, message, capacity) result(code) bind(c)
            import :: c_char, c_double, c_int32_t, c_ptr, c_size_t
            type(c_ptr), value :: field
            character(kind=c_char), intent(in) :: name(*)
            real(c_double), intent(out) :: values(*)
            character(kind=c_char), intent(out) :: message(*)
            integer(c_size_t), value :: capacity
            integer(c_int32_t) :: code
        end function
    end interface

contains

    ! The text at an address, without its NUL; empty for NULL.
    function c_text(address) result(text)
        type(c_ptr), intent(in) :: address
        character(:), allocatable :: text
        character(kind=c_char), pointer :: letters(:)
        text = ''
        if (.not. c_associated(address)) return
        do
            call c_f_pointer(address, letters, [len(text) + 1])
            if (letters(len(text) + 1) == c_null_char) exit
            text = text // letters(len(text) + 1)
        end do
    end function
end module
