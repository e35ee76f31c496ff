// State of one lowering: the module under construction and what its parts share. Private to the lower_*.cpp files.
#pragma once
#include <array>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/lower/module_items.h"
#include "ir/core/parts.h"

namespace rung::gsk {

// Level 1 reads X and F as they are, Level 2 from its latch (P3). Units that several levels run are lowered for each
// and share their slots.
struct LevelState {
  uint32_t level = 0;                                // its place in the language, and of its unit in the program
  std::array<ir::SpaceId, kAreas.size()> spaces;     // of inputs the latch, where it has one
  std::array<std::vector<bool>, kAreas.size()> used; // bytes that are read or written, X F R only
  std::vector<ir::RoutineId> routines;               // by unit; invalid where the level does not run it
  bool hasClock = false;
  ir::SlotId clock;      // `now` at the beginning of the last run
  ir::SlotId scanTime;   // from that to the beginning of this run
  bool straight = false; // every run takes all networks of the level itself, in their order: none jumps
  bool countsRuns = false;
  ir::SlotId runs; // number of the run
};

// A unit on one level.
struct RoutineContext {
  LevelState* level = nullptr;
  uint32_t unit = 0;
  std::vector<uint32_t> rungOf; // by network
};

// The contacts and coils of one rung go to where they are asked for, if they are.
class RungMarks {
public:
  RungMarks(ir::Marks* marks, const SourceManager& sources, ir::RoutineId routine, uint32_t rung)
      : marks_(marks), sources_(sources), routine_(routine), rung_(rung) {}
  // A contact or coil: its text is what its range holds.
  void element(ir::MarkKind kind, ir::ValueId value, SourceRange range) const;
  // A function; `more` is part of its text.
  void function(ir::MarkKind kind, ir::ValueId value, const network::Function& function,
                std::string_view more = {}) const;

private:
  void add(ir::MarkKind kind, ir::ValueId value, SourceRange range, std::string text) const;

  ir::Marks* marks_;
  const SourceManager& sources_;
  ir::RoutineId routine_;
  uint32_t rung_;
};

class ModuleLowering {
public:
  ModuleLowering(const network::Program& program, network::Context& context, std::span<const FileId> files,
                 const frontend::CompileOptions& options);
  std::unique_ptr<ir::Module> run();

  // For Lowering.
  ir::SlotId slot(const std::string& key, ir::Type type, int64_t init, bool transient);
  ir::SpaceId constantSpace(std::string_view bytes) { return constants_.spaceOf(bytes); }
  // One for a name, however often it is asked for.
  ir::SpaceId hiddenSpace(const std::string& name, uint32_t bytes);
  ir::ServiceId service(std::string_view signature) { return frontend::service(*module_, signature); }
  std::span<const LevelState> levels() const { return levels_; }
  ir::SlotId leaveTarget() { return slot("@leave", ir::Type::I32, 0, false); }
  const network::Program& program() const { return program_; }
  void use(LevelState& level, const network::Address& address, uint32_t bytes);

private:
  void addSpaces();
  void addSymbols();
  void addPresets();
  void planRoutines(LevelState& level);
  std::string routineName(const LevelState& level, const network::Unit& unit) const;
  void makeKeys();
  void makeNumbers();
  void lowerRoutine(LevelState& level, uint32_t unit);
  void planClock(LevelState& level);
  void addClock(ir::Routine& routine, LevelState& level, const network::Unit& unit);
  void lowerNetwork(RoutineContext& routine, ir::Rung& rung, uint32_t network);
  struct Key {
    uint64_t key = 0;
    uint32_t copy = 0;
  };
  void describe(ir::Rung& rung, const network::Network& network, Key key) const;
  std::vector<ir::ValueId> lowerLogic(LevelState& level, ir::RungBuilder& b, const network::Network& network,
                                      const RungMarks& marks);
  ir::ValueId lowerFunction(RoutineContext& routine, ir::RungBuilder& b, uint32_t network,
                            std::span<const ir::ValueId> conditions, const RungMarks& marks);
  void lowerCoils(RoutineContext& routine, ir::RungBuilder& b, const network::Network& network, ir::ValueId value,
                  const RungMarks& marks);
  void addLeave(RoutineContext& routine, ir::Rung& rung, uint32_t next);
  bool mayLeaveAfter(const network::Network& network) const;
  void planParts();
  void reportLongRungs(const std::vector<ir::PartPiece>& pieces, uint64_t room);
  void addTasks();
  void addTask(const LevelState& level);
  void addScan();
  void addLatch(const LevelState& level, size_t area);
  void addResultRegisters(const LevelState& level);
  ir::RoutineId routineOf(const LevelState& level) const { return level.routines[level.level]; }

  const network::Program& program_;
  network::Context& context_;
  std::span<const FileId> files_;
  const frontend::CompileOptions& options_;
  std::unique_ptr<ir::Module> module_;
  frontend::ConstantBytes constants_;
  std::unordered_map<uint32_t, ir::FileIndex> fileIndex_;
  std::unordered_map<std::string, ir::SlotId> slots_;
  std::array<ir::SpaceId, kAreas.size()> spaces_; // of the areas
  std::unordered_map<std::string, ir::SpaceId> hidden_;
  std::vector<std::vector<Key>> keys_;                            // by unit and network
  std::vector<std::vector<std::string>> slotPrefixes_;            // by unit and network; of networks with a function
  std::unordered_map<const network::Network*, uint32_t> numbers_; // as drawn; of the ends of units there is none
  std::vector<LevelState> levels_;
  uint32_t parts_ = 1;
};

} // namespace rung::gsk
