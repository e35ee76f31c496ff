// The HTTP server of the page. It uses civetweb, which nothing else includes.
//
// Nothing queues: a page asks for the next picture when it has drawn the last one, and each answer is written by the
// thread of its connection, which gives up on a client that does not read.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "ir/support/result.h"
#include "tools/web/access.h"

namespace rung::web {

struct Request {
  bool post = false;
  std::string path; // "/", "/api/index"
  std::string query;
  std::string body;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
};

class Server;

// Called by several threads at a time, for requests that may be answered. An exception becomes an answer of status 500.
using Handler = std::function<Response(const Request& request, Server& by)>;

class Server {
public:
  static constexpr size_t kMostBody = size_t{64} << 10; // bytes of a request
  static constexpr int kThreads = 24;                   // connections that are served at a time

  // Listens until it is destroyed. Fails if the address cannot be used. `handler` is called before this returns, too.
  static Result<std::unique_ptr<Server>> start(const Listen& listen, Handler handler);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // A link that opens the page in one browser.
  std::string newLink();

  struct State;

private:
  Server() = default;
  std::unique_ptr<State> state_;
};

} // namespace rung::web
