// See host.h.
#include "tools/rungc/host.h"

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include <nlohmann/json.hpp>

namespace rung::rungc {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

constexpr auto kWritten = 120ms; // after a request to follow, what has run before is in the file
constexpr auto kBegins = 3s;     // a host that was just started records soon

std::string folderOf(control::Client& client) {
  return control::asked(client, {{"do", "recording"}, {"follow", true}}).value("folder", "");
}

} // namespace

void FollowedHost::refresh() {
  try {
    (void)folderOf(*client);
    std::this_thread::sleep_for(kWritten);
  } catch (const std::exception&) { // what it has recorded stays
  }
  (void)followed.take();
}

Result<FollowedHost> followHost(const std::string& host,
                                std::vector<std::shared_ptr<const compiler::Compiled>> known) try {
  FollowedHost to;
  to.client = std::make_unique<control::Client>(host);
  to.name = to.client->greeting().value("host", host);
  const std::string folder = folderOf(*to.client);
  std::this_thread::sleep_for(kWritten);
  std::string problem;
  for (const auto until = std::chrono::steady_clock::now() + kBegins; std::chrono::steady_clock::now() < until;) {
    if (runtime::RecordingReader::open(folder, problem)) break;
    std::this_thread::sleep_for(kWritten);
  }
  Result<replay::Followed> followed = replay::follow(folder, std::move(known));
  if (!followed.ok()) return followed.failure();
  to.followed = std::move(followed).value();
  return to;
} catch (const std::exception& problem) {
  return failure(problem.what());
}

} // namespace rung::rungc
