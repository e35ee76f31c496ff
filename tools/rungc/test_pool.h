// Runs scenarios on several threads and hands the results on in order.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tools/rungc/scenarios.h"

namespace rung::rungc {

struct PoolCalls {
  // On the caller's thread, in the order of the files. False: no further scenario is begun, and no further result
  // given.
  std::function<bool(TestCase)> finished;
  // On the caller's thread, now and then while nothing is finished: the file whose result is waited for.
  std::function<void(const std::string& file)> waiting;
};

void runAll(const std::vector<std::string>& files, const scenario::RunOptions& options, unsigned threads,
            const PoolCalls& calls);

} // namespace rung::rungc
