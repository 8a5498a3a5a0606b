#include "schottky/finer_faces.h"

#include <map>
#include <utility>

namespace koebe {
namespace {

FinerFaces cut_in_four(const FinerFaces& faces)
{
    FinerFaces finer;
    std::map<std::pair<Index, Index>, Index> middle;
    const Triangles& triangles = faces.triangles;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) middle.try_emplace(std::minmax(triangles(f, k), triangles(f, (k + 1) % 3)), 0);
    finer.vertices.resize(faces.vertices.rows() + static_cast<Eigen::Index>(middle.size()), 3);
    finer.vertices.topRows(faces.vertices.rows()) = faces.vertices;
    auto next = static_cast<Index>(faces.vertices.rows());
    for (auto& [edge, vertex] : middle) {
        vertex = next++;
        finer.vertices.row(vertex) = 0.5 * faces.vertices.row(edge.first) + 0.5 * faces.vertices.row(edge.second);
    }
    finer.triangles.resize(4 * triangles.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        std::array<Index, 3> half;
        for (int k = 0; k < 3; ++k) half[k] = middle.at(std::minmax(triangles(f, k), triangles(f, (k + 1) % 3)));
        for (int k = 0; k < 3; ++k) finer.triangles.row(4 * f + k) << triangles(f, k), half[k], half[(k + 2) % 3];
        finer.triangles.row(4 * f + 3) << half[0], half[1], half[2];
        for (int k = 0; k < 4; ++k) finer.input_face.push_back(faces.input_face[f]);
    }
    // Triangle t is split into 4 t to 4 t + 3; corner c of t is the first corner of triangle 4 t + c.
    finer.corners = faces.corners;
    for (auto& corners : finer.corners)
        for (Index& corner : corners) corner = 3 * (4 * (corner / 3) + corner % 3);
    return finer;
}

}  // namespace

FinerFaces finer_faces(const Vertices& vertices, const Triangles& triangles, Index enough, int most_levels)
{
    FinerFaces faces{vertices, triangles, {}, {}};
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        faces.input_face.push_back(f);
        faces.corners.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    for (int level = 0; level < most_levels && faces.triangles.rows() < enough; ++level) faces = cut_in_four(faces);
    return faces;
}

}  // namespace koebe
