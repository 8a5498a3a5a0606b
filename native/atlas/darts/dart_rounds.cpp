#include "darts/dart_rounds.h"

#include "core/connectivity.h"
#include "cost/tuning.h"
#include "darts/darts.h"
#include "darts/tension.h"
#include "even/even_forces.h"
#include "execution/profile.h"
#include "execution/side_by_side.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr int most_dart_rounds = 8;
constexpr EvenEffort trial_effort{2, 1};
constexpr EvenEffort warm_effort{1, 1};             // after some of the darts were closed again
constexpr EvenEffort strained_effort{8, 4, 30, 8};  // a crammed toe unfolds to a hundred times its area
constexpr double longest_fine = 0.12;               // of darts in strained faces: longer ones were tried on a proxy

constexpr int roundings = 16;            // with the grid in other places
constexpr double coarse_grid = 1 << 21;  // steps along the unit square: an eighth of those of 32-bit floats

/// The place of an edge that is no seam: a part and its half-edge.
struct EdgePlace {
    std::size_t part;
    Index halfedge;
};

class DartRounds {
public:
    DartRounds(std::vector<HeldPart>& parts, DartTips tips, double even, double price, int threads,
               ExecutionContext& context)
        : parts_(parts),
          tips_(tips),
          refused_(parts.size()),
          energy_(parts.size()),
          even_(even),
          price_(price),
          threads_(threads),
          context_(context)
    {
        for (const HeldPart& part : parts) is_mirrored_ = is_mirrored_ || !part.flat.image.empty();
    }

    /// @return whether any darts were tried
    bool round()
    {
        trials_.assign(parts_.size(), {});
        for_each_part([&](std::size_t k, ExecutionContext&) {
            refused_[k].resize(static_cast<std::size_t>(parts_[k].flat.points.rows()), 0);
            EvenForces forces = forces_of(parts_[k].flat);
            trials_[k].darts = promising_darts(parts_[k].flat, forces, even_, price_, barred_tips(k, forces));
            energy_[k] = std::move(forces.energy);
        });
        leave_unnoticed_out();
        if (is_mirrored_) {
            const std::vector<Trial> unpaired = trials_;
            pair_images();
            free_strained(unpaired);
        }
        if (std::ranges::all_of(trials_, [](const Trial& trial) { return trial.darts.empty(); })) return false;
        for_each_part([&](std::size_t k, ExecutionContext& own) { open(k, own); });
        const std::vector<std::vector<char>> pays = paying();
        for_each_part([&](std::size_t k, ExecutionContext& own) { keep(k, pays[k], own); });
        return true;
    }

private:
    struct Trial {
        std::vector<Dart> darts;
        std::vector<std::pair<std::size_t, std::size_t>>
            image;                       ///< part and place of each dart's image; empty: no mirror
        std::optional<HeldPart> opened;  ///< empty if the darts cannot be opened
        std::vector<Index> source;       ///< (V) the vertex that each vertex of `opened` was
        std::vector<double> gain;
    };

    /// What darts gain must be noticed in their part; in strained faces, which cost more work, in the whole.
    void leave_unnoticed_out()
    {
        double whole = 0.0;
        for (const VectorXd& energy : energy_) whole += energy.sum();
        for (std::size_t k = 0; k < trials_.size(); ++k) {
            std::vector<Dart>& darts = trials_[k].darts;
            if (tips_ == DartTips::strained)
                std::erase_if(darts, [](const Dart& dart) { return dart.length > longest_fine; });
            double surplus = 0.0;
            for (const Dart& dart : darts) surplus += dart.gain - dart.cost;
            if (surplus < tuning::noticeable * (tips_ == DartTips::strained ? whole : energy_[k].sum())) darts.clear();
        }
    }

    template <typename Visit>
    void for_each_part(Visit visit)
    {
        side_by_side(parts_.size(), threads_, context_, visit);
    }

    /// (V) 1 where no dart may end.
    std::vector<char> barred_tips(std::size_t k, const EvenForces& forces) const
    {
        if (tips_ == DartTips::anywhere) return refused_[k];
        const FlatPart& flat = parts_[k].flat;
        const Triangles& triangles = flat.surface.triangles;
        const std::vector<int> is_strained = strained_faces(forces.energy, face_areas(flat.vertices, triangles));
        std::vector<char> barred(refused_[k].size(), 1);
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            if (is_strained[f] != 0)
                for (const Index v : triangles.row(f)) barred[v] = refused_[k][v];
        return barred;
    }

