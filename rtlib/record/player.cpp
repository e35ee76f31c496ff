// See player.h.
#include "rtlib/record/player.h"

#include <algorithm>
#include <utility>

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

Player::Player(Instance& instance, PlayerOwner& owner)
    : instance_(instance), owner_(owner), written_(writtenBytes(instance.program())),
      bits_(bitBytes(instance.program())) {
  instance_.setHooks(this);
}

Player::~Player() { instance_.setHooks(nullptr); }

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
    run();
    return Played::Part;
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
      if (reader_.takeNumber() == instance_.program().code_hash) break;
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
  if (whole_ && comparesOutputs_) compareState(bytes);
  core::Loader loader(bytes);
  switch (instance_.load(loader)) {
  case LoadResult::Loaded: break;
  case LoadResult::OtherProgram: whole_ = false; return Played::Other;
  default: return damaged();
  }
  whole_ = true;
  if (outputs_) outputsHash_ = outputs_->hash(instance_.block().data());
  return Played::State;
}

// What only others write and the program never reads is not recorded.
void Player::compareState(std::span<const uint8_t> recorded) {
  std::vector<uint8_t> mine(recorded.size());
  core::Saver saver(mine);
  const std::span<const uint8_t> block = Instance::blockIn(recorded, instance_.program());
  if (instance_.save(saver, false) && saver.size() == recorded.size() && !block.empty()) {
    const size_t first = static_cast<size_t>(block.data() - recorded.data());
    const auto different = [&](size_t i) {
      const bool isOthers = i >= first && i - first < block.size() && !written_[i - first];
      return !isOthers && mine[i] != recorded[i];
    };
    size_t i = 0;
    while (i < mine.size() && !different(i)) ++i;
    if (i == mine.size()) return;
    difference_ = PlayedDifference{.kind = PlayedDifference::Kind::State};
    if (i >= first && i - first < block.size()) difference_->offset = static_cast<uint32_t>(i - first);
    return;
  }
  difference_ = PlayedDifference{.kind = PlayedDifference::Kind::State};
}

// ---- before a part -----------------------------------------------------------------------------------------------

bool Player::takeBefore(Event event) {
  switch (event) {
  case Event::Surroundings: return takeSurroundings();
  case Event::Outputs: outputs_ = WatchedBytes::fromList(instance_.program(), reader_); return outputs_.has_value();
  case Event::Clock: instance_.advanceClock(unzigzag(reader_.takeNumber())); return reader_.good();
  case Event::Bytes: return takeBytes();
  case Event::Stopped: instance_.setStopped(reader_.takeNumber() != 0); return reader_.good();
  case Event::Request: return takeRequest();
  case Event::Mark: {
    const std::span<const uint8_t> text = reader_.takeBytes(reader_.takeNumber());
    owner_.marked({reinterpret_cast<const char*>(text.data()), text.size()});
    return reader_.good();
  }
  default: return false;
  }
}

bool Player::takeSurroundings() {
  surroundings_.works = reader_.takeNumber32();
  surroundings_.latches = reader_.takeNumber() != 0;
  surroundings_.neededOnly = reader_.takeNumber() != 0;
  if (!reader_.good()) return false;
  instance_.worksChanged();
  instance_.setLatching(surroundings_.latches);
  instance_.setNeededCopiesOnly(surroundings_.neededOnly);
  return true;
}

bool Player::takeForces() {
  std::vector<core::ForcedBits> bits;
  for (uint64_t count = reader_.takeNumber(); count != 0 && reader_.good(); --count) {
    const uint32_t offset = reader_.takeNumber32(), mask = reader_.takeNumber32(), value = reader_.takeNumber32();
    if (offset >= bits_.size() || mask > (bits_[offset] ? 1 : 255) || value > mask) return false;
    bits.push_back({offset, static_cast<uint8_t>(mask), static_cast<uint8_t>(value)});
  }
  return reader_.good() && owner_.force(instance_, bits);
}

