// M, S, T and further functions of a part program, and keys, on their way from the NC to the PLC program, by the
// dialect's own handshake. A simulated NC and a host that drives a machine hand functions over by the same class.
// Everything here is for the scan thread and allocates nothing.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/core/queues.h"
#include "rtlib/retain/retained_memory.h"
#include "rtlib/run/instance.h"

namespace rung::nc {

// B: the second auxiliary function; Key: one of the panel that is pressed and released.
enum class FunctionKind : uint8_t { M, S, T, B, H, Key };
inline constexpr std::string_view kFunctionKinds[] = {"M", "S", "T", "B", "H", "key"}; // by FunctionKind

// The functions of one channel of the control (Control::functions). They are ready once the program is switched on; a
// power-on leaves none under way.
class Functions {
public:
  virtual ~Functions() = default;

  // From now on the program finishes every kind of function by a signal of its own, so that kinds do not wait for each
  // other. False: the dialect has no such mode.
  virtual bool useHighSpeed() { return false; }
  // The machine has this M function in a group of its choice, from now on. False: the dialect has no such group, or the
  // function has its group for good.
  virtual bool setGroup(uint32_t code, uint32_t group) { return (void)code, (void)group, false; }
  // False: the dialect has no signals for this kind of function, or none that hold the code.
  virtual bool supports(FunctionKind kind, uint32_t code) const = 0;

  // Hands a function over that the signals carry; gives the line that it is on, which is its own until it is finished.
  // Nothing: the signals that it needs are in use, or it is not the time for it; try again before a later slice.
  virtual std::optional<uint32_t> start(FunctionKind kind, uint32_t code) = 0;
  // Before every slice of the program.
  virtual void step() = 0;
  // The program has not finished the function on this line, of which there may be none.
  virtual bool busy(uint32_t line) const = 0;
  // Reset, emergency stop: what is under way ends at once, unanswered.
  virtual void abort() = 0;
};

// How people write a message's number.

inline constexpr size_t kMessageNumber = 64; // characters: more than any has

// The number as the program has it, and which message of that number it is: "12", "12 (channel 1, index 0)". Gives the
// characters written; what does not fit is cut off. Allocates nothing.
size_t putMessageNumber(uint32_t number, int32_t channel, int32_t index, std::span<char> out) noexcept;

// A message of the program as the control shows it to its operator.

struct ShownMessage {
  uint32_t number = 0;
  int32_t channel = 0;
  int32_t index = 0;
  int64_t value = 0; // the bits of a double when `real`; TECHNOL: par1
  bool real = false;
  std::string text;
  uint32_t par2 = 0, par3 = 0; // TECHNOL
  bool operator==(const ShownMessage&) const = default;
  // The same message with the same values: then a program has one text for both.
  bool isSameButText(const ShownMessage& other) const {
    return number == other.number && channel == other.channel && index == other.index && value == other.value &&
           real == other.real && par2 == other.par2 && par3 == other.par3;
  }
};

// What the machine's configuration says of one message.
struct DefinedMessage {
  uint32_t number = 0;
  bool lasts = false;      // it is shown until the program ends it, else until the operator confirms it
  bool loggedOnly = false; // it is not shown
  std::string text;        // %d, %x and %X are places for the values of the message
};

// Characters that Control::describe may write; longer texts are cut off.
inline constexpr size_t kMessageLine = 400;

// What the software of a CNC does around its PLC program, whatever the machine: power-on and power-off, signals
// that the program takes for granted (clocks, first cycle, "ready"), messages, retained cells, names. One class a
// dialect (gsk/, nct/, technol/). A host that drives a real machine and the simulation alike put it beside the program.
//
// A control belongs to one instance and to its thread. What runs while the program is scanned (the hooks, accept,
// describe, afterSlice) allocates nothing, takes no lock and never blocks; the rest is for start, end and the operator.

enum class PowerOn : uint8_t { Cold, Warm };

// Where a control reads and writes in one program (Control::locate).
class Places {
public:
  virtual ~Places() = default;
};

class Control : public runtime::ScheduleHooks {
public:
  // The program is switched on in two steps, so that others can prepare memory in between. `prepare`: memory, presets
  // and signals of the control; a warm start keeps what the dialect keeps. `start`: what the control runs before the
  // first scan.
  virtual void prepare(runtime::Instance& instance, PowerOn kind);
  virtual void start(runtime::Instance& instance) { (void)instance; }
  void powerOn(runtime::Instance& instance, PowerOn kind) {
    prepare(instance, kind);
    start(instance);
  }

