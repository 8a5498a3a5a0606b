// The columns of a Laplacian where the boundary is held.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// What values on some boundary vertices draw from the others, and what arrives at them: K's columns there, which are
/// its rows too.
class GroundColumns {
public:
    GroundColumns() = default;
    GroundColumns(const SparseMatrix& laplacian, std::vector<Index> vertices);

    /// The same columns of another Laplacian.
    void renew(const SparseMatrix& laplacian);

    const std::vector<Index>& vertices() const { return vertices_; }
    Index size() const { return static_cast<Index>(vertices_.size()); }

    /// -K z, and z itself on these vertices: (V, C). Sums go by the number of the vertex. @param values (g, C) z
    MatrixXd load(const MatrixXd& values) const;
    /// -K u on these vertices. @param u (V)
    VectorXd flux(const VectorXd& u) const;

private:
    std::vector<Index> vertices_;
    SparseMatrix columns_;
};

}  // namespace koebe
