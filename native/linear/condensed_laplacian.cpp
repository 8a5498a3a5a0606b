#include "linear/condensed_laplacian.h"

#include "core/errors.h"
#include "core/thread_share.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace koebe {

namespace {

constexpr std::size_t columns_at_a_time = 32768;  // columns of a thread
constexpr double stiffness = 1e20;  // over the largest diagonal entry: 1 over it is nothing beside rounding

/// K on the interior, the unit matrix where something is cut off, nothing between them; 1 more on the diagonal of what
/// is kept to the end. The pattern does not depend on the values.
SparseMatrix shifted_and_cut(const SparseMatrix& laplacian, const std::vector<char>& is_cut,
                             const std::vector<Index>& kept)
{
    std::vector<char> is_kept(laplacian.rows(), 0);
    for (const Index v : kept) is_kept[v] = 1;
    SparseMatrix result(laplacian.rows(), laplacian.cols());
    Index* const begin = result.outerIndexPtr();
    const auto each_column = [&](const auto& work) {
        in_pieces(is_cut.size(), columns_at_a_time, [&](std::size_t from, std::size_t until) {
            for (Index column = static_cast<Index>(from); column < static_cast<Index>(until); ++column) work(column);
        });
    };
    each_column([&](Index column) {
        Index count = is_cut[column] ? 1 : 0;
        if (!is_cut[column])
            for (SparseMatrix::InnerIterator it(laplacian, column); it; ++it) count += is_cut[it.row()] ? 0 : 1;
        begin[column + 1] = count;
    });
    for (std::size_t column = 0; column < is_cut.size(); ++column) begin[column + 1] += begin[column];
    result.resizeNonZeros(begin[is_cut.size()]);
    each_column([&](Index column) {
        Index* row = result.innerIndexPtr() + begin[column];
        double* value = result.valuePtr() + begin[column];
        if (is_cut[column]) {
            *row = column;
            *value = 1.0;
            return;
        }
        for (SparseMatrix::InnerIterator it(laplacian, column); it; ++it)
            if (!is_cut[it.row()]) {
                *row++ = static_cast<Index>(it.row());
                *value++ = it.value() + (is_kept[column] && it.row() == column ? 1.0 : 0.0);
            }
    });
    return result;
}

/// The lower triangle of K cut off at the first loop, with an entry between any two vertices of each other loop.
SparseMatrix with_room_for_disks(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops)
{
    constexpr Index none = -1, first = 0;
    std::vector<Index> loop_of(laplacian.rows(), none);
    std::vector<std::vector<Index>> sorted = loops;
    std::ptrdiff_t entries = laplacian.nonZeros();
    for (std::size_t k = 0; k < loops.size(); ++k) {
        for (const Index v : loops[k]) loop_of[v] = static_cast<Index>(k);
        std::sort(sorted[k].begin(), sorted[k].end());
        entries += static_cast<std::ptrdiff_t>(loops[k].size() * loops[k].size());
    }
    SparseMatrix result(laplacian.rows(), laplacian.cols());
    result.reserve(entries);
    for (Index v = 0; v < static_cast<Index>(laplacian.cols()); ++v) {
        result.startVec(v);
        if (loop_of[v] == first) {
            result.insertBack(v, v) = 1.0;
            continue;
        }
        auto room = sorted[first].end();
        const auto end = loop_of[v] == none ? room : sorted[loop_of[v]].end();
        if (loop_of[v] != none) room = std::lower_bound(sorted[loop_of[v]].begin(), end, v);
        for (SparseMatrix::InnerIterator it(laplacian, v); it; ++it) {
            const Index row = static_cast<Index>(it.row());
            if (row < v || loop_of[row] == first) continue;
            for (; room != end && *room < row; ++room) result.insertBack(*room, v) = 0.0;
            if (room != end && *room == row) ++room;
            result.insertBack(row, v) = it.value();
        }
        for (; room != end; ++room) result.insertBack(*room, v) = 0.0;
    }
    result.finalize();
    return result;
}

}  // namespace

