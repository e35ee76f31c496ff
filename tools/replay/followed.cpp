// See followed.h.
#include "tools/replay/followed.h"

#include <utility>

namespace rung::replay {

Result<Followed> follow(const std::string& path, std::vector<std::shared_ptr<const compiler::Compiled>> known) {
  Followed followed;
  Result<std::unique_ptr<GrowingRecording>> files = GrowingRecording::open(path, kFollowedLimits, std::move(known));
  if (!files.ok()) return files.failure();
  followed.files = std::move(files).value();
  Result<std::unique_ptr<Past>> past = Past::open(followed.files->recording(), {});
  if (!past.ok()) return past.failure();
  followed.past = std::move(past).value();
  followed.past->compare(false);
  if (std::string problem = followed.past->goTo(followed.past->contents().parts); !problem.empty())
    return failure(problem);
  return followed;
}

} // namespace rung::replay