    EvenForces forces_of(const FlatPart& flat) const { return forces_in(flat, even_); }

    /// @param before the same part, relaxed with more darts, if there is one
    void open(std::size_t k, ExecutionContext& context, const Trial* before = nullptr)
    {
        Trial& trial = trials_[k];
        if (trial.darts.empty()) return;
        // Cut the part along the trial's darts. Each face belongs to the nearest of them.
        HeldPart part = parts_[k];
        std::vector<std::vector<Index>> cuts;
        for (const Dart& dart : trial.darts) cuts.push_back(dart.vertices);
        const std::vector<int> nearest = nearest_cut(part.flat, cuts, tuning::cut_reach);
        const auto source = open_darts(part.flat, trial.darts);
        if (!source) return;
        FlatPart& flat = part.flat;
        hold_both_ends(part.round, *source, parts_[k].flat.points.rows());
        // Relax, from the points of the trial with more darts where they still lie one to one.
        bool is_warm = false;
        if (before && part.round.empty()) {
            const PlanarPoints points = with_fewer_darts(*before, *source, parts_[k].flat.points.rows());
            is_warm = lies_one_to_one(flat, points);
            if (is_warm) flat.points = points;
        }
        const EvenEffort& effort = tips_ == DartTips::strained ? strained_effort : is_warm ? warm_effort : trial_effort;
        if (!make_even(flat_surface(flat, part.round), even_, packed_side, context, effort).moved) return;
        if (!survives_storing(flat)) return;
        // A dart's gain: the energy that its faces lost.
        const VectorXd released = energy_[k] - forces_of(flat).energy;
        trial.gain.assign(trial.darts.size(), 0.0);
        for (std::size_t f = 0; f < nearest.size(); ++f)
            if (nearest[f] >= 0) trial.gain[nearest[f]] += released[static_cast<Eigen::Index>(f)];
        trial.opened = std::move(part);
        trial.source = *source;
    }

    /// The points of a relaxed part after some of its darts were closed: both sides of these meet in the middle.
    /// @param source (V) of the part with fewer darts, as in Trial @param count of vertices without darts
    static PlanarPoints with_fewer_darts(const Trial& before, const std::vector<Index>& source, Eigen::Index count)
    {
        const PlanarPoints& points = before.opened->flat.points;
        std::vector<Index> second(static_cast<std::size_t>(count), -1);
        for (std::size_t v = second.size(); v < before.source.size(); ++v)
            second[before.source[v]] = static_cast<Index>(v);
        PlanarPoints found(static_cast<Eigen::Index>(source.size()), 2);
        found.topRows(count) = points.topRows(count);
        std::vector<char> is_open(second.size(), 0);
        for (std::size_t v = second.size(); v < source.size(); ++v) {
            is_open[source[v]] = 1;
            found.row(static_cast<Eigen::Index>(v)) = points.row(second[source[v]]);
        }
        for (std::size_t v = 0; v < second.size(); ++v)
            if (second[v] >= 0 && !is_open[v])
                found.row(static_cast<Eigen::Index>(v)) =
                    0.5 * (points.row(static_cast<Eigen::Index>(v)) + points.row(second[v]));
        return found;
    }

    /// Both ends of a dart that begins at a round loop stay on the loop's circle or line.
    /// @param source (V) the vertex that each vertex was before darts were opened @param count of vertices then
    static void hold_both_ends(std::vector<RoundLoop>& round, const std::vector<Index>& source, Eigen::Index count)
    {
        std::map<Index, Index> second;
        for (auto v = static_cast<Index>(count); v < static_cast<Index>(source.size()); ++v)
            second.emplace(source[v], v);
        for (RoundLoop& loop : round)
            for (std::size_t i = 0, held = loop.vertices.size(); i < held; ++i)
                if (const auto found = second.find(loop.vertices[i]); found != second.end())
                    loop.vertices.push_back(found->second);
    }

