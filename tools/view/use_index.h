// Which rungs of a drawing use a place, whatever its operands look like.
#pragma once
#include <vector>

#include "tools/view/program.h"

namespace rung::view {

class UseIndex {
public:
  // `reference` must outlive it. It knows what no operand says: the cells between the two ends of an array, a
  // counter's own.
  explicit UseIndex(const report::CrossReference& reference) : reference_(reference) {}

  // A use as drawn. All of them come before the first question.
  void add(const ir::BitRange& place, Use use) { drawn_.push_back({place, use}); }
  // By rung, each side once.
  std::vector<Use> of(const ir::BitRange& place);

private:
  struct Drawn {
    ir::BitRange place;
    Use use;
  };
  void settle();
  std::vector<Use> drawnAt(const ir::BitRange& place) const;

  const report::CrossReference& reference_;
  std::vector<Drawn> drawn_;
  uint32_t longest_ = 0; // bits of a use; 0: not settled yet
};

} // namespace rung::view
