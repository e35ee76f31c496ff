// From networks to a program: which unit a network belongs to.
#pragma once
#include <map>
#include <vector>

#include "frontend/network/program.h"
#include "frontend/network/read/context.h"

namespace rung::network {

// Sorts networks into units. Command lists bring their own ends (§1.2); ladder modules name their unit.
class UnitAssembler {
public:
  UnitAssembler(Context& context, Program& program)
      : language_(context.language), context_(context), program_(program) {}

  // Command lists: every network in the order of the text, then the end of each file.
  void add(Network&& network);
  void endOfList(SourceRange lastLine);

  // Ladder modules: the unit of `module LEVEL1`, `module LEVEL2` or `module SUB Pn`.
  uint32_t openModule(UnitKind kind, uint32_t number, SourceRange module, SourceRange name);
  void addTo(uint32_t unit, Network&& network) { program_.units[unit].networks.push_back(std::move(network)); }

  // After all files: every unit gets its end. `anywhere` serves where a unit has no place of its own.
  void finish(SourceRange anywhere);
  // A function command may have been lost in an error; then nothing is said about what is missing.
  bool incomplete() const { return incomplete_; }
  void setIncomplete() { incomplete_ = true; }

private:
  void end1(Network&& network);
  void end2(Network&& network);
  void beginSubprogram(const Network& network);
  void endSubprogram(Network&& network);
  void body(Network&& network);
  void nest(SourceRange inner);
  void closeAll();
  uint32_t subprogram(uint32_t number, SourceRange range, SourceRange name);

  const Language& language_;
  Context& context_;
  Program& program_;
  std::map<uint32_t, uint32_t> subprograms_; // number -> unit
  uint32_t current_ = kLevel1;               // kNone: after END2, in no subprogram
  struct Open {
    uint32_t unit = kNone;
    uint32_t outside = kNone; // the unit around a misplaced or nested subprogram
    bool closedInner = false; // the last thing in it was a nested subprogram
  };
  std::vector<Open> open_; // subprograms, the innermost last
  bool nestedReported_ = false;
  bool sawEnd1_ = false;
  bool sawEnd2_ = false;
  bool sawList_ = false;
  SourceRange end2Range_;
  bool strayReported_ = false;         // in this run of commands after END2
  std::vector<SourceRange> stray_;     // such runs
  std::vector<SourceRange> misplaced_; // subprograms that began before END2
  bool incomplete_ = false;
  bool moduleOpened_[2] = {false, false};
};

} // namespace rung::network
