// A slit that opens a surface.
#pragma once

#include "cut/seamed_mesh.h"

#include <vector>

namespace koebe {

/// The path along which a surface is opened, its boundary made long.
///
/// Without boundary: a shortest path between two vertices far apart, each the farthest of another (two sweeps). With
/// loops: one from the longest loop to the farthest other one, up to the first that it meets, or to the farthest
/// vertex where there is no other loop.
/// @param mesh connected, of genus 0
/// @return half-edges in its order, two at least where there is no boundary; none where no path is worth it
std::vector<Index> long_slit(const SeamedMesh& mesh);

/// Two edges that meet, for a surface without boundary: the shortest that are found by one look at each.
std::vector<Index> short_slit(const SeamedMesh& mesh);

}  // namespace koebe
