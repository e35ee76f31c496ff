// The NC beside a TECHNOL PLC: start and stop of the program, the flow of part-program blocks through MODULE_BLOCK_INIT
// and MODULE_BLOCK_DONE, messages (inventory §12, §13, §25).
#include "rtlib/host/program_info.h"
#include "rtlib/nc/model/nc_model.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::nc {
namespace {

constexpr const char* kInterfaceArea = "I";
constexpr const char* kInterfaceSpace = "NCI";
constexpr int kShutdownScans = 500; // at most, while MODULE_DONE_FINISHED is owed (§25)

enum class BlockPhase : uint8_t { Idle, Starting, Init, Motion, Done };

class TechnolModel final : public NcModel {
public:
  // Memory zeroed, interface presets, MODULE_INIT with DR = 0 (§12.3).
  void powerOn(host::Instance& instance, PowerOn kind) override {
    NcModel::powerOn(instance, kind);
    instance.setStopped(false);
    phase_ = BlockPhase::Idle;
    motionDone_ = stopping_ = false;
    blockSignals_.clear();
    runModule(instance, "INIT", 0);
    board_.take(instance);
  }

  // MODULE_DONE with DR = 0; where MODULE_DONE_FINISHED is used, scans until it has been executed.
  void powerOff(host::Instance& instance) override {
    runModule(instance, "DONE", 0);
    for (int i = 0; i < kShutdownScans && bit(instance, "@DONE.OWED"); ++i) scan(instance);
  }

  // Hook 1 stands behind MODULE_INPUT: the supervisor of blocks.
  void onHook(host::Instance& instance, uint32_t work) override {
    if (work == 1) supervise(instance);
  }

  void onFault(host::Instance& instance) override { instance.runTask("HALT"); }

  void scan(host::Instance& instance) override {
    NcModel::scan(instance);
    if (stopping_ && !bit(instance, "@DONE.OWED")) stop(instance);
  }

  std::string blockStart(host::Instance& instance, const std::vector<NcArgument>& keys) override {
    if (phase_ != BlockPhase::Idle) return "a block is under way already";
    for (const NcArgument& key : keys) {
      const std::optional<host::Ref> place = writePlace(instance, key.key);
      if (!place) return "unknown signal '" + key.key + "'";
    }
    for (const NcArgument& key : keys) {
      const host::Ref place = *writePlace(instance, key.key);
      if (key.isReal)
        instance.writeReal(place, key.real);
      else
        instance.write(place, static_cast<uint64_t>(key.integer));
      blockSignals_.push_back(key.key);
    }
    phase_ = BlockPhase::Starting;
    motionDone_ = false;
    return {};
  }

  std::string blockDone(host::Instance&) override {
    if (phase_ == BlockPhase::Idle) return "no block is under way";
    motionDone_ = true;
    return {};
  }

  std::string event(host::Instance& instance, std::string_view name, const std::vector<NcArgument>& keys) override {
    if (name != "CONFIRM") return NcModel::event(instance, name, keys);
    board_.confirmOldest();
    return {};
  }

  std::string plcCommand(host::Instance& instance, std::string_view command) override {
    if (command == "stop") {
      runModule(instance, "DONE", 1);
      stopping_ = true;
      if (!bit(instance, "@DONE.OWED")) stop(instance);
    } else if (command == "start") {
      instance.setStopped(false);
      runModule(instance, "INIT", 1);
    } else {
      runModule(instance, "CLEAR", 0);
    }
    board_.take(instance);
    return {};
  }

protected:
  std::optional<host::Ref> signal(const host::Instance& instance, std::string_view name) const override {
    const Signal* found = findSignal(technolSignals(), name, kInterfaceArea);
    const uint32_t space = host::findSpace(instance.program(), kInterfaceSpace);
    if (found == nullptr || space == RUNG_NONE) return std::nullopt;
    if (found->type == SignalType::Bit) return host::bitRef(space, found->byteOffset, found->bit);
    const uint32_t bytes = elementBytes(found->type);
    if (bytes == 0) return std::nullopt;
    host::Ref place = found->type == SignalType::Real ? host::realRef(space, found->byteOffset)
                                                      : host::intRef(space, found->byteOffset, bytes * 8);
    place.count = found->count;
    return place;
  }

private:
  static bool bit(const host::Instance& instance, const char* name) {
    const auto place = instance.resolve(name);
    return place && instance.read(*place) != 0;
  }
  void setCell(host::Instance& instance, const char* name, uint64_t value) {
    if (const auto place = writePlace(instance, name)) instance.write(*place, value);
  }

