#include "parts/mesh_parts.h"

#include "core/connectivity.h"
#include "cost/costs.h"
#include "execution/side_by_side.h"
#include "mesh/connected_pieces.h"
#include "parts/carried_parts.h"
#include "parts/even_parts.h"
#include "parts/hard_surface.h"
#include "parts/pinholes.h"
#include "parts/proxy.h"
#include "parts/unfolding.h"
#include "surface/ambient_visibility.h"
#include "surface/importance.h"
#include "surface/mirror.h"
#include "surface/mirror_plane.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr Index proxy_from = 6000;   // faces: larger meshes are decided on proxies,
constexpr Index proxy_faces = 5500;  // with about so many faces,
constexpr Index least_proxy = 300;   // and each piece has at least so many
constexpr Index least_mirrored =
    1500;  // faces of a mesh without a proxy that is its mirror image but for its faces: it
constexpr double mirrored_share = 0.6;  // gets a mirrored proxy with this share of its faces
constexpr int rounds_on_proxy = 5;      // of relaxing with the void

/// A piece and how far its parts are decided.
struct MeshPiece : FlatPiece {
    std::optional<Proxy> proxy = {};            ///< on which the parts were decided
    std::optional<PieceInput> filled = {};      ///< the piece without its pinholes: the proxy's fine surface is of it,
    std::optional<PieceSurface> open = {};      ///< and this is the surface with its pinholes
    bool is_fine = true;                        ///< whether the parts name elements of the piece, not of the proxy
    std::vector<FlatPart> conformal = {};       ///< fine parts at E = 0, without darts, to compare with
    bool is_measured = false;                   ///< whether these only compare: they are no result
    std::vector<std::size_t> group = {};        ///< (parts) parts of one group were one part before they were cut
    std::vector<std::size_t> uncut_group = {};  ///< (conformal)

    /// The piece whose numbers parts may name.
    const SurfacePiece& named() const { return filled ? filled->piece : input.piece; }
    /// The piece as a surface that has its pinholes.
    const PieceSurface& surface() const { return open ? *open : proxy->fine; }
};

/// For each part the number of the other part with its first face. @param faces of the surface
std::vector<std::size_t> owners(const std::vector<FlatPart>& parts, const std::vector<FlatPart>& others,
                                Eigen::Index faces)
{
    std::vector<std::size_t> other(static_cast<std::size_t>(faces), 0), owner;
    for (std::size_t k = 0; k < others.size(); ++k)
        for (const Index f : others[k].faces) other[f] = k;
    for (const FlatPart& part : parts) owner.push_back(other[part.faces.front()]);
    return owner;
}

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

/// Makes cuts dearer where they are seen from more directions, and cheaper where from fewer: in the mean as dear.
void price_by_visibility(PieceInput& input)
{
    const SurfacePiece& piece = input.piece;
    const VectorXd own = ambient_visibility(piece.vertices, piece.triangles);
    VectorXd seen = own;
    const std::vector<Index> image = find_mirror(piece.vertices, piece.triangles, input.polygon).vertex;
    for (std::size_t v = 0; v < image.size(); ++v)
        if (image[v] >= 0) seen[v] = 0.5 * (own[v] + own[image[v]]);
    VectorXd areas = VectorXd::Zero(seen.size());
    const VectorXd faces = face_areas(piece.vertices, piece.triangles);
    for (Eigen::Index c = 0; c < piece.triangles.size(); ++c) areas[piece.triangles.data()[c]] += faces[c / 3];
    if (input.shown.empty()) input.shown.assign(static_cast<std::size_t>(seen.size()), 1.0);
    const VectorXd factor = visibility_factors(seen, areas);
    for (Eigen::Index v = 0; v < factor.size(); ++v) input.shown[v] *= factor[v];
}

/// Whether a piece is its own mirror image, but not its triangulation.
bool is_only_nearly_mirror(const PieceInput& input)
{
    const auto& [vertices, triangles] = std::tie(input.piece.vertices, input.piece.triangles);
    return find_mirror(vertices, triangles, input.polygon).vertex.empty() && nearly_mirror(vertices, triangles);
}

