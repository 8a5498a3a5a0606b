#include "parts/mesh_parts.h"

#include "core/sort_unique.h"
#include "cost/tuning.h"
#include "execution/side_by_side.h"
#include "parts/even_parts.h"
#include "parts/fine_parts.h"
#include "parts/hard_surface.h"
#include "parts/mesh_piece.h"
#include "parts/sketched_cuts.h"
#include "surface/importance.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr int rounds_on_proxy = 5;  // of relaxing with the void

/// Tells faces how large they should be, and scales each part to the sum of its faces. @param importance of the
/// vertices of all parts, or empty
void ask_for_sizes(const std::vector<double>& importance, std::vector<FlatPart>& parts)
{
    if (importance.empty()) return;
    Vertices vertices(static_cast<Eigen::Index>(importance.size()), 3);
    Eigen::Index faces = 0, first = 0, row = 0;
    for (const FlatPart& part : parts) faces += part.surface.triangles.rows();
    Triangles triangles(faces, 3);
    for (const FlatPart& part : parts) {
        vertices.middleRows(first, part.vertices.rows()) = part.vertices;
        triangles.middleRows(row, part.surface.triangles.rows()) =
            part.surface.triangles.array() + static_cast<Index>(first);
        first += part.vertices.rows();
        row += part.surface.triangles.rows();
    }
    const Eigen::Map<const VectorXd> own(importance.data(), static_cast<Eigen::Index>(importance.size()));
    const VectorXd sizes = size_factors(vertices, triangles, own);
    if (sizes.size() == 0) return;
    row = 0;
    for (FlatPart& part : parts) {
        const VectorXd areas = face_areas(part.vertices, part.surface.triangles);
        const VectorXd wanted = sizes.segment(row, areas.size());
        const double asked = part.sizes.empty() ? areas.dot(wanted) : 0.0;  // else its map has these sizes
        part.sizes.assign(wanted.begin(), wanted.end());
        if (asked > 0.0) part.points *= std::sqrt(asked / areas.sum());
        row += areas.size();
    }
}

/// Pieces, whose parts are decided one by one and made even together.
class PartsOfPieces {
public:
    PartsOfPieces(std::vector<FlatPiece> pieces, const PartsOptions& options, bool only_uncut,
                  ExecutionContext& context)
        : options_(options), only_uncut_(only_uncut), context_(context)
    {
        for (FlatPiece& own : pieces) pieces_.push_back({std::move(own)});
        for (const MeshPiece& own : pieces_)
            if (own.parts.empty()) total_ += own.input.piece.triangles.rows();
    }

    /// Large pieces one after the other on all threads, the others side by side.
    void decide()
    {
        if (total_ == 0) return;
        std::vector<std::size_t> small, big;
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            if (pieces_[i].parts.empty())
                (8 * pieces_[i].input.piece.triangles.rows() > total_ ? big : small).push_back(i);
        // Progress by faces.
        std::vector<SplitEffort> efforts(pieces_.size());
        double done = 0.0;
        const auto stage = [&](double faces) {
            const double from = done;
            done = std::min(1.0, done + faces / static_cast<double>(total_));
            context_.begin_stage("split", 0.05 + 0.75 * from, 0.05 + 0.75 * done);
        };
        // The large ones, then all others at once.
        for (const std::size_t i : big) {
            stage(static_cast<double>(pieces_[i].input.piece.triangles.rows()));
            decide_parts(pieces_[i], total_, options_, options_.threads, context_, efforts[i]);
            if (i != big.back()) sketch();
        }
        stage(static_cast<double>(total_));
        side_by_side(small.size(), options_.threads, context_, [&](std::size_t k, ExecutionContext& own) {
            decide_parts(pieces_[small[k]], total_, options_, 1, own, efforts[small[k]]);
        });
        // The report counts maps of the whole mesh.
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            result_.maps += efforts[i].maps * static_cast<double>(pieces_[i].input.piece.triangles.rows()) /
                            static_cast<double>(total_);
        sketch();
    }

    /// Makes the parts even. Parts that were decided on proxies are then made of the fine surface, and relaxed.
    /// @return false, before that, if they are cut and only an uncut mesh is asked for
    bool make_even()
    {
        const std::optional<double> even = make_all_even(true);
        result_.even = even.value_or(0.0);
        return even.has_value();
    }

    /// With parts named by the input.
    MeshParts take()
    {
        for (MeshPiece& own : pieces_) {
            name_by_source(own.input.piece, own.parts);
            std::ranges::move(own.parts, std::back_inserter(result_.parts));
        }
        return std::move(result_);
    }

private:
    void sketch() const
    {
        if (options_.sketch) options_.sketch(sketched_boundaries(pieces_, context_));
    }

    bool is_cut() const
    {
        std::size_t count = 0;
        for (const MeshPiece& own : pieces_) count += own.parts.size();
        return count > 1 || std::ranges::any_of(pieces_, [](const MeshPiece& own) {
                   return std::ranges::any_of(own.parts, &FlatPart::is_cut_open);
               });
    }

