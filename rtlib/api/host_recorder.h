// Records what the host of an instance does to it, from which a player (host_player.h) computes everything again with
// the control of the dialect: inputs, written cells, answers, functions, the clock, forces, the operator's stop, faults
// and replacements. What the control does is not recorded. The functions are for the scan thread, allocate nothing and
// never wait.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "rtlib/api/environment.h"
#include "rtlib/record/input_bits.h"
#include "rtlib/record/part_stream.h"
#include "rung/runtime.h"

namespace rung::api {

struct Generation;

// A setting of the control by the machine's configuration (Event::Configured).
struct Configured {
  enum class Kind : uint8_t {
    Stored,    // retained memory is on disk
    HighSpeed, // channel
    Group,     // channel, code, group
    AxisGroup, // axis, group
    Message,   // number, flags, text
  };
  Kind kind = Kind::Stored;
  uint32_t a = 0, b = 0, c = 0;
  std::string text = {};
  bool operator==(const Configured&) const = default;
};
// Event::Configured, and the bytes that it takes at most.
void putConfiguration(runtime::EventWriter& writer, const Configured& of) noexcept;
size_t roomFor(const std::vector<Configured>& all) noexcept;

// Of the whole state of an instance as it is recorded; 0: it was never on.
size_t stateSize(const rung_instance& instance) noexcept;

// The bits that the bound variables of an instance write in one of its programs. Not in real time.
std::unique_ptr<runtime::InputBits> inputBits(const rung_instance& instance, const Generation& generation);

class HostRecorder {
public:
  HostRecorder(rung_instance& instance, const runtime::RecorderOptions& options);
  ~HostRecorder();
  HostRecorder(const HostRecorder&) = delete;
  HostRecorder& operator=(const HostRecorder&) = delete;

  runtime::PartStream& stream() noexcept { return stream_; }

  // Before a part, after its inputs; `withInputs`: they have been written.
  void partBegins(runtime::PartKind kind, uint32_t number, bool withInputs) noexcept;
  void partEnds() noexcept;
  // The part finds this reply.
  void replied(const core::ServiceReply& reply) noexcept;
  // Of a request, whether it is the program's or the control's. `answer`: enum rung_answer.
  void decided(int32_t answer, const core::ServiceReply& reply) noexcept;
  // The host has written there.
  void written(const core::Place& place) noexcept;
  void writtenText(const runtime::Ref& ref) noexcept;
  // Before the host begins a function; `refused` takes it back.
  void functionBegins(uint32_t channel, int32_t kind, uint32_t code) noexcept;
  void functionRefused() noexcept;
  void aborts(uint32_t channel) noexcept;
  void served(bool is) noexcept;
  void saved() noexcept;
  void stopped(bool is) noexcept;
  void forcesChanged() noexcept;
  // Memory or configuration are others than before.
  void changedWhole() noexcept { stream_.beginAnew(); }
  // Another program runs; `bits` are its inputs, and receive those of the former one.
  void programChanged(std::unique_ptr<runtime::InputBits>& bits) noexcept;
  // The host has bound other variables. Not in real time.
  void inputsChanged();

private:
  void putState() noexcept;
  bool putStateInto(size_t reserved) noexcept; // bytes for the state
  bool putWhole(runtime::EventWriter& writer) noexcept;
  void putBefore(runtime::InputBits::Step* other) noexcept;
  void endFaulted() noexcept;
  void putBytes(uint32_t offset, uint32_t count) noexcept;
  void putLogicalByte(uint32_t space, uint32_t byte) noexcept;
  runtime::EventWriter& events() noexcept { return stream_.events(); }

  rung_instance& instance_;
  runtime::Instance& running_;
  runtime::PartStream stream_;
  std::unique_ptr<runtime::InputBits> inputs_; // null: the program is not recorded; never while whole
  bool inPart_ = false;
  bool served_ = false, servedKnown_ = false;
  bool faulted_ = false;
  bool neededOnly_ = false;
  int64_t nowUs_ = 0; // after the last part
  size_t stateBytes_; // of the last state, and a reserve
  size_t beforeFunction_ = 0;
};

} // namespace rung::api
