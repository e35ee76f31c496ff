// Totals and merging (see report.h).
#include "tools/report/coverage_report.h"

#include <algorithm>

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

// A number is there once.
void mergeProgram(Program& program, const Program& other) {
  for (Rung& rung : program.rungs) {
    const auto at = std::lower_bound(other.rungs.begin(), other.rungs.end(), rung.number,
                                     [](const Rung& r, uint32_t number) { return r.number < number; });
    if (at != other.rungs.end() && sameRung(rung, *at)) mergeRung(rung, *at);
  }
}

// The configuration may make two programs of the same files.
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

} // namespace rung::report
