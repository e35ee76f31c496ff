// Executes lines that the user types while a program runs.
#include "tools/scenario/console.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ranges>
#include <utility>

#include "frontend/dialects/dialect.h"
#include "rtlib/nc/faults.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/similar.h"
#include "rtlib/text/utf8.h"
#include "tools/scenario/compile_step.h"
#include "tools/scenario/names.h"
#include "tools/scenario/requests.h"
#include "tools/scenario/words.h"

namespace rung::scenario {

std::vector<std::string> typedWords(std::string_view line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c != ' ' && c != '\t')
      words.back() += c;
    else if (words.size() > 1 || !words.back().empty())
      if (!words.back().empty()) words.emplace_back();
  }
  return words;
}

namespace {

std::string formLine(const StatementForm& form) { return fmt::format("  {:<42} {}", form.form, form.meaning); }

bool writeText(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  return bool(out);
}

} // namespace

std::string faultLine(const runtime::Instance& instance) {
  const std::string text = instance.faultText();
  const nc::Fault* fault = nc::findFault(instance.program().dialect, text);
  if (fault == nullptr) return "the program stopped with a fault: " + text;
  const std::string_view name = nc::shortName(*fault);
  const bool quoted = name.find(' ') != std::string_view::npos;
  return fmt::format("the program stopped with a fault: {}; try `rungc explain {}`", text,
                     quoted ? fmt::format("\"{}\"", name) : std::string(name));
}

std::span<const Console::Command> Console::commands() {
  static constexpr Command kCommands[] = {
      {{"toggle", "toggle NAME", "inverts a bit"}, Words::Value, &Console::toggle},
      {{"watch", "watch [NAME…]", "prints their changes; without names: lists the watched ones"},
       Words::Values,
       &Console::watch},
      {{"unwatch", "unwatch NAME…", "stops watching them"}, Words::Values, &Console::unwatch},
      {{"why", "why NAME", "the chain from the value back to what it came from"}, Words::Value, &Console::why},
      {{"forces", "forces", "lists the forced variables"}, Words::Other, &Console::forces},
      {{"messages", "messages", "the messages on the screen"}, Words::Other, &Console::messages},
      {{"save", "save FILE.scn", "saves the session as a scenario"}, Words::File, &Console::save},
      {{"help", "help [WORD]", "all statements, or one"}, Words::Statement, &Console::help},
      {{"quit", "quit", "ends the run, as does Ctrl-D"}, Words::Other, &Console::quit},
  };
  return kCommands;
}

std::vector<std::string> Console::words() {
  std::vector<std::string> words;
  for (const StatementInfo& info : StatementInfo::all())
    if (info.atPrompt()) words.emplace_back(info.form.word);
  for (const Command& command : commands()) words.emplace_back(command.form.word);
  return words;
}

Console::Console(Session& session, Watch& watch, Recording& recording, Why why, WhyUnexpected whyUnexpected,
                 Print print)
    : session_(session), watch_(watch), recording_(recording), why_(std::move(why)),
      whyUnexpected_(std::move(whyUnexpected)), print_(std::move(print)), completion_(session, words()) {}

std::string Console::prompt() const {
  return fmt::format("scan {}, {:.3f} s> ", session_.scans(), static_cast<double>(session_.nowUs()) / 1e6);
}

Outcome Console::fail(const std::string& message) {
  print_(message);
  return Outcome::Failed;
}

// ---- lines ---------------------------------------------------------------------------------------------------------

Outcome Console::execute(std::string_view line) {
  const Outcome outcome = executeLine(line);
  reportFault();
  return outcome;
}

Outcome Console::executeLine(std::string_view line) {
  std::vector<ScenarioWord> split;
  if (const std::string problem = splitLine(line, split); !problem.empty()) return fail(problem);
  if (split.empty()) return Outcome::Done;
  std::vector<std::string> rest;
  for (size_t i = 1; i < split.size(); ++i) rest.push_back(split[i].text);
  const std::string& first = split[0].text;
  for (const Command& command : commands())
    if (command.form.word == first || (first == "exit" && command.form.word == "quit"))
      return (this->*command.run)(rest);
  const Result<Statement> statement = parseStatement(line);
  if (!statement.ok()) return unreadable(first, rest.empty(), statement.error());
  if (statement.value().kind == Kind::Include) return include(statement.value().name);
  return execute(statement.value());
}

