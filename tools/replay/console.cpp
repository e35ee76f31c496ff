// Commands of `rungc replay` (see console.h).
#include "tools/replay/console.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fstream>
#include <utility>

#include "rtlib/load/program_info.h"
#include "tools/replay/past_messages.h"
#include "tools/replay/scenario_file.h"
#include "tools/replay/why.h"
#include "tools/scenario/in_project.h"
#include "tools/scenario/names.h"
#include "tools/scenario/runner.h"
#include "tools/scenario/trace.h"
#include "tools/scenario/words.h"

namespace rung::replay {

using scenario::Outcome;

namespace {

std::optional<uint64_t> numberOf(std::string_view word) {
  uint64_t number = 0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
  return read.ec == std::errc() && read.ptr == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

// "1.5s", "250ms", "1.5" in seconds; in microseconds.
std::optional<int64_t> timeOf(std::string_view word) {
  double number = 0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
  constexpr double kMost = 1e12; // seconds
  if (read.ec != std::errc() || !(number >= 0 && number <= kMost)) return std::nullopt;
  const std::string_view unit(read.ptr, static_cast<size_t>(word.data() + word.size() - read.ptr));
  if (unit == "us") return static_cast<int64_t>(number);
  if (unit == "ms") return static_cast<int64_t>(number * 1e3);
  return unit.empty() || unit == "s" ? std::optional(static_cast<int64_t>(number * 1e6)) : std::nullopt;
}

size_t charactersOf(std::string_view text) {
  return static_cast<size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

} // namespace

Console::Console(Past& past, scenario::Print print)
    : past_(past), print_(std::move(print)), nc_(sim::makeSimulatedNc(past.instance().program().dialect)) {}

std::span<const Console::Command> Console::commands() {
  static constexpr Command kCommands[] = {
      {"scan", "scan N", "goes to the end of scan N", false, &Console::scan},
      {"time", "time 1.5s", "goes to the first scan that ends at this time of the program's clock or later", false,
       &Console::time},
      {"next", "next [N] [scan|task|rung]", "moves forwards by a scan, a task or a rung, or by N", false,
       &Console::next},
      {"back", "back [N] [scan|task|rung]", "moves backwards", false, &Console::back},
      {"show", "show NAME…", "the values at this moment", true, &Console::show},
      {"rung", "rung [N]", "a rung with its power in this scan; without N, all that ran", false, &Console::rung},
      {"find", "find CONDITION",
       "goes to the next scan after which the condition begins to hold; without one, the last", true, &Console::find},
      {"why", "why NAME [@ SCAN]", "the chain from the value back to what it came from", true, &Console::whyCommand},
      {"writes", "writes NAME", "each write of it in this scan", true, &Console::writes},
      {"marks", "marks", "statements, marks, starts and gaps", false, &Console::marks},
      {"messages", "messages", "the messages of the program, with their scans", false, &Console::messages},
      {"faults", "faults", "the faults that stopped the program", false, &Console::faults},
      {"compare", "compare", "plays everything, and compares it with what was recorded", false, &Console::compare},
      {"export", "export FILE.vcd|.csv|.scn [FROM TO] [NAME…]",
       "writes values of scans, or a scenario that does the same", true, &Console::exportCommand},
      {"help", "help", "this list", false, &Console::help},
      {"quit", "quit", "ends it, as does Ctrl-D", false, &Console::quit},
  };
  return kCommands;
}

Outcome Console::fail(const std::string& message) {
  print_(message);
  return Outcome::Failed;
}

Outcome Console::say(const std::string& text) {
  if (!text.empty()) print_(text);
  return Outcome::Done;
}

Outcome Console::execute(std::string_view line) {
  std::vector<std::string> words = scenario::typedWords(line);
  if (!words.empty() && words.back().empty()) words.pop_back();
  if (words.empty() || words[0].starts_with('#')) return Outcome::Done;
  for (const Command& command : commands()) {
    if (command.word != words[0]) continue;
    if (command.form == command.word && words.size() > 1)
      return fail(fmt::format("expected no more words (the command is: {})", command.form));
    return (this->*command.run)(std::span(words).subspan(1));
  }
  return fail(fmt::format("'{}' is not a command; help lists them", words[0]));
}

std::string Console::prompt() const {
  const std::string at = positionText(past_);
  return runs_ ? fmt::format("{}, after {} of {} rungs> ", at, *runs_, runCount_) : at + "> ";
}

std::vector<std::string> Console::completions(std::string_view line) {
  const std::vector<std::string> typed = scenario::typedWords(line);
  std::vector<std::string> found;
  const std::string& word = typed.back();
  const auto offer = [&](std::string_view text) {
    if (text.starts_with(word)) found.emplace_back(text);
  };
  if (typed.size() == 1) {
    for (const Command& command : commands()) offer(command.word);
    return found;
  }
  for (const Command& command : commands())
    if (command.word == typed[0] && command.takesNames)
      for (const std::string& name : scenario::namesOf(past_.instance().program(), *nc_)) offer(name);
  std::ranges::sort(found);
  return found;
}

// ---- moving ------------------------------------------------------------------------------------------------------

Outcome Console::arrived(const std::string& problem) {
  runs_.reset();
  if (!problem.empty()) return fail(problem);
  for (const Landmark& landmark : past_.contents().landmarks)
    if (landmark.part == past_.part() && landmark.kind == Landmark::Kind::Fault) print_(landmarkText(landmark));
  return Outcome::Done;
}

Outcome Console::scan(Words words) {
  const std::optional<uint64_t> part = words.size() == 1 ? numberOf(words[0]) : std::nullopt;
  if (!part) return fail("expected a number (the command is: scan N)");
  return arrived(past_.goTo(*part));
}

Outcome Console::time(Words words) {
  const std::optional<int64_t> us = words.size() == 1 ? timeOf(words[0]) : std::nullopt;
  if (!us) return fail("expected a time such as 1.5s or 250ms (the command is: time 1.5s)");
  return arrived(past_.goToTime(*us));
}

Outcome Console::move(Words words, bool forwards) {
  uint64_t count = 1;
  std::string_view unit = "scan";
  if (const std::optional<uint64_t> number = words.empty() ? std::nullopt : numberOf(words[0])) {
    count = *number;
    words = words.subspan(1);
  }
  if (!words.empty()) unit = words[0];
  if (words.size() > 1) return fail(fmt::format("expected a number and scan, task or rung, found '{}'", words[1]));
  if (unit == "rung" || unit == "task") return moveByRungs(count, forwards, unit == "task");
  if (unit != "scan") return fail(fmt::format("expected scan, task or rung, found '{}'", unit));
  // Within a scan, back goes to its beginning.
  const uint64_t here = past_.part() - (runs_ && forwards ? 1 : 0);
  if (!forwards && count > here - past_.firstPart()) return fail("the recording begins here");
  if (forwards && count > past_.contents().parts - here) return fail(past_.rangeText());
  return arrived(past_.goTo(forwards ? here + count : here - count));
}

// Makes the state in the flow's instance that of after `runs_`; whether it could.
bool Console::ranToRung() {
  std::vector<uint8_t> block;
  if (*runs_ == 0) {
    if (past_.flow() == nullptr) return false;
    block.assign(past_.blockBefore().begin(), past_.blockBefore().end());
  } else {
    const Flow* flow = past_.flow([&](size_t run, std::span<const uint64_t>) {
      if (run + 1 != *runs_) return;
      const std::span<const uint8_t> now = past_.flowInstance().block();
      block.assign(now.begin(), now.end());
    });
    if (flow == nullptr) return false;
  }
  std::ranges::copy(block, past_.flowInstance().block().begin());
  return true;
}

Outcome Console::moveByRungs(uint64_t count, bool forwards, bool byTask) {
  while (count-- > 0) {
    if (!runs_ && forwards) { // into the next part
      if (std::string problem = past_.goTo(past_.part() + 1); !problem.empty()) return fail(problem);
      runs_ = 0;
    }
    const Flow* flow = past_.flow();
    if (flow == nullptr) {
      runs_.reset();
      return fail("rungs cannot be shown where the program was started or another state loaded");
    }
    runCount_ = flow->runs().size();
    const size_t at = runs_.value_or(runCount_);
    std::vector<size_t> stops = {0, runCount_};
    if (byTask)
      for (const TaskFlow& task : flow->tasks()) stops.push_back(task.firstRun + task.runCount);
    else
      for (size_t i = 0; i < runCount_; ++i) stops.push_back(i);
    std::ranges::sort(stops);
    if (forwards) {
      const auto stop = std::ranges::upper_bound(stops, at);
      runs_ = stop == stops.end() ? runCount_ : *stop;
      if (*runs_ == runCount_) runs_.reset();
    } else {
      const auto stop = std::ranges::lower_bound(stops, at);
      if (stop == stops.begin()) {
        if (std::string problem = past_.goTo(past_.part() - 1); !problem.empty()) return fail(problem);
        runs_.reset();
        ++count;
        continue;
      }
      runs_ = *std::prev(stop);
    }
  }
  if (!runs_) return Outcome::Done;
  const Flow* flow = past_.flow();
  if (flow == nullptr || *runs_ == 0) return say("before the first rung");
  return say("after " + runtime::rungText(past_.instance().program(), flow->runs()[*runs_ - 1].lowered));
}

// ---- looking -----------------------------------------------------------------------------------------------------

Result<runtime::Ref> Console::locate(std::string_view name) const {
  const rung_program& program = past_.instance().program();
  if (const std::optional<runtime::Ref> place = nc_->readPlace(program, name)) return *place;
  return failure(scenario::unknownName(program, *nc_, name));
}

Result<std::string> Console::shown(const std::string& name) {
  const bool within = runs_ && ranToRung();
  const runtime::Instance& instance = within ? past_.flowInstance() : past_.instance();
  const Result<scenario::Reading> reading = scenario::readName(instance, *nc_, name, false);
  if (!reading.ok()) return reading.failure();
  return fmt::format("{} = {}", name, scenario::show(reading.value()));
}

Outcome Console::show(Words words) {
  if (words.empty()) return fail("expected names (the command is: show NAME…)");
  for (const std::string& name : words) {
    const Result<std::string> line = shown(name);
    if (!line.ok()) return fail(line.error());
    print_(line.value());
  }
  return Outcome::Done;
}

// Below each line of the rung, what conducts and has power: = for on, - for off.
Outcome Console::rung(Words words) {
  const Flow* flow = past_.flow();
  if (flow == nullptr) return fail("no scan has led here: the program was started, or another state loaded");
  const Elements& elements = past_.flowEngine().elements();
  const std::vector<uint32_t> times = flow->timesRun();
  if (words.empty()) {
    for (uint32_t r = 0; r < elements.rungs().size(); ++r)
      if (times[r] != 0) print_(runtime::rungText(past_.instance().program(), elements.rungs()[r].lowered[0]));
    return Outcome::Done;
  }
  const std::optional<uint64_t> number = words.size() == 1 ? numberOf(words[0]) : std::nullopt;
  if (!number) return fail("expected a number (the command is: rung [N])");
  const auto rung = std::ranges::find_if(elements.rungs(), [&](const SourceRung& r) { return r.number == number; });
  if (rung == elements.rungs().end())
    return fail(fmt::format("there is no rung '{}'; the program has {}", words[0], elements.rungs().size()));
  const uint32_t index = static_cast<uint32_t>(rung - elements.rungs().begin());
  print_(fmt::format("{}{}", runtime::rungText(past_.instance().program(), rung->lowered[0]),
                     times[index] == 0   ? ": did not run in this scan"
                     : times[index] == 1 ? ""
                                         : fmt::format(": ran {} times, this is the last", times[index])));
  const std::vector<std::optional<Power>> powers = flow->lastPowers();
  std::string_view text = past_.flowEngine().rung(rung->lowered[0]).sourceText;
  uint32_t line = rung->line;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    print_("  " + std::string(text.substr(0, end)));
    std::string power;
    for (const Element& element : elements.all().subspan(rung->firstElement, rung->elementCount)) {
      if (element.line != line) continue;
      const std::optional<Power>& of = powers[element.firstPin];
      const size_t at = element.column > 0 ? element.column - 1 : 0;
      const std::string_view name = element.pins[0].text;
      const size_t length = std::max<size_t>(1, charactersOf(name.substr(0, name.find(' ', 1))));
      if (power.size() < at + length) power.resize(at + length, ' ');
      std::fill_n(power.begin() + static_cast<ptrdiff_t>(at), length,
                  !of || *of == Power::NotReached ? '?'
                  : *of == Power::On              ? '='
                                                  : '-');
    }
    if (!power.empty()) print_("  " + power);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
  }
  return Outcome::Done;
}

Outcome Console::find(Words words) {
  if (!words.empty()) condition_ = fmt::format("{}", fmt::join(words, " "));
  if (condition_.empty())
    return fail("expected a condition such as X8.4 or D100 > 500 (the command is: find CONDITION)");
  const Condition::Locate locate = [this](std::string_view name) { return this->locate(name); };
  Result<Condition> condition = Condition::parse(condition_, locate);
  if (!condition.ok()) return fail(condition.error());
  const uint64_t here = past_.part();
  std::string problem;
  const auto found = findNext(past_, condition.value(), locate, here, past_.contents().parts, problem);
  runs_.reset();
  if (found) return arrived({});
  (void)past_.goTo(here);
  return fail(problem.empty() ? "it does not begin to hold after this scan; `scan " +
                                    std::to_string(past_.firstPart()) + "` goes to the beginning"
                              : problem);
}

Result<std::vector<uint64_t>> Console::findAll(std::string_view text, size_t most) {
  const Condition::Locate locate = [this](std::string_view name) { return this->locate(name); };
  Result<Condition> condition = Condition::parse(text, locate);
  if (!condition.ok()) return condition.failure();
  std::string problem;
  std::vector<uint64_t> found =
      replay::findAll(past_, condition.value(), locate, past_.firstPart(), past_.contents().parts, most, problem);
  if (!problem.empty()) return failure(problem);
  return found;
}

// NAME, NAME @ SCAN, NAME@SCAN.
Result<std::string> Console::why(Words words, bool asJson) {
  std::string text = fmt::format("{}", fmt::join(words, " "));
  if (const size_t at = text.rfind('@'); at != std::string::npos && at != 0) {
    std::string_view number = std::string_view(text).substr(at + 1);
    while (number.starts_with(' ')) number.remove_prefix(1);
    const std::optional<uint64_t> part = numberOf(number);
    const std::optional<int64_t> us = part ? std::nullopt : timeOf(number);
    if (part || us) {
      if (std::string problem = part ? past_.goTo(*part) : past_.goToTime(*us); !problem.empty())
        return failure(problem);
      runs_.reset();
      text.resize(at);
      while (text.ends_with(' ')) text.pop_back();
    }
  }
  if (text.empty()) return failure("expected a name (the command is: why NAME [@ SCAN])");
  const Result<runtime::Ref> place = locate(text);
  if (!place.ok()) return place.failure();
  if (place.value().kind == runtime::RefKind::Constant) return failure(text + " is a constant");
  const Explanation explanation = replay::why(past_, place.value());
  return asJson ? jsonOf(explanation) : textOf(explanation);
}

Outcome Console::whyCommand(Words words) {
  const Result<std::string> text = why(words, false);
  return text.ok() ? say(text.value()) : fail(text.error());
}

Outcome Console::writes(Words words) {
  const Result<runtime::Ref> place =
      words.size() == 1 ? locate(words[0])
                        : Result<runtime::Ref>(failure("expected a name (the command is: writes NAME)"));
  if (!place.ok()) return fail(place.error());
  const std::vector<std::string> lines = writesOf(past_, place.value());
  return say(lines.empty() ? "no rung wrote it in this scan" : fmt::format("{}", fmt::join(lines, "\n")));
}

std::string Console::landmarkText(const Landmark& landmark) const {
  const char* kind = landmark.kind == Landmark::Kind::Note ? "before" : "at";
  const uint64_t part = landmark.part + (landmark.kind == Landmark::Kind::Note ? 1 : 0);
  return fmt::format("{} scan {}: {}", kind, part, landmark.text);
}

Outcome Console::marks(Words) {
  for (const Landmark& landmark : past_.contents().landmarks) print_(landmarkText(landmark));
  return Outcome::Done;
}

Outcome Console::faults(Words) {
  const uint64_t here = past_.part();
  bool any = false;
  for (const Landmark& landmark : past_.contents().landmarks) {
    if (landmark.kind != Landmark::Kind::Fault || !past_.goTo(landmark.part).empty()) continue;
    print_(fmt::format("{}: {}", positionText(past_), past_.instance().faultText()));
    any = true;
  }
  (void)past_.goTo(here);
  return any ? Outcome::Done : say("no fault");
}

Outcome Console::messages(Words) {
  const uint64_t here = past_.part();
  bool any = false;
  const std::string problem = forEachMessage(past_, [&](const PastMessage& change) {
    print_(fmt::format("{}: {}{}", positionText(past_), change.gone ? "gone: " : "", change.text));
    any = true;
  });
  (void)past_.goTo(here);
  if (!problem.empty()) return fail(problem);
  return any ? Outcome::Done : say("no messages");
}

// Where events are missing between two parts, or cannot be read.
std::vector<std::string> Console::gaps(uint64_t from, uint64_t to) const {
  std::vector<std::string> gaps;
  for (const Landmark& landmark : past_.contents().landmarks) {
    const bool isGap = landmark.kind == Landmark::Kind::Lost || landmark.kind == Landmark::Kind::Damaged;
    if (isGap && landmark.part >= from && landmark.part <= to)
      gaps.push_back(fmt::format("after scan {}: {}", landmark.part, landmark.text));
  }
  return gaps;
}

Outcome Console::compare(Words) {
  const uint64_t here = past_.part();
  std::string problem = past_.goTo(past_.firstPart());
  while (problem.empty() && past_.next()) {
  }
  if (problem.empty()) problem = past_.problem();
  for (const Difference& difference : past_.differences())
    print_(fmt::format("scan {}: otherwise than recorded{}{}", difference.part, difference.place.empty() ? "" : " at ",
                       difference.place));
  const std::vector<std::string> missing = gaps(0, past_.contents().parts);
  if (past_.differences().empty())
    print_(fmt::format("{} scans do what was recorded{}", past_.part() - past_.firstPart(),
                       problem.empty() && missing.empty() ? "" : "; the recording has more"));
  for (const std::string& gap : missing) print_(gap);
  if (!problem.empty()) print_(problem);
  const bool good = past_.differences().empty() && problem.empty() && missing.empty();
  (void)past_.goTo(here);
  return good ? Outcome::Done : Outcome::Failed;
}

// ---- files -------------------------------------------------------------------------------------------------------

Result<std::vector<std::string>> Console::exportTo(const std::string& path, uint64_t from, uint64_t to,
                                                   std::vector<std::string> names) {
  if (from >= to) return failure(fmt::format("the first scan, {}, is not before the last one, {}", from, to));
  if (to > past_.contents().parts || from < past_.firstPart()) return failure(past_.rangeText());
  runs_.reset();
  if (!path.ends_with(".scn")) return exportTrace(path, from, to, std::move(names));
  if (!names.empty()) return failure("a scenario has what others wrote, and no list of names");
  return exportScenario(path, from, to);
}

// Of another program that takes over, the names that it has, too.
Result<std::vector<std::string>> Console::exportTrace(const std::string& path, uint64_t from, uint64_t to,
                                                      std::vector<std::string> names) {
  if (std::string wrong = scenario::traceFileProblem(path); !wrong.empty()) return failure(std::move(wrong));
  if (std::string problem = past_.goTo(from); !problem.empty()) return failure(std::move(problem));
  if (names.empty()) names = scenario::defaultTraceNames(past_.instance().program(), past_.compiled().uses.get());
  if (std::string wrong = scenario::Trace::nameProblem(names, past_.instance(), *nc_); !wrong.empty())
    return failure(std::move(wrong));
  auto trace = scenario::Trace::open(path, names, past_.instance(), *nc_, from);
  if (!trace.ok()) return trace.failure();
  const NotCompared notCompared(past_);
  uint32_t program = past_.programNumber();
  int64_t us = past_.instance().nowUs();
  while (past_.part() < to && past_.next()) {
    if (std::exchange(program, past_.programNumber()) != past_.programNumber())
      trace.value()->relocate(past_.instance(), *nc_);
    const int64_t now = past_.instance().nowUs();
    if (now < std::exchange(us, now)) trace.value()->clockSet(now); // it was started again
    trace.value()->sample(past_.instance(), *nc_, past_.part());
  }
  if (std::string wrong = trace.value()->finish(); !wrong.empty()) return failure(std::move(wrong));
  std::vector<std::string> lacks = gaps(from, to);
  if (past_.part() < to)
    lacks.push_back(fmt::format("it ends with scan {}: {}", past_.part(),
                                past_.problem().empty() ? "the recording ends there" : past_.problem()));
  return lacks;
}

namespace {

// The scenario is run, so that none is written that fails without a word. "" or what it does otherwise than recorded.
std::string whatElseHappens(const std::string& path, const ScenarioText& text) {
  scenario::Scenario scenario = scenario::parse(path, text.text);
  scenario::takeProject(scenario);
  const scenario::RunResult result = scenario::run(scenario, {.engines = {compiler::EngineKind::Interp}});
  if (!result.environment.empty()) return "it cannot be run here: " + result.environment;
  const auto isTheFault = [&](const scenario::Problem& problem) {
    return !text.fault.empty() && problem.message.find(text.fault) != std::string::npos;
  };
  const auto other = std::ranges::find_if_not(result.problems, isTheFault);
  if (other != result.problems.end()) return "it does something else than was recorded: " + textOf(*other);
  if (result.problems.empty() && !text.fault.empty())
    return "it does not stop with the fault that was recorded: " + text.fault;
  return {};
}

} // namespace

Result<std::vector<std::string>> Console::exportScenario(const std::string& path, uint64_t from, uint64_t to) {
  Result<ScenarioText> scenario = scenarioOf(past_, path, from, to);
  if (!scenario.ok()) return scenario.failure();
  std::ofstream out(path, std::ios::binary);
  out << scenario.value().text;
  out.close();
  if (!out) return failure(fmt::format("cannot write '{}'", path));
  std::vector<std::string> lacks = std::move(scenario.value().lacks);
  if (std::string other = whatElseHappens(path, scenario.value()); !other.empty()) lacks.push_back(std::move(other));
  return lacks;
}

Outcome Console::exportCommand(Words words) {
  if (words.empty()) return fail("expected a file (the command is: export FILE.vcd|.csv|.scn [FROM TO] [NAME…])");
  uint64_t from = past_.firstPart(), to = past_.contents().parts;
  size_t next = 1;
  if (words.size() >= 3 && numberOf(words[1]) && numberOf(words[2])) {
    from = *numberOf(words[1]);
    to = *numberOf(words[2]);
    next = 3;
  }
  const uint64_t here = past_.part();
  const Result<std::vector<std::string>> lacks =
      exportTo(words[0], from, to, {words.begin() + static_cast<ptrdiff_t>(next), words.end()});
  (void)past_.goTo(here);
  if (!lacks.ok()) return fail(lacks.error());
  print_("wrote " + words[0]);
  for (const std::string& lack : lacks.value()) print_(lack);
  return lacks.value().empty() ? Outcome::Done : Outcome::Failed;
}

Outcome Console::help(Words) {
  for (const Command& command : commands()) print_(fmt::format("  {:<42} {}", command.form, command.meaning));
  return Outcome::Done;
}

} // namespace rung::replay
