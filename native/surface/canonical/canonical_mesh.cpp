#include "canonical/canonical_mesh.h"

#include "canonical/canonical_position.h"
#include "canonical/canonical_walk.h"
#include "core/connectivity.h"
#include "core/numbering.h"
#include "cut/edge_runs.h"
#include "mesh/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

namespace koebe {
namespace {

bool is_mesh(const Vertices& vertices, const Triangles& triangles)
{
    if (triangles.size() == 0 || !vertices.allFinite()) return false;
    if (triangles.minCoeff() < 0 || triangles.maxCoeff() >= vertices.rows()) return false;
    const Eigen::Index first = triangles(0, 0);
    return std::any_of(triangles.data(), triangles.data() + triangles.size(),
                       [&](Index v) { return vertices.row(v) != vertices.row(first); });
}

bool names_twice(const Triangles& triangles, Index f)
{
    return triangles(f, 0) == triangles(f, 1) || triangles(f, 1) == triangles(f, 2) ||
           triangles(f, 2) == triangles(f, 0);
}

/// Marks duplicate faces: all faces with the same vertices except the one that agrees with most of its neighbours, or
/// the first of several such. @param left_out (F) changed
void leave_out_duplicates(const Triangles& triangles, Index vertex_count, std::vector<char>& left_out)
{
    const auto count = static_cast<Index>(triangles.rows());
    const auto corners = [&](Index f) {
        std::array<Index, 3> result{triangles(f, 0), triangles(f, 1), triangles(f, 2)};
        std::ranges::sort(result);
        return std::pair(result, f);
    };
    std::vector<Index> begin(static_cast<std::size_t>(vertex_count) + 1, 0);  // of the faces with each lowest corner
    for (Index f = 0; f < count; ++f) begin[triangles.row(f).minCoeff() + 1] += left_out[f] ? 0 : 1;
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Index> faces(static_cast<std::size_t>(begin.back())), cursor(begin.begin(), begin.end() - 1);
    for (Index f = 0; f < count; ++f)
        if (!left_out[f]) faces[cursor[triangles.row(f).minCoeff()]++] = f;
    std::vector<std::pair<Index, Index>> steps;  // along edges of all faces without duplicates
    std::vector<std::vector<Index>> groups;
    for (Index v = 0; v < vertex_count; ++v) {
        const auto last = faces.begin() + begin[v + 1];
        std::ranges::sort(std::span<Index>(faces.data() + begin[v], faces.data() + begin[v + 1]), {}, corners);
        for (auto run = faces.begin() + begin[v]; run != last;) {
            const auto end = std::find_if(run, last, [&](Index f) { return corners(f).first != corners(*run).first; });
            if (end - run > 1) groups.emplace_back(run, end);
            run = end;
        }
    }
    if (groups.empty()) return;
    for (const auto& group : groups)
        for (const Index f : group) left_out[f] = 1;
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        if (!left_out[face_of(h)]) steps.emplace_back(origin(triangles, h), target(triangles, h));
    std::ranges::sort(steps);
    const auto agreeing = [&](Index f) {
        int count = 0;
        for (Index h = 3 * f; h < 3 * f + 3; ++h)
            count += std::ranges::binary_search(steps, std::pair(target(triangles, h), origin(triangles, h))) ? 1 : 0;
        return count;
    };
    for (const auto& group : groups) left_out[*std::ranges::max_element(group, {}, agreeing)] = 0;
}

/// (3F) twins over edges of two faces in one orientation.
std::vector<Index> twins_of(const Triangles& triangles, Index vertex_count, const std::vector<char>& left_out)
{
    std::vector<Index> twin(static_cast<std::size_t>(triangles.size()), no_twin), own;
    for_each_edge(triangles, vertex_count, [&](std::span<const Index> run) {
        own.clear();
        for (const Index h : run)
            if (!left_out[face_of(h)]) own.push_back(h);
        if (own.size() != 2 || origin(triangles, own[0]) != target(triangles, own[1])) return;
        twin[own[0]] = own[1];
        twin[own[1]] = own[0];
    });
    return twin;
}

/// Numbers the patches of faces that twins join.
void number_patches(JoinedFaces& faces, const std::vector<char>& left_out)
{
    const auto count = static_cast<Index>(faces.triangles.rows());
    faces.patch.assign(static_cast<std::size_t>(count), -1);
    faces.patches = 0;
    std::vector<Index> queue;
    for (Index seed = 0; seed < count; ++seed) {
        if (faces.patch[seed] >= 0 || left_out[seed]) continue;
        faces.patch[seed] = faces.patches;
        queue.assign(1, seed);
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h)
                if (const Index other = faces.twin[h]; other != no_twin && faces.patch[face_of(other)] < 0) {
                    faces.patch[face_of(other)] = faces.patches;
                    queue.push_back(face_of(other));
                }
        ++faces.patches;
    }
}

/// A half-edge of each face in no patch, in an order that follows from the other numbers.
std::vector<Index> entries_of_others(const Triangles& triangles, const std::vector<Index>& patch,
                                     const std::vector<Index>& rank)
{
    std::vector<std::pair<std::array<Index, 3>, Index>> entries;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        if (patch[f] >= 0) continue;
        std::pair<std::array<Index, 3>, Index> best;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            std::array<Index, 3> key;
            for (Index k = 0, g = h; k < 3; ++k, g = next_halfedge(g)) key[k] = rank[origin(triangles, g)];
            if (h == 3 * f || key < best.first) best = {key, h};
        }
        entries.push_back(best);
    }
    std::ranges::stable_sort(entries, {}, [](const auto& entry) { return entry.first; });
    std::vector<Index> result;
    for (const auto& entry : entries) result.push_back(entry.second);
    return result;
}

