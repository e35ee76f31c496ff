// Answers of the page's server (see page.h).
#include "tools/web/page.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rtlib/text/embedded.h"
#include "tools/view/overlay.h"
#include "tools/view/style.h"
#include "tools/view/svg.h"
#include "tools/web/files.h"

namespace rung::web {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr uint32_t kMostRows = 120;   // of one answer
constexpr size_t kMostNames = 200;    // that one page follows by name
constexpr size_t kMostTraced = 16;    // names of a trace
constexpr uint64_t kMostScans = 2000; // of a trace
constexpr uint64_t kMostShares = 500; // scans of a profile
constexpr auto kWait = 1000ms;        // for a picture newer than the last one
constexpr size_t kMostPageName = 64;  // characters

Response textOf(int status, std::string text) { return {status, "text/plain", std::move(text) + "\n"}; }

// Texts of programs may have bytes that are not UTF-8.
Response jsonOf(const json& value) {
  return {200, "application/json", value.dump(-1, ' ', false, json::error_handler_t::replace)};
}

uint64_t numberOf(const Request& request, std::string_view name) {
  const std::string text = queryValue(request.query, name);
  uint64_t number = 0;
  (void)std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// The names that are asked for, one a line.
std::vector<std::string> wordsOf(const Request& request, size_t most) {
  std::vector<std::string> names;
  const std::string asked = queryValue(request.query, "names");
  for (std::string_view rest = asked; !rest.empty() && names.size() < most;) {
    const size_t at = std::min(rest.find('\n'), rest.size());
    names.emplace_back(rest.substr(0, at));
    rest.remove_prefix(std::min(at + 1, rest.size()));
  }
  return names;
}

Width widthOf(const Request& request) {
  return static_cast<Width>(std::min<uint64_t>(numberOf(request, "width"), kWidths - 1));
}

std::string_view typeOf(std::string_view name) {
  if (name.ends_with(".js")) return "text/javascript";
  return name.ends_with(".css") ? "text/css" : "text/html";
}

json namesOf(const ShownProgram& program) {
  const std::map<uint32_t, std::set<std::string>> shapes = program.shapes();
  json all = json::array();
  for (const view::NameTable& table : program.tables()) {
    for (const view::NameRow& row : table.rows) {
      if (row.name.empty()) continue;
      json uses = json::array();
      for (const view::Use& use : row.uses) uses.push_back(use.writes ? -static_cast<int64_t>(use.rung) : use.rung);
      const char* kind = table.texts ? "t" : row.constant ? "c" : row.input ? "i" : row.output ? "o" : "";
      const auto drawn = shapes.find(row.id);
      all.push_back({row.id, row.name, row.address, row.comment, kind, std::move(uses),
                     drawn == shapes.end() ? json::array() : json(drawn->second)});
    }
  }
  return all;
}

Response doneOf(const Result<std::string>& done) {
  return done.ok() ? jsonOf({{"done", done.value()}}) : textOf(409, done.error());
}

const char* nameOf(RunState state) {
  constexpr const char* kNames[] = {"running", "paused", "past", "fault", "stopped", "lost"};
  return kNames[static_cast<size_t>(state)];
}

} // namespace

// Heights are those of rows, from which the page knows where each of them is.
Response Page::index(const Request& request) const {
  const Drawn drawn = source_.drawn();
  const ShownProgram& program = *drawn.program;
  const Width width = widthOf(request);
  json heights = json::array(), numbers = json::array();
  std::string kinds;
  for (uint32_t i = 0; i < program.rows().size(); ++i) {
    const Row& row = program.rows()[i];
    heights.push_back(program.heightOf(i, width));
    numbers.push_back(row.number);
    kinds += "fmscrd"[static_cast<size_t>(row.kind)];
  }
  json tree = json::array();
  for (const view::ContentsEntry& entry : program.contents())
    tree.push_back({entry.level, entry.block, entry.text, entry.title, entry.firstRung, entry.lastRung});
  return jsonOf({{"program", drawn.number},
                 {"title", program.title()},
                 {"control", program.control()},
                 {"kinds", kinds},
                 {"heights", std::move(heights)},
                 {"numbers", std::move(numbers)},
                 {"tree", std::move(tree)},
                 {"live", source_.isLive()},
                 {"machine", source_.isMachine()}});
}

Response Page::rungs(const Request& request, const ShownProgram& program) {
  const auto all = static_cast<uint64_t>(program.rows().size());
  const uint64_t first = std::min(numberOf(request, "from"), all);
  const uint64_t end = std::min({numberOf(request, "to"), all, first + kMostRows});
  const Width width = widthOf(request);
  json rows = json::array();
  for (auto row = static_cast<uint32_t>(first); row < end; ++row)
    rows.push_back({row, program.html(row, width), program.nameOf(row)});
  return jsonOf(rows);
}

// What a search looks at.
Response Page::names(const ShownProgram& program) {
  json titles = json::array();
  for (uint32_t row = 0; row < program.rows().size(); ++row) titles.push_back(program.titleOf(row));
  return jsonOf({{"names", namesOf(program)}, {"titles", std::move(titles)}});
}

// A picture has the power of the rows and the values of the names that are asked for, all of one scan.
Response Page::picture(const Request& request) {
  const Drawn drawn = source_.drawn();
  const auto all = static_cast<uint64_t>(drawn.program->rows().size());
  const uint64_t first = std::min(numberOf(request, "from"), all);
  uint64_t end = std::min({numberOf(request, "to"), all, first + kMostRows});
  std::vector<std::string> names = wordsOf(request, kMostNames);
  const size_t watched = names.size();
  std::vector<std::pair<uint64_t, ShownProgram::ShownValue>> shown;
  for (uint64_t row = first; row < end; ++row)
    for (ShownProgram::ShownValue& value : drawn.program->values(static_cast<uint32_t>(row))) {
      names.push_back(value.name);
      shown.emplace_back(row, std::move(value));
    }
  const std::string page = queryValue(request.query, "page").substr(0, kMostPageName);
  const auto now = source_.picture(page, names, numberOf(request, "after"), kWait);
  if (now == nullptr) return jsonOf({{"revision", 0}});
  // Of another program, the page asks for its rungs first.
  const ShownProgram& program = *now->drawn.program;
  if (now->drawn.number != drawn.number) end = first;
  json rows = json::object(), values = json::object(), texts = json::object(), forces = json::array();
  for (uint64_t row = first; row < end; ++row)
    if (program.rows()[row].elements > 0)
      rows[std::to_string(row)] = program.flow(static_cast<uint32_t>(row), now->elements);
  for (size_t i = 0; i < watched; ++i)
    if (const auto value = now->values.find(names[i]); value != now->values.end()) values[names[i]] = value->second;
  for (const auto& [row, value] : shown)
    if (const auto found = now->values.find(value.name); found != now->values.end())
      texts[fmt::format("{}.{}.{}", row, value.element, value.operand)] = found->second;
  for (const ForcedCell& cell : now->forces)
    forces.push_back({{"name", cell.name}, {"value", cell.value}, {"ids", cell.rows}});
  json messages = json::array();
  for (const ShownMessage& message : now->messages) messages.push_back({message.number, message.text});
  return jsonOf({{"revision", now->revision},
                 {"scan", now->scan},
                 {"us", now->us},
                 {"ran", now->ranLast},
                 {"program", now->drawn.number},
                 {"state", nameOf(now->state)},
                 {"follows", now->follows},
                 {"notice", now->notice},
                 {"mayWrite", now->mayWrite},
                 {"fault", now->fault},
                 {"first", now->firstScan},
                 {"last", now->lastScan},
                 {"event", now->lastEvent},
                 {"trigger", now->trigger},
                 {"messages", std::move(messages)},
                 {"forces", std::move(forces)},
                 {"rows", std::move(rows)},
                 {"values", std::move(values)},
                 {"texts", std::move(texts)}});
}

Response Page::events(const Request& request) {
  json all = json::array();
  for (const Event& event : source_.events(numberOf(request, "after")))
    all.push_back({event.number, event.scan, event.us, event.kind, event.text});
  return jsonOf(all);
}

// Steps are [depth, text, scan, row or null, causes], causes [name, value, ids, whether it decided alone].
Response Page::why(const Request& request) {
  const Result<Why> why = source_.why(queryValue(request.query, "name"));
  if (!why.ok()) return textOf(409, why.error());
  json steps = json::array();
  for (const WhyStep& step : why.value().steps) {
    json causes = json::array();
    for (const WhyCause& cause : step.causes) causes.push_back({cause.name, cause.value, cause.ids, cause.alone});
    steps.push_back({step.depth, step.text, step.scan, step.row ? json(*step.row) : json(), std::move(causes)});
  }
  return jsonOf({{"why", why.value().text},
                 {"steps", std::move(steps)},
                 {"different", why.value().toChange},
                 {"skipped", why.value().skipped}});
}

Response Page::trace(const Request& request) {
  const Result<ScanTrace> trace = source_.trace(
      wordsOf(request, kMostTraced), std::min(numberOf(request, "scans"), kMostScans), numberOf(request, "last"));
  if (!trace.ok()) return textOf(409, trace.error());
  return jsonOf({{"first", trace.value().firstScan}, {"values", trace.value().values}});
}

// Rungs are [number, runs, share of all operations, colour].
Response Page::shares(const Request& request) {
  const Result<Shares> shares = source_.shares(std::clamp<uint64_t>(numberOf(request, "scans"), 1, kMostShares));
  if (!shares.ok()) return textOf(409, shares.error());
  uint64_t all = 0, most = 0;
  for (const RungShare& one : shares.value().rungs) {
    all += one.operations;
    most = std::max(most, one.operations);
  }
  const auto shareOf = [&](uint64_t operations) {
    return all == 0 ? 0 : static_cast<double>(operations) / static_cast<double>(all);
  };
  json rungs = json::array();
  for (const RungShare& one : shares.value().rungs) {
    const double share = shareOf(one.operations);
    rungs.push_back({one.rung, one.runs, share, view::heatStep({.heat = share}, shareOf(most))});
  }
  return jsonOf({{"first", shares.value().firstScan},
                 {"last", shares.value().lastScan},
                 {"steps", view::kHeatSteps},
                 {"most", shareOf(most)},
                 {"rungs", std::move(rungs)}});
}

Response Page::order(const Request& request) {
  const json asked = json::parse(request.body, nullptr, false);
  if (!asked.is_object()) return textOf(400, "an order is a JSON object");
  const auto word = [&](const char* key) {
    const auto found = asked.find(key);
    return found != asked.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  constexpr std::pair<std::string_view, Order::Kind> kKinds[] = {
      {"run", Order::Kind::Run},         {"pause", Order::Kind::Pause},
      {"step", Order::Kind::Step},       {"seek", Order::Kind::Seek},
      {"set", Order::Kind::Set},         {"force", Order::Kind::Force},
      {"unforce", Order::Kind::Unforce}, {"mark", Order::Kind::Mark},
      {"reload", Order::Kind::Reload},   {"statement", Order::Kind::Statement}};
  const std::string what = word("do");
  if (what == "trigger") return doneOf(source_.setTrigger(word("name")));
  const bool acknowledges = what == "acknowledge";
  const auto kind = std::ranges::find(kKinds, what, &std::pair<std::string_view, Order::Kind>::first);
  if (kind == std::end(kKinds) && !acknowledges) return textOf(400, fmt::format("no order is called '{}'", what));
  const bool writes = acknowledges || kind->second >= Order::Kind::Set;
  if (writes && !asked.value("writing", false)) return textOf(403, "writing is switched off on this page");
  if (const std::string why = source_.mayWrite(); writes && !why.empty()) return textOf(403, why);
  if (acknowledges) return doneOf(source_.acknowledge());
  Order order{kind->second, 0, word("name"), word("value")};
  if (const auto scans = asked.find("scans"); scans != asked.end() && scans->is_number_integer())
    order.scans = scans->get<int64_t>();
  return doneOf(source_.execute(order));
}

Response Page::respond(const Request& request, const std::function<std::string()>& newLink) {
  if (request.post) {
    if (request.path == "/api/order") return order(request);
    if (request.path == "/api/link") return jsonOf({{"link", newLink()}});
    return textOf(404, "nothing is posted there");
  }
  if (request.path == "/api/index") return index(request);
  if (request.path == "/api/rungs") return rungs(request, *source_.drawn().program);
  if (request.path == "/api/names") return names(*source_.drawn().program);
  if (request.path == "/api/picture") return picture(request);
  if (request.path == "/api/events") return events(request);
  if (request.path == "/api/trace") return trace(request);
  if (request.path == "/api/shares") return shares(request);
  if (request.path == "/api/why") return why(request);
  if (request.path == "/style.css")
    return {200, "text/css", view::colourRules() + view::pictureStyle(source_.drawn().program->drawing(), true)};
  const std::string_view name = request.path == "/" ? "index.html" : std::string_view(request.path).substr(1);
  const auto file = std::ranges::find(appFiles(), name, &text::EmbeddedFile::name);
  if (file == appFiles().end()) return textOf(404, "there is no such page");
  return {200, std::string(typeOf(name)), std::string(file->text)};
}

} // namespace rung::web
