#include "splitting/mirror_symmetry.h"

#include "core/connectivity.h"
#include "core/grouping.h"
#include "cost/costs.h"
#include "execution/profile.h"
#include "mesh/connected_pieces.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <map>
#include <set>

namespace koebe {
namespace {

double border_of(const CutSurface& whole, const std::vector<PartPointer>& parts)
{
    std::vector<Index> label(static_cast<std::size_t>(whole.areas.size()), -1);
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const Index f : parts[k]->mesh.faces) label[f] = static_cast<Index>(k);
    double length = 0.0;
    for (Index h = 0; h < static_cast<Index>(whole.surface.twin.size()); ++h) {
        const Index t = whole.surface.twin[h];
        if (t > h && label[face_of(t)] != label[face_of(h)]) length += whole.lengths[h];
    }
    return length;
}

double cost_of(const CutSurface& whole, const SplitOptions& options, const std::vector<PartPointer>& parts)
{
    double cost = options.of(static_cast<double>(parts.size()), border_of(whole, parts));
    for (const PartPointer& part : parts) cost += part->map.overflow;
    return cost;
}

/// Sets of faces: the parts of one side, and their images.
std::vector<std::vector<Index>> mirrored_faces(const CutSurface& whole, const Mirror& mirror,
                                               const std::vector<PartPointer>& parts, double chosen)
{
    std::vector<Index> label(mirror.image.size());
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const Index f : parts[k]->mesh.faces) label[mirror.group[f]] = static_cast<Index>(k);
    const auto on_chosen_side = [&](Index g) { return mirror.image[g] == g || chosen * mirror.side[g] > 0.0; };
    // Faces are joined over an edge if their polygons are in one part on the chosen side, or the images are. A polygon
    // and its own image over the plane are joined if they were in one part, others as the image is.
    const auto joined = [&](Index a, Index b) {
        if (on_chosen_side(a) && on_chosen_side(b)) return label[a] == label[b];
        if (!on_chosen_side(a) && !on_chosen_side(b)) return label[mirror.image[a]] == label[mirror.image[b]];
        const bool is_first_chosen = on_chosen_side(a);
        const Index here = is_first_chosen ? a : b, there = is_first_chosen ? b : a, image = mirror.image[there];
        const bool is_own_image = image == here;
        return label[here] == label[is_own_image ? there : image];
    };
    Index count = 0;
    const std::vector<Index>& twin = whole.surface.twin;
    const std::vector<Index> piece = joined_pieces(
        twin, count, [&](Index h) { return joined(mirror.group[face_of(h)], mirror.group[face_of(twin[h])]); });
    return places_of_numbers(piece, count);
}

}  // namespace

bool is_worth_symmetry(const CutSurface& whole, const SplitOptions& options, const std::vector<PartPointer>& symmetric,
                       const std::vector<PartPointer>& others)
{
    return cost_of(whole, options, symmetric) < most_cost_of_symmetric(cost_of(whole, options, others));
}

std::vector<std::vector<Index>> faces_of_sides(const CutSurface& whole, const Mirror& mirror)
{
    std::vector<int> side;
    for (const Index group : mirror.group) side.push_back(mirror.side[group] > 0.0);
    Index count = 0;
    const std::vector<Index> piece = connected_pieces(whole.surface.twin, side, count);
    return places_of_numbers(piece, count);
}

bool make_symmetric(const CutSurface& whole, const SplitOptions& options, const Mirror& mirror,
                    std::vector<PartPointer>& parts, ExecutionContext& context, SplitEffort& effort)
{
    const ProfiledStage profiled("symmetry");
    if (mirror.image.empty()) return false;
    if (parts.size() < 2) return true;
    // Parts that stay need no new map.
    std::map<std::vector<Index>, PartPointer> known;
    for (const PartPointer& part : parts) known.emplace(part->mesh.faces, part);
    double best = most_cost_of_symmetric(cost_of(whole, options, parts));
    std::vector<PartPointer> chosen;
    // The parts of one side and their images, for both sides: the cheaper ones, if they cost little enough.
    for (const double side : {1.0, -1.0}) {
        std::vector<PartPointer> mirrored;
        std::vector<std::vector<Index>> sets = mirrored_faces(whole, mirror, parts, side);
        if (sets.size() == 1 && whole.surface.loops.empty()) continue;  // closed
        for (std::vector<Index>& faces : sets) {
            PartPointer& part = known[faces];
            if (!part) {
                part = std::make_shared<Part>(Part{part_mesh(whole, std::move(faces)), {}, {}});
                map_anew(whole, *part, context, effort);
            }
            mirrored.push_back(part);
        }
        const double cost = cost_of(whole, options, mirrored);
        if (cost >= best) continue;
        best = cost;
        chosen = std::move(mirrored);
    }
    if (chosen.empty()) return false;
    parts = std::move(chosen);
    return true;
}

std::vector<char> mirrored_slits(const CutSurface& whole, const Mirror& mirror, const std::vector<char>& opened)
{
    std::vector<char> slit(whole.surface.twin.size(), 0);
    if (mirror.image.empty()) return slit;
    std::set<std::pair<Index, Index>> images;
    const auto groups = [&](Index h) {
        return std::pair{mirror.group[face_of(h)], mirror.group[face_of(whole.surface.twin[h])]};
    };
    for (Index h = 0; h < static_cast<Index>(slit.size()); ++h) {
        if (whole.surface.twin[h] == no_twin) continue;
        const auto sides = groups(h);
        slit[h] = sides.first != sides.second && mirror.image[sides.first] == sides.second;
        if (opened[h]) images.emplace(mirror.image[sides.first], mirror.image[sides.second]);
    }
    for (Index h = 0; h < static_cast<Index>(slit.size()); ++h)
        if (whole.surface.twin[h] != no_twin && images.contains(groups(h))) slit[h] = 1;
    return slit;
}

}  // namespace koebe
