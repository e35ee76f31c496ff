// What editors show beside the text: how often declared names are written and read, and the addresses of names.
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "rtlib/nc/names/names.h"
#include "tools/lsp/features.h"
#include "tools/report/place_names.h"

namespace rung::lsp {
namespace {

struct Counts {
  size_t writes = 0;
  size_t reads = 0;
};

// Of the operands with a fixed place, under whatever names.
class UseCounts {
public:
  explicit UseCounts(const frontend::Analysis& analysis) {
    for (const frontend::OperandUse& operand : analysis.operands()) {
      Counts& counts = counts_[keyOf(operand.place)];
      if (isWritten(operand.access)) ++counts.writes;
      if (isRead(operand.access)) ++counts.reads;
    }
  }
  Counts of(const frontend::NamedPlace& place) const {
    const auto found = counts_.find(keyOf(place));
    return found == counts_.end() ? Counts{} : found->second;
  }

private:
  using Key = std::tuple<std::string_view, uint32_t, uint32_t>;
  static Key keyOf(const frontend::NamedPlace& place) { return {place.space, place.firstBit, place.bits}; }

  std::map<Key, Counts> counts_;
};

std::string counted(size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

} // namespace

json codeLenses(Program& program, FileId file, Unit unit) {
  json list = json::array();
  if (program.analysis() == nullptr) return list;
  const SourceManager& sources = program.sources();
  const UseCounts counts(*program.analysis());
  for (const frontend::Definition& definition : program.analysis()->definitions()) {
    if (!definition.range.valid() || definition.isConstant() || sources.fileOf(definition.range.begin) != file)
      continue;
    const Counts uses = counts.of(definition.place);
    const Range range = rangeOf(sources, definition.range, unit);
    const std::string title = fmt::format("{}, {}", counted(uses.writes, "write"), counted(uses.reads, "read"));
    list.push_back({{"range", toJson(range)}, {"command", {{"title", title}, {"command", ""}}}});
  }
  return list;
}

// Not in drawings, whose columns they would move.
json inlayHints(const Place& begin, SourcePos end) {
  json list = json::array();
  const auto text = begin.program.text();
  if (!text || text->reference == nullptr || isLadderText(begin.program, begin.file)) return list;
  const rung_program& program = text->reference->program();
  for (const frontend::NameUse& use : text->analysis.names()) {
    if (use.range.begin < begin.at || end < use.range.end) continue;
    const frontend::Definition& definition = text->analysis.definitions()[use.definition];
    const auto bits = definition.isConstant() ? std::nullopt : report::rangeOf(program, definition.place);
    const std::string shown = bits ? nc::address(program, report::refAt(*bits)) : std::string(definition.value);
    if (shown.empty() || shown == text->sources.text(use.range)) continue;
    list.push_back({{"position", toJson(positionOf(text->sources, use.range.end, begin.unit))},
                    {"label", shown},
                    {"paddingLeft", true}});
  }
  return list;
}

} // namespace rung::lsp
