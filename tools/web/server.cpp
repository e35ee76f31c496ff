// The server on civetweb (see server.h).
#include "tools/web/server.h"

#include <atomic>
#include <civetweb.h>
#include <exception>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace rung::web {

struct Server::State {
  Handler handler;
  Server* server = nullptr;
  std::optional<Access> access; // set once the port is known
  std::atomic<bool> ready = false;
  mg_context* context = nullptr;
};

namespace {

constexpr const char* kRequestTimeoutMs = "5000"; // for a whole request, and for a client to read
constexpr const char* kKeepAliveMs = "2000";
constexpr const char* kMostHead = "8192";  // bytes of a request's head
constexpr const char* kMostWaiting = "64"; // connections that no thread serves yet

constexpr std::string_view kSecurity =
    "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
    "img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Opener-Policy: same-origin\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Cache-Control: no-store\r\n";

// The answer to a browser that has spent its token. It loads the page by itself: a redirection would not have the
// cookie where the link was on a page from elsewhere.
constexpr std::string_view kWelcome =
    "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><link rel=\"icon\" href=\"data:,\"><title>Rung</title>"
    "<meta http-equiv=\"refresh\" content=\"0; url=/\"><a href=\"/\">Open</a></html>\n";
constexpr std::string_view kSpent =
    "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><title>Rung</title><h1>This link has been used</h1>"
    "<p>Each link opens the page in one browser. The page has a button that makes a link for another one; a new start "
    "prints a new link.</p></html>\n";

std::string_view header(const mg_connection* connection, const char* name) {
  const char* value = mg_get_header(connection, name);
  return value == nullptr ? "" : value;
}

const char* reasonOf(int status) { return status == 200 ? "OK" : status < 500 ? "Refused" : "Failed"; }

void answer(mg_connection* connection, const Response& response, std::string_view more, bool bodyToo) {
  const std::string head =
      fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}; charset=utf-8\r\nContent-Length: {}\r\n{}{}\r\n",
                  response.status, reasonOf(response.status), response.type, response.body.size(), kSecurity, more);
  const std::string all = bodyToo ? head + response.body : head;
  mg_write(connection, all.data(), all.size());
}

// Nothing: too long, or it did not come.
std::optional<std::string> bodyOf(mg_connection* connection) {
  const long long length = mg_get_request_info(connection)->content_length;
  if (length < 0 || length > static_cast<long long>(Server::kMostBody)) return std::nullopt;
  std::string body(static_cast<size_t>(length), '\0');
  size_t got = 0;
  while (got < body.size()) {
    const int more = mg_read(connection, body.data() + got, body.size() - got);
    if (more <= 0) return std::nullopt;
    got += static_cast<size_t>(more);
  }
  return body;
}

Response handled(Server::State& state, const Request& request) try {
  return state.handler(request, *state.server);
} catch (const std::exception& error) {
  return {500, "text/plain", fmt::format("{}\n", error.what())};
}

struct Answer {
  Response response;
  std::string headers;
};

Answer respond(Server::State& state, mg_connection* connection) {
  const mg_request_info& info = *mg_get_request_info(connection);
  const Caller caller{info.request_method, header(connection, "Host"), header(connection, "Origin"),
                      header(connection, "Sec-Fetch-Site"), header(connection, "Cookie")};
  constexpr const char* kText = "text/plain";
  if (const std::string why = state.access->refusal(caller); !why.empty()) return {{403, kText, why + "\n"}, {}};
  Request request{caller.method == "POST", info.local_uri, info.query_string == nullptr ? "" : info.query_string, {}};
  if (const std::string token = queryValue(request.query, "token"); !token.empty() && request.path == "/") {
    if (state.access->spend(token))
      return {{200, "text/html", std::string(kWelcome)}, fmt::format("Set-Cookie: {}\r\n", state.access->cookie())};
    if (!state.access->knows(caller)) return {{403, "text/html", std::string(kSpent)}, {}};
  }
  if (!state.access->knows(caller)) return {{403, "text/html", std::string(kSpent)}, {}};
  if (!caller.fetchSite.empty() && caller.fetchSite != "same-origin" && request.path != "/")
    return {{403, kText, "a page from elsewhere asks\n"}, {}};
  if (header(connection, "Upgrade") != "") return {{400, kText, "no other protocol is spoken here\n"}, {}};
  if (request.post) {
    std::optional<std::string> body = bodyOf(connection);
    if (!body)
      return {{413, kText, fmt::format("a request has at most {} bytes, and says how many\n", Server::kMostBody)}, {}};
    request.body = std::move(*body);
  }
  return {handled(state, request), {}};
}

// Every request comes here first, whatever it asks for.
int beginRequest(mg_connection* connection) {
  auto& state = *static_cast<Server::State*>(mg_get_user_data(mg_get_context(connection)));
  if (!state.ready) return answer(connection, {503, "text/plain", "not ready\n"}, "Connection: close\r\n", true), 503;
  const bool head = std::string_view(mg_get_request_info(connection)->request_method) == "HEAD";
  const Answer made = respond(state, connection);
  // What was refused may have sent more than was read: the connection is not used again.
  const std::string_view close = made.response.status == 200 ? "" : "Connection: close\r\n";
  if (made.response.status != 200) mg_disable_connection_keep_alive(connection);
  answer(connection, made.response, made.headers + std::string(close), !head);
  return made.response.status;
}

} // namespace

Result<std::unique_ptr<Server>> Server::start(const Listen& listen, Handler handler) {
  std::unique_ptr<Server> server(new Server);
  server->state_ = std::make_unique<State>();
  State& state = *server->state_;
  state.handler = std::move(handler);
  state.server = server.get();
  const bool ipv6 = listen.host.find(':') != std::string::npos;
  const std::string host = listen.host == "localhost" ? "127.0.0.1" : listen.host;
  const std::string port = ipv6 ? fmt::format("[{}]:{}", host, listen.port) : fmt::format("{}:{}", host, listen.port);
  const std::string threads = std::to_string(kThreads);
  const char* options[] = {"listening_ports",
                           port.c_str(),
                           "num_threads",
                           threads.c_str(),
                           "request_timeout_ms",
                           kRequestTimeoutMs,
                           "enable_keep_alive",
                           "yes",
                           "keep_alive_timeout_ms",
                           kKeepAliveMs,
                           "max_request_size",
                           kMostHead,
                           "connection_queue",
                           kMostWaiting,
                           "tcp_nodelay",
                           "1",
                           "enable_directory_listing",
                           "no",
                           nullptr};
  mg_callbacks callbacks{};
  callbacks.begin_request = beginRequest;
  callbacks.log_message = [](const mg_connection*, const char*) { return 1; }; // broken clients are not worth a line
  mg_init_library(0);
  state.context = mg_start(&callbacks, &state, options);
  if (state.context == nullptr)
    return failure(fmt::format("cannot listen on {}: is another program using the port, or is it not an address of "
                               "this computer?",
                               port));
  mg_server_port ports[2]{};
  mg_get_server_ports(state.context, 2, ports);
  state.access.emplace(listen, static_cast<uint16_t>(ports[0].port));
  state.ready = true;
  return server;
}

Server::~Server() {
  if (state_ != nullptr && state_->context != nullptr) mg_stop(state_->context);
}

std::string Server::newLink() { return fmt::format("{}?token={}", state_->access->url(), state_->access->newToken()); }

} // namespace rung::web
