// Cells in the hidden space @REG, shared by host and program.
#pragma once

#include <cstdint>
#include <string_view>

#include "ir/core/type.h"

namespace rung::frontend::technol {

// @DR, @RLO: registers at the start of INIT, DONE and of event procedures. @BLOCK_x.CONT: state of a block module, 0 at
// its beginning; @BLOCK_x.DONE: it has finished (the host clears it). @INIT.PENDING, @DONE.PENDING: a bit for each file
// that has yet to execute MODULE_INIT_FINISHED or MODULE_DONE_FINISHED. @LICENCES: a bit for each licence of the
// hardware key (rtlib/nc/technol/services.h). @ANALOG.PORT: that of the last ANALOG_PORT, 0 before the first.
// @POS.CONTROL: by axis, the control record of the last POS_MODE as bytesArgument (rtlib/nc/technol/services.h).
enum class HostCell : uint8_t {
  Dr,
  Rlo,
  BlockInitCont,
  BlockInitDone,
  BlockDoneCont,
  BlockDoneDone,
  InitPending,
  DonePending,
  Licences,
  AnalogPort,
  PositionControl,
};
struct HostCellInfo {
  std::string_view name;
  ir::Type type;
  uint32_t byte;
  uint32_t count = 1;
};
const HostCellInfo& hostCell(HostCell cell);
inline constexpr int kHostCells = 11;

} // namespace rung::frontend::technol
