// The program's own requests to save its memory (see backup.h).
#include "tools/sim/technol/backup.h"

#include "tools/sim/technol/cells.h"

namespace rung::nc::technol {

void Backup::powerOn(const host::Instance& instance) { request_ = signalPlace(instance, "REQ_BACKUP_MEM"); }

void Backup::behindMain(host::Instance& instance) {
  if (!stored_) saved(instance);
}

} // namespace rung::nc::technol
