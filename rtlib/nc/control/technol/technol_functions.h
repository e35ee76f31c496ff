// M, S, T and H functions of TECHNOL: a function is a block of the part program without motion. The control writes its
// code and its change bit into the command block (man. l.6682-6968, 6978-7136) and sends the block through
// MODULE_BLOCK_INIT and MODULE_BLOCK_DONE (blocks.h); the function is finished when the block is. Blocks are executed
// one after the other, so functions are, too (l.2682-2711). Reset and emergency stop cause the central annulment
// (Blocks::annul). A key is a PLCCommand of the control's configuration: _ON_CMD is called when it is pressed, and in
// the next scan for its release (l.1614-1624). Scan thread.
#pragma once
#include <array>

#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/technol/blocks.h"
#include "rtlib/nc/control/technol/cells.h"

namespace rung::nc {

class TechnolFunctions final : public Functions {
  static constexpr uint32_t kMostM = 99;
  static constexpr uint32_t kGroups = 14; // groups of M functions, from 1
  static constexpr uint32_t kDecoded = 21;
  static constexpr uint32_t kMostValues = 16; // values of a block
  static constexpr uint32_t kBlockLine = 0, kKeyLine = 1;
  enum class Key : uint8_t { None, Waits, Pressed };

  struct Group {
    core::Place changed, code;           // ZMMxPI; PBxx
    core::Place blockChanged, blockCode; // BLK[0].Mx, BLK[0].M[x]
  };

public:
  // The places of the cells in one program.
  class Places {
  public:
    Places() = default; // a program without these cells
    explicit Places(const rung_program& program);

  private:
    friend class TechnolFunctions;
    core::Place automatic; // AUTPI
    std::array<Group, kGroups + 1> groups;
    std::array<core::Place, kDecoded> decoded;
    core::Place speedChanged, speed;
    core::Place toolChanged, blockToolChanged, blockTool;
    technol::Procedure onCommand;
    core::Place hChanged, blockHChanged, hCode, blockH;
    std::array<core::Place, 4> toolDigits;
  };

  // The blocks outlive this object.
  explicit TechnolFunctions(technol::Blocks& blocks);

  // Sets the places of the running program. Instance and places outlive their use.
  void use(runtime::Instance& instance, const Places& places) {
    instance_ = &instance;
    places_ = &places;
  }

  template <class Archive>
  void state(Archive& archive) { // groups are of the configuration
    archive(key_, keyCode_);
  }

  // At power-on: no key is pressed.
  void reset() { key_ = Key::None; }
  // The attribute GroupNo of the control's configuration: groups 1 to 14, but not for functions to which the control
  // itself assigns a group (l.7184-7214).
  bool setGroup(uint32_t code, uint32_t group) override;
  // M and H up to 99, T up to 99999999, which fit in their BCD cells. No B: the command block has no second auxiliary
  // function.
  bool supports(FunctionKind kind, uint32_t code) const override;
  std::optional<uint32_t> start(FunctionKind kind, uint32_t code) override;
  void step() override;
  bool busy(uint32_t line) const override { return line == kKeyLine ? key_ != Key::None : blocks_.busy(); }
  void abort() override { blocks_.annul(*instance_); }

private:
  // The values that a block writes.
  struct Values {
    std::array<technol::CommandValue, kMostValues> all;
    uint32_t count = 0;

    void add(const core::Place& place, int64_t value) { all[count++] = {.place = place, .integer = value}; }
    void addReal(const core::Place& place, double value) {
      all[count++] = {.place = place, .isReal = true, .real = value};
    }
  };

  void addM(Values& values, uint32_t code) const;
  void addSpeed(Values& values, uint32_t code) const;
  void addTool(Values& values, uint32_t code) const;
  void addH(Values& values, uint32_t code) const;
  std::optional<uint32_t> press(uint32_t code);

  static const Places kNothing;

  technol::Blocks& blocks_;
  runtime::Instance* instance_ = nullptr;
  const Places* places_ = &kNothing;
  std::array<uint8_t, kMostM + 1> groupOfM_ = {}; // by code
  Key key_ = Key::None;
  uint32_t keyCode_ = 0;
};

} // namespace rung::nc
