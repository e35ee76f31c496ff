// Prints what watched names become, which messages come and go, each with the time, and the lines of print statements.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tools/scenario/names.h"
#include "tools/scenario/session.h"

namespace rung::console {

using Print = std::function<void(const std::string& line)>; // a line without its end, or several

class Watch final : public scenario::Observer {
public:
  explicit Watch(Print print) : print_(std::move(print)) {}

  // "" or why the name cannot be watched. Its first value is printed at the next look.
  std::string add(const std::string& name, const scenario::Session& session);
  // False: it is not watched.
  bool remove(const std::string& name);
  std::vector<std::string> names() const;

  void scanned(const scenario::Session& session) override { look(session); }
  void replaced(const scenario::Session& session, const scenario::NextProgram& next) override;
  void printed(const std::string& line) override { print_(line); }
  // Prints what has changed since the last look.
  void look(const scenario::Session& session);

private:
  struct Watched {
    scenario::NamedValue value;
    std::string last;
  };
  void printMessages(const scenario::Session& session);

  Print print_;
  std::vector<Watched> watched_;
  std::vector<nc::ShownMessage> shown_;
  bool otherTexts_ = false; // perhaps: another program has taken over
};

} // namespace rung::console
