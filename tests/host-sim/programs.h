// The programs of a simulated host: versions of one, compiled in the process.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "compiler/engines.h"
#include "rung/runtime.hpp"

namespace rung::host_sim {

struct Version {
  std::string name;
  bool remembers = true; // edges, times and requests
};

class Programs {
public:
  Programs();
  ~Programs();
  const std::vector<Version>& versions() const { return versions_; }
  // Made anew each time; code with forced cells can be had for it.
  Image image(size_t version) const;
  // By name; nothing: there is none.
  std::optional<size_t> find(const std::string& name) const;

private:
  struct Made;
  std::vector<Version> versions_;
  std::vector<std::unique_ptr<Made>> made_;
};

} // namespace rung::host_sim
