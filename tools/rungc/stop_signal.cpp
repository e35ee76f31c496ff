// See stop_signal.h.
#include "tools/rungc/stop_signal.h"

#include <csignal>

namespace rung::rungc {
namespace {

scenario::Signal gStop = 0; // the only variable that the signal handler writes

} // namespace

scenario::Signal& stopSignal() { return gStop; }

scenario::Signal& catchStop() {
  struct sigaction action{};
  action.sa_handler = [](int signal) { gStop = signal; };
  sigaction(SIGINT, &action, nullptr); // without SA_RESTART: a prompt that reads must notice
  sigaction(SIGTERM, &action, nullptr);
  return gStop;
}

} // namespace rung::rungc
