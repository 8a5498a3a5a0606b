// The slits along which surfaces of genus 0 are opened.
#pragma once

#include "cut/seamed_mesh.h"

#include "core/types.h"

#include <vector>

namespace koebe {

/// Two edges that meet, for a surface without boundary: the shortest pair found by one look at each edge.
std::vector<Index> short_slit(const SeamedMesh& mesh);

/// The path along which a surface is opened, so that its boundary gets long.
///
/// Without boundary: a shortest path between two vertices far apart, each the farthest from another (two sweeps). With
/// loops: a path from the longest loop towards the farthest other loop, up to the first loop that it meets; without
/// another loop, to the farthest vertex.
/// @param mesh connected, of genus 0
/// @return half-edges in order, at least two without boundary; empty if no path is worth it
std::vector<Index> long_slit(const SeamedMesh& mesh);

}  // namespace koebe