bool Player::takeBytes() {
  const uint64_t offset = reader_.takeNumber();
  const std::span<const uint8_t> bytes = reader_.takeBytes(reader_.takeNumber());
  const std::span<uint8_t> block = instance_.block();
  if (!reader_.good() || !mayWrite(bits_, offset, bytes)) return false;
  std::ranges::copy(bytes, block.begin() + static_cast<ptrdiff_t>(offset));
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

// Of those that follow.
bool Player::takeReplies() {
  while (isNext(Event::Reply)) {
    (void)reader_.takeEvent();
    const std::optional<core::ServiceReply> reply = takeReply();
    if (!reply || !instance_.services().complete(*reply)) return false;
  }
  return true;
}

bool Player::takeRequest() {
  const uint32_t service = reader_.takeNumber32(), count = reader_.takeNumber32();
  int64_t args[RUNG_MAX_SERVICE_ARGS] = {};
  if (!takeList(args, count)) return false;
  (void)instance_.services().request(service, args, count);
  return true;
}

// ---- parts -------------------------------------------------------------------------------------------------------

Played Player::playPart() {
  const uint64_t kind = reader_.takeNumber();
  number_ = reader_.takeNumber32();
  if (!reader_.good() || kind >= static_cast<uint64_t>(PartKind::PowerOff) || !whole_) return damaged();
  kind_ = static_cast<PartKind>(kind);
  if (!takeReplies()) return damaged();
  run();
  compareOutcome();
  return reader_.good() && !failed_ ? Played::Part : damaged();
}

// What the program sends is dropped.
void Player::run() {
  within_ = 0;
  switch (kind_) {
  case PartKind::Scan: instance_.scan(); break;
  case PartKind::Slot: instance_.slot(); break;
  case PartKind::Slice: instance_.slice(); break;
  case PartKind::Fast: instance_.fast(); break;
  case PartKind::SliceToFast: instance_.sliceToFast(); break;
  case PartKind::Task: (void)instance_.runTask(number_); break;
  case PartKind::Halt: (void)instance_.halt(number_); break;
  case PartKind::PowerOff: break; // only where the control runs again
  }
  core::ServiceRequest request;
  while (instance_.services().take(request)) {
  }
}

void Player::compareOutputs(bool compares) {
  if (compares && !comparesOutputs_ && outputs_) outputsHash_ = outputs_->hash(instance_.block().data());
  comparesOutputs_ = compares;
}

void Player::compareOutcome() {
  using Kind = PlayedDifference::Kind;
  if (isNext(Event::Ended)) (void)reader_.takeEvent();
  const bool compares = outputs_ && comparesOutputs_;
  const uint32_t hash = compares ? outputs_->hash(instance_.block().data()) : 0;
  if (isNext(Event::Hash)) {
    (void)reader_.takeEvent();
    outputsHash_ = reader_.takeNumber32();
  }
  if (compares && hash != outputsHash_) difference_ = PlayedDifference{.kind = Kind::Outputs};
  if (compares) outputsHash_ = hash;
  if (isNext(Event::Fault)) {
    (void)reader_.takeEvent();
    rung_fault fault;
    fault.code = reader_.takeNumber32(), fault.rung = reader_.takeNumber32();
    fault.line = reader_.takeNumber32(), fault.task = reader_.takeNumber32();
    const rung_fault& mine = instance_.fault();
    const bool same = instance_.faulted() && fault.code == mine.code && fault.rung == mine.rung &&
                      fault.line == mine.line && fault.task == mine.task;
    if (!same) difference_ = PlayedDifference{.kind = Kind::Fault};
  }
}

// A hook or a latch of the part.
void Player::within() {
  for (bool goesOn = true; goesOn && !failed_;) {
    goesOn = false;
    const uint32_t number = within_++;
    EventReader after = reader_;
    if (!isNext(Event::Within) || (after.takeEvent(), after.takeNumber32()) != number) return;
    reader_ = after;
    for (;;) {
      if (isNext(Event::Bytes)) {
        (void)reader_.takeEvent();
        failed_ = failed_ || !takeBytes();
      } else if (isNext(Event::Reply)) {
        failed_ = failed_ || !takeReplies();
        instance_.services().deliver();
      } else if (isNext(Event::Request)) {
        (void)reader_.takeEvent();
        failed_ = failed_ || !takeRequest();
      } else if (isNext(Event::Task)) {
        (void)reader_.takeEvent();
        (void)instance_.runTask(reader_.takeNumber32());
        goesOn = true;
        break;
      } else {
        break;
      }
      if (failed_) return;
    }
  }
}

bool Player::respond(Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) {
  if (!isNext(Event::Answer)) return false;
  EventReader before = reader_;
  (void)reader_.takeEvent();
  const std::optional<core::ServiceReply> answer = takeReply();
  if (!answer || answer->ticket != request.ticket) {
    reader_ = before;
    failed_ = failed_ || !answer;
    return false;
  }
  reply = *answer;
  return true;
}

} // namespace rung::runtime
