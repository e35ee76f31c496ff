// The page's requests: what is asked of a program and of its source, as JSON (docs/live-page.md).
#pragma once
#include <functional>
#include <string>

#include "tools/web/server.h"
#include "tools/web/shown_program.h"
#include "tools/web/source.h"

namespace rung::web {

class Page {
public:
  // Both must outlive it.
  Page(const ShownProgram& program, Source& source) : program_(program), source_(source) {}

  // `newLink`: see Server. Any thread.
  Response respond(const Request& request, const std::function<std::string()>& newLink);

private:
  Response index(const Request& request) const;
  Response rungs(const Request& request) const;
  Response names() const;
  Response picture(const Request& request);
  Response events(const Request& request);
  Response why(const Request& request);
  Response trace(const Request& request);
  Response shares(const Request& request);
  Response order(const Request& request);

  const ShownProgram& program_;
  Source& source_;
};

} // namespace rung::web
