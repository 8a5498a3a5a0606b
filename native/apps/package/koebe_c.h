/* Koebe UV for C programs, and for languages that call C: #include <koebe/koebe_c.h>, link koebe::koebe. */
#ifndef KOEBE_C_H
#define KOEBE_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#include "core/api.h"
#define KOEBE_C_FUNCTION extern "C" KOEBE_API
#define KOEBE_C_NOEXCEPT noexcept
#else
#define KOEBE_C_FUNCTION
#define KOEBE_C_NOEXCEPT
#endif

/* NOLINTBEGIN(readability-identifier-naming): the names are those of C. */

/* What a call returns: the exit codes of the command. */
enum koebe_status {
    KOEBE_DONE = 0,
    KOEBE_BROKEN = 1,           /* the library itself failed */
    KOEBE_WRONG_USAGE = 2,      /* an argument: a pointer, a number, an index */
    KOEBE_CANNOT_BE_MAPPED = 3, /* the surface: its topology, or too little memory */
    KOEBE_NOT_CONVERGED = 4     /* the map is written, but not done: the message says why */
};

typedef struct koebe_options {
    double even;          /* 0: conformal, to 1: true to size */
    int32_t outer_vertex; /* a vertex of the outer loop; -1: chosen */
    int32_t center;       /* an inner vertex that goes to 0; -1: none */
    int32_t point;        /* a vertex of the outer loop that goes to 1; -1: none */
    int32_t threads;      /* at most; 0: all cores. Any number gives the same result */
} koebe_options;

/* The options of a call without options. */
#define KOEBE_DEFAULT_OPTIONS                                                                                          \
    {                                                                                                                  \
        0.0, -1, -1, -1, 0                                                                                             \
    }

typedef struct koebe_circle {
    double x, y, radius;
} koebe_circle;

typedef struct koebe_report {
    int64_t loops;            /* boundary loops of the surface */
    int64_t flipped;          /* faces without positive area as 32-bit UVs */
    int64_t below_resolution; /* those of them that are too small for 32-bit UVs */
    double angle_error_deg;   /* mean */
    double lost_area;         /* share of the surface without area in the UVs */
    double seconds;
} koebe_report;

/* Maps a surface with holes to the unit disk, each boundary loop onto a circle (koebe::uniformize). Calls on several
   threads at once are independent. Without success only `message` changes.

   vertices  (vertex_count, 3) by rows, finite
   triangles (triangle_count, 3) by rows: vertices, from 0
   options   or NULL: the defaults
   uv        (vertex_count, 2) by rows, for the points of the disk; may be the memory of the vertices
   circles   (circle_count) for the circles of the first loops, the outer one first; NULL if circle_count is 0
   report    or NULL
   message   (message_size) for one line, "" when done; NULL if message_size is 0
   Returns a koebe_status. */
KOEBE_C_FUNCTION int koebe_uniformize(const double* vertices, int64_t vertex_count, const int32_t* triangles,
                                      int64_t triangle_count, const koebe_options* options, double* uv,
                                      koebe_circle* circles, int64_t circle_count, koebe_report* report, char* message,
                                      size_t message_size) KOEBE_C_NOEXCEPT;

/* NOLINTEND(readability-identifier-naming) */

#endif
