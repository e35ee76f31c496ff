// Cutting at the breaks that the layout names (see pieces.h).
#include "tools/view/pieces.h"

#include <algorithm>

namespace rung::view {
namespace {

// Tops of the pieces, and the end of the last.
std::vector<int> edgesOf(const Picture& picture, int most) {
  std::vector<int> edges{picture.top};
  int last = picture.top; // the last break that was seen
  for (int at : picture.breaks) {
    if (at - edges.back() > most && last > edges.back()) edges.push_back(last);
    last = at;
  }
  const int end = picture.top + picture.height;
  if (end - edges.back() > most && last > edges.back()) edges.push_back(last);
  edges.push_back(end);
  return edges;
}

class Cutter {
public:
  explicit Cutter(const std::vector<int>& edges) : edges_(edges), pieces_(edges.size() - 1) {}

  std::vector<Picture> run(const Picture& picture) {
    for (size_t i = 0; i < pieces_.size(); ++i) {
      pieces_[i].width = picture.width;
      pieces_[i].rail = picture.rail;
      pieces_[i].top = edges_[i];
      pieces_[i].height = edges_[i + 1] - edges_[i];
    }
    for (const Line& wire : picture.wires) addWire(wire);
    for (Point dot : picture.dots) at(dot.y).dots.push_back(dot);
    for (const Symbol& symbol : picture.symbols) at(symbol.left.y).symbols.push_back(symbol);
    for (const Frame& frame : picture.frames) at(frame.corner.y).frames.push_back(frame);
    for (const Halo& halo : picture.halos) at(halo.corner.y).halos.push_back(halo);
    for (const Text& text : picture.texts) at(text.at.y).texts.push_back(text);
    return std::move(pieces_);
  }

private:
  size_t indexAt(int y) const {
    const auto edge = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, y);
    return static_cast<size_t>(edge - edges_.begin()) - 1;
  }
  Picture& at(int y) { return pieces_[indexAt(y)]; }

  void addWire(const Line& wire) {
    for (size_t i = indexAt(wire.from.y); i <= indexAt(wire.to.y); ++i) {
      const int from = std::max(wire.from.y, edges_[i]);
      const int to = std::min(wire.to.y, edges_[i + 1]);
      pieces_[i].wires.push_back({{wire.from.x, from}, {wire.to.x, to}});
    }
  }

  const std::vector<int>& edges_;
  std::vector<Picture> pieces_;
};

} // namespace

std::vector<Picture> piecesOf(const Picture& picture, int most) {
  const std::vector<int> edges = edgesOf(picture, most);
  if (edges.size() == 2) return {picture};
  return Cutter(edges).run(picture);
}

} // namespace rung::view
