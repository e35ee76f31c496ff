// The simulated NCT control of a PLC program (`config nc simulated`): it owns the topics, passes each request of MR and
// MW to the topic that serves it, between two scans, and answers MACR, MACW, SCP and MOVCMND within the cycle. A new
// topic is a member here and an entry of topics_, in the order in which they work.
#pragma once
#include <array>
#include <vector>

#include "rtlib/nc/nct/services.h"
#include "sim/nct/axes.h"
#include "sim/nct/channels.h"
#include "sim/nct/drives.h"
#include "sim/nct/machine_on.h"
#include "sim/nct/network.h"
#include "sim/nct/pallets.h"
#include "sim/nct/parameters.h"
#include "sim/nct/scope.h"
#include "sim/nct/screen.h"
#include "sim/nct/spindles.h"
#include "sim/nct/tool_management.h"

namespace rung::sim::nct {

class Simulator {
public:
  Simulator();

  // Nothing: no topic has the key.
  Handled config(std::string_view key, std::string_view value);
  std::vector<std::string_view> events() const;
  Handled event(std::string_view name, const std::vector<NcArgument>& keys);
  std::optional<double> quantity(std::string_view name) const;
  Handled setQuantity(std::string_view name, double value);

  // The program's memory has been initialized; `signals` are those of the control.
  void powerOn(runtime::Instance& instance, const SignalMemory& signals, nc::PowerOn kind);
  // Another program has taken over: requests in progress are answered to it.
  void programChanged(runtime::Instance& instance, const SignalMemory& signals);
  // Called before every time slice; `cycle`: it is the first one of a PLC cycle.
  void timeSlice(runtime::Instance& instance, bool cycle);
  // MACR, MACW, SCP, MOVCMND; returns false for other services.
  bool respond(const core::ServiceRequest& request, core::ServiceReply& reply);
  // Takes the requests of MR and MW and answers those that can be answered, oldest first; a request in progress does
  // not delay the others.
  void betweenScans(runtime::Instance& instance);
  void setRealTime() { links_.realTime = true; }

  void retain(Retained& retained);

  // Signals and the program's memory have been loaded.
  template <class Archive>
  void state(Archive& archive) {
    archive(links_, parameters_, nvram_, wiring_, spindles_, axes_, macros_, screen_, drives_, network_, mailbox_,
            channels_, tools_, pallets_, sliceUs_);
    archive.atMost(waitingCount_, waiting_.size());
    for (uint32_t i = 0; i < waitingCount_; ++i) archive(waiting_[i].request, waiting_[i].sinceUs);
  }
  // After loading: requests in progress are those of this program.
  void nameRequests(const core::ServiceQueue& services) {
    for (uint32_t i = 0; i < waitingCount_; ++i) services.setName(waiting_[i].request);
  }
  // Sets the tables to those of a control as delivered, with the configuration applied.
  void deliver();

private:
  void attach(runtime::Instance& instance, const SignalMemory& signals);
  // The execution code of a request; nothing: still in progress.
  std::optional<int32_t> execute(const core::ServiceRequest& request);
  // Services that are answered in the same cycle. Later: not now.
  enum class Outcome : uint8_t { Done, Refused, Later };
  Outcome answer(nc::nct::ServiceKind kind, const int64_t* args, core::ServiceReply& reply);

  Links makeLinks();

  Links links_ = makeLinks(); // precedes all topics, which use it in their constructors
  Parameters parameters_{links_};
  Nvram nvram_{links_};
  MachineOn machineOn_{links_};
  Wiring wiring_{links_};
  Spindles spindles_{links_};
  Axes axes_{links_};
  Macros macros_{links_};
  Screen screen_{links_};
  Drives drives_{links_};
  Scope scope_{links_};
  Network network_{links_};
  Mailbox mailbox_{links_};
  Channels channels_{links_};
  ProgramSelection programSelection_{links_};
  ToolManagement tools_{links_};
  PalletManagement pallets_{links_};
  std::vector<Topic*> topics_; // in the order in which they work

  const rung_program* program_ = nullptr; // the program that is switched on; null: none yet
  std::span<uint8_t> blocks_;             // the space @MB
  struct Waiting {
    core::ServiceRequest request;
    int64_t sinceUs = 0;
  };
  std::vector<Waiting> waiting_; // oldest first; room for all pending requests
  uint32_t waitingCount_ = 0;
  int64_t sliceUs_ = 0;                                 // the clock at the last time slice
  std::array<uint32_t, nc::nct::kBlockStride> words_{}; // the block of the request in progress
};

} // namespace rung::sim::nct
