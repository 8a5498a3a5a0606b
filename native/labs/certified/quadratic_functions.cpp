#include "certified/quadratic_functions.h"

#include "core/connectivity.h"

namespace koebe {
namespace {

using Row = std::array<double, 6>;  // of the coefficients of corners 0, 1, 2 and edges 0, 1, 2

/// The derivative in the middle of edge m along edge k: a function is linear plus coefficient times 4 l_j l_j+1 for
/// each edge j, l the barycentric coordinates.
constexpr Row derivative(int m, int k)
{
    Row row{};
    row[(k + 1) % 3] = 1.0;
    row[k] = -1.0;
    const auto coordinate = [&](int corner) { return corner == m || corner == (m + 1) % 3 ? 0.5 : 0.0; };
    const auto change = [&](int corner) { return corner == k ? -1.0 : corner == (k + 1) % 3 ? 1.0 : 0.0; };
    for (int j = 0; j < 3; ++j) {
        const int next = (j + 1) % 3;
        row[3 + j] = 4.0 * (coordinate(j) * change(next) + coordinate(next) * change(j));
    }
    return row;
}

constexpr auto derivatives = [] {
    std::array<std::array<Row, 3>, 3> all{};
    for (int m = 0; m < 3; ++m)
        for (int k = 0; k < 3; ++k) all[m][k] = derivative(m, k);
    return all;
}();

}  // namespace

QuadraticFunctions::QuadraticFunctions(const BisectedSurface& surface)
    : surface_(surface), edge_(surface.twin().size()), size_(surface.vertex_count())
{
    for (std::size_t h = 0; h < edge_.size(); ++h) {
        const Index twin = surface.twin()[h];
        edge_[h] = twin != no_twin && twin < static_cast<Index>(h) ? edge_[twin] : size_++;
    }
}

std::array<Index, 6> QuadraticFunctions::coefficients(Index f) const
{
    const Index* const corner = surface_.triangles().data() + 3 * f;
    return {corner[0], corner[1], corner[2], edge_[3 * f], edge_[3 * f + 1], edge_[3 * f + 2]};
}

SparseMatrix QuadraticFunctions::energy_matrix(const EdgeLengths& half_cotangents) const
{
    std::vector<Eigen::Triplet<double, Index>> entries;
    entries.reserve(36 * static_cast<std::size_t>(surface_.face_count()));
    for (Index f = 0; f < surface_.face_count(); ++f) {
        Eigen::Matrix<double, 6, 6> local = Eigen::Matrix<double, 6, 6>::Zero();
        for (const auto& middle : derivatives)
            for (int k = 0; k < 3; ++k) {
                const Eigen::Map<const Eigen::Matrix<double, 6, 1>> row(middle[k].data());
                local += half_cotangents(f, k) / 3.0 * row * row.transpose();
            }
        const auto at = coefficients(f);
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) entries.emplace_back(at[i], at[j], local(i, j));
    }
    SparseMatrix matrix(size_, size_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

VectorXd QuadraticFunctions::load(const EdgeLengths& half_cotangents, const OneForm& form) const
{
    VectorXd load = VectorXd::Zero(size_);
    for (Index f = 0; f < surface_.face_count(); ++f) {
        const auto at = coefficients(f);
        for (const auto& middle : derivatives)
            for (int k = 0; k < 3; ++k)
                for (int i = 0; i < 6; ++i) load[at[i]] -= half_cotangents(f, k) / 3.0 * form[3 * f + k] * middle[k][i];
    }
    return load;
}

std::array<Interval, 2> QuadraticFunctions::covector(const VectorXd& function, const OneForm* form, Index f,
                                                     int m) const
{
    const auto at = coefficients(f);
    std::array<Interval, 2> along;
    for (int i = 0; i < 2; ++i) {
        const int k = 2 * i;  // edge 0 leaves corner 0, edge 2 comes to it
        Interval sum = Interval(function[at[(k + 1) % 3]]) - function[at[k]];
        for (int j = 3; j < 6; ++j)
            if (derivatives[m][k][j] != 0.0) sum = sum + Interval(derivatives[m][k][j]) * function[at[j]];
        if (form != nullptr) sum = sum + (*form)[3 * f + k];
        along[i] = i == 0 ? sum : -sum;
    }
    return along;
}

}  // namespace koebe