// A single name shows its value.
Outcome Console::unreadable(const std::string& word, bool alone, const std::string& problem) {
  if (alone) {
    const auto reading = readName(session_.instance(), session_.nc(), word, false);
    if (reading.ok()) {
      print_(fmt::format("{} = {}", word, show(reading.value())));
      return Outcome::Done;
    }
  }
  if (!problem.starts_with("unknown statement") || problem.find("did you mean") != std::string::npos)
    return fail(problem);
  const std::vector<std::string> known = words();
  const std::string_view meant = text::mostSimilar(word, known);
  return fail(problem + (meant.empty() ? "; help lists them" : text::didYouMean(meant)));
}

Outcome Console::execute(const Statement& statement) {
  const uint64_t scans = session_.scans();
  const int64_t us = session_.nowUs();
  const Forces::Values forced = session_.forces();
  const std::optional<Problem> problem = session_.execute(statement);
  watch_.look(session_);
  if (statement.kind != Kind::Unforce) reportEndOf(forced);
  for (const std::string& line : session_.shadowNews()) print_(line);
  const StatementInfo& info = StatementInfo::of(statement);
  if (problem) {
    const std::string text = problem->file.empty() ? problem->message : textOf(*problem);
    return fail(text + (info.expectsValue() ? whyUnexpected_(statement) : ""));
  }
  const bool typed = statement.file.empty();
  if (typed && info.expects) print_("ok");
  if (typed && info.program == OtherProgram::TakesOver)
    for (const std::string& line : session_.report().lines()) print_(line);
  return record(statement, scans, us);
}

// Forces end at a fault, a stop, a power-on and when another program takes over.
void Console::reportEndOf(const Forces::Values& forced) {
  if (forced.empty() || !session_.forces().empty()) return;
  print_(fmt::format("{} {} ended: {}", forced.size(), forced.size() == 1 ? "force" : "forces",
                     fmt::join(forced | std::views::keys, ", ")));
}

Outcome Console::record(const Statement& s, uint64_t scansBefore, int64_t usBefore) {
  const uint64_t scans = session_.scans() - scansBefore;
  const int64_t us = session_.nowUs() - usBefore;
  const StatementInfo& info = StatementInfo::of(s);
  const bool counts = info.advances == Advance::Scans || info.advances == Advance::Parts;
  if (counts && scans < s.count) {
    recording_.add(fmt::format("{} {}", info.form.word, scans));
    return Outcome::Interrupted;
  }
  if (info.advances == Advance::Time && us < s.microseconds) {
    recording_.add(us > 0 ? fmt::format("run {}us", us) : fmt::format("scan {}", scans));
    return Outcome::Interrupted;
  }
  if (info.program != OtherProgram::None)
    recordProgram(s);
  else
    recording_.add(s.text);
  return Outcome::Done;
}

void Console::recordProgram(const Statement& s) {
  const std::vector<std::string> files = programPaths(s);
  const bool object = files.size() == 1 && files[0].ends_with(".so");
  const std::string word(StatementInfo::of(s).form.word);
  recording_.addProgram(
      word, files, object ? fmt::format("a scenario names sources, not a shared object: {} its sources", word) : "");
}

void Console::reportFault() {
  const bool faulted = session_.instance().faulted();
  if (faulted && !faultReported_) print_(faultLine(session_.instance()) + "; cold_start and warm_start restart it");
  faultReported_ = faulted;
}

Outcome Console::include(const std::string& file) {
  const Result<Scenario> read = readStatements(file);
  if (!read.ok()) return fail(read.error());
  for (const Problem& problem : read.value().problems) print_(textOf(problem));
  if (!read.value().problems.empty()) return Outcome::Failed;
  for (const Statement& statement : read.value().statements)
    if (const Outcome outcome = execute(statement); outcome != Outcome::Done) return outcome;
  return Outcome::Done;
}

std::vector<std::string> Console::completions(std::string_view line) {
  const std::vector<std::string> typed = typedWords(line);
  const size_t index = typed.size() - 1;
  if (index == 0) return completion_.of(Words::Statement, 1, typed[0]);
  for (const Command& command : commands())
    if (command.form.word == typed[0]) return completion_.of(command.words, index, typed.back());
  const StatementInfo* info = findStatement(typed[0]);
  return info == nullptr ? std::vector<std::string>() : completion_.of(info->words, index, typed.back());
}

// ---- commands ------------------------------------------------------------------------------------------------------

