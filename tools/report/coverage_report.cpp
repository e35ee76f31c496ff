// Totals and merging.
#include "tools/report/coverage_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace rung::report {

namespace {

template <class Part>
bool samePlaces(const std::vector<Part>& a, const std::vector<Part>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Part& x, const Part& y) {
    return x.text == y.text && x.line == y.line && x.column == y.column;
  });
}

bool sameDecisions(const Rung& a, const Rung& b) {
  const auto sameBy = [](const Deciding& x, const Deciding& y) { return x.condition == y.condition; };
  const auto same = [&](const Decision& x, const Decision& y) {
    return x.outputs == y.outputs && std::equal(x.by.begin(), x.by.end(), y.by.begin(), y.by.end(), sameBy);
  };
  return std::equal(a.decisions.begin(), a.decisions.end(), b.decisions.begin(), b.decisions.end(), same);
}

bool sameRung(const Rung& a, const Rung& b) {
  return a.number == b.number && a.file == b.file && a.line == b.line && samePlaces(a.conditions, b.conditions) &&
         samePlaces(a.outputs, b.outputs) && sameDecisions(a, b);
}

void mergeRung(Rung& rung, const Rung& other) {
  rung.runs += other.runs;
  for (size_t i = 0; i < rung.conditions.size(); ++i) {
    rung.conditions[i].open |= other.conditions[i].open;
    rung.conditions[i].closed |= other.conditions[i].closed;
  }
  for (size_t i = 0; i < rung.outputs.size(); ++i) {
    rung.outputs[i].off |= other.outputs[i].off;
    rung.outputs[i].on |= other.outputs[i].on;
  }
  for (size_t i = 0; i < rung.decisions.size(); ++i)
    for (size_t k = 0; k < rung.decisions[i].by.size(); ++k)
      rung.decisions[i].by[k].alone |= other.decisions[i].by[k].alone;
}

// Each number occurs once.
void mergeProgram(Program& program, const Program& other) {
  for (Rung& rung : program.rungs) {
    const auto at = std::lower_bound(other.rungs.begin(), other.rungs.end(), rung.number,
                                     [](const Rung& r, uint32_t number) { return r.number < number; });
    if (at != other.rungs.end() && sameRung(rung, *at)) mergeRung(rung, *at);
  }
}

// Files alone do not identify a program: the configuration may make two programs of the same files.
bool sameProgram(const Program& a, const Program& b) {
  return a.files == b.files && std::equal(a.rungs.begin(), a.rungs.end(), b.rungs.begin(), b.rungs.end(), sameRung);
}

} // namespace

Share& Share::operator+=(const Share& other) {
  seen += other.seen;
  all += other.all;
  return *this;
}

Totals& Totals::operator+=(const Totals& other) {
  rungs += other.rungs;
  contacts += other.contacts;
  coils += other.coils;
  decided += other.decided;
  oneWay += other.oneWay;
  return *this;
}

Totals totalsOf(std::span<const Rung> rungs) {
  Totals totals;
  const auto count = [](Share& share, bool seen) { share += {seen ? 1u : 0u, 1}; };
  for (const Rung& rung : rungs) {
    count(totals.rungs, rung.runs > 0);
    for (const Condition& condition : rung.conditions)
      if (condition.contact) count(totals.contacts, condition.open && condition.closed);
    for (const Output& output : rung.outputs)
      if (output.coil) count(totals.coils, output.on && output.off);
    for (const Decision& decision : rung.decisions)
      for (const Deciding& deciding : decision.by) {
        count(totals.decided, deciding.bothWays());
        totals.oneWay += deciding.alone != 0 && !deciding.bothWays() ? 1 : 0;
      }
  }
  return totals;
}

Totals totalsOf(const CoverageReport& report) {
  Totals totals;
  for (const Program& program : report.programs) totals += totalsOf(program.rungs);
  return totals;
}

void merge(CoverageReport& report, const CoverageReport& other) {
  for (const Program& program : other.programs) {
    const auto at = std::find_if(report.programs.begin(), report.programs.end(),
                                 [&](const Program& p) { return sameProgram(p, program); });
    if (at == report.programs.end())
      report.programs.push_back(program);
    else
      mergeProgram(*at, program);
  }
}

void mergeFormer(CoverageReport& report, const CoverageReport& former) {
  const size_t own = report.programs.size();
  for (const Program& program : former.programs) {
    bool known = false;
    for (size_t i = 0; i < own; ++i) {
      if (report.programs[i].files != program.files) continue;
      mergeProgram(report.programs[i], program);
      known = true;
    }
    if (!known) report.programs.push_back(program);
  }
}

// The report as JSON, for other programs and for the next run.

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

// The report as text.

