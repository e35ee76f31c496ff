// Checks of requests (see access.h).
#include "tools/web/access.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/random.h>

namespace rung::web {
namespace {

std::optional<uint16_t> portOf(std::string_view text) {
  uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return port;
}

// "host:port" with brackets around an IPv6 address; without a port only `host`.
std::pair<std::string_view, std::string_view> split(std::string_view text) {
  const size_t bracket = text.find(']');
  const size_t colon = text.find(':', text.starts_with('[') && bracket != std::string_view::npos ? bracket : 0);
  std::string_view host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  return {host, colon == std::string_view::npos ? "" : text.substr(colon + 1)};
}

bool isAddress(std::string_view host) {
  const std::string text(host);
  std::array<uint8_t, 16> bytes{};
  return inet_pton(AF_INET, text.c_str(), bytes.data()) == 1 || inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1;
}

std::string shownHost(std::string_view host) {
  return host.find(':') == std::string_view::npos ? std::string(host) : fmt::format("[{}]", host);
}

// Takes the same time wherever the texts differ.
bool isSame(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (size_t i = 0; i < a.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return different == 0;
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string decoded(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
    if (!escape) {
      out += text[i] == '+' ? ' ' : text[i];
      continue;
    }
    out += static_cast<char>(digit(text[i + 1]) * 16 + digit(text[i + 2]));
    i += 2;
  }
  return out;
}

} // namespace

std::optional<Listen> parseListen(std::string_view text) {
  if (const auto port = portOf(text)) return Listen{.port = *port};
  const auto [host, port] = split(text);
  const auto number = portOf(port);
  if (host.empty() || text.ends_with(":") || (!port.empty() && !number)) return std::nullopt;
  return Listen{std::string(host), number.value_or(0)};
}

std::string Access::newSecret() {
  std::array<uint8_t, 24> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers, which links to the page need");
  std::string text;
  for (const uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

std::string Access::newToken() {
  const std::lock_guard lock(mutex_);
  if (tokens_.size() == kMostTokens) tokens_.erase(tokens_.begin());
  return tokens_.emplace_back(newSecret());
}

bool Access::spend(std::string_view token) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find_if(tokens_, [&](const std::string& one) { return isSame(one, token); });
  if (found == tokens_.end()) return false;
  tokens_.erase(found);
  return true;
}

bool Access::isOurs(std::string_view host) const {
  const auto [name, port] = split(host);
  if (portOf(port.empty() ? "80" : port) != port_) return false;
  return name == "localhost" || name == listen_.host || isAddress(name);
}

std::string Access::refusal(const Caller& caller) const {
  if (!isOurs(caller.host))
    return fmt::format("this page is not at '{}': open the link that was printed", caller.host.substr(0, 100));
  const bool reads = caller.method == "GET" || caller.method == "HEAD";
  if (!reads && caller.method != "POST") return "only GET, HEAD and POST are answered";
  if (!caller.origin.empty() && caller.origin != fmt::format("http://{}", caller.host))
    return "a page from elsewhere asks";
  if (!reads && caller.origin.empty()) return "it does not say which page asks (Origin)";
  return {};
}

std::string Access::cookieName() const { return fmt::format("rung-{}", port_); }

std::string Access::cookie() const {
  return fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/", cookieName(), secret_);
}

bool Access::knows(const Caller& caller) const {
  std::string_view rest = caller.cookies;
  const std::string name = cookieName();
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(';'), rest.size());
    std::string_view one = rest.substr(0, end);
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (one.starts_with(name) && one.substr(name.size()).starts_with('=') &&
        isSame(one.substr(name.size() + 1), secret_))
      return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

std::string Access::url() const {
  const bool any = listen_.host == "0.0.0.0" || listen_.host == "::";
  return fmt::format("http://{}:{}/", any ? "127.0.0.1" : shownHost(listen_.host), port_);
}

std::string queryValue(std::string_view query, std::string_view name) {
  while (!query.empty()) {
    const size_t end = std::min(query.find('&'), query.size());
    const std::string_view one = query.substr(0, end);
    const size_t equals = std::min(one.find('='), one.size());
    if (one.substr(0, equals) == name) return decoded(one.substr(std::min(equals + 1, one.size())));
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return {};
}

} // namespace rung::web
