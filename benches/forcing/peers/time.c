/* Times the body force of a header that sympy_cse.py wrote. Reads from standard input, all as doubles: the
   number of points, the number of rounds, the time, the parameters, and the coordinates axis by axis. Writes
   the seconds of each round and the results, component by component, as doubles. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include HEADER

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

__attribute__((noinline)) static void all(size_t n, double t, const double *p, double *const *x,
                                          double *const *out) {
    double *restrict first = out[0];
#if DIMENSION > 1
    double *restrict second = out[1];
#endif
#if DIMENSION > 2
    double *restrict third = out[2];
#endif
    for (size_t i = 0; i < n; i++) {
        double b[DIMENSION];
        CALL;
        first[i] = b[0];
#if DIMENSION > 1
        second[i] = b[1];
#endif
#if DIMENSION > 2
        third[i] = b[2];
#endif
    }
}

static double read_number(void) {
    double value;
    if (fread(&value, sizeof value, 1, stdin) != 1) exit(1);
    return value;
}

int main(void) {
    size_t n = (size_t)read_number(), rounds = (size_t)read_number();
    double t = read_number(), p[PARAMETERS], *x[DIMENSION], *out[DIMENSION];
    for (int k = 0; k < PARAMETERS; k++) p[k] = read_number();
    for (int k = 0; k < DIMENSION; k++) {
        x[k] = malloc(n * sizeof *x[k]);
        out[k] = malloc(n * sizeof *out[k]);
        if (!x[k] || !out[k] || fread(x[k], sizeof *x[k], n, stdin) != n) return 1;
    }
    /* Runs untimed for 1 ms, as the other contenders do. */
    double begun = now();
    do all(n, t, p, x, out);
    while (now() - begun < 1e-3);
    for (size_t round = 0; round < rounds; round++) {
        double start = now();
        all(n, t, p, x, out);
        double seconds = now() - start;
        fwrite(&seconds, sizeof seconds, 1, stdout);
    }
    for (int k = 0; k < DIMENSION; k++) fwrite(out[k], sizeof *out[k], n, stdout);
    return 0;
}
