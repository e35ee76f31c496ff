// The program's own requests to save its memory (see backup.h).
#include "rtlib/nc/control/technol/backup.h"

#include "rtlib/nc/control/technol/cells.h"

namespace rung::nc::technol {

void Backup::locate(const host::Instance& instance) {
  const std::optional<host::Ref> place = signalPlace(instance.program(), "REQ_BACKUP_MEM");
  request_ = place ? host::locate(instance.memory(), *place) : rt::Place();
}

void Backup::afterMain(host::Instance& instance) {
  if (!stored_) saved(instance);
}

} // namespace rung::nc::technol
