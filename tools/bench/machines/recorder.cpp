// See recorder.h.
#include "tools/bench/machines/recorder.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>
#include <utility>

#include "rtlib/load/program_info.h"

namespace rung::bench {

namespace {

// Of each offset of the block the byte that it holds or is a part of. Hidden cells of the compiler are the program's
// own and left out, as bytes of no space.
std::vector<runtime::LogicalByte> bytesOf(const rung_program& program) {
  std::vector<runtime::LogicalByte> bytes(program.memory_size);
  for (uint32_t offset = 0; offset < program.memory_size; ++offset)
    if (const auto byte = runtime::byteAt(program, offset);
        byte && (program.spaces[byte->space].flags & RUNG_SPACE_HIDDEN) == 0)
      bytes[offset] = *byte;
  return bytes;
}

} // namespace

struct Recorder::Beside {
  Beside(scenario::Session& of, const compiler::Compiled& program, compiler::EngineKind kind, EachPart receiver)
      : session(of), each(std::move(receiver)), engine(engineOf(program, kind)),
        image(rung::Image::adopt(engine->program(), engine->context())), replay(image),
        bytes(bytesOf(engine->program())), inSlots(of.nc().control().runsInSlots()) {}

  static std::unique_ptr<runtime::Engine> engineOf(const compiler::Compiled& program, compiler::EngineKind kind) {
    auto engine = compiler::makeEngine(kind, program, {});
    if (!engine.ok()) throw std::runtime_error(engine.error());
    return std::move(engine).value();
  }

  std::vector<Writes> differences(const runtime::Instance& to) const;

  scenario::Session& session;
  EachPart each;
  std::unique_ptr<runtime::Engine> engine;
  rung::Image image;
  Replay replay;
  std::vector<runtime::LogicalByte> bytes; // by offset in the block
  bool inSlots;
  bool within = false; // within a scan
  bool runs = false;   // parts have run
  bool ended = false;  // the scenario has switched the program on again
  std::string problem;
};

// The differing bytes, as runs of bytes.
std::vector<Writes> Recorder::Beside::differences(const runtime::Instance& to) const {
  const std::span<const uint8_t> from = replay.inside().block(), now = to.block();
  std::set<std::pair<uint32_t, uint32_t>> different; // space, byte
  constexpr size_t kStep = 256;
  for (size_t at = 0; at < bytes.size(); at += kStep) {
    const size_t end = std::min(at + kStep, bytes.size());
    if (std::memcmp(from.data() + at, now.data() + at, end - at) == 0) continue;
    for (size_t i = at; i < end; ++i)
      if (from[i] != now[i] && bytes[i].space != RUNG_NONE) different.emplace(bytes[i].space, bytes[i].byte);
  }
  std::vector<Writes> all;
  const rung_program& program = to.program();
  uint32_t lastSpace = RUNG_NONE, lastByte = 0;
  for (const auto& [space, byte] : different) {
    if (space != lastSpace || byte != lastByte + 1)
      all.push_back({.space = program.spaces[space].name, .byte = byte, .bytes = {}});
    all.back().bytes.push_back(to.memory().readByte(space, byte));
    lastSpace = space, lastByte = byte;
  }
  return all;
}

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
  Part part{.writes = beside_->differences(instance), .hash = 0};
  beside_->replay.write(part);
  beside_->replay.run();
  beside_->replay.drain();
  beside_->each(std::move(part));
}

} // namespace rung::bench
