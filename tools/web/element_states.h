// The states of the elements that the page shows, from the flow of a scan.
#pragma once
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "ir/core/memory_use.h"
#include "tools/replay/flow.h"
#include "tools/web/shown_program.h"

namespace rung::web {

// Keeps no reference to the arguments of its constructor. Any thread.
class ElementStates {
public:
  ElementStates(replay::FlowEngine& engine, const ShownProgram& program);

  // Whether rungs read the bit as one that never changes: a flow says nothing of such a contact, since front ends leave
  // it out, and its state is set once.
  bool isConstant(const ir::BitRange& bit) const;
  void setConstant(uint32_t element, bool conducts);

  // By element of the program (ElementState), with the memory block after the flow. An element that was evaluated
  // several times has the state of the last time.
  std::vector<uint8_t> of(const replay::Flow& flow, std::span<const uint8_t> block) const;

private:
  struct Pin {
    uint32_t pin = 0; // over all elements of the flow
    uint32_t element = 0;
    uint8_t result = 0; // of a box, what comes out of it: kResultKnown, perhaps with kConducts
  };
  struct Step {
    uint32_t element = 0;
    uint32_t offset = 0; // of the continuation in the block
    std::vector<uint32_t> states;
  };
  void addWired(const replay::Elements& elements, const ShownProgram& program);

  std::vector<Pin> pins_;
  std::vector<Step> steps_;
  std::vector<uint32_t> rungOf_;             // by rung as lowered: in wired_, or none
  std::vector<std::vector<uint32_t>> wired_; // by rung of the source: its rail, and coils and boxes without a pin
  uint32_t elements_;                        // of the program
  std::set<std::pair<uint32_t, uint64_t>> constantBits_; // space, bit
  std::vector<std::pair<uint32_t, uint8_t>> constants_;
};

} // namespace rung::web
