#include "transfer/cut_mesh.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <limits>

namespace koebe {
namespace {

constexpr double on_it = 1e-8;  // barycentric weight that counts as 0, dimensionless

using Corners = std::array<Index, 3>;

/// Weights of a face's corners at a vertex in it, of the mesh or added.
Eigen::RowVector3d weights_in(const Triangles& triangles, Index vertex_count, const std::vector<SurfacePoint>& added,
                              Index face, Index vertex)
{
    Eigen::RowVector3d weights = Eigen::RowVector3d::Zero();
    const auto corner = [&](Index v) {
        const auto row = triangles.row(face);
        return std::find(row.begin(), row.end(), v) - row.begin();
    };
    if (vertex < vertex_count) {
        weights[corner(vertex)] = 1.0;
        return weights;
    }
    const SurfacePoint& point = added[vertex - vertex_count];
    for (int k = 0; k < 3; ++k)
        if (point.weights[k] > 0.0) weights[corner(triangles(point.face, k))] += point.weights[k];
    return weights;
}

class Cutter {
public:
    Cutter(const Triangles& triangles, Index vertex_count) : triangles_(triangles), vertex_count_(vertex_count)
    {
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            pieces_.push_back({triangles(f, 0), triangles(f, 1), triangles(f, 2)});
            face_.push_back(static_cast<Index>(f));
        }
    }

    Index cut(const SurfacePoint& point)
    {
        auto [piece, weights] = piece_of(point);
        for (int k = 0; k < 3; ++k)
            if (weights[k] < on_it) weights[k] = 0.0;
        weights /= weights.sum();
        const auto zeros = (weights.array() == 0.0).count();
        const Corners corners = pieces_[piece];
        int largest = 0, least = 0;
        weights.maxCoeff(&largest);
        weights.minCoeff(&least);
        if (zeros == 2) return corners[largest];
        const Index vertex = vertex_count_ + static_cast<Index>(added_.size());
        added_.push_back(combined(piece, weights));
        if (zeros == 1)
            cut_edge(corners[(least + 1) % 3], corners[(least + 2) % 3], vertex);
        else
            cut_piece(piece, vertex);
        return vertex;
    }

    CutMesh result() const
    {
        CutMesh mesh;
        mesh.triangles.resize(static_cast<Eigen::Index>(pieces_.size()), 3);
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            mesh.triangles.row(static_cast<Eigen::Index>(i)) << pieces_[i][0], pieces_[i][1], pieces_[i][2];
        mesh.face = face_;
        mesh.added = added_;
        return mesh;
    }

private:
    Eigen::Matrix3d corners_in_face(std::size_t piece) const
    {
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k)
            corners.row(k) = weights_in(triangles_, vertex_count_, added_, face_[piece], pieces_[piece][k]);
        return corners;
    }

    SurfacePoint combined(std::size_t piece, const Eigen::RowVector3d& weights) const
    {
        return {face_[piece], weights * corners_in_face(piece)};
    }

    /// The piece of its face that holds a point, and the weights there.
    std::pair<std::size_t, Eigen::RowVector3d> piece_of(const SurfacePoint& point) const
    {
        std::pair<std::size_t, Eigen::RowVector3d> best{static_cast<std::size_t>(point.face), point.weights};
        double inside = -std::numeric_limits<double>::infinity();
        const auto look_at = [&](std::size_t piece) {
            if (face_[piece] != point.face) return;
            const Eigen::RowVector3d weights =
                corners_in_face(piece).transpose().partialPivLu().solve(point.weights.transpose()).transpose();
            if (weights.allFinite() && weights.minCoeff() > inside) {
                inside = weights.minCoeff();
                best = {piece, weights.cwiseMax(0.0)};
            }
        };
        look_at(static_cast<std::size_t>(point.face));
        for (std::size_t piece = static_cast<std::size_t>(triangles_.rows()); piece < pieces_.size(); ++piece)
            look_at(piece);
        return best;
    }

    void cut_piece(std::size_t piece, Index vertex)
    {
        const auto [a, b, c] = pieces_[piece];
        pieces_[piece] = {a, b, vertex};
        add({b, c, vertex}, face_[piece]);
        add({c, a, vertex}, face_[piece]);
    }

    void cut_edge(Index from, Index to, Index vertex)
    {
        for (std::size_t piece = 0, count = pieces_.size(); piece < count; ++piece)
            for (int k = 0; k < 3; ++k) {
                const Index a = pieces_[piece][k], b = pieces_[piece][(k + 1) % 3], c = pieces_[piece][(k + 2) % 3];
                if (!((a == from && b == to) || (a == to && b == from))) continue;
                pieces_[piece] = {a, vertex, c};
                add({vertex, b, c}, face_[piece]);
                break;
            }
    }

    void add(const Corners& corners, Index face)
    {
        pieces_.push_back(corners);
        face_.push_back(face);
    }

    const Triangles& triangles_;
    Index vertex_count_;
    std::vector<Corners> pieces_;
    std::vector<Index> face_;
    std::vector<SurfacePoint> added_;
};

}  // namespace

SurfacePoint CutMesh::on_mesh(Index piece, const Eigen::RowVector3d& weights, const Triangles& of_mesh,
                              Index vertex_count) const
{
    SurfacePoint point{face[piece], Eigen::RowVector3d::Zero()};
    for (int k = 0; k < 3; ++k)
        point.weights += weights[k] * weights_in(of_mesh, vertex_count, added, point.face, triangles(piece, k));
    return point;
}

CutMesh cut_at_points(const Triangles& triangles, Index vertex_count, const std::vector<SurfacePoint>& points)
{
    Cutter cutter(triangles, vertex_count);
    std::vector<Index> vertices;
    for (const SurfacePoint& point : points) vertices.push_back(cutter.cut(point));
    CutMesh mesh = cutter.result();
    mesh.vertex = std::move(vertices);
    return mesh;
}

}  // namespace koebe
