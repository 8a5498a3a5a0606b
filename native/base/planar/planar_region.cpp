#include "planar/planar_region.h"

#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace koebe::detail {
std::vector<std::size_t> to_and_fro(const std::vector<Complex>& points)
{
    const double rows = std::max(1.0, std::floor(std::sqrt(0.5 * static_cast<double>(points.size()))));
    Complex low(0.0, 0.0), high(0.0, 0.0);
    for (const Complex z : points) {
        low = {std::min(low.real(), z.real()), std::min(low.imag(), z.imag())};
        high = {std::max(high.real(), z.real()), std::max(high.imag(), z.imag())};
    }
    const double height = std::max(high.imag() - low.imag(), std::numeric_limits<double>::min());
    std::vector<std::tuple<double, double, std::size_t>> keys;
    keys.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double row = std::floor(rows * ((points[i].imag() - low.imag()) / height));
        keys.emplace_back(row, std::fmod(row, 2.0) == 0.0 ? points[i].real() : -points[i].real(), i);
    }
    std::ranges::sort(keys);
    std::vector<std::size_t> order;
    order.reserve(points.size());
    for (const auto& key : keys) order.push_back(std::get<2>(key));
    return order;
}

PlanarRegion::PlanarRegion(const std::vector<VectorXcd>& polygons, const std::vector<Complex>& interior)
{
    std::vector<Cdt::Vertex_handle> handles;
    Cdt::Face_handle near;
    const auto insert = [&](Complex z, Index number) {
        const auto count = cdt_.number_of_vertices();
        const Cdt::Vertex_handle vertex = cdt_.insert(to_point(z), near);
        near = vertex->face();
        if (cdt_.number_of_vertices() == count) return Cdt::Vertex_handle();  // another point is at that place
        vertex->info() = number;
        return vertex;
    };
    for (const VectorXcd& polygon : polygons)
        for (const Complex z : polygon) handles.push_back(insert(z, static_cast<Index>(handles.size())));
    const std::size_t boundary_count = handles.size();
    for (const std::size_t i : to_and_fro(interior)) insert(interior[i], static_cast<Index>(boundary_count + i));

    std::vector<Index> lost;
    for (std::size_t i = 0; i < boundary_count; ++i)
        if (handles[i] == Cdt::Vertex_handle()) lost.push_back(static_cast<Index>(i));
    if (!lost.empty()) throw InputError("points of a polygon coincide (points listed)", ElementKind::points, lost);
    constrain(polygons, handles);
    mark_inside();
}

void PlanarRegion::constrain(const std::vector<VectorXcd>& polygons, const std::vector<Cdt::Vertex_handle>& handles)
{
    Index begin = 0;
    for (const VectorXcd& polygon : polygons) {
        const Index n = static_cast<Index>(polygon.size());
        for (Index i = 0; i < n; ++i) {
            const Index from = begin + i, to = begin + (i + 1) % n;
            try {
                cdt_.insert_constraint(handles[from], handles[to]);
            } catch (const Cdt::Intersection_of_constraints_exception&) {
                throw InputError("polygons cross (end points of the edge listed)", ElementKind::points, {from, to});
            }
            Cdt::Face_handle face;
            int opposite = 0;
            if (!cdt_.is_edge(handles[from], handles[to], face, opposite))
                throw InputError("a polygon's point lies on an edge (end points of the edge listed)",
                                 ElementKind::points, {from, to});
        }
        begin += n;
    }
}

void PlanarRegion::mark_inside()
{
    constexpr char unknown = -1;
    for (auto f = cdt_.all_faces_begin(); f != cdt_.all_faces_end(); ++f) f->info().state = unknown;
    std::vector<Cdt::Face_handle> front{cdt_.infinite_face()}, beyond;
    // From infinity inwards: each rim that is crossed changes between outside and inside.
    for (char side = 0; !front.empty(); side ^= 1) {
        beyond.clear();
        for (const Cdt::Face_handle face : front)
            if (face->info().state == unknown) face->info().state = side;
        while (!front.empty()) {
            const Cdt::Face_handle face = front.back();
            front.pop_back();
            if (face->info().state != side) continue;
            for (int i = 0; i < 3; ++i) {
                const Cdt::Face_handle neighbor = face->neighbor(i);
                if (neighbor->info().state != unknown) continue;
                if (face->is_constrained(i)) {
                    beyond.push_back(neighbor);
                } else {
                    neighbor->info().state = side;
                    front.push_back(neighbor);
                }
            }
        }
        front.swap(beyond);
    }
}

}  // namespace koebe::detail
