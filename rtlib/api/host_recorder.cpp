// See host_recorder.h.
#include "rtlib/api/host_recorder.h"

#include <algorithm>

#include "rtlib/api/instance.h"
#include "rtlib/api/running.h"
#include "rtlib/core/archive.h"

namespace rung::api {

using runtime::Event;
using runtime::EventWriter;
using runtime::putForces;
using runtime::putReply;
using runtime::zigzag;

namespace {

// Room for the events of one part: each input with an event of its own, and what else there may be.
constexpr size_t kPartRoom = 262'144;

constexpr size_t kReserve = 1024; // bytes that a state may grow by until the next one

} // namespace

void putConfiguration(EventWriter& writer, const Configured& of) noexcept {
  writer.put(Event::Configured, static_cast<uint8_t>(of.kind), of.a, of.b, of.c, of.text.size());
  writer.putBytes({reinterpret_cast<const uint8_t*>(of.text.data()), of.text.size()});
}

size_t roomFor(const std::vector<Configured>& all) noexcept {
  constexpr size_t kEach = 32;
  size_t room = 0;
  for (const Configured& one : all) room += kEach + one.text.size();
  return room;
}

size_t stateSize(const rung_instance& instance) noexcept {
  core::Saver counted({});
  return instance.wasOn && saveState(instance, counted, Waiting::LeftOut) ? counted.size() : 0;
}

// Ones written to a block of zeros are the bits of the cell.
std::unique_ptr<runtime::InputBits> inputBits(const rung_instance& instance, const Generation& generation) {
  const rung_program& program = generation.program();
  std::vector<uint8_t> masks(std::max(program.memory_size, core::Memory::kLeastBlock));
  const core::Memory memory(program, masks.data());
  for (const BoundVariable& v : instance.inputs) {
    const LocatedCell* cell = generation.cells.at(v.cell);
    if (cell != nullptr && cell->state == CellState::Good) memory.write(cell->place, UINT64_MAX);
  }
  return std::make_unique<runtime::InputBits>(masks);
}

HostRecorder::HostRecorder(rung_instance& instance, const runtime::RecorderOptions& options)
    : instance_(instance), running_(instance.running), stream_(options, kPartRoom),
      inputs_(inputBits(instance, instance.now())), stateBytes_(stateSize(instance) + kReserve) {
  running_.services().setObserver(
      [](void* self, const core::ServiceReply& reply) { static_cast<HostRecorder*>(self)->replied(reply); }, this);
}

HostRecorder::~HostRecorder() { running_.services().setObserver(nullptr, nullptr); }

void HostRecorder::inputsChanged() {
  stream_.beginAnew();
  inputs_ = inputBits(instance_, instance_.now());
}

void HostRecorder::programChanged(std::unique_ptr<runtime::InputBits>& bits) noexcept {
  stream_.beginAnew();
  std::swap(inputs_, bits);
}

// ---- whole states ------------------------------------------------------------------------------------------------

// The size is known when it is written. If there is too little room for it, false, and `stateBytes_` is enough.
bool HostRecorder::putWhole(EventWriter& writer) noexcept {
  writer.put(Event::State);
  EventWriter size = writer;
  writer.advance(EventWriter::kPadded);
  core::Saver saver(writer.rest());
  const bool saved = saveState(instance_, saver, Waiting::LeftOut);
  if (saved && !saver.fits()) stateBytes_ = saver.size() + kReserve;
  if (!saved || !saver.fits()) return false;
  size.putPadded(saver.size());
  writer.advance(saver.size());
  return true;
}

void HostRecorder::putState() noexcept {
  if (inputs_ == nullptr) return; // the replacement was prepared before the recording
  const size_t reserved = stateBytes_;
  bool isPut = putStateInto(reserved);
  if (!isPut && stateBytes_ > reserved) isPut = putStateInto(stateBytes_); // it has grown
  if (!isPut) return;
  inputs_->know(running_.block().data());
  nowUs_ = running_.nowUs();
  faulted_ = running_.faulted();
  servedKnown_ = false;
}

bool HostRecorder::putStateInto(size_t reserved) noexcept {
  constexpr size_t kOther = 256; // of the other events
  const size_t room = reserved + kOther + runtime::roomForForces(running_.forcedBits()) + inputs_->listed() +
                      roomFor(instance_.configured);
  neededOnly_ = running_.neededCopiesOnly();
  const auto put = [&](EventWriter& writer) noexcept {
    const runtime::Surroundings of = running_.surroundings();
    writer.put(Event::Surroundings, of.works, of.latches, of.neededOnly);
    putConfiguration(writer, {.kind = Configured::Kind::Stored, .a = instance_.retention != nullptr ? 1u : 0u});
    for (const Configured& one : instance_.configured) putConfiguration(writer, one);
    writer.put(Event::Inputs);
    inputs_->list(writer);
    putForces(writer, running_.forcedBits());
    return putWhole(writer);
  };
  return stream_.putState(running_.program().code_hash, running_.nowUs(), room, put);
}

// ---- before a part -----------------------------------------------------------------------------------------------

void HostRecorder::partBegins(runtime::PartKind kind, uint32_t number, bool withInputs) noexcept {
  inPart_ = true;
  stream_.announce(kind, number);
  if (stream_.whole()) {
    runtime::InputBits::Step* other = withInputs ? inputs_->firstOther(running_.block().data()) : nullptr;
    if (other != nullptr || running_.nowUs() != nowUs_) putBefore(other);
    if (running_.neededCopiesOnly() != neededOnly_) stream_.beginAnew();
  }
  if (stream_.isStateDue(running_.nowUs()) && running_.atListStart()) putState();
  if (stream_.whole()) stream_.begin();
}

// Apart, since before most parts nothing has changed. `other`: inputs from there on.
[[gnu::noinline]] void HostRecorder::putBefore(runtime::InputBits::Step* other) noexcept {
  if (running_.nowUs() != nowUs_) events().put(Event::Clock, zigzag(running_.nowUs() - nowUs_));
  const uint8_t* block = running_.block().data();
  runtime::ByteRuns runs(events(), stream_.places(), Event::Input, block);
  inputs_->compare(other, block, [&](uint32_t offset) noexcept { runs.add(offset); });
}

void HostRecorder::replied(const core::ServiceReply& reply) noexcept {
  if (!stream_.whole()) return;
  stream_.putPart();
  putReply(events(), Event::Reply, reply);
}

void HostRecorder::putBytes(uint32_t offset, uint32_t count) noexcept {
  runtime::putRun(events(), stream_.places(), {Event::Bytes, offset, count}, running_.block().data() + offset);
}

// A byte as the dialect counts them, whose bits may have a byte each.
void HostRecorder::putLogicalByte(uint32_t space, uint32_t byte) noexcept {
  constexpr uint32_t kExpanded = 8;
  const rung_range* range = running_.memory().rangeOf(space, byte);
  if (range == nullptr) return;
  putBytes(running_.memory().locateBit(space, byte, 0).offset(), range->repr == RUNG_REPR_BYTE_PER_BIT ? kExpanded : 1);
}

void HostRecorder::written(const core::Place& place) noexcept {
  if (!stream_.whole() || place.outside()) return;
  if (!place.apart()) return putBytes(place.offset(), (place.bit() + place.width() + 7) / 8);
  for (uint32_t i = 0; i < (place.width() + 7) / 8; ++i) putLogicalByte(place.space, place.byte + i);
}

void HostRecorder::writtenText(const runtime::Ref& ref) noexcept {
  if (!stream_.whole()) return;
  for (uint32_t i = 0; i < ref.count; ++i) putLogicalByte(ref.space, ref.byte + i);
}

void HostRecorder::functionBegins(uint32_t channel, int32_t kind, uint32_t code) noexcept {
  beforeFunction_ = events().size();
  if (stream_.whole()) events().put(Event::Function, channel, static_cast<uint32_t>(kind), code);
}

void HostRecorder::functionRefused() noexcept {
  if (events().fits()) events().cut(beforeFunction_);
}

void HostRecorder::aborts(uint32_t channel) noexcept {
  if (stream_.whole()) events().put(Event::Abort, channel);
}

void HostRecorder::served(bool is) noexcept {
  if (!stream_.whole() || (servedKnown_ && served_ == is)) return;
  events().put(Event::Served, is);
  served_ = is;
  servedKnown_ = true;
}

void HostRecorder::saved() noexcept {
  if (stream_.whole()) events().put(Event::Saved);
}

void HostRecorder::stopped(bool is) noexcept {
  if (stream_.whole()) events().put(Event::Stopped, is);
}

void HostRecorder::forcesChanged() noexcept {
  if (stream_.whole()) putForces(events(), running_.forcedBits());
}

// ---- within and after a part -------------------------------------------------------------------------------------

void HostRecorder::decided(int32_t answer, const core::ServiceReply& reply) noexcept {
  if (!stream_.whole()) return;
  if (inPart_) stream_.putPart();
  if (answer == RUNG_ANSWER) return putReply(events(), Event::Answer, reply);
  events().put(Event::Decision, answer == RUNG_QUEUE ? RUNG_QUEUE : RUNG_REFUSE);
}

// After a fault once more, when another program may have taken over: that has ended the part already.
void HostRecorder::partEnds() noexcept {
  if (!inPart_) return;
  inPart_ = false;
  nowUs_ = running_.nowUs();
  if (!stream_.whole()) return;
  if (stream_.hasEventsWithin()) events().put(Event::Ended);
  if (running_.faulted() != faulted_) return endFaulted();
  stream_.end();
}

// A part that has stopped the program, or put it back to work.
[[gnu::noinline]] void HostRecorder::endFaulted() noexcept {
  faulted_ = running_.faulted();
  if (!faulted_) return stream_.end();
  const rung_fault& fault = running_.fault();
  stream_.putPart();
  events().put(Event::Fault, fault.code, fault.rung, fault.line, fault.task);
  stream_.endByFault();
}

} // namespace rung::api
