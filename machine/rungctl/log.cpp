// See log.h.
#include "machine/rungctl/log.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <ctime>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <map>
#include <stdexcept>
#include <utility>

#include "machine/control/log.h"
#include "machine/control/log_file.h"
#include "rtlib/text/controls.h"
#include "rtlib/text/number.h"

namespace rung::rungctl {

using nlohmann::json;

// ---- one entry -----------------------------------------------------------------------------------------------------

namespace {

constexpr size_t kDate = 11; // "2026-11-29 "

bool isMessage(const json& entry) { return entry.value("kind", "") == "message"; }

// The time, without the date if that is the date of `other`.
std::string timeBeside(int64_t seconds, const std::string& other) {
  std::string text = control::dateText(seconds);
  if (text.substr(0, kDate) == other.substr(0, kDate)) text.erase(0, kDate);
  return text;
}

} // namespace

std::string entryText(const json& entry) {
  const std::string came = control::dateText(entry.value("came", int64_t{0}));
  std::string went;
  if (entry.value("on", false))
    went = "- on now";
  else if (entry.contains("went"))
    went = "- " + timeBeside(entry["went"].get<int64_t>(), came);
  else if (isMessage(entry))
    went = "- ?";
  std::string text = fmt::format("{} {:<10}  ", came, went);
  if (entry.contains("by"))
    text += fmt::format("{} (user {}, process {}): ", shown(entry["by"]["name"]), entry["by"]["user"].dump(),
                        entry["by"]["process"].dump());
  text += text::withoutControls(shown(entry["text"]));
  if (const auto times = entry.value("times", uint64_t{1}); times != 1) text += fmt::format(" ({} times)", times);
  if (entry.contains("acknowledged"))
    text += ", acknowledged " + timeBeside(entry["acknowledged"].get<int64_t>(), came);
  return text + (entry.value("cut", false) ? ", still on when the host ended" : "");
}

// ---- messages ------------------------------------------------------------------------------------------------------

int messages(Client& client, const Words& words, const volatile int& stop) {
  if (words.acknowledge) {
    const json answer = asked(client, {{"do", "acknowledge"}});
    std::string text;
    for (const json& message : answer["acknowledged"]) text += "acknowledged: " + shown(message) + "\n";
    print(words, answer, text.empty() ? "no message is on that was not acknowledged" : text);
    return cli::kOk;
  }
  const json answer = asked(client, {{"do", "messages"}, {"follow", words.follow}, {"history", words.all}});
  std::string text;
  for (const json& entry : answer["entries"])
    if (!words.on || entry.value("on", false)) text += entryText(entry) + "\n";
  print(words, answer, text);
  while (words.follow && stop == 0 && std::cout) {
    const std::optional<json> event = client.event(stop);
    if (event) print(words, *event, shown((*event)["text"]) + (event->value("event", "") == "gone" ? " has gone" : ""));
  }
  return cli::kOk;
}

// ---- log -----------------------------------------------------------------------------------------------------------

namespace {

// "90s", "10m", "2h", "3d" as seconds.
std::optional<int64_t> durationOf(const std::string& text) {
  constexpr std::pair<char, int64_t> kUnits[] = {{'s', 1}, {'m', 60}, {'h', 3600}, {'d', 86400}};
  constexpr uint32_t kMost = 1'000'000;
  for (const auto& [letter, seconds] : kUnits)
    if (text.ends_with(letter))
      if (const auto number = text::numberIn<uint32_t>(std::string_view(text).substr(0, text.size() - 1));
          number && *number <= kMost)
        return *number * seconds;
  return std::nullopt;
}

} // namespace

std::optional<int64_t> timeOf(const std::string& text, int64_t nowS) {
  if (const std::optional<int64_t> before = durationOf(text)) return nowS - *before;
  for (const char* format : {"%Y-%m-%d %H:%M:%S", "%Y-%m-%d %H:%M", "%Y-%m-%d", "%H:%M:%S", "%H:%M"}) {
    const auto now = static_cast<std::time_t>(nowS);
    std::tm parts{};
    localtime_r(&now, &parts);
    parts.tm_hour = parts.tm_min = parts.tm_sec = 0;
    parts.tm_isdst = -1;
    const char* end = strptime(text.c_str(), format, &parts);
    if (end != nullptr && *end == '\0') return std::mktime(&parts);
  }
  return std::nullopt;
}

namespace {

// Which entries are wanted.
class Wanted {
public:
  // Throws std::invalid_argument.
  explicit Wanted(const Words& words) : kinds_(words.kinds), most_(words.most) {
    if (words.since.empty()) return;
    sinceS_ = timeOf(words.since, std::time(nullptr));
    if (!sinceS_)
      throw std::invalid_argument("--since: found " + words.since +
                                  ", expected \"2026-11-29\", \"2026-11-29 14:38\", \"14:38:05\", or 90s, 10m, 2h, 3d");
  }

