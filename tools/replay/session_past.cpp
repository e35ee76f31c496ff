// See session_past.h.
#include "tools/replay/session_past.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "tools/replay/past.h"
#include "tools/scenario/names.h"
#include "tools/scenario/words.h"

namespace rung::replay {

SessionPast::SessionPast(scenario::Session& session, compiler::GetCompiled program, SessionRecorder* recorder)
    : session_(session), programs_{std::move(program)},
      own_(recorder == nullptr ? std::make_unique<SessionRecorder>(session) : nullptr),
      recorder_(recorder == nullptr ? own_.get() : recorder) {}

void SessionPast::executing(const scenario::Session& session, const scenario::Statement& statement) {
  if (own_) own_->executing(session, statement);
}

void SessionPast::started(scenario::Session& session) {
  if (own_) own_->started(session);
}

void SessionPast::restored(const scenario::Session& session) {
  if (own_) own_->restored(session);
}

void SessionPast::scanned(const scenario::Session& session) {
  if (own_) own_->scanned(session);
}

void SessionPast::replaced(const scenario::Session& session, const scenario::NextProgram& next) {
  if (own_) own_->replaced(session, next);
  if (next.compiled) programs_.push_back(next.compiled);
}

// The programs stay those of the session.
Result<Recording> SessionPast::recording() {
  std::vector<std::shared_ptr<const compiler::Compiled>> programs;
  for (const compiler::GetCompiled& get : programs_) {
    const Result<const compiler::Compiled*> program = get();
    if (!program.ok()) return program.failure();
    programs.emplace_back(std::shared_ptr<void>(), program.value());
  }
  return recorder_->soFar(std::move(programs));
}

Result<SessionPast::Answer> SessionPast::answer(const std::string& name, bool wantReal, uint64_t back) {
  const auto said = [](std::string text) { return Answer{std::nullopt, std::move(text)}; };
  const Result<scenario::Reading> now = scenario::readName(session_.instance(), session_.nc(), name, wantReal);
  if (!now.ok()) return now.failure();
  const std::string value = scenario::show(now.value());
  std::optional<runtime::Ref> place = session_.nc().readPlace(session_.instance().program(), name);
  if (!place) return said(fmt::format("{} = {}, in the NC, of which nothing is recorded", name, value));
  if (place->kind == runtime::RefKind::Constant) return said(fmt::format("{} = {}, a constant", name, value));
  if (wantReal) place = runtime::asReal(session_.instance().memory(), *place).value_or(*place);
  const Result<Recording> recording = this->recording();
  if (!recording.ok()) return recording.failure();
  const Result<std::unique_ptr<Past>> opened = Past::open(recording.value(), {.engine = compiler::EngineKind::Interp});
  if (!opened.ok()) return said(fmt::format("{} = {}; no scan has run", name, value));
  Past& past = *opened.value();
  if (std::string problem = past.goTo(past.contents().parts - std::min(back, past.contents().parts)); !problem.empty())
    return failure(std::move(problem));
  const Result<scenario::Reading> then = scenario::readName(past.instance(), session_.nc(), name, wantReal);
  if (then.ok() && scenario::show(then.value()) != value)
    return said(fmt::format("{} = {}, set after {}; no scan has run since", name, value, positionText(past)));
  WhyOptions options;
  if (past.firstPart() == 0) options.beginning = "the start";
  return Answer{replay::why(past, *place, options), {}};
}

uint64_t SessionPast::scans() {
  const Result<Recording> recording = this->recording();
  return recording.ok() ? Contents(recording.value()).parts : session_.scans();
}

Result<std::string> SessionPast::why(const std::string& name, uint64_t back) {
  Result<Answer> found = answer(name, false, back);
  if (!found.ok()) return found.failure();
  return found.value().explanation ? textOf(*found.value().explanation) : std::move(found.value().text);
}

std::string SessionPast::whyUnexpected(const scenario::Statement& expectation, const std::string& rest) {
  constexpr TextLimits kShort{.steps = 3, .places = 6};
  std::string lines;
  if (session_.instance().faulted())
    lines = fmt::format("the program has stopped with a fault: {}\n", session_.instance().faultText());
  if (session_.instance().stopped()) lines += "the program is stopped\n";
  const Result<Answer> found = answer(expectation.name, scenario::wantsReal(expectation), 0);
  if (found.ok() && found.value().explanation) {
    const std::string text = textOf(*found.value().explanation, kShort);
    lines += text + "\n";
    if (text != textOf(*found.value().explanation)) lines += fmt::format("  all of it: {}\n", rest);
  }
  std::string indented;
  for (size_t begin = 0, end = 0; (end = lines.find('\n', begin)) != std::string::npos; begin = end + 1)
    indented += "\n    " + lines.substr(begin, end - begin);
  return indented;
}

scenario::RunResult runAndExplain(const scenario::Scenario& scenario, const scenario::RunOptions& options) {
  scenario::RunResult result = scenario::run(scenario, options);
  if (result.unexpected == nullptr) return result;
  const bool interpreted = options.engines.front() == compiler::EngineKind::Interp;
  std::unique_ptr<SessionPast> past;
  std::string why;
  scenario::RunOptions again{
      .engines = {interpreted ? compiler::EngineKind::Interp : compiler::EngineKind::Tiered},
      .marks = true,
      .programs = options.programs,
      .started = [&](scenario::Session& session, const compiler::Compiled& program) -> std::string {
        past = std::make_unique<SessionPast>(
            session, [&program]() -> Result<const compiler::Compiled*> { return &program; }, nullptr);
        session.addObserver(*past);
        return {};
      },
      .ended =
          [&](scenario::Session&) {
            why = past->whyUnexpected(*result.unexpected,
                                      fmt::format("rungc replay {} --why {}", scenario::asWord(scenario.path),
                                                  scenario::asWord(result.unexpected->name)));
            past.reset();
          }};
  again.engine.cppCompiler = options.engine.cppCompiler;
  if (scenario::run(scenario, again).unexpected == result.unexpected) result.problems.back().message += why;
  return result;
}

} // namespace rung::replay
