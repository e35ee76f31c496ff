// The messages of a program on the screen of the NCT control (man. §6.13, N_CLRMSG l.7987-8013): a list in which the
// last one sent is on top. It takes what the program sent, deletes what the operator clears, and reports to the program
// by the space @SHOWN and by N_MSGA, N_MSG0 and N_ACTMSG what is displayed.
//
// A code is displayed once: sent again it comes to the top with its new number. A message that the operator clears goes
// at the end of the PLC cycle in which N_CLRMSG is 1, so that the program sees both at once (l.2870); it comes back
// with the next rising edge only. Nothing here allocates, but `shown` and the makers of places.
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
  struct Entry {
    uint32_t code;
    bool clearing; // goes at the end of this cycle
    rung_message message;
  };

public:
  // Where the messages of one program have their cells, and room for them.
  class Places {
  public:
    explicit Places(const rung_program& program);

  private:
    friend class Messages;
    PackedSpace cells; // the space @SHOWN
    std::vector<Entry> list;
    std::vector<uint32_t> cleared, sorted;
  };

  // The program's memory has been started.
  void powerOn();
  // Of the program that runs now. Whichever has more room stays here. Messages that no box of it wants are cleared, by
  // messages of the program: after a power-on there are none.
  void use(runtime::Instance& instance, Places& places) noexcept;
  // What the program sent.
  void accept(const rung_message& message);
  // The operator's buttons: CANCEL takes the message on top, others the selected one or all of them. False: the
  // selected one is not displayed.
  void cancelTop();
  void cancelAll();
  bool cancel(uint32_t code);
  // Before a time slice. `common`: the word of N_CLRMSG, N_MSGA and N_MSG0; `lost` counts messages that found no room
  // in the program's queue.
  enum class Slice : uint8_t { Alone, First, Further }; // in no PLC cycle; its first one; another one
  void timeSlice(const SignalMemory& signals, SignalWord& common, Slice slice, uint32_t lost);
  // After a PLC cycle; the first time slice of the next one makes up for it if this was not called.
  void endCycle();

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
  std::span<uint8_t> cells_;      // see Places
  std::vector<Entry> list_;       // the top is the last one; room for a message of each box
  std::vector<uint32_t> cleared_; // by the operator since the last cycle
  std::vector<uint32_t> sorted_;  // scratch: the codes of the list
  uint32_t lost_ = 0;
  bool cancel_ = false;    // the operator pressed a button since the last cycle
  bool pressed_ = false;   // N_CLRMSG as it was in the last time slice
  bool ownSignal_ = false; // N_CLRMSG is 1 because of that button
  bool changed_ = true;
};

// The message's number and the text with its values: the characters written, what does not fit is cut off.
// Allocates nothing.
size_t logLine(const rung_program& program, const rung_message& message, std::span<char> out) noexcept;

} // namespace rung::nc::nct
