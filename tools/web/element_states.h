// The states of the elements that the page shows, from the flow of a scan.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tools/replay/flow.h"
#include "tools/web/shown_program.h"

namespace rung::web {

// Keeps no reference to the arguments of its constructor. Any thread.
class ElementStates {
public:
  ElementStates(replay::FlowEngine& engine, const ShownProgram& program);

  // Whether a flow says something of the element. Of a contact whose bit never changes it says nothing: front ends
  // leave it out; its state is set once.
  bool shows(uint32_t element) const { return shown_[element]; }
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
  std::vector<Pin> pins_;
  std::vector<Step> steps_;
  std::vector<bool> shown_; // by element of the program
  std::vector<std::pair<uint32_t, uint8_t>> constants_;
};

} // namespace rung::web