struct CondensedLaplacian::Impl {
    SparseMatrix ground_columns;  // of K, which are its rows too
    double largest_diagonal = 0.0;
    Index vertex_count = 0;
    std::vector<Index> ground, kept;           // the two parts of the boundary, in the factor's order
    std::vector<std::vector<Index>> loops;     // without Sigma
    std::unique_ptr<SparseCholesky> cholesky;  // of K + diag(0, 1 where kept), 1 in the place of what is cut off
    std::vector<MatrixXd> stiff;               // without Sigma: in place of the disks they hold the loops at 0
    bool is_filled = false;                    // the factor is of disks
    std::vector<Index> row;                    // of each kept vertex in the factor's order, where that is another

    void take_ground_columns(const SparseMatrix& laplacian)
    {
        if (ground.empty()) return;
        largest_diagonal = laplacian.diagonal().maxCoeff();
        SparseMatrix columns(laplacian.rows(), static_cast<Eigen::Index>(ground.size()));
        for (std::size_t i = 0; i < ground.size(); ++i) {
            columns.startVec(static_cast<Eigen::Index>(i));
            for (SparseMatrix::InnerIterator it(laplacian, ground[i]); it; ++it)
                columns.insertBack(it.row(), static_cast<Eigen::Index>(i)) = it.value();
        }
        columns.finalize();
        ground_columns.swap(columns);
    }

    /// What is factored of a Laplacian, where there is a Sigma.
    SparseMatrix shifted(const SparseMatrix& matrix) const
    {
        std::vector<char> is_cut(vertex_count, 0);
        for (const Index v : ground) is_cut[v] = 1;
        return shifted_and_cut(matrix, is_cut, kept);
    }

    void take_stiffness()
    {
        const double value = stiffness * largest_diagonal;
        stiff.clear();
        for (std::size_t k = 1; k < loops.size(); ++k)
            stiff.push_back(value * MatrixXd::Identity(loops[k].size(), loops[k].size()));
        is_filled = true;
    }

    /// Rows in the factor's order as the boundary is given now.
    template <typename Matrix>
    Matrix as_given(Matrix rows) const
    {
        return row.empty() ? rows : Matrix(rows(row, Eigen::all));
    }

    MatrixXd as_factored(const MatrixXd& rows) const
    {
        if (row.empty()) return rows;
        MatrixXd result(rows.rows(), rows.cols());
        result(row, Eigen::all) = rows;
        return result;
    }

    /// -K z for values on the grounded part, and the values themselves there. Sums go by the number of the vertex.
    MatrixXd load(const MatrixXd& ground_values) const
    {
        std::vector<Index> order(ground.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::sort(order, {}, [&](Index i) { return ground[i]; });
        MatrixXd result = MatrixXd::Zero(vertex_count, ground_values.cols());
        for (const Index i : order)
            for (SparseMatrix::InnerIterator it(ground_columns, i); it; ++it)
                result.row(it.row()) -= it.value() * ground_values.row(i);
        result(ground, Eigen::all) = ground_values;
        return result;
    }

    /// -K u on the grounded part.
    VectorXd flux_to_ground(const VectorXd& u) const
    {
        VectorXd result = VectorXd::Zero(static_cast<Eigen::Index>(ground.size()));
        for (Index i = 0; i < static_cast<Index>(ground.size()); ++i)
            for (SparseMatrix::InnerIterator it(ground_columns, i); it; ++it) result[i] -= it.value() * u[it.row()];
        return result;
    }

    bool has_sigma() const { return stiff.empty(); }

    /// Solves K_II u_I = f_I; what comes on the boundary is not to be read. NaN if K_II is not positive definite.
    /// Without Sigma.
    MatrixXd solve_inside(MatrixXd f)
    {
        f(ground, Eigen::all).setZero();
        try {
            if (is_filled) cholesky->refactorize(stiff);
        } catch (const OutOfMemory&) {
            throw;
        } catch (const SolverError&) {
            return MatrixXd::Constant(f.rows(), f.cols(), std::numeric_limits<double>::quiet_NaN());
        }
        is_filled = false;
        std::vector<Index> all(vertex_count);
        std::iota(all.begin(), all.end(), 0);
        return cholesky->solve_for(all, f);
    }
};

CondensedLaplacian::CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<Index>& boundary,
                                       Index grounded)
    : impl_(std::make_unique<Impl>())
{
    impl_->vertex_count = static_cast<Index>(laplacian.rows());
    impl_->ground.assign(boundary.begin(), boundary.begin() + grounded);
    impl_->kept.assign(boundary.begin() + grounded, boundary.end());
    impl_->take_ground_columns(laplacian);
    impl_->cholesky = std::make_unique<SparseCholesky>(impl_->shifted(laplacian), impl_->kept);
}

