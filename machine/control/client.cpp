// See client.h.
#include "machine/control/client.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "machine/control/place.h"
#include "machine/control/values.h"
#include "rtlib/text/bit_word.h"
#include "rtlib/text/number.h"

namespace rung::control {

using nlohmann::json;

namespace {

// Checks which user listens there: another user could have created the folder first. Returns "" for the own user and
// root.
std::string strangerOf(int made) {
  ucred who{};
  socklen_t size = sizeof who;
  if (getsockopt(made, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0)
    return "does not identify its owner, and is not used";
  if (geteuid() == 0 || who.uid == geteuid() || who.uid == 0) return {};
  return "belongs to user " + std::to_string(who.uid) + ", and is not used";
}

// Returns -1 with errno if no host listens there.
int connected(const std::string& path) {
  const sockaddr_un address = socketAddress(path);
  const int made = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (connect(made, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int problem = errno;
    close(made);
    errno = problem;
    return -1;
  }
  if (const std::string wrong = strangerOf(made); !wrong.empty()) {
    close(made);
    throw std::runtime_error("the host at " + path + " " + wrong);
  }
  return made;
}

Reached reachedBy(std::string host, int made) {
  return {std::move(host), Connection(host::Socket(made), Connection::kLongestAnswer)};
}

Reached reach(const std::string& host) {
  std::string problem;
  for (const std::string& folder : socketFolders(geteuid())) {
    const std::string path = socketPath(folder, host);
    if (const int made = connected(path); made >= 0) return reachedBy(host, made);
    if (problem.empty()) problem = "cannot reach a host at " + path + ": " + std::strerror(errno);
  }
  throw std::runtime_error(problem + "; does it run, under your user name?");
}

// Connects only once to each host: a separate check whether it runs would make it serve two connections.
Reached reachTheOnlyOne() {
  std::vector<Reached> reached;
  for (Place& place : placesOf(geteuid()))
    if (const int made = connected(place.path); made >= 0) reached.push_back(reachedBy(std::move(place.host), made));
  if (reached.size() == 1) return std::move(reached.front());
  if (reached.empty())
    throw std::runtime_error(
        fmt::format("no host is running: no socket is in {}", fmt::join(socketFolders(geteuid()), " or ")));
  std::vector<std::string> hosts;
  for (Reached& one : reached) hosts.push_back(std::move(one.host));
  std::ranges::sort(hosts);
  throw std::runtime_error(
      fmt::format("several hosts are running; choose one with --host: {}", fmt::join(hosts, ", ")));
}

} // namespace

Client::Client(const std::string& host, std::chrono::milliseconds patience)
    : Client(host.empty() ? reachTheOnlyOne() : reach(host), patience) {}

Client::Client(Reached reached, std::chrono::milliseconds patience)
    : host_(std::move(reached.host)), connection_(std::move(reached.connection)) {
  const std::optional<json> first = next(patience);
  if (!first) throw std::runtime_error("the host " + host_ + " does not answer");
  if (first->contains("error")) throw std::runtime_error((*first)["error"].get<std::string>());
  greeting_ = *first;
  if (greeting_.value("rung", "") != "host" || greeting_.value("protocol", 0) != kProtocol)
    throw std::runtime_error("the host " + host_ + " speaks another protocol: " + greeting_.dump());
}

json Client::ask(const json& request, std::chrono::milliseconds patience) {
  connection_.send(request.dump());
  while (const std::optional<json> line = next(patience)) {
    if (!line->contains("event")) return *line;
    events_.push_back(*line);
  }
  if (connection_.ended()) throw std::runtime_error("the host " + host_ + " has ended");
  throw std::runtime_error(interrupted_ ? "interrupted before the host " + host_ + " answered"
                                        : "the host " + host_ + " does not answer");
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

// Returns the next line; nothing after the wait, or if the host has disconnected.
std::optional<json> Client::next(std::chrono::milliseconds wait) {
  while (true) {
    if (const std::optional<std::string> line = connection_.line()) {
      json parsed = json::parse(*line, nullptr, false);
      if (parsed.is_object()) return parsed;
      throw std::runtime_error("the host " + host_ + " sent a line that is not a JSON object");
    }
    if (connection_.ended()) return std::nullopt;
    pollfd waiting{connection_.socket(), POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(wait.count()));
    interrupted_ = ready < 0 && errno == EINTR;
    if (ready <= 0) return std::nullopt;
    connection_.receive();
  }
}

json asked(Client& client, const json& request, std::chrono::milliseconds patience) {
  json answer = client.ask(request, patience);
  if (!answer.value("ok", false)) throw std::runtime_error(answer.value("error", "the host refuses"));
  return answer;
}

json compiledByHost(Client& client, const std::string& packed, const volatile int& stop) {
  constexpr size_t kPiece = 45'000; // a request has at most 64 kB
  for (size_t at = 0; at < packed.size(); at += kPiece)
    asked(client, {{"do", "sources"}, {"first", at == 0}, {"piece", toBase64(packed.substr(at, kPiece))}});
  asked(client, {{"do", "compile"}});
  json answer;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    answer = asked(client, {{"do", "compiled"}});
  } while (stop == 0 && answer["state"] == "compiling");
  return answer;
}

std::string whetherItRuns(const json& answer, const char* program) {
  if (answer.value("put_back", false))
    return "the new program stopped at once with a fault, and the former one is back: see status";
  const char* does = answer.value("waits", false)     ? "waits for a reset"
                     : answer.value("stopped", false) ? "is stopped"
                     : answer.value("again", false)   ? "runs again"
                                                      : "runs";
  return fmt::format("the {} program {}", program, does);
}

json writtenValue(const std::string& text) {
  if (const std::optional<bool> bit = text::bitWord(text)) return *bit;
  const text::WrittenNumber number = text::writtenNumber(text);
  if (number.form == text::NumberForm::Real && std::isfinite(number.real)) return number.real;
  if (number.form != text::NumberForm::Whole) return text;
  return number.negative ? json(static_cast<int64_t>(number.bits())) : json(number.magnitude);
}

namespace {

// Returns false at the end.
bool readMore(int in, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t count = read(in, buffer.data(), buffer.size());
  if (count > 0) text.append(buffer.data(), static_cast<size_t>(count));
  return count > 0;
}

void passLines(std::string& text, Connection& host) {
  for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
    host.send(std::string_view(text).substr(0, end));
    text.erase(0, end + 1);
  }
  if (text.size() > Connection::kLongestRequest) throw std::runtime_error("found a line of more than 64 kB");
}

void passAnswers(Connection& host, std::ostream& out) {
  while (const std::optional<std::string> line = host.line()) out << *line << '\n';
  out.flush();
}

} // namespace

void relay(Connection& host, int in, std::ostream& out, const volatile int& stop) {
  constexpr int kTurnMs = 100;
  std::string text;
  while (stop == 0 && out) {
    passAnswers(host, out);
    if (host.ended()) return;
    std::array<pollfd, 2> waiting = {
        pollfd{host.socket(), static_cast<short>(POLLIN | (host.wantsToSend() ? POLLOUT : 0)), 0},
        pollfd{in, POLLIN, 0}};
    if (poll(waiting.data(), waiting.size(), kTurnMs) < 0) continue; // interrupted by a signal
    if ((waiting[0].revents & POLLOUT) != 0) host.sendMore();
    if ((waiting[0].revents & ~POLLOUT) != 0) host.receive();
    if (waiting[1].revents != 0 && !readMore(in, text)) return;
    passLines(text, host);
  }
}

} // namespace rung::control
