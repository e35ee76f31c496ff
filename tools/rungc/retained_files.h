// `rungc run --retain FILE`: what a program and its control keep through power-off, on disk.
#pragma once
#include <functional>
#include <string>

#include "sim/retained_tables.h"
#include "tools/scenario/session.h"

namespace rung::rungc {

// The program's retained memory, which the library keeps, and the tables of the NC beside it: taken before the start,
// saved during the run and at its end.
class RetainedFiles final : public scenario::Observer {
public:
  using Report = std::function<void(const std::string& line)>; // for the user

  // The session is configured and has not started; it outlives this. What the files hold is reported at its warm start.
  RetainedFiles(scenario::Session& session, const std::string& file, Report report);

  // The tables: "", or why their files cannot be used. What is wrong with their contents is reported.
  std::string load();
  void scanned(const scenario::Session& session) override;
  // After the last scan; "" or what could not be written.
  std::string finish();

private:
  void reportFailures();

  scenario::Session& session_;
  std::string file_;
  sim::RetainedTables tables_;
  Report report_;
  bool memoryFails_ = false; // and that has been reported
  bool tablesFail_ = false;
};

} // namespace rung::rungc
