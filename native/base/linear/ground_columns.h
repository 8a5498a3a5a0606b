// The columns of a Laplacian at grounded boundary vertices.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// The columns of K at some boundary vertices. For values at these vertices they give the load on the other vertices.
/// As K is symmetric, they also give the flux that arrives at these vertices.
class GroundColumns {
public:
    GroundColumns() = default;
    GroundColumns(const SparseMatrix& laplacian, std::vector<Index> vertices);

    /// Takes the same columns of another Laplacian.
    void renew(const SparseMatrix& laplacian);

    const std::vector<Index>& vertices() const { return vertices_; }
    Index size() const { return static_cast<Index>(vertices_.size()); }

    /// -K z, and z itself on these vertices: (V, C). Sums follow the vertices' numbers. @param values (g, C) z
    MatrixXd load(const MatrixXd& values) const;
    /// -K u on these vertices. @param u (V)
    VectorXd flux(const VectorXd& u) const;

private:
    std::vector<Index> vertices_;
    SparseMatrix columns_;
};

}  // namespace koebe
