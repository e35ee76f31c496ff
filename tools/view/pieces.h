// A drawing that is higher than a page, cut between its rows.
#pragma once
#include <vector>

#include "tools/view/layout.h"

namespace rung::view {

// Pieces of at most `most` pixels where the rows allow it, from top to bottom, with the coordinates of the whole; the
// drawing itself when it is not higher. Every shape is in one piece; vertical wires continue from piece to piece.
std::vector<Picture> piecesOf(const Picture& picture, int most);

} // namespace rung::view
