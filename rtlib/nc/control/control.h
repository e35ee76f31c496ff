// M, S, T and further functions of a part program, and keys, on their way from the NC to the PLC program, by the
// dialect's own handshake. A simulated NC and a host that drives a machine start functions by the same class. Scan
// thread; nothing in Functions allocates.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/core/archive.h"
#include "rtlib/core/queues.h"
#include "rtlib/retain/retained_memory.h"
#include "rtlib/run/instance.h"

namespace rung::nc {

// B: the second auxiliary function; Key: a key of the panel, which is pressed and released.
enum class FunctionKind : uint8_t { M, S, T, B, H, Key };
inline constexpr std::string_view kFunctionKinds[] = {"M", "S", "T", "B", "H", "key"}; // by FunctionKind

// The functions of one channel of the control (Control::functions). They are ready once the program is switched on; at
// a power-on no function is under way.
class Functions {
public:
  virtual ~Functions() = default;

  // From now on the program finishes each kind of function by a separate signal, so that kinds do not wait for each
  // other. False: the dialect has no such mode.
  virtual bool useHighSpeed() { return false; }
  // Assigns this M function to a group, from now on. False: the dialect has no such group, or the group of the function
  // is fixed.
  virtual bool setGroup(uint32_t code, uint32_t group) { return (void)code, (void)group, false; }
  // False: the dialect has no signals for this kind of function, or they cannot hold the code.
  virtual bool supports(FunctionKind kind, uint32_t code) const = 0;

  // Starts a function that is supported; returns its handle, which is valid until it is finished. Nothing: the signals
  // that it needs are in use, or it cannot start now; try again before a later slice.
  virtual std::optional<uint32_t> start(FunctionKind kind, uint32_t code) = 0;
  // Continues the handshakes; to be called before every slice of the program.
  virtual void step() = 0;
  // Whether the program has not finished the function with this handle; false if there is no such function.
  virtual bool busy(uint32_t handle) const = 0;
  // Reset, emergency stop: functions under way end at once, without an answer.
  virtual void abort() = 0;
};

// The number of a message as users write it.

inline constexpr size_t kMessageNumber = 64; // characters, enough for any number

// Writes the number of a message, with channel and index if it has any: "12", "12 (channel 1, index 0)". Returns the
// number of characters written; longer texts are cut off. Allocates nothing.
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
  // Whether it is the same message with the same values, so that both have the same text in a program.
  bool isSameButText(const ShownMessage& other) const {
    return number == other.number && channel == other.channel && index == other.index && value == other.value &&
           real == other.real && par2 == other.par2 && par3 == other.par3;
  }
};

// The definition of one message by the machine's configuration.
struct DefinedMessage {
  uint32_t number = 0;
  bool lasts = false;      // shown until the program ends it; else until the operator confirms it
  bool loggedOnly = false; // logged, but not shown
  std::string text;        // %d, %x and %X are places for the values of the message
};

// Characters that Control::describe may write; longer texts are cut off.
inline constexpr size_t kMessageLine = 400;

// Control: the part of a CNC's software that surrounds its PLC program on any machine: power-on and power-off, signals
// on which the program relies (clocks, first cycle, "ready"), messages, retained cells, names. There is one class for
// each dialect (nct/, technol/) or family of dialects (pmc/), used by hosts that drive a real machine and by the
// simulation.
//
// A control belongs to one instance and to its thread. The functions called during scans (hooks, accept, describe,
// afterSlice) allocate nothing, take no lock and never block; the others are called at start and end and for the
// operator.

enum class PowerOn : uint8_t { Cold, Warm };

// The places that a control reads and writes in one program (Control::locate).
class Places {
public:
  virtual ~Places() = default;
};

class Control : public runtime::ScheduleHooks {
public:
  // The program is switched on in two steps, so that the caller can prepare memory in between. `prepare` initializes
  // memory, presets and signals of the control; a warm start keeps retained memory. `start` runs the tasks that the
  // control runs before the first scan.
  virtual void prepare(runtime::Instance& instance, PowerOn kind);
  virtual void start(runtime::Instance& instance) { (void)instance; }
  void powerOn(runtime::Instance& instance, PowerOn kind) {
    prepare(instance, kind);
    start(instance);
  }

