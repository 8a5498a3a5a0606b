// A grey image as heights on a sheet.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/png_image.h"

#include <optional>
#include <vector>

namespace koebe {

/// A sheet with finer faces. Its first vertices are the sheet's, unchanged; others lie on its faces.
struct FineSheet {
    Vertices vertices, normals;
    Triangles triangles;
    std::vector<Complex> uv;  ///< (3F)
    std::vector<Index> face;  ///< (F) the sheet's face of each
};

/// Halves edges until each is at most `longest_uv` in the UVs, or `longest` on the surface if that is given.
/// @throws InputError it would have over four million faces; faces would be too small for 32-bit UVs
FineSheet refined_sheet(const FlatSheet& sheet, double longest_uv, std::optional<double> longest);

/// How an image covers a domain: once the unit square, or all of a ring or torus.
struct ImagePlace {
    int repeats = 1;          ///< copies round a ring or sphere, or along the first period of a torus
    double home_scale = 0.0;  ///< of a sphere (sphere_sheets.h); 0: it is none
};

/// The edge of a pixel in the UVs, the longer one; larger where that would need more than about a million faces.
double pixel_edge(const FlatSheet& sheet, const GreyImage& image, const ImagePlace& place);

/// The image's value for each vertex, from 0 to 1, bilinear between the middles of pixels. On a disk the image's top
/// is at v = 1; on a ring its columns go on over the cut, and its rows reach from rim to rim; on a torus both go on.
/// On a sphere its columns are meridians, as on a globe, and its rows reach from pole to pole.
VectorXd image_values(const FlatSheet& sheet, const FineSheet& fine, const GreyImage& image, const ImagePlace& place);

}  // namespace koebe
