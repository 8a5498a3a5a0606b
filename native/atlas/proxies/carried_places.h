// Where a piece of the fine surface lies in the plane, if it corresponds to a relaxed part of a proxy.
#pragma once

#include "execution/execution.h"
#include "proxies/near_faces.h"

namespace koebe {

/// Gives a piece the places in which its edges have, in the mean, the courses that the part's map would give them.
/// Where its loops cross there, they are held at the part's loops.
/// @param number of the part in the net @param piece its points are set
/// @return whether the piece is one to one, also as stored
bool take_places(const Proxy& proxy, const CoarseNet& net, const NearFaces& near, const FlatPart& part, int number,
                 FlatPart& piece, const ExecutionContext& context);

}  // namespace koebe
