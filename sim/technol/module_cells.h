// Logical inputs and outputs of modules (man. ch. 27.2-27.4): real-time manager (RTM), EtherCAT (ECAT), virtual
// keyboard (VKeyboard). Each is a cell that keeps what is put into it; where no simulated device works at it, a
// scenario plays the module by these names.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rtlib/nc/technol/exchange.h"
#include "sim/simulated_nc.h"
#include "sim/technol/devices/ethercat_slaves.h"

namespace rung::sim::technol {

// What a simulated device has at an element.
struct ModulePoint {
  enum class Kind : uint8_t {
    None,
    Key,         // `number` is the scan code on the virtual keyboard
    ProcessData, // the entry of the process image
    Position,    // the axis, from 0, in the space `part`, 0 to 6
    Shift,       // the axis, from 0: what SHIFT adds in POS6
    Increment,   // the axis, from 0; its AxisIncrement
    Servo,       // the servo; its ServoPart
    Shared,      // a cell of the program: `number` of the row `part` of kSharedElements
  } kind = Kind::None;
  uint32_t number = 0;
  uint32_t part = 0;
};
// What a servo is given, then what it gives.
enum ServoPart : uint32_t {
  kServoStatus,
  kServoError,
  kServoPosition,
  kServoInputs,
  kServoControl = kServoInputs,
  kServoRequestedPosition,
  kServoRequestedVelocity,
  kServoState,
  kServoBlocksMotion,
  kServoFaulty,
  kFollowingErrorMm, // the rest in millimetres, micrometres, increments
  kFollowingErrorUm,
  kMeasuredMm,
  kMeasuredUm,
  kMeasuredIncrements,
  kRequestedMm,
  kRequestedUm
};
// Of the path in a space; T is a millisecond (man. l.2664, l.12764-12868).
enum AxisIncrement : uint32_t {
  kPerTick,
  kPerMinute,
  kByHand,
  kPath5PerTick,
  kPath6PerTick,
  kPath5PerMinute,
  kPath6PerMinute
};

// Elements that are cells of the program under another name: what is put at one is at the other.
struct SharedElement {
  std::string_view area, element; // as the signals have them
  std::string_view cell;          // of a servo, its number follows
};
inline constexpr SharedElement kSharedElements[] = {
    {"RTM.Axis", "ReqShift", "REQ_ESHIFT"},               // l.10882, l.12760
    {"RTM.Axis", "ActShift", "ACT_ESHIFT"},               // l.10885, l.12761
    {"RTM.Axis", "KnobStep", "KNOB_STEP"},                // l.11054, l.12798
    {"RTM.Axis", "ShiftEnable_Ax", "SHIFT_ENABLE"},       // l.11056, l.12762; a bit an axis
    {"RTM.Servo.Edrv", "Simul", "flEdrvSimul"},           // l.10378, l.12894
    {"RTM.Servo.Edrv", "Init", "flEdrvInit"},             // l.10360, l.12896
    {"RTM.Servo.Edrv", "On", "flEdrvOn"},                 // l.10362, l.12904
    {"RTM.Servo.Edrv", "Enable", "flEdrvEnable"},         // l.10365, l.12900
    {"RTM.Servo.Edrv", "Disable", "flEdrvDisable"},       // l.10368, l.12902
    {"RTM.Servo.Edrv", "Done", "flEdrvDone"},             // l.10371, l.12898
    {"RTM.Servo.Edrv", "Erase", "flEdrvErase"},           // l.10374, l.12906
    {"RTM.Servo.Edrv", "ScaleSpeed", "rEdrvScaleSpeed"}}; // l.10376, l.12920

struct ModuleElement {
  std::string key; // one an element, whichever way it is written
  nc::ExchangeType type = nc::ExchangeType::Bit;
  bool typeIsOpen = false; // EtherCAT: the type is that of the other end
  bool signIsOpen = false; // of process data, whether the integer is signed
  nc::ExchangePeriod period = nc::ExchangePeriod::Fast;
  bool isSource = true, isDestination = true;
  ModulePoint point = {};
};

// By a canonical identifier, without `.Bit[k]`, without simulated devices. Nothing: no such element; `problem`
// says why where the module is known.
std::optional<ModuleElement> moduleElement(std::string_view identifier, std::string& problem);

struct ModuleCell {
  nc::ExchangeType type = nc::ExchangeType::Bit;
  bool typeIsOpen = false;
  uint64_t bits = 0;  // of the type; a bit is 0 or 1
  uint64_t given = 0; // what a device has put there last
};

class ModuleCells {
public:
  // A simulated EtherCAT net, whose slaves' elements are those of its image. It outlives the cells.
  void simulate(const EthercatImage& image) { image_ = &image; }
  // As moduleElement, and of the simulated net.
  std::optional<ModuleElement> element(std::string_view identifier, std::string& problem) const;

  void reset(); // all cells 0
  // Cells for the elements of kSharedElements, whether or not they are connected.
  void addShared();
  // Cells stay where they are while a table of connections holds their numbers.
  uint32_t cellOf(const ModuleElement& element);
  ModuleCell& at(uint32_t cell) { return cells_[cell]; }
  const ModuleCell& at(uint32_t cell) const { return cells_[cell]; }

  // Those at which a simulated device may work.
  struct PointCell {
    ModulePoint point{};
    uint32_t cell = 0;
  };
  std::span<const PointCell> points() const { return points_; }

  // By any identifier. Nothing: no such element.
  std::optional<NcCell> read(std::string_view name) const;
  bool write(std::string_view name, const NcCell& value);

private:
  const EthercatImage* image_ = nullptr;
  std::vector<ModuleCell> cells_;
  std::vector<PointCell> points_;
  std::unordered_map<std::string, uint32_t> byKey_;
};

} // namespace rung::sim::technol
