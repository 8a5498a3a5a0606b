// Koebe UV for C++ programs: #include <koebe/koebe.h>, find_package(koebe), link koebe::koebe.
//
// Surfaces are (V, 3) positions and (F, 3) vertex indices (core/types.h); a map is (V, 2) points of the unit disk.
// The library never prints. Errors derive from koebe::KoebeError (core/errors.h).
#pragma once

#include "conformal/annulus_map.h"
#include "conformal/disk_map.h"
#include "core/errors.h"
#include "core/types.h"
#include "core/warning.h"
#include "cut/open_surface.h"
#include "execution/execution.h"
#include "holes/fair_filling.h"
#include "holes/fan_filling.h"
#include "lift/lift.h"
#include "lift/patterns.h"
#include "mesh/topology.h"
#include "opened/cut_uniformize.h"
#include "parts/parts.h"
#include "pipeline/surface_solver.h"
#include "pipeline/uniformize.h"
#include "quality/distortion.h"
#include "quality/verdict.h"
#include "schottky/schottky_map.h"
#include "shape/conformal_module.h"
#include "shape/domain_alignment.h"
#include "shape/loop_matching.h"
#include "shape/module_error.h"
#include "sphere/sphere_map.h"
#include "surface/harmonic_map.h"
#include "tiles/tile_map.h"
#include "transfer/correspondence.h"
#include "transfer/surface_point.h"
