// Assigns networks to the units of a program.
#pragma once
#include <map>
#include <vector>

#include "frontend/network/program.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::network {

// Sorts networks into units. Command lists contain their ends (§1.2); ladder modules name their unit.
class UnitAssembler {
public:
  UnitAssembler(Context& context, Program& program)
      : language_(context.language), context_(context), program_(program), ends_(language_.levels.size()),
        moduleOpened_(language_.levels.size()) {}

  // Command lists: every network in text order, then the end of each file.
  void add(Network&& network);
  void endOfList(SourceRange lastLine);
  bool sawList() const { return sawList_; } // whether a list had networks

  // Ladder modules: the unit of `module LEVEL1` or `module SUB Pn`.
  uint32_t openLevel(uint32_t level, SourceRange module);
  uint32_t openSubprogram(uint32_t number, SourceRange range, SourceRange name);
  Unit& at(uint32_t unit) { return program_.units[unit]; }

  // After all files: gives every unit its end. `anywhere` is used for units without a position.
  void finish(SourceRange anywhere);
  // Whether a function command may have been lost in an error; then missing parts are not reported.
  bool incomplete() const { return incomplete_; }
  void setIncomplete() { incomplete_ = true; }

private:
  void endLevel(Network&& network);
  void endOrder(uint32_t level, std::string_view before, SourceRange range);
  // Text of what an end of a level must not follow; "" if it is in its place.
  std::string isAfter(uint32_t level) const;
  void beginSubprogram(Network& network);
  void endSubprogram(Network&& network);
  void endProgram(Network&& network);
  void leaveOptional(Gap& next);
  void body(Network&& network);
  static void takeSource(Unit& unit, Network& network);
  void giveBackSource(Network& network);
  void nest(SourceRange inner);
  void closeAll();
  // Whether the open unit is a level that a list need not have.
  bool isInOptional() const { return current_ < levelCount() && language_.levels[current_].optional; }
  uint32_t levelCount() const { return static_cast<uint32_t>(language_.levels.size()); }
  // The first level after `level` whose end was found, otherwise levelCount().
  uint32_t nextEnded(uint32_t level) const;
  // Whether no command has been read.
  bool isEmpty() const;
  // The end after which subprograms must follow.
  const Row& lastEnd() const;

  const Language& language_;
  Context& context_;
  Program& program_;
  std::map<uint32_t, uint32_t> subprograms_; // number -> unit
  uint32_t current_ = 0;                     // kNone: after the last level, outside of subprograms
  struct Open {
    uint32_t unit = kNone;
    uint32_t outside = kNone; // the unit around a misplaced or nested subprogram
    bool closedInner = false; // its last part was a nested subprogram
  };
  std::vector<Open> open_; // subprograms, the innermost last
  bool nestedReported_ = false;
  bool sawList_ = false;
  SourceRange programEnd_;             // invalid: not found
  std::vector<SourceRange> ends_;      // of the levels; invalid: not found
  bool strayReported_ = false;         // for this run of commands after the last level
  std::vector<SourceRange> stray_;     // ranges of such runs
  std::vector<SourceRange> misplaced_; // subprograms that began before its end
  bool incomplete_ = false;
  std::vector<bool> moduleOpened_; // by level
};

} // namespace rung::frontend::network
