// Holomorphic 1-forms with simple poles at marked points of a circle domain.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <array>
#include <vector>

namespace koebe {

/// Each form is imaginary along all rims.
struct MarkedForms {
    Eigen::MatrixXcd forms;                   ///< (F, forms)
    std::vector<std::array<Index, 2>> poles;  ///< vertices of each form's simple poles; twice the same: one pole
};

/// (F, C) 2 du/dz of functions u (V, C) that are linear in each face; 0 in faces without area.
Eigen::MatrixXcd forms_of(const Triangles& triangles, const PlanarPoints& uv, const VectorXd& area, const MatrixXd& u);

/// For each mark inside the form of Green's function. For marks on rims, in the order of rims and angles, forms with
/// poles at two neighbours. If there are marks of both kinds, also a form with a pole at one of each. The parts with
/// poles are exact at the faces' centroids: those of the disk inside the outer circle, or outside a hole's circle. To
/// them are added harmonic functions that make them imaginary along the other rims, too.
/// @param middle a vertex far from rims @param area (F) 0 for faces to leave out @throws SolverError
MarkedForms marked_forms(const Triangles& triangles, const PlanarPoints& uv, const std::vector<Circle>& circles,
                         const std::vector<VertexLoop>& loops, const std::vector<Index>& marks, Index middle,
                         const VectorXd& area);

}  // namespace koebe
