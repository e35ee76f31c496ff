// The internal quantities of the control that SCP queries (man. 6.17).
#pragma once
#include <optional>
#include <vector>

#include "sim/nct/topic.h"

namespace rung::sim::nct {

class Scope {
public:
  explicit Scope(const Links& links);

  // `symbol` is an index into scopeSymbols(). Nothing: there is no such symbol, or its parameters are out of range.
  std::optional<double> read(int64_t symbol, int64_t parameter1, int64_t parameter2) const;

  using Read = double (*)(const Links& links, uint32_t parameter1, uint32_t parameter2);

private:
  const Links& links_;
  std::vector<Read> reads_; // by symbol
};

} // namespace rung::sim::nct
