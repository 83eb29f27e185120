static const double eps = sizeof(real) < sizeof(double) ? (double)FLT_EPSILON : DBL_EPSILON;
static const double least = sizeof(real) < sizeof(double) ? (double)FLT_MIN : DBL_MIN;
static double worst = 0.0;
static int failures = 0;

/* Compares the results of a function with a set of parameters. */
static void check(const char *name, int n, const double *expected, const real *found)
{
    const int limit = accepted[sizeof(real) < sizeof(double)];
    double error = 0.0, magnitude = least;
    for (int k = 0; k < n; k++) {
        const double difference = fabs((double)found[k] - expected[k]);
        error = fmax(error, isfinite(difference) ? difference : HUGE_VAL);
        magnitude = fmax(magnitude, fabs(expected[k]));
    }
    error = error / magnitude / eps;
    worst = fmax(worst, error);
    if (error > limit) {
        printf("%s: %.3g eps, accepted %d\n", name, error, limit);
        failures++;
    }
}

/* Calls a function, which writes COUNT numbers into `out`, at each of ROWS points. */
#define CHECK(NAME, ROWS, COUNT, CALL)                                        \
    table(#NAME, ROWS, COUNT);                                                \
    for (int p = 0; p < ROWS; p++) {                                          \
        real *const out = &found[COUNT * p];                                  \
        CALL;                                                                 \
    }                                                                         \
    check(#NAME, ROWS * COUNT, numbers, found)

static struct point {
    real t, X[DIMENSION], N[DIMENSION], H[SQUARED];
} at[ROOM];
static field_instant now[ROOM];
static real found[ROOM * WIDEST];

int main(int count, char **arguments)
{
    field_parameters parameters = field_default_parameters();
    open_vectors(count, arguments);
    table("defaults", 1, PARAMETERS);
    DEFAULTS
    for (int set = 0; set < SETS; set++) {
        table("set", 1, PARAMETERS);
        GIVEN
        const field_field field = field_prepare(&parameters);
        table("at", POINTS, WIDTH);
        for (int p = 0; p < POINTS; p++) {
            const double *const row = &numbers[WIDTH * p];
            at[p].t = (real)row[0];
            for (int k = 0; k < DIMENSION; k++) {
                at[p].X[k] = (real)row[1 + k];
                at[p].N[k] = (real)row[1 + DIMENSION + k];
            }
            for (int k = 0; k < SQUARED; k++) {
                at[p].H[k] = (real)row[1 + 2 * DIMENSION + k];
            }
            now[p] = field_at_time(&field, at[p].t);
        }
        FUNCTIONS
    }
    printf("field_: worst error %.3g eps\n", worst);
    return failures > 0;
}
