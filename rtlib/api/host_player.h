// Runs a program again as a recording of its host says (host_recorder.h), part by part, with the control of the
// dialect, and compares what it does with what it did then. Not for real time.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rtlib/api/instance.h"
#include "rtlib/record/input_bits.h"
#include "rtlib/record/player.h"
#include "rtlib/record/watched_bytes.h"

namespace rung::api {

// Code for forces by the compiler that serves an image (rung_image_serve).
class ServedOwner : public runtime::PlayerOwner {
public:
  // The image outlives this object.
  explicit ServedOwner(rung_image* image) : image_(image) {}
  ~ServedOwner() override { release(); }
  ServedOwner(const ServedOwner&) = delete;
  ServedOwner& operator=(const ServedOwner&) = delete;
  std::optional<core::Code> codeFor(const runtime::Forcing& forcing) override;

private:
  void release();
  rung_image* image_;
  rung_forced_code code_{};
};

class HostPlayer {
public:
  // Makes an instance of the program of `image`, by whatever engine. `owner` outlives the player. Throws
  // std::runtime_error if the library refuses the image.
  HostPlayer(rung_image* image, runtime::PlayerOwner& owner);
  ~HostPlayer();
  HostPlayer(const HostPlayer&) = delete;
  HostPlayer& operator=(const HostPlayer&) = delete;

  // Messages of the program are in the queue of the instance after each part.
  rung_instance* instance() { return instance_; }
  runtime::Instance& running() { return instance_->running; }
  const nc::Control& control() const { return *instance_->control; }

  // As in runtime::Player.
  void setEvents(std::span<const uint8_t> events);
  size_t position() const { return reader_.position(); }
  runtime::Played play();
  uint64_t repeatsLeft() const { return repeats_; }
  runtime::PartKind lastKind() const { return kind_; }
  uint32_t lastNumber() const { return number_; }
  const std::optional<runtime::PlayedDifference>& difference() const { return difference_; }
  // Events by which another player gets the present state, up to their end; empty within a scan, and before a state.
  std::vector<uint8_t> state();
  bool isWhole() const { return whole_; }
  // Whether states are compared with the recorded ones, as they are at first.
  void compareStates(bool compares) { comparesStates_ = compares; }

private:
  static int32_t request(void* player, rung_instance* instance, const rung_request* request, rung_reply* reply);
  int32_t decide(const rung_request& request, rung_reply& reply);
  bool isNext(runtime::Event event) const { return !reader_.atEnd() && reader_.next() == event; }
  runtime::Played damaged();
  runtime::Played playState();
  runtime::Played playPart();
  void compareState(std::span<const uint8_t> recorded);
  void compareOutcome();
  bool takeBefore(runtime::Event event);
  bool takeSurroundings();
  bool takeConfigured();
  bool takeInputs();
  bool takeForces();
  bool takeFunction();
  std::optional<core::ServiceReply> takeReply();
  void run();

  runtime::PlayerOwner& owner_;
  rung_instance* instance_ = nullptr;
  runtime::EventReader reader_{{}};
  std::optional<runtime::InputBits> inputs_, nextInputs_; // those of the next state
  std::vector<Configured> configured_;                    // that the control has
  runtime::BlockBytes bits_;
  bool neededOnly_ = false;
  bool served_ = false;
  bool comparesStates_ = true;
  bool whole_ = false;
  bool failed_ = false;
  bool wasFaulted_ = false;
  bool otherRequests_ = false;                       // the program has asked for something that it had not asked for
  runtime::PartKind kind_ = runtime::PartKind::Scan; // of the last part
  uint32_t number_ = 0;
  uint64_t repeats_ = 0; // that are left
  std::optional<runtime::PlayedDifference> difference_;
};

} // namespace rung::api
