// The material point method in C++17: linear weights in the reference configuration, FLIP, leapfrog, rollers on all sides.
//
//     points CELLS STEPS START END FILE
//
// b and the start come from the field, which `mms emit --target cpp` writes; the solver has its own law.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "axis_aligned_2d.hpp"

using Vector = std::array<double, 2>;
using Matrix = std::array<Vector, 2>;

static const double lambda = 1e6 * 0.3 / (1.3 * 0.4), mu = 1e6 / 2.6, density = 1000;

struct Point {
    Vector X, u, v;
    Matrix F;
};

struct Node {
    double mass = 0;
    Vector momentum{}, force{};
};

// P of neo-Hookean material.
static Matrix stress(const Matrix &F)
{
    const double J = F[0][0] * F[1][1] - F[0][1] * F[1][0];
    const Matrix inverse = {{{F[1][1] / J, -F[1][0] / J}, {-F[0][1] / J, F[0][0] / J}}};
    Matrix P;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            P[i][k] = mu * (F[i][k] - inverse[i][k]) + lambda * std::log(J) * inverse[i][k];
    return P;
}

int main(int count, char **words)
{
    if (count != 6) return std::fprintf(stderr, "usage: points CELLS STEPS START END FILE\n"), 2;
    const int cells = std::atoi(words[1]), steps = std::atoi(words[2]), row = cells + 1;
    const double begin = std::atof(words[3]), dt = (std::atof(words[4]) - begin) / steps;
    const double h = 1.0 / cells, volume = h * h / 4;
    namespace exact = axis_aligned_2d;
    const auto field = exact::prepare(exact::default_parameters<double>());
    const auto start = exact::at_time(field, begin);
    std::vector<Point> points(4 * cells * cells);
    for (int p = 0; p < 4 * cells * cells; p++) {
        Point &it = points[p];
        it.X = {(p % (2 * cells) + 0.5) * h / 2, (p / (2 * cells) + 0.5) * h / 2};
        exact::displacement(start, it.X.data(), it.u.data());
        exact::velocity(start, it.X.data(), it.v.data());
        double F[4];
        exact::deformation_gradient(start, it.X.data(), F);
        it.F = {{{F[0], F[1]}, {F[2], F[3]}}};
    }
    for (int step = 0; step < steps; step++) {
        const auto now = exact::at_time(field, begin + step * dt);
        std::vector<Node> nodes(row * row);
        // The four nodes around a point, each with its weight and weight gradient.
        const auto around = [&](const Point &it, auto &&visit) {
            const int i = int(it.X[0] / h), j = int(it.X[1] / h);
            const double r = it.X[0] / h - i, s = it.X[1] / h - j;
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++) {
                    const double x = a ? r : 1 - r, y = b ? s : 1 - s;
                    visit(nodes[(j + b) * row + i + a], x * y,
                          Vector{(a ? y : -y) / h, (b ? x : -x) / h});
                }
        };
        for (const Point &it : points) {
            const Matrix P = stress(it.F);
            Vector b;
            exact::body_force(now, it.X.data(), b.data());
            around(it, [&](Node &node, double w, Vector g) {
                node.mass += w * density * volume;
                for (int i = 0; i < 2; i++) {
                    node.momentum[i] += w * density * volume * it.v[i];
                    const double inner = P[i][0] * g[0] + P[i][1] * g[1];
                    node.force[i] += (w * density * b[i] - inner) * volume;
                }
            });
        }
        // The first kick is half a step. No node moves through a side.
        const double kick = step == 0 ? dt / 2 : dt;
        for (int n = 0; n < row * row; n++)
            for (int i = 0; i < 2; i++) {
                const int place = i == 0 ? n % row : n / row;
                const bool is_wall = place == 0 || place == cells;
                Node &node = nodes[n];
                node.force[i] = is_wall ? 0 : node.force[i] / node.mass;
                node.momentum[i] = is_wall ? 0 : node.momentum[i] / node.mass + kick * node.force[i];
            }
        for (Point &it : points)
            around(it, [&](Node &node, double w, Vector g) {
                for (int i = 0; i < 2; i++) {
                    it.v[i] += kick * w * node.force[i];
                    it.u[i] += dt * w * node.momentum[i];
                    for (int k = 0; k < 2; k++) it.F[i][k] += dt * node.momentum[i] * g[k];
                }
            });
    }
    std::FILE *file = std::fopen(words[5], "w");
    if (!file) return std::perror(words[5]), 1;
    std::fprintf(file, "X,Y,ux,uy\n");
    for (const Point &it : points)
        std::fprintf(file, "%.17g,%.17g,%.17g,%.17g\n", it.X[0], it.X[1], it.u[0], it.u[1]);
    return std::fclose(file) ? 1 : 0;
}
