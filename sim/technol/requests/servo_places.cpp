// Cells of EtherCAT drives (see servo_places.h).
#include "sim/technol/requests/servo_places.h"

#include <iterator>
#include <string>

#include "rtlib/nc/control/technol/cells.h"

namespace rung::sim::technol {
namespace {

// The servo's number follows.
struct Flag {
  const char* name;
  bool ServoCells::* member;
};
constexpr Flag kFlagNames[] = {{"flEdrvInit", &ServoCells::init},
                               {"flEdrvOn", &ServoCells::on},
                               {"flEdrvEnable", &ServoCells::enable},
                               {"flEdrvDisable", &ServoCells::disable},
                               {"flEdrvDone", &ServoCells::done},
                               {"flEdrvErase", &ServoCells::erase},
                               {"flEdrvSimul", &ServoCells::isSimulated},
                               {"flEdrvError", &ServoCells::isFaulty},
                               {"flEdrvMoveDisReq", &ServoCells::blocksMotion}};
constexpr const char* kWordNames[] = {"wEdrvDriveStatus", "wEdrvDriveErrReg",  "wEdrvDriveControl",
                                      "bEdrvState",       "dwEdrvDrivePosReq", "dwEdrvDriveVeloReq"};

} // namespace

ServoPlaces::ServoPlaces(const rung_program& program) {
  static_assert(std::size(kFlagNames) == kFlags && std::size(kWordNames) == kWords);
  for (uint32_t servo = 0; servo < EthercatServos::kCount; ++servo) {
    const std::string number = std::to_string(servo);
    for (uint32_t i = 0; i < kFlags; ++i)
      flags_[servo][i] = nc::technol::locateSignal(program, kFlagNames[i].name + number);
    for (uint32_t i = 0; i < kWords; ++i) words_[servo][i] = nc::technol::locateSignal(program, kWordNames[i] + number);
    position_[servo] = nc::technol::locateSignal(program, "dwEdrvDrivePos" + number);
    velocityScale_[servo] = nc::technol::locateSignal(program, "rEdrvScaleSpeed" + number);
  }
  nc::technol::locateElements(program, "DIFCIT_X", followingError_);
  nc::technol::locateElements(program, "ServoReqPosition", requested_);
  nc::technol::locateElements(program, "ServoPosition", measured_);
  nc::technol::locateElements(program, "SERVO_POSITION", increments_);
}

void ServoPlaces::read(const core::Memory& memory, EthercatServos::Cells& servos) const {
  for (uint32_t servo = 0; servo < servos.size(); ++servo) {
    for (uint32_t i = 0; i < kFlags; ++i) servos[servo].*kFlagNames[i].member = memory.read(flags_[servo][i]) != 0;
    servos[servo].status = static_cast<uint16_t>(memory.read(words_[servo][0]));
    servos[servo].error = static_cast<uint16_t>(memory.read(words_[servo][1]));
    servos[servo].position = static_cast<int32_t>(memory.readSigned(position_[servo]));
    servos[servo].velocityScale = memory.readReal(velocityScale_[servo]);
  }
}

void ServoPlaces::write(const core::Memory& memory, const EthercatServos::Cells& servos) const {
  for (uint32_t servo = 0; servo < servos.size(); ++servo) {
    const ServoCells& cells = servos[servo];
    if (!cells.exists()) continue;
    for (uint32_t i = 0; i < kFlags; ++i) memory.write(flags_[servo][i], cells.*kFlagNames[i].member ? 1 : 0);
    const uint64_t numbers[] = {cells.status,
                                cells.error,
                                cells.control,
                                static_cast<uint64_t>(cells.state),
                                static_cast<uint64_t>(cells.requestedPosition),
                                static_cast<uint64_t>(cells.requestedVelocity)};
    for (uint32_t i = 0; i < kWords; ++i) memory.write(words_[servo][i], numbers[i]);
    for (const OfServos* places : {&position_, &increments_})
      memory.write((*places)[servo], static_cast<uint64_t>(cells.position));
    memory.write(measured_[servo], static_cast<uint64_t>(cells.micrometres(cells.position)));
    memory.write(requested_[servo], static_cast<uint64_t>(cells.micrometres(cells.requestedPosition)));
    memory.write(followingError_[servo], static_cast<uint64_t>(cells.micrometres(cells.followingError())));
  }
}

} // namespace rung::sim::technol
