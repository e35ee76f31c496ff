// See host_player.h.
#include "rtlib/api/host_player.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "rtlib/api/error.h"
#include "rtlib/api/running.h"

namespace rung::api {

using runtime::Event;
using runtime::EventReader;
using runtime::PartKind;
using runtime::Played;
using runtime::PlayedDifference;
using runtime::unzigzag;

void ServedOwner::release() {
  if (code_.release != nullptr) code_.release(code_.owner);
  code_ = {};
}

std::optional<core::Code> ServedOwner::codeFor(const runtime::Forcing& forcing) {
  const Image& image = *image_->image;
  const rung_code_maker* maker = image.maker.load();
  if (maker == nullptr) return std::nullopt;
  release();
  std::array<char, 512> problem{};
  const std::vector<rung_forced_byte>& bytes = forcing.bytes();
  if (maker->force(maker->user, image_, image.engine, bytes.data(), static_cast<uint32_t>(bytes.size()), &code_,
                   problem.data(), problem.size()) != RUNG_OK)
    return std::nullopt;
  return core::Code{code_.chunk_fns, code_.engine};
}

HostPlayer::HostPlayer(rung_image* image, runtime::PlayerOwner& owner) : owner_(owner) {
  const rung_instance_options options{.size = sizeof options, .user = this, .request = &HostPlayer::request};
  if (newInstance(image, &options, nullptr, &instance_) != RUNG_OK) throw std::runtime_error(errorText());
  bits_ = runtime::bitBytes(running().program());
}

HostPlayer::~HostPlayer() { (void)rung_instance_free(instance_); }

void HostPlayer::setEvents(std::span<const uint8_t> events) {
  reader_ = EventReader(events);
  failed_ = false;
  repeats_ = 0;
}

// As HostRecorder writes it. The inputs may be others than those that the block has now.
std::vector<uint8_t> HostPlayer::state() {
  core::Saver counted({});
  if (!whole_ || !inputs_ || !saveState(*instance_, counted, Waiting::LeftOut)) return {};
  const std::span<const core::ForcedBits> forced = running().forcedBits();
  constexpr size_t kNumber = 10; // bytes of one, at most
  size_t room = counted.size() + inputs_->listed() + 2 * inputs_->bytes() + (16 + 3 * forced.size()) * kNumber;
  for (const Configured& one : configured_) room += one.text.size() + 6 * kNumber;
  std::vector<uint8_t> events(room);
  runtime::EventWriter writer(events);
  writer.put(Event::Surroundings, 0, 0, neededOnly_);
  for (const Configured& one : configured_) {
    writer.put(Event::Configured, static_cast<uint32_t>(one.kind), one.a, one.b, one.c, one.text.size());
    writer.putBytes({reinterpret_cast<const uint8_t*>(one.text.data()), one.text.size()});
  }
  writer.put(Event::Inputs);
  inputs_->list(writer);
  writer.put(Event::Forces, forced.size());
  for (const core::ForcedBits& bits : forced)
    writer.putNumber(bits.offset), writer.putNumber(bits.mask), writer.putNumber(bits.value);
  writer.put(Event::State, counted.size());
  core::Saver saver(writer.rest());
  (void)saveState(*instance_, saver, Waiting::LeftOut);
  writer.advance(counted.size());
  inputs_->listKnown(writer);
  writer.put(Event::Served, served_);
  events.resize(writer.size());
  return events;
}

Played HostPlayer::damaged() {
  failed_ = true;
  whole_ = false;
  return Played::Damaged;
}

Played HostPlayer::play() {
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
      if (reader_.takeNumber() == running().program().code_hash) break;
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

Played HostPlayer::playState() {
  const std::span<const uint8_t> bytes = reader_.takeBytes(reader_.takeNumber());
  if (!reader_.good() || !nextInputs_) return damaged();
  running().setNeededCopiesOnly(neededOnly_);
  if (whole_ && comparesStates_) compareState(bytes);
  core::Loader loader(bytes);
  if (loadState(*instance_, loader) != RUNG_OK) return damaged();
  inputs_ = std::exchange(nextInputs_, std::nullopt);
  inputs_->know(running().block().data());
  whole_ = true;
  return Played::State;
}

void HostPlayer::compareState(std::span<const uint8_t> recorded) {
  inputs_->write(running().block().data());
  std::vector<uint8_t> mine(recorded.size());
  core::Saver saver(mine);
  const bool isSame = saveState(*instance_, saver, Waiting::LeftOut) && saver.size() == recorded.size();
  const std::span<const uint8_t> block = runtime::Instance::blockIn(recorded, running().program());
  size_t i = 0;
  while (isSame && i < mine.size() && mine[i] == recorded[i]) ++i;
  if (isSame && i == mine.size()) return;
  difference_ = PlayedDifference{.kind = PlayedDifference::Kind::State};
  if (block.empty()) return;
  const size_t first = static_cast<size_t>(block.data() - recorded.data());
  if (isSame && i >= first && i - first < block.size()) difference_->offset = static_cast<uint32_t>(i - first);
}

// ---- before a part -----------------------------------------------------------------------------------------------

bool HostPlayer::takeBefore(Event event) {
  switch (event) {
  case Event::Surroundings: return takeSurroundings();
  case Event::Configured: return takeConfigured();
  case Event::Inputs:
    nextInputs_ = inputs_ && inputs_->takeSame(reader_)
                      ? inputs_
                      : runtime::InputBits::fromList(running().block().size(), reader_);
    // The configuration comes before the first power-on, and forces after it.
    if (!instance_->on) (void)rung_instance_power_on(instance_, RUNG_COLD);
    return nextInputs_.has_value();
  case Event::Clock: running().advanceClock(unzigzag(reader_.takeNumber())); return reader_.good();
  case Event::Input:
  case Event::Bytes: {
    const uint64_t offset = reader_.takeNumber();
    const std::span<const uint8_t> bytes = reader_.takeBytes(reader_.takeNumber());
    const std::span<uint8_t> block = running().block();
    if (!reader_.good() || !inputs_ || !runtime::mayWrite(bits_, offset, bytes)) return false;
    if (event == Event::Input)
      inputs_->set(offset, bytes);
    else
      std::ranges::copy(bytes, block.begin() + static_cast<ptrdiff_t>(offset));
    return true;
  }
  case Event::Stopped:
    return (reader_.takeNumber() != 0 ? rung_instance_stop(instance_) : rung_instance_start(instance_)) == RUNG_OK;
  case Event::Function: return takeFunction();
  case Event::Abort:
    return rung_instance_abort_functions(instance_, reader_.takeNumber32()) == RUNG_OK && reader_.good();
  case Event::Served:
    served_ = reader_.takeNumber() != 0;
    return rung_instance_serving(instance_, served_ ? 1 : 0) == RUNG_OK;
  case Event::Saved: instance_->control->saved(running()); return true;
  case Event::Mark: {
    const std::span<const uint8_t> text = reader_.takeBytes(reader_.takeNumber());
    owner_.marked({reinterpret_cast<const char*>(text.data()), text.size()});
    return reader_.good();
  }
  default: return false;
  }
}

// Of the control's own works nothing is set: they are those of the same control.
bool HostPlayer::takeSurroundings() {
  (void)reader_.takeNumber32();
  (void)reader_.takeNumber();
  neededOnly_ = reader_.takeNumber() != 0;
  return reader_.good();
}

bool HostPlayer::takeConfigured() {
  const uint64_t kind = reader_.takeNumber();
  Configured what{.kind = static_cast<Configured::Kind>(kind)};
  what.a = reader_.takeNumber32(), what.b = reader_.takeNumber32(), what.c = reader_.takeNumber32();
  const std::span<const uint8_t> text = reader_.takeBytes(reader_.takeNumber());
  what.text.assign(text.begin(), text.end());
  if (!reader_.good() || kind > static_cast<uint64_t>(Configured::Kind::Message)) return false;
  if (std::ranges::find(configured_, what) != configured_.end()) return true;
  configured_.push_back(what);
  switch (what.kind) {
  case Configured::Kind::Stored: instance_->control->setStored(what.a != 0); return true;
  case Configured::Kind::HighSpeed: return rung_instance_high_speed_functions(instance_, what.a) == RUNG_OK;
  case Configured::Kind::Group: return rung_instance_group_function(instance_, what.a, what.b, what.c) == RUNG_OK;
  case Configured::Kind::AxisGroup: return rung_instance_axis_group(instance_, what.a, what.b) == RUNG_OK;
  case Configured::Kind::Message:
    return instance_->wasOn || rung_instance_define_message(instance_, what.a, what.b, what.text.c_str()) == RUNG_OK;
  }
  return false;
}

bool HostPlayer::takeForces() {
  std::vector<core::ForcedBits> bits;
  for (uint64_t count = reader_.takeNumber(); count != 0 && reader_.good(); --count) {
    const uint32_t offset = reader_.takeNumber32(), mask = reader_.takeNumber32(), value = reader_.takeNumber32();
    if (offset >= bits_.size() || mask > (bits_[offset] ? 1 : 255) || value > mask) return false;
    bits.push_back({offset, static_cast<uint8_t>(mask), static_cast<uint8_t>(value)});
  }
  return reader_.good() && owner_.force(running(), bits);
}

bool HostPlayer::takeFunction() {
  const uint32_t channel = reader_.takeNumber32(), kind = reader_.takeNumber32(), code = reader_.takeNumber32();
  uint32_t handle = 0;
  if (!reader_.good()) return false;
  const int32_t status = rung_instance_begin_function(instance_, channel, static_cast<int32_t>(kind), code, &handle);
  if (status == RUNG_LATER) difference_ = PlayedDifference{.kind = PlayedDifference::Kind::Requests};
  return status >= RUNG_OK;
}

std::optional<core::ServiceReply> HostPlayer::takeReply() {
  core::ServiceReply reply;
  reply.ticket = reader_.takeNumber32();
  reply.state = reader_.takeNumber32();
  reply.resultCount = reader_.takeNumber32();
  if (reply.resultCount > RUNG_MAX_SERVICE_ARGS) return std::nullopt;
  for (uint32_t i = 0; i < reply.resultCount; ++i) reply.results[i] = unzigzag(reader_.takeNumber());
  return reader_.good() ? std::optional(reply) : std::nullopt;
}

// ---- parts -------------------------------------------------------------------------------------------------------

Played HostPlayer::playPart() {
  const uint64_t kind = reader_.takeNumber();
  number_ = reader_.takeNumber32();
  if (!reader_.good() || kind > static_cast<uint64_t>(PartKind::PowerOff) || !whole_) return damaged();
  kind_ = static_cast<PartKind>(kind);
  otherRequests_ = false;
  while (isNext(Event::Reply)) {
    (void)reader_.takeEvent();
    const std::optional<core::ServiceReply> reply = takeReply();
    if (!reply || !running().services().complete(*reply)) return damaged();
  }
  wasFaulted_ = running().faulted();
  run();
  compareOutcome();
  return reader_.good() && !failed_ ? Played::Part : damaged();
}

void HostPlayer::run() {
  runtime::Instance& running = this->running();
  if (!running.withinSlice() && kind_ != PartKind::PowerOff) inputs_->write(running.block().data());
  switch (kind_) {
  case PartKind::Scan: (void)rung_instance_scan(instance_); break;
  case PartKind::Slot: (void)rung_instance_slot(instance_); break;
  case PartKind::Slice: (void)rung_instance_slice(instance_); break;
  case PartKind::Fast: (void)rung_instance_fast(instance_); break;
  case PartKind::SliceToFast: runPart(*instance_, kind_, [&] { running.sliceToFast(); }); break;
  case PartKind::Halt: runPart(*instance_, kind_, [&] { (void)running.halt(number_); }); break;
  case PartKind::PowerOff: (void)rung_instance_begin_power_off(instance_); break;
  case PartKind::Task: break; // no part of a host
  }
  core::ServiceRequest request;
  while (running.services().take(request)) {
  }
}

void HostPlayer::compareOutcome() {
  using Kind = PlayedDifference::Kind;
  if (isNext(Event::Ended)) (void)reader_.takeEvent();
  if (otherRequests_) difference_ = PlayedDifference{.kind = Kind::Requests};
  rung_fault fault{};
  const bool faults = isNext(Event::Fault);
  if (faults) {
    (void)reader_.takeEvent();
    fault.code = reader_.takeNumber32(), fault.rung = reader_.takeNumber32();
    fault.line = reader_.takeNumber32(), fault.task = reader_.takeNumber32();
  }
  const rung_fault& mine = running().fault();
  const bool same = (faults || wasFaulted_) == running().faulted() &&
                    (!faults || (fault.code == mine.code && fault.rung == mine.rung && fault.line == mine.line &&
                                 fault.task == mine.task));
  if (!same) difference_ = PlayedDifference{.kind = Kind::Fault};
}

// ---- requests ----------------------------------------------------------------------------------------------------

int32_t HostPlayer::request(void* player, rung_instance*, const rung_request* request, rung_reply* reply) {
  auto& self = *static_cast<HostPlayer*>(player);
  return self.whole_ ? self.decide(*request, *reply) : int32_t{RUNG_REFUSE};
}

int32_t HostPlayer::decide(const rung_request& request, rung_reply& reply) {
  const EventReader before = reader_;
  if (isNext(Event::Decision)) {
    (void)reader_.takeEvent();
    return reader_.takeNumber() == RUNG_QUEUE ? RUNG_QUEUE : RUNG_REFUSE;
  }
  if (isNext(Event::Answer)) {
    (void)reader_.takeEvent();
    if (const std::optional<core::ServiceReply> answer = takeReply(); answer && answer->ticket == request.ticket) {
      reply.error = answer->state == RUNG_SERVICE_ERROR ? 1 : 0;
      reply.result_count = answer->resultCount;
      std::ranges::copy(answer->results, reply.results);
      return RUNG_ANSWER;
    }
  }
  reader_ = before;
  otherRequests_ = true;
  return RUNG_REFUSE;
}

} // namespace rung::api
