// See recorder.h.
#include "tools/bench/machines/recorder.h"

#include <stdexcept>
#include <utility>

namespace rung::bench {

struct Recorder::Beside {
  Beside(scenario::Session& of, const compiler::Compiled& program, compiler::EngineKind kind, EachPart receiver)
      : session(of), each(std::move(receiver)), engine(engineOf(program, kind)),
        image(rung::Image::adopt(engine->program(), engine->context())), replay(image),
        inSlots(of.nc().control().runsInSlots()) {}

  static std::unique_ptr<runtime::Engine> engineOf(const compiler::Compiled& program, compiler::EngineKind kind) {
    auto engine = compiler::makeEngine(kind, program, {});
    if (!engine.ok()) throw std::runtime_error(engine.error());
    return std::move(engine).value();
  }

  scenario::Session& session;
  EachPart each;
  std::unique_ptr<runtime::Engine> engine;
  rung::Image image;
  Replay replay;
  bool inSlots;
  bool within = false; // within a scan
  bool runs = false;   // parts have run
  bool ended = false;  // the scenario has switched the program on again
  std::string problem;
};

namespace {

// The differing bytes, as runs of bytes. Hidden cells of the compiler are the program's own and left out.
std::vector<Writes> differences(const runtime::Instance& from, const runtime::Instance& to) {
  std::vector<Writes> all;
  const rung_program& program = to.program();
  for (uint32_t space = 0; space < program.space_count; ++space) {
    if ((program.spaces[space].flags & RUNG_SPACE_HIDDEN) != 0) continue;
    uint32_t last = 0;
    for (uint32_t byte = 0; byte < program.spaces[space].byte_count; ++byte) {
      const uint8_t value = to.memory().readByte(space, byte);
      if (from.memory().readByte(space, byte) == value) continue;
      if (all.empty() || all.back().space != program.spaces[space].name || last + 1 != byte)
        all.push_back({.space = program.spaces[space].name, .byte = byte, .bytes = {}});
      all.back().bytes.push_back(value);
      last = byte;
    }
  }
  return all;
}

} // namespace

Recorder::Recorder(scenario::Session& session, const compiler::Compiled& program, compiler::EngineKind engine,
                   EachPart each)
    : beside_(std::make_unique<Beside>(session, program, engine, std::move(each))) {
  session.addObserver(*this);
}

Recorder::~Recorder() = default;

Replay& Recorder::replay() { return beside_->replay; }
const std::string& Recorder::problem() const { return beside_->problem; }

void Recorder::started(scenario::Session& session) {
  beside_->ended = beside_->runs;
  session.instance().setTaskWatch(beside_->ended ? nullptr : this);
}

void Recorder::scanned(const scenario::Session& session) {
  beside_->within = false;
  if (beside_->ended) return;
  if (session.nowUs() != beside_->replay.inside().nowUs() && beside_->problem.empty())
    beside_->problem = "the scenario runs other parts than whole scans";
}

void Recorder::begins(const runtime::Instance& instance, uint32_t task) {
  const bool partBegins = beside_->inSlots ? task == instance.program().fast_task : !beside_->within;
  if (!partBegins || beside_->ended || !beside_->problem.empty()) return;
  beside_->within = beside_->runs = true;
  Part part{.writes = differences(beside_->replay.inside(), instance), .hash = 0};
  beside_->replay.write(part);
  beside_->replay.run();
  beside_->replay.drain();
  part.hash = beside_->replay.hash();
  beside_->each(std::move(part));
}

} // namespace rung::bench
