// A kernel whose 3D triangulations do not depend on memory addresses.
#pragma once

#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_3.h>
#include <CGAL/tags.h>

#include <cstddef>

namespace koebe {

/// CGAL's kernel under a name of its own, so that the class below can be specialized for it.
struct KernelOfAgedCells : CGAL::Exact_predicates_inexact_constructions_kernel {};

}  // namespace koebe

namespace CGAL {

/// A cell with a time stamp. CGAL names an edge by the least of the cells around it, and walks around it from there.
/// Without a stamp the least cell is the one of lowest address, which differs from call to call.
template <class Base>
class Delaunay_triangulation_cell_base_3<koebe::KernelOfAgedCells, Base> : public Base {
public:
    using Has_timestamp = Tag_true;
    template <class Structure>
    struct Rebind_TDS {  // NOLINT(readability-identifier-naming): CGAL asks for it by this name
        using Other = Delaunay_triangulation_cell_base_3<koebe::KernelOfAgedCells,
                                                         typename Base::template Rebind_TDS<Structure>::Other>;
    };
    using Base::Base;
    std::size_t time_stamp() const { return age_; }
    void set_time_stamp(std::size_t age) { age_ = age; }

private:
    std::size_t age_ = static_cast<std::size_t>(-1);
};

}  // namespace CGAL
