// See player.h.
#include "rtlib/record/player.h"

#include <algorithm>

namespace rung::runtime {

bool PlayerOwner::force(Instance& instance, std::span<const core::ForcedBits> bits) {
  instance.endForces();
  forcing_.reset();
  if (bits.empty()) return true;
  auto forcing = std::make_unique<Forcing>(instance.program(), instance.context().engine, bits);
  if (forcing->needsCode()) {
    const std::optional<core::Code> code = codeFor(*forcing);
    if (!code) return false;
    forcing->setCode(*code);
  }
  forcing_ = std::move(forcing);
  (void)instance.force(*forcing_);
  return true;
}

void Player::setEvents(std::span<const uint8_t> events) {
  reader_ = EventReader(events);
  failed_ = false;
  repeats_ = 0;
}

Played Player::damaged() {
  failed_ = true;
  whole_ = false;
  return Played::Damaged;
}

Played Player::play() {
  difference_.reset();
  if (failed_) return Played::Damaged;
  if (repeats_ != 0) {
    --repeats_;
    return runAndCompare();
  }
  while (!reader_.atEnd()) {
    const EventReader here = reader_;
    const Event event = reader_.takeEvent();
    switch (event) {
    case Event::Lost: whole_ = false; return Played::Lost;
    case Event::Anew: whole_ = false; break;
    case Event::State: return playState();
    case Event::Part: return playPart();
    case Event::Program:
      if (reader_.takeNumber() == instance().program().code_hash) break;
      if (!reader_.good()) return damaged();
      whole_ = false;
      reader_ = here;
      return Played::Other;
    case Event::Repeat:
      repeats_ = reader_.takeNumber();
      if (repeats_ == 0 || !whole_) return damaged();
      return play();
    case Event::Forces:
      if (!takeForces()) return reader_.good() ? Played::NoForces : damaged();
      break;
    default:
      if (!takeBefore(event)) return damaged();
    }
  }
  return reader_.good() ? Played::End : damaged();
}

// ---- states ------------------------------------------------------------------------------------------------------

Played Player::playState() {
  const std::span<const uint8_t> bytes = reader_.takeBytes(reader_.takeNumber());
  if (!reader_.good()) return damaged();
  if (whole_) compareState(bytes);
  core::Loader loader(bytes);
  switch (load(loader)) {
  case LoadResult::Loaded: break;
  case LoadResult::OtherProgram: whole_ = false; return Played::Other;
  default: return damaged();
  }
  whole_ = true;
  return Played::State;
}

void Player::compareState(std::span<const uint8_t> recorded) {
  beforeComparison();
  std::vector<uint8_t> mine(recorded.size());
  core::Saver saver(mine);
  const bool comparable = save(saver) && saver.size() == recorded.size();
  const std::span<const uint8_t> block = Instance::blockIn(recorded, instance().program());
  const size_t first = block.empty() ? recorded.size() : static_cast<size_t>(block.data() - recorded.data());
  const auto isOfBlock = [&](size_t i) { return i >= first && i - first < block.size(); };
  size_t i = 0;
  while (comparable && i < mine.size() && (mine[i] == recorded[i] || (isOfBlock(i) && !matters(i - first)))) ++i;
  if (comparable && i == mine.size()) return;
  differs(PlayedDifference::Kind::State);
  if (comparable && isOfBlock(i)) difference_->offset = static_cast<uint32_t>(i - first);
}

std::vector<uint8_t> Player::state() const {
  core::Saver counted({});
  if (!whole_ || !save(counted)) return {};
  const std::span<const core::ForcedBits> forced = instance().forcedBits();
  constexpr size_t kOther = 64; // of the events around the forces and the bytes
  std::vector<uint8_t> events(roomForOthers() + roomForForces(forced) + counted.size() + kOther);
  EventWriter writer(events);
  putBeforeState(writer);
  putForces(writer, forced);
  writer.put(Event::State, counted.size());
  core::Saver saver(writer.rest());
  (void)save(saver);
  writer.advance(counted.size());
  putAfterState(writer);
  events.resize(writer.size());
  return events;
}

// ---- before a part -----------------------------------------------------------------------------------------------

bool Player::takeBefore(Event event) {
  switch (event) {
  case Event::Clock: instance().advanceClock(unzigzag(reader_.takeNumber())); return reader_.good();
  case Event::Bytes: return takeBytes();
  case Event::Mark: return takeMark();
  default: return takeOther(event);
  }
}

bool Player::takeMark() {
  const std::span<const uint8_t> text = reader_.takeBytes(reader_.takeNumber());
  owner_.marked({reinterpret_cast<const char*>(text.data()), text.size()});
  return reader_.good();
}

bool Player::takeForces() {
  std::vector<core::ForcedBits> bits;
  for (uint64_t count = reader_.takeNumber(); count != 0 && reader_.good(); --count) {
    const uint32_t offset = reader_.takeNumber32(), mask = reader_.takeNumber32(), value = reader_.takeNumber32();
    if (offset >= bits_.size() || mask > (bits_[offset] ? 1 : 255) || value > mask) return false;
    bits.push_back({offset, static_cast<uint8_t>(mask), static_cast<uint8_t>(value)});
  }
  return reader_.good() && owner_.force(instance(), bits);
}

bool Player::takeBytes(uint64_t& offset, std::span<const uint8_t>& bytes) {
  offset = reader_.takeNumber();
  bytes = reader_.takeBytes(reader_.takeNumber());
  return reader_.good() && mayWrite(bits_, offset, bytes);
}

bool Player::takeBytes() {
  uint64_t offset = 0;
  std::span<const uint8_t> bytes;
  if (!takeBytes(offset, bytes)) return false;
  std::ranges::copy(bytes, instance().block().begin() + static_cast<ptrdiff_t>(offset));
  return true;
}

bool Player::takeList(int64_t* values, uint32_t count) {
  if (count > RUNG_MAX_SERVICE_ARGS) return false;
  for (uint32_t i = 0; i < count; ++i) values[i] = unzigzag(reader_.takeNumber());
  return reader_.good();
}

std::optional<core::ServiceReply> Player::takeReply() {
  core::ServiceReply reply;
  reply.ticket = reader_.takeNumber32();
  reply.state = reader_.takeNumber32();
  reply.resultCount = reader_.takeNumber32();
  return takeList(reply.results, reply.resultCount) ? std::optional(reply) : std::nullopt;
}

bool Player::takeReplies() {
  while (isNext(Event::Reply)) {
    (void)reader_.takeEvent();
    const std::optional<core::ServiceReply> reply = takeReply();
    if (!reply || !instance().services().complete(*reply)) return false;
  }
  return true;
}

// ---- parts -------------------------------------------------------------------------------------------------------

Played Player::playPart() {
  const uint64_t kind = reader_.takeNumber();
  number_ = reader_.takeNumber32();
  if (!reader_.good() || kind > static_cast<uint64_t>(PartKind::PowerOff) || !whole_) return damaged();
  kind_ = static_cast<PartKind>(kind);
  return mayRun(kind_) && takeReplies() ? runAndCompare() : damaged();
}

Played Player::runAndCompare() {
  const bool wasFaulted = instance().faulted();
  run();
  if (isNext(Event::Ended)) (void)reader_.takeEvent();
  compareOutcome();
  compareFault(wasFaulted);
  return reader_.good() && !failed_ ? Played::Part : damaged();
}

void Player::compareFault(bool wasFaulted) {
  const bool faults = isNext(Event::Fault);
  rung_fault fault{};
  if (faults) {
    (void)reader_.takeEvent();
    fault.code = reader_.takeNumber32(), fault.rung = reader_.takeNumber32();
    fault.line = reader_.takeNumber32(), fault.task = reader_.takeNumber32();
  }
  const rung_fault& mine = instance().fault();
  const bool same = !faults || (fault.code == mine.code && fault.rung == mine.rung && fault.line == mine.line &&
                                fault.task == mine.task);
  if (!same || (faults || wasFaulted) != instance().faulted()) differs(PlayedDifference::Kind::Fault);
}

} // namespace rung::runtime
