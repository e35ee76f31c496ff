// Who may talk to the page's server: checks of a request before anything else looks at it. Pure functions and a small
// state; no network here.
#pragma once
#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rung::web {

// An address to listen on: "127.0.0.1:8080", "[::1]:0", "8080". Port 0: any free one.
struct Listen {
  std::string host = "127.0.0.1"; // an address or a name, IPv6 without brackets
  uint16_t port = 0;
};
// Nothing: not an address.
std::optional<Listen> parseListen(std::string_view text);

// What a request says about where it comes from.
struct Caller {
  std::string_view method;
  std::string_view host;      // header Host; "" without one
  std::string_view origin;    // header Origin; "" without one
  std::string_view fetchSite; // header Sec-Fetch-Site; "" without one
  std::string_view cookies;   // header Cookie
};

// Links are used once: the first request with a link's token gets the cookie, by which it is known from then on. Any
// thread.
class Access {
public:
  // `port`: the one that is listened on.
  Access(Listen listen, uint16_t port) : listen_(std::move(listen)), port_(port), secret_(newSecret()) {}

  // A new token for one browser. At most kMostTokens wait to be used; the oldest becomes invalid.
  std::string newToken();
  // Whether the token waits to be used; it does not any more then.
  bool spend(std::string_view token);

  // Whether the request may be answered at all; "" or why not. A name that a foreign name server resolves to this
  // computer is not ours (DNS rebinding): the host is an address, localhost, or what was listened on. Requests
  // that change something, and those for data, come from our own page.
  std::string refusal(const Caller& caller) const;
  // Whether the request has the cookie.
  bool knows(const Caller& caller) const;
  // The header Set-Cookie for a browser that has spent a token.
  std::string cookie() const;

  // The address of the page: "http://127.0.0.1:8080/".
  std::string url() const;

private:
  static constexpr size_t kMostTokens = 8;
  static std::string newSecret();
  std::string cookieName() const;
  bool isOurs(std::string_view host) const;

  const Listen listen_;
  const uint16_t port_;
  const std::string secret_;
  mutable std::mutex mutex_; // protects the tokens
  std::vector<std::string> tokens_;
};

// The value of a name in "a=1&b=2", decoded; "" if it is not there.
std::string queryValue(std::string_view query, std::string_view name);

} // namespace rung::web
