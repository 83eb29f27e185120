#ifdef FIELD_FLOAT
static const double eps = (double)FLT_EPSILON, least = (double)FLT_MIN;
#else
static const double eps = DBL_EPSILON, least = DBL_MIN;
#endif

static double errors[SETS], magnitudes[SETS], worst;
static const char *worst_name = "nothing";
static int failures;

static void compare(int set, int count, const double *expected, const field_real *found)
{
    for (int k = 0; k < count; k++) {
        const double value = (double)found[k];
        const double error = isfinite(value) ? fabs(value - expected[k]) : HUGE_VAL;
        errors[set] = fmax(errors[set], error);
        magnitudes[set] = fmax(magnitudes[set], fabs(expected[k]));
    }
}

/* Ends the comparison of a function. */
static void settle(const char *name, int accepted)
{
    for (int set = 0; set < SETS; set++) {
        const double error = errors[set] / fmax(magnitudes[set], least) / eps;
        if (error > accepted) {
            printf("%s: %.3g eps, accepted %d\n", name, error, accepted);
            failures++;
        }
        if (error > worst) {
            worst = error;
            worst_name = name;
        }
        errors[set] = magnitudes[set] = 0.0;
    }
}

static int conclude(void)
{
    printf("field_: worst error %.3g eps, of %s\n", worst, worst_name);
    return failures == 0 ? 0 : 1;
}

#define CHECK_ROWS(ROWS, SET, NAME, COUNT, ACCEPTED, CALL)  \
    for (int s = 0; s < ROWS; s++) {                        \
        field_real out[COUNT];                              \
        CALL;                                               \
        compare(SET, COUNT, NAME##_expected[s], out);       \
    }                                                       \
    settle(#NAME, ACCEPTED)
#define CHECK(NAME, COUNT, ACCEPTED, CALL) \
    CHECK_ROWS(SAMPLES, samples[s].set, NAME, COUNT, ACCEPTED, CALL)
#define CHECK_DOMAIN(NAME, COUNT, ACCEPTED, CALL) CHECK_ROWS(SETS, s, NAME, COUNT, ACCEPTED, CALL)
#define CHECK_DEFAULT(NAME, VALUE)                          \
    compare(0, 1, &(const double){VALUE}, &defaults.NAME);  \
    settle("default of " #NAME, 1)

