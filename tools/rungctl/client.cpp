// See client.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/rungctl/client.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "tools/remote/controller.h"
#include "tools/remote/place.h"

namespace rung::rungctl {

using nlohmann::json;

namespace {

// Who listens there: somebody else could have made the folder first. "" of the user himself, and of root.
std::string strangerOf(int made) {
  ucred who{};
  socklen_t size = sizeof who;
  if (getsockopt(made, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0) return "does not say whose it is";
  if (geteuid() == 0 || who.uid == geteuid() || who.uid == 0) return {};
  return "belongs to user " + std::to_string(who.uid) + ", and is not used";
}

int connected(const std::string& path) {
  const sockaddr_un address = remote::socketAddress(path);
  const int made = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (connect(made, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    if (const std::string wrong = strangerOf(made); !wrong.empty()) {
      close(made);
      throw std::runtime_error("the host at " + path + " " + wrong);
    }
    return made;
  }
  const int problem = errno;
  close(made);
  throw std::runtime_error("cannot reach a host at " + path + ": " + std::strerror(problem) +
                           "; is it running, and yours?");
}

// That of the name, or the only one.
std::string chosen(const std::string& host) {
  if (!host.empty()) return host;
  const std::vector<std::string> hosts = remote::hostsOf(geteuid());
  if (hosts.size() == 1) return hosts.front();
  if (hosts.empty())
    throw std::runtime_error(
        fmt::format("no host is running: no socket is in {}", fmt::join(remote::socketFolders(geteuid()), " or ")));
  throw std::runtime_error(fmt::format("several hosts are running; choose one by --host: {}", fmt::join(hosts, ", ")));
}

} // namespace

Client::Client(const std::string& host)
    : host_(chosen(host)),
      connection_(connected(remote::socketOf(geteuid(), host_)), remote::Connection::kLongestAnswer) {
  const std::optional<json> first = next(kAnswer);
  if (!first) throw std::runtime_error("the host " + host_ + " does not answer");
  if (first->contains("error")) throw std::runtime_error((*first)["error"].get<std::string>());
  greeting_ = *first;
  if (greeting_.value("rung", "") != "host" || greeting_.value("protocol", 0) != remote::Controller::kProtocol)
    throw std::runtime_error("the host " + host_ + " speaks another protocol: " + greeting_.dump());
}

json Client::ask(const json& request, std::chrono::milliseconds patience) {
  connection_.send(request.dump());
  while (const std::optional<json> line = next(patience)) {
    if (!line->contains("event")) return *line;
    events_.push_back(*line);
  }
  throw std::runtime_error("the host " + host_ + " does not answer");
}

std::optional<json> Client::event(const volatile int& stop) {
  constexpr std::chrono::milliseconds kTurn(100);
  std::optional<json> found;
  while (stop == 0 && !found) found = event(kTurn);
  return found;
}

std::optional<json> Client::event(std::chrono::milliseconds patience) {
  if (!events_.empty()) {
    json first = std::move(events_.front());
    events_.pop_front();
    return first;
  }
  std::optional<json> line = next(patience);
  if (line && line->contains("event")) return line;
  if (connection_.ended()) throw std::runtime_error("the host " + host_ + " has ended");
  return std::nullopt;
}

// The next line, nothing within that time; or the host has gone.
std::optional<json> Client::next(std::chrono::milliseconds wait) {
  while (true) {
    if (const std::optional<std::string> line = connection_.line()) {
      json parsed = json::parse(*line, nullptr, false);
      if (parsed.is_object()) return parsed;
      throw std::runtime_error("the host " + host_ + " sent a line that is not a JSON object");
    }
    if (connection_.ended()) return std::nullopt;
    pollfd waiting{connection_.socket(), POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(wait.count())) <= 0) return std::nullopt;
    connection_.receive();
  }
}

} // namespace rung::rungctl
