// What the software of a CNC does around its PLC program, whatever the machine: power-on and power-off, signals that
// the program takes for granted (clocks, first cycle, "ready"), messages, retained cells, names. One class a dialect
// (gsk/, nct/, technol/). A host that drives a real machine and the simulation alike put it beside the program.
//
// A control belongs to one instance and to its thread. What runs while the program is scanned (the hooks, accept,
// describe, afterSlice) allocates nothing, takes no lock and never blocks; the rest is for start, end and the operator.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/nc/control/functions.h"
#include "rtlib/nc/control/shown_message.h"
#include "rtlib/run/instance.h"

namespace rung::nc {

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
  // Another program has taken over, between two passes: `places`, of that program, are what the control uses from now
  // on; it gets those of the former one. Allocates nothing.
  void exchangePlaces(runtime::Instance& instance, std::unique_ptr<Places>& places) noexcept;
  // The same for a host that has not looked them up beforehand.
  void onReplace(runtime::Instance& instance) override;

  // Before a scan, a slot or a slice, where a host moves a real machine: it has written its signals.
  virtual void beforeSlice(runtime::Instance& instance) { (void)instance; }
  // After a scan, a slot or a slice.
  virtual void afterSlice(runtime::Instance& instance) { (void)instance; }

  // No CNC is there to answer: see refuse.h.
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;

  // The place that a name of the program or of the NC's interface refers to for somebody who reads it, and for the NC
  // or the machine that writes it. Nothing when the name is unknown.
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
  // there is none. Between two passes; allocates nothing.
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
  // Whether somebody carries out what is asked of the CNC; so it is until something else is said.
  virtual void setServed(bool served) { (void)served; }
  // The service of requests that the control itself makes for the program, outside of its tasks: its number, which no
  // program has, and its text as rung_program::services has it.
  static constexpr uint32_t kOwnService = 0x8000'0000;
  virtual const char* ownService() const { return ""; }

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

// By rung_program::dialect; a plain control for a dialect that has none of its own.
std::unique_ptr<Control> makeControl(std::string_view dialect);

} // namespace rung::nc
