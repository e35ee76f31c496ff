// Plays a program (see stage.h).
#include "tools/replay/stage.h"

#include <utility>

namespace rung::replay {

using runtime::Event;
using runtime::Played;

bool playState(runtime::Player& player, std::span<const uint8_t> events) {
  player.setEvents(events);
  return player.play() == Played::State && player.play() == Played::End;
}

uint64_t takeRepeats(std::span<const uint8_t> events, size_t& position) {
  runtime::EventReader reader(events.subspan(position));
  if (reader.atEnd() || reader.next() != Event::Repeat) return 0;
  (void)reader.takeEvent();
  const uint64_t repeats = reader.takeNumber();
  if (!reader.good()) return 0;
  position += reader.position();
  return repeats;
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

const Flow* Stage::flow(std::span<const uint8_t> state, std::span<const uint8_t> events, uint64_t skipped,
                        uint64_t parts, const FlowEngine::AfterRun& afterRun) {
  FlowEngine& engine = flowEngine();
  if (!playState(*flowPlayer_, state)) return nullptr;
  flowPlayer_->setEvents(events);
  const auto play = [&](uint64_t count) {
    while (count != 0) {
      const Played what = flowPlayer_->play();
      if (what != Played::Part && what != Played::State && what != Played::Lost) return false;
      count -= what == Played::Part ? 1 : 0;
    }
    return true;
  };
  if (!play(skipped)) return nullptr;
  bool played = false;
  const Flow& flow = engine.observe(flowPlayer_->instance(), [&] { played = play(parts); }, afterRun);
  return played ? &flow : nullptr;
}

} // namespace rung::replay
