// Reads a pattern that is a file.
#pragma once

#include "io/polygon_triangulation.h"
#include "lift/lift.h"
#include "lift/png_image.h"
#include "svg/svg_drawing.h"

#include <optional>
#include <string>

namespace koebe {

/// A mesh with x and y as flat coordinates and z as height.
struct PatternMesh {
    Vertices vertices;
    Triangles triangles;
};

/// What a pattern's file holds; nothing for a built-in pattern.
struct PatternFile {
    std::optional<SvgDrawing> drawing;
    std::optional<GreyImage> image;
    std::optional<PatternMesh> mesh;
};

/// @throws FileError; InputError the file is damaged, or options that its kind of pattern does not have
PatternFile read_pattern(const std::string& pattern, const LiftOptions& options);

}  // namespace koebe
