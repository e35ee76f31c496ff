// See replay.h.
#include "tools/bench/machines/replay.h"

#include <algorithm>
#include <stdexcept>

#include "ir/support/hash.h"
#include "rtlib/api/instance.h"

namespace rung::bench {
Replay::Replay(const rung::Image& image)
    : image_(image), instance_(image), inside_(api::insideOf(*instance_.handle())),
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
  if (!own_.empty())
    eachByte(part, [&](uint32_t space, uint32_t byte, uint32_t offset, uint32_t) {
      if (own_[offset] == 0) instance_.handle()->recorder->written(inside_.memory().locate(space, byte, 1));
    });
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

// each(space, byte, offset, bytes of the block) for each byte that the machine writes.
template <class Each>
void Replay::eachByte(const Part& part, Each each) const {
  const core::Memory memory = inside_.memory();
  for (const Writes& writes : part.writes) {
    const uint32_t space = spaceOf(writes.space);
    for (uint32_t i = 0; i < writes.bytes.size(); ++i) {
      const bool expanded = memory.rangeOf(space, writes.byte + i)->repr == RUNG_REPR_BYTE_PER_BIT;
      each(space, writes.byte + i, memory.locateBit(space, writes.byte + i, 0).offset(), expanded ? 8u : 1u);
    }
  }
}

std::vector<uint8_t> Replay::ownBytes(const Recording& recording) const {
  Replay probe(image_);
  const std::span<const uint8_t> block = probe.inside_.block();
  std::vector<uint8_t> own(block.size()), written(block.size()), known(block.size());
  const auto isOther = [&](size_t i) { return written[i] != 0 && known[i] != block[i]; };
  for (const Part& part : recording.parts) {
    for (size_t i = 0; i < block.size(); ++i)
      if (isOther(i)) own[i] = 0;
    probe.write(part);
    probe.eachByte(part, [&](uint32_t, uint32_t, uint32_t offset, uint32_t bytes) {
      for (uint32_t i = offset; i < offset + bytes; ++i) {
        if (written[i] == 0) own[i] = 0xFF;
        written[i] = 1;
        known[i] = block[i];
      }
    });
    probe.run();
    probe.drain();
  }
  // Of a byte whose bits lie apart, all or none.
  for (const Part& part : recording.parts)
    eachByte(part, [&](uint32_t, uint32_t, uint32_t offset, uint32_t bytes) {
      const auto first = own.begin() + offset;
      if (std::find(first, first + bytes, 0) != first + bytes) std::fill_n(first, bytes, 0);
    });
  return own;
}

void Replay::record(const Recording& recording, const std::string& folder) {
  own_ = ownBytes(recording);
  rung_instance& instance = *instance_.handle();
  instance.recorder = std::make_unique<api::HostRecorder>(instance, runtime::RecorderOptions{});
  auto inputs = std::make_unique<runtime::InputBits>(own_);
  instance.recorder->programChanged(inputs);
  writer_ = std::make_unique<runtime::RecordingWriter>(instance.recorder->stream(), runtime::RecordingMode::Control,
                                                       runtime::RecordingOptions{.folder = folder});
}

runtime::RecordingState Replay::recorded() {
  instance_.handle()->recorder->stream().flush();
  writer_->look();
  return writer_->state();
}

void Replay::addProgram(uint64_t hash, const std::string& ir) {
  writer_->addProgram(hash, {reinterpret_cast<const uint8_t*>(ir.data()), ir.size()});
}

void Replay::endRecord() {
  writer_.reset();
  instance_.handle()->recorder.reset();
}

void Replay::drain() {
  while (instance_.nextMessage()) {
  }
}

} // namespace rung::bench
