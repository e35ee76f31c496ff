// REQ_BACKUP_MEM: the program requests saving of PLC_MEM_BACKUP; the control resets the bit when it is done (man.
// l.7549-7568, l.13500-13518). Scan thread.
#pragma once
#include "rtlib/run/instance.h"

namespace rung::nc::technol {

class Backup {
public:
  // Whether the host stores the memory on disk; if not, requests are done at once.
  void setStored(bool stored) { stored_ = stored; }
  // The place of REQ_BACKUP_MEM in a program; `use` sets that of the running program.
  static core::Place locate(const rung_program& program);
  void use(const core::Place& request) { request_ = request; }
  void afterMain(runtime::Instance& instance);
  bool asked(const runtime::Instance& instance) const { return instance.memory().read(request_) != 0; }
  void saved(runtime::Instance& instance) { instance.memory().write(request_, 0); }

private:
  bool stored_ = false;
  core::Place request_;
};

} // namespace rung::nc::technol
