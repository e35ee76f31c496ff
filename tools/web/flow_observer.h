// What the interpreter shows of each element while it runs a program.
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ir/core/marks.h"
#include "ir/core/module.h"
#include "ir/interp/interp.h"
#include "tools/web/shown_program.h"

namespace rung::web {

// Belongs to the thread that runs the program. An element that is evaluated several times in a scan has the state of
// the last time.
class FlowObserver final : public ir::RungObserver {
public:
  // `module`: not changed by any pass. Keeps no reference to the arguments.
  FlowObserver(const ir::Module& module, const ir::Marks& marks, const ShownProgram& program);

  // Whether the interpreter shows something of the element. Of a contact whose bit never changes it shows nothing; its
  // state is set once.
  bool shows(uint32_t element) const { return shown_[element]; }
  void setConstant(uint32_t element, bool conducts);

  void rungRan(uint32_t number, std::span<const uint64_t> values) override;
  // What was evaluated before belongs to an earlier scan from now on.
  void beginScan() { before_ = run_; }
  // The states of all elements after the scan (ElementState).
  std::vector<uint8_t> states() const;

private:
  // The condition of a region around the operation that computes a value.
  struct Guard {
    uint32_t value = 0;
    bool wanted = true;
  };
  struct Watched {
    uint32_t value = 0;
    uint32_t element = 0;
    uint8_t result = 0; // of a box, what comes out of it: kResultKnown, perhaps with kConducts
    std::vector<Guard> guards;
  };
  static std::vector<std::vector<Guard>> guardsOf(const ir::Rung& rung);

  std::vector<std::vector<Watched>> rungs_;             // by rung number over all routines
  std::vector<bool> shown_;                             // by element
  std::vector<uint8_t> states_;                         // by element
  std::vector<uint64_t> runs_;                          // by element: the run of a rung in which it was last evaluated
  std::vector<std::pair<uint32_t, uint8_t>> constants_; // elements with their states
  uint64_t run_ = 0;
  uint64_t before_ = 0; // the last run of earlier scans
};

} // namespace rung::web
