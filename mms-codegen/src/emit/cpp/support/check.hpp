/// The errors of one precision.
template <class T> class Check {
public:
    explicit Check(const char *precision) : precision_(precision) {}

    void compare(int set, const double *expected, const T *found, int count)
    {
        for (int k = 0; k < count; k++) {
            const double value = static_cast<double>(found[k]);
            const double error = std::isfinite(value) ? std::fabs(value - expected[k]) : HUGE_VAL;
            errors_[set] = std::fmax(errors_[set], error);
            magnitudes_[set] = std::fmax(magnitudes_[set], std::fabs(expected[k]));
        }
    }

    /// Ends the comparison of a function.
    void settle(const char *name, int accepted)
    {
        const double eps = static_cast<double>(std::numeric_limits<T>::epsilon());
        const double least = static_cast<double>(std::numeric_limits<T>::min());
        for (int set = 0; set < SETS; set++) {
            const double error = errors_[set] / std::fmax(magnitudes_[set], least) / eps;
            if (error > accepted) {
                std::printf("%s in %s: %.3g eps, accepted %d\n", name, precision_, error, accepted);
                failures_++;
            }
            if (error > worst_) {
                worst_ = error;
                worst_name_ = name;
            }
            errors_[set] = magnitudes_[set] = 0.0;
        }
    }

    int conclude() const
    {
        std::printf("field_ in %s: worst error %.3g eps, of %s\n", precision_, worst_, worst_name_);
        return failures_;
    }

private:
    const char *precision_;
    const char *worst_name_ = "nothing";
    double errors_[SETS] = {}, magnitudes_[SETS] = {}, worst_ = 0.0;
    int failures_ = 0;
};

/// Numbers in the precision that is checked.
template <class T, std::size_t N> std::array<T, N> of(const double (&values)[N])
{
    std::array<T, N> result{};
    for (std::size_t k = 0; k < N; k++) {
        result[k] = static_cast<T>(values[k]);
    }
    return result;
}

/// Two points as a function of many takes them: a column for each number.
template <class T, std::size_t N>
std::array<T, 2 * N> columns(const double (&first)[N], const double (&second)[N])
{
    std::array<T, 2 * N> result{};
    for (std::size_t k = 0; k < N; k++) {
        result[2 * k] = static_cast<T>(first[k]);
        result[2 * k + 1] = static_cast<T>(second[k]);
    }
    return result;
}

/// What it gives at the second of two points.
template <class T, std::size_t N> std::array<T, N / 2> second(const T (&both)[N])
{
    std::array<T, N / 2> result{};
    for (std::size_t k = 0; k < N / 2; k++) {
        result[k] = both[2 * k + 1];
    }
    return result;
}
