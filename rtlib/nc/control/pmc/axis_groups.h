// PMC axis control (GSK's man. §9.2, l.7566-8289): the groups take blocks from G by EBUF and EBSY, buffer them, execute
// them in order and answer in F. Dwells and the handshake of auxiliary functions are handled here; axes are moved by a
// Mover: the simulated CNC or that of the host.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "rtlib/nc/control/pmc/signals_io.h"
#include "rtlib/nc/pmc/model.h"

namespace rung::nc {

class PmcAxisGroups {
public:
  static constexpr uint32_t kAxes = 8;
  static constexpr uint32_t kSlotMs = 8;

  struct Command {
    uint8_t code = 0;
    bool noStop = false; // EMSBK
    uint16_t data1 = 0;
    int32_t data2 = 0;
    template <class Archive>
    void state(Archive& archive) {
      archive(code, noStop, data1, data2);
    }
  };
  enum class Progress : uint8_t { UnderWay, Over, Failed };
  struct Motion {
    bool moving = false;
    bool stopping = false; // after `stop`: no motion can begin
    bool unknown = false;  // its state is not known: it does not count as stopped
    bool lost = false;     // it was moving when its state was lost
    bool overPositive = false, overNegative = false;
  };

  // Moves axes. In a set of axes bit n-1 is axis n.
  class Mover {
  public:
    virtual ~Mover() = default;
    // Parameter 7010: the group of an axis, from 0; nothing: the program never commands it.
    virtual std::optional<uint32_t> groupOf(uint32_t axis) const = 0;
    virtual bool movesForCnc(uint32_t axis) const { return (void)axis, false; }
    virtual void assigned(uint32_t axis, bool toProgram) { (void)axis, (void)toProgram; }
    // Alarm 311: an axis was assigned to the program or the CNC at the wrong time (l.7817).
    virtual void raiseAssignment() {}

    // Begins a command. False: it raises an alarm of the group.
    virtual bool begin(uint8_t axes, const Command& command) = 0;
    // The data of the running command have changed.
    virtual void change(uint8_t axes, const Command& command) { (void)axes, (void)command; }
    virtual Progress move(uint8_t axes, const Command& command) = 0;
    virtual void pause(uint8_t axes) { (void)axes; }
    // `cleared`: by ECLR, which ends an over-travel, too (l.8122).
    virtual void stop(uint8_t axes, bool cleared) = 0;
    virtual Motion look(uint8_t axes) const = 0;
  };

  // The model outlives it.
  explicit PmcAxisGroups(const pmc::Model& model) : model_(&model) {}

  // Runs one slot. Groups that are not `served` (bit n-1) and their signals are left alone.
  void step(const pmc::SignalsIo& io, Mover& mover, uint8_t served, bool emergencyStop);

  template <class Archive>
  void state(Archive& archive) {
    archive(groups_, selected_);
  }

private:
  enum class AuxPhase : uint8_t { None, Code, Strobe, EfinFalls };
  // A group: the executing command and the two buffers before it (l.7675-7686).
  struct Group {
    std::optional<Command> executing, waiting, input;
    uint8_t axes = 0; // bit n-1
    bool ebsy = false;
    bool begun = false;
    bool blockStop = false; // ESBK holds the next block
    bool alarm = false;
    bool pausing = false;
    int64_t dwellMs = 0;
    AuxPhase aux = AuxPhase::None;
    bool busy() const { return executing || waiting || input; }
    template <class Archive>
    void state(Archive& archive) {
      archive(executing, waiting, input, axes, ebsy, begun, blockStop, alarm, pausing, dwellMs, aux);
    }
  };
  struct Step; // the work of one group in a slot

  void assign(const pmc::SignalsIo& io, Mover& mover, uint8_t served);
  static void clear(const Step& step);
  static void take(const Step& step);
  static void shift(const Step& step, const Command& ended);
  static void execute(const Step& step);
  static void begin(const Step& step, const Command& command);
  static bool isOver(const Step& step, const Command& command);
  static bool runAuxiliary(const Step& step, const Command& command);
  static void writeGroup(const Step& step);
  void writeCommon(const pmc::SignalsIo& io, const Mover& mover);

  uint32_t count() const { return static_cast<uint32_t>(model_->axisGroups.size()); }

  const pmc::Model* model_;
  std::array<Group, pmc::kMostAxisGroups> groups_;
  bool selected_ = false; // *EAXSL of the last slot
};

} // namespace rung::nc
