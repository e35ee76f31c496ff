// `rungc run --retain FILE`: what a program and its control keep through power-off, on disk.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "rtlib/nc/control/retention.h"
#include "tools/scenario/session.h"
#include "tools/sim/retained_tables.h"

namespace rung::rungc {

// The program's retained memory and the tables of the NC beside it: taken before the start, saved during the run and at
// its end.
class RetainedFiles final : public scenario::Observer {
public:
  using Report = std::function<void(const std::string& line)>; // for the user

  // The session is configured and has not started; it outlives this.
  RetainedFiles(scenario::Session& session, const std::string& file, bool realTime, Report report);

  // Takes what the files hold and reports what is wrong with them. How the program starts then; nothing, and `error`
  // says why, when they cannot be used.
  std::optional<nc::PowerOn> load(std::string& error);
  void scanned(const scenario::Session& session) override;
  void replaced(const scenario::Session& session, const scenario::NextProgram& next) override;
  // After the last scan; "" or what could not be written.
  std::string finish();

private:
  void reportFailures();

  scenario::Session& session_;
  std::string file_;
  nc::Retention memory_;
  sim::RetainedTables tables_;
  bool realTime_;
  Report report_;
  bool memoryFails_ = false; // and that has been reported
  bool tablesFail_ = false;
};

} // namespace rung::rungc
