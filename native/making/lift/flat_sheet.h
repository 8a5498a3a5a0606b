// A surface with UVs for each corner, as a sheet: a path can cross every edge, also where the UVs are cut.
#pragma once

#include "core/connectivity.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// A triangle's chart is the UV plane with its own corners. Charts of two faces differ by a translation where the UVs
/// are cut along a period, and not at all inside a map.
struct FlatSheet {
    Vertices vertices;
    Triangles triangles;      ///< all of one orientation
    std::vector<Complex> uv;  ///< (3F) of corners
    double grid = 0.0;        ///< UVs are whole multiples of it; 0: there is no such number
    std::vector<Complex> periods = {};
    std::vector<double> grade = {};  ///< (V) size of outlines there, as a share of what is asked for; empty: 1
    std::vector<Index> gap = {};     ///< (F) of a filled sheet (filled_sheet.h); else empty

    std::vector<Index> twin;    ///< (3F)
    std::vector<char> border;   ///< (3F) whether the walk ends at this half-edge
    std::vector<Complex> step;  ///< (3F) added to a place in the face's chart it gives the place in its twin's chart
    std::vector<Index> sheet;   ///< (F) faces that can be reached from each other have one number
    std::vector<double> scale;  ///< (V) length on the surface over length in UVs
    Vertices normals;           ///< (V, 3) unit, weighted by angles
    double area = 0.0;          ///< of the surface
    double mean_scale = 1.0;    ///< root of the surface's area over the UVs'

    Complex corner(Index face, int k) const { return uv[3 * face + k]; }
    double twice_area(Index face) const;
    /// A field linear in each face, at barycentric weights.
    double scale_at(Index face, const Eigen::RowVector3d& weights) const;
    double grade_at(Index face, const Eigen::RowVector3d& weights) const;
    bool on_surface(Index face) const { return gap.empty() || gap[face] < 0; }
    Eigen::RowVector3d position_at(Index face, const Eigen::RowVector3d& weights) const;
    Complex uv_at(Index face, const Eigen::RowVector3d& weights) const;
    /// Barycentric coordinates of a place in a face's chart.
    Eigen::RowVector3d weights_of(Index face, Complex place) const;
};

/// @param triangles all of one orientation @param corner_uvs (3F, 2)
/// @throws TopologyError nonmanifold_edge
FlatSheet flat_sheet(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& corner_uvs,
                     double grid = 0.0, std::vector<Complex> periods = {});

/// 0, and what leads to the copies of a domain around it: up to two of each period, both ways.
std::vector<Complex> period_shifts(const std::vector<Complex>& periods);

/// (n, 2)
PlanarPoints planar_points(const std::vector<Complex>& places);

}  // namespace koebe