  // A regular power-off: what the control runs before it. True: the program has to be scanned on while `endsLater`, but
  // not longer than that.
  virtual bool beginPowerOff(runtime::Instance& instance) { return (void)instance, false; }
  virtual bool endsLater(const runtime::Instance& instance) const { return (void)instance, false; }
  static constexpr uint32_t kMostLastScans = 500;
  // All of it at once, with scans of the host.
  template <class Scan>
  void powerOff(runtime::Instance& instance, Scan scan) {
    if (!beginPowerOff(instance)) return;
    for (uint32_t i = 0; i < kMostLastScans && !instance.faulted() && endsLater(instance); ++i) scan();
  }

  // Looks up where the control reads and writes in a program of its dialect. Any thread, but not in real time.
  virtual std::unique_ptr<Places> locate(const rung_program& program) const { return (void)program, nullptr; }
  // Another program has taken over, between two scans: `places`, of that program, are what the control uses from now
  // on; it gets those of the former one. Allocates nothing.
  void exchangePlaces(runtime::Instance& instance, std::unique_ptr<Places>& places) noexcept;
  // The same for a host that has not looked them up beforehand.
  void onReplace(runtime::Instance& instance) override;

  // Before a scan, a slot or a slice, where a host moves a real machine: it has written its signals.
  virtual void beforeSlice(runtime::Instance& instance) { (void)instance; }
  // After a scan, a slot or a slice.
  virtual void afterSlice(runtime::Instance& instance) { (void)instance; }

  // The answer if there is no CNC to give one, so that a program never waits for ever. Of an error NCT's MR and MW make
  // execution code 1, and MACR, MACW, SCP and MOVCMND the flag FL_ER. Allocates nothing.
  virtual core::ServiceReply refuse(const core::ServiceRequest& request) const noexcept {
    return {.ticket = request.ticket, .state = RUNG_SERVICE_ERROR};
  }
  bool respond(runtime::Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    reply = refuse(request);
    return true;
  }

  // The place that a name of the program or of the NC's interface refers to for a reader, and for the NC or the machine
  // that writes it. Nothing when the name is unknown.
  virtual std::optional<runtime::Ref> readPlace(const rung_program& program, std::string_view name) const;
  virtual std::optional<runtime::Ref> writePlace(const rung_program& program, std::string_view name) const {
    return readPlace(program, name);
  }

  // Whether the control itself writes there, again and again or once for all, so that no other's value lasts:
  // constants, clocks. `place`: of writePlace.
  virtual bool writesItself(const rung_program& program, const runtime::Ref& place) const {
    return (void)program, (void)place, false;
  }

  // What the machine's configuration says of a message, before the first power-on. False: the dialect has texts of
  // messages in the program alone.
  virtual bool define(const DefinedMessage& message) { return (void)message, false; }
  // A message of the program's queue as a host reads it: its number alone, and what becomes of it.
  virtual rung_message outward(const rung_message& message) const noexcept { return message; }
  // A message that the host has taken from the program's queue, and those that the operator sees now.
  virtual void accept(const rung_message& message) { (void)message; }
  virtual std::vector<ShownMessage> messages(const runtime::Instance& instance) const {
    return (void)instance, std::vector<ShownMessage>();
  }
  // Whether the operator sees these now, and no others; texts are neither made nor compared. Allocates nothing.
  virtual bool shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept {
    return (void)instance, these.empty();
  }
  // For programs whose messages are bits: the next one that has come or gone since the last call, in `message`. False:
  // there is none. Between two scans; allocates nothing.
  virtual bool nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
    return (void)instance, (void)message, false;
  }
  // The line of a log: the message's number as the dialect writes it, and its text. Gives the characters written; what
  // does not fit is cut off.
  virtual size_t describe(const rung_program& program, const rung_message& message, std::span<char> out) const noexcept;
  // A message as its operator reads it: `message 12 (channel 1, index 0) "text"`.
  virtual std::string text(const ShownMessage& message) const;

