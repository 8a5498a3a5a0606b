#include "splitting/straight_borders.h"

#include "core/connectivity.h"
#include "execution/profile.h"
#include "splitting/straight_paths.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace koebe {
namespace {

/// Straightens borders one after the other.
class BorderStraightener {
public:
    BorderStraightener(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts)
        : whole_(whole),
          options_(options),
          parts_(parts),
          label_(static_cast<std::size_t>(whole.areas.size())),
          paths_(whole)
    {
        for (std::size_t k = 0; k < parts.size(); ++k)
            for (const Index f : parts[k]->mesh.faces) label_[f] = static_cast<int>(k);
    }

    void straighten(ExecutionContext& context, SplitEffort& effort)
    {
        const std::vector<Index>& twin = whole_.surface.twin;
        std::vector<char> is_border(twin.size(), 0);
        for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
            is_border[h] = twin[h] != no_twin && label_[face_of(h)] != label_[face_of(twin[h])];
        std::vector<Path> borders = chains_of(whole_.surface, is_border);
        for (const Path& border : borders) paths_.add(border);
        for (Path& border : borders) {
            const Path before = border;
            const double saved = paths_.straighten(border);
            if (saved > 0.0 && !move(before, border, saved, context, effort)) paths_.replace(border, before);
        }
    }

private:
    /// Moves a border between two parts. @param saved length @return whether it moved
    bool move(const Path& from, const Path& to, double saved, ExecutionContext& context, SplitEffort& effort)
    {
        const int left = label_[face_of(from.front())], right = label_[face_of(whole_.surface.twin[from.front()])];
        std::vector<Index> faces[2];
        if (!divide(from, to, left, right, faces)) return false;
        const PartPointer old[] = {parts_[left], parts_[right]};
        PartPointer moved[2];
        for (const int k : {0, 1}) {
            moved[k] = std::make_shared<Part>(Part{part_mesh(whole_, std::move(faces[k])), {}, {}});
            if (moved[k]->mesh.surface.loops.size() != old[k]->mesh.surface.loops.size()) return false;
        }
        map_all(whole_, {moved[0].get(), moved[1].get()}, options_.threads, context, effort);
        double gain = options_.of(0.0, saved), lost = 0.0;
        for (const int k : {0, 1}) {
            gain += old[k]->map.overflow - moved[k]->map.overflow;
            lost += moved[k]->map.lost_area - old[k]->map.lost_area;
        }
        if (lost > 0.0 || gain < 0.0) return false;
        parts_[left] = moved[0];
        parts_[right] = moved[1];
        for (const int k : {0, 1})
            for (const Index f : moved[k]->mesh.faces) label_[f] = k == 0 ? left : right;
        return true;
    }

    /// The faces of two parts on both sides of a new border between them; false: it does not divide them.
    bool divide(const Path& from, const Path& to, int left, int right, std::vector<Index> (&faces)[2]) const
    {
        const std::vector<Index>& twin = whole_.surface.twin;
        // Walls: the borders of both parts, with the new border in place of the old one.
        std::vector<char> is_closed(twin.size(), 0);
        for (const Part* part : {parts_[left].get(), parts_[right].get()})
            for (const Index f : part->mesh.faces)
                for (Index h = 3 * f; h < 3 * f + 3; ++h)
                    is_closed[h] = twin[h] == no_twin || label_[face_of(twin[h])] != label_[f];
        for (const Index h : from) is_closed[h] = is_closed[twin[h]] = 0;
        for (const Index h : to) is_closed[h] = is_closed[twin[h]] = 1;
        std::vector<signed char> side(label_.size(), -1);
        // Flood from either side of the new border. The floods may not meet, and must reach all faces.
        for (const int k : {0, 1}) {
            const Index seed = face_of(k == 0 ? to.front() : twin[to.front()]);
            if (side[seed] >= 0) return false;
            side[seed] = static_cast<signed char>(k);
            faces[k] = {seed};
            for (std::size_t i = 0; i < faces[k].size(); ++i)
                for (Index h = 3 * faces[k][i]; h < 3 * faces[k][i] + 3; ++h) {
                    if (is_closed[h] || side[face_of(twin[h])] == k) continue;
                    if (side[face_of(twin[h])] >= 0) return false;
                    side[face_of(twin[h])] = static_cast<signed char>(k);
                    faces[k].push_back(face_of(twin[h]));
                }
            std::ranges::sort(faces[k]);
        }
        return faces[0].size() + faces[1].size() == parts_[left]->mesh.faces.size() + parts_[right]->mesh.faces.size();
    }

    const CutSurface& whole_;
    const SplitOptions& options_;
    std::vector<PartPointer>& parts_;
    std::vector<int> label_;  // (F) the part
    PathStraightener paths_;
};

}  // namespace

void straighten_borders(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                        ExecutionContext& context, SplitEffort& effort)
{
    const ProfiledStage profiled("straight borders");
    if (parts.size() > 1) BorderStraightener(whole, options, parts).straighten(context, effort);
}

}  // namespace koebe
