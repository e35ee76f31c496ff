// The ports of the input and output units: forced bits and shorted outputs (man. l.3498-3609). Inputs are forced
// before the program, outputs after it; what the machine or the program itself put there comes back before the next
// cycle. Without forcing and errors a cycle only looks at half a kilobyte.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/run/instance.h"
#include "sim/technol/connections.h"

namespace rung::sim::technol {

class Ports {
public:
  // P1IN to P128IN, P0OUT to P95OUT (man. l.3341); units INOUT08.
  static constexpr uint32_t kInputs = 128, kOutputs = 96, kUnits = 32;

  // `config CAN[1].INOUT08[i].CONTROL n`: the control byte of a unit, of which IO_DIS_ERPIS counts here. False: another
  // key. `problem` says what is wrong with the value.
  bool configure(std::string_view key, std::string_view value, std::string& problem);
  // At a power-on: nothing is forced.
  void reset(const runtime::Instance& instance);
  // Where the ports are in the program that runs now.
  void locate(const runtime::Instance& instance);

  void beforeProgram(runtime::Instance& instance);
  void afterProgram(runtime::Instance& instance);
  // The value that comes may be equal to a forced one, so the ports it goes to get their own back first.
  void beforeWrite(runtime::Instance& instance, const runtime::Ref& place);

private:
  struct Port {
    uint8_t own = 0;    // what the machine or the program put there
    uint8_t forced = 0; // what has been there since
    bool active = false;
  };
  struct Family { // of cells that are numbered
    uint32_t space = RUNG_NONE, first = 0, stride = 0;
    // The number of the cell at this byte.
    std::optional<uint32_t> find(uint32_t inSpace, uint32_t byte, uint32_t count) const;
  };
  struct Span {
    uint32_t offset, size;
  };
  static Family familyOf(const runtime::Instance& instance, const char* first, const char* second);
  static uint8_t read(const runtime::Instance& instance, const Family& family, uint32_t number);
  static void write(runtime::Instance& instance, const Family& family, uint32_t number, uint8_t value);
  static void restore(runtime::Instance& instance, const Family& family, uint32_t number, Port& port);
  static void force(runtime::Instance& instance, const Family& family, uint32_t number, Port& port, uint8_t high,
                    uint8_t low);
  void findSwitches(const runtime::Instance& instance);
  bool anySwitch(const runtime::Instance& instance) const;
  uint8_t shorted(runtime::Instance& instance, uint32_t output) const;

  Family inputs_, outputs_, lowIn_, highIn_, lowOut_, highOut_, shorts_;
  std::array<Port, kInputs> in_;
  std::array<Port, kOutputs> out_;
  std::array<uint8_t, kUnits> control_{};
  std::vector<Span> switches_; // of the block: forcing and errors
  bool active_ = false;
};

// Everything that the simulated control exchanges with a program beside its interface cells: shared variables,
// connections, module cells, ports (man. ch. 9, 10, 18, 27), in the order of a cycle.

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
  // Define and UpdateInput; false: another request.
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