  bool isKind(const json& entry) const {
    return kinds_.empty() || std::ranges::find(kinds_, entry.value("kind", "")) != kinds_.end();
  }
  json of(const std::vector<json>& all) const {
    std::vector<json> found;
    for (const json& entry : all)
      if (isKind(entry) && isLate(entry)) found.push_back(entry);
    const size_t most = most_.value_or(sinceS_ ? found.size() : kMost);
    if (found.size() > most) found.erase(found.begin(), found.end() - static_cast<std::ptrdiff_t>(most));
    return found;
  }

private:
  static constexpr size_t kMost = 50;
  bool isLate(const json& entry) const {
    return !sinceS_ || entry.value("on", false) || entry.value("came", int64_t{0}) >= *sinceS_ ||
           entry.value("went", int64_t{0}) >= *sinceS_;
  }

  const std::vector<std::string>& kinds_;
  std::optional<uint64_t> most_;
  std::optional<int64_t> sinceS_;
};

std::string textOf(const json& entries) {
  std::string text;
  for (const json& entry : entries) text += entryText(entry) + "\n";
  return text.empty() ? "the log has no such entries" : text;
}

// The entries of the files, in which those in the memory of the host are newer. The file may have others that came
// after the host's answer: whether they are on is not known here.
std::vector<json> merged(const control::LogInFiles& files, const json& ofHost) {
  std::map<uint64_t, json> byNumber;
  const uint64_t last = ofHost.empty() ? UINT64_MAX : ofHost.back().value("n", uint64_t{0});
  for (const control::LogEntry& entry : files.entries)
    if (entry.number <= last) byNumber[entry.number] = control::jsonOf(entry);
  for (const json& entry : ofHost) byNumber[entry.value("n", uint64_t{0})] = entry;
  std::vector<json> all;
  for (auto& [number, entry] : byNumber) all.push_back(std::move(entry));
  return all;
}

void warnOf(const control::LogInFiles& files) {
  for (const std::string& text : files.wrong) fail(text);
}

void follow(Client& client, const Words& words, const Wanted& wanted, const volatile int& stop) {
  while (stop == 0 && std::cout) {
    const std::optional<json> event = client.event(stop);
    if (!event || event->value("event", "") != "log") continue;
    if (const json& entry = (*event)["entry"]; wanted.isKind(entry)) print(words, *event, entryText(entry));
  }
}

} // namespace

int log(Client& client, const Words& words, const volatile int& stop) try {
  const Wanted wanted(words);
  json answer = asked(client, {{"do", "log"}, {"follow", words.follow}});
  control::LogInFiles files;
  if (answer.contains("file")) files = control::readLog(answer["file"].get<std::string>());
  answer["entries"] = wanted.of(merged(files, answer["entries"]));
  print(words, answer, textOf(answer["entries"]));
  if (!std::cout) return cli::kOk; // the error of the output alone is shown
  if (!answer.contains("file"))
    fail("this host keeps its log only in memory; --retain FILE (rung_hal: retain=FILE) keeps it in FILE.log");
  else
    warnOf(files);
  if (answer.contains("problem")) fail("the log is not kept on disk: " + shown(answer["problem"]));
  if (!files.problem.empty()) fail(files.problem + "; older entries are missing");
  if (words.follow) follow(client, words, wanted, stop);
  return cli::kOk;
} catch (const std::invalid_argument& wrong) {
  return fail(wrong.what(), cli::kUsage);
}

int logFile(const Words& words) try {
  if (words.follow) return fail("--follow needs a running host, without FILE", cli::kUsage);
  const Wanted wanted(words);
  const control::LogInFiles files = control::readLog(words.file);
  if (!files.found) return fail("there is no log " + words.file, cli::kEnvironment);
  if (files.entries.empty() && files.problem.empty() && !files.wrong.empty())
    return fail(words.file + " is not a log of a host", cli::kEnvironment);
  const json answer = {{"ok", true}, {"entries", wanted.of(merged(files, json::array()))}};
  print(words, answer, textOf(answer["entries"]));
  warnOf(files);
  return files.problem.empty() ? int{cli::kOk} : fail(files.problem, cli::kEnvironment);
} catch (const std::invalid_argument& wrong) {
  return fail(wrong.what(), cli::kUsage);
}

} // namespace rung::rungctl
