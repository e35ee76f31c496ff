// The page's requests: what is asked of a program and of its source, as JSON (docs/live-page.md).
#pragma once
#include <functional>
#include <string>

#include "tools/web/server.h"
#include "tools/web/source.h"

namespace rung::web {

class Page {
public:
  // The source must outlive it.
  explicit Page(Source& source) : source_(source) {}

  // `newLink`: see Server. Any thread.
  Response respond(const Request& request, const std::function<std::string()>& newLink);

private:
  Response index(const Request& request) const;
  static Response rungs(const Request& request, const ShownProgram& program);
  static Response names(const ShownProgram& program);
  Response picture(const Request& request);
  Response events(const Request& request);
  Response why(const Request& request);
  Response trace(const Request& request);
  Response shares(const Request& request);
  Response order(const Request& request);

  Source& source_;
};

} // namespace rung::web
