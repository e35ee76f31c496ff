// The retained memory of a program on disk, as its control wants it: what every host does that is given a file for it.
#pragma once
#include <optional>
#include <string>

#include "rtlib/nc/control/control.h"
#include "rtlib/retain/retained_memory.h"

namespace rung::nc {

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
  void programChanged(std::unique_ptr<runtime::RetainLane>& lane) noexcept { memory_.programChanged(lane); }
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