CanonicalMesh as_it_is(const Vertices& vertices, const Triangles& triangles)
{
    CanonicalMesh mesh{vertices, triangles, {}, {}, {}, Eigen::Matrix3d::Identity()};
    mesh.original_vertices = numbers_below(vertices.rows());
    mesh.original_faces = numbers_below(triangles.rows());
    mesh.first_corners.assign(mesh.original_faces.size(), 0);
    return mesh;
}

/// Numbers the vertices that have no number yet.
void append_unmet(const std::vector<Index>& wanted, std::vector<Index>& rank, std::vector<Index>& vertices)
{
    for (const Index v : wanted) {
        if (rank[v] != static_cast<Index>(rank.size())) continue;
        rank[v] = static_cast<Index>(vertices.size());
        vertices.push_back(v);
    }
}

}  // namespace

Index CanonicalMesh::vertex(Index original) const
{
    const auto found = std::ranges::find(original_vertices, original);
    return found == original_vertices.end() ? original : static_cast<Index>(found - original_vertices.begin());
}

void CanonicalMesh::name_path(std::vector<Index>& vertices) const
{
    for (Index& v : vertices) name_vertex(v);
}

void CanonicalMesh::name_loop(VertexLoop& loop) const
{
    name_path(loop);
    std::rotate(loop.begin(), std::ranges::min_element(loop), loop.end());
}

void CanonicalMesh::name_vertices(std::vector<Index>& vertices) const
{
    name_path(vertices);
    std::ranges::sort(vertices);
}

void CanonicalMesh::name_faces(std::vector<Index>& faces) const
{
    // Pieces of divided faces have numbers beyond the mesh, and the face's own number is there too.
    std::erase_if(faces, [&](Index f) { return f >= static_cast<Index>(triangles.rows()); });
    for (Index& f : faces) name_face(f);
    std::ranges::sort(faces);
}

void CanonicalMesh::name_elements(ElementKind kind, std::vector<Index>& elements) const
{
    if (kind == ElementKind::vertices) name_vertices(elements);
    if (kind == ElementKind::faces) name_faces(elements);
    if (kind != ElementKind::edges) return;
    std::vector<std::pair<Index, Index>> edges;
    for (std::size_t i = 0; i + 1 < elements.size(); i += 2) {
        Index a = elements[i], b = elements[i + 1];
        name_vertex(a);
        name_vertex(b);
        edges.emplace_back(std::minmax(a, b));
    }
    std::ranges::sort(edges);
    elements.clear();
    for (const auto& [a, b] : edges) elements.insert(elements.end(), {a, b});
}

void CanonicalMesh::name_report(MapReport& report) const
{
    name_faces(report.distortion.flipped);
    name_faces(report.distortion.below_resolution);
    for (Warning& warning : report.warnings) name_elements(elements_of(warning.kind), warning.elements);
}

