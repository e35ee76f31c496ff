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

class HostPlayer : public runtime::Player {
public:
  // Makes an instance of the program of `image`, by whatever engine. `owner` outlives the player. Throws
  // std::runtime_error if the library refuses the image.
  HostPlayer(rung_image* image, runtime::PlayerOwner& owner);
  ~HostPlayer() override;

  // Messages of the program are in the queue of the instance after each part.
  runtime::Instance& instance() override { return instance_->running; }
  const nc::Control& control() const { return *instance_->control; }

private:
  // An observer sees all hooks of the schedule; those in which the control has nothing to do do nothing.
  class AllHooks final : public runtime::ScheduleHooks {
  public:
    explicit AllHooks(Hooks& own) : own_(own) {}
    void onHook(runtime::Instance& running, uint32_t work) override {
      if ((own_.works() >> work & 1) != 0) own_.onHook(running, work);
    }
    void onFault(runtime::Instance& running) override { own_.onFault(running); }
    void onLatch(runtime::Instance& running, uint32_t task) override { own_.onLatch(running, task); }
    bool respond(runtime::Instance& running, const core::ServiceRequest& request, core::ServiceReply& reply) override {
      return own_.respond(running, request, reply);
    }

  private:
    Hooks& own_;
  };

  static int32_t request(void* player, rung_instance* instance, const rung_request* request, rung_reply* reply);
  int32_t decide(const rung_request& request, rung_reply& reply);

  bool save(core::Saver& saver) const override;
  runtime::LoadResult load(core::Loader& loader) override;
  size_t roomForOthers() const override;
  void putBeforeState(runtime::EventWriter& writer) const override;
  void putAfterState(runtime::EventWriter& writer) const override { inputs_->listKnown(writer); }
  void beforeComparison() override { inputs_->write(instance().block().data()); }
  bool takeOther(runtime::Event event) override;
  bool mayRun(runtime::PartKind kind) const override { return kind != runtime::PartKind::Task; } // no part of a host
  void run() override;
  void compareOutcome() override;

  bool takeSurroundings();
  bool takeConfigured();
  bool configure(const Configured& what);
  bool takeInputs();
  bool takeInput(uint32_t offset, std::span<const uint8_t> bytes) override;
  bool takeFunction();

  rung_instance* instance_ = nullptr;
  std::optional<AllHooks> hooks_;
  std::optional<runtime::InputBits> inputs_, nextInputs_; // those of the next state
  std::vector<Configured> configured_;                    // that the control has
  bool neededOnly_ = false;
  bool otherRequests_ = false; // the program has asked for something that it had not asked for
};

} // namespace rung::api
