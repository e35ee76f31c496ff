// The report for programs and for the next run (see report.h).
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/report/coverage_report.h"

namespace rung::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "rung-coverage";
constexpr int kVersion = 1;

struct NamedAlone {
  Alone alone;
  std::string_view name;
};
constexpr std::array<NamedAlone, 4> kAlone = {
    {{kOpenOff, "open/off"}, {kOpenOn, "open/on"}, {kClosedOff, "closed/off"}, {kClosedOn, "closed/on"}}};

Json jsonOf(const Share& share) { return {{"seen", share.seen}, {"all", share.all}}; }

Json jsonOf(const Totals& totals) {
  Json decided = jsonOf(totals.decided);
  decided["one_way"] = totals.oneWay;
  return {{"rungs", jsonOf(totals.rungs)},
          {"contacts", jsonOf(totals.contacts)},
          {"coils", jsonOf(totals.coils)},
          {"conditions", decided}};
}

Json jsonOf(const Decision& decision) {
  Json by = Json::array();
  for (const Deciding& deciding : decision.by) {
    Json alone = Json::array();
    for (const NamedAlone& named : kAlone)
      if ((deciding.alone & named.alone) != 0) alone.push_back(named.name);
    by.push_back({{"condition", deciding.condition}, {"alone", alone}, {"both_ways", deciding.bothWays()}});
  }
  return {{"outputs", decision.outputs}, {"by", by}};
}

Json jsonOf(const Rung& rung) {
  Json conditions = Json::array();
  for (const Condition& c : rung.conditions)
    conditions.push_back({{"text", c.text},
                          {"line", c.line},
                          {"column", c.column},
                          {"kind", c.contact ? "contact" : "result"},
                          {"open", c.open},
                          {"closed", c.closed}});
  Json outputs = Json::array();
  for (const Output& o : rung.outputs)
    outputs.push_back({{"text", o.text},
                       {"line", o.line},
                       {"column", o.column},
                       {"kind", o.coil ? "coil" : "input"},
                       {"off", o.off},
                       {"on", o.on}});
  Json decisions = Json::array();
  for (const Decision& decision : rung.decisions) decisions.push_back(jsonOf(decision));
  return {{"number", rung.number},    {"routine", rung.routine}, {"title", rung.title},
          {"file", rung.file},        {"line", rung.line},       {"runs", rung.runs},
          {"conditions", conditions}, {"outputs", outputs},      {"decisions", decisions}};
}

// ---- reading; a member that is missing or of another type throws ----------------------------------------------------

Condition conditionOf(const Json& json) {
  return {.text = json.at("text"),
          .line = json.at("line"),
          .column = json.at("column"),
          .contact = json.at("kind") == "contact",
          .open = json.at("open"),
          .closed = json.at("closed")};
}

Output outputOf(const Json& json) {
  return {.text = json.at("text"),
          .line = json.at("line"),
          .column = json.at("column"),
          .coil = json.at("kind") == "coil",
          .off = json.at("off"),
          .on = json.at("on")};
}

uint32_t indexOf(const Json& json, size_t size) {
  const uint32_t index = json.get<uint32_t>();
  if (index >= size) throw std::out_of_range(fmt::format("there is no entry {}", index));
  return index;
}

Decision decisionOf(const Json& json, const Rung& rung) {
  Decision decision;
  for (const Json& output : json.at("outputs")) decision.outputs.push_back(indexOf(output, rung.outputs.size()));
  if (decision.outputs.empty()) throw std::out_of_range("a decision has no output");
  for (const Json& entry : json.at("by")) {
    Deciding& deciding = decision.by.emplace_back();
    deciding.condition = indexOf(entry.at("condition"), rung.conditions.size());
    for (const Json& name : entry.at("alone"))
      for (const NamedAlone& named : kAlone)
        if (name == named.name) deciding.alone |= named.alone;
  }
  return decision;
}

Rung rungOf(const Json& json) {
  Rung rung{.number = json.at("number"),
            .routine = json.at("routine"),
            .title = json.at("title"),
            .file = json.at("file"),
            .line = json.at("line"),
            .runs = json.at("runs"),
            .conditions = {},
            .outputs = {},
            .decisions = {}};
  for (const Json& condition : json.at("conditions")) rung.conditions.push_back(conditionOf(condition));
  for (const Json& output : json.at("outputs")) rung.outputs.push_back(outputOf(output));
  for (const Json& decision : json.at("decisions")) rung.decisions.push_back(decisionOf(decision, rung));
  return rung;
}

CoverageReport reportOf(const Json& json) {
  if (json.at("format") != kFormat || json.at("version") != kVersion)
    throw std::invalid_argument(fmt::format("it is not {} version {}", kFormat, kVersion));
  CoverageReport report;
  for (const Json& entry : json.at("programs")) {
    Program& program = report.programs.emplace_back();
    program.files = entry.at("files").get<std::vector<std::string>>();
    for (const Json& rung : entry.at("rungs")) program.rungs.push_back(rungOf(rung));
    std::sort(program.rungs.begin(), program.rungs.end(),
              [](const Rung& a, const Rung& b) { return a.number < b.number; });
  }
  return report;
}

} // namespace

std::string toJson(const CoverageReport& report) {
  Json programs = Json::array();
  for (const Program& program : report.programs) {
    Json rungs = Json::array();
    for (const Rung& rung : program.rungs) rungs.push_back(jsonOf(rung));
    programs.push_back({{"files", program.files}, {"totals", jsonOf(totalsOf(program.rungs))}, {"rungs", rungs}});
  }
  const Json json = {
      {"format", kFormat}, {"version", kVersion}, {"totals", jsonOf(totalsOf(report))}, {"programs", programs}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<CoverageReport> fromJson(std::string_view text) {
  try {
    return reportOf(Json::parse(text));
  } catch (const std::exception& error) {
    return failure(error.what());
  }
}

} // namespace rung::report
