#include "foldover/newton_system.h"

#include "core/complex_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace koebe {
namespace {

constexpr double shift = 1e-9;  // share added to the Hessian's diagonal

Eigen::Vector2d vector(Complex z) { return {z.real(), z.imag()}; }

/// Sorts pairs and leaves each of them once: first into a bucket for each first number, which is below `count`.
void sort_in_buckets(std::vector<std::pair<Index, Index>>& pairs, Index count)
{
    std::vector<std::size_t> end(static_cast<std::size_t>(count) + 1, 0);
    for (const auto& [first, second] : pairs) ++end[first + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Index> seconds(pairs.size());
    for (const auto& [first, second] : pairs) seconds[end[first]++] = second;  // end[first] now is what its name says
    pairs.clear();
    for (Index first = 0; first < count; ++first) {
        const auto from = seconds.begin() + static_cast<std::ptrdiff_t>(first > 0 ? end[first - 1] : 0);
        const auto to = seconds.begin() + static_cast<std::ptrdiff_t>(end[first]);
        std::sort(from, to);
        std::for_each(from, std::unique(from, to), [&](Index second) { pairs.emplace_back(first, second); });
    }
}

/// The vector turned clockwise.
Eigen::Vector2d normal_of(const Eigen::Vector2d& along) { return {along[1], -along[0]}; }

}  // namespace

NewtonSystem::NewtonSystem(const FoldoverProblem& problem, NewtonPattern* kept)
    : problem_(problem), first_unknown_(problem.points.rows(), -1), kept_(kept)
{
    for (Eigen::Index v = 0; v < problem.points.rows(); ++v)
        if (problem.mobility[v] != Mobility::held) {
            first_unknown_[v] = unknowns_;
            unknowns_ += unknowns_of(v);
        }
    for (const Track& track : problem.tracks) {
        first_of_track_.push_back(unknowns_);
        unknowns_ += track.unknowns();
    }
    for (std::size_t j = 0; j < problem.periods.size(); ++j) {
        first_of_period_.push_back(unknowns_);
        unknowns_ += j == 0 ? 1 : 2;
    }
    if (unknowns_ > 0) tangents_.resize(first_unknown_.size());
    angle_.resize(tangents_.size());
    if (kept_) pattern_ = std::exchange(*kept_, {});
    const bool fits = pattern_.hessian.rows() == unknowns_ &&
                      pattern_.places.size() == static_cast<std::size_t>(problem.triangles.rows()) &&
                      pattern_.first_unknown == first_unknown_ && pattern_.track_of == problem.track_of;
    if (!fits) pattern_ = {};
    if (!fits && unknowns_ > 0) set_pattern();
}

NewtonSystem::~NewtonSystem()
{
    if (kept_) *kept_ = std::move(pattern_);
}

Index NewtonSystem::unknowns_of(Index v) const
{
    return problem_.mobility[v] == Mobility::free ? 2 : problem_.mobility[v] == Mobility::held ? 0 : 1;
}

/// Whether unknowns that many faces share move the face's corners.
bool NewtonSystem::is_shared(Eigen::Index f) const
{
    if (!problem_.periods.empty() && problem_.lift[f] != CornerLifts::value_type{}) return true;
    const auto row = problem_.triangles.row(f);
    return !problem_.tracks.empty() && (rides(row[0]) || rides(row[1]) || rides(row[2]));
}

/// All unknowns that move the corners of a face.
std::vector<NewtonSystem::Column> NewtonSystem::columns(Eigen::Index f) const
{
    std::vector<Column> result;
    for (int k = 0; k < 3; ++k) {
        // A corner beyond a seam moves with the periods. The first period keeps its direction.
        for (std::size_t j = 0; j < problem_.periods.size(); ++j) {
            const int times = problem_.lift[f][k][j];
            if (times == 0) continue;
            const Index first = first_of_period_[j];
            if (j == 0) {
                result.push_back({first, k, times * vector(problem_.periods[0] / std::abs(problem_.periods[0]))});
                continue;
            }
            result.push_back({first, k, times * Eigen::Vector2d::UnitX()});
            result.push_back({first + 1, k, times * Eigen::Vector2d::UnitY()});
        }
        // A free vertex has two unknowns.
        const Index v = problem_.triangles(f, k), first = first_unknown_[v];
        if (first < 0) continue;
        if (problem_.mobility[v] == Mobility::free) {
            result.push_back({first, k, Eigen::Vector2d::UnitX()});
            result.push_back({first + 1, k, Eigen::Vector2d::UnitY()});
            continue;
        }
        // A vertex on a line or circle has one, along it, and moves with the centre and the radius if these are free.
        const Eigen::Vector2d along = tangent(v);
        result.push_back({first, k, along});
        if (!rides(v)) continue;
        const Index shared = first_of_track_[problem_.track_of[v]];
        if (track_of(v).straight) {
            result.push_back({shared, k, normal_of(along)});
            continue;
        }
        result.push_back({shared, k, Eigen::Vector2d::UnitX()});
        result.push_back({shared + 1, k, Eigen::Vector2d::UnitY()});
        result.push_back({shared + 2, k, normal_of(along)});
    }
    return result;
}

/// Sets the lower triangle of the Hessian, with the columns and rows of a vertex side by side. Notes for each two
/// corners of a face where the rows of the later one begin in the first column of the other.
void NewtonSystem::set_pattern()
{
    std::vector<std::pair<Index, Index>> pairs;  // (vertex or track of the column, of the row), by first unknowns
    std::vector<Index> width_of(unknowns_, 0);
    for (Eigen::Index v = 0; v < problem_.points.rows(); ++v)
        if (first_unknown_[v] >= 0) width_of[first_unknown_[v]] = unknowns_of(v);
    for (std::size_t i = 0; i < problem_.tracks.size(); ++i)
        width_of[first_of_track_[i]] = problem_.tracks[i].unknowns();
    for (std::size_t j = 0; j < problem_.periods.size(); ++j) width_of[first_of_period_[j]] = j == 0 ? 1 : 2;
    for (Index i = 0; i < unknowns_; ++i)
        if (width_of[i] > 0) pairs.emplace_back(i, i);
    for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
        for (int k = 0; k < 3; ++k)
            if (const auto [a, b] = ends(f, k); a >= 0) pairs.emplace_back(a, b);
        if (is_shared(f)) add_shared_pairs(f, pairs);
    }
    sort_in_buckets(pairs, unknowns_);
    std::vector<Index> rows, outer{0}, below;
    for (auto pair = pairs.begin(); pair != pairs.end();) {
        const Index column = pair->first;
        below.clear();
        for (; pair != pairs.end() && pair->first == column; ++pair)
            for (Index r = 0; r < width_of[pair->second]; ++r) below.push_back(pair->second + r);
        for (Index c = 0; c < width_of[column]; ++c) {
            rows.insert(rows.end(), below.begin() + c, below.end());
            outer.push_back(static_cast<Index>(rows.size()));
        }
    }
    pattern_.first_unknown = first_unknown_;
    pattern_.track_of = problem_.track_of;
    pattern_.hessian.resize(unknowns_, unknowns_);
    pattern_.hessian.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
    std::ranges::copy(outer, pattern_.hessian.outerIndexPtr());
    std::ranges::copy(rows, pattern_.hessian.innerIndexPtr());
    for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
        std::array<Index, 3> places{-1, -1, -1};
        for (int k = 0; k < 3; ++k)
            if (const auto [column, row] = ends(f, k); column >= 0) {
                const auto begin = rows.begin() + outer[column], end = rows.begin() + outer[column + 1];
                places[k] = static_cast<Index>(std::lower_bound(begin, end, row) - begin);
            }
        pattern_.places.push_back(places);
    }
}

