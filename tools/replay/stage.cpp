// Plays a program (see stage.h).
#include "tools/replay/stage.h"

#include <utility>

namespace rung::replay {

using runtime::Event;
using runtime::EventWriter;
using runtime::Played;

bool playState(runtime::Player& player, std::span<const uint8_t> events) {
  player.setEvents(events);
  return player.play() == Played::State && player.play() == Played::End;
}

Result<std::unique_ptr<Stage>> Stage::make(const compiler::Compiled& compiled, compiler::EngineKind kind,
                                           runtime::RecordingMode mode) {
  std::unique_ptr<Stage> stage(new Stage(compiled, kind, mode));
  stage->options_.virtualClock = true;
  Result<std::unique_ptr<runtime::Engine>> engine = compiler::makeEngine(kind, compiled, stage->options_);
  if (!engine.ok()) return engine.failure();
  stage->engine_ = std::move(engine).value();
  stage->player_ = makePlayer(mode, *stage->engine_, stage->fastOwner_);
  return stage;
}

FlowEngine& Stage::flowEngine() {
  if (!flowEngine_) {
    flowEngine_ = std::make_unique<FlowEngine>(compiled_);
    flowPlayer_ = makePlayer(mode_, flowEngine_->engine(), slowOwner_);
  }
  return *flowEngine_;
}

std::optional<core::Code> Stage::FastOwner::codeFor(const runtime::Forcing& forcing) {
  runtime::Engine& engine = *stage.engine_;
  auto made = compiler::makeForcedCode(stage.compiled_, stage.kind_, stage.options_, engine.program(), engine.context(),
                                       forcing.bytes());
  if (!made.ok()) return std::nullopt;
  code = std::move(made).value();
  return code->code();
}

std::optional<core::Code> Stage::SlowOwner::codeFor(const runtime::Forcing&) {
  runtime::Engine& engine = stage.flowEngine_->engine();
  return core::Code{engine.program().chunk_fns, engine.context()};
}

const Flow* Stage::flow(const Moment& from, std::span<const uint8_t> events, const FlowEngine::AfterRun& afterRun) {
  FlowEngine& engine = flowEngine();
  if (!playState(*flowPlayer_, from.events)) return nullptr;
  std::vector<uint8_t> again(64);
  EventWriter writer(again);
  std::span<const uint8_t> next = events.subspan(from.position);
  if (from.repeats != 0) {
    writer.put(Event::Part, static_cast<uint8_t>(from.kind), from.number);
    next = writer.written();
  }
  flowPlayer_->setEvents(next);
  Played played = Played::End;
  const Flow& flow = engine.observe(
      flowPlayer_->instance(),
      [&] {
        do played = flowPlayer_->play();
        while (played == Played::State || played == Played::Lost);
      },
      afterRun);
  return played == Played::Part ? &flow : nullptr;
}

} // namespace rung::replay
