// Lowers a program of this control.
#include "frontend/dialects/fanuc/config.h"
#include "frontend/dialects/fanuc/lower/lower.h"
#include "frontend/network/lower/functions.h"
#include "frontend/network/lower/lower_module.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/pmc/slot.h"

namespace rung::frontend::fanuc {
namespace {

using ir::Type;
using ir::ValueId;
using network::Address;
using network::Network;

// System relays (inventory §5.3), by their byte and bit from the system area.
struct SystemBit {
  uint32_t byte;
  uint8_t bit;
};
constexpr SystemBit kAlwaysOff{kClockByte, 0}, kAlwaysOn{kClockByte, 1}, kRuns{kClockByte, 2};
constexpr uint8_t kFastClock = 5, kSlowClock = 6; // of the clock byte
constexpr int64_t kFastHalfUs = 100'000, kSlowHalfUs = 500'000;

Address bitOf(Pmc pmc, SystemBit bit) {
  Address address = network::plus(systemArea(pmc), bit.byte);
  address.bit = bit.bit;
  address.isBit = true;
  return address;
}

// What the program does with the bytes of the system area.
class SystemUse {
public:
  SystemUse(const network::Program& program, Pmc pmc) : system_(systemArea(pmc)) {
    for (const network::Unit& unit : program.units)
      for (const Network& network : unit.networks) look(network);
  }

  bool reads(uint32_t byte) const { return read_[byte]; }
  bool writes(uint32_t byte) const { return written_[byte]; }

private:
  static constexpr uint32_t kBytes = 100;

  void mark(bool (&bytes)[kBytes], const Address& address, uint32_t length) const {
    if (address.area != system_.area) return;
    for (uint32_t i = 0; i < length; ++i)
      if (const uint32_t at = address.byte + i - system_.byte; at < kBytes) bytes[at] = true;
  }
  void look(const Network& network) {
    for (const network::LogicStep& step : network.logic)
      if (step.kind != network::Logic::OrBlock && step.kind != network::Logic::AndBlock) mark(read_, step.bit, 1);
    for (const network::CoilStep& coil : network.coils) mark(written_, coil.bit, 1);
    for (const network::Param& param : network.function.params) {
      if (!param.isAddress) continue;
      if (param.access != frontend::Access::Write) mark(read_, param.address, param.bytes);
      if (param.access != frontend::Access::Read) mark(written_, param.address, param.bytes);
    }
  }

  Address system_;
  bool read_[kBytes] = {};
  bool written_[kBytes] = {};
};

// The clocks are half of their period 0, then 1.
ValueId clockBit(ir::RungBuilder& b, int64_t halfUs, uint8_t bit) {
  const ValueId halves = b.divU(b.now(), b.constant(Type::I64, halfUs));
  const ValueId one = b.trunc(Type::Bit, halves);
  return b.select(one, b.constant(Type::I8, int64_t{1} << bit), b.constant(Type::I8, 0));
}

void writeClocks(network::Lowering& f, const Address& system) {
  ir::RungBuilder& b = f.b;
  const ValueId constant = b.constant(Type::I8, (1 << kAlwaysOn.bit) | (1 << kRuns.bit));
  const ValueId clocks = b.or_(clockBit(b, kFastHalfUs, kFastClock), clockBit(b, kSlowHalfUs, kSlowClock));
  f.store(network::plus(system, kClockByte), b.or_(constant, clocks));
}

// Bits that the program only reads are constants in its code; clocks are written where they are read, and the bit of
// the first scan ends with the first cycle of level 2 (F14).
network::Execution executionOf(const network::Program& program, Pmc pmc) {
  const Address system = systemArea(pmc);
  const SystemUse use(program, pmc);
  network::Execution execution{.slotUs = nc::pmc::kSlotUs,
                               .budget = 10'000'000,
                               .overrunFault = nc::kPmcDeadLoop,
                               .results = system,
                               .resultBytes = kResultBytes};
  if (!use.writes(kClockByte))
    execution.constants = {{bitOf(pmc, kAlwaysOff), false}, {bitOf(pmc, kAlwaysOn), true}, {bitOf(pmc, kRuns), true}};
  if (use.reads(kClockByte)) execution.eachSlot = [system](network::Lowering& f) { writeClocks(f, system); };
  execution.eachCycle = [start = network::plus(system, kStartByte)](network::Lowering& f) {
    f.store(start, f.b.constant(Type::I8, 0));
  };
  return execution;
}

void addSystemRelays(network::ModuleLowering& lowering, Pmc pmc) {
  const Address system = systemArea(pmc);
  const auto init = [&](uint32_t byte, uint8_t value) {
    lowering.module().inits.push_back({lowering.spaceOf(system.area), system.byte + byte, {value}});
  };
  init(kStartByte, 1);
  init(kClockByte, (1 << kAlwaysOn.bit) | (1 << kRuns.bit));
}

} // namespace

std::unique_ptr<ir::Module> lowerProgram(const network::Program& program, network::Context& context,
                                         std::span<const FileId> files, const frontend::CompileOptions& options) {
  const Pmc pmc = pmcOf(context.language);
  network::ModuleLowering lowering(program, context, files, executionOf(program, pmc), options.marks,
                                   options.given != nullptr);
  addSystemRelays(lowering, pmc);
  network::addPresets(lowering, options, pagesOf(pmc));
  lowering.lowerUnits();
  lowering.addTasks(network::partsOfLevel2(lowering, options, context.diagnostics));
  return lowering.take();
}

} // namespace rung::frontend::fanuc