  // A text of the program's memory as UTF-8, and one in UTF-8 as `bytes` bytes of memory hold it.
  virtual std::string shownText(std::string_view inMemory) const { return std::string(inMemory); }
  virtual std::string memoryText(std::string_view shown, uint32_t bytes) const {
    return (void)bytes, std::string(shown);
  }

  // Whether the program is run in slots of its schedule, too (Instance::slot).
  virtual bool runsInSlots() const { return false; }

  // The handshake of M, S and T functions in a channel, which count from 0; null: the control has no such channel, or
  // the dialect no such functions.
  virtual Functions* functions(uint32_t channel) { return (void)channel, nullptr; }

  // The program commands this axis by the signals of a group, from now on, and the host's CNC moves it; both count from
  // 0. False: the dialect has no such axis or group.
  virtual bool setAxisGroup(uint32_t axis, uint32_t group) { return (void)axis, (void)group, false; }
  // Whether a CNC carries out the program's requests; initially yes.
  virtual void setServed(bool served) { (void)served; }
  // The service of requests that the control itself makes for the program, outside of its tasks: its number, which no
  // program has, and what it is.
  static constexpr uint32_t kOwnService = 0x8000'0000;
  virtual core::ServiceName ownService() const { return {}; }

  // The program's retained memory was there but could not be restored: called before the power-on.
  virtual void reportRetainedLost() {}
  // TECHNOL saves its retained memory at a power-off and when the program asks, and at no other time: a host that
  // stores it says so before the power-on, looks between two scans whether the program asks, and reports when it is on
  // disk.
  virtual bool savesOnRequest() const { return false; }
  virtual void setStored(bool stored) { (void)stored; }
  virtual bool asksToSave(const runtime::Instance& instance) const { return (void)instance, false; }
  virtual void saved(runtime::Instance& instance) { (void)instance; }

protected:
  // Another program has taken over: these are its places, which stay until there are others. Allocates nothing.
  virtual void usePlaces(runtime::Instance& instance, Places& places) noexcept { (void)instance, (void)places; }

  // The NC's signals by their predeclared names; asked for what the program's own table does not hold.
  virtual std::optional<runtime::Ref> signal(const rung_program& program, std::string_view name) const {
    return (void)program, (void)name, std::nullopt;
  }

private:
  std::unique_ptr<Places> places_;
};

// By rung_program::dialect; a plain control for a dialect without one.
std::unique_ptr<Control> makeControl(std::string_view dialect);

// The retained memory of a program on disk, as its control wants it: what every host does that is given a file for it.

class Retention {
public:
  // Control and instance outlive this. FILE of FILE.a and FILE.b. `take`: as RetainedMemory has it.
  Retention(Control& control, runtime::Instance& instance, const std::string& file,
            runtime::RetainTake take = &runtime::takeRetainedOf, const runtime::Outside& outside = {});

  // Before the power-on: how the program is switched on. Nothing, and `error` says why: the files cannot be used.
  // `report`: what the operator should know of them, or "".
  std::optional<PowerOn> load(std::string& report, std::string& error);
  // Scan thread, after every slice and Control::afterSlice; never waits. False: the program asks for saving, and that
  // is not on disk yet.
  bool afterSlice() noexcept;
  // After the last scan; before the power-off too, because a fault in the scans that it needs spoils them. "" or why
  // the last whole scan is not on disk.
  std::string finish() { return memory_.finish(*instance_); }

  // How saving goes: for any thread, without a lock.
  const runtime::RetainedMemory& memory() const { return memory_; }
  // As RetainedMemory has them.
  void programChanged(std::unique_ptr<runtime::RetainChannel>& channel) noexcept { memory_.programChanged(channel); }
  void settle() { memory_.settle(); }
  // Not in a scan: waits for what was offered.
  bool flush() { return memory_.flush(); }
  // As RetainSaver has them.
  void look() noexcept { memory_.look(); }
  void abandon() noexcept { memory_.abandon(); }

private:
  Control* control_;
  runtime::Instance* instance_;
  runtime::RetainedMemory memory_;
};

} // namespace rung::nc