namespace {

std::string line(std::string_view what, const Share& share, std::string_view more = {}) {
  return fmt::format("  {:<26}{:>6} of {:<6}{:>8}{}\n", what, share.seen, share.all, percentText(share), more);
}

std::string summary(const Totals& totals) {
  const std::string oneWay =
      totals.oneWay == 0 ? std::string() : fmt::format("  and {} in one direction only", totals.oneWay);
  return line("rungs run", totals.rungs) + line("contacts open and closed", totals.contacts) +
         line("coils on and off", totals.coils) + line("conditions shown to decide", totals.decided, oneWay);
}

std::string byFile(const Program& program) {
  if (program.files.size() < 2) return {};
  std::map<std::string, std::vector<Rung>> rungs;
  for (const Rung& rung : program.rungs) rungs[rung.file].push_back(rung);
  std::string text = fmt::format("\n  {:>8}{:>10}{:>10}{:>12}  file\n", "rungs", "contacts", "coils", "conditions");
  for (const std::string& file : program.files) {
    const Totals totals = totalsOf(rungs[file]);
    if (totals.rungs.all == 0) continue; // only declarations
    text += fmt::format("  {:>8}{:>10}{:>10}{:>12}  {}\n", percentText(totals.rungs), percentText(totals.contacts),
                        percentText(totals.coils), percentText(totals.decided), file);
  }
  return text;
}

std::string nameOf(const Rung& rung) {
  return fmt::format("rung {}{} ({}:{})", rung.number, rung.title.empty() ? "" : fmt::format(" \"{}\"", rung.title),
                     rung.file, rung.line);
}

std::string outcomeOf(const Rung& rung, const Decision& decision) {
  std::string text = rung.outputs[decision.outputs[0]].text;
  if (decision.outputs.size() > 1) text += fmt::format(" and {} more", decision.outputs.size() - 1);
  return text;
}

// A box without power has no result: this is reported once, at its input.
bool isSaidOfInput(const Rung& rung, const Condition& condition, const std::string& missing) {
  return std::ranges::any_of(rung.outputs, [&](const Output& output) {
    return output.line == condition.line && output.column == condition.column && missingOf(output) == missing;
  });
}

// What is missing in a rung that ran. For a condition that never changed, that alone is reported.
std::vector<std::string> partsMissing(const Rung& rung) {
  std::vector<std::string> lines;
  for (const Condition& condition : rung.conditions)
    if (const std::string missing = missingOf(condition); !missing.empty() && !isSaidOfInput(rung, condition, missing))
      lines.push_back(fmt::format("{} (line {}) {}", condition.text, condition.line, missing));
  for (const Output& output : rung.outputs)
    if (const std::string missing = missingOf(output); !missing.empty())
      lines.push_back(fmt::format("{} (line {}) {}", output.text, output.line, missing));
  for (const Decision& decision : rung.decisions)
    for (const Deciding& deciding : decision.by) {
      const Condition& condition = rung.conditions[deciding.condition];
      const std::string missing = missingOf(deciding, outcomeOf(rung, decision));
      if (missing.empty() || !condition.open || !condition.closed) continue;
      lines.push_back(fmt::format("{} (line {}) {}", condition.text, condition.line, missing));
    }
  return lines;
}

std::vector<std::string> missingLines(const Program& program) {
  std::vector<std::string> lines;
  for (const Rung& rung : program.rungs) {
    if (rung.runs == 0) {
      lines.push_back(fmt::format("  {} never ran", nameOf(rung)));
      continue;
    }
    const std::vector<std::string> parts = partsMissing(rung);
    if (!parts.empty()) lines.push_back(fmt::format("  {}", nameOf(rung)));
    for (const std::string& part : parts) lines.push_back("    " + part);
  }
  return lines;
}

std::string listOf(const std::vector<std::string>& lines, uint32_t limit) {
  if (lines.empty()) return {};
  const size_t shown = limit == 0 ? lines.size() : std::min<size_t>(lines.size(), limit);
  std::string text = "\nnot covered\n";
  for (size_t i = 0; i < shown; ++i) text += lines[i] + "\n";
  if (shown < lines.size()) text += fmt::format("  … {} more lines: --coverage-all\n", lines.size() - shown);
  return text;
}

} // namespace

std::string percentText(const Share& share) { return fmt::format("{:.1f} %", std::floor(share.percent() * 10) / 10); }

std::string missingOf(const Condition& condition) {
  if (condition.open && condition.closed) return {};
  const std::string_view closed = condition.contact ? "closed" : "on";
  const std::string_view open = condition.contact ? "open" : "off";
  if (!condition.open && !condition.closed) return "never evaluated";
  return fmt::format("never {}", condition.open ? closed : open);
}

std::string missingOf(const Output& output) {
  if (output.on && output.off) return {};
  if (!output.on && !output.off) return "never evaluated";
  return output.off ? "never on" : "never off";
}

std::string missingOf(const Deciding& deciding, std::string_view outcome) {
  if (deciding.bothWays()) return {};
  if (deciding.alone == 0) return fmt::format("was never shown to switch {}", outcome);
  const bool on = (deciding.alone & (kOpenOn | kClosedOn)) != 0;
  const bool off = (deciding.alone & (kOpenOff | kClosedOff)) != 0;
  if (on && off) return fmt::format("was shown to switch {} in one of its own states only", outcome);
  return on ? fmt::format("was shown to switch {} on, but never off", outcome)
            : fmt::format("was shown to switch {} off, but never on", outcome);
}

std::string toText(const CoverageReport& report, const CoverageTextOptions& options) {
  std::string text;
  for (const Program& program : report.programs)
    text +=
        fmt::format("{}coverage of {}\n{}{}{}", text.empty() ? "" : "\n", fmt::join(program.files, " "),
                    summary(totalsOf(program.rungs)), byFile(program), listOf(missingLines(program), options.missing));
  return text;
}

} // namespace rung::report
