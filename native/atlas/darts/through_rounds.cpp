#include "darts/through_rounds.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "darts/darts.h"
#include "darts/roomy_cuts.h"
#include "darts/tension.h"
#include "execution/profile.h"
#include "execution/side_by_side.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr EvenEffort through_effort{6, 2};
constexpr int most_failures = 2;          // rounds in which no cut of a piece pays
constexpr std::size_t fewest_faces = 10;  // of a piece that is cut off for room, unless it is true to size

/// A cut as vertices of the whole: cuts of other parts have numbers of their own.
struct NamedCut {
    std::vector<Index> vertices;
    double cost = 0.0;
};

/// The cut along these vertices of the whole, if it runs through this part.
std::optional<ThroughCut> cut_in(const FlatPart& flat, const NamedCut& named)
{
    // The cut's edges by their vertices in the whole.
    std::map<EdgeEnds, std::size_t> wanted;
    for (std::size_t i = 0; i + 1 < named.vertices.size(); ++i)
        wanted.emplace(sorted_ends(named.vertices[i], named.vertices[i + 1]), i);
    const Triangles& triangles = flat.surface.triangles;
    ThroughCut cut{std::vector<Index>(named.vertices.size(), -1), std::vector<Index>(wanted.size(), no_twin)};
    if (wanted.size() + 1 != named.vertices.size()) return {};
    // Find them in the part. A vertex that the part has twice excludes the cut.
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        if (flat.surface.twin[h] < h) continue;
        const Index a = origin(triangles, h), b = target(triangles, h);
        const auto found = wanted.find(sorted_ends(flat.original[a], flat.original[b]));
        if (found == wanted.end()) continue;
        const std::size_t i = found->second;
        const bool along = flat.original[a] == named.vertices[i];
        cut.halfedges[i] = h;
        for (const auto& [place, v] : {std::pair(i, along ? a : b), std::pair(i + 1, along ? b : a)}) {
            if (cut.vertices[place] >= 0 && cut.vertices[place] != v) return {};
            cut.vertices[place] = v;
        }
    }
    if (std::ranges::count(cut.halfedges, no_twin) > 0) return {};
    // It begins and ends on the border, and stays inside between.
    const std::vector<char> outside = boundary_mask(flat.surface);
    for (std::size_t i = 0; i < cut.vertices.size(); ++i)
        if ((outside[cut.vertices[i]] != 0) != (i == 0 || i + 1 == cut.vertices.size())) return {};
    return cut;
}

struct CutGroup {
    std::vector<HeldPart> parts;
    int cuts = 0;
};

/// A part and its mirror image, which may be the part itself, or a part without one. And the pieces cut from them.
class MirrorGroup {
public:
    MirrorGroup(std::vector<HeldPart> parts, const ThroughPrice& price) : price_(price)
    {
        for (HeldPart& part : parts) {
            work_left_ += most_trial_work * static_cast<double>(part.flat.faces.size());
            pieces_.push_back({std::move(part.flat)});
        }
    }

    /// Cuts by what they release in parts that are relaxed for this E.
    CutGroup cut(double even, ExecutionContext& context)
    {
        return cut_while([&](std::size_t k) { return release_once(k, even, context); });
    }

    /// Cuts by the room that they save.
    CutGroup cut_for_room(double square)
    {
        return cut_while([&](std::size_t k) { return save_room_once(k, square); });
    }

private:
    struct Piece {
        FlatPart flat;
        bool settled = false;          ///< no cut pays
        std::vector<CutEnds> refused;  ///< cuts that did not pay,
        int failures = 0;              ///< and rounds in which none did
    };
    struct Trial {
        std::vector<Piece> pieces;
        std::vector<char> changed;  ///< (pieces)
        double price = 0.0;         ///< of all cuts
    };

    template <typename CutOnce>
    CutGroup cut_while(const CutOnce& cut_once)
    {
        for (std::size_t k = 0; k < pieces_.size();)
            if (pieces_[k].settled || !cut_once(k)) pieces_[k++].settled = true;
        CutGroup group{{}, cuts_};
        for (Piece& piece : pieces_) group.parts.push_back({std::move(piece.flat), {}});
        return group;
    }

