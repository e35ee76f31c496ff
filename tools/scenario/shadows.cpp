// Runs a shadow beside a session's program (see shadows.h).
#include "tools/scenario/shadows.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <utility>

namespace rung::scenario {
namespace {

constexpr size_t kListed = 8; // most differences in a message
constexpr const char* kNone = "no program runs beside this one: write shadow FILE… before";

// The shadow works after every scan, so there is room for the recorded runs of more than one scan.
uint32_t roomFor(const rung_program& program) {
  return std::min(2 * (program.scan_count + program.fast_count) + 16, RUNG_MOST_SHADOW_ROOM);
}

std::string valueText(uint32_t type, rung_value value) {
  return type == RUNG_TYPE_F64 ? fmt::format("{}", value.real) : fmt::format("{}", value.integer);
}

// For a service, the word before its operands, as in expect_call.
std::string nameOf(const rung_difference& difference) {
  const std::string_view name = difference.name;
  return std::string(difference.type == 0 ? name.substr(0, name.find(' ')) : name);
}

std::string textOf(const rung_difference& difference) {
  const double seconds = static_cast<double>(difference.first_us) / 1e6;
  if (difference.type == 0)
    return fmt::format("only the shadow requests {} (first at {:.3f} s)", nameOf(difference), seconds);
  return fmt::format("{} is {}, and {} in the shadow (first at {:.3f} s)", nameOf(difference),
                     valueText(difference.type, difference.running), valueText(difference.type, difference.next),
                     seconds);
}

// Why it has ended, if for another reason than the requested end.
std::string endOf(const rung_shadow_info& info) {
  switch (info.state) {
  case RUNG_SHADOW_FAULTED: return fmt::format("the shadow has stopped with a fault: {}", info.fault);
  case RUNG_SHADOW_STOPPED: return "the shadow has ended together with the program";
  case RUNG_SHADOW_TOO_SLOW:
    return "the shadow has ended: a scan had more task runs or requests than there is room for";
  case RUNG_SHADOW_FINISHED: return fmt::format("the shadow has ended after {} scans", RUNG_MOST_SHADOW_SCANS);
  default: return {};
  }
}

std::string listOf(const std::vector<rung_difference>& differences) {
  std::vector<std::string> texts;
  for (size_t i = 0; i < std::min(differences.size(), kListed); ++i) texts.push_back(textOf(differences[i]));
  if (differences.size() > kListed) texts.push_back(fmt::format("{} more", differences.size() - kListed));
  return fmt::format("{}", fmt::join(texts, "; "));
}

} // namespace

std::string Shadows::begin(const EngineRuns& runs, const std::vector<runtime::Engine*>& engines) try {
  end();
  std::vector<InRun> inRuns;
  for (size_t i = 0; i < runs.size(); ++i) {
    rung::Image image = rung::Image::adopt(engines[i]->program(), engines[i]->context());
    rung::Shadow shadow(runs[i]->machine().instance(), image, RUNG_MOST_SHADOW_SCANS,
                        roomFor(runs[i]->instance().program()));
    inRuns.push_back({std::move(image), std::move(shadow)});
  }
  for (size_t i = 0; i < runs.size(); ++i)
    if (check(rung_instance_shadow(runs[i]->machine().instance().handle(), inRuns[i].shadow.handle())) != RUNG_OK)
      return runs[i]->instance().faulted() ? "a program that a fault has stopped has no shadow" : rung_error_text();
  inRuns_ = std::move(inRuns);
  taken_.clear();
  shown_.clear();
  return {};
} catch (const rung::Error& error) {
  return error.what();
}

void Shadows::work() {
  for (InRun& run : inRuns_)
    while (run.shadow.work()) continue;
}

template <class Look>
std::string Shadows::inAll(const EngineRuns& runs, Look look) {
  if (inRuns_.empty()) return kNone;
  for (size_t i = 0; i < inRuns_.size(); ++i) {
    const rung_shadow_info info = inRuns_[i].shadow.report();
    std::vector<rung_difference> left;
    for (const rung_difference& difference : inRuns_[i].shadow.differences())
      if (!taken_.contains(nameOf(difference))) left.push_back(difference);
    if (std::string problem = look(info, left); !problem.empty())
      return runs.size() > 1 ? fmt::format("[{}] {}", runs[i]->engineName(), problem) : problem;
  }
  return {};
}

std::string Shadows::expectDifference(const EngineRuns& runs, const std::string& name) {
  std::string problem =
      inAll(runs, [&](const rung_shadow_info&, const std::vector<rung_difference>& left) -> std::string {
        if (std::ranges::any_of(left, [&](const rung_difference& d) { return nameOf(d) == name; })) return {};
        return left.empty() ? fmt::format("the shadow shows no difference; expected {}", name)
                            : fmt::format("{} did not differ; the differences are: {}", name, listOf(left));
      });
  if (problem.empty()) taken_.insert(name);
  return problem;
}

std::string Shadows::expectNone(const EngineRuns& runs) {
  return inAll(runs, [](const rung_shadow_info& info, const std::vector<rung_difference>& left) -> std::string {
    if (!left.empty()) return "there are differences that no expect_difference names: " + listOf(left);
    return endOf(info);
  });
}

std::vector<std::string> Shadows::news() {
  std::vector<std::string> lines;
  if (inRuns_.empty()) return lines;
  const rung_shadow_info info = inRuns_[0].shadow.report();
  const auto show = [&](const std::string& key, std::string line) {
    if (shown_.insert(key).second) lines.push_back(std::move(line));
  };
  for (const rung_difference& difference : inRuns_[0].shadow.differences())
    show(nameOf(difference), textOf(difference));
  if (const std::string end = endOf(info); !end.empty()) show("", end);
  return lines;
}

} // namespace rung::scenario
