// One topic of the simulated NCT control: a table, a device, the axes … Each is a class of its own that the Simulator
// (simulator.h) holds; a topic reaches the signals, the PLC memory and the other topics through Links.
//
// Order of things: config before the first power-on; powerOn; then `timeSlice` before every time slice of the PLC,
// `cycle` before the first one of a PLC cycle. Between two scans the requests of MR and MW are answered by
// `service`. What runs in the scan (timeSlice, cycle, service) allocates nothing and never blocks.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/nc/control/nct/signal_memory.h"
#include "rtlib/nc/nct/operand_block.h"
#include "sim/keys.h"
#include "sim/nct/kept.h"
#include "sim/simulated_nc.h"

namespace rung::sim::nct {

// The runtime's view of a program's memory, which every topic speaks of.
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

// What topics share. The pointers hold from the making of the Simulator on.
struct Links {
  SignalMemory signals;
  PlcMemory memory;
  int64_t nowUs = 0;
  int64_t sliceUs = 0;      // since the last time slice
  int64_t requestAgeUs = 0; // in `service`: time since the NC took the request
  bool realTime = false;    // the program runs on the machine's clock: waiting is not allowed even between scans
  Parameters* parameters = nullptr;
  Channels* channels = nullptr;
  Axes* axes = nullptr;
  Spindles* spindles = nullptr;
  Macros* macros = nullptr;
  Drives* drives = nullptr;
  ToolManagement* tools = nullptr;
  PalletManagement* pallets = nullptr;
};

inline constexpr double kNear = 1e-9; // units or turns: a way of less is none

// "" done, a text: what is wrong, nothing: not this topic's.
using Handled = std::optional<std::string>;

class Topic {
public:
  explicit Topic(Links& links) : links_(links) {}
  virtual ~Topic() = default;
  Topic(const Topic&) = delete;
  Topic& operator=(const Topic&) = delete;

  // The functions of MR (write = false) and MW that `service` answers.
  virtual bool serves(bool write, uint32_t function) const { return (void)write, (void)function, false; }
  // The execution code (man. 6.29); nothing: still at work, asked again between the next two scans. `block` holds the
  // operand words of the request; what is set in it goes to the program's block. The amount has not been checked.
  virtual std::optional<int32_t> service(uint32_t function, Block& block) { return (void)function, (void)block, 1; }
  // Asked no more for a request that `service` has answered with nothing: the program was restarted.
  virtual void dropRequests() {}

  // The value is right by the row of the key (rtlib/nc/config_key.h).
  virtual Handled config(std::string_view key, std::string_view value) { return (void)key, (void)value, std::nullopt; }
  virtual std::span<const std::string_view> events() const { return {}; }
  // One of them.
  virtual Handled event(std::string_view name, const std::vector<NcArgument>& keys) {
    return (void)name, (void)keys, std::nullopt;
  }
  virtual std::optional<double> quantity(std::string_view name) const { return (void)name, std::nullopt; }
  virtual Handled setQuantity(std::string_view name, double value) { return (void)name, (void)value, std::nullopt; }

  // Cold: as delivered, with the configuration. Warm: power off and on; what `keep` names stays. Links::signals and
  // Links::memory are ready; outputs of the program are 0.
  virtual void powerOn(nc::PowerOn kind) { (void)kind; }
  virtual void cycle() {}
  virtual void timeSlice() {}
  // The non-volatile fields, always the same and in the same order once the configuration is done.
  virtual void keep(Kept& kept) { (void)kept; }

protected:
  Links& links() const { return links_; }

private:
  Links& links_;
};

} // namespace rung::sim::nct
