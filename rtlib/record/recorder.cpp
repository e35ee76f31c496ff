// See recorder.h.
#include "rtlib/record/recorder.h"

#include <cstring>
#include <utility>

namespace rung::runtime {

namespace {

// Room for the events of one part: each watched byte with an event of its own, twice, and what else there may be.
size_t partRoom(const RecordedBytes& bytes) {
  constexpr size_t kRest = 65'536, kEvent = 12;
  return kRest + kEvent * (bytes.before.size() + 2 * bytes.within.size());
}

// Joins bytes of the block to runs, each of which is an event.
class ByteRuns {
public:
  ByteRuns(EventWriter& writer, const uint8_t* block) noexcept : writer_(&writer), block_(block) {}
  ByteRuns(const ByteRuns&) = delete;
  ByteRuns& operator=(const ByteRuns&) = delete;
  ~ByteRuns() { put(); }

  void add(uint32_t offset) noexcept {
    if (count_ != 0 && offset != first_ + count_) put();
    if (count_ == 0) first_ = offset;
    ++count_;
  }

private:
  void put() noexcept {
    if (count_ == 0) return;
    writer_->put(Event::Bytes, first_, count_);
    writer_->putBytes({block_ + first_, count_});
    count_ = 0;
  }
  EventWriter* writer_;
  const uint8_t* block_;
  uint32_t first_ = 0, count_ = 0;
};

bool sameForces(std::span<const core::ForcedBits> a, std::span<const core::ForcedBits> b) noexcept {
  return a.data() == b.data() && a.size() == b.size();
}

void putForces(EventWriter& writer, std::span<const core::ForcedBits> forced) noexcept {
  writer.put(Event::Forces, forced.size());
  for (const core::ForcedBits& bits : forced) {
    writer.putNumber(bits.offset);
    writer.putNumber(bits.mask);
    writer.putNumber(bits.value);
  }
}

void putSurroundings(EventWriter& writer, const Surroundings& of) noexcept {
  writer.put(Event::Surroundings, of.works, of.latches, of.neededOnly);
}

} // namespace

Recorder::Recorder(const Instance& instance, RecordedBytes bytes, const RecorderOptions& options)
    : options_(options), ring_(options.ringBytes), partBytes_(partRoom(bytes)),
      batchBytes_(partBytes_.size() + 2 * kBatch), part_(partBytes_), batch_(batchBytes_),
      before_(std::move(bytes.before)), withinBytes_(std::move(bytes.within)), outputs_(std::move(bytes.outputs)),
      nowUs_(instance.nowUs()) {}

// ---- whole states ------------------------------------------------------------------------------------------------

size_t Recorder::stateSize(const Instance& instance) const noexcept {
  core::Saver counted({});
  return instance.save(counted, false) ? counted.size() : 0;
}

void Recorder::know(const Instance& instance) noexcept {
  before_.know(instance.block().data());
  withinBytes_.know(instance.block().data());
  outputs_.know(instance.block().data());
  nowUs_ = instance.nowUs();
  stopped_ = instance.stopped();
  faulted_ = instance.faulted();
  forced_ = instance.forcedBits();
  for (replies_ = 0; instance.services().undelivered(replies_) != nullptr;) ++replies_;
}

// What has come from outside before it is written as well, so that a player can compare. Without room for a state the
// recording continues as it was.
void Recorder::putState(const Instance& instance) noexcept {
  constexpr size_t kOther = 256, kForce = 12; // of the other events
  keepBefore();
  const size_t size = stateSize(instance);
  const size_t room = size + kOther + kForce * instance.forcedBits().size() + outputs_.listed();
  const std::span<uint8_t> to = ring_.reserve(room);
  if (to.empty()) return;
  EventWriter writer(to);
  if (!whole_) writer.put(lost_ ? Event::Lost : Event::Anew);
  putSurroundings(writer, instance.surroundings());
  writer.put(Event::Outputs);
  outputs_.list(writer);
  putForces(writer, instance.forcedBits());
  writer.put(Event::State, size);
  core::Saver saver(to.subspan(writer.size()));
  (void)instance.save(saver, false);
  ring_.commit(writer.size() + size);
  know(instance);
  stateUs_ = nowUs_ + options_.stateEveryUs;
  whole_ = true;
  lost_ = false;
  last_.plain = false; // a recording may be played from here
}

void Recorder::keepBefore() noexcept {
  if (!whole_) return;
  if (!part_.fits()) return lose();
  if (part_.size() != 0) {
    putRepeats();
    batch_.putBytes(part_.written());
    part_.cut(0);
    last_.plain = false;
  }
  flush();
}

void Recorder::lose() noexcept {
  lost_ = lost_ || whole_;
  whole_ = false;
  last_.plain = false;
  repeats_ = 0;
  part_.cut(0);
  batch_.cut(0);
}

void Recorder::changedWhole(const Instance&) noexcept {
  flush();
  whole_ = false;
  part_.cut(0);
  replies_ = 0;
}

// ---- before a part -----------------------------------------------------------------------------------------------

void Recorder::begins(const Instance& instance, PartKind kind, uint32_t number) noexcept {
  if (inPart_) return beginsWithin(instance, number);
  inPart_ = true;
  within_ = 0;
  putBefore(instance);
  const bool isStateDue = !whole_ || instance.nowUs() >= stateUs_;
  if (isStateDue && instance.atListStart()) putState(instance);
  if (!whole_) return;
  if (kind != PartKind::Task && kind != PartKind::Halt) replies_ = 0; // they are delivered
  now_ = {kind, number, part_.size() == 0};
  plainSize_ = 0;
  if (!now_.plain) putPart();
}

// Only when there is something else to write: most parts are as the one before.
void Recorder::putPart() noexcept {
  if (plainSize_ != 0) return;
  part_.put(Event::Part, static_cast<uint8_t>(now_.kind), now_.number == RUNG_NONE ? 0 : now_.number);
  plainSize_ = part_.size();
}

void Recorder::putBefore(const Instance& instance) noexcept {
  if (!whole_) return;
  if (instance.nowUs() != nowUs_) part_.put(Event::Clock, zigzag(instance.nowUs() - nowUs_));
  if (instance.stopped() != stopped_) part_.put(Event::Stopped, stopped_ = instance.stopped());
  if (!sameForces(instance.forcedBits(), forced_)) putForces(part_, forced_ = instance.forcedBits());
  putChanges(instance, before_);
  putChanges(instance, withinBytes_);
  for (; const core::ServiceReply* reply = instance.services().undelivered(replies_); ++replies_)
    putReply(Event::Reply, *reply);
}

void Recorder::putChanges(const Instance& instance, WatchedBytes& watched) noexcept {
  const uint8_t* block = instance.block().data();
  if (watched.isAsKnown(block)) return;
  ByteRuns runs(part_, block);
  watched.compare(block, [&](uint32_t offset) noexcept {
    putWithin();
    runs.add(offset);
  });
}

void Recorder::putReply(Event event, const core::ServiceReply& reply) noexcept {
  const uint32_t count = std::min(reply.resultCount, RUNG_MAX_SERVICE_ARGS);
  part_.put(event, reply.ticket, reply.state, count);
  for (uint32_t i = 0; i < count; ++i) part_.putNumber(zigzag(reply.results[i]));
}

void Recorder::surroundingsChanged(const Instance& instance) noexcept {
  if (whole_) putSurroundings(part_, instance.surroundings());
}

void Recorder::written(const Instance& instance, uint32_t offset, uint32_t bytes) noexcept {
  if (!whole_) return;
  part_.put(Event::Bytes, offset, bytes);
  part_.putBytes(instance.block().subspan(offset, bytes));
}

void Recorder::mark(std::string_view text) noexcept {
  if (!whole_) return;
  part_.put(Event::Mark, text.size());
  part_.putBytes({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

// ---- within a part -----------------------------------------------------------------------------------------------

// What the program has written in the part so far is not what others write now.
void Recorder::withinBegins(const Instance& instance) noexcept { enterWithin(instance); }

void Recorder::withinEnded(const Instance& instance) noexcept {
  if (whole_) putChanges(instance, withinBytes_);
  inWithin_ = depth_ != 0;
}

void Recorder::enterWithin(const Instance& instance) noexcept {
  withinBytes_.knowWritten(instance.block().data());
  inWithin_ = true;
  withinPut_ = false;
  number_ = within_++;
}

// The event that says where the following ones happen, before the first of them.
void Recorder::putWithin() noexcept {
  if (!inWithin_ || withinPut_) return;
  putPart();
  part_.put(Event::Within, number_);
  withinPut_ = true;
}

void Recorder::beginsWithin(const Instance& instance, uint32_t task) noexcept {
  ++depth_;
  if (!whole_) return;
  putChanges(instance, withinBytes_);
  putWithin();
  part_.put(Event::Task, task);
  inWithin_ = false;
}

void Recorder::requested(const Instance& instance, const core::ServiceRequest& request,
                         const core::ServiceReply* reply) noexcept {
  if (!whole_) return;
  const bool isControls = request.service >= instance.program().service_count;
  if (!isControls && reply != nullptr) putPart();
  if (isControls) {
    putWithin();
    part_.put(Event::Request, request.service, request.argCount);
    for (uint32_t i = 0; i < request.argCount; ++i) part_.putNumber(zigzag(request.args[i]));
  }
  if (reply != nullptr) putReply(Event::Answer, *reply);
}

// ---- after a part ------------------------------------------------------------------------------------------------

void Recorder::ended(const Instance& instance) noexcept {
  if (depth_ != 0) { // of a task within a hook, which goes on
    --depth_;
    return enterWithin(instance);
  }
  inPart_ = false;
  before_.knowWritten(instance.block().data());
  withinBytes_.knowWritten(instance.block().data());
  nowUs_ = instance.nowUs();
  if (!whole_) return;
  if (part_.size() != plainSize_) part_.put(Event::Ended);
  putOutcome(instance);
  keepPart();
}

void Recorder::putOutcome(const Instance& instance) noexcept {
  const uint8_t* block = instance.block().data();
  if (!outputs_.isAsKnown(block)) {
    outputs_.know(block);
    putPart();
    part_.put(Event::Hash, outputs_.hash(block));
  }
  if (instance.faulted() == faulted_) return;
  faulted_ = instance.faulted();
  const rung_fault& fault = instance.fault();
  putPart();
  if (faulted_) part_.put(Event::Fault, fault.code, fault.rung, fault.line, fault.task);
}

void Recorder::keepPart() noexcept {
  if (part_.size() == 0 && now_ == last_) {
    ++repeats_;
    return;
  }
  putPart();
  if (!part_.fits()) return lose();
  putRepeats();
  last_ = {now_.kind, now_.number, true};
  batch_.putBytes(part_.written());
  part_.cut(0);
  if (batch_.size() >= kBatch || faulted_) flush();
}

void Recorder::putRepeats() noexcept {
  if (repeats_ != 0) batch_.put(Event::Repeat, repeats_);
  repeats_ = 0;
}

void Recorder::flush() noexcept {
  putRepeats();
  if (batch_.size() == 0) return;
  const bool kept = ring_.push(batch_.written());
  batch_.cut(0);
  if (!kept) lose();
}

} // namespace rung::runtime
