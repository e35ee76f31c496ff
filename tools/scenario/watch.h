// Prints what watched names become, which messages come and go, each with the time, and the lines of print statements.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tools/scenario/names.h"
#include "tools/scenario/session.h"

namespace rung::scenario {

using Print = std::function<void(const std::string& line)>; // a line without its end, or several

class Watch final : public Observer {
public:
  explicit Watch(Print print) : print_(std::move(print)) {}

  // "" or why the name cannot be watched. Its first value is printed at the next look.
  std::string add(const std::string& name, const Session& session);
  // False: it is not watched.
  bool remove(const std::string& name);
  std::vector<std::string> names() const;

  void scanned(const Session& session) override { look(session); }
  void replaced(const Session& session, const NextProgram& next) override;
  void printed(const std::string& line) override { print_(line); }
  // Prints what has changed since the last look.
  void look(const Session& session);

private:
  struct Watched {
    NamedValue value;
    std::string last;
  };
  void printMessages(const Session& session);

  Print print_;
  std::vector<Watched> watched_;
  std::vector<nc::ShownMessage> shown_;
  bool otherTexts_ = false; // perhaps: another program has taken over
};

} // namespace rung::scenario
