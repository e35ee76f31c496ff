// PLC axis control of the simulated CNC: the groups A-H take blocks from G, buffer and execute them on the axes that
// parameter 7010 gives them and EAX hands over (man. §9.2, l.7566-8289).
#pragma once
#include <array>
#include <optional>

#include "rtlib/nc/gsk/axis_commands.h"
#include "tools/sim/gsk/machine.h"

namespace rung::sim::gsk {

class PlcAxes {
public:
  void step(const nc::gsk::SignalsIo& io, Machine& machine, bool emergencyStop);

private:
  struct Command {
    uint8_t code = 0;
    bool noStop = false; // EMSBK
    uint16_t data1 = 0;
    int32_t data2 = 0;
  };
  enum class AuxPhase : uint8_t { None, Code, Strobe, EfinFalls };
  // What runs and the two buffers before it (l.7675-7686).
  struct Group {
    std::optional<Command> executing, waiting, input;
    uint8_t axes = 0; // bit n-1
    bool ebsy = false;
    bool begun = false;
    bool blockStop = false; // ESBK holds the next block
    bool alarm = false;
    bool pausing = false;
    std::array<int64_t, kAxes> target = {};
    double dwellMs = 0;
    AuxPhase aux = AuxPhase::None;
    bool busy() const { return executing || waiting || input; }
  };
  struct Step; // a group's part of a slot

  void assign(const nc::gsk::SignalsIo& io, Machine& machine);
  void clear(Group& group, const nc::gsk::AxisGroup& place, const nc::gsk::SignalsIo& io, Machine& machine);
  void take(Step& step);
  void shift(Step& step, const Command& ended);
  void execute(Step& step);
  void begin(Step& step, const Command& command);
  bool runMotion(Step& step, const Command& command);
  bool runContinuous(Step& step, const Command& command);
  bool runAuxiliary(Step& step, const Command& command);
  double speed(const Step& step, const Command& command, uint32_t axis) const;
  double cuttingOverride(const Step& step) const;
  void writeGroup(Step& step);
  void writeCommon(const nc::gsk::SignalsIo& io, const Machine& machine);

  std::array<Group, nc::gsk::kAxisGroups> groups_;
  bool selected_ = false; // *EAXSL of the last slot
};

} // namespace rung::sim::gsk
