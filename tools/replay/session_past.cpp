// See session_past.h.
#include "tools/replay/session_past.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "tools/replay/past.h"
#include "tools/replay/why.h"
#include "tools/scenario/names.h"

namespace rung::replay {

SessionPast::SessionPast(scenario::Session& session, compiler::GetCompiled program, SessionRecorder* recorder)
    : session_(session), programs_{std::move(program)},
      own_(recorder == nullptr ? std::make_unique<SessionRecorder>(session) : nullptr),
      recorder_(recorder == nullptr ? own_.get() : recorder) {}

void SessionPast::executing(const scenario::Session& session, const scenario::Statement& statement) {
  if (own_) own_->executing(session, statement);
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

Result<std::string> SessionPast::why(const std::string& name, uint64_t back) {
  const Result<scenario::Reading> now = scenario::readName(session_.instance(), session_.nc(), name, false);
  if (!now.ok()) return now.failure();
  const std::string value = scenario::show(now.value());
  const std::optional<runtime::Ref> place = session_.nc().readPlace(session_.instance().program(), name);
  if (!place) return fmt::format("{} = {}, in the NC, of which nothing is recorded", name, value);
  if (place->kind == runtime::RefKind::Constant) return fmt::format("{} = {}, a constant", name, value);
  const Result<Recording> recording = this->recording();
  if (!recording.ok()) return recording.failure();
  const Result<std::unique_ptr<Past>> opened = Past::open(recording.value(), {.engine = compiler::EngineKind::Interp});
  if (!opened.ok()) return fmt::format("{} = {}; no scan has run", name, value);
  Past& past = *opened.value();
  if (std::string problem = past.goTo(past.contents().parts - std::min(back, past.contents().parts)); !problem.empty())
    return failure(std::move(problem));
  const Result<scenario::Reading> then = scenario::readName(past.instance(), session_.nc(), name, false);
  if (then.ok() && scenario::show(then.value()) != value)
    return fmt::format("{} = {}, set after {}; no scan has run since", name, value, positionText(past));
  return textOf(replay::why(past, *place));
}

} // namespace rung::replay
