// See page.h.
#include "machine/rungctl/page.h"

#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <iterator>
#include <sstream>
#include <utility>

#include "machine/control/log.h"
#include "machine/rungctl/log.h"
#include "machine/rungctl/status.h"
#include "machine/rungctl/words.h"
#include "rtlib/text/controls.h"

namespace rung::rungctl {

using nlohmann::json;
using Lines = std::vector<Line>;

namespace {

std::string nameOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

bool isContinued(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

void addText(Lines& lines, const std::string& text, Style style) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back({line, style});
}

// ---- the head ------------------------------------------------------------------------------------------------------

std::string timesOf(const json& status) {
  const auto clock = status.find("clock");
  if (clock == status.end()) {
    const json scan = status.value("scan", json::object());
    return fmt::format("scan: last {:.1f} us, longest {:.1f} us", scan.value("last_us", 0.0),
                       scan.value("longest_us", 0.0));
  }
  const auto figure = [&](const char* key) { return clock->value(key, 0.0); };
  const json worst = clock->value("worst", json::array());
  return fmt::format("step: last {:.1f} us, mean {:.1f}, 50% {:.1f}, 99% {:.1f}, 99.9% {:.1f}, longest {:.1f}",
                     figure("last_us"), figure("mean_us"), figure("took_50_us"), figure("took_99_us"),
                     figure("took_999_us"), worst.empty() ? 0.0 : worst[0].value("us", 0.0));
}

std::string overrunsOf(const json& status) {
  const auto clock = status.find("clock");
  if (clock == status.end()) return {};
  return fmt::format("every {:.0f} us: {} steps, {} overruns; start late: 99% within {:.1f} us, the latest {:.1f} us",
                     clock->value("period_us", 0.0), clock->value("steps", uint64_t{0}),
                     clock->value("overruns", uint64_t{0}), clock->value("late_99_us", 0.0),
                     clock->value("latest_us", 0.0));
}

Lines headOf(const Look& look, const std::string& problem) {
  const json& status = look.status;
  const bool faulted = status.value("faulted", false);
  Lines lines;
  lines.push_back({fmt::format("host {}, program {}, dialect {}  {}", shown(status["host"]), shown(status["program"]),
                               shown(status["dialect"]), control::dateText(std::time(nullptr))),
                   Style::Heading});
  if (!problem.empty()) lines.push_back({problem, Style::Alarm});
  addText(lines, stateText(status), faulted ? Style::Alarm : Style::Plain);
  lines.push_back({timesOf(status)});
  if (const std::string text = overrunsOf(status); !text.empty()) lines.push_back({text});
  if (const auto forced = status.value("forced", size_t{0}); forced != 0)
    lines.push_back({fmt::format("{} forced: see rungctl forced", forced), Style::Alarm});
  return lines;
}

// ---- sections ------------------------------------------------------------------------------------------------------

// The place of a rung as it was drawn.
std::string placeOf(const json& rung) {
  const std::string title = rung.value("title", "");
  return fmt::format("{}:{}{}", nameOf(shown(rung["file"])), rung["line"].dump(), title.empty() ? "" : "  " + title);
}

Lines rungsOf(const Look& look) {
  if (look.profile.is_null())
    return {{"the program does not count its rungs: build it with `rungc build --profile`, or", Style::Faint},
            {"`rungctl reload --profile` it", Style::Faint}};
  const double whole = look.profile.value("time_ns", 0.0);
  Lines lines;
  for (const json& rung : look.profile["rungs"]) {
    const auto runs = rung.value("executions", uint64_t{0});
    const double time = rung.value("time_ns", 0.0);
    lines.push_back({fmt::format("{:>6} {:>5.1f}% {:>9.1f} {:>9.1f} {:>11}  {}", rung["rung"].dump(),
                                 whole > 0 ? 100 * time / whole : 0, runs == 0 ? 0 : time / static_cast<double>(runs),
                                 rung.value("max_ns", 0.0), runs, placeOf(rung))});
  }
  return lines;
}

std::string timeOf(const json& timer, const char* key) {
  if (!timer.contains(key)) return "?";
  if (timer.value("unit", "") == "runs") return timer[key].dump() + " runs";
  return fmt::format("{:.3f} s", timer[key].get<double>() / 1e6);
}

Lines timersOf(const Look& look) {
  Lines lines;
  for (const json& timer : look.timers)
    lines.push_back(
        {fmt::format("{:<20} {:>12} of {:>12} {:>12} left  {}", shown(timer["name"]), timeOf(timer, "elapsed"),
                     timeOf(timer, "preset"), timeOf(timer, "remaining"), placeOf(timer))});
  if (lines.empty()) lines.push_back({"no timer runs", Style::Faint});
  return lines;
}

std::string ageText(double seconds) {
  if (seconds < 0) return "";
  return seconds < 60 ? fmt::format("{:.0f} s ago", seconds) : fmt::format("{:.0f} min ago", seconds / 60);
}

Lines pinsOf(const Look& look, bool byName) {
  std::vector<Look::Pin> pins = look.pins;
  if (byName)
    std::ranges::sort(pins, {}, &Look::Pin::name);
  else
    std::ranges::stable_sort(pins, [](const Look::Pin& a, const Look::Pin& b) {
      return a.changedS >= 0 && (b.changedS < 0 || a.changedS < b.changedS);
    });
  Lines lines;
  for (const Look::Pin& pin : pins)
    lines.push_back({fmt::format("{:<24} {:>10} {:>10}  {:>10}  {}", pin.name, pin.value,
                                 pin.changes == 0 ? "" : pin.former, ageText(pin.changedS), pin.uses),
                     pin.changes == 0 ? Style::Faint : Style::Plain});
  if (lines.empty()) lines.push_back({"the mapping file has no pins", Style::Faint});
  return lines;
}

Lines entriesOf(const std::vector<json>& entries, const char* none, bool newestFirst) {
  Lines lines;
  for (const json& entry : entries)
    lines.push_back({entryText(entry),
                     entry.value("on", false) || entry.value("kind", "") == "fault" ? Style::Alarm : Style::Plain});
  if (newestFirst) std::ranges::reverse(lines);
  if (lines.empty()) lines.push_back({none, Style::Faint});
  return lines;
}

Lines waitingLinesOf(const Look& look) {
  Lines lines;
  for (const Waiting& waiting : waitingOf(look.status))
    lines.push_back({waiting.text, waiting.late ? Style::Alarm : Style::Plain});
  if (lines.empty()) lines.push_back({"nothing waits", Style::Faint});
  return lines;
}

std::string headingOf(Section section, const View& view) {
  switch (section) {
  case Section::Overview: return "";
  case Section::Rungs:
    return fmt::format("RUNGS by {}:  rung, share, mean ns, longest ns, runs", view.byLongest ? "longest run" : "time");
  case Section::Timers: return "TIMERS that run:  elapsed, preset, remaining, rung";
  case Section::Pins: return fmt::format("PINS by {}:  value, before, changed", view.byLongest ? "name" : "change");
  case Section::Messages: return "MESSAGES that are on";
  case Section::Waiting: return "WAITING functions and requests";
  case Section::Log: return "LOG, newest first";
  }
  return "";
}

Lines linesOf(const Look& look, Section section, const View& view) {
  switch (section) {
  case Section::Overview: return {};
  case Section::Rungs: return rungsOf(look);
  case Section::Timers: return timersOf(look);
  case Section::Pins: return pinsOf(look, view.byLongest);
  case Section::Messages: return entriesOf(look.messages, "no message is on", false);
  case Section::Waiting: return waitingLinesOf(look);
  case Section::Log:
    return look.log ? entriesOf(*look.log, "nothing has happened", true)
                    : Lines{{"not known: the connection has ended before it was asked for", Style::Faint}};
  }
  return {};
}

// The overview has some lines of each section, and names how many more there are.
void addSome(Lines& page, const Look& look, const View& view, Section section, size_t most) {
  const Lines lines = linesOf(look, section, view);
  const size_t shown = lines.size() > most ? most - 1 : lines.size();
  page.push_back({headingOf(section, view), Style::Heading});
  page.insert(page.end(), lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(shown));
  if (shown < lines.size()) page.push_back({fmt::format("  and {} more", lines.size() - shown), Style::Faint});
}

void addOverview(Lines& page, const Look& look, const View& view, size_t room) {
  constexpr std::pair<Section, size_t> kParts[] = {
      {Section::Messages, 4}, {Section::Waiting, 3}, {Section::Timers, 3}, {Section::Rungs, 4}, {Section::Pins, 6}};
  constexpr size_t kAll = 20;
  for (const auto& [section, lines] : kParts)
    addSome(page, look, view, section, std::max<size_t>(room * lines / kAll, 2) - 1);
}

void addSection(Lines& page, const Look& look, const View& view, size_t room) {
  const Lines lines = linesOf(look, view.section, view);
  page.push_back({headingOf(view.section, view), Style::Heading});
  const size_t most = room < 2 ? 1 : room - 1;
  const size_t first = std::min(view.scrolled, lines.size() > most ? lines.size() - most : 0);
  const size_t end = std::min(lines.size(), first + most);
  page.insert(page.end(), lines.begin() + static_cast<std::ptrdiff_t>(first),
              lines.begin() + static_cast<std::ptrdiff_t>(end));
}

constexpr const char* kKeys = "o overview  r rungs  t timers  p pins  m messages  w waits  l log  s sort  q end";

} // namespace

std::string cutTo(std::string text, size_t width) {
  size_t columns = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (isContinued(text[i])) continue;
    if (columns++ == width) {
      text.resize(i);
      break;
    }
  }
  return text;
}

std::vector<Line> pageOf(const Look& look, const View& view, const std::string& problem, size_t width, size_t height) {
  Lines page = headOf(look, problem);
  const size_t room = height > page.size() + 1 ? height - page.size() - 1 : 0;
  if (view.section == Section::Overview)
    addOverview(page, look, view, room);
  else
    addSection(page, look, view, room);
  constexpr size_t kLeast = 3; // lines of a page with room for the keys
  page.resize(height < kLeast ? height : height - 1);
  if (height >= kLeast) page.push_back({kKeys, Style::Faint});
  for (Line& line : page) line.text = cutTo(text::withoutControls(line.text), width);
  return page;
}

std::string wholeText(const Look& look) {
  Lines lines = headOf(look, "");
  for (const Section section :
       {Section::Messages, Section::Waiting, Section::Timers, Section::Rungs, Section::Pins, Section::Log})
    addSome(lines, look, {}, section, section == Section::Log ? 20 : Observer::kMostRungs);
  std::string text;
  for (const Line& line : lines) text += text::withoutControls(line.text) + "\n";
  return text;
}

} // namespace rung::rungctl