  // A regular power-off: runs the tasks that the control runs before it. True: scans must continue while `endsLater` is
  // true, at most kMostLastScans.
  virtual bool beginPowerOff(runtime::Instance& instance) { return (void)instance, false; }
  virtual bool endsLater(const runtime::Instance& instance) const { return (void)instance, false; }
  static constexpr uint32_t kMostLastScans = 500;
  // The complete power-off; `scan` runs one scan of the host.
  template <class Scan>
  void powerOff(runtime::Instance& instance, Scan scan) {
    if (!beginPowerOff(instance)) return;
    for (uint32_t i = 0; i < kMostLastScans && !instance.faulted() && endsLater(instance); ++i) scan();
  }

  // Looks up the places that the control reads and writes in a program of its dialect. Any thread, but not in real
  // time.
  virtual std::unique_ptr<Places> locate(const rung_program& program) const { return (void)program, nullptr; }
  // Another program has taken over, between two scans: the control uses `places`, which belong to that program, from
  // now on, and returns the former ones in it. Allocates nothing.
  void exchangePlaces(runtime::Instance& instance, std::unique_ptr<Places>& places) noexcept;
  // The same for a host that has not looked up the places beforehand; allocates.
  void onReplace(runtime::Instance& instance) override;

  // Called before a scan, a slot or a slice by a host that moves a real machine and has written its signals.
  virtual void beforeSlice(runtime::Instance& instance) { (void)instance; }
  // Called after a scan, a slot or a slice.
  virtual void afterSlice(runtime::Instance& instance) { (void)instance; }

  // The answer without a CNC, so that no program waits forever. NCT's MR and MW turn an error into execution code 1,
  // MACR, MACW, SCP and MOVCMND into the flag FL_ER. Allocates nothing.
  virtual core::ServiceReply refuse(const core::ServiceRequest& request) const noexcept {
    return {.ticket = request.ticket, .state = RUNG_SERVICE_ERROR};
  }
  bool respond(runtime::Instance&, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    reply = refuse(request);
    return true;
  }

  // The place where a name of the program or of the NC's interface is read, and the place that the NC or the machine
  // writes. Nothing if the name is unknown.
  virtual std::optional<runtime::Ref> readPlace(const rung_program& program, std::string_view name) const;
  virtual std::optional<runtime::Ref> writePlace(const rung_program& program, std::string_view name) const {
    return readPlace(program, name);
  }

  // Whether the control itself writes there, repeatedly or once, so that values of other writers do not last:
  // constants, clocks. `place` is a result of writePlace.
  virtual bool writesItself(const rung_program& program, const runtime::Ref& place) const {
    return (void)program, (void)place, false;
  }

  // Defines a message as the machine's configuration does, before the first power-on. False: the dialect has message
  // texts only in the program.
  virtual bool define(const DefinedMessage& message) { return (void)message, false; }
  // Whether programs have the value of this place, or of a part of it, in their code: what is written or forced there
  // has no effect.
  virtual bool isConstant(const rung_program& program, const runtime::Ref& place) const {
    return (void)program, (void)place, false;
  }

  // Converts a message of the program's queue to the form that a host reads: the plain number, and the operation that
  // applies.
  virtual rung_message outward(const rung_message& message) const noexcept { return message; }
  // `accept` receives a message that the host has taken from the program's queue; `messages` returns the messages that
  // the operator sees now.
  virtual void accept(const rung_message& message) { (void)message; }
  virtual std::vector<ShownMessage> messages(const runtime::Instance& instance) const {
    return (void)instance, std::vector<ShownMessage>();
  }
  // Whether the operator sees exactly these messages now; texts are neither made nor compared. Allocates nothing.
  virtual bool shows(const runtime::Instance& instance, std::span<const ShownMessage> these) const noexcept {
    return (void)instance, these.empty();
  }
  // Returns in `message` the next one that has appeared or disappeared since the last call without a message of the
  // program: in dialects whose messages are bits, and where another program has changed a text. False: there is none.
  // To be called between two scans; allocates nothing.
  virtual bool nextChange(const runtime::Instance& instance, rung_message& message) noexcept {
    return (void)instance, (void)message, false;
  }
  // Writes the log line of a message: its number as the dialect writes it, and its text. Returns the number of
  // characters written; longer texts are cut off.
  virtual size_t describe(const rung_program& program, const rung_message& message, std::span<char> out) const noexcept;
  // A message as the operator reads it: `message 12 (channel 1, index 0) "text"`.
  virtual std::string text(const ShownMessage& message) const;

