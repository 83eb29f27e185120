/* A total-Lagrangian solid of neo-Hookean material in plane strain: squares of bilinear elements, 2 x 2
 * points of quadrature, a lumped mass and central differences in time. It runs travelling_wave_2d of the
 * gallery from the start of its window, and writes the displacement at the nodes in the legacy format of VTK.
 *
 * mms emit travelling_wave_2d --target c -o FOLDER
 * cc -std=c99 -O2 -ffp-contract=off -IFOLDER FOLDER/travelling_wave_2d.c solid.c -lm
 * ./a.out CELLS STEPS END FILE */
#include "travelling_wave_2d.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A mesh of n x n elements, and the state at its nodes, two components each. */
typedef struct {
    size_t n;
    double h, lambda, mu, rho0;
    double *X, *u, *v, *a;
} solid;

static double *numbers(size_t count)
{
    double *first = calloc(count, sizeof *first);
    if (!first) {
        fputs("out of memory\n", stderr);
        exit(3);
    }
    return first;
}

static size_t node(const solid *body, size_t i, size_t j)
{
    return j * (body->n + 1) + i;
}

static int is_held(const solid *body, size_t i, size_t j)
{
    return i == 0 || j == 0 || i == body->n || j == body->n;
}

/* P = mu (F - F^-T) + lambda ln J F^-T, rows first. */
static void stress(const solid *body, const double H[4], double P[4])
{
    const double F[4] = {1.0 + H[0], H[1], H[2], 1.0 + H[3]};
    const double J = F[0] * F[3] - F[1] * F[2];
    const double inverse_transpose[4] = {F[3] / J, -F[2] / J, -F[1] / J, F[0] / J};
    const double factor = body->lambda * log(J) - body->mu;
    for (int k = 0; k < 4; ++k) {
        P[k] = body->mu * F[k] + factor * inverse_transpose[k];
    }
}

/* Values and gradients of the four shape functions, at (x, y) in the unit square. */
static void shape(double h, double x, double y, double N[4], double G[4][2])
{
    const double along[4] = {1.0 - x, x, x, 1.0 - x}, up[4] = {1.0 - y, 1.0 - y, y, y};
    const double slope[4] = {-1.0, 1.0, 1.0, -1.0}, rise[4] = {-1.0, -1.0, 1.0, 1.0};
    for (int k = 0; k < 4; ++k) {
        N[k] = along[k] * up[k];
        G[k][0] = slope[k] * up[k] / h;
        G[k][1] = along[k] * rise[k] / h;
    }
}

/* The nodes of element (i, j), whose quadrature points have weights 1/4. */
static void element(const solid *body, size_t i, size_t j, size_t at[4])
{
    at[0] = node(body, i, j);
    at[1] = node(body, i + 1, j);
    at[2] = node(body, i + 1, j + 1);
    at[3] = node(body, i, j + 1);
}

static const double GAUSS[2] = {0.21132486540518713, 0.78867513459481287};

/* Accelerations: of inner nodes, (rho0 b - P grad) over the mass; of the others, from the field. */
static void accelerate(solid *body, const travelling_wave_2d_instant *now)
{
    const size_t n = body->n, count = (n + 1) * (n + 1);
    const double area = body->h * body->h;
    memset(body->a, 0, 2 * count * sizeof *body->a);
    for (size_t j = 0; j < n; ++j) {
        for (size_t i = 0; i < n; ++i) {
            size_t at[4];
            element(body, i, j, at);
            for (int q = 0; q < 4; ++q) {
                double N[4], G[4][2], H[4] = {0.0}, P[4], X[2] = {0.0}, b[2];
                shape(body->h, GAUSS[q % 2], GAUSS[q / 2], N, G);
                for (int k = 0; k < 4; ++k) {
                    for (int c = 0; c < 2; ++c) {
                        X[c] += N[k] * body->X[2 * at[k] + c];
                        H[2 * c] += body->u[2 * at[k] + c] * G[k][0];
                        H[2 * c + 1] += body->u[2 * at[k] + c] * G[k][1];
                    }
                }
                stress(body, H, P);
                travelling_wave_2d_body_force(now, X, b);
                for (int k = 0; k < 4; ++k) {
                    for (int c = 0; c < 2; ++c) {
                        const double pull = P[2 * c] * G[k][0] + P[2 * c + 1] * G[k][1];
                        body->a[2 * at[k] + c] += area / 4.0 * (body->rho0 * N[k] * b[c] - pull);
                    }
                }
            }
        }
    }
    for (size_t j = 0; j <= n; ++j) {
        for (size_t i = 0; i <= n; ++i) {
            double *a = body->a + 2 * node(body, i, j);
            if (is_held(body, i, j)) {
                travelling_wave_2d_acceleration(now, body->X + 2 * node(body, i, j), a);
            } else {
                a[0] /= body->rho0 * area;
                a[1] /= body->rho0 * area;
            }
        }
    }
}