/// Pairs the tracks and periods of a face with its vertices and with each other.
void NewtonSystem::add_shared_pairs(Eigen::Index f, std::vector<std::pair<Index, Index>>& pairs) const
{
    std::vector<Index> shared;
    for (int k = 0; k < 3; ++k) {
        if (const Index v = problem_.triangles(f, k); rides(v)) shared.push_back(first_of_track_[problem_.track_of[v]]);
        for (std::size_t j = 0; j < problem_.periods.size(); ++j)
            if (problem_.lift[f][k][j] != 0) shared.push_back(first_of_period_[j]);
    }
    for (const Index own : shared) {
        for (const Index other : problem_.triangles.row(f))
            if (first_unknown_[other] >= 0) pairs.emplace_back(first_unknown_[other], own);
        for (const Index other : shared) pairs.emplace_back(std::minmax(own, other));
    }
}

/// The first unknowns of the corners k and k + 1 of a face, the lower one first; -1 if one of them is held.
std::pair<Index, Index> NewtonSystem::ends(Eigen::Index f, int k) const
{
    const Index a = first_unknown_[problem_.triangles(f, k)];
    const Index b = first_unknown_[problem_.triangles(f, (k + 1) % 3)];
    if (a < 0 || b < 0) return {-1, -1};
    return std::minmax(a, b);
}

