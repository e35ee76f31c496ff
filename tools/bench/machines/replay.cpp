// See replay.h.
#include "tools/bench/machines/replay.h"

#include <stdexcept>

#include "ir/support/hash.h"
#include "rtlib/api/instance.h"

namespace rung::bench {
Replay::Replay(const rung::Image& image)
    : instance_(image), inside_(api::insideOf(*instance_.handle())),
      runPart_(instance_.handle()->control->runsInSlots() ? &rung_instance_slot : &rung_instance_scan) {
  instance_.powerOn(rung::Power::Cold);
}

uint32_t Replay::spaceOf(const std::string& name) const {
  const rung_program& program = inside_.program();
  for (uint32_t space = 0; space < program.space_count; ++space)
    if (name == program.spaces[space].name) return space;
  throw std::runtime_error("the program has no space " + name + ", which the recording names");
}

void Replay::write(const Part& part) {
  for (const Writes& writes : part.writes) {
    const uint32_t space = spaceOf(writes.space);
    if (!inside_.memory().contains(space, writes.byte, static_cast<uint32_t>(writes.bytes.size())))
      throw std::runtime_error("the program's space " + writes.space + " ends before byte " +
                               std::to_string(writes.byte + writes.bytes.size()) + " of the recording");
    for (uint32_t i = 0; i < writes.bytes.size(); ++i)
      inside_.memory().writeByte(space, writes.byte + i, writes.bytes[i]);
  }
}

uint64_t Replay::hash() const {
  const bool only = inside_.neededCopiesOnly();
  inside_.setNeededCopiesOnly(false); // needed to bring in the copies that are left out
  const uint64_t hash = hashOfAll();
  inside_.setNeededCopiesOnly(only);
  return hash;
}

uint64_t Replay::hashOfAll() const {
  uint64_t hash = kHashSeed;
  const auto add = [&](uint64_t value) {
    hash = hashBytes({reinterpret_cast<const char*>(&value), sizeof value}, hash);
  };
  const rung_program& program = inside_.program();
  for (uint32_t space = 0; space < program.space_count; ++space)
    for (uint32_t byte = 0; byte < program.spaces[space].byte_count; ++byte)
      if (const uint8_t value = inside_.memory().readByte(space, byte); value != 0)
        add(uint64_t{space} << 40 | uint64_t{byte} << 8 | value);
  add(static_cast<uint64_t>(inside_.nowUs()));
  add(inside_.faulted() ? inside_.fault().code : RUNG_NONE);
  return hash;
}

void Replay::record(const Recording& recording, const std::string& folder) {
  std::vector<uint8_t> masks(inside_.block().size());
  const core::Memory memory(inside_.program(), masks.data());
  for (const Part& part : recording.parts)
    for (const Writes& writes : part.writes)
      for (uint32_t i = 0; i < writes.bytes.size(); ++i) memory.writeByte(spaceOf(writes.space), writes.byte + i, 0xFF);
  rung_instance& instance = *instance_.handle();
  instance.recorder = std::make_unique<api::HostRecorder>(instance, runtime::RecorderOptions{});
  auto inputs = std::make_unique<runtime::InputBits>(masks);
  instance.recorder->programChanged(inputs);
  writer_ = std::make_unique<runtime::RecordingWriter>(instance.recorder->stream(), runtime::RecordingMode::Control,
                                                       runtime::RecordingOptions{.folder = folder});
}

runtime::RecordingState Replay::recorded() {
  instance_.handle()->recorder->stream().flush();
  writer_->look();
  return writer_->state();
}

void Replay::drain() {
  while (instance_.nextMessage()) {
  }
}

} // namespace rung::bench
