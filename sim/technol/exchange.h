// The ports of the input and output units: forced bits and shorted outputs (man. l.3498-3609). Inputs are forced before
// the program, outputs after it; values written by the machine or the program are restored before the next cycle.
// Without forcing and errors a cycle only compares half a kilobyte.
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
  // P1IN to P128IN, P0OUT to P95OUT (man. l.3341); INOUT08 units.
  static constexpr uint32_t kInputs = 128, kOutputs = 96, kUnits = 32;

  // `config CAN[1].INOUT08[i].CONTROL n`: sets the control byte of a unit; only IO_DIS_ERPIS is used here. Returns
  // false for other keys. `problem`: the error in the value.
  bool configure(std::string_view key, std::string_view value, std::string& problem);
  // At a power-on: nothing is forced.
  void reset(const runtime::Instance& instance);
  // Looks up the ports in the running program.
  void locate(const runtime::Instance& instance);

  void beforeProgram(runtime::Instance& instance);
  void afterProgram(runtime::Instance& instance);
  // Restores the own values of the ports, because a value about to be written may be equal to a forced one.
  void beforeWrite(runtime::Instance& instance, const runtime::Ref& place);

  template <class Archive>
  void state(Archive& archive) {
    archive(in_, out_, active_);
  }

private:
  struct Port {
    uint8_t own = 0;    // written by the machine or the program
    uint8_t forced = 0; // forced value, present since then
    bool active = false;
    template <class Archive>
    void state(Archive& archive) {
      archive(own, forced, active);
    }
  };
  struct Family { // numbered cells
    uint32_t space = RUNG_NONE, first = 0, stride = 0;
    // The number of the cell that contains this byte.
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
  std::vector<Span> switches_; // areas with the bits for forcing and errors
  bool active_ = false;
};

// Everything that the simulated control exchanges with a program besides its interface cells: shared variables,
// connections, module cells, ports (man. ch. 9, 10, 18, 27), in the order of a cycle.

class Exchange {
public:
  // To be called before the program runs; returns "", or the error.
  std::string configure(std::string_view key, std::string_view value);
  void connect(std::string_view source, std::string_view destination) { connections_.connect(source, destination); }
  // Adds the definitions in the control's files.
  void take(std::span<const host::ConnectionDefinition> connections,
            std::span<const host::TerminalDefinition> terminals) {
    connections_.take(connections, terminals);
  }

  // Memory has been initialized; the program's MODULE_INIT follows. `powerOn`: false if only the program starts.
  void beforeInit(runtime::Instance& instance, bool powerOn);
  void afterInit(runtime::Instance& instance);
  // Another program has taken over without running its MODULE_INIT: variables declared by the previous one are looked
  // up in it. Those that it does not have are dropped, with their connections; module cells and forced ports stay
  // unchanged.
  void programChanged(runtime::Instance& instance);
  // The hooks of the schedule that have work, one bit each; the configuration may change them.
  uint32_t works() const;
  void onHook(runtime::Instance& instance, uint32_t hook);
  // While the program is stopped: modules exchange values with each other.
  void idle(runtime::Instance& instance) { connections_.copyBetweenModules(instance, cells_); }
  void beforeWrite(runtime::Instance& instance, const runtime::Ref& place) { ports_.beforeWrite(instance, place); }
  // Answers Define and UpdateInput; returns false for other requests.
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply);

  const SharedVariables& shared() const { return shared_; }
  ModuleCells& cells() { return cells_; }
  const ModuleCells& cells() const { return cells_; }
  const std::vector<NcProblem>& problems() const { return connections_.problems(); }

  template <class Archive>
  void state(Archive& archive) {
    archive(shared_, cells_, ports_, defined_);
  }
  // After loading: makes the connections again. False: there cannot be such variables and cells.
  bool settle(runtime::Instance& instance);

private:
  void define(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply);

  const rung_program* program_ = nullptr; // the program of these places
  SharedVariables shared_;
  ModuleCells cells_;
  Connections connections_;
  Ports ports_;
  bool defined_ = false; // something was defined since the table of connections was made
};

} // namespace rung::sim::technol