/// The direction in which a sliding or riding vertex moves.
Eigen::Vector2d NewtonSystem::tangent_now(Index v) const
{
    if (rides(v)) return vector(track_of(v).along({problem_.points(v, 0), problem_.points(v, 1)}));
    const Circle& circle = problem_.circles[v];
    const Eigen::Vector2d arm(problem_.points(v, 0) - circle.center.real(),
                              problem_.points(v, 1) - circle.center.imag());
    return Eigen::Vector2d(-arm[1], arm[0]) / arm.norm();
}

/// Adds a block to the Hessian. @param place of its rows in the first column
void NewtonSystem::add(Index column_vertex, Index row_vertex, Index place, const Eigen::Matrix2d& block)
{
    const Index first = first_unknown_[column_vertex];
    double* const values = pattern_.hessian.valuePtr();
    const Index* const outer = pattern_.hessian.outerIndexPtr();
    const bool wide = problem_.mobility[column_vertex] == Mobility::free;
    const bool high = problem_.mobility[row_vertex] == Mobility::free;
    const bool own = column_vertex == row_vertex;
    if (wide && high) {
        values[outer[first] + place] += block(0, 0);
        values[outer[first] + place + 1] += block(1, 0);
        if (!own) values[outer[first + 1] + place - 1] += block(0, 1);
        values[outer[first + 1] + place] += block(1, 1);
    } else if (wide) {
        const Eigen::RowVector2d row = tangent(row_vertex).transpose() * block;
        values[outer[first] + place] += row[0];
        values[outer[first + 1] + place - 1] += row[1];
    } else if (high) {
        const Eigen::Vector2d column = block * tangent(column_vertex);
        values[outer[first] + place] += column[0];
        values[outer[first] + place + 1] += column[1];
    } else {
        values[outer[first] + place] += tangent(row_vertex).dot(block * tangent(column_vertex));
    }
}

/// Adds a face that is_shared, with a search for its entries.
void NewtonSystem::add_by_columns(Eigen::Index f, const FaceDerivatives& face, const WantedShape& shape)
{
    const std::vector<Column> all = columns(f);
    for (int k = 0; k < 3; ++k)
        if (const Index v = problem_.triangles(f, k); rides(v))
            outward_force_[v] -= vector(face.gradient[k]).dot(normal_of(tangent(v)));
    double* const values = pattern_.hessian.valuePtr();
    const Index* const outer = pattern_.hessian.outerIndexPtr();
    const Index* const inner = pattern_.hessian.innerIndexPtr();
    for (const Column& column : all) {
        gradient_[column.unknown] += column.way.dot(vector(face.gradient[column.corner]));
        for (const Column& row : all) {
            if (row.unknown < column.unknown) continue;
            const Index* const end = inner + outer[column.unknown + 1];
            const Index* const at = std::lower_bound(inner + outer[column.unknown], end, row.unknown);
            values[at - inner] += row.way.dot(face.block(row.corner, column.corner, shape) * column.way);
        }
    }
}

