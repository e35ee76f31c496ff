// `rungc run --retain FILE`: stores the retained memory of a program and its control on disk.
#pragma once
#include <functional>
#include <string>

#include "sim/retained_tables.h"
#include "tools/scenario/session.h"

namespace rung::rungc {

// The program's retained memory, which the library stores, and the tables of the NC beside it: loaded before the start,
// saved during the run and at its end.
class RetainedFiles final : public scenario::Observer {
public:
  using Report = std::function<void(const std::string& line)>; // prints a line for the user

  // The session is configured and has not started; it must outlive this object. The contents of the files are reported
  // at the warm start.
  RetainedFiles(scenario::Session& session, const std::string& file, Report report);

  // Loads the tables. "" or why their files cannot be used; mistakes in their contents are reported.
  std::string load();
  void scanned(const scenario::Session& session) override;
  // Saves after the last scan. "" or what could not be written.
  std::string finish();

private:
  void reportFailures();

  scenario::Session& session_;
  std::string file_;
  sim::RetainedTables tables_;
  Report report_;
  bool memoryFails_ = false; // saving failed, and that has been reported
  bool tablesFail_ = false;
};

} // namespace rung::rungc
