// The connections of logical inputs and outputs, and the configuration of mapped ones (man. ch. 10, 27): a table of
// wires, made when the program has declared what it has.
#pragma once
#include <compare>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/control_files.h"
#include "sim/technol/module_cells.h"
#include "sim/technol/shared_variables.h"
#include "sim/technol/wire.h"

namespace rung::sim::technol {

class Connections {
public:
  // ---- before the program runs
  // `connect SOURCE DESTINATION` of a scenario.
  void connect(std::string_view source, std::string_view destination);
  // `config ID.Invert 1` and its like; other keys are left alone.
  void configure(std::string_view key, std::string_view value);
  void take(std::span<const host::ConnectionDefinition> connections,
            std::span<const host::TerminalDefinition> terminals);

  // Something is: without it nothing is ever connected, whatever the program declares.
  bool configured() const { return !connections_.empty() || !attributes_.empty(); }

  // ---- at a start
  // What the program may see while it starts: ANALOG_CONNECTED.
  void preset(runtime::Instance& instance) const;
  // A default value of the configuration, in the bits of the variable's type.
  std::optional<uint64_t> defaultOf(const SharedVariable& variable) const;
  // Makes the table.
  void build(runtime::Instance& instance, const SharedVariables& variables, ModuleCells& cells);
  const std::vector<NcProblem>& problems() const { return problems_; }

  // ---- while it runs; nothing allocates
  // All that are not slower than `slowest`.
  void copy(runtime::Instance& instance, ModuleCells& cells, nc::ExchangePeriod slowest) const;
  // While the program is stopped: what passes from module to module, without ends that several connections set.
  void copyBetweenModules(runtime::Instance& instance, ModuleCells& cells) const;
  // What kUpdateService answers.
  void update(runtime::Instance& instance, ModuleCells& cells, const core::ServiceRequest& request,
              core::ServiceReply& reply) const;

private:
  struct Attributes {
    std::optional<double> invert, scale, offset, least, most, otherwise, connected, port, bit, physical;
    std::string wrong;     // an attribute that is not a number
    host::FilePlace place; // where it was read, "" without a file
  };
  struct Connection {
    std::string source, destination; // as written
    bool invert = false;
    double scale = 1, offset = 0;
    uint32_t number = RUNG_NONE; // of the calls of connect
    host::FilePlace place;
  };
  struct End {
    Pin pin;
    nc::ExchangePeriod period = nc::ExchangePeriod::Fast;
    bool isSource = false, isDestination = false;
    const SharedVariable* variable = nullptr;
    bool isOpen = false;     // a module's cell whose type the other end gives
    bool signIsOpen = false; // or whose sign
    uint64_t target = Wire::kNoTarget;
    bool whole = true;
  };
  class Resolver;

  const Attributes* attributesOf(const SharedVariable& variable) const;
  const Attributes* attributesOf(std::string_view canonicalName) const;
  void openCells(Resolver& resolver, ModuleCells& cells) const;
  void addTerminals(Resolver& resolver, const SharedVariables& variables);
  void add(Resolver& resolver, const Connection& connection);
  void addWire(const Connection& connection, const End& from, const End& to);
  void shape(Wire& wire, const Connection& connection, const End& from, const End& to) const;
  void report(const Connection& connection, std::string text);
  void order();
  static void markAnalogue(runtime::Instance& instance, const Wire& wire);

  std::map<std::string, Attributes, std::less<>> attributes_; // by canonical identifier
  std::vector<Connection> connections_;
  uint32_t connects_ = 0;
  std::vector<std::pair<host::TerminalKind, uint32_t>> channels_; // analogue ones that a file connects

  std::vector<Wire> wires_; // by period, the fastest first; those on demand last
  size_t ends_[4] = {};     // of each period
  struct Target {
    uint64_t place; // Wire::target
    uint32_t wire;
    auto operator<=>(const Target&) const = default;
  };
  std::vector<Target> targets_; // sorted
  std::vector<NcProblem> problems_;
};

} // namespace rung::sim::technol