/// Pieces, whose parts are decided one by one and made even together.
class PartsOfPieces {
public:
    PartsOfPieces(std::vector<FlatPiece> pieces, const PartsOptions& options, ExecutionContext& context)
        : options_(options), context_(context)
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
        std::vector<SplitEffort> efforts(pieces_.size());
        double done = 0.0;
        const auto stage = [&](double faces) {
            const double from = done;
            done = std::min(1.0, done + faces / static_cast<double>(total_));
            context_.begin_stage("split", 0.05 + 0.75 * from, 0.05 + 0.75 * done);
        };
        for (const std::size_t i : big) {
            stage(static_cast<double>(pieces_[i].input.piece.triangles.rows()));
            decide(pieces_[i], options_.threads, context_, efforts[i]);
        }
        stage(static_cast<double>(total_));
        side_by_side(small.size(), options_.threads, context_, [&](std::size_t k, ExecutionContext& own) {
            decide(pieces_[small[k]], 1, own, efforts[small[k]]);
        });
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            result_.maps += efforts[i].maps * static_cast<double>(pieces_[i].input.piece.triangles.rows()) /
                            static_cast<double>(total_);
    }

    /// Makes the parts even. Parts that were decided on proxies are then made of the fine surface, and relaxed.
    void make_even() { result_.even = make_all_even(); }

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
    /// @return E
    double make_all_even()
    {
        EvenOptions evening = evening_of(options_, options_.roomy, options_.threads);
        const bool by_proxy = std::ranges::any_of(pieces_, [](const MeshPiece& own) { return own.proxy.has_value(); });
        if (by_proxy && (options_.even == 0.0 || evening.loops != LoopForm::free))
            for (MeshPiece& own : pieces_)
                if (own.proxy) lay_fine(own);
        if (std::ranges::all_of(pieces_, &MeshPiece::is_fine)) return make_together_even(evening);

        // Decide the cuts and E on the proxies.
        std::vector<std::vector<FlatPart>> before;
        for (const MeshPiece& own : pieces_) before.push_back(own.parts);
        EvenOptions on_proxy = evening;
        on_proxy.dearer = tuning::proxy_factor;
        on_proxy.rounds = rounds_on_proxy;
        double even = make_together_even(on_proxy);

        // Make the same parts of the fine surface. Where angles are worse than at 0, go back.
        if (even > 0.0) {
            for (std::size_t i = 0; i < pieces_.size(); ++i) note_uncut(pieces_[i], std::move(before[i]));
            std::vector<FlatPart> parts = together();
            const EvenParts relaxed = relax_carried(parts, even, angle_bounds(), evening, context_);
            take_back(std::move(parts), relaxed);
            for (MeshPiece& own : pieces_) open_pinholes(own);
            go_back(relaxed.worse);
            if (relaxed.even > 0.0) return relaxed.even;
        } else {
            for (std::size_t i = 0; i < pieces_.size(); ++i) {
                pieces_[i].parts = std::move(before[i]);
                if (pieces_[i].proxy) lay_fine(pieces_[i]);
            }
        }
        result_.not_even.clear();
        evening.darts = 0.0;
        return make_together_even(evening);
    }

    void decide(MeshPiece& own, int threads, ExecutionContext& context, SplitEffort& effort) const
    {
        const Index faces = static_cast<Index>(own.input.piece.triangles.rows());
        const Index coarse =
            std::max(least_proxy, static_cast<Index>(proxy_faces * static_cast<double>(faces) / total_));
        const bool by_proxy = total_ > proxy_from && faces > coarse && options_.slits.empty();
        if (!by_proxy && faces <= proxy_from) price_by_visibility(own.input);
        PieceSurface surface = surface_of(own.input);
        std::optional<UnfoldedParts> true_to_size;
        if (may_unfold(options_)) true_to_size = unfolded(surface.whole, context, unfolding_of(options_));
        const auto take_unfolded = [&] {
            own.parts = std::move(true_to_size->parts);
            note_shown(own.input.shown, own.parts);
        };
        if (true_to_size && true_to_size->cut_length <= tuning::few_cuts * std::sqrt(surface.whole.areas.sum())) {
            take_unfolded();
            return;
        }
        make_proxy(own, by_proxy ? coarse : 0, surface, context);
        if (own.proxy) {
            price_by_visibility(own.proxy->input);
            own.is_fine = false;
            PieceSurface judged = surface_of(own.proxy->input);
            judged.whole.exact = false;
            own.parts = flat_piece(own.proxy->input, std::move(judged), options_, threads, context, effort).parts;
            name_by_source(own.proxy->input.piece, own.parts);
        } else {
            own.parts = flat_piece(own.input, std::move(surface), options_, threads, context, effort).parts;
        }
        if (!true_to_size) return;
        const EvenOptions evening = evening_of(options_, false, threads);
        if (cost_when_even(true_to_size->parts, evening, context) > cost_when_even(own.parts, evening, context)) return;
        take_unfolded();
        own.proxy.reset();
        own.filled.reset();
        own.is_fine = true;
    }

    /// Makes a proxy of a large piece, or of one that is its own mirror image but for its triangulation.
    /// @param coarse faces of a large piece's proxy; 0: the piece is not large @param surface of the input; the proxy
    /// takes it
    void make_proxy(MeshPiece& own, Index coarse, PieceSurface& surface, ExecutionContext& context) const
    {
        const auto faces = static_cast<Index>(own.input.piece.triangles.rows());
        if (coarse > 0) {
            own.filled = may_carry() ? without_pinholes(own.input, surface.whole.surface) : std::nullopt;
            if (own.filled) own.open = std::exchange(surface, surface_of(*own.filled));
            own.proxy = proxy_of(own.filled ? *own.filled : own.input, std::exchange(surface, {}), coarse, context);
        } else if (faces >= least_mirrored && may_carry() && is_only_nearly_mirror(own.input)) {
            own.proxy =
                proxy_of(own.input, std::exchange(surface, {}), static_cast<Index>(mirrored_share * faces), context);
            if (own.proxy->is_mirrored) return;
            surface = std::move(own.proxy->fine);
            own.proxy.reset();
        }
    }

    /// Whether parts that were decided on a proxy may keep their darts, and no form was chosen for loops or cuts.
    bool may_carry() const
    {
        return options_.slits.empty() && !options_.round_cuts && options_.even != 0.0 &&
               evening_of(options_, false, 1).loops == LoopForm::free;
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

    /// Notes what the parts of a piece are at E = 0, and makes them of the fine surface. @param before without darts
    void note_uncut(MeshPiece& own, std::vector<FlatPart> before)
    {
        if (own.is_fine) {
            own.group = owners(own.parts, before, own.named().triangles.rows());
            own.conformal = std::move(before);
            own.uncut_group.resize(own.conformal.size());
            std::iota(own.uncut_group.begin(), own.uncut_group.end(), 0);
            return;
        }
        std::vector<FlatPart> fine = carried_parts(*own.proxy, own.parts, options_.threads, context_);
        if (fine.empty()) {
            own.parts = std::move(before);
            lay_fine(own);
            note_uncut(own, own.parts);
            return;
        }
        own.group = owners(own.parts, before, own.proxy->surface.triangles.rows());
        std::vector<std::vector<Index>> faces(before.size());
        for (std::size_t k = 0; k < fine.size(); ++k)
            faces[own.group[k]].insert(faces[own.group[k]].end(), fine[k].faces.begin(), fine[k].faces.end());
        own.conformal = laid(own, faces, true);
        own.uncut_group = owners(own.conformal, fine, own.proxy->fine.whole.areas.size());
        for (std::size_t& group : own.uncut_group) group = own.group[group];
        own.is_measured = true;
        side_by_side(fine.size(), options_.threads, context_, [&](std::size_t k, ExecutionContext& context) {
            if (!fine[k].is_near) start_by_itself(own.conformal, fine[k], context);
        });
        own.parts = std::move(fine);
        own.is_fine = true;
    }

    /// Makes parts that were only measured anew, as they would be stored.
    void make_exact(MeshPiece& own)
    {
        if (!std::exchange(own.is_measured, false)) return;
        std::vector<std::vector<Index>> faces;
        for (const FlatPart& part : own.conformal) faces.push_back(part.faces);
        std::vector<FlatPart> exact = laid(own, faces);
        std::vector<std::size_t> group = owners(exact, own.conformal, own.proxy->fine.whole.areas.size());
        for (std::size_t& k : group) k = own.uncut_group[k];
        own.conformal = std::move(exact);
        own.uncut_group = std::move(group);
    }

    /// The angles of all groups at E = 0; no bounds, if E is given.
    AngleBounds angle_bounds()
    {
        AngleBounds bounds;
        if (options_.even) return bounds;
        for (const MeshPiece& own : pieces_) {
            const std::size_t first = bounds.most.size();
            for (const std::size_t group : own.group) bounds.group.push_back(first + group);
            bounds.most.resize(first + groups_of(own), 0.0);
            for (std::size_t k = 0; k < own.conformal.size(); ++k)
                bounds.most[first + own.uncut_group[k]] += own.is_measured
                                                               ? sum_of_upright_angle_errors(own.conformal[k])
                                                               : sum_of_angle_errors(own.conformal[k]);
        }
        if (std::ranges::any_of(pieces_, &MeshPiece::is_measured))
            bounds.exact = [this] {
                for (MeshPiece& own : pieces_) make_exact(own);
                return angle_bounds();
            };
        return bounds;
    }

    /// Puts conformal parts in the place of groups. @param groups numbers as in angle_bounds
    void go_back(const std::vector<std::size_t>& groups)
    {
        std::size_t first = 0;
        for (MeshPiece& own : pieces_) {
            const std::size_t end = first + groups_of(own);
            std::vector<FlatPart> parts;
            const auto goes_back = [&](std::size_t group) { return std::ranges::count(groups, first + group) > 0; };
            for (std::size_t k = 0; k < own.parts.size(); ++k)
                if (!goes_back(own.group[k])) parts.push_back(std::move(own.parts[k]));
            for (std::size_t k = 0; k < own.conformal.size(); ++k) {
                if (!goes_back(own.uncut_group[k])) continue;
                for (const Index f : own.conformal[k].faces) result_.not_even.push_back(own.input.piece.source_face[f]);
                parts.push_back(std::move(own.conformal[k]));
            }
            own.parts = std::move(parts);
            own.conformal.clear();
            first = end;
        }
        std::ranges::sort(result_.not_even);
        result_.not_even.erase(std::unique(result_.not_even.begin(), result_.not_even.end()), result_.not_even.end());
    }

    static std::size_t groups_of(const MeshPiece& own)
    {
        return std::max(*std::ranges::max_element(own.group), *std::ranges::max_element(own.uncut_group)) + 1;
    }

    /// Parts of the fine surface with its pinholes, each mapped by itself. @param faces of each part; if only filled
    /// pinholes join them, there are more parts @param measured they are no result
    std::vector<FlatPart> laid(const MeshPiece& own, const std::vector<std::vector<Index>>& faces,
                               bool measured = false) const
    {
        SplitEffort effort;
        const CutSurface& whole = own.surface().whole;
        const auto count = static_cast<Index>(whole.areas.size());
        std::vector<int> label(static_cast<std::size_t>(count), -1);
        for (std::size_t k = 0; k < faces.size(); ++k)
            for (const Index f : faces[k])
                if (f < count) label[f] = static_cast<int>(k);
        Index pieces = 0;
        const std::vector<Index> piece = connected_pieces(whole.surface.twin, label, pieces);
        std::vector<std::vector<Index>> faces_of(static_cast<std::size_t>(pieces));
        for (Index f = 0; f < count; ++f)
            if (label[f] >= 0) faces_of[piece[f]].push_back(f);
        std::vector<PartPointer> parts;
        for (std::vector<Index>& of_part : faces_of)
            if (!of_part.empty())
                parts.push_back(std::make_shared<Part>(Part{part_mesh(whole, std::move(of_part)), {}, {}}));
        const CutPrices prices = prices_of_piece(whole.areas.sum(), options_.price);
        return flat_parts(whole, find_mirror(whole.vertices, whole.surface.triangles, whole.polygon), parts,
                          {prices.cut_price, prices.part_price, options_.round_cuts, measured}, options_.threads,
                          context_, effort)
            .parts;
    }

    /// Makes the proxy's parts of the fine surface, each mapped by itself. If they have no place there, the parts of
    /// the fine surface are decided on itself.
    void lay_fine(MeshPiece& own)
    {
        SplitEffort effort;
        const std::vector<std::vector<Index>> faces = carried_faces(*own.proxy, own.parts, context_);
        own.is_fine = true;
        own.parts = faces.empty()
                        ? flat_piece(own.input, own.surface(), options_, options_.threads, context_, effort).parts
                        : laid(own, faces);
    }

    /// Takes the faces away that fill pinholes.
    static void open_pinholes(MeshPiece& own)
    {
        if (!own.filled) return;
        std::vector<FlatPart> parts;
        std::vector<std::size_t> group;
        for (std::size_t k = 0; k < own.parts.size(); ++k)
            for (FlatPart& part :
                 with_pinholes(std::move(own.parts[k]), static_cast<Index>(own.input.piece.triangles.rows()))) {
                parts.push_back(std::move(part));
                group.push_back(own.group[k]);
            }
        own.parts = std::move(parts);
        own.group = std::move(group);
    }

    std::vector<MeshPiece> pieces_;
    const PartsOptions& options_;
    ExecutionContext& context_;
    Eigen::Index total_ = 0;  // faces
    MeshParts result_;
};

}  // namespace

MeshParts mesh_parts(std::vector<FlatPiece> pieces, const PartsOptions& options, ExecutionContext& context)
{
    PartsOfPieces parts(std::move(pieces), options, context);
    parts.decide();
    context.begin_stage("even", 0.8, 0.9);
    parts.make_even();
    return parts.take();
}

}  // namespace koebe
