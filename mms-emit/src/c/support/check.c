static const double eps = sizeof(real) < sizeof(double) ? (double)FLT_EPSILON : DBL_EPSILON;
static const double least = sizeof(real) < sizeof(double) ? (double)FLT_MIN : DBL_MIN;
static double worst = 0.0;
static int failures = 0;

/* Compares what a function gives with a set of parameters. */
static void check(const char *name, int n, int accepted, const double *expected, const real *found)
{
    double error = 0.0, magnitude = least;
    for (int k = 0; k < n; k++) {
        const double difference = fabs((double)found[k] - expected[k]);
        error = fmax(error, isfinite(difference) ? difference : HUGE_VAL);
        magnitude = fmax(magnitude, fabs(expected[k]));
    }
    error = error / magnitude / eps;
    worst = fmax(worst, error);
    if (error > accepted) {
        printf("%s: %.3g eps, accepted %d\n", name, error, accepted);
        failures++;
    }
}

/* Calls a function, which puts COUNT numbers into `out`, at each of so many points. */
#define CHECK(NAME, ROWS, COUNT, ACCEPTED, CALL)                              \
    for (int p = 0; p < ROWS; p++) {                                          \
        real *const out = &found[COUNT * p];                                  \
        CALL;                                                                 \
    }                                                                         \
    check(#NAME, ROWS * COUNT, ACCEPTED, expected_##NAME[set][0], found)

int main(void)
{
    static real found[FOUND];
    DEFAULTS
    for (int set = 0; set < SETS; set++) {
        const field_field field = field_prepare(&sets[set]);
        const struct point *const at = points[set];
        field_instant now[POINTS];
        for (int p = 0; p < POINTS; p++) {
            now[p] = field_at_time(&field, at[p].t);
        }
        FUNCTIONS
    }
    printf("field_: worst error %.3g eps\n", worst);
    return failures > 0;
}