Outcome Console::toggle(std::span<const std::string> words) {
  if (words.size() != 1) return fail("expected one name (the command is: toggle NAME)");
  const std::string& name = words[0];
  const std::optional<runtime::Ref> place = session_.nc().writePlace(session_.instance().program(), name);
  if (!place) return fail(unknownName(session_.instance().program(), session_.nc(), name));
  if (place->kind != runtime::RefKind::Bit) return fail(fmt::format("{0} is not a bit; write: set {0} VALUE", name));
  return executeLine(fmt::format("set {} {}", asWord(name), session_.instance().read(*place) == 0 ? 1 : 0));
}

Outcome Console::watch(std::span<const std::string> words) {
  if (words.empty()) {
    const std::vector<std::string> names = watch_.names();
    print_(names.empty() ? "nothing is watched" : fmt::format("{}", fmt::join(names, " ")));
  }
  Outcome outcome = Outcome::Done;
  for (const std::string& name : words)
    if (const std::string problem = watch_.add(name, session_); !problem.empty()) outcome = fail(problem);
  watch_.look(session_);
  return outcome;
}

Outcome Console::unwatch(std::span<const std::string> words) {
  if (words.empty()) return fail("expected names (the command is: unwatch NAME…)");
  for (const std::string& name : words)
    if (!watch_.remove(name)) return fail(fmt::format("{} is not watched", name));
  return Outcome::Done;
}

Outcome Console::messages(std::span<const std::string> words) {
  if (!words.empty()) return fail("expected no more words (the command is: messages)");
  const std::vector<nc::ShownMessage> shown = session_.nc().control().messages(session_.instance());
  for (const nc::ShownMessage& message : shown) print_(session_.nc().control().text(message));
  if (shown.empty()) print_("no messages");
  return Outcome::Done;
}

Outcome Console::forces(std::span<const std::string>) {
  const Forces::Values& values = session_.forces();
  for (const rung_force_info& force : session_.machine().instance().forced())
    if (const auto value = values.find(force.name); value != values.end())
      print_(fmt::format("{} = {}, since {:.3f} s", value->first, value->second.text,
                         static_cast<double>(force.since_us) / 1e6));
  if (values.empty()) print_("nothing is forced");
  return Outcome::Done;
}

Outcome Console::why(std::span<const std::string> words) {
  if (words.size() != 1) return fail("expected one name (the command is: why NAME)");
  const Result<std::string> text = why_(words[0]);
  if (!text.ok()) return fail(text.error());
  print_(text.value());
  return Outcome::Done;
}

Outcome Console::save(std::span<const std::string> words) {
  if (words.size() != 1 || !words[0].ends_with(".scn"))
    return fail("expected the name of a scenario (the command is: save FILE.scn)");
  const Result<std::string> text = recording_.scenario(words[0], session_, watch_.names());
  if (!text.ok()) return fail(text.error());
  if (!writeText(words[0], text.value())) return fail(fmt::format("cannot write '{}'", words[0]));
  const Scenario saved = parse(words[0], text.value());
  print_(fmt::format("wrote {}: `rungc test {}` runs it{}", words[0], words[0],
                     expectsNothing(saved) ? "; it expects nothing yet: watch or expect what it is to check" : ""));
  return Outcome::Done;
}

Outcome Console::help(std::span<const std::string> words) {
  bool found = false;
  const auto offer = [&](const StatementForm& form) {
    if (!words.empty() && form.word != words[0]) return;
    print_(formLine(form));
    found = true;
  };
  for (const StatementInfo& info : StatementInfo::all())
    if (info.atPrompt()) offer(info.form);
  for (const Command& command : commands()) offer(command.form);
  return found ? Outcome::Done : fail(fmt::format("'{}' is not a statement; help lists them", words[0]));
}

Outcome Console::quit(std::span<const std::string>) { return Outcome::Quit; }

// Watched names and messages.

namespace {

std::string atTime(const Session& session, const std::string& what) {
  return fmt::format("{:>12.3f} ms  {}", static_cast<double>(session.nowUs()) / 1000.0, what);
}

} // namespace

std::string Watch::add(const std::string& name, const Session& session) {
  const Result<Reading> reading = readName(session.instance(), session.nc(), name, false);
  if (!reading.ok()) return reading.error();
  if (std::ranges::find(watched_, name, [](const Watched& w) { return w.value.name(); }) == watched_.end())
    watched_.push_back({{name, session.instance(), session.nc()}, ""});
  return {};
}

