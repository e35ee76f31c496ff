// Checks of a drawing (see drawn.h).
#include "tests/unit/view/drawn.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ir/support/diag_render.h"
#include "tools/view/drawn_program.h"

namespace rung::view::test {
namespace {

using frontend::ladder::Element;
using frontend::ladder::ElementKind;

struct Box {
  int left, top, right, bottom;
};

Box boxOf(const Text& text) {
  const int width = widthOf(text.text, text.style);
  const int size = static_cast<int>(infoOf(text.style).size);
  const int left = text.anchor == Anchor::Start    ? text.at.x
                   : text.anchor == Anchor::Middle ? text.at.x - width / 2
                                                   : text.at.x - width;
  return {left, text.at.y - size * 8 / 10, left + width, text.at.y + size * 2 / 10};
}
Box boxOf(const Frame& frame) {
  return {frame.corner.x, frame.corner.y, frame.corner.x + frame.width, frame.corner.y + frame.height};
}
Box boxOf(const Symbol& symbol) {
  return {symbol.left.x, symbol.left.y - kSymbolHalf, symbol.left.x + symbol.width, symbol.left.y + kSymbolHalf};
}
bool meet(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}
bool inside(const Box& a, const Box& b) {
  return a.left >= b.left && a.right <= b.right && a.top >= b.top && a.bottom <= b.bottom;
}

// Elements in the order in which they stand in the source, as their shapes do.
std::vector<const Element*> inSource(const frontend::ladder::Rung& rung, bool boxes) {
  std::vector<const Element*> elements;
  for (const Element& element : rung.elements)
    if ((element.kind == ElementKind::Box) == boxes) elements.push_back(&element);
  std::sort(elements.begin(), elements.end(), [](const Element* a, const Element* b) {
    return std::pair(a->line, a->column) < std::pair(b->line, b->column);
  });
  return elements;
}

// Which points the wires join. A wire joins what lies on it; two wires that only cross are not joined.
class Joined {
public:
  explicit Joined(const Picture& picture) : picture_(picture), parent_(picture.wires.size() + 1) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
    for (size_t i = 0; i < picture.wires.size(); ++i) {
      for (size_t k = 0; k < i; ++k) {
        const Line& a = picture.wires[i];
        const Line& b = picture.wires[k];
        if (on(a.from, b) || on(a.to, b) || on(b.from, a) || on(b.to, a)) unite(i, k);
      }
      if (picture.wires[i].from.x == kLeft) unite(i, picture.wires.size());
    }
    for (const Jump& jump : picture.jumps) unite(at(jump.from), at(jump.to));
  }
  // The net of a point; the left rail is the last one. Throws the reader off when no wire ends there.
  size_t netAt(Point point) {
    if (point.x == kLeft) return find(picture_.wires.size());
    return find(at(point));
  }
  bool has(Point point) const {
    return std::any_of(picture_.wires.begin(), picture_.wires.end(), [&](const Line& line) { return on(point, line); });
  }
  size_t rail() { return find(picture_.wires.size()); }
  bool crossed() const {
    for (const Line& a : picture_.wires)
      for (const Line& b : picture_.wires)
        if (a.from.y == a.to.y && b.from.x == b.to.x && a.from.x < b.from.x && b.from.x < a.to.x &&
            b.from.y < a.from.y && a.from.y < b.to.y)
          return true;
    return false;
  }

private:
  static bool on(Point p, const Line& line) {
    return p.x >= line.from.x && p.x <= line.to.x && p.y >= line.from.y && p.y <= line.to.y;
  }
  size_t at(Point point) const {
    for (size_t i = 0; i < picture_.wires.size(); ++i)
      if (on(point, picture_.wires[i])) return i;
    ADD_FAILURE() << "no wire at " << point.x << "," << point.y;
    return 0;
  }
  size_t find(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(size_t a, size_t b) { parent_[find(a)] = find(b); }

  const Picture& picture_;
  std::vector<size_t> parent_;
};

// Nets of the source and of the drawing, each of one the same as one of the other.
class SameNets {
public:
  void add(uint32_t source, size_t drawn, const std::string& what) {
    const auto [a, freshA] = drawnOf_.emplace(source, drawn);
    const auto [b, freshB] = sourceOf_.emplace(drawn, source);
    if (a->second != drawn) wrong_ += what + " is cut off\n";
    if (b->second != source) wrong_ += what + " is joined to another net\n";
  }
  std::string wrong() const { return wrong_; }

private:
  std::map<uint32_t, size_t> drawnOf_;
  std::map<size_t, uint32_t> sourceOf_;
  std::string wrong_;
};

// Heights at which wires end at the left or right side of a box.
std::vector<int> portsOf(const Picture& picture, const Frame& frame, bool left) {
  const int x = frame.corner.x + (left ? 0 : frame.width);
  std::set<int> ports;
  for (const Line& wire : picture.wires) {
    const Point end = left ? wire.to : wire.from;
    if (wire.from.y == wire.to.y && end.x == x && end.y > frame.corner.y && end.y < frame.corner.y + frame.height)
      ports.insert(end.y);
  }
  return {ports.begin(), ports.end()};
}

} // namespace

namespace {

std::unique_ptr<Drawn> drawProgram(std::unique_ptr<Drawn> drawn, const std::vector<FileId>& files) {
  const frontend::Dialect& dialect = *frontend::dialectOf(drawn->sources, files[0]);
  auto program = drawnProgram(drawn->sources, files, dialect, {}, drawn->diagnostics);
  EXPECT_TRUE(program) << renderText(drawn->diagnostics, drawn->sources, {}) << drawn->sources.text(files[0]);
  if (!program) return nullptr;
  drawn->program = std::move(*program);
  drawn->module = dialect.compile(drawn->sources, files, {}, drawn->diagnostics);
  if (dialect.findBox == nullptr) return drawn;
  FileId first = files[0];
  const auto checked = dialect.check(drawn->sources, files, {}, drawn->diagnostics);
  if (const auto networks = checked->networks())
    first = frontend::network::ladderForm(networks->language, drawn->sources, networks->files, drawn->diagnostics)
                ->files[0];
  drawn->ladders.push_back(frontend::ladder::parseLadder(drawn->sources, first, drawn->diagnostics, dialect.findBox));
  return drawn;
}

} // namespace

std::unique_ptr<Drawn> draw(const std::string& name, const std::string& text) {
  auto drawn = std::make_unique<Drawn>();
  const FileId file = drawn->sources.addBuffer(name, text);
  return drawProgram(std::move(drawn), {file});
}

std::unique_ptr<Drawn> drawFiles(const std::vector<std::string>& paths) {
  auto drawn = std::make_unique<Drawn>();
  std::vector<FileId> files;
  for (const std::string& path : paths) {
    const Result<FileId> file = drawn->sources.addFile(path);
    EXPECT_TRUE(file.ok()) << path << ": run in the root of the repository";
    if (!file.ok()) return nullptr;
    files.push_back(file.value());
  }
  return drawProgram(std::move(drawn), files);
}

std::unique_ptr<Drawn> drawRung(const std::string& drawing) {
  return draw("t.lad", "dialect nct\nmodule MAIN\nrung\n" + drawing);
}

void expectSameNumbers(const Drawn& drawn) {
  size_t compared = 0;
  for (const ir::Routine& routine : drawn.module->routines) {
    for (const ir::Rung& rung : routine.rungs) {
      if (rung.number == 0) continue;
      ASSERT_LE(rung.number, drawn.program.figures.size());
      const Figure& figure = drawn.program.figures[rung.number - 1];
      EXPECT_EQ(figure.number, rung.number);
      EXPECT_EQ(figure.title, rung.title) << "rung " << rung.number;
      EXPECT_EQ(figure.place.line, rung.begin.line) << "rung " << rung.number;
      EXPECT_EQ(drawn.module->files[rung.begin.file.index], drawn.program.files[figure.place.file].path)
          << "rung " << rung.number;
      ++compared;
    }
  }
  EXPECT_GE(compared, drawn.program.figures.size() * 9 / 10); // all that is run, and most of a machine's program is
  uint32_t last = 0;
  for (const Block& block : drawn.program.blocks)
    if (block.kind == Block::Kind::Rung) EXPECT_EQ(drawn.program.figures[block.figure].number, ++last);
  EXPECT_EQ(last, drawn.program.figures.size());
}

std::string wrongTexts(const frontend::ladder::Rung& rung, const Picture& picture) {
  std::multiset<std::string> wanted;
  std::multiset<std::string> found;
  for (const Element& element : rung.elements) {
    if (element.kind == ElementKind::Box) wanted.insert("box " + std::string(element.mnemonic));
    for (const frontend::Word& word : rung.operandsOf(element)) wanted.insert(std::string(word.text));
  }
  wanted.erase("TABLE");
  wanted.erase("table");
  for (const Text& text : picture.texts) {
    if (text.style == Style::Title) found.insert("box " + text.text);
    if (text.style != Style::Name) continue;
    std::istringstream words(text.text); // several only in tables
    for (std::string word; words >> word;) found.insert(word);
  }
  std::string wrong;
  for (const std::string& text : wanted)
    if (found.count(text) != wanted.count(text))
      wrong += fmt::format("'{}' {} times instead of {}\n", text, found.count(text), wanted.count(text));
  if (found.size() != wanted.size()) wrong += fmt::format("{} texts instead of {}\n", found.size(), wanted.size());
  if (picture.symbols.size() != inSource(rung, false).size()) wrong += "other contacts or coils\n";
  if (picture.frames.size() != inSource(rung, true).size()) wrong += "other boxes\n";
  return wrong;
}

std::string overlaps(const Picture& picture) {
  std::string wrong;
  for (size_t i = 0; i < picture.texts.size(); ++i) {
    const Text& text = picture.texts[i];
    const Box box = boxOf(text);
    for (size_t k = 0; k < i; ++k)
      if (meet(box, boxOf(picture.texts[k])))
        wrong += fmt::format("'{}' lies on '{}'\n", text.text, picture.texts[k].text);
    for (const Frame& frame : picture.frames)
      if (meet(box, boxOf(frame)) && !inside(box, boxOf(frame))) wrong += fmt::format("'{}' on a side\n", text.text);
    for (const Symbol& symbol : picture.symbols)
      if (text.style != Style::Mark && meet(box, boxOf(symbol))) wrong += fmt::format("'{}' on a symbol\n", text.text);
  }
  std::vector<Box> solid;
  for (const Frame& frame : picture.frames) solid.push_back(boxOf(frame));
  for (const Symbol& symbol : picture.symbols) solid.push_back(boxOf(symbol));
  for (size_t i = 0; i < solid.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      if (meet(solid[i], solid[k])) wrong += "an element on another\n";
  for (const Line& wire : picture.wires)
    for (const Text& text : picture.texts)
      if (text.style != Style::Mark && meet(boxOf(text), {wire.from.x, wire.from.y, wire.to.x + 1, wire.to.y + 1}))
        wrong += fmt::format("a wire through '{}'\n", text.text);
  for (const Line& wire : picture.wires)
    for (const Box& box : solid)
      if (meet({wire.from.x, wire.from.y, wire.to.x + 1, wire.to.y + 1},
               {box.left + 1, box.top + 1, box.right, box.bottom}))
        wrong += fmt::format("a wire through an element at {},{}\n", wire.from.x, wire.from.y);
  return wrong;
}

std::string wrongWires(const frontend::ladder::Rung& rung, const Picture& picture) {
  Joined joined(picture);
  SameNets nets;
  nets.add(frontend::ladder::kRail.index, joined.rail(), "the rail");
  std::string wrong = joined.crossed() ? "two wires cross\n" : "";
  const auto port = [&](frontend::ladder::NetId net, Point point, std::string_view name) {
    if (!joined.has(point))
      wrong += fmt::format("nothing at {},{} for {}\n", point.x, point.y, name);
    else if (net.valid())
      nets.add(net.index, joined.netAt(point), std::string(name));
  };
  const auto symbols = inSource(rung, false);
  for (size_t i = 0; i < symbols.size() && i < picture.symbols.size(); ++i) {
    const std::string_view name = rung.operandOf(*symbols[i]).text;
    const Symbol& symbol = picture.symbols[i];
    port(rung.inputOf(*symbols[i]), symbol.left, name);
    port(symbols[i]->output, {symbol.left.x + symbol.width, symbol.left.y}, name);
  }
  const auto boxes = inSource(rung, true);
  for (size_t i = 0; i < boxes.size() && i < picture.frames.size(); ++i) {
    const Frame& frame = picture.frames[i];
    const std::vector<int> ports = portsOf(picture, frame, true);
    const auto pins = rung.pinsOf(*boxes[i]);
    if (ports.size() != pins.size()) return wrong + fmt::format("{} with {} pins\n", boxes[i]->mnemonic, ports.size());
    for (size_t pin = 0; pin < pins.size(); ++pin)
      port(pins[pin].input, {frame.corner.x, ports[pin]}, boxes[i]->mnemonic);
    port(boxes[i]->output, {frame.corner.x + frame.width, ports[0]}, boxes[i]->mnemonic);
  }
  return wrong + nets.wrong();
}

std::string outOfBounds(const Picture& picture) {
  std::string wrong;
  const Box page{0, 0, picture.width, picture.height};
  const Box rails{kLeft, 0, picture.rail, picture.height};
  for (const Text& text : picture.texts)
    if (!inside(boxOf(text), page)) wrong += fmt::format("'{}' beside the page\n", text.text);
  for (const Symbol& symbol : picture.symbols)
    if (!inside(boxOf(symbol), rails)) wrong += "a symbol beside the rails\n";
  for (const Frame& frame : picture.frames)
    if (!inside(boxOf(frame), rails)) wrong += "a box beside the rails\n";
  return wrong;
}

} // namespace rung::view::test