    /// (parts, darts) 1 for darts that pay together with their images.
    std::vector<std::vector<char>> paying() const
    {
        const auto surplus = [&](std::size_t k, std::size_t i) {
            return trials_[k].gain.empty() ? -trials_[k].darts[i].cost : trials_[k].gain[i] - trials_[k].darts[i].cost;
        };
        std::vector<std::vector<char>> pays(trials_.size());
        for (std::size_t k = 0; k < trials_.size(); ++k)
            for (std::size_t i = 0; i < trials_[k].darts.size(); ++i) {
                bool opens = trials_[k].opened.has_value();
                double sum = surplus(k, i);
                if (!trials_[k].image.empty()) {
                    const auto [other, place] = trials_[k].image[i];
                    opens = opens && trials_[other].opened.has_value();
                    sum = sum + surplus(other, place);
                }
                pays[k].push_back(opens && sum > 0.0);
            }
        return pays;
    }

    void keep(std::size_t k, const std::vector<char>& pays, ExecutionContext& context)
    {
        Trial& trial = trials_[k];
        std::vector<Dart> kept;
        for (std::size_t i = 0; i < pays.size(); ++i) {
            if (pays[i])
                kept.push_back(trial.darts[i]);
            else
                refuse(k, trial.darts[i].vertices.front());
        }
        if (kept.empty()) return;
        if (kept.size() < trial.darts.size()) {
            const Trial before = std::exchange(trial, {std::move(kept), {}, {}, {}, {}});
            open(k, context, before.opened ? &before : nullptr);
        }
        if (trial.opened) parts_[k] = std::move(*trial.opened);
    }

    /// No dart begins again within half the spacing of a tip that did not pay.
    void refuse(std::size_t k, Index tip)
    {
        const Vertices& vertices = parts_[k].flat.vertices;
        for (std::size_t v = 0; v < refused_[k].size(); ++v)
            if ((vertices.row(static_cast<Eigen::Index>(v)) - vertices.row(tip)).norm() < 0.5 * tuning::dart_spacing)
                refused_[k][v] = 1;
    }

