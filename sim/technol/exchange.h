// Everything that the simulated control exchanges with a program beside its interface cells: shared variables,
// connections, module cells, ports (man. ch. 9, 10, 18, 27), in the order of a cycle.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/technol/connections.h"
#include "sim/technol/ports.h"

namespace rung::sim::technol {

class Exchange {
public:
  // Before the program runs; "" or what is wrong.
  std::string configure(std::string_view key, std::string_view value);
  void connect(std::string_view source, std::string_view destination) { connections_.connect(source, destination); }
  // Of the control's files.
  void take(std::span<const host::ConnectionDefinition> connections,
            std::span<const host::TerminalDefinition> terminals) {
    connections_.take(connections, terminals);
  }

  // Memory has been started; the program's MODULE_INIT follows. `powerOn`: not a mere start of the program.
  void beforeInit(runtime::Instance& instance, bool powerOn);
  void afterInit(runtime::Instance& instance);
  // Another program has taken over, whose MODULE_INIT does not run: what the former one has declared is found again in
  // it. Variables that it does not have are dropped, with the connections that end there; module cells and forced ports
  // stay as they are.
  void programChanged(runtime::Instance& instance);
  // Hooks of the schedule, and those that have something to do, a bit each; configuring may change them.
  uint32_t works() const;
  void onHook(runtime::Instance& instance, uint32_t hook);
  // While the program is stopped: modules exchange with each other.
  void idle(runtime::Instance& instance) { connections_.copyBetweenModules(instance, cells_); }
  void beforeWrite(runtime::Instance& instance, const runtime::Ref& place) { ports_.beforeWrite(instance, place); }
  // The services kDefineService and kUpdateService; false: another one.
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply);

  const SharedVariables& shared() const { return shared_; }
  ModuleCells& cells() { return cells_; }
  const ModuleCells& cells() const { return cells_; }
  const std::vector<NcProblem>& problems() const { return connections_.problems(); }

private:
  void define(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply);

  const rung_program* program_ = nullptr; // whose places these are
  SharedVariables shared_;
  ModuleCells cells_;
  Connections connections_;
  Ports ports_;
  bool defined_ = false; // something that the table of connections does not know
};

} // namespace rung::sim::technol