bool Watch::remove(const std::string& name) {
  return std::erase_if(watched_, [&](const Watched& w) { return w.value.name() == name; }) > 0;
}

std::vector<std::string> Watch::names() const {
  std::vector<std::string> names;
  for (const Watched& watched : watched_) names.push_back(watched.value.name());
  return names;
}

void Watch::replaced(const Session& session, const NextProgram&) {
  for (Watched& watched : watched_) watched.value.locate(session.instance(), session.nc());
  otherTexts_ = true;
}

void Watch::look(const Session& session) {
  for (Watched& watched : watched_) {
    const std::optional<Reading> reading = watched.value.read(session.instance(), session.nc());
    std::string now = reading ? " = " + showShort(*reading) : " is gone";
    if (now == watched.last) continue;
    print_(atTime(session, watched.value.name() + now));
    watched.last = std::move(now);
  }
  printMessages(session);
}

void Watch::printMessages(const Session& session) {
  const nc::Control& control = session.nc().control();
  if (!std::exchange(otherTexts_, false) && control.shows(session.instance(), shown_)) return;
  std::vector<nc::ShownMessage> now = control.messages(session.instance());
  const auto has = [](const std::vector<nc::ShownMessage>& list, const nc::ShownMessage& message) {
    return std::ranges::find(list, message) != list.end();
  };
  for (const nc::ShownMessage& message : shown_)
    if (!has(now, message)) print_(atTime(session, control.text(message) + " is gone"));
  for (const nc::ShownMessage& message : now)
    if (!has(shown_, message)) print_(atTime(session, control.text(message)));
  shown_ = std::move(now);
}

// A session as a scenario.

namespace {

namespace fs = std::filesystem;

fs::path folderOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

bool isSetting(const compiler::Project& project, const std::string& key, const std::string& value) {
  return std::ranges::any_of(project.config,
                             [&](const compiler::Setting& s) { return s.key == key && s.value == value; });
}

std::string relativeTo(const fs::path& folder, const std::string& file) {
  std::error_code none;
  const fs::path relative = fs::proximate(file, folder, none);
  return none ? file : relative.string();
}

// Files that the control reads are relative to the scenario; those of the compiler are relative to the program.
std::string configValue(const std::string& dialect, const std::string& key, const std::string& value,
                        const fs::path& folder) {
  const frontend::Dialect* known = frontend::findDialect(dialect);
  const nc::ConfigKey* row = known == nullptr ? nullptr : nc::findConfigKey(known->configKeys, key);
  const bool file = row != nullptr && row->form == nc::ConfigForm::File && row->reader == nc::ConfigReader::Control;
  return file ? relativeTo(folder, value) : value;
}

// "" for a value that a scenario cannot write: a text that contains a quotation mark.
std::string expectationOf(const std::string& name, const Reading& reading) {
  switch (reading.kind) {
  case ValueKind::Int: return fmt::format("expect {} {}", asWord(name), reading.integer);
  case ValueKind::Real: return fmt::format("expect {} {}", asWord(name), reading.real);
  case ValueKind::Text: break;
  }
  const bool writable = reading.text.find_first_of("\"\n\r") == std::string::npos;
  return writable ? fmt::format("expect {} \"{}\"", asWord(name), reading.text) : std::string();
}

std::string withoutRung(std::string_view fault) { // the rung and the file in brackets may change
  return std::string(fault.substr(0, fault.find(" (")));
}

} // namespace

void Recording::add(std::string statement) { statements_.push_back({std::move(statement)}); }

void Recording::addProgram(std::string word, std::vector<std::string> files, const std::string& notAScenario) {
  if (start_.notAScenario.empty()) start_.notAScenario = notAScenario;
  statements_.push_back({std::move(word), std::move(files)});
}

const compiler::Project* Recording::ownProject(const std::string& folder) const {
  if (!start_.project || start_.programs != start_.project->files) return nullptr;
  const auto found = compiler::findUpwards(fs::absolute(folder).lexically_normal().string());
  std::error_code none;
  return found && fs::equivalent(*found, start_.project->file, none) ? &*start_.project : nullptr;
}