    /// @param stitch whether parts may be joined again @return E; nothing if only an uncut mesh is asked for, and the
    /// parts on proxies are cut
    std::optional<double> make_all_even(bool stitch)
    {
        FineParts fine(pieces_, options_, context_);
        EvenOptions evening = evening_of(options_, options_.roomy, options_.threads);
        evening.stitch = stitch && options_.slits.empty();  // slits that were chosen stay open
        const bool by_proxy = std::ranges::any_of(pieces_, [](const MeshPiece& own) { return own.proxy.has_value(); });
        if (by_proxy && (options_.even == 0.0 || evening.loops != LoopForm::free))
            for (MeshPiece& own : pieces_)
                if (own.proxy) fine.lay(own);
        if (std::ranges::all_of(pieces_, &MeshPiece::is_fine)) return make_together_even(evening);

        // Decide the cuts and E on the proxies.
        std::vector<std::vector<FlatPart>> before;
        for (const MeshPiece& own : pieces_) before.push_back(own.parts);
        EvenOptions on_proxy = evening;
        on_proxy.dearer = tuning::proxy_factor;
        on_proxy.rounds = rounds_on_proxy;
        const double even = make_together_even(on_proxy);
        if (only_uncut_ && is_cut()) return {};
        sketch();

        // Make the same parts of the fine surface. Where angles are worse than at 0, go back.
        if (even > 0.0) {
            fine.carry(before);
            std::vector<FlatPart> parts = together();
            const EvenParts relaxed = relax_carried(parts, even, fine.angle_bounds(), evening, context_);
            take_back(std::move(parts), relaxed);
            if (!fine.can_go_back(relaxed.worse)) {
                take_decided(std::move(before));
                return make_all_even(false);
            }
            fine.open_pinholes();
            const std::vector<Index> worse = fine.go_back(relaxed.worse);
            result_.not_even.insert(result_.not_even.end(), worse.begin(), worse.end());
            sort_unique(result_.not_even);
            if (relaxed.even > 0.0) return relaxed.even;
        } else {
            for (std::size_t i = 0; i < pieces_.size(); ++i) {
                pieces_[i].parts = std::move(before[i]);
                if (pieces_[i].proxy) fine.lay(pieces_[i]);
            }
        }
        result_.not_even.clear();
        evening.darts = 0.0;
        return make_together_even(evening);
    }

    /// The pieces as they were before their parts were made even.
    void take_decided(std::vector<std::vector<FlatPart>> parts)
    {
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            MeshPiece& own = pieces_[i];
            own.parts = std::move(parts[i]);
            own.conformal.clear();
            own.is_fine = !own.proxy;
            own.is_measured = own.is_joined = false;
        }
    }

    /// The parts of all pieces. An element's name is its number and the number of elements in all pieces before.
    std::vector<FlatPart> together()
    {
        const std::vector<double>& importance = options_.importance;  // (V) of the input, or empty
        std::vector<FlatPart> all;
        std::vector<double> weights;  // of the vertices of all parts
        Index vertices = 0, faces = 0;
        for (MeshPiece& own : pieces_) {
            if (!importance.empty())
                for (const FlatPart& part : own.parts)
                    for (const Index v : part.original)
                        weights.push_back(
                            importance[own.named().source_vertex[own.is_fine ? v : own.proxy->coarse.vertex[v]]]);
            rename_elements(
                own.parts, [&](Index v) { return v < 0 ? v : vertices + v; }, [&](Index f) { return faces + f; });
            std::ranges::move(own.parts, std::back_inserter(all));
            own.parts.clear();
            vertices += static_cast<Index>(own.named().vertices.rows());
            faces += static_cast<Index>(own.named().triangles.rows());
        }
        ask_for_sizes(weights, all);
        return all;
    }

    /// Gives the pieces their parts back.
    void take_back(std::vector<FlatPart> parts, const EvenParts& even)
    {
        std::vector<Index> first{0};
        for (const MeshPiece& own : pieces_)
            first.push_back(first.back() + static_cast<Index>(own.named().triangles.rows()));
        const auto piece_of = [&](Index face) {
            return static_cast<std::size_t>(std::ranges::upper_bound(first, face) - first.begin()) - 1;
        };
        result_.not_even.clear();
        for (const std::size_t k : even.left)
            for (const Index face : parts[k].faces)
                if (const MeshPiece& own = pieces_[piece_of(face)]; own.is_fine)
                    if (const Index name = own.named().source_face[face - first[piece_of(face)]]; name >= 0)
                        result_.not_even.push_back(name);
        std::ranges::sort(result_.not_even);
        for (FlatPart& part : parts) pieces_[piece_of(part.faces.front())].parts.push_back(std::move(part));
        Index vertices = 0;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            rename_elements(
                pieces_[i].parts, [&](Index v) { return v < 0 ? v : v - vertices; },
                [&](Index f) { return f - first[i]; });
            vertices += static_cast<Index>(pieces_[i].named().vertices.rows());
        }
    }

    double make_together_even(const EvenOptions& evening)
    {
        std::vector<FlatPart> parts = together();
        const EvenParts even = make_parts_even(parts, evening, context_);
        take_back(std::move(parts), even);
        return even.even;
    }

    std::vector<MeshPiece> pieces_;
    const PartsOptions& options_;
    bool only_uncut_;
    ExecutionContext& context_;
    Eigen::Index total_ = 0;  // faces
    MeshParts result_;
};

}  // namespace

std::optional<MeshParts> mesh_parts(std::vector<FlatPiece> pieces, const PartsOptions& options, bool only_uncut,
                                    ExecutionContext& context)
{
    PartsOfPieces parts(std::move(pieces), options, only_uncut, context);
    parts.decide();
    context.begin_stage("even", 0.8, 0.9);
    if (!parts.make_even()) return {};
    return parts.take();
}

}  // namespace koebe
