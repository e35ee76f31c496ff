// The program's own requests to save its memory (see backup.h).
#include "rtlib/nc/control/technol/backup.h"

#include "rtlib/nc/control/technol/cells.h"

namespace rung::nc::technol {

core::Place Backup::locate(const rung_program& program) { return locateSignal(program, "REQ_BACKUP_MEM"); }

void Backup::afterMain(runtime::Instance& instance) {
  if (!stored_) saved(instance);
}

} // namespace rung::nc::technol