void Recording::writeStart(const std::string& path, const std::string& dialect, std::string& text) const {
  const fs::path folder = folderOf(path);
  const compiler::Project* project = ownProject(folder.string());
  if (project == nullptr) {
    text += "program";
    for (const std::string& program : start_.programs) text += " " + asWord(relativeTo(folder, program));
    text += fmt::format("\ndialect {}\n", dialect);
  }
  for (const auto& [key, value] : start_.config)
    if (project == nullptr || !isSetting(*project, key, value))
      text += fmt::format("config {} {}\n", key, asWord(configValue(dialect, key, value, folder)));
  if (start_.periodUs > 0) text += fmt::format("period {}us\n", start_.periodUs);
  for (const std::string& connect : start_.connects) text += connect + "\n";
}

Result<std::string> Recording::scenario(const std::string& path, const Session& session,
                                        const std::vector<std::string>& watched) const {
  if (!start_.notAScenario.empty()) return failure(start_.notAScenario);
  if (start_.project && !start_.project->includePaths.empty() && ownProject(folderOf(path).string()) == nullptr)
    return failure(fmt::format("the program needs the include folders of {}: save the scenario in the folder of the "
                               "project, and run the program of the project",
                               start_.project->file));
  std::string text = "# Written by the prompt of rungc run.\n";
  writeStart(path, session.instance().program().dialect, text);
  for (const Done& done : statements_) {
    text += done.statement;
    for (const std::string& file : done.files) text += " " + asWord(relativeTo(folderOf(path), file));
    text += "\n";
  }
  for (const std::string& name : watched) {
    const Result<Reading> reading = readName(session.instance(), session.nc(), name, false);
    if (const std::string line = reading.ok() ? expectationOf(name, reading.value()) : ""; !line.empty())
      text += line + "\n";
  }
  if (!session.unexpectedFault().empty())
    text += fmt::format("expect_fault {}\n", withoutRung(session.instance().faultText()));
  return text;
}

// Completion of words.

namespace {

namespace fs = std::filesystem;

std::vector<std::string> beginning(std::string_view word, const std::vector<std::string>& candidates) {
  std::vector<std::string> found;
  std::ranges::copy_if(candidates, std::back_inserter(found),
                       [&](const std::string& candidate) { return text::startsWithIgnoringCase(candidate, word); });
  return found;
}

std::vector<std::string> services(const rung_program& program) {
  std::vector<std::string> names;
  for (uint32_t i = 0; i < program.service_count; ++i) names.emplace_back(serviceRow(program, i).name);
  return names;
}

// Files in the folder that the word begins with; folders end in a slash.
std::vector<std::string> files(std::string_view word) {
  const fs::path folder = fs::path(word).parent_path();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code none;
    names.push_back((folder / at->path().filename()).string() + (at->is_directory(none) ? "/" : ""));
  }
  return names;
}

std::string_view withoutQuote(std::string_view word) { return word.starts_with('"') ? word.substr(1) : word; }

// Quotes names with blanks, as statements need them.
std::vector<std::string> inQuotes(std::vector<std::string> names) {
  for (std::string& name : names)
    if (name.find(' ') != std::string::npos) name = '"' + name + '"';
  return names;
}

} // namespace

const std::vector<std::string>& Completion::values() {
  const runtime::Instance& instance = session_.instance();
  if (values_.empty() || generation_ != instance.generation()) values_ = namesOf(instance.program(), session_.nc());
  generation_ = instance.generation();
  return values_;
}

std::vector<std::string> Completion::of(Words words, size_t index, std::string_view word) {
  if (index > 1 && words != Words::Values && words != Words::Files) return {};
  std::vector<std::string> found;
  switch (words) {
  case Words::Other: return {};
  case Words::Value:
  case Words::Values: found = beginning(word, values()); break;
  case Words::Service: found = beginning(word, services(session_.instance().program())); break;
  case Words::Statement: found = beginning(word, statements_); break;
  case Words::File:
  case Words::Files: found = inQuotes(beginning(withoutQuote(word), files(withoutQuote(word)))); break;
  case Words::PlcCommand: found = beginning(word, {"clear", "start", "stop"}); break;
  case Words::BlockCommand: found = beginning(word, {"done", "start"}); break;
  }
  std::ranges::sort(found);
  return found;
}

std::string commonStart(const std::vector<std::string>& words) {
  std::string common = words.empty() ? std::string() : words[0];
  for (const std::string& word : words) {
    size_t same = static_cast<size_t>(std::ranges::mismatch(common, word).in1 - common.begin());
    while (same > 0 && same < word.size() && text::isUtf8Continuation(word[same])) --same; // not within a character
    common.resize(same);
  }
  return common;
}

} // namespace rung::scenario
