// A connection as it is executed: its source, its destination, and the conversion of the value. Made before the program
// runs; copying allocates nothing and looks nothing up.
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

// The source or destination of a connection: a bit, a number or a text.
struct Pin {
  enum class Kind : uint8_t {
    Memory,  // the number or bit at `located`, which is `place`
    Text,    // at `place`
    Cell,    // of a module
    CellBit, // a bit of a module's cell
  };
  Kind kind = Kind::Memory;
  nc::ExchangeType type = nc::ExchangeType::Bit;
  uint8_t bit = 0;   // bit of the cell
  uint32_t cell = 0; // number of the cell
  core::Place located;
  runtime::Ref place;
};
inline bool isOfModule(const Pin& pin) { return pin.kind == Pin::Kind::Cell || pin.kind == Pin::Kind::CellBit; }
inline bool isMemoryBit(const Pin& pin) { return pin.kind == Pin::Kind::Memory && pin.type == nc::ExchangeType::Bit; }
Pin pinAt(const rung_program& program, const runtime::Ref& place, nc::ExchangeType type);

// (min(max(x, least), most) + before) * scale + after, then limited to low … high.
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
  bool joins = false;    // ORed with the value that another wire has set there
  bool isShared = false; // other wires also set or join its destination
  bool isBit = false;    // from one bit of memory to another, the most frequent case
  uint8_t stageCount = 0;
  Stage stages[kStages];
  nc::ExchangePeriod period = nc::ExchangePeriod::Slow;
  uint64_t target = kNoTarget; // the element of a DEF_IN that is its destination
  bool whole = true;           // false: the destination is a bit of it

  static constexpr uint64_t kNoTarget = UINT64_MAX;
  static uint64_t targetOf(uint32_t space, uint32_t byte) { return uint64_t{space} << 32 | byte; }
};

class WireMemory {
public:
  WireMemory(runtime::Instance& instance, ModuleCells& cells) : memory_(instance.memory()), cells_(&cells) {}
  void copy(const Wire& wire) const;
  // The value to be copied, in the type of the destination; not for texts.
  uint64_t valueOf(const Wire& wire) const;

private:
  uint64_t read(const Pin& pin) const;
  void write(const Pin& pin, uint64_t bits) const;
  void copyText(const Wire& wire) const;

  core::Memory memory_;
  ModuleCells* cells_;
};

// The variables of a running program that its control knows by name: mapped and logical inputs and outputs, and those
// shared by SHARE_VAR and SHARE_BIT (man. ch. 10, 18.2, 27). The program declares them while it starts.

struct SharedVariable {
  std::string name; // as in the program
  nc::ExchangeKind kind = nc::ExchangeKind::Variable;
  nc::ExchangeType type = nc::ExchangeType::Uns8;
  nc::ExchangePeriod period = nc::ExchangePeriod::Slow;
  uint32_t count = 1; // number of elements, or bytes of a text
  uint32_t space = 0, byte = 0, bit = 0;
  std::optional<runtime::Ref> least, most; // of SHARE_VAR: reals

  // Whether the program reads the variable from the control; a screen may write it.
  bool isInput() const {
    return kind == nc::ExchangeKind::MapIn || kind == nc::ExchangeKind::MapAin || kind == nc::ExchangeKind::DefIn;
  }
  bool isMapped() const { return nc::isMapped(kind); }
  bool isLogical() const { return kind == nc::ExchangeKind::DefIn || kind == nc::ExchangeKind::DefOut; }
  bool isText() const { return nc::isText(type); }

  template <class Archive>
  void state(Archive& archive) {
    archive(name, count, space, byte, bit);
    archiveLimit(archive, least);
    archiveLimit(archive, most);
    archive.atMost(kind, static_cast<uint64_t>(nc::ExchangeKind::Bit));
    archive.atMost(type, static_cast<uint64_t>(nc::ExchangeType::Binary));
    archive.atMost(period, static_cast<uint64_t>(nc::ExchangePeriod::OnDemand));
  }

private:
  template <class Archive>
  static void archiveLimit(Archive& archive, std::optional<runtime::Ref>& limit) {
    std::optional<std::pair<uint32_t, uint32_t>> place; // of a real
    if (limit) place.emplace(limit->space, limit->byte);
    archive(place);
    if constexpr (Archive::kLoads)
      limit = place ? std::optional(runtime::realRef(place->first, place->second)) : std::nullopt;
  }
};

// The place of an element.
runtime::Ref placeOf(const SharedVariable& variable, uint32_t element);

class SharedVariables {
public:
  SharedVariables() { all_.reserve(kUsual); }
  void clear();
  // Returns false if the name already has another meaning, or the place is not in the program's memory. `isNew`:
  // something has changed.
  bool define(const rung_program& program, SharedVariable variable, bool& isNew);

