// One topic of the simulated NCT control: a table, a device, the axes … Each is a class that the Simulator
// (simulator.h) owns; a topic accesses the signals, the PLC memory and the other topics through Links.
//
// Order of calls: config before the first power-on; powerOn; then `timeSlice` before every time slice of the PLC,
// `cycle` before the first one of a PLC cycle. Between two scans `service` answers the requests of MR and MW. Functions
// in the scan (timeSlice, cycle, service) allocate nothing and never block.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/nc/control/nct/signal_memory.h"
#include "rtlib/nc/nct/operand_block.h"
#include "sim/keys.h"
#include "sim/nct/retained.h"
#include "sim/simulated_nc.h"

namespace rung::sim::nct {

// The runtime's types for a program's memory, used by every topic.
using nc::nct::BitSignal;
using nc::nct::Block;
using nc::nct::PlcMemory;
using nc::nct::RealSignal;
using nc::nct::SignalMemory;
using nc::nct::WordSignal;

class Axes;
class Channels;
class Drives;
class Macros;
class PalletManagement;
class Parameters;
class Spindles;
class ToolManagement;

// Shared by the topics. The pointers are valid once the Simulator is constructed.
struct Links {
  SignalMemory signals;
  PlcMemory memory;
  int64_t nowUs = 0;
  int64_t sliceUs = 0;      // since the last time slice
  int64_t requestAgeUs = 0; // in `service`: time since the NC took the request
  bool realTime = false;    // the program runs on the machine's clock: waiting is not permitted even between scans
  Parameters* parameters = nullptr;
  Channels* channels = nullptr;
  Axes* axes = nullptr;
  Spindles* spindles = nullptr;
  Macros* macros = nullptr;
  Drives* drives = nullptr;
  ToolManagement* tools = nullptr;
  PalletManagement* pallets = nullptr;

  template <class Archive>
  void state(Archive& archive) {
    archive(nowUs, sliceUs, requestAgeUs);
  }
};

inline constexpr double kNear = 1e-9; // units or turns: smaller distances count as none

// "": done; a text: the error; nothing: not for this topic.
using Handled = std::optional<std::string>;

class Topic {
public:
  explicit Topic(Links& links) : links_(links) {}
  virtual ~Topic() = default;
  Topic(const Topic&) = delete;
  Topic& operator=(const Topic&) = delete;

  // The functions of MR (write = false) and MW that `service` answers.
  virtual bool serves(bool write, uint32_t function) const { return (void)write, (void)function, false; }
  // Returns the execution code (man. 6.29); nothing: still in progress, called again between the next two scans.
  // `block` has the operand words of the request; words set in it are written to the program's block. The amount has
  // not been checked.
  virtual std::optional<int32_t> service(uint32_t function, Block& block) { return (void)function, (void)block, 1; }
  // The program was restarted: `service` is not called again for requests in progress.
  virtual void dropRequests() {}

  // The value has been checked against the key's row (rtlib/nc/config_key.h).
  virtual Handled config(std::string_view key, std::string_view value) { return (void)key, (void)value, std::nullopt; }
  virtual std::span<const std::string_view> events() const { return {}; }
  // One of events().
  virtual Handled event(std::string_view name, const std::vector<NcArgument>& keys) {
    return (void)name, (void)keys, std::nullopt;
  }
  virtual std::optional<double> quantity(std::string_view name) const { return (void)name, std::nullopt; }
  virtual Handled setQuantity(std::string_view name, double value) { return (void)name, (void)value, std::nullopt; }

  // Cold: as delivered, with the configuration applied. Warm: power off and on; the fields in `keep` are retained.
  // Links::signals and Links::memory are ready; outputs of the program are 0.
  virtual void powerOn(nc::PowerOn kind) { (void)kind; }
  virtual void cycle() {}
  virtual void timeSlice() {}
  // Topics with fields that change name them in a `state` (rtlib/core/archive.h), which the Simulator knows.
  // Names the non-volatile fields, always the same and in the same order once the configuration is complete.
  virtual void retain(Retained& retained) { (void)retained; }

protected:
  Links& links() const { return links_; }

private:
  Links& links_;
};

} // namespace rung::sim::nct
