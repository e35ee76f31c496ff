// See relay.h.
#include "machine/rungctl/relay.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <ostream>
#include <stdexcept>
#include <string>

namespace rung::rungctl {
namespace {

// False: there is no more.
bool readMore(int in, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t count = read(in, buffer.data(), buffer.size());
  if (count > 0) text.append(buffer.data(), static_cast<size_t>(count));
  return count > 0;
}

void passLines(std::string& text, control::Connection& host) {
  for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
    host.send(std::string_view(text).substr(0, end));
    text.erase(0, end + 1);
  }
  if (text.size() > control::Connection::kLongestRequest) throw std::runtime_error("found a line of more than 64 kB");
}

void passAnswers(control::Connection& host, std::ostream& out) {
  while (const std::optional<std::string> line = host.line()) out << *line << '\n';
  out.flush();
}

} // namespace

void relay(control::Connection& host, int in, std::ostream& out, const volatile int& stop) {
  constexpr int kTurnMs = 100;
  std::string text;
  while (stop == 0 && out) {
    passAnswers(host, out);
    if (host.ended()) return;
    std::array<pollfd, 2> waiting = {
        pollfd{host.socket(), static_cast<short>(POLLIN | (host.wantsToSend() ? POLLOUT : 0)), 0},
        pollfd{in, POLLIN, 0}};
    if (poll(waiting.data(), waiting.size(), kTurnMs) < 0) continue; // a signal
    if ((waiting[0].revents & POLLOUT) != 0) host.sendMore();
    if ((waiting[0].revents & ~POLLOUT) != 0) host.receive();
    if (waiting[1].revents != 0 && !readMore(in, text)) return;
    passLines(text, host);
  }
}

} // namespace rung::rungctl
