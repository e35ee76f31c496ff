// `rungc run --retain FILE`: what a program and its control keep through power-off, on disk.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "rtlib/host/retained_memory.h"
#include "tools/scenario/session.h"
#include "tools/sim/retained_tables.h"

namespace rung::rungc {

// The program's retained memory and the tables of the NC beside it: taken before the start, saved during the run and at
// its end.
class RetainedFiles final : public scenario::Observer {
public:
  // The session is configured and has not started; it outlives this.
  RetainedFiles(scenario::Session& session, const std::string& file, bool realTime);

  // Takes what the files hold and says on standard error what is wrong with them. How the program starts then; nothing,
  // and `error` says why, when they cannot be used.
  std::optional<nc::PowerOn> load(std::string& error);
  void scanned(const scenario::Session& session) override;
  // After the last scan; "" or what could not be written.
  std::string finish();

private:
  void saveOnRequest();

  scenario::Session& session_;
  host::RetainedMemory memory_;
  sim::RetainedTables tables_;
  bool realTime_;
  bool saving_ = false;   // an image that the program asked for is being written
  uint64_t failures_ = 0; // before it
};

} // namespace rung::rungc
