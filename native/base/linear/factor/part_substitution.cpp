#include "linear/factor/part_substitution.h"

namespace koebe::detail {
namespace {

/// C is the number of right-hand sides, if it is known at compile time.
template <int C>
class Columns {
public:
    using Values = Eigen::Matrix<double, C, Eigen::Dynamic>;

    Columns(const SupernodalFactor& l, MatrixXd& y) : l_(l), y_(y.data(), y.rows(), y.cols()) {}

    void forward(Index s)
    {
        gather(s);
        const int width = l_.width(s), height = l_.height(s);
        for (int j = 0; j < width; ++j) {
            const double* column = l_.values(s) + static_cast<std::ptrdiff_t>(j) * height;
            front_.col(j) /= column[j];
            for (int r = j + 1; r < height; ++r) front_.col(r) -= column[r] * front_.col(j);
        }
        for (int r = 0; r < height; ++r) y_.col(l_.rows_of(s)[r]) = front_.col(r);
    }

    void backward(Index s)
    {
        gather(s);
        const int width = l_.width(s), height = l_.height(s);
        for (int j = width - 1; j >= 0; --j) {
            const double* column = l_.values(s) + static_cast<std::ptrdiff_t>(j) * height;
            // Two sums, as each addition waits for the one before it.
            Eigen::Matrix<double, C, 1> even = front_.col(j), odd = Eigen::Matrix<double, C, 1>::Zero(front_.rows());
            int r = j + 1;
            for (; r + 1 < height; r += 2) {
                even -= column[r] * front_.col(r);
                odd -= column[r + 1] * front_.col(r + 1);
            }
            if (r < height) even -= column[r] * front_.col(r);
            front_.col(j) = (even + odd) / column[j];
            y_.col(l_.first[s] + j) = front_.col(j);
        }
    }

private:
    void gather(Index s)
    {
        const int height = l_.height(s);
        if (front_.cols() < height) front_ = Values(y_.rows(), height);
        for (int r = 0; r < height; ++r) front_.col(r) = y_.col(l_.rows_of(s)[r]);
    }

    const SupernodalFactor& l_;
    Eigen::Map<Values> y_;
    Values front_;
};

template <typename Visit>
void with_columns(const SupernodalFactor& l, MatrixXd& y, const Visit& visit)
{
    if (y.rows() == 1)
        visit(Columns<1>(l, y));
    else if (y.rows() == 2)
        visit(Columns<2>(l, y));
    else
        visit(Columns<Eigen::Dynamic>(l, y));
}

}  // namespace

std::vector<char> PartSubstitution::ways_from(const std::vector<Index>& rows) const
{
    std::vector<char> visited(l_.count(), 0);
    for (const Index v : rows)
        for (Index s = l_.supernode[l_.rank[v]]; !visited[s]; s = l_.parent(s)) visited[s] = 1;
    return visited;
}

MatrixXd PartSubstitution::forward(const MatrixXd& f) const
{
    MatrixXd y(f.cols(), f.rows());
    std::vector<Index> rows;
    for (Index v = 0; v < static_cast<Index>(f.rows()); ++v) {
        y.col(l_.rank[v]) = f.row(v).transpose();
        if ((f.row(v).array() != 0.0).any()) rows.push_back(v);
    }
    const std::vector<char> visited = ways_from(rows);
    with_columns(l_, y, [&](auto columns) {
        for (std::size_t s = 0; s < visited.size(); ++s)
            if (visited[s]) columns.forward(static_cast<Index>(s));
    });
    return y;
}

void PartSubstitution::backward(MatrixXd& y, const std::vector<Index>& wanted) const
{
    const std::vector<char> visited = ways_from(wanted);
    with_columns(l_, y, [&](auto columns) {
        for (std::size_t s = visited.size(); s-- > 0;)
            if (visited[s]) columns.backward(static_cast<Index>(s));
    });
}

}  // namespace koebe::detail
