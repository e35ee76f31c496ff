// Plays a program (see stage.h).
#include "tools/replay/stage.h"

#include <algorithm>
#include <map>
#include <utility>

#include "rtlib/load/program_info.h"

namespace rung::replay {
namespace {

using runtime::Event;
using runtime::EventWriter;

// The bits as cells. A bit may have a byte of its own.
std::vector<runtime::ForcedCell> cellsOf(const runtime::Instance& instance, std::span<const core::ForcedBits> bits) {
  std::vector<runtime::ForcedCell> cells;
  for (const core::ForcedBits& forced : bits) {
    const std::optional<runtime::LogicalByte> byte = runtime::byteAt(instance.program(), forced.offset);
    for (uint32_t bit = 0; byte && bit < 8; ++bit) {
      const core::Place at = instance.memory().locateBit(byte->space, byte->byte, bit);
      if (at.outside() || at.offset() != forced.offset || (forced.mask >> at.bit() & 1) == 0) continue;
      cells.push_back({.ref = runtime::bitRef(byte->space, byte->byte, bit),
                       .bits = static_cast<uint64_t>(forced.value >> at.bit() & 1)});
    }
  }
  return cells;
}

} // namespace

Result<std::unique_ptr<Stage>> Stage::make(const compiler::Compiled& compiled, compiler::EngineKind kind) {
  std::unique_ptr<Stage> stage(new Stage(compiled, kind));
  stage->options_.virtualClock = true;
  Result<std::unique_ptr<runtime::Engine>> engine = compiler::makeEngine(kind, compiled, stage->options_);
  if (!engine.ok()) return engine.failure();
  stage->engine_ = std::move(engine).value();
  stage->instance_ = std::make_unique<runtime::Instance>(*stage->engine_);
  stage->player_ = std::make_unique<runtime::Player>(*stage->instance_, *stage);
  return stage;
}

FlowEngine& Stage::flowEngine() {
  if (!flowEngine_) {
    flowEngine_ = std::make_unique<FlowEngine>(compiled_);
    flowInstance_ = std::make_unique<runtime::Instance>(flowEngine_->engine());
    flowPlayer_ = std::make_unique<runtime::Player>(*flowInstance_, *this);
  }
  return *flowEngine_;
}

bool Stage::force(runtime::Instance& instance, std::span<const core::ForcedBits> bits) {
  const bool slow = &instance == flowInstance_.get();
  InEffect& effect = slow ? slow_ : fast_;
  instance.endForces();
  effect = {};
  if (bits.empty()) return true;
  runtime::Engine& engine = slow ? flowEngine_->engine() : *engine_;
  const std::vector<runtime::ForcedCell> cells = cellsOf(instance, bits);
  auto forcing = std::make_unique<runtime::Forcing>(engine.program(), engine.context(), cells);
  if (!forcing->problem().empty()) return false;
  if (forcing->needsCode() && slow) {
    forcing->setCode({engine.program().chunk_fns, engine.context()}); // the observer holds the bits
  } else if (forcing->needsCode()) {
    auto code =
        compiler::makeForcedCode(compiled_, kind_, options_, engine.program(), engine.context(), forcing->bytes());
    if (!code.ok()) return false;
    effect.code = std::move(code).value();
    forcing->setCode(effect.code->code());
  }
  effect.forcing = std::move(forcing);
  (void)instance.force(*effect.forcing); // refused after a fault, which has ended the recorded ones, too
  return true;
}

std::optional<std::vector<uint8_t>> Stage::state() const {
  core::Saver counted({});
  if (!instance_->save(counted)) return std::nullopt;
  const std::span<const core::ForcedBits> forced = instance_->forcedBits();
  constexpr size_t kNumber = 10; // bytes of one, at most
  std::vector<uint8_t> events((8 + 3 * forced.size()) * kNumber + counted.size());
  EventWriter writer(events);
  const runtime::Surroundings around = instance_->surroundings();
  writer.put(Event::Surroundings, around.works, around.latches, around.neededOnly);
  writer.put(Event::Forces, forced.size());
  for (const core::ForcedBits& bits : forced) {
    writer.putNumber(bits.offset);
    writer.putNumber(bits.mask);
    writer.putNumber(bits.value);
  }
  writer.put(Event::State, counted.size());
  core::Saver saver(std::span(events).subspan(writer.size()));
  (void)instance_->save(saver);
  events.resize(writer.size() + counted.size());
  return events;
}

const Flow* Stage::flow(const Moment& from, std::span<const uint8_t> events, const FlowEngine::AfterRun& afterRun) {
  FlowEngine& engine = flowEngine();
  flowPlayer_->setEvents(from.events);
  if (flowPlayer_->play() != runtime::Played::State) return nullptr;
  std::vector<uint8_t> again(64);
  EventWriter writer(again);
  std::span<const uint8_t> next = events.subspan(from.position);
  if (from.repeats != 0) {
    writer.put(Event::Part, static_cast<uint8_t>(from.kind), from.number);
    next = writer.written();
  }
  flowPlayer_->setEvents(next);
  runtime::Played played = runtime::Played::End;
  const Flow& flow = engine.observe(
      *flowInstance_,
      [&] {
        do played = flowPlayer_->play();
        while (played == runtime::Played::State || played == runtime::Played::Lost);
      },
      afterRun);
  return played == runtime::Played::Part ? &flow : nullptr;
}

} // namespace rung::replay
