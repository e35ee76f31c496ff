// One connection as it is served: from where, to where, how the value changes on the way. Made before the program runs;
// copying allocates nothing and looks nothing up.
#pragma once
#include <compare>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "machine/host/control_files.h"
#include "rtlib/change/relocation.h"
#include "rtlib/nc/technol/exchange.h"
#include "rtlib/run/instance.h"
#include "sim/technol/module_cells.h"

namespace rung::sim::technol {

// A place that a connection begins or ends at: a bit, a number or a text.
struct Pin {
  enum class Kind : uint8_t {
    Memory,  // the number or bit at `located`, which is `place`
    Text,    // at `place`
    Cell,    // of a module
    CellBit, // a bit of a module's cell
  };
  Kind kind = Kind::Memory;
  nc::ExchangeType type = nc::ExchangeType::Bit;
  uint8_t bit = 0;   // of the cell
  uint32_t cell = 0; // its number
  core::Place located;
  runtime::Ref place;
};
inline bool isOfModule(const Pin& pin) { return pin.kind == Pin::Kind::Cell || pin.kind == Pin::Kind::CellBit; }
inline bool isMemoryBit(const Pin& pin) { return pin.kind == Pin::Kind::Memory && pin.type == nc::ExchangeType::Bit; }
Pin pinAt(const rung_program& program, const runtime::Ref& place, nc::ExchangeType type);

// (min(max(x, least), most) + before) * scale + after, then held between low and high.
struct Stage {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double least = -kInfinity, most = kInfinity;
  double before = 0, scale = 1, after = 0;
  double low = -kInfinity, high = kInfinity;
  bool operator==(const Stage&) const = default;
};

struct Wire {
  static constexpr size_t kStages = 3;
  Pin from, to;
  bool invert = false;
  bool joins = false;    // ORed to what another wire has put there
  bool isShared = false; // its end is one that others join or have set
  bool isBit = false;    // from a bit of the memory to another: most are
  uint8_t stageCount = 0;
  Stage stages[kStages];
  nc::ExchangePeriod period = nc::ExchangePeriod::Slow;
  uint64_t target = kNoTarget; // the element of a DEF_IN that it ends in
  bool whole = true;           // and not in a bit of it

  static constexpr uint64_t kNoTarget = UINT64_MAX;
  static uint64_t targetOf(uint32_t space, uint32_t byte) { return uint64_t{space} << 32 | byte; }
};

class WireMemory {
public:
  WireMemory(runtime::Instance& instance, ModuleCells& cells) : memory_(instance.memory()), cells_(&cells) {}
  void copy(const Wire& wire) const;
  // The value that would be copied, in the bits of the wire's end; not of texts.
  uint64_t valueOf(const Wire& wire) const;

private:
  uint64_t read(const Pin& pin) const;
  void write(const Pin& pin, uint64_t bits) const;
  void copyText(const Wire& wire) const;

  core::Memory memory_;
  ModuleCells* cells_;
};

// The variables of a running program that its control knows by names: mapped and logical inputs and outputs, and what
// SHARE_VAR and SHARE_BIT share (man. ch. 10, 18.2, 27). The program declares them while it starts.

struct SharedVariable {
  std::string name; // as the program writes it
  nc::ExchangeKind kind = nc::ExchangeKind::Variable;
  nc::ExchangeType type = nc::ExchangeType::Uns8;
  nc::ExchangePeriod period = nc::ExchangePeriod::Slow;
  uint32_t count = 1; // elements, or bytes of a text
  uint32_t space = 0, byte = 0, bit = 0;
  std::optional<runtime::Ref> least, most; // of SHARE_VAR: reals

  // What the program takes from the control; a screen may write it.
  bool isInput() const {
    return kind == nc::ExchangeKind::MapIn || kind == nc::ExchangeKind::MapAin || kind == nc::ExchangeKind::DefIn;
  }
  bool isMapped() const { return nc::isMapped(kind); }
  bool isLogical() const { return kind == nc::ExchangeKind::DefIn || kind == nc::ExchangeKind::DefOut; }
  bool isText() const { return nc::isText(type); }
};

// The place of an element.
runtime::Ref placeOf(const SharedVariable& variable, uint32_t element);

class SharedVariables {
public:
  SharedVariables() { all_.reserve(kUsual); }
  void clear();
  // False where the name has another meaning already, or the place is not in the program's memory. `isNew` says
  // whether something has changed.
  bool define(const rung_program& program, SharedVariable variable, bool& isNew);

  // In another program; those that it does not have are dropped.
  void relocate(const runtime::Relocation& relocation);

  const std::vector<SharedVariable>& all() const { return all_; }
  // By a canonical identifier of a DEF_IN or DEF_OUT.
  const SharedVariable* logical(nc::ExchangeKind kind, std::string_view identifier) const;
  // By the name that a screen uses: of any kind, with the index of an element and `.Bit[k]` after it, as `PLC.Input.`
  // or `PLC.Output.` identifier or the identifier alone.
  std::optional<runtime::Ref> find(std::string_view name, bool toWrite) const;
  // Of MAP_* and DEF_*: the variable that holds the place, and which of its elements.
  const SharedVariable* at(const runtime::Ref& place, uint32_t& element) const;

private:
  static constexpr size_t kUsual = 1024; // more than that allocate when they are defined
  const SharedVariable* byName(std::string_view name, bool toWrite) const;

  std::vector<SharedVariable> all_;
  // By kind (see cpp) and canonical identifier.
  std::unordered_map<std::string, uint32_t> byKey_;
};

// What Define declares.
std::optional<SharedVariable> variableOf(const core::ServiceRequest& request);

// The connections of logical inputs and outputs, and the configuration of mapped ones (man. ch. 10, 27): a table of
// wires, made when the program has declared what it has.

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
  // What UpdateInput answers.
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