  static void runModule(host::Instance& instance, const char* module, uint32_t dr) {
    if (host::findTask(instance.program(), module) == RUNG_NONE) return;
    if (const auto place = instance.resolve("@DR")) instance.write(*place, dr);
    instance.runTask(module);
    if (const auto place = instance.resolve("@DR")) instance.write(*place, 0);
  }

  void stop(host::Instance& instance) {
    stopping_ = false;
    instance.setStopped(true);
  }

  // One pass of a block module; true when it ran through. It starts at its beginning with every block.
  static bool pass(host::Instance& instance, const char* module, bool first) {
    const std::string prefix = std::string("@") + module;
    if (first) {
      if (const auto place = instance.resolve(prefix + ".CONT")) instance.write(*place, 0);
      if (const auto place = instance.resolve(prefix + ".DONE")) instance.write(*place, 0);
    }
    if (host::findTask(instance.program(), module) == RUNG_NONE) return true;
    instance.runTask(module);
    const auto done = instance.resolve(prefix + ".DONE");
    return !done || instance.read(*done) != 0;
  }

  // §12.2 step 3; where nothing waits, all phases follow each other within one scan.
  void supervise(host::Instance& instance) {
    if (phase_ == BlockPhase::Idle || bit(instance, "@INIT.OWED")) return;
    if (phase_ == BlockPhase::Starting) {
      setCell(instance, "PO_POL", 0);
      setCell(instance, "PO_F", 1);
      setCell(instance, "STATUS_RESTART", 1);
      phase_ = BlockPhase::Init;
      passes_ = 0;
    }
    if (phase_ == BlockPhase::Init && pass(instance, "BLOCK_INIT", passes_++ == 0)) {
      phase_ = BlockPhase::Motion;
      setCell(instance, "STATUS_RESTART", 2);
    }
    if (phase_ == BlockPhase::Motion && motionDone_) {
      phase_ = BlockPhase::Done;
      passes_ = 0;
      setCell(instance, "PO_POL", 1);
      setCell(instance, "STATUS_RESTART", 4);
    }
    if (phase_ == BlockPhase::Done && pass(instance, "BLOCK_DONE", passes_++ == 0)) finishBlock(instance);
  }

  void finishBlock(host::Instance& instance) {
    setCell(instance, "PO_F", 0);
    setCell(instance, "STATUS_RESTART", 0);
    for (const std::string& name : blockSignals_)
      if (lastsOneBlock(name)) setCell(instance, name.c_str(), 0);
    blockSignals_.clear();
    phase_ = BlockPhase::Idle;
  }

  // Change pulses ZM…PI and …PID, M60PI and the command block return to 0 (§25); static bits stay.
  static bool lastsOneBlock(std::string_view name) {
    return name.starts_with("ZM") || name.ends_with("PID") || name == "M60PI" || name.starts_with("BLK[");
  }

  BlockPhase phase_ = BlockPhase::Idle;
  bool motionDone_ = false;
  bool stopping_ = false;
  uint32_t passes_ = 0;
  std::vector<std::string> blockSignals_;
};

} // namespace

std::unique_ptr<NcModel> makeTechnolModel() { return std::make_unique<TechnolModel>(); }

} // namespace rung::nc
