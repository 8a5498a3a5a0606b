// The examples of the C++ reference, each with a law that it must keep: they throw if one does not hold.
#pragma once

#include <koebe/koebe.h>

/// Examples on an annulus with radii 0.3 and 1, whose vertices begin at the inner loop.
void one_surface(const koebe::Vertices& vertices, const koebe::Triangles& triangles);
void steps(const koebe::Vertices& vertices, const koebe::Triangles& triangles);
void shapes();
void handles();
