// The functions that define the module, by subject.
#pragma once

#include <pybind11/pybind11.h>

namespace koebe::python {

/// uniformize, uniformize_with_cuts, open_surface, their options, and types that all calls share.
void bind_uniformize(pybind11::module_& m);
/// A surface that is mapped in several shapes, and a map that is made more or less even again and again.
void bind_shared(pybind11::module_& m);
/// Maps to domains other than the disk, and to parts.
void bind_domains(pybind11::module_& m);

/// Single steps: loops, holes, triangles, harmonic, disk and annulus maps, distortion; disks, mirrors.
void bind_steps(pybind11::module_& m);

// Of the extra making: patterns on surfaces, and patterns to sew.
void bind_lift(pybind11::module_& m);
void bind_flatten(pybind11::module_& m);

// Of the extra labs: conformal modules and alignments of circle domains, points carried; maps to given circle domains.
void bind_shapes(pybind11::module_& m);
void bind_fit(pybind11::module_& m);
/// Planar domains, to ten digits.
void bind_planar(pybind11::module_& m);

}  // namespace koebe::python
