// rungc web: the live page of a machine that runs.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tools/rungc/commands.h"
#include "tools/rungc/host.h"
#include "tools/rungc/stop_signal.h"
#include "tools/rungc/web.h"

namespace rung::rungc {
namespace {

struct WebOptions {
  std::vector<std::string> files;
  std::string host;
  std::string listen = kDefaultListen;
};

int runWeb(const WebOptions& options) {
  if (const std::string wrong = listenProblem(options.listen); !wrong.empty()) return usageError(wrong);
  Result<FollowedHost> host = followHost(options.host);
  if (!host.ok()) return environmentError(host.error());
  const scenario::Signal& stop = catchStop();
  return serveMachine(options.listen, std::move(host).value(), options.files, [&stop] { return stop != 0; });
}

} // namespace

void addWeb(CommandLine& app, int& status) {
  Command command = app.add("web", "Show a machine that runs in a browser: its rungs, its past, and why");
  auto options = std::make_shared<WebOptions>();
  command.option("FILE", options->files,
                 "Sources of the program that runs, or the folder of its project; default: the files that it names");
  command.option("--host", options->host, "Name of the host; default: the only running one");
  command.option("--listen", options->listen, "Address of the page, such as 8080 or 192.168.0.5:8080").showDefault();
  command.onRun([options, &status] { status = runWeb(*options); });
}

} // namespace rung::rungc
