// The array types of the library's interfaces.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <cstdint>
#include <vector>

namespace koebe {

using Index = std::int32_t;
using Complex = std::complex<double>;

/// (V, 3) positions, row-major, in the unit of the input.
using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// (F, 3) vertex indices, row-major, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<Index, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// (V, 2) planar positions, row-major.
using PlanarPoints = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

using VertexLoop = std::vector<Index>;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

}  // namespace koebe