/* Writes nodes, elements and the displacement; returns 0 if that fails. */
static int written(const solid *body, const char *path)
{
    const size_t n = body->n, count = (n + 1) * (n + 1);
    FILE *file = fopen(path, "w");
    if (!file) {
        return 0;
    }
    fprintf(file, "# vtk DataFile Version 3.0\nsolid\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %zu double\n", count);
    for (size_t k = 0; k < count; ++k) {
        fprintf(file, "%.17g %.17g 0\n", body->X[2 * k], body->X[2 * k + 1]);
    }
    fprintf(file, "CELLS %zu %zu\n", n * n, 5 * n * n);
    for (size_t j = 0; j < n; ++j) {
        for (size_t i = 0; i < n; ++i) {
            size_t at[4];
            element(body, i, j, at);
            fprintf(file, "4 %zu %zu %zu %zu\n", at[0], at[1], at[2], at[3]);
        }
    }
    fprintf(file, "CELL_TYPES %zu\n", n * n);
    for (size_t k = 0; k < n * n; ++k) {
        fputs("9\n", file);
    }
    fprintf(file, "POINT_DATA %zu\nVECTORS displacement double\n", count);
    for (size_t k = 0; k < count; ++k) {
        fprintf(file, "%.17g %.17g 0\n", body->u[2 * k], body->u[2 * k + 1]);
    }
    return fclose(file) == 0;
}

/* Runs from the start of the window to `end`; returns 0 if the result cannot be written. */
static int run(size_t n, size_t steps, double end, const char *path)
{
    const travelling_wave_2d_parameters parameters = travelling_wave_2d_default_parameters();
    const travelling_wave_2d_field field = travelling_wave_2d_prepare(&parameters);
    const size_t count = (n + 1) * (n + 1);
    const double young = parameters.young, nu = parameters.nu;
    solid body = {
        n, parameters.length / (double)n,
        young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), young / (2.0 * (1.0 + nu)), parameters.rho0,
        numbers(2 * count), numbers(2 * count), numbers(2 * count), numbers(2 * count),
    };
    double window[2];
    travelling_wave_2d_time_window(&field, window);
    const double dt = (end - window[0]) / (double)steps;

    travelling_wave_2d_instant now = travelling_wave_2d_at_time(&field, window[0]);
    for (size_t j = 0; j <= n; ++j) {
        for (size_t i = 0; i <= n; ++i) {
            const size_t first = 2 * node(&body, i, j);
            body.X[first] = body.h * (double)i;
            body.X[first + 1] = body.h * (double)j;
            travelling_wave_2d_displacement(&now, body.X + first, body.u + first);
            travelling_wave_2d_velocity(&now, body.X + first, body.v + first);
        }
    }
    accelerate(&body, &now);
    for (size_t step = 1; step <= steps; ++step) {
        for (size_t k = 0; k < 2 * count; ++k) {
            body.v[k] += dt / 2.0 * body.a[k];
            body.u[k] += dt * body.v[k];
        }
        now = travelling_wave_2d_at_time(&field, window[0] + (double)step * dt);
        accelerate(&body, &now);
        for (size_t k = 0; k < 2 * count; ++k) {
            body.v[k] += dt / 2.0 * body.a[k];
        }
    }
    const int result = written(&body, path);
    free(body.X);
    free(body.u);
    free(body.v);
    free(body.a);
    return result;
}

int main(int count, char **words)
{
    if (count != 5) {
        fputs("expected CELLS STEPS END FILE\n", stderr);
        return 2;
    }
    const size_t cells = strtoul(words[1], NULL, 10), steps = strtoul(words[2], NULL, 10);
    if (!run(cells, steps, strtod(words[3], NULL), words[4])) {
        perror(words[4]);
        return 3;
    }
    return 0;
}
