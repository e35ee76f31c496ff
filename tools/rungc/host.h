// A machine that runs, as commands of rungc see it: through the socket of its host, and by what the host records.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "ir/support/result.h"
#include "machine/control/client.h"
#include "tools/replay/followed.h"

namespace rung::rungc {

struct FollowedHost {
  std::unique_ptr<control::Client> client;
  std::string name;
  replay::Followed followed;

  // Takes what has been recorded up to now; what it was before, if the host does not answer.
  void refresh();
};

// `host`: a name as for rungctl; "": the only one that runs. `known`: programs that it may run, in addition to that
// of its recording. The position is the newest scan. Fails if the host cannot be reached or records nothing.
Result<FollowedHost> followHost(const std::string& host,
                                std::vector<std::shared_ptr<const compiler::Compiled>> known = {});

} // namespace rung::rungc
