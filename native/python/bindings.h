// The module's definitions, by subject.
#pragma once

#include <pybind11/pybind11.h>

namespace koebe::python {

/// uniformize, uniformize_with_cuts, open_surface, their options, and what all calls share.
void bind_uniformize(pybind11::module_& m);
/// A surface that is mapped in several shapes.
void bind_surface(pybind11::module_& m);
/// Maps to domains that are no disk, and to parts.
void bind_domains(pybind11::module_& m);
/// Single steps: loops, holes, triangles, harmonic, disk and annulus maps, distortion.
void bind_steps(pybind11::module_& m);
/// What circles tell: conformal modules, one domain over another; disks in a square; mirror images.
void bind_shapes(pybind11::module_& m);

}  // namespace koebe::python
