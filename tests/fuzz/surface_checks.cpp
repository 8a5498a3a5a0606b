#include "array_checks.h"
#include "promise_check.h"
#include "surface_facts.h"

#include "canonical/canonical_form.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "ears/ears.h"
#include "holes/fair_filling.h"
#include "holes/fan_filling.h"
#include "mesh/halfedge_mesh.h"
#include "mesh/topology.h"
#include "surface/intrinsic_metric.h"

#include <algorithm>
#include <cmath>

namespace koebe::fuzz {
namespace {

Surface checked_surface(const Program& program)
{
    const Vertices vertices = program.soup.vertices();
    const Triangles triangles = program.soup.triangles();
    validate_arrays(vertices, triangles);
    return require_bordered_genus_zero(triangles, static_cast<Index>(vertices.rows()));
}

bool is_permutation(std::vector<Index> numbers, std::size_t count)
{
    std::ranges::sort(numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] != static_cast<Index>(i)) return false;
    return numbers.size() == count;
}

std::vector<Edge> rim_of(const std::vector<VertexLoop>& loops)
{
    std::vector<Edge> edges;
    for (const VertexLoop& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            edges.push_back(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
    std::ranges::sort(edges);
    return edges;
}

void check_topology(const Program& program)
{
    const std::optional<SurfaceFacts> facts = surface_facts(program.soup);
    bool taken = false;
    try {
        const Surface surface = checked_surface(program);
        taken = true;
        require(facts.has_value(), "what is no surface of genus 0 with boundary is refused");
        require(surface.loops.size() == facts->loop_count, "every boundary loop is found");
        require(rim_of(surface.loops) == facts->boundary, "the loops are the boundary");
    } catch (const KoebeError&) {
        require(taken || !facts, "a surface of genus 0 with boundary is taken");
    }
}

void check_canonical_form(const Program& program)
{
    const Surface surface = checked_surface(program);
    const CanonicalForm form = canonical_form(surface, program.soup.vertices());
    const std::size_t used = program.soup.points.size() - surface.unused.size();
    require(form.original_vertices.size() == used && form.vertices.rows() == static_cast<Eigen::Index>(used),
            "every used vertex has its place");
    require(is_permutation(form.original_faces, program.soup.faces.size()), "every face has its place");
    require(form.vertices.allFinite() && form.vertices.rowwise().norm().maxCoeff() <= 1.0 + 1e-9,
            "the form lies within the unit ball");
    for (Index h = 0; h < static_cast<Index>(form.surface.twin.size()); ++h) {
        const Index twin = form.surface.twin[h];
        require(twin == no_twin || form.surface.twin[twin] == h, "twins are each other's");
    }
    std::vector<VertexLoop> loops = form.surface.loops;
    for (VertexLoop& loop : loops)
        for (Index& v : loop) v = form.original_vertices[v];
    require(rim_of(loops) == rim_of(surface.loops), "the form has the same boundary");
}

void check_ears(const Program& program)
{
    const Surface surface = checked_surface(program);
    const EarCut cut = cut_ears(program.soup.vertices(), surface, surface.loops);
    if (cut.ears.empty()) return;
    std::vector<Index> faces;
    for (const Ear& ear : cut.ears) faces.insert(faces.end(), ear.faces.begin(), ear.faces.end());
    const std::size_t cut_off = faces.size();
    std::ranges::sort(faces);
    require(std::ranges::adjacent_find(faces) == faces.end(), "a face belongs to one ear");
    require(cut_off + static_cast<std::size_t>(cut.core.triangles.rows()) == program.soup.faces.size(),
            "ears and core are the whole");
    require(cut.loops.size() == surface.loops.size(), "the core has every loop");
    for (const VertexLoop& loop : cut.loops) require(loop.size() >= 3, "a loop keeps three vertices");
}

void check_filling(const Program& program, bool fair)
{
    const Vertices vertices = program.soup.vertices();
    const Triangles triangles = program.soup.triangles();
    const FilledSurface filled = fair ? fill_and_fair_holes(vertices, triangles) : fill_holes(vertices, triangles);
    require(filled.vertices.allFinite(), "fillings are finite");
    require(filled.vertices.topRows(vertices.rows()) == vertices, "the input's vertices stay");
    require(filled.label.size() == static_cast<std::size_t>(filled.triangles.rows()), "every face has a label");
    for (const Index twin : pair_halfedges(filled.triangles, static_cast<Index>(filled.vertices.rows())))
        require(twin != no_twin, "a filled surface is closed");
    if (!fair) return;
    const FilledSurface again = fill_and_fair_holes(vertices, triangles);
    require(again.vertices == filled.vertices && again.triangles == filled.triangles, "a patch is the same each time");
}

void check_fans(const Program& program) { check_filling(program, false); }

void check_fairing(const Program& program)
{
    if (program.soup.faces.size() <= 60) check_filling(program, true);
}

void check_metric(const Program& program)
{
    const Surface surface = checked_surface(program);
    const CanonicalForm form = canonical_form(surface, program.soup.vertices());
    const IntrinsicMetric metric = intrinsic_metric(form.vertices, form.surface);
    require(metric.triangles.rows() == form.surface.triangles.rows(), "flips keep the number of faces");
    for (Eigen::Index f = 0; f < metric.lengths.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const double a = metric.lengths(f, k), b = metric.lengths(f, (k + 1) % 3),
                         c = metric.lengths(f, (k + 2) % 3);
            require(std::isfinite(a) && a > 0.0, "lengths are positive");
            require(b + c >= a * (1.0 - 1e-12), "the triangle inequality holds");
        }
    for (Index h = 0; h < static_cast<Index>(metric.twin.size()); ++h)
        require(metric.twin[h] == no_twin || metric.lengths.data()[h] == metric.lengths.data()[metric.twin[h]],
                "both sides of an edge are as long");
}

void check_halfedges(const Program& program)
{
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    const Vertices vertices = program.soup.vertices();
    const Surface surface = analyze_surface(program.soup.triangles(), static_cast<Index>(vertices.rows()));
    const MeshArrays back = to_arrays(to_halfedge_mesh(vertices, surface));
    require(back.vertices.rows() == vertices.rows() &&
                std::equal(vertices.data(), vertices.data() + vertices.size(), back.vertices.data(), same),
            "vertices come back");
    require(back.triangles == surface.triangles, "faces come back");
}

constexpr ArrayCheck checks[] = {check_topology, check_canonical_form, check_ears,     check_fans,
                                 check_fairing,  check_metric,         check_halfedges};

}  // namespace

std::span<const ArrayCheck> surface_checks() { return checks; }

}  // namespace koebe::fuzz