void NewtonSystem::clear()
{
    gradient_ = VectorXd::Zero(unknowns_);
    std::fill_n(pattern_.hessian.valuePtr(), pattern_.hessian.nonZeros(), 0.0);
    for (Index v = 0; v < static_cast<Index>(tangents_.size()); ++v) {
        const bool slides = problem_.mobility[v] == Mobility::sliding;
        if (slides || rides(v)) tangents_[v] = tangent_now(v);
        if (slides) angle_[v] = std::arg(complex_at(problem_.points, v) - problem_.circles[v].center);
    }
    outward_force_.assign(problem_.bends ? first_unknown_.size() : problem_.track_of.size(), 0.0);
}

void NewtonSystem::add_face(Eigen::Index f, const FaceDerivatives& face, const WantedShape& shape)
{
    if (is_shared(f)) {
        add_by_columns(f, face, shape);
        return;
    }
    for (int k = 0; k < 3; ++k) {
        const Index v = problem_.triangles(f, k), first = first_unknown_[v];
        if (first < 0) continue;
        const Eigen::Vector2d g = vector(face.gradient[k]);
        if (problem_.mobility[v] == Mobility::free)
            gradient_.segment<2>(first) += g;
        else
            gradient_[first] += g.dot(tangent(v));
        if (problem_.bends && problem_.mobility[v] == Mobility::sliding)
            outward_force_[v] -= g.dot(normal_of(tangent(v)));
        add(v, v, 0, face.block(k, k, shape));
        if (pattern_.places[f][k] < 0) continue;
        const int l = (k + 1) % 3, column = first < first_unknown_[problem_.triangles(f, l)] ? k : l;
        const int row = k + l - column;
        add(problem_.triangles(f, column), problem_.triangles(f, row), pattern_.places[f][k],
            face.block(row, column, shape));
    }
}

void NewtonSystem::add_vertex(Index vertex, const Eigen::Vector2d& gradient, const Eigen::Matrix2d& hessian)
{
    gradient_.segment<2>(first_unknown_[vertex]) += gradient;
    add(vertex, vertex, 0, hessian);
}

void NewtonSystem::add_bends()
{
    for (Index v = 0; v < static_cast<Index>(outward_force_.size()); ++v) {
        const bool slides = problem_.bends && problem_.mobility[v] == Mobility::sliding;
        if (!slides && !(rides(v) && !track_of(v).straight)) continue;
        const Circle& circle = slides ? problem_.circles[v] : track_of(v).circle;
        pattern_.hessian.valuePtr()[pattern_.hessian.outerIndexPtr()[first_unknown_[v]]] +=
            std::max(outward_force_[v], 0.0) / circle.radius;
    }
}

std::pair<VectorXd, double> NewtonSystem::descent()
{
    return newton_descent(pattern_.hessian, gradient_, shift, pattern_.solver);  // tracks without riders have only 0
}

FoldoverPlaces NewtonSystem::moved(const VectorXd& step, double share) const
{
    // Lines, circles and periods first: the vertices on them are carried along.
    FoldoverPlaces result = problem_;
    for (std::size_t i = 0; i < result.tracks.size(); ++i)
        result.tracks[i] = problem_.tracks[i].moved(step.data() + first_of_track_[i], share);
    for (std::size_t j = 0; j < result.periods.size(); ++j) {
        const Index first = first_of_period_[j];
        result.periods[j] += share * (j == 0 ? step[first] * result.periods[0] / std::abs(result.periods[0])
                                             : Complex(step[first], step[first + 1]));
    }
    for (Eigen::Index v = 0; v < result.points.rows(); ++v) {
        const Index first = first_unknown_[v];
        if (first < 0) continue;
        if (problem_.mobility[v] == Mobility::free) {
            result.points.row(v) += share * step.segment<2>(first).transpose();
            continue;
        }
        Complex image;
        if (rides(v)) {
            image = track_of(v).carried(complex_at(result.points, v), share * step[first],
                                        result.tracks[problem_.track_of[v]]);
        } else {
            const Circle& circle = problem_.circles[v];
            const double turn = share * step[first] / circle.radius;
            image = circle.center + std::polar(circle.radius, angle_[v] + turn);
        }
        result.points.row(v) << image.real(), image.imag();
    }
    return result;
}

}  // namespace koebe
