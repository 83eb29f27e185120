"""b of the 1-D bar with half its amplitude, at five points and one time; and a mistake.

python3 forcing.py PREFIX/lib/libmms_capi.so
"""

import ctypes
import sys

mms = ctypes.CDLL(sys.argv[1])
mms.mms_field_name.restype = ctypes.c_char_p
mms.mms_field_title.restype = ctypes.c_char_p
for function in (mms.mms_field_name, mms.mms_field_title, mms.mms_field_free):
    function.argtypes = [ctypes.c_void_p]
message = ctypes.create_string_buffer(1024)


def call(function, *arguments):
    """Calls a function that takes a buffer for its message last; raises what is in it."""
    code = function(*arguments, message, ctypes.c_size_t(len(message)))
    if code != 0:
        raise RuntimeError(f"{code}: {message.value.decode()}")


def bound(field, name):
    """Where the body or the time window ends."""
    values = (ctypes.c_double * 3)()
    call(mms.mms_field_get_bound, field, name, ctypes.c_size_t(len(values)), values)
    return values


bar = ctypes.c_void_p()
call(mms.mms_field_from_gallery, b"bar_1d", ctypes.byref(bar))
call(mms.mms_field_set_parameter, bar, b"amplitude", ctypes.c_double(0.1))
print(f"{mms.mms_field_name(bar).decode()}: {mms.mms_field_title(bar).decode()}")

lower, upper = bound(bar, b"lower")[0], bound(bar, b"upper")[0]
X = (ctypes.c_double * 5)(*(lower + (upper - lower) * i / 4 for i in range(5)))
b = (ctypes.c_double * 5)()
count = ctypes.c_size_t(5)
call(mms.mms_field_evaluate, bar, b"body_force", ctypes.c_double(0.013), count, X, None, b)
for point, value in zip(X, b):
    print(f"{point:8.4f} {value:14.6f}")

try:
    call(mms.mms_field_set_parameter, bar, b"amplitud", ctypes.c_double(0.1))
except RuntimeError as error:
    print(error)
mms.mms_field_free(bar)
