// The messages of a program on the screen of the NCT control (man. §6.13, N_CLRMSG l.7987-8013): a list with the last
// message sent on top. It accepts the messages of the program, deletes those that the operator clears, and reports the
// displayed messages to the program by the space @SHOWN and by N_MSGA, N_MSG0 and N_ACTMSG.
//
// A code is displayed once: if it is sent again, it moves to the top with its new value. A message that the operator
// clears disappears at the end of the PLC cycle in which N_CLRMSG is 1, so that the program sees both at once (l.2870);
// it reappears only with the next rising edge. If a program with another text takes over, the message ends for the host
// and begins anew; the list stays. Scan thread; only `shown` and the constructor of Places allocate.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/nct/signal_memory.h"
#include "rtlib/nc/nct/messages.h"
#include "rtlib/run/instance.h"

namespace rung::nc::nct {

class Messages {
  enum class Renewal : uint8_t { None, End, Begin }; // what is to be reported to the host next
  struct Entry {
    uint32_t code;
    bool clearing; // it disappears at the end of this cycle
    Renewal renewal;
    rung_message message;
    template <class Archive>
    void state(Archive& archive) {
      archive(code, clearing, message.op, message.number, message.channel, message.index, message.value, message.real,
              message.rung);
    }
  };

public:
  // The cells of one program's messages, and storage for its list.
  class Places {
  public:
    explicit Places(const rung_program& of);

  private:
    friend class Messages;
    const rung_program* program;
    PackedSpace cells; // the space @SHOWN
    std::vector<Entry> list;
    std::vector<uint32_t> cleared, sorted;
  };

  // At power-on, after the program's memory has been initialized.
  void powerOn();
  // Sets the places of the running program; of the two lists, the one with more room stays here. Messages that no box
  // of the program wants any more are cleared by messages of the program; after a power-on there are none.
  void use(runtime::Instance& instance, Places& places) noexcept;
  // As Control::nextChange, of messages whose texts another program has changed.
  bool nextChange(rung_message& message) noexcept;
  // A message that the program has sent.
  void accept(const rung_message& message);
  // The operator's buttons: CANCEL clears the message on top, others clear the selected message or all of them. False:
  // the selected message is not displayed.
  void cancelTop();
  void cancelAll();
  bool cancel(uint32_t code);
  // Called before a time slice. `common` is the word of N_CLRMSG, N_MSGA and N_MSG0; `lost` counts messages that found
  // no room in the program's queue.
  enum class Slice : uint8_t { Alone, First, Further }; // outside PLC cycles; the first of a cycle; a later one
  void timeSlice(const SignalMemory& signals, SignalWord& common, Slice slice, uint32_t lost);
  // Called after a PLC cycle; if it was not called, the first time slice of the next cycle does its work.
  void endCycle();

  template <class Archive>
  void state(Archive& archive) {
    archive(list_, cleared_, lost_, cancel_, pressed_, ownSignal_);
    if constexpr (Archive::kLoads) changed_ = true;
  }

  std::vector<ShownMessage> shown(const rung_program& program) const;
  bool shows(std::span<const ShownMessage> these) const noexcept;

private:
  uint32_t cells() const { return static_cast<uint32_t>(cells_.size() / (size_t{kMessageWords} * 4)); }
  uint32_t cell(uint32_t box, uint32_t word) const;
  void setShown(uint32_t box, bool shown);
  bool isShown(uint32_t code) const;
  bool isWanted(uint32_t code) const noexcept;
  void endGone(runtime::Instance& instance) noexcept;
  void remove(uint32_t code);
  void registered(uint32_t code);
  void dropUnwanted();
  void report(const SignalMemory& signals, SignalWord& common);
  void press(const SignalWord& common, bool inCycle);

  BitSignal clear_{"N_CLRMSG"};
  BitSignal any_{"N_MSGA"};
  BitSignal plc_{"N_MSG0"};
  WordSignal active_{"N_ACTMSG"};
  const rung_program* program_ = nullptr;
  std::span<uint8_t> cells_;      // of the Places in use
  std::vector<Entry> list_;       // the last element is on top; with room for a message of each box
  std::vector<uint32_t> cleared_; // by the operator since the last cycle
  std::vector<uint32_t> sorted_;  // scratch: the codes of the list
  uint32_t lost_ = 0;
  bool cancel_ = false;    // the operator pressed a button since the last cycle
  bool pressed_ = false;   // N_CLRMSG as it was in the last time slice
  bool ownSignal_ = false; // N_CLRMSG is 1 because of that button
  bool changed_ = true;
};

// Writes the message's number and its text with the values. Returns the number of characters written; longer texts are
// cut off. Allocates nothing.
size_t logLine(const rung_program& program, const rung_message& message, std::span<char> out) noexcept;

} // namespace rung::nc::nct