    /// Keeps only promising darts that have an image, in this part or another, and adds the images. Of two darts in
    /// each other's way the dart of the earlier part, or with more promise, stays.
    void pair_images()
    {
        // The edges of all parts by their names in the whole.
        std::map<EdgeEnds, EdgePlace> places;
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const FlatPart& flat = parts_[k].flat;
            if (flat.image.empty()) continue;
            for (Index h = 0; h < static_cast<Index>(flat.surface.triangles.size()); ++h)
                if (flat.surface.twin[h] > h)
                    places.emplace(sorted_ends(flat.original[origin(flat.surface.triangles, h)],
                                               flat.original[target(flat.surface.triangles, h)]),
                                   EdgePlace{k, h});
        }
        // Darts that are kept take their vertices.
        std::vector<Trial> paired(trials_.size());
        std::vector<std::vector<char>> taken, outside;
        for (const HeldPart& part : parts_) {
            taken.emplace_back(static_cast<std::size_t>(part.flat.points.rows()), 0);
            outside.push_back(boundary_mask(part.flat.surface));
        }
        const auto is_free = [&](std::size_t k, const Dart& dart) {
            return std::ranges::none_of(dart.vertices, [&](Index v) { return taken[k][v] != 0; });
        };
        const auto add = [&](std::size_t k, const Dart& dart) {
            for (const Index v : dart.vertices) taken[k][v] = 1;
            paired[k].darts.push_back(dart);
            return paired[k].darts.size() - 1;
        };
        for (std::size_t k = 0; k < trials_.size(); ++k)
            for (const Dart& dart : trials_[k].darts) {
                // A part without a mirror keeps its darts.
                if (parts_[k].flat.image.empty()) {
                    add(k, dart);
                    continue;
                }
                // Others need an image that runs from inside to a rim, too.
                if (!is_free(k, dart)) continue;
                const auto found = image_of(k, dart, places);
                if (!found) continue;
                const auto& [other, image] = *found;
                if (!is_dart_of(outside[other], image)) continue;
                // A dart in the plane is its own image.
                if (other == k && image.vertices == dart.vertices) {
                    const std::size_t i = add(k, dart);
                    paired[k].image.emplace_back(k, i);
                    continue;
                }
                // Else both are kept, unless they touch, or the image is in the way of another dart.
                const bool touch = other == k && std::ranges::any_of(image.vertices, [&](Index v) {
                                       return std::ranges::count(dart.vertices, v) > 0;
                                   });
                if (touch || !is_free(other, image)) continue;
                const std::size_t i = add(k, dart), j = add(other, image);
                paired[k].image.resize(paired[k].darts.size());
                paired[other].image.resize(paired[other].darts.size());
                paired[k].image[i] = {other, j};
                paired[other].image[j] = {k, i};
            }
        trials_ = std::move(paired);
    }

    /// Takes the mirror from parts that no dart would help otherwise: none has an image, as where rims differ.
    void free_strained(const std::vector<Trial>& unpaired)
    {
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const FlatPart& flat = parts_[k].flat;
            const double area = face_areas(flat.vertices, flat.surface.triangles).sum();
            if (unpaired[k].darts.empty() || !trials_[k].darts.empty() || flat.image.empty() ||
                !(energy_[k].sum() > tuning::stuck * area))
                continue;
            trials_[k] = unpaired[k];
            const std::set<Index> own(flat.original.begin(), flat.original.end());
            for (HeldPart& other : parts_)
                if (std::ranges::any_of(other.flat.image, [&](Index v) { return own.contains(v); }))
                    other.flat.image.clear();
        }
    }

    std::optional<std::pair<std::size_t, Dart>> image_of(std::size_t k, const Dart& dart,
                                                         const std::map<EdgeEnds, EdgePlace>& places) const
    {
        const FlatPart& flat = parts_[k].flat;
        std::size_t other = parts_.size();
        Dart image = dart;
        image.halfedges.clear();
        image.vertices.clear();
        const auto number = [&](Index v) { return flat.image[v]; };
        for (std::size_t i = 0; i + 1 < dart.vertices.size(); ++i) {
            const Index a = number(dart.vertices[i]), b = number(dart.vertices[i + 1]);
            const auto found = places.find(sorted_ends(a, b));
            if (found == places.end() || (i > 0 && found->second.part != other)) return {};
            other = found->second.part;
            const FlatPart& there = parts_[other].flat;
            const Index h = found->second.halfedge;
            const Index from = origin(there.surface.triangles, h), to = target(there.surface.triangles, h);
            const bool along = there.original[from] == a;
            if (i == 0) image.vertices.push_back(along ? from : to);
            if (image.vertices.back() != (along ? from : to)) return {};  // beside another side of a cut
            image.vertices.push_back(along ? to : from);
            image.halfedges.push_back(h);
        }
        return std::make_pair(other, std::move(image));
    }

    /// From inside to a rim.
    /// @param outside (V) 1 on the boundary
    static bool is_dart_of(const std::vector<char>& outside, const Dart& dart)
    {
        for (std::size_t i = 0; i < dart.vertices.size(); ++i) {
            if ((outside[dart.vertices[i]] != 0) != (i + 1 == dart.vertices.size())) return false;
        }
        return true;
    }

    std::vector<HeldPart>& parts_;
    DartTips tips_;
    std::vector<std::vector<char>> refused_;
    std::vector<VectorXd> energy_;  // (parts) energies of the faces, before this round
    std::vector<Trial> trials_;
    double even_, price_;
    int threads_;
    ExecutionContext& context_;
    bool is_mirrored_ = false;
};

}  // namespace

FlatSurface flat_surface(FlatPart& flat, std::vector<RoundLoop>& round)
{
    FlatSurface surface{flat.vertices, flat.surface.triangles, flat.surface.loops, flat.points, round};
    surface.weights = weights_of_faces(flat);
    surface.sizes = Eigen::Map<const VectorXd>(flat.sizes.data(), static_cast<Eigen::Index>(flat.sizes.size()));
    return surface;
}

bool survives_storing(const FlatPart& flat)
{
    const PlanarPoints uv = (flat.points.rowwise() - flat.points.colwise().minCoeff()) / packed_side;
    // Where a vertex all but touches an edge, each rounding tells by chance.
    for (int i = 0; i < roundings; ++i) {
        const Eigen::RowVector2d shift(std::fmod(0.618 * i, 1.0), std::fmod(0.755 * i, 1.0));
        if (!loops_apart(flat, (((uv * coarse_grid).rowwise() + shift).array().round() / coarse_grid).matrix()))
            return false;
    }
    return true;
}

void cut_darts(std::vector<HeldPart>& parts, DartTips tips, double even, double price, int threads,
               ExecutionContext& context)
{
    const ProfiledStage profiled("darts");
    DartRounds rounds(parts, tips, even, price, threads, context);
    for (int i = 0; i < most_dart_rounds; ++i)
        if (!rounds.round()) return;
}

}  // namespace koebe
