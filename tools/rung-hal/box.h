// A PLC program between HAL pins: all that the component does, without RTAPI. Everything is allocated when the box is
// made; `step` allocates nothing, takes no lock and makes no system call.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rtlib/core/place_list.h"
#include "rtlib/host/instance.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/retention.h"
#include "tools/rung-hal/binding.h"
#include "tools/rung-hal/function_queue.h"
#include "tools/rung-hal/map_file.h"
#include "tools/rung-hal/pin_cell.h"

namespace rung::hal {

enum class StepResult : uint8_t {
  Waiting, // no part of the schedule was due, or the program has stopped
  Ran,
  Failed, // a fault has stopped the program in this step
};

// Takes a message of the program in the scan.
using MessageSink = void (*)(const nc::Control& control, const rung_program& program, const rung_message& message);

class Box {
public:
  // Null, and `errors` say why, when the map does not fit the program, which outlives the box. The start is cold, or
  // with the memory that `retain` (FILE of FILE.a and FILE.b) keeps. `warnings`: what the operator should know of the
  // retained memory, and of parts of the program that never run here.
  static std::unique_ptr<Box> make(const rung_program& program, MapFile map, std::vector<std::string>& errors,
                                   const std::string& retain, std::vector<std::string>& warnings);
  // After the last step: what is retained is on disk then; "" or why not.
  std::string close();

  const std::vector<MapPin>& pins() const { return map_.pins; }
  // As many cells as there are pins, in their order; they outlive the box.
  void connect(const PinCell* cells) { cells_ = cells; }
  void setMessageSink(MessageSink sink) { sink_ = sink; }

  // The clock of the thread advances by `ns`: what is due of the program's schedule runs on fresh inputs. A step that
  // runs nothing only watches for edges. After a fault all output pins are 0 for good.
  StepResult step(int64_t ns) noexcept;

  const rung_program& program() const { return instance_.program(); }
  const rung_fault& fault() const { return instance_.fault(); }
  uint32_t scans() const { return scans_; } // passes of the schedule
  const FunctionQueue& functions() const { return *functions_; }
  // Of the retained memory; null: nothing is kept.
  const host::RetainedMemory* retained() const { return retained_ ? &retained_->memory() : nullptr; }

private:
  Box(const rung_program& program, MapFile map);

  bool start(const std::string& retain, std::vector<std::string>& errors, std::vector<std::string>& warnings);
  void slice() noexcept;
  void locatePlaces();
  void readPins() noexcept;
  void writePins() noexcept;
  void clearPins() noexcept;
  void passMessages() noexcept;

  MapFile map_;
  std::unique_ptr<nc::Control> control_;
  host::Instance instance_;
  Binding binding_;
  std::vector<rt::ListedPlace> inputs_, outputs_; // of binding_; its constants follow the inputs
  std::vector<uint64_t> inputValues_, outputValues_;
  std::unique_ptr<FunctionQueue> functions_; // once the map is bound
  std::unique_ptr<nc::Retention> retained_;  // null: nothing is kept
  const PinCell* cells_ = nullptr;
  MessageSink sink_ = nullptr;
  int64_t owedNs_ = 0; // time that the program's clock lags
  uint32_t scans_ = 0;
  bool failed_ = false;
};

} // namespace rung::hal
