// The thread of the serial ports (see tty_thread.h).
#include "machine/io/com/tty_thread.h"

#include <poll.h>

#include "rtlib/run/realtime.h"

namespace rung::io::com {

std::string TtyThread::add(Port& port, std::string path) {
  if (!isStandardSpeed(port.settings().speed))
    return path + ": no serial port has " + std::to_string(port.settings().speed) + " bit/s";
  lines_.emplace_back(port, std::move(path));
  return {};
}

void TtyThread::start() {
  if (!lines_.empty()) thread_ = std::thread([this] { run(); });
}

void TtyThread::end() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
}

std::vector<std::string> TtyThread::problems() const {
  std::vector<std::string> found;
  for (const TtyLine& line : lines_)
    if (std::string problem = line.problem(); !problem.empty()) found.push_back(std::move(problem));
  return found;
}

void TtyThread::run() noexcept {
  runtime::becomeHelper();
  std::vector<pollfd> waited(lines_.size());
  for (bool last = false; !last;) {
    last = ending_;
    auto* entry = waited.data();
    for (TtyLine& line : lines_) {
      line.step(runtime::monotonicNs() / 1'000'000);
      *entry++ = {line.descriptor(), static_cast<short>(line.hasUnsent() ? POLLIN | POLLOUT : POLLIN), 0};
    }
    if (!last) poll(waited.data(), waited.size(), kPauseMs);
  }
}

} // namespace rung::io::com
