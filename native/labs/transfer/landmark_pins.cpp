#include "transfer/landmark_pins.h"

#include "core/errors.h"
#include "core/sort_unique.h"
#include "mesh/loop_with.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr double same_place = 1e-12;  // lengths in the disk
constexpr double on_rim = 1e-6;       // lengths in the disk: distance of points from the circle

[[noreturn]] void refuse(const std::string& what, std::vector<Index> landmarks)
{
    sort_unique(landmarks);
    const std::string text = what + ": " + landmark_numbers(landmarks);
    throw InputError(text, ElementKind::landmarks, std::move(landmarks));
}

/// Whether a point lies on an edge of a loop, between two vertices.
bool lies_on_rim_edge(const SurfacePoint& point, const Triangles& triangles, const std::vector<LoopReport>& loops)
{
    int zero = 0;
    if (point.weights.minCoeff(&zero) > 0.0) return false;
    const Index a = triangles(point.face, (zero + 1) % 3), b = triangles(point.face, (zero + 2) % 3);
    const auto is_edge = [&](const VertexLoop& loop) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Index from = loop[i], to = loop[(i + 1) % loop.size()];
            if ((from == a && to == b) || (from == b && to == a)) return true;
        }
        return false;
    };
    return std::ranges::any_of(loops, [&](const LoopReport& loop) { return is_edge(loop.vertices); });
}

}  // namespace

std::string landmark_numbers(const std::vector<Index>& landmarks)
{
    constexpr std::size_t most = 5;
    std::string text = landmarks.size() == 1 ? "landmark" : "landmarks";
    for (std::size_t i = 0; i < std::min(landmarks.size(), most); ++i)
        text += (i > 0 ? ", " : " ") + std::to_string(landmarks[i]);
    return text + (landmarks.size() > most ? ", ..." : "");
}

std::vector<Pin> landmark_pins(const CutMesh& mesh, const Triangles& triangles, const std::vector<LoopReport>& loops,
                               const std::vector<Circle>& circles, const PlanarPoints& start, const VectorXcd& places)
{
    const Index count = static_cast<Index>(start.rows() - static_cast<Eigen::Index>(mesh.added.size()));
    std::vector<Pin> pins;
    std::vector<Index> on_edges, apart, off_rims;
    for (std::size_t i = 0; i < mesh.vertex.size(); ++i) {
        const Index number = static_cast<Index>(i), v = mesh.vertex[i];
        if (v >= count && lies_on_rim_edge(mesh.added[v - count], triangles, loops)) on_edges.push_back(number);
        // A landmark of loop k lies on circle k, and on no other circle.
        const int k = v < count ? loop_with(loops, v, &LoopReport::vertices) : -1;
        Complex place = places[number];
        bool fits = k < 0 || !std::ranges::binary_search(loops[k].off_circle, v);
        for (std::size_t other = 0; other < circles.size(); ++other) {
            const Complex arm = place - circles[other].center;
            const bool on_it = std::abs(std::abs(arm) - circles[other].radius) < on_rim;
            fits = fits && on_it == (static_cast<int>(other) == k);
        }
        if (!fits) off_rims.push_back(number);
        if (k >= 0) place = circles[k].center + std::polar(circles[k].radius, std::arg(place - circles[k].center));
        // Landmarks at one point must have one place, and the reverse.
        bool known = false;
        for (const Pin& pin : pins) {
            const bool same_point = pin.vertex == v;
            if (same_point != (std::abs(pin.end - place) < same_place))
                apart.insert(apart.end(), {pin.landmark, number});
            known = known || same_point;
        }
        if (!known) pins.push_back({v, number, k, Complex(start(v, 0), start(v, 1)), place});
    }
    if (!on_edges.empty()) refuse("on a rim landmarks must be vertices", std::move(on_edges));
    if (!off_rims.empty())
        refuse("landmarks lie on a rim of one surface, and beside the rim on the other", std::move(off_rims));
    if (!apart.empty())
        refuse("two landmarks lie at one point of a surface, and at two points of the other", std::move(apart));
    return pins;
}

}  // namespace koebe
