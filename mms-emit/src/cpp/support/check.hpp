int failures = 0;
double worst = 0.0;

/// Compares what a function gives with a set of parameters.
template <class T>
void check(const char *name, int n, int accepted, const double *expected, const T *found)
{
    double error = 0.0, magnitude = static_cast<double>(std::numeric_limits<T>::min());
    for (int k = 0; k < n; k++) {
        const double difference = std::fabs(static_cast<double>(found[k]) - expected[k]);
        error = std::fmax(error, std::isfinite(difference) ? difference : HUGE_VAL);
        magnitude = std::fmax(magnitude, std::fabs(expected[k]));
    }
    error = error / magnitude / static_cast<double>(std::numeric_limits<T>::epsilon());
    worst = std::fmax(worst, error);
    if (error > accepted) {
        std::printf("%s: %.3g eps of %zu bytes, accepted %d\n", name, error, sizeof(T), accepted);
        failures++;
    }
}

/// The numbers of a point, of columns of them.
template <class T, std::size_t N> std::array<T, N> row(const T (&columns)[N][POINTS], int p)
{
    std::array<T, N> numbers{};
    for (std::size_t k = 0; k < N; k++) {
        numbers[k] = columns[k][p];
    }
    return numbers;
}

/// Calls a function of one point, which puts COUNT numbers into `out`, at each; and that of many, for
/// each point and all before it, so that what is compared is the last of them.
#define CHECK(NAME, COUNT, ACCEPTED, ONE, MANY)                                            \
    for (int p = 0; p < POINTS; p++) {                                                     \
        ONE;                                                                               \
        for (int k = 0; k < COUNT; k++) {                                                  \
            found[k][p] = out[k];                                                          \
        }                                                                                  \
    }                                                                                      \
    check(#NAME, COUNT * POINTS, ACCEPTED, expected_##NAME[set][0], found[0]);             \
    for (std::size_t p = POINTS; p-- > 0;) {                                               \
        MANY;                                                                              \
    }                                                                                      \
    check(#NAME "_batch", COUNT * POINTS, ACCEPTED, expected_##NAME[set][0], found[0])

template <class T> void check_all()
{
    T out[WIDEST];
    DEFAULTS
    for (int set = 0; set < SETS; set++) {
        const auto field = field_::prepare(sets<T>[set]);
        const auto &at = points<T>[set];
        T found[WIDEST][POINTS];
        field_::Instant<T> now[POINTS];
        for (int p = 0; p < POINTS; p++) {
            now[p] = field_::at_time(field, at.t[p]);
        }
        FUNCTIONS
    }
}

int run()
{
    check_all<double>();
    check_all<float>();
    std::printf("field_: worst error %.3g eps\n", worst);
    return failures > 0;
}

} // namespace
} // namespace mms_check

int main()
{
    return mms_check::run();
}
