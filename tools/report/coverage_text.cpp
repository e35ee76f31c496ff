// The report for people (see report.h).
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "tools/report/coverage_report.h"

namespace rung::report {
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

// A box that got no power gives nothing: once is enough.
bool isSaidOfInput(const Rung& rung, const Condition& condition, const std::string& missing) {
  return std::ranges::any_of(rung.outputs, [&](const Output& output) {
    return output.line == condition.line && output.column == condition.column && missingOf(output) == missing;
  });
}

// What is missing in a rung that ran. Of a condition that never moved, that says enough.
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
