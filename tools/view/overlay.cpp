// From places to the rungs and elements that are drawn there (see overlay.h).
#include "tools/view/overlay.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

#include "frontend/syntax/word_lexer.h"

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
    Cell* cell = cellAt(element.place);
    if (cell == nullptr) return;
    cell->seen = seenOf(element);
    cell->badge = badgeOf(element);
    cell->detail = element.detail;
  }

private:
  Key keyOf(const Place& place, uint32_t column) const { return {program_.files[place.file].path, place.line, column}; }
  template <class Map, class K>
  static typename Map::mapped_type find(const Map& map, const K& key) {
    const auto at = map.find(key);
    return at == map.end() ? nullptr : at->second;
  }
  Cell* cellAt(const SourcePlace& place) const {
    if (place.column != 0) return find(cells_, Key{place.file, place.line, place.column});
    const auto at = cells_.lower_bound(Key{place.file, place.line, 0u});
    const auto end = cells_.lower_bound(Key{place.file, place.line + 1, 0u});
    return at != end && std::next(at) == end ? at->second : nullptr;
  }

  Program& program_;
  std::unordered_map<uint32_t, Figure*> byNumber_;
  std::map<Key, Figure*> byPlace_;
  std::map<Key, Cell*> cells_;
};

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
  Layer layer(program);
  for (const RungOverlay& rung : overlay.rungs) layer.add(rung);
  for (const ElementOverlay& element : overlay.elements) layer.add(element);
}

std::vector<TableRow> rowsOf(const ir::Module& module) {
  std::map<uint32_t, TableRow> rows; // by the rung's number over all routines, in which the source has them
  uint32_t index = 0;
  for (const ir::Routine& routine : module.routines) {
    for (const ir::Rung& rung : routine.rungs) {
      const uint32_t at = rung.origin.index == RUNG_NONE ? index : rung.origin.index;
      ++index;
      if (rung.number == 0) continue;
      const bool known = rung.begin.line > 0;
      rows[at] = {rung.number,
                  ir::homeOf(routine, rung),
                  rung.title,
                  {known ? module.files[rung.begin.file.index] : "", rung.begin.line, 0},
                  rung.lastLine};
    }
  }
  std::vector<TableRow> list;
  for (auto& [at, row] : rows) list.push_back(std::move(row));
  return list;
}

Listing listingOf(const SourceManager& sources, std::span<const FileId> files, std::string_view control,
                  std::vector<TableRow> rows, const std::vector<std::string>& included) {
  std::vector<std::string> names;
  for (const FileId file : files) names.emplace_back(sources.name(file));
  Listing listing{titleOf(shownFiles(names)), std::string(control), std::move(rows), {}};
  // As they are written, whatever routine comes first; one that is several in the module is one here.
  std::ranges::stable_sort(listing.rows, {}, &TableRow::number);
  const auto again = std::ranges::unique(listing.rows, {}, &TableRow::number);
  listing.rows.erase(again.begin(), again.end());
  std::map<std::string_view, FileId> readable; // the last of a name: what a dialect has made of its bytes
  for (uint32_t i = 0; i < sources.fileCount(); ++i) readable[sources.name(FileId{i})] = FileId{i};
  const auto add = [&](const std::string& path) {
    const auto file = readable.find(path);
    const auto [text, isNew] = listing.texts.try_emplace(path);
    if (!isNew || file == readable.end()) return;
    frontend::LineReader lines(sources, file->second);
    for (frontend::SourceLine line; lines.next(line);) text->second.emplace_back(line.text);
  };
  for (const TableRow& row : listing.rows) add(row.place.file);
  std::ranges::for_each(names, add);
  std::ranges::for_each(included, add);
  std::erase_if(listing.texts, [](const auto& text) { return text.second.empty(); });
  return listing;
}

} // namespace rung::view
