// A difference for other programs (see difference.h).
#include <nlohmann/json.hpp>

#include "tools/report/difference.h"

namespace rung::report {
namespace {

using Json = nlohmann::ordered_json;

Json rungJson(const ir::Module& module, const ShownRung& shown) {
  const ir::Rung* rung = shown.rung;
  if (rung == nullptr) return nullptr;
  return {{"number", rung->number},
          {"title", rung->title},
          {"routine", shownName(*shown.routine)},
          {"file", module.files[rung->begin.file.index]},
          {"line", rung->begin.line},
          {"text", rung->sourceText}};
}

Json namesJson(const std::vector<NameChange>& changes) {
  Json list = Json::array();
  for (const NameChange& change : changes)
    list.push_back(
        {{"change", nameOf(change.kind)}, {"name", change.name}, {"before", change.before}, {"after", change.after}});
  return list;
}

Json linesJson(const std::vector<LineChange>& changes) {
  Json list = Json::array();
  for (const LineChange& change : changes)
    list.push_back({{"name", change.name}, {"before", change.before}, {"after", change.after}});
  return list;
}

} // namespace

std::string shownAsJson(const Difference& difference, const ir::Module& before, const ir::Module& after) {
  Json rungs = Json::array();
  for (const RungChange& change : difference.rungs) {
    Json ways = Json::array();
    for (const OtherWay& way : change.ways) ways.push_back({{"before", way.before}, {"after", way.after}});
    rungs.push_back({{"change", nameOf(change.kind)},
                     {"before", rungJson(before, change.before)},
                     {"after", rungJson(after, change.after)},
                     {"leads", std::move(ways)}});
  }
  const Json json = {{"rungs", std::move(rungs)},
                     {"same", difference.same},
                     {"names", namesJson(difference.names)},
                     {"contents", namesJson(difference.contents)},
                     {"messages", namesJson(difference.messages)},
                     {"configuration", namesJson(difference.settings)},
                     {"lines", linesJson(difference.lines)}};
  return json.dump(2) + "\n";
}

} // namespace rung::report