  // Convert a text of the program's memory to UTF-8, and a UTF-8 text to the form that `bytes` bytes of memory hold.
  virtual std::string shownText(std::string_view inMemory) const { return std::string(inMemory); }
  virtual std::string memoryText(std::string_view shown, uint32_t bytes) const {
    return (void)bytes, std::string(shown);
  }

  // The state of the control, beside that of its instance (Instance::save): handshakes under way, messages that are
  // shown, what it has seen of signals. What follows from the machine's configuration is not a part. `load` takes what
  // a control of the same dialect has saved, with the same program in the instance. `save` allocates nothing.
  virtual void save(core::Saver& saver) const noexcept { (void)saver; }
  virtual void load(core::Loader& loader) { (void)loader; }

  // Whether the schedule has slots (Instance::slot).
  virtual bool runsInSlots() const { return false; }

  // The handshake of M, S and T functions in a channel, which count from 0; null: the control has no such channel, or
  // the dialect no such functions.
  virtual Functions* functions(uint32_t channel) { return (void)channel, nullptr; }

  // From now on the program commands this axis by the signals of a group, and the host's CNC moves it; both count from
  // 0. False: the dialect has no such axis or group.
  virtual bool setAxisGroup(uint32_t axis, uint32_t group) { return (void)axis, (void)group, false; }
  // Whether a CNC carries out the program's requests; initially yes.
  virtual void setServed(bool served) { (void)served; }
  // The service of requests that the control itself makes for the program, outside its tasks: its number, which no
  // program uses, and its name and kind.
  static constexpr uint32_t kOwnService = 0x8000'0000;
  virtual core::ServiceName ownService() const { return {}; }

  // Called before the power-on if the program's retained memory existed but could not be restored.
  virtual void reportRetainedLost() {}
  // TECHNOL saves its retained memory only at a power-off and when the program requests it: a host that stores it calls
  // setStored before the power-on, checks asksToSave between two scans, and calls `saved` when the memory is on disk.
  virtual bool savesOnRequest() const { return false; }
  virtual void setStored(bool stored) { (void)stored; }
  virtual bool asksToSave(const runtime::Instance& instance) const { return (void)instance, false; }
  virtual void saved(runtime::Instance& instance) { (void)instance; }

protected:
  // Called when another program has taken over: its places, which stay valid until the next call. Allocates nothing.
  virtual void usePlaces(runtime::Instance& instance, Places& places) noexcept { (void)instance, (void)places; }

  // A signal of the NC by its predeclared name; used for names that the program's own table does not contain.
  virtual std::optional<runtime::Ref> signal(const rung_program& program, std::string_view name) const {
    return (void)program, (void)name, std::nullopt;
  }

private:
  std::unique_ptr<Places> places_;
};

// Makes the control of a dialect (rung_program::dialect); for other dialects a plain Control.
std::unique_ptr<Control> makeControl(std::string_view dialect);

// The retained memory of a program on disk, saved as its control requires. Used by every host that stores retained
// memory.

class Retention {
public:
  // Control and instance outlive this object. `file` is FILE of FILE.a and FILE.b; `take` as in RetainedMemory.
  Retention(Control& control, runtime::Instance& instance, const std::string& file,
            runtime::RetainTake take = &runtime::takeRetainedOf, const runtime::Outside& outside = {});

  // Loads the memory before the power-on, and returns how to switch the program on. Nothing, and `error` says why: the
  // files cannot be used. `report` is a message about the files for the operator, or "".
  std::optional<PowerOn> load(std::string& report, std::string& error);
  // Scan thread, after every slice and Control::afterSlice; never waits. False: the program has requested saving, and
  // the memory is not on disk yet.
  bool afterSlice() noexcept;
  // Saves after the last scan; also called before the power-off, because a fault in its last scans would make them
  // unusable. Returns "", or why the last whole scan is not on disk.
  std::string finish() { return memory_.finish(*instance_); }

  // The state of saving. Any thread, without a lock.
  const runtime::RetainedMemory& memory() const { return memory_; }
  // As in RetainedMemory.
  void programChanged(std::unique_ptr<runtime::RetainChannel>& channel) noexcept { memory_.programChanged(channel); }
  void settle() { memory_.settle(); }
  // As in RetainedMemory; waits, so not for the scan thread.
  bool flush() { return memory_.flush(); }
  // As in RetainSaver.
  void look() noexcept { memory_.look(); }
  void abandon() noexcept { memory_.abandon(); }

private:
  Control* control_;
  runtime::Instance* instance_;
  runtime::RetainedMemory memory_;
};

} // namespace rung::nc
