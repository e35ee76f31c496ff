// Window instructions: data of the CNC through a control block (§8). The states of a request and the lock of low-speed
// functions are the family's; a dialect says what it refuses, what it asks for and where the answer goes.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "frontend/network/lower/lower_function.h"
#include "rtlib/nc/pmc/window_functions.h"

namespace rung::frontend::network {

class WindowLowering {
public:
  virtual ~WindowLowering() = default;
  // Lowers the instruction: its first parameter is the control block, its only condition ACT.
  void run();

protected:
  WindowLowering(Lowering& f, bool writes, std::span<const nc::pmc::WindowFunction> functions)
      : f_(f), b_(f.b), writes_(writes), functions_(functions) {}

  // The end code (i64) of a request that is refused without asking the CNC, kNoError for one that is not.
  virtual ir::ValueId refusal(ir::ValueId function, ir::ValueId length) = 0;
  // Sends the request; returns its ticket.
  virtual ir::ValueId request(ir::ValueId function, ir::ValueId length) = 0;
  // The end code (i64) of a request that the host answers with an error.
  virtual int64_t notProvided() const = 0;
  // Whether the instruction has finished in this run, with the end code; `ticket` is that of the request, 0 if there
  // was none. Called in every run, after the output has been set.
  struct Answer {
    ir::ValueId finished; // bit
    ir::ValueId end;      // i64
    ir::ValueId ticket;   // i32
    ir::ValueId length;   // i16, of the block when the request was sent
  };
  virtual void finish(const Answer& answer) = 0;
  // The code in the table of functions.
  virtual ir::ValueId codeOf(ir::ValueId function) { return function; }

  static constexpr int64_t kNoError = 0;
  bool writes() const { return writes_; }
  Address at(uint32_t offset) const { return plus(f_.param(0).address, offset); }
  ir::ValueId word(uint32_t offset) { return f_.load(ir::Type::I16, at(offset)); }
  // Bytes from the data to the end of the area; parameters.cpp ensures at least one.
  uint32_t room() const { return f_.room(at(nc::pmc::kWindowDataAt)); }
  // Whether a function code is one of those for which `belongs` is true.
  template <class Belongs>
  ir::ValueId isOneOf(ir::ValueId function, Belongs belongs) {
    return isOneOf(function, codesOf(belongs));
  }

  Lowering& f_;
  ir::RungBuilder& b_;

private:
  struct Step;

  template <class Belongs>
  std::vector<uint16_t> codesOf(Belongs belongs) const {
    std::vector<uint16_t> codes;
    for (const nc::pmc::WindowFunction& function : functions_)
      if (belongs(function)) codes.push_back(function.code);
    return codes;
  }
  ir::ValueId isOneOf(ir::ValueId function, const std::vector<uint16_t>& codes);

  ir::SlotId ticket() { return f_.slot("ticket", ir::Type::I32); }
  ir::SlotId length() { return f_.slot("length", ir::Type::I16); }
  // One lock for all low-speed functions of the program. The instruction that holds it has a state other than idle:
  // when a program is replaced, the key shows that a removed instruction held the lock (rtlib/change/state_transfer.h).
  static constexpr const char* kLock = "@window/lock";
  ir::SlotId lock() { return f_.shared(kLock, ir::Type::Bit); }
  ir::SlotId state() { return f_.slot(std::string("state") + kLock, ir::Type::I8); }

  ir::ValueId endOf(ir::ValueId ticket);
  void setState(uint8_t state) { b_.slotStore(state_, b_.constant(ir::Type::I8, state)); }
  void release();

  Step nothing(ir::ValueId out);
  Step fork(ir::ValueId condition, Step (WindowLowering::*yes)(), Step (WindowLowering::*no)());
  Step underWay();
  Step whenDone();
  Step whenPending();
  Step awaited();
  Step unwanted();
  Step begin();
  Step start();
  Step immediate();
  Step lowSpeed();
  void ask();
  Step rest();

  const bool writes_;
  const std::span<const nc::pmc::WindowFunction> functions_;
  ir::SlotId state_;
  ir::ValueId oldState_, function_, length_, refusal_;
};

} // namespace rung::frontend::network
