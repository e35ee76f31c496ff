// Logical inputs and outputs of modules (man. ch. 27.2-27.4): real-time manager (RTM), EtherCAT (ECAT), virtual
// keyboard (VKeyboard). Each is a cell that stores its last value; if no simulated device uses it, a scenario can play
// the module through its name.
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

// The value of a simulated device at an element.
struct ModulePoint {
  enum class Kind : uint8_t {
    None,
    Key,         // `number`: the scan code on the virtual keyboard
    ProcessData, // `number`: the entry of the process image
    Position,    // `number`: the axis, from 0; `part`: the space, 0 to 6
    Shift,       // `number`: the axis, from 0; the SHIFT value in POS6
    Increment,   // `number`: the axis, from 0; `part`: AxisIncrement
    Servo,       // `number`: the servo; `part`: ServoPart
    Shared,      // a cell of the program: `number` in row `part` of kSharedElements
  } kind = Kind::None;
  uint32_t number = 0;
  uint32_t part = 0;

  template <class Archive>
  void state(Archive& archive) {
    archive(kind, number, part);
  }
};
// The inputs of a servo, then its outputs.
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
  kFollowingErrorMm, // the following ones in millimetres, micrometres, increments
  kFollowingErrorUm,
  kMeasuredMm,
  kMeasuredUm,
  kMeasuredIncrements,
  kRequestedMm,
  kRequestedUm
};
// Speeds along the path in a space; T is a millisecond (man. l.2664, l.12764-12868).
enum AxisIncrement : uint32_t {
  kPerTick,
  kPerMinute,
  kByHand,
  kPath5PerTick,
  kPath6PerTick,
  kPath5PerMinute,
  kPath6PerMinute
};

// Elements that are cells of the program under another name: both always have the same value.
struct SharedElement {
  std::string_view area, element; // as in the signals
  std::string_view cell;          // for a servo, followed by its number
};
inline constexpr SharedElement kSharedElements[] = {
    {"RTM.Axis", "ReqShift", "REQ_ESHIFT"},               // l.10882, l.12760
    {"RTM.Axis", "ActShift", "ACT_ESHIFT"},               // l.10885, l.12761
    {"RTM.Axis", "KnobStep", "KNOB_STEP"},                // l.11054, l.12798
    {"RTM.Axis", "ShiftEnable_Ax", "SHIFT_ENABLE"},       // l.11056, l.12762; one bit per axis
    {"RTM.Servo.Edrv", "Simul", "flEdrvSimul"},           // l.10378, l.12894
    {"RTM.Servo.Edrv", "Init", "flEdrvInit"},             // l.10360, l.12896
    {"RTM.Servo.Edrv", "On", "flEdrvOn"},                 // l.10362, l.12904
    {"RTM.Servo.Edrv", "Enable", "flEdrvEnable"},         // l.10365, l.12900
    {"RTM.Servo.Edrv", "Disable", "flEdrvDisable"},       // l.10368, l.12902
    {"RTM.Servo.Edrv", "Done", "flEdrvDone"},             // l.10371, l.12898
    {"RTM.Servo.Edrv", "Erase", "flEdrvErase"},           // l.10374, l.12906
    {"RTM.Servo.Edrv", "ScaleSpeed", "rEdrvScaleSpeed"}}; // l.10376, l.12920

struct ModuleElement {
  std::string key; // the same for all spellings of an element
  nc::ExchangeType type = nc::ExchangeType::Bit;
  bool typeIsOpen = false; // EtherCAT: the type is that of the other end of the connection
  bool signIsOpen = false; // process data: the sign is that of the other end
  nc::ExchangePeriod period = nc::ExchangePeriod::Fast;
  bool isSource = true, isDestination = true;
  ModulePoint point = {};
};

// Finds an element by its canonical identifier, without `.Bit[k]`, without simulated devices. Nothing: no such element;
// `problem` has the reason if the module is known.
std::optional<ModuleElement> moduleElement(std::string_view identifier, std::string& problem);

struct ModuleCell {
  nc::ExchangeType type = nc::ExchangeType::Bit;
  bool typeIsOpen = false;
  uint64_t bits = 0;  // in the cell's type; a bit is 0 or 1
  uint64_t given = 0; // last value set by a device

  template <class Archive>
  void state(Archive& archive) {
    archive(typeIsOpen, bits, given);
    archive.atMost(type, static_cast<uint64_t>(nc::ExchangeType::Binary));
  }
};

class ModuleCells {
public:
  // Adds the elements of a simulated EtherCAT network's image, which must outlive the cells.
  void simulate(const EthercatImage& image) { image_ = &image; }
  // Like moduleElement, but including the simulated network.
  std::optional<ModuleElement> element(std::string_view identifier, std::string& problem) const;

  void reset(); // sets all cells to 0
  // Adds cells for the elements of kSharedElements, whether or not they are connected.
  void addShared();
  // Returns the number of the cell, which stays valid while a table of connections uses it.
  uint32_t cellOf(const ModuleElement& element);
  ModuleCell& at(uint32_t cell) { return cells_[cell]; }
  const ModuleCell& at(uint32_t cell) const { return cells_[cell]; }

  // The cells that a simulated device may use.
  struct PointCell {
    ModulePoint point{};
    uint32_t cell = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(point, cell);
    }
  };
  std::span<const PointCell> points() const { return points_; }

  // Access by any identifier. Nothing, false: no such element.
  std::optional<NcCell> read(std::string_view name) const;
  bool write(std::string_view name, const NcCell& value);

  template <class Archive>
  void state(Archive& archive) {
    archive(keys_, cells_, points_);
  }
  // After loading. False: there cannot be such cells; then there are none.
  bool settle();

private:
  bool isPossible(const PointCell& point) const;

  const EthercatImage* image_ = nullptr;
  std::vector<ModuleCell> cells_;
  std::vector<std::string> keys_; // of the cells
  std::vector<PointCell> points_;
  std::unordered_map<std::string, uint32_t> byKey_;
};

} // namespace rung::sim::technol
