"""Measures the library beside the C code of `mms emit`, and prints the table of docs/guide/python.md: measure.py MMS.

Each number is the least of several tries, for others may use the processor. Needs the package, NumPy and gcc.
"""

import ctypes
import os
import pathlib
import subprocess
import sys
import tempfile
import time

FIELD, COUNT, TIME = "axis_aligned_3d", 10**6, 0.01


def least(work, tries=9):
    """The least wall time of several tries, in s."""
    times = []
    for _ in range(tries):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def imported():
    """The time to import the package after NumPy, in s: a process for each try."""
    code = "import time, numpy; s = time.perf_counter(); import manufactured; print(time.perf_counter() - s)"
    tries = [subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.PIPE).stdout for _ in range(9)]
    return min(float(it) for it in tries)


def emitted(mms, folder):
    """b of the C code of `mms emit`, point by point and of arrays of coordinates, each as a function of X and out."""
    subprocess.run([mms, "emit", FIELD, "--target", "c", "-o", folder], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    (pathlib.Path(folder) / "caller.c").write_text(f"""#include "{FIELD}.h"
static {FIELD}_instant now(double t) {{
    static {FIELD}_parameters parameters;
    static {FIELD}_field field;
    parameters = {FIELD}_default_parameters();
    field = {FIELD}_prepare(&parameters);
    return {FIELD}_at_time(&field, t);
}}
void points(size_t count, double t, const double *x, double *out) {{
    const {FIELD}_instant at = now(t);
    for (size_t i = 0; i < count; ++i) {FIELD}_body_force(&at, x + 3 * i, out + 3 * i);
}}
void arrays(size_t count, double t, const double *x, double *out) {{
    const {FIELD}_instant at = now(t);
    {FIELD}_body_force_batch(
            &at, count, x, x + count, x + 2 * count, out, out + count, out + 2 * count);
}}
""")
    library = os.path.join(folder, "b.so")
    command = ["gcc", "-O3", "-march=native", "-shared", "-fPIC", f"{FIELD}.c", "caller.c", "-o", library, "-lm"]
    subprocess.run(command, check=True, cwd=folder)
    calls = ctypes.CDLL(library)

    def of(call):
        call.argtypes = [ctypes.c_size_t, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p]
        return lambda x, out: call(x.size // 3, TIME, x.ctypes.data, out.ctypes.data)

    return of(calls.points), of(calls.arrays)


def memory():
    """The memory beyond X and the result that b of 10^7 points in three dimensions takes, in MiB: a process of its own."""
    code = f"""
import numpy as np, manufactured as mf
field = mf.field("{FIELD}")
field.b(field.sample(10), 0.0)
X = np.ascontiguousarray(np.resize(field.sample(10**5), (10**7, 3)))
open("/proc/self/clear_refs", "w").write("5")
before = [int(it.split()[1]) for it in open("/proc/self/status") if it.startswith("VmRSS")][0] / 1024
b = field.b(X, {TIME})
after = [int(it.split()[1]) for it in open("/proc/self/status") if it.startswith("VmHWM")][0] / 1024
print(after - before - b.nbytes / 2**20)
"""
    return float(subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.PIPE).stdout)


def leaked():
    """By how much the memory grows from the 1000th to the 11000th call, in kB."""
    import manufactured as mf

    field = mf.field("travelling_wave_2d")
    X = field.sample(1000)

    def resident():
        return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4

    def calls(count):
        for k in range(count):
            field.b(X, 1e-6 * k)
            field.at(1e-6 * k).sigma(X[::2])
            field.points(X).u(1e-6 * k)

    calls(1000)
    before = resident()
    calls(10_000)
    return resident() - before


def main(mms):
    affinity = os.sched_getaffinity(0)
    seconds = imported()
    os.sched_setaffinity(0, {min(affinity)})  # one thread
    import numpy as np

    import manufactured as mf

    field, bar = mf.field(FIELD), mf.field("bar_1d")
    X = field.sample(COUNT)
    kept, out = field.points(X), np.empty_like(X)
    at_points = [0.0]

    def later():
        at_points[0] += 1e-6
        kept.b(at_points[0])

    with tempfile.TemporaryDirectory() as folder:
        points, arrays = emitted(mms, folder)
        points(X, out)
        assert np.allclose(out, field.b(X, TIME), rtol=1e-9)
        turned, turned_out = np.ascontiguousarray(X.T), np.empty_like(X.T, order="C")
        arrays(turned, turned_out)
        assert np.allclose(turned_out.T, out, rtol=1e-12)
        c = min(least(lambda: points(X, out)), least(lambda: arrays(turned, turned_out)))
    ours, again = least(lambda: field.b(X, TIME)), least(later)
    point = np.array([0.3])
    one = least(lambda: [bar.displacement(point, 0.01) for _ in range(10_000)]) / 10_000
    print(f"| import, beyond NumPy | {seconds * 1e3:.1f} ms |")
    print(f"| b of `{FIELD}` at 10^6 points, one thread | {ours * 1e3:.0f} ms |")
    print(f"| the same from `points(X)`, at another time | {again * 1e3:.0f} ms |")
    print(f"| the C code of `mms emit` for it, with `gcc -O3 -march=native`, through ctypes | {c * 1e3:.0f} ms |")
    print(f"| `displacement` of `bar_1d` at one point | {one * 1e6:.1f} us |")
    growth = leaked()
    os.sched_setaffinity(0, affinity)
    print(f"| memory beyond X and the result, 10^7 points in three dimensions | {memory():.1f} MiB |")
    print(f"growth of memory over 30000 calls: {growth} kB; b takes {ours / c:.2f} of the time of C")


main(*sys.argv[1:])
