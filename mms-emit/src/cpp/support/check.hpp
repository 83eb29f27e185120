int failures = 0;
double worst = 0.0;

/// Compares the results of a function with a set of parameters; the rows of the expected table are columns of `found`.
template <class T> void check(const char *name, int rows, int columns, const double *expected, const T *found)
{
    const int limit = accepted[sizeof(T) < sizeof(double)];
    double error = 0.0, magnitude = static_cast<double>(std::numeric_limits<T>::min());
    for (int k = 0; k < rows * columns; k++) {
        const double wanted = expected[k];
        const double difference = std::fabs(static_cast<double>(found[k % columns * rows + k / columns]) - wanted);
        error = std::fmax(error, std::isfinite(difference) ? difference : HUGE_VAL);
        magnitude = std::fmax(magnitude, std::fabs(wanted));
    }
    error = error / magnitude / static_cast<double>(std::numeric_limits<T>::epsilon());
    worst = std::fmax(worst, error);
    if (error > limit) {
        std::printf("%s: %.3g eps of %zu bytes, accepted %d\n", name, error, sizeof(T), limit);
        failures++;
    }
}

/// The points of a set of parameters.
template <class T> struct Points {
    T t[ROOM], X[DIMENSION][ROOM], N[DIMENSION][ROOM], H[SQUARED][ROOM];
};

/// The numbers of a point, of columns of them.
template <class T, std::size_t N> std::array<T, N> row(const T (&columns)[N][ROOM], int p)
{
    std::array<T, N> result{};
    for (std::size_t k = 0; k < N; k++) {
        result[k] = columns[k][p];
    }
    return result;
}

/// Calls a function of one point, which writes COUNT numbers into `out`, at each point. Then calls its batch function for
/// each point and all points before it, and compares the last result of each call.
#define CHECK(NAME, COUNT, ONE, MANY)                                                      \
    table(#NAME, POINTS, COUNT);                                                           \
    for (int p = 0; p < POINTS; p++) {                                                     \
        ONE;                                                                               \
        for (int k = 0; k < COUNT; k++) {                                                  \
            found[k][p] = out[k];                                                          \
        }                                                                                  \
    }                                                                                      \
    check(#NAME, POINTS, COUNT, numbers, found[0]);                                        \
    for (std::size_t p = POINTS; p-- > 0;) {                                               \
        MANY;                                                                              \
    }                                                                                      \
    check(#NAME "_batch", POINTS, COUNT, numbers, found[0])

template <class T> void check_all()
{
    // If the field has no value at any point, only its point-free numbers are compared.
    [[maybe_unused]] static T out[WIDEST], found[WIDEST][ROOM];
    static Points<T> at;
    static field_::Instant<T> now[ROOM];
    std::rewind(vectors);
    table("defaults", 1, PARAMETERS);
    auto parameters = field_::default_parameters<T>();
    DEFAULTS
    for (int set = 0; set < SETS; set++) {
        table("set", 1, PARAMETERS);
        GIVEN
        const auto field = field_::prepare(parameters);
        table("at", POINTS, WIDTH);
        for (int p = 0; p < POINTS; p++) {
            const double *const given = &numbers[WIDTH * p];
            at.t[p] = T(given[0]);
            for (int k = 0; k < DIMENSION; k++) {
                at.X[k][p] = T(given[1 + k]);
                at.N[k][p] = T(given[1 + DIMENSION + k]);
            }
            for (int k = 0; k < SQUARED; k++) {
                at.H[k][p] = T(given[1 + 2 * DIMENSION + k]);
            }
            now[p] = field_::at_time(field, at.t[p]);
        }
        FUNCTIONS
    }
}

int run(int count, char **arguments)
{
    open_vectors(count, arguments);
    check_all<double>();
    check_all<float>();
    std::printf("field_: worst error %.3g eps\n", worst);
    return failures > 0;
}

} // namespace
} // namespace mms_check

int main(int count, char **arguments)
{
    return mms_check::run(count, arguments);
}