CondensedLaplacian::CondensedLaplacian(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops)
    : impl_(std::make_unique<Impl>())
{
    impl_->vertex_count = static_cast<Index>(laplacian.rows());
    impl_->loops = loops;
    for (const std::vector<Index>& loop : loops) impl_->ground.insert(impl_->ground.end(), loop.begin(), loop.end());
    impl_->take_ground_columns(laplacian);
    impl_->cholesky = std::make_unique<SparseCholesky>(with_room_for_disks(laplacian, loops), loops[1],
                                                       std::vector(loops.begin() + 1, loops.end()));
    impl_->take_stiffness();
}

void CondensedLaplacian::renew(const SparseMatrix& laplacian)
{
    impl_->take_ground_columns(laplacian);
    if (has_sigma()) return impl_->cholesky->refactorize(impl_->shifted(laplacian));
    impl_->cholesky->refactorize(with_room_for_disks(laplacian, impl_->loops));
    impl_->take_stiffness();
}

CondensedLaplacian::~CondensedLaplacian() = default;
CondensedLaplacian::CondensedLaplacian(CondensedLaplacian&&) noexcept = default;
CondensedLaplacian& CondensedLaplacian::operator=(CondensedLaplacian&&) noexcept = default;

Index CondensedLaplacian::boundary_size() const
{
    return static_cast<Index>(impl_->ground.size() + impl_->kept.size());
}

bool CondensedLaplacian::reorder_boundary(const std::vector<Index>& boundary)
{
    if (!impl_->ground.empty()) return false;
    std::vector<Index> place(impl_->vertex_count, -1);
    for (std::size_t i = 0; i < impl_->kept.size(); ++i) place[impl_->kept[i]] = static_cast<Index>(i);
    impl_->row.clear();
    for (const Index v : boundary) impl_->row.push_back(place[v]);
    return true;
}

bool CondensedLaplacian::has_sigma() const { return impl_->has_sigma(); }

bool CondensedLaplacian::grounded() const { return impl_->has_sigma() && !impl_->ground.empty(); }

MatrixXd CondensedLaplacian::sigma() const
{
    MatrixXd result = impl_->cholesky->last_schur();
    result.diagonal().array() -= 1.0;
    return impl_->row.empty() ? result : MatrixXd(result(impl_->row, impl_->row));
}

MatrixXd CondensedLaplacian::load_of_grounded(const MatrixXd& values) const
{
    const MatrixXd load = impl_->load(values);
    return impl_->cholesky->flux_to_last(load) + load(impl_->kept, Eigen::all);
}

VectorXd CondensedLaplacian::flux_to_grounded(const VectorXd& values) const
{
    return impl_->flux_to_ground(impl_->cholesky->extend(values));
}

const SparseCholesky& CondensedLaplacian::fill(const std::vector<MatrixXd>& disks) const
{
    impl_->is_filled = true;
    impl_->cholesky->refactorize(disks);
    return *impl_->cholesky;
}

MatrixXd CondensedLaplacian::extend(const MatrixXd& boundary_values) const
{
    const Eigen::Index grounded = static_cast<Eigen::Index>(impl_->ground.size());
    if (grounded == 0) return impl_->cholesky->extend(impl_->as_factored(boundary_values));
    if (!has_sigma()) {
        MatrixXd result = impl_->solve_inside(impl_->load(boundary_values));
        result(impl_->ground, Eigen::all) = boundary_values;
        return result;
    }
    return impl_->cholesky->extend(boundary_values.bottomRows(boundary_values.rows() - grounded),
                                   impl_->load(boundary_values.topRows(grounded)));
}

InteriorSolution CondensedLaplacian::solve_interior(const VectorXd& load) const
{
    if (!has_sigma()) {
        VectorXd values = impl_->solve_inside(load);
        values(impl_->ground).setZero();
        return {values, impl_->flux_to_ground(values)};
    }
    VectorXd inner = load;
    inner(impl_->ground).setZero();
    auto [values, flux] = impl_->cholesky->solve_inner(inner);
    if (impl_->ground.empty()) return {std::move(values), impl_->as_given(std::move(flux))};
    VectorXd boundary_flux(boundary_size());
    boundary_flux << impl_->flux_to_ground(values), flux;
    return {std::move(values), std::move(boundary_flux)};
}

}  // namespace koebe
