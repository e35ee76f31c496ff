// Lowering of a program to a module: spaces for the areas, a routine for each unit on each level, a task for each
// level, and the scan as slots (P3). The dialect adds the rest of its control.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "frontend/lower/module_items.h"
#include "frontend/network/lower/lower_function.h"
#include "frontend/network/read/context.h"
#include "ir/core/marks.h"

namespace rung::frontend::network {

// How the control runs programs of the language.
struct Execution {
  uint32_t slotUs = 0;           // from one run of the levels to the next
  uint32_t budget = 0;           // steps of one run (P6)
  std::string_view overrunFault; // fault of a run that takes more
  Address results;               // the first result register: each level has a separate set (P4)
  uint32_t resultBytes = 0;      // their number
  // Bits that never change and that the program does not write, such as one that is always 1.
  std::vector<std::pair<Address, bool>> constants = {};
  // Adds what the control does before the first level in each slot, and at the end of each cycle. May be
  // empty.
  std::function<void(Lowering& f)> eachSlot = {}, eachCycle = {};

  std::optional<bool> constantAt(const Address& bit) const;
};

// Units that several levels run are lowered for each level and share their slots.
struct LevelState {
  uint32_t level = 0;                  // index in the language, and of its unit in the program
  std::vector<ir::SpaceId> spaces;     // by area; for inputs the latch, if there is one
  std::vector<std::vector<bool>> used; // by area: whether each byte is read or written
  std::vector<ir::RoutineId> routines; // by unit; invalid if the level does not run it
  bool hasClock = false;
  ir::SlotId clock;      // time at the beginning of the last run
  ir::SlotId scanTime;   // from there to the beginning of this run
  bool straight = false; // every run executes all networks of the level itself, in their order: none jumps
  bool countsRuns = false;
  ir::SlotId runs; // number of the run

  ir::SpaceId spaceOf(const Address& address) const { return spaces[static_cast<size_t>(address.area)]; }
  ir::Place placeOf(const Address& address) const {
    return {spaceOf(address), address.byte, address.isBit ? address.bit : 0u};
  }
  void use(const Address& address, uint32_t bytes);
  ir::RoutineId entry() const { return routines[level]; }
};

// A unit on one level.
struct RoutineContext {
  LevelState* level = nullptr;
  uint32_t unit = 0;
  std::vector<uint32_t> rungOf; // by network
};

// Adds the contacts and coils of one rung to the marks, if they are requested.
class RungMarks {
public:
  RungMarks(ir::Marks* marks, const SourceManager& sources, ir::RoutineId routine, uint32_t rung)
      : marks_(marks), sources_(sources), routine_(routine), rung_(rung) {}
  // A contact or coil: its text is that of its range.
  void element(ir::MarkKind kind, ir::ValueId value, SourceRange range) const;
  // A function; `more` is appended to its text.
  void function(ir::MarkKind kind, ir::ValueId value, const Function& function, std::string_view more = {}) const;

private:
  void add(ir::MarkKind kind, ir::ValueId value, SourceRange range, std::string text) const;

  ir::Marks* marks_;
  const SourceManager& sources_;
  ir::RoutineId routine_;
  uint32_t rung_;
};

class ModuleLowering {
public:
  // Afterwards the spaces and symbols exist. `marks`: null, or receives contacts and coils. `compared`: with another
  // version of the program; then nothing is simplified because of other rungs.
  ModuleLowering(const Program& program, Context& context, std::span<const FileId> files, const Execution& execution,
                 ir::Marks* marks, bool compared);
  // Called in this order: the networks; tasks and scan, with the main program in `parts` parts; the module.
  void lowerUnits();
  void addTasks(uint32_t parts);
  std::unique_ptr<ir::Module> take() { return std::move(module_); }

  ir::Module& module() { return *module_; }
  ir::SpaceId spaceOf(Area area) const { return spaces_[static_cast<size_t>(area)]; }
  std::span<const LevelState> levels() const { return levels_; }
  const Language& language() const { return language_; }
  const Execution& execution() const { return execution_; }
  // The network from which a rung of a unit was made.
  const Network* networkOf(uint32_t unit, const ir::Rung& rung) const;

  // For Lowering.
  ir::SlotId slot(const std::string& key, ir::Type type, int64_t init, bool transient);
  ir::SpaceId constantSpace(std::string_view bytes) { return constants_.spaceOf(bytes); }
  // One for each name, made on first use.
  ir::SpaceId hiddenSpace(const std::string& name, uint32_t bytes);
  ir::ServiceId service(const nc::ServiceRow& row) { return frontend::service(*module_, row); }
  ir::SlotId leaveTarget() { return slot("@leave", ir::Type::I32, 0, false); }

private:
  void addSpaces();
  void addSymbols();
  // A level that a program need not have, and does not.
  bool isAbsent(uint32_t level) const;
  // The one that ends a cycle of the main program.
  uint32_t lastLevel() const;
  void planRoutines(LevelState& level);
  std::string routineName(const LevelState& level, const Unit& unit) const;
  void makeKeys();
  void makeNumbers();
  void lowerRoutine(LevelState& level, uint32_t unit);
  void planClock(LevelState& level);
  void addClock(ir::Routine& routine, RoutineContext& context, const Unit& unit);
  void byControl(const std::function<void(Lowering&)>& add, RoutineContext& routine, ir::RungBuilder& b,
                 const Network& network);
  void lowerNetwork(RoutineContext& routine, ir::Rung& rung, uint32_t network);
  struct Key {
    uint64_t key = 0;
    uint32_t copy = 0;
  };
  void describe(ir::Rung& rung, const Network& network, Key key) const;
  std::vector<ir::ValueId> lowerLogic(LevelState& level, ir::RungBuilder& b, const Network& network,
                                      const RungMarks& marks);
  ir::ValueId lowerFunction(RoutineContext& routine, ir::RungBuilder& b, uint32_t network,
                            std::span<const ir::ValueId> conditions, const RungMarks& marks);
  void lowerCoils(RoutineContext& routine, ir::RungBuilder& b, const Network& network, ir::ValueId value,
                  const RungMarks& marks);
  void addLeave(RoutineContext& routine, ir::Rung& rung, uint32_t next);
  bool mayLeaveAfter(const Network& network) const;
  void addTask(const LevelState& level, uint32_t parts);
  void addScan(uint32_t parts);
  void addLatch(const LevelState& level, size_t area);
  void addResultRegisters(const LevelState& level);
  std::string resultSpace(uint32_t level) const;

  const Program& program_;
  Context& context_;
  const Language& language_;
  const Execution execution_;
  ir::Marks* marks_;
  const bool compared_;
  std::unique_ptr<ir::Module> module_;
  frontend::ConstantBytes constants_;
  std::unordered_map<uint32_t, ir::FileIndex> fileIndex_;
  std::unordered_map<std::string, ir::SlotId> slots_;
  std::vector<ir::SpaceId> spaces_; // of the areas
  std::unordered_map<std::string, ir::SpaceId> hidden_;
  std::vector<std::vector<Key>> keys_;                         // by unit and network
  std::vector<std::vector<std::string>> slotPrefixes_;         // by unit and network, for networks with a function
  std::unordered_map<const LogicStep*, std::string> edgeKeys_; // of contacts for edges
  std::unordered_map<const Network*, uint32_t> numbers_;       // as drawn; the ends of units have none
  std::vector<LevelState> levels_;
};

} // namespace rung::frontend::network
