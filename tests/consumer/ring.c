// The program in C of docs/cpp.md.
#include <koebe/koebe_c.h>

#include <math.h>
#include <stdio.h>

int main(void)
{
    /* A flat ring of 12 quadrilaterals, each cut into two triangles: radii 1 and 2. */
    double vertices[24][3], uv[24][2];
    int32_t triangles[24][3];
    for (int k = 0; k < 12; ++k) {
        const int next = (k + 1) % 12;
        const int32_t two[2][3] = {{k, next, next + 12}, {k, next + 12, k + 12}};
        for (int i = 0; i < 6; ++i) triangles[2 * k + i / 3][i % 3] = two[i / 3][i % 3];
        for (int r = 0; r < 2; ++r) {
            const double turn = 2.0 * acos(-1.0) * k / 12.0, radius = 2 - r;
            double* const at = vertices[12 * r + k];
            at[0] = radius * cos(turn);
            at[1] = radius * sin(turn);
            at[2] = 0.0;
        }
    }
    koebe_circle circles[2];
    koebe_report report;
    char message[200];
    const int status = koebe_uniformize(&vertices[0][0], 24, &triangles[0][0], 24, NULL, &uv[0][0], circles, 2, &report,
                                        message, sizeof message);
    if (status != KOEBE_DONE) {
        fprintf(stderr, "%s\n", message);
        return status;
    }
    printf("%d loops, radius %.3f, %.2f degrees\n", (int)report.loops, circles[1].radius, report.angle_error_deg);
    triangles[0][0] = 99;
    return koebe_uniformize(&vertices[0][0], 24, &triangles[0][0], 24, NULL, &uv[0][0], NULL, 0, NULL, message,
                            sizeof message) == KOEBE_WRONG_USAGE
               ? 0
               : 1;
}