  // After loading. False: the program cannot have such variables; then there are none.
  bool settle(const rung_program& program);
  template <class Archive>
  void state(Archive& archive) {
    archive(all_);
  }

  // Moves the variables to another program; those that it does not have are dropped.
  void relocate(const runtime::Relocation& relocation);

  const std::vector<SharedVariable>& all() const { return all_; }
  // Finds a DEF_IN or DEF_OUT by its canonical identifier.
  const SharedVariable* logical(nc::ExchangeKind kind, std::string_view identifier) const;
  // Finds a variable of any kind by the name that a screen uses: `PLC.Input.` or `PLC.Output.` and the identifier, or
  // the identifier alone, with an optional element index and `.Bit[k]`.
  std::optional<runtime::Ref> find(std::string_view name, bool toWrite) const;
  // Finds the MAP_* or DEF_* variable at this place, and the element.
  const SharedVariable* at(const runtime::Ref& place, uint32_t& element) const;

private:
  static constexpr size_t kUsual = 1024; // a larger number allocates in `define`
  const SharedVariable* byName(std::string_view name, bool toWrite) const;

  std::vector<SharedVariable> all_;
  // By kind (see connections.cpp) and canonical identifier.
  std::unordered_map<std::string, uint32_t> byKey_;
};

// The variable that a request of kind Define declares.
std::optional<SharedVariable> variableOf(const core::ServiceRequest& request);

// The connections of logical inputs and outputs, and the configuration of mapped ones (man. ch. 10, 27): a table of
// wires, made when the program has declared its variables.

class Connections {
public:
  // ---- before the program runs
  // `connect SOURCE DESTINATION` of a scenario.
  void connect(std::string_view source, std::string_view destination);
  // `config ID.Invert 1` and similar keys; others are ignored.
  void configure(std::string_view key, std::string_view value);
  void take(std::span<const host::ConnectionDefinition> connections,
            std::span<const host::TerminalDefinition> terminals);

  // Whether there is any configuration: without it nothing is ever connected, whatever the program declares.
  bool configured() const { return !connections_.empty() || !attributes_.empty(); }

  // ---- at a start
  // Sets ANALOG_CONNECTED, which the program may read while it starts.
  void preset(runtime::Instance& instance) const;
  // A configured default value, in the type of the variable.
  std::optional<uint64_t> defaultOf(const SharedVariable& variable) const;
  // Makes the table of wires, and sets ANALOG_CONNECTED for those that are analogue.
  void build(runtime::Instance& instance, const SharedVariables& variables, ModuleCells& cells);
  // The same without writing to the program's memory.
  void rebuild(runtime::Instance& instance, const SharedVariables& variables, ModuleCells& cells);
  const std::vector<NcProblem>& problems() const { return problems_; }

  // ---- while it runs; nothing allocates
  // Copies all connections with periods up to `slowest`.
  void copy(runtime::Instance& instance, ModuleCells& cells, nc::ExchangePeriod slowest) const;
  // While the program is stopped: copies between modules, except to destinations that several connections set.
  void copyBetweenModules(runtime::Instance& instance, ModuleCells& cells) const;
  // Answers a request of kind UpdateInput.
  void update(runtime::Instance& instance, ModuleCells& cells, const core::ServiceRequest& request,
              core::ServiceReply& reply) const;

private:
  struct Attributes {
    std::optional<double> invert, scale, offset, least, most, otherwise, connected, port, bit, physical;
    std::string wrong;     // an attribute with a value that is not a number
    host::FilePlace place; // position in its file, "" without a file
  };
  struct Connection {
    std::string source, destination; // as written
    bool invert = false;
    double scale = 1, offset = 0;
    uint32_t number = RUNG_NONE; // number of the call of connect
    host::FilePlace place;
  };
  struct End {
    Pin pin;
    nc::ExchangePeriod period = nc::ExchangePeriod::Fast;
    bool isSource = false, isDestination = false;
    const SharedVariable* variable = nullptr;
    bool isOpen = false;     // a module's cell whose type is that of the other end
    bool signIsOpen = false; // a module's cell whose sign is that of the other end
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
  std::vector<std::pair<host::TerminalKind, uint32_t>> channels_; // analogue ones connected in a file

  std::vector<Wire> wires_; // sorted by period, the fastest first; those on demand last
  size_t ends_[4] = {};     // end of each period in wires_
  struct Target {
    uint64_t place; // Wire::target
    uint32_t wire;
    auto operator<=>(const Target&) const = default;
  };
  std::vector<Target> targets_; // sorted
  std::vector<NcProblem> problems_;
};

} // namespace rung::sim::technol
