// See recorder.h.
#include "rtlib/record/recorder.h"

#include <cstring>
#include <utility>

namespace rung::runtime {

namespace {

constexpr size_t kRest = 65'536; // room for events of a part that are not of bytes

// Room for the events of one part: each watched byte with an event of its own, twice, and what else there may be.
size_t partRoom(const RecordedBytes& bytes) {
  constexpr size_t kEvent = 12;
  return kRest + kEvent * (bytes.before.size() + 2 * bytes.within.size());
}

bool sameForces(std::span<const core::ForcedBits> a, std::span<const core::ForcedBits> b) noexcept {
  return a.data() == b.data() && a.size() == b.size();
}

void putSurroundings(EventWriter& writer, const Surroundings& of) noexcept {
  writer.put(Event::Surroundings, of.works, of.latches, of.neededOnly);
}

} // namespace

Recorder::Recorder(const Instance& instance, RecordedBytes bytes, const RecorderOptions& options)
    : stream_(options, partRoom(bytes)), bytes_(std::make_unique<RecordedBytes>(std::move(bytes))),
      nowUs_(instance.nowUs()) {}

void Recorder::programChanged(std::unique_ptr<RecordedBytes>& bytes) noexcept {
  stream_.beginAnew();
  bytes_.swap(bytes);
}

// ---- whole states ------------------------------------------------------------------------------------------------

size_t Recorder::stateSize(const Instance& instance) const noexcept {
  core::Saver counted({});
  return instance.save(counted, false) ? counted.size() : 0;
}

void Recorder::know(const Instance& instance) noexcept {
  bytes_->before.know(instance.block().data());
  bytes_->within.know(instance.block().data());
  bytes_->outputs.know(instance.block().data());
  nowUs_ = instance.nowUs();
  stopped_ = instance.stopped();
  faulted_ = instance.faulted();
  forced_ = instance.forcedBits();
}

void Recorder::putState(const Instance& instance) noexcept {
  if (bytes_ == nullptr) return;
  constexpr size_t kOther = 256; // of the other events
  const size_t size = stateSize(instance);
  const size_t room = size + kOther + roomForForces(instance.forcedBits()) + bytes_->outputs.listed();
  const auto put = [&](EventWriter& writer) noexcept {
    putSurroundings(writer, instance.surroundings());
    writer.put(Event::Outputs);
    bytes_->outputs.list(writer);
    putForces(writer, instance.forcedBits());
    writer.put(Event::State, size);
    core::Saver saver(writer.rest());
    (void)instance.save(saver, false);
    writer.advance(size);
    return true;
  };
  if (stream_.putState(instance.program().code_hash, instance.nowUs(), room, put)) know(instance);
}

void Recorder::changedWhole(const Instance&) noexcept { stream_.beginAnew(); }

// ---- before a part -----------------------------------------------------------------------------------------------

void Recorder::begins(const Instance& instance, PartKind kind, uint32_t number) noexcept {
  if (inPart_) return beginsWithin(instance, number);
  inPart_ = true;
  stream_.announce(kind, number);
  within_ = 0;
  putBefore(instance);
  if (stream_.isStateDue(instance.nowUs()) && instance.atListStart()) putState(instance);
  if (!stream_.whole()) return;
  for (const std::string& text : marks_) putMark(text);
  marks_.clear();
  stream_.begin();
}

void Recorder::putBefore(const Instance& instance) noexcept {
  if (!stream_.whole()) return;
  if (instance.nowUs() != nowUs_) stream_.events().put(Event::Clock, zigzag(instance.nowUs() - nowUs_));
  if (instance.stopped() != stopped_) stream_.events().put(Event::Stopped, stopped_ = instance.stopped());
  if (!sameForces(instance.forcedBits(), forced_)) putForces(stream_.events(), forced_ = instance.forcedBits());
  putChanges(instance, bytes_->before);
  putChanges(instance, bytes_->within);
}

void Recorder::putChanges(const Instance& instance, WatchedBytes& watched) noexcept {
  const uint8_t* block = instance.block().data();
  if (watched.isAsKnown(block)) return;
  ByteRuns runs(stream_.events(), stream_.places(), Event::Bytes, block);
  watched.compare(block, [&](uint32_t offset) noexcept {
    putWithin();
    runs.add(offset);
  });
}

void Recorder::surroundingsChanged(const Instance& instance) noexcept {
  if (stream_.whole()) putSurroundings(stream_.events(), instance.surroundings());
}

void Recorder::written(const Instance& instance, uint32_t offset, uint32_t bytes) noexcept {
  if (!stream_.whole()) return;
  putRun(stream_.events(), stream_.places(), {Event::Bytes, offset, bytes}, instance.block().data() + offset);
}

void Recorder::mark(std::string_view text) {
  if (stream_.whole())
    putMark(text);
  else
    marks_.emplace_back(text);
}

// Left out rather than that it takes the room of what has to be recorded.
void Recorder::putMark(std::string_view text) noexcept {
  if (stream_.events().size() + text.size() > kRest / 2) return;
  stream_.events().put(Event::Mark, text.size());
  stream_.events().putBytes({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

// ---- within a part -----------------------------------------------------------------------------------------------

// What the program has written in the part so far is known.
void Recorder::withinBegins(const Instance& instance) noexcept { enterWithin(instance); }

void Recorder::withinEnded(const Instance& instance) noexcept {
  if (stream_.whole()) putChanges(instance, bytes_->within);
  inWithin_ = depth_ != 0;
}

void Recorder::enterWithin(const Instance& instance) noexcept {
  if (stream_.whole()) bytes_->within.knowWritten(instance.block().data());
  inWithin_ = true;
  withinPut_ = false;
  number_ = within_++;
}

// The event that says where the following ones happen, before the first of them.
void Recorder::putWithin() noexcept {
  if (!inWithin_ || withinPut_) return;
  stream_.putPart();
  stream_.events().put(Event::Within, number_);
  withinPut_ = true;
}

void Recorder::beginsWithin(const Instance& instance, uint32_t task) noexcept {
  ++depth_;
  if (!stream_.whole()) return;
  putChanges(instance, bytes_->within);
  putWithin();
  stream_.events().put(Event::Task, task);
  inWithin_ = false;
}

void Recorder::replied(const Instance&, const core::ServiceReply& reply) noexcept {
  if (!stream_.whole()) return;
  if (inPart_) stream_.putPart();
  putWithin();
  putReply(stream_.events(), Event::Reply, reply);
}

void Recorder::requested(const Instance& instance, const core::ServiceRequest& request,
                         const core::ServiceReply* reply) noexcept {
  if (!stream_.whole()) return;
  const bool isControls = request.service >= instance.program().service_count;
  if (!isControls && reply != nullptr) stream_.putPart();
  if (isControls) {
    putWithin();
    stream_.events().put(Event::Request, request.service, request.argCount);
    for (uint32_t i = 0; i < request.argCount; ++i) stream_.events().putNumber(zigzag(request.args[i]));
  }
  if (reply != nullptr) putReply(stream_.events(), Event::Answer, *reply);
}

// ---- after a part ------------------------------------------------------------------------------------------------

void Recorder::ended(const Instance& instance) noexcept {
  if (depth_ != 0) { // of a task within a hook, which continues
    --depth_;
    return enterWithin(instance);
  }
  inPart_ = false;
  nowUs_ = instance.nowUs();
  if (!stream_.whole()) return;
  bytes_->before.knowWritten(instance.block().data());
  bytes_->within.knowWritten(instance.block().data());
  if (stream_.hasEventsWithin()) stream_.events().put(Event::Ended);
  putOutcome(instance);
  faulted_ ? stream_.endByFault() : stream_.end();
}

void Recorder::putOutcome(const Instance& instance) noexcept {
  const uint8_t* block = instance.block().data();
  if (!bytes_->outputs.isAsKnown(block)) {
    bytes_->outputs.know(block);
    stream_.putPart();
    stream_.events().put(Event::Hash, bytes_->outputs.hash(block));
  }
  if (instance.faulted() == faulted_) return;
  faulted_ = instance.faulted();
  const rung_fault& fault = instance.fault();
  stream_.putPart();
  if (faulted_) stream_.events().put(Event::Fault, fault.code, fault.rung, fault.line, fault.task);
}

} // namespace rung::runtime