    /// Opens cuts of a piece together, and keeps those that pay. On a mirrored piece it is one cut, and its image.
    /// @return whether to go on with this piece
    bool release_once(std::size_t k, double even, ExecutionContext& context)
    {
        if (work_left_ < 0.0) return false;
        std::vector<ThroughCut> cuts = promising_through_cuts(pieces_[k].flat, even, price_, pieces_[k].refused);
        if (cuts.empty()) return false;
        if (!pieces_[k].flat.image.empty()) cuts.resize(1);
        // Open, relax, compare. If some cuts do not pay, the others are tried again without them.
        while (!cuts.empty()) {
            std::optional<Trial> trial = opened(k, cuts);
            if (trial && !relax(*trial, even, context)) trial.reset();
            const std::vector<double> released =
                trial ? released_by(k, cuts, *trial, even) : std::vector(cuts.size(), 0.0);
            std::vector<ThroughCut> paying;
            for (std::size_t i = 0; i < cuts.size(); ++i) {
                if (released[i] > cuts[i].cost)
                    paying.push_back(cuts[i]);
                else
                    pieces_[k].refused.push_back(cuts[i].ends);
            }
            if (paying.size() == cuts.size()) {
                take(std::move(*trial));
                return true;
            }
            cuts = std::move(paying);
        }
        return ++pieces_[k].failures < most_failures;
    }

    /// The energy that each cut of a piece released: that of the faces nearest to it. A cut with an image has released
    /// all, less what the image costs.
    std::vector<double> released_by(std::size_t k, const std::vector<ThroughCut>& cuts, const Trial& trial,
                                    double even) const
    {
        const auto energies = [&](const FlatPart& flat) -> VectorXd { return forces_in(flat, even).energy; };
        if (cuts.size() == 1) {
            double surplus = -trial.price;
            for (std::size_t i = 0; i < trial.pieces.size(); ++i) {
                if (!trial.changed[i]) continue;
                if (i < pieces_.size()) surplus += energies(pieces_[i].flat).sum();
                surplus -= energies(trial.pieces[i].flat).sum();
            }
            return {surplus + cuts.front().cost};
        }
        // Of several cuts, each has released what the faces nearest to it have lost.
        const FlatPart& before = pieces_[k].flat;
        std::vector<std::vector<Index>> paths;
        for (const ThroughCut& cut : cuts) paths.push_back(cut.vertices);
        const std::vector<int> nearest = nearest_cut(before, paths, std::numeric_limits<double>::infinity());
        std::map<Index, int> cut_at;
        for (std::size_t f = 0; f < nearest.size(); ++f) cut_at.emplace(before.faces[f], nearest[f]);
        std::vector<double> released(cuts.size(), 0.0);
        const auto add = [&](const FlatPart& flat, double sign) {
            const VectorXd energy = energies(flat);
            for (std::size_t f = 0; f < flat.faces.size(); ++f)
                if (const int cut = cut_at.at(flat.faces[f]); cut >= 0)
                    released[cut] += sign * energy[static_cast<Eigen::Index>(f)];
        };
        add(before, 1.0);
        for (std::size_t i = 0; i < trial.pieces.size(); ++i)
            if (trial.changed[i]) add(trial.pieces[i].flat, -1.0);
        return released;
    }

    /// Makes the first cut that can be made, and its mirror image. @return whether there is one
    bool save_room_once(std::size_t k, double square)
    {
        for (const ThroughCut& cut : roomy_cuts(pieces_[k].flat, square, price_))
            if (std::optional<Trial> trial = opened(k, {cut}); trial && !has_tiny_pieces(*trial)) {
                take(std::move(*trial));
                return true;
            }
        return false;
    }

    static bool has_tiny_pieces(const Trial& trial)
    {
        for (std::size_t k = 0; k < trial.pieces.size(); ++k)
            if (const FlatPart& flat = trial.pieces[k].flat;
                trial.changed[k] && flat.faces.size() < fewest_faces && !is_true_to_size(flat))
                return true;
        return false;
    }

    void take(Trial trial)
    {
        pieces_ = std::move(trial.pieces);
        ++cuts_;
    }

    static std::vector<NamedCut> named_cuts(const FlatPart& flat, const ThroughCut& cut)
    {
        NamedCut named{{}, cut.cost}, image{{}, cut.cost};
        for (const Index v : cut.vertices) {
            named.vertices.push_back(flat.original[v]);
            if (!flat.image.empty()) image.vertices.push_back(flat.image[v]);
        }
        const bool is_own =
            image.vertices == named.vertices ||
            std::equal(image.vertices.rbegin(), image.vertices.rend(), named.vertices.begin(), named.vertices.end());
        if (flat.image.empty() || is_own) return {std::move(named)};
        return {std::move(named), std::move(image)};
    }

    /// The pieces after these cuts of one of them and their images, not relaxed yet; nothing if one of the cuts cannot
    /// be made.
    std::optional<Trial> opened(std::size_t own, const std::vector<ThroughCut>& cuts) const
    {
        std::vector<NamedCut> all;
        for (const ThroughCut& cut : cuts)
            std::ranges::move(named_cuts(pieces_[own].flat, cut), std::back_inserter(all));
        Trial trial{pieces_, std::vector<char>(pieces_.size(), 0)};
        for (const NamedCut& named : all) {
            std::vector<FlatPart> parts;
            for (std::size_t k = 0; k < trial.pieces.size() && parts.empty(); ++k) {
                const auto cut = cut_in(trial.pieces[k].flat, named);
                if (!cut) continue;
                parts = cut_through(trial.pieces[k].flat, *cut);
                if (parts.empty()) return {};
                trial.pieces[k] = {std::move(parts.front()), false, trial.pieces[k].refused};
                trial.changed[k] = 1;
                if (parts.size() > 1) trial.pieces.push_back({std::move(parts.back()), false, trial.pieces[k].refused});
            }
            if (parts.empty()) return {};
            trial.changed.resize(trial.pieces.size(), 1);
            trial.price += named.cost;
        }
        return trial;
    }

