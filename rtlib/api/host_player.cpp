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
using runtime::EventWriter;
using runtime::PartKind;
using runtime::PlayedDifference;

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

HostPlayer::HostPlayer(rung_image* image, runtime::PlayerOwner& owner) : Player(owner) {
  const rung_instance_options options{.size = sizeof options, .user = this, .request = &HostPlayer::request};
  if (newInstance(image, &options, nullptr, &instance_) != RUNG_OK) throw std::runtime_error(errorText());
  hooks_.emplace(instance_->hooks);
  instance().setHooks(&*hooks_);
  beginWith(instance().program());
}

HostPlayer::~HostPlayer() { (void)rung_instance_free(instance_); }

// ---- states ------------------------------------------------------------------------------------------------------

bool HostPlayer::save(core::Saver& saver) const { return saveState(*instance_, saver, Waiting::LeftOut); }

runtime::LoadResult HostPlayer::load(core::Loader& loader) {
  if (!nextInputs_ || loadState(*instance_, loader) != RUNG_OK) return runtime::LoadResult::Damaged;
  inputs_ = std::exchange(nextInputs_, std::nullopt);
  inputs_->know(instance().block().data());
  return runtime::LoadResult::Loaded;
}

size_t HostPlayer::roomForOthers() const { return inputs_->listed() + inputs_->listedKnown() + roomFor(configured_); }

// As HostRecorder writes it. Inputs follow the state, because they may be others than those that the block has now.
void HostPlayer::putBeforeState(EventWriter& writer) const {
  writer.put(Event::Surroundings, 0, 0, neededOnly_);
  for (const Configured& one : configured_) putConfiguration(writer, one);
  writer.put(Event::Inputs);
  inputs_->list(writer);
}

// ---- before a part -----------------------------------------------------------------------------------------------

bool HostPlayer::takeOther(Event event) {
  switch (event) {
  case Event::Surroundings: return takeSurroundings();
  case Event::Configured: return takeConfigured();
  case Event::Inputs: return takeInputs();
  case Event::Stopped:
    return (reader_.takeNumber() != 0 ? rung_instance_stop(instance_) : rung_instance_start(instance_)) == RUNG_OK;
  case Event::Function: return takeFunction();
  case Event::Abort:
    return rung_instance_abort_functions(instance_, reader_.takeNumber32()) == RUNG_OK && reader_.good();
  case Event::Served: return rung_instance_serving(instance_, reader_.takeNumber() != 0 ? 1 : 0) == RUNG_OK;
  case Event::Saved: instance_->control->saved(instance()); return true;
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
  return configure(what);
}

bool HostPlayer::configure(const Configured& what) {
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

// The configuration comes before the first power-on, and forces and the state after it.
bool HostPlayer::takeInputs() {
  nextInputs_ = inputs_ && inputs_->takeSame(reader_)
                    ? inputs_
                    : runtime::InputBits::fromList(instance().block().size(), reader_);
  if (!instance_->on) (void)rung_instance_power_on(instance_, RUNG_COLD);
  instance().setNeededCopiesOnly(neededOnly_);
  return nextInputs_.has_value();
}

bool HostPlayer::takeInput(uint32_t offset, std::span<const uint8_t> bytes) {
  if (inputs_) inputs_->set(offset, bytes);
  return inputs_.has_value();
}

bool HostPlayer::takeFunction() {
  const uint32_t channel = reader_.takeNumber32(), kind = reader_.takeNumber32(), code = reader_.takeNumber32();
  uint32_t handle = 0;
  if (!reader_.good()) return false;
  const int32_t status = rung_instance_begin_function(instance_, channel, static_cast<int32_t>(kind), code, &handle);
  if (status == RUNG_LATER) differs(PlayedDifference::Kind::Requests);
  return status >= RUNG_OK;
}

// ---- parts -------------------------------------------------------------------------------------------------------

void HostPlayer::run() {
  otherRequests_ = false;
  runtime::Instance& running = instance();
  if (!running.withinSlice() && kind_ != PartKind::PowerOff) inputs_->write(running.block().data());
  switch (kind_) {
  case PartKind::Scan: (void)rung_instance_scan(instance_); break;
  case PartKind::Slot: (void)rung_instance_slot(instance_); break;
  case PartKind::Slice: (void)rung_instance_slice(instance_); break;
  case PartKind::Fast: (void)rung_instance_fast(instance_); break;
  case PartKind::SliceToFast: runPart(*instance_, kind_, [&] { running.sliceToFast(); }); break;
  case PartKind::Halt: runPart(*instance_, kind_, [&] { (void)running.halt(number_); }); break;
  case PartKind::PowerOff: (void)rung_instance_begin_power_off(instance_); break;
  case PartKind::Task: break; // mayRun
  }
  core::ServiceRequest request;
  while (running.services().take(request)) {
  }
}

void HostPlayer::compareOutcome() {
  if (otherRequests_) differs(PlayedDifference::Kind::Requests);
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
