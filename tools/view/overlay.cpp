// Finds the drawn rungs and elements of positions (see overlay.h).
#include "tools/view/overlay.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

namespace rung::view {
namespace {

using Key = std::tuple<std::string_view, uint32_t, uint32_t>; // file, line, column

class Layer {
public:
  explicit Layer(Program& program) : program_(program) {
    for (Figure& figure : program.figures) {
      byNumber_.emplace(figure.number, &figure);
      if (figure.place.line > 0) byPlace_.emplace(keyOf(figure.place, 0), &figure);
      for (Cell& cell : figure.sheet.cells)
        if (cell.place.line > 0) cells_.emplace(keyOf(cell.place, cell.place.column), &cell);
    }
  }

  void add(const RungOverlay& rung) {
    Figure* figure =
        rung.number != 0 ? find(byNumber_, rung.number) : find(byPlace_, Key{rung.place.file, rung.place.line, 0u});
    if (figure != nullptr) figure->run = rung.run;
  }
  void add(const ElementOverlay& element) {
    for (Cell* cell : cellsAt(element.place)) {
      cell->seen = seenOf(element);
      cell->badge = badgeOf(element);
      cell->detail = element.detail;
    }
  }

private:
  Key keyOf(const Place& place, uint32_t column) const { return {program_.files[place.file].path, place.line, column}; }
  template <class Map, class K>
  static typename Map::mapped_type find(const Map& map, const K& key) {
    const auto at = map.find(key);
    return at == map.end() ? nullptr : at->second;
  }
  std::vector<Cell*> cellsAt(const SourcePlace& place) const {
    const auto first = cells_.lower_bound(Key{place.file, place.line, place.column});
    const auto end = place.column == 0 ? cells_.lower_bound(Key{place.file, place.line + 1, 0u})
                                       : cells_.upper_bound(Key{place.file, place.line, place.column});
    std::vector<Cell*> found;
    for (auto at = first; at != end; ++at) found.push_back(at->second);
    if (place.column == 0 && found.size() > 1) found.clear();
    return found;
  }

  Program& program_;
  std::unordered_map<uint32_t, Figure*> byNumber_;
  std::map<Key, Figure*> byPlace_;
  std::multimap<Key, Cell*> cells_; // an instruction may have several
};

void lay(const std::vector<StepOverlay>& steps, Program& program) {
  std::unordered_map<std::string_view, uint32_t> states;
  for (const StepOverlay& step : steps) states[step.continuation] = step.state;
  for (Chart& chart : program.charts) {
    const auto state = states.find(chart.sequence.continuation);
    if (state == states.end()) continue;
    for (size_t i = 0; i < chart.waits.size(); ++i) {
      const std::vector<uint32_t>& all = chart.sequence.parts[i].states;
      chart.waits[i] = std::ranges::find(all, state->second) != all.end();
    }
  }
}

} // namespace

Seen seenOf(const ElementOverlay& element) {
  if (!element.off && !element.on) return Seen::Nothing;
  const bool all = element.off && element.on && (element.decided || element.kind != ElementOverlay::Kind::Contact);
  return all ? Seen::All : Seen::Part;
}

std::string badgeOf(const ElementOverlay& element) {
  const bool contact = element.kind == ElementOverlay::Kind::Contact;
  if (!element.off && !element.on) return "never ran";
  if (!element.on) return contact ? "never closed" : "never on";
  if (!element.off) return contact ? "never open" : "never off";
  return seenOf(element) == Seen::All ? "" : "never decided";
}

int heatStep(const Run& run, double hottest) {
  if (run.heat <= 0) return 0;
  return 1 + std::min(kHeatSteps - 1, static_cast<int>(run.heat / hottest * kHeatSteps));
}

std::string_view labelOf(const Run& run) {
  if (!run.label.empty() || run.state == Run::State::Unasked) return run.label;
  return run.state == Run::State::Never ? "never ran" : "ran";
}

void lay(const Overlay& overlay, Program& program) {
  program.runs = {overlay.title, overlay.summary, overlay.heat};
  lay(overlay.steps, program);
  Layer layer(program);
  for (const RungOverlay& rung : overlay.rungs) layer.add(rung);
  for (const ElementOverlay& element : overlay.elements) layer.add(element);
}

} // namespace rung::view