    /// Relaxes the pieces that are new. @return whether they are one to one
    bool relax(Trial& trial, double even, ExecutionContext& context)
    {
        for (std::size_t k = 0; k < trial.pieces.size(); ++k) {
            if (!trial.changed[k]) continue;
            FlatPart& flat = trial.pieces[k].flat;
            std::vector<RoundLoop> none;
            const EvenMap relaxed = make_even(flat_surface(flat, none), even, packed_side, context, through_effort);
            work_left_ -= static_cast<double>(relaxed.iterations) * static_cast<double>(flat.faces.size());
            if (!relaxed.moved || !survives_storing(flat)) return false;
        }
        return true;
    }

    std::vector<Piece> pieces_;
    int cuts_ = 0;
    double work_left_ = 0.0;  // Newton steps times faces
    ThroughPrice price_;
};

/// The groups of parts, by their numbers. A part with an image that is no part by itself is in no group.
std::vector<std::vector<std::size_t>> mirror_groups(const std::vector<HeldPart>& parts)
{
    std::map<EdgeEnds, std::size_t> part_at;  // inner edges
    const auto inner_edges = [](const FlatPart& flat, const std::vector<Index>& names, auto visit) {
        for (Index h = 0; h < static_cast<Index>(flat.surface.triangles.size()); ++h)
            if (flat.surface.twin[h] > h)
                visit(sorted_ends(names[origin(flat.surface.triangles, h)], names[target(flat.surface.triangles, h)]));
    };
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (!parts[k].flat.image.empty())
            inner_edges(parts[k].flat, parts[k].flat.original, [&](EdgeEnds edge) { part_at.emplace(edge, k); });
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (!parts[k].round.empty()) continue;
        if (parts[k].flat.image.empty()) {
            groups.push_back({k});
            continue;
        }
        // The part in which all images of its inner edges lie.
        std::optional<std::size_t> image;
        bool is_one = true;
        inner_edges(parts[k].flat, parts[k].flat.image, [&](EdgeEnds edge) {
            const auto found = part_at.find(edge);
            is_one = is_one && found != part_at.end() && (!image || *image == found->second);
            if (is_one) image = found->second;
        });
        if (!is_one || !image || *image < k || !parts[*image].round.empty()) continue;
        groups.push_back(*image == k ? std::vector{k} : std::vector{k, *image});
    }
    return groups;
}

/// Cuts the groups, on several threads. @return whether any cut was made
template <typename CutGroupOf>
bool cut_groups(std::vector<HeldPart>& parts, int threads, ExecutionContext& context, const CutGroupOf& cut_group)
{
    const auto groups = mirror_groups(parts);
    std::vector<CutGroup> pieces(groups.size());
    side_by_side(groups.size(), threads, context, [&](std::size_t g, ExecutionContext& own) {
        pieces[g] = cut_group(values_at(parts, groups[g]), own);
    });
    bool is_cut = false;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        is_cut = is_cut || pieces[g].cuts > 0;
        for (std::size_t i = 0; i < pieces[g].parts.size(); ++i) {
            if (i < groups[g].size())
                parts[groups[g][i]] = std::move(pieces[g].parts[i]);
            else
                parts.push_back(std::move(pieces[g].parts[i]));
        }
    }
    return is_cut;
}

}  // namespace

bool cut_parts_through(std::vector<HeldPart>& parts, double even, const ThroughPrice& price, int threads,
                       ExecutionContext& context)
{
    const ProfiledStage profiled("through cuts");
    return cut_groups(parts, threads, context, [&](std::vector<HeldPart> group, ExecutionContext& own) {
        return MirrorGroup(std::move(group), price).cut(even, own);
    });
}

bool cut_parts_for_room(std::vector<HeldPart>& parts, const ThroughPrice& price, int threads, ExecutionContext& context)
{
    const ProfiledStage profiled("cuts for room");
    std::vector<const FlatPart*> flats;
    for (const HeldPart& part : parts) flats.push_back(&part.flat);
    const double square = square_for_all(flats);
    return cut_groups(parts, threads, context, [&](std::vector<HeldPart> group, ExecutionContext&) {
        return MirrorGroup(std::move(group), price).cut_for_room(square);
    });
}

}  // namespace koebe