CanonicalMesh canonical_mesh(const Vertices& vertices, const Triangles& triangles)
{
    if (!is_mesh(vertices, triangles)) return as_it_is(vertices, triangles);
    const auto vertex_count = static_cast<Index>(vertices.rows());
    std::vector<char> left_out(static_cast<std::size_t>(triangles.rows()));
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) left_out[f] = names_twice(triangles, f);
    leave_out_duplicates(triangles, vertex_count, left_out);
    const std::vector<Index> twin = twins_of(triangles, vertex_count, left_out);
    JoinedFaces faces{triangles, twin, vertex_count};
    number_patches(faces, left_out);
    Surface box;  // only its corners are read
    box.triangles = triangles;
    const Vertices positions = scaled_position(box, vertices);
    FaceWalk walk;
    if (faces.patches > 0) walk = walk_from(faces, first_halfedges(faces, positions));
    CanonicalMesh mesh;
    mesh.original_vertices = std::move(walk.vertices);
    std::vector<Index> rank(vertices.rows(), vertex_count);
    for (std::size_t v = 0; v < mesh.original_vertices.size(); ++v)
        rank[mesh.original_vertices[v]] = static_cast<Index>(v);
    for (const Index h : entries_of_others(triangles, faces.patch, rank)) {
        walk.entered.push_back(h);
        append_unmet({origin(triangles, h), target(triangles, h), origin(triangles, previous_halfedge(h))}, rank,
                     mesh.original_vertices);
    }
    mesh.triangles.resize(triangles.rows(), 3);
    for (std::size_t f = 0; f < walk.entered.size(); ++f) {
        Index h = walk.entered[f];
        mesh.original_faces.push_back(face_of(h));
        mesh.first_corners.push_back(static_cast<char>((3 - h % 3) % 3));
        for (Eigen::Index k = 0; k < 3; ++k, h = next_halfedge(h))
            mesh.triangles(static_cast<Eigen::Index>(f), k) = rank[origin(triangles, h)];
    }
    CanonicalPosition position =
        turned_position(mesh.triangles, Vertices(positions(mesh.original_vertices, Eigen::all)));
    std::vector<Index> all = numbers_below(vertices.rows());
    append_unmet(all, rank, mesh.original_vertices);
    mesh.vertices = Vertices::Zero(vertices.rows(), 3);
    mesh.vertices.topRows(position.vertices.rows()) = position.vertices;
    mesh.turn = position.turn;
    return mesh;
}

namespace {

/// The face with the least height over its longest edge.
std::size_t thinnest_face(const CanonicalMesh& mesh)
{
    std::size_t thinnest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const Eigen::RowVector3d a = mesh.vertices.row(mesh.triangles(f, 0));
        const Eigen::RowVector3d b = mesh.vertices.row(mesh.triangles(f, 1)) - a;
        const Eigen::RowVector3d c = mesh.vertices.row(mesh.triangles(f, 2)) - a;
        const double longest = std::max({b.squaredNorm(), c.squaredNorm(), (c - b).squaredNorm()});
        if (const double height = longest > 0.0 ? b.cross(c).norm() / longest : 0.0; height < least) {
            least = height;
            thinnest = static_cast<std::size_t>(f);
        }
    }
    return thinnest;
}

}  // namespace

void throw_named(const CanonicalMesh& mesh, const KoebeError& error)
{
    std::vector<Index> elements = error.elements();
    mesh.name_elements(error.elements_of(), elements);
    const ElementKind kind = error.elements_of();
    if (const auto* topology = dynamic_cast<const TopologyError*>(&error))
        throw TopologyError(topology->kind(), error.what(), std::move(elements));
    if (dynamic_cast<const InputError*>(&error)) throw InputError(error.what(), kind, std::move(elements));
    if (dynamic_cast<const OutOfMemory*>(&error)) throw OutOfMemory(error.what(), kind, std::move(elements));
    if (dynamic_cast<const SolverError*>(&error)) {
        // A matrix that cannot be factored, or a number that is not finite, comes from faces that are too thin.
        if (elements.empty() && mesh.triangles.rows() > 0)
            throw SolverError(std::string(error.what()) + " (the thinnest face listed)", ElementKind::faces,
                              {mesh.original_faces[thinnest_face(mesh)]});
        throw SolverError(error.what(), kind, std::move(elements));
    }
    if (dynamic_cast<const Cancelled*>(&error)) throw Cancelled();
    throw KoebeError(error.what(), kind, std::move(elements));
}

}  // namespace koebe
