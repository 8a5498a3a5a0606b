// A vertex of a filled map brought to 0.
#include "embedding/filled_map.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr int most_moves = 80, most_stuck = 4;
constexpr double longest_move = 0.3;                    // disk units: |a| of an automorphism
constexpr double least_move = 1e-3, poor_move = 0.02;   // shares of the way to 0
constexpr double with_room = 0.3, hardest_pull = 1e12;  // dimensionless: weight of the holes' fans, and the pull

}  // namespace

/// Moves each vertex by an automorphism of the disk that leaves the vertex at 1.
/// @return false, without a change, if a face would turn over
bool FilledMap::move_by(Moebius moebius)
{
    const std::vector<char> was_right = right_faces();
    const PlanarPoints before = now_.points;
    if (places_.point >= 0) {
        const Complex image = moebius(at(places_.point));
        moebius.turn = std::conj(image) / std::abs(image);
    }
    for (Index v = 0; v < filled_.vertex_count; ++v) {
        Complex image = v == places_.point ? Complex(1.0, 0.0) : moebius(at(v));
        if (loop_of_[v] == 0) image /= std::abs(image);
        now_.points.row(v) << image.real(), image.imag();
    }
    for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f)
        if (was_right[f] && !right(f)) {
            now_.points = before;
            return false;
        }
    return true;
}

/// Moves the vertex for 0 alone, by a share of its way.
/// @return false, without a change, if a face would turn over
bool FilledMap::move_center_by(double share)
{
    const Index v = places_.center;
    const std::vector<char> was_right = right_faces();
    const Eigen::RowVector2d before = now_.points.row(v);
    now_.points.row(v) -= share * before;
    if (star_right(v, was_right)) return true;
    now_.points.row(v) = before;
    return false;
}

/// Brings the vertex for 0 there, and holds it. An automorphism turns a face over only if its pole lies in the face's
/// circumscribed disk. So this takes small automorphisms, whose poles are far, and steps of the vertex alone. Between
/// them the faces around it are relaxed, first towards equilateral ones, which have the smallest circumscribed disks.
void FilledMap::bring_to_center(const ExecutionContext& context)
{
    let_rim_slide(true);
    const State start = now_;
    if (approach_center(false, context)) return;
    return_to(start);
    approach_center(true, context);
}

/// @param follows whether the vertex moves when faces are relaxed; it is then pulled the last part of the way
/// @return whether the vertex is at 0
bool FilledMap::approach_center(bool follows, const ExecutionContext& context)
{
    const Index v = places_.center;
    now_.mobility[v] = follows ? Mobility::free : Mobility::held;
    PatchShape shape = PatchShape::equilateral;
    bool there = move_center_by(1.0);
    for (int step = 0, stuck = 0; !there && step < most_moves && stuck < most_stuck; ++step) {
        double turned = std::min(1.0, longest_move / std::abs(at(v))), alone = follows ? 0.0 : 0.5;
        while (turned > least_move && !move_by({turned * at(v)})) turned *= 0.5;
        while (alone > least_move && !move_center_by(alone)) alone *= 0.5;
        const double most = std::max(turned, alone);
        stuck = most > least_move ? 0 : stuck + 1;
        if (most < poor_move) shape = shape == PatchShape::surface ? PatchShape::equilateral : PatchShape::surface;
        relax({.regular = with_room, .shape = shape}, most < poor_move ? 12 : 4, context);
        there = move_center_by(1.0);
    }
    for (double pull = 1.0; follows && !there && pull < hardest_pull; pull *= 10.0) {
        relax({.regular = with_room, .place = pull, .shape = PatchShape::equilateral}, 12, context);
        there = move_center_by(1.0);
    }
    now_.mobility[v] = there ? Mobility::held : Mobility::free;
    return there;
}

}  // namespace koebe
