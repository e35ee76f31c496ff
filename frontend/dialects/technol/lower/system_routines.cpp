// Routines that the compiler generates.
#include "frontend/dialects/technol/lower/system_routines.h"

#include <string>

#include "frontend/dialects/technol/lower/areas.h"
#include "frontend/dialects/technol/read/symbols.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {

using ir::Type;

// ---- CLEAR ----------------------------------------------------------------------------------------------------------

void Clears::call(bool global) {
  ir::RoutineId& routine = routines_[global ? 0 : 1];
  if (!routine.valid()) routine = emitter_.newRoutine(global ? "@CLEAR GLOBAL" : "@CLEAR INTERNAL");
  emitter_.out().call(routine);
}

// Clears the data items; adjacent items are cleared together.
void Clears::clearData(bool local) {
  uint32_t first = 0, end = 0;
  for (const DataItem& item : program_.declarations.items) {
    if (item.local != local || item.bytes == 0) continue;
    if (item.byte != end) {
      clearRange(memory_, kDataSpace, first, end);
      first = item.byte;
    }
    end = item.byte + item.bytes;
  }
  clearRange(memory_, kDataSpace, first, end);
}

// Restores the contents that texts and structures have at power-on (man. l.1533-1536).
void Clears::fillData() {
  const Declarations& declarations = program_.declarations;
  size_t item = 0;
  for (const ir::Init& init : declarations.inits) {
    if (init.space != kDataSpace) continue;
    while (item + 1 < declarations.items.size() &&
           declarations.items[item].byte + declarations.items[item].bytes <= init.byte)
      ++item;
    if (declarations.items[item].local) continue;
    const std::string_view bytes(reinterpret_cast<const char*>(init.data.data()), init.data.size());
    for (size_t at = 0; at < bytes.size(); at += kMostCleared) {
      const std::string_view part = bytes.substr(at, kMostCleared);
      const auto size = static_cast<uint32_t>(part.size());
      copy(emitter_, fixedArea(emitter_, kDataSpace, declarations.dataBytes, init.byte + static_cast<uint32_t>(at)),
           fixedArea(emitter_, emitter_.constantBytes(part), size, 0), fixedCount(emitter_.b(), size));
      emitter_.out().cut();
    }
  }
}

// GLOBAL clears the data of all files, mechanisms and timers; INTERNAL clears the data of DATA_LOCAL and the cells that
// instructions allocate automatically (man. l.1533-1539).
void Clears::make() {
  constexpr uint32_t kMechanismsPerRung = 16;
  for (const bool global : {true, false}) {
    if (!routines_[global ? 0 : 1].valid()) continue;
    emitter_.open(routines_[global ? 0 : 1]);
    clearData(!global);
    if (global) {
      fillData();
      for (uint32_t i = 0; i < program_.source.mechanisms.size(); ++i) {
        sequences_.initialise(i);
        if (i % kMechanismsPerRung == kMechanismsPerRung - 1) emitter_.out().cut();
      }
    }
    emitter_.clearSlots(global ? state_.timers() : state_.automatic());
    emitter_.close();
  }
}

// ---- start and events -----------------------------------------------------------------------------------------------

void makeStart(const SourceProgram& program, Emitter& emitter, ir::RoutineId routine, const State& state,
               const Clocks& clocks, BitMessages& messages) {
  emitter.open(routine);
  ir::RungBuilder& b = emitter.b();
  b.store(place(HostCell::InitPending), b.constant(Type::I64, program.filesWith(&SourceFile::finishesInit)));
  b.store(place(HostCell::DonePending), b.constant(Type::I64, 0));
  storeStartPresets(b);
  emitter.clearSlots(state.forgotten());
  emitter.clearSlots(clocks.phases());
  messages.forget();
  emitter.close();
}

// Makes the routine of an event; the host sets RLO and DR.
static Event makeEvent(Emitter& emitter, std::string name, ir::RoutineId procedure, Clocks& clocks) {
  const ir::RoutineId routine = emitter.newRoutine("@" + name);
  emitter.open(routine);
  emitter.r().clear();
  emitter.r().setRlo(emitter.b().load(Type::Bit, place(HostCell::Rlo)));
  emitter.r().setDr(emitter.b().load(Type::I64, place(HostCell::Dr)));
  clocks.callEvent(procedure);
  emitter.close();
  return {std::move(name), routine};
}

std::vector<Event> makeEvents(const SourceProgram& program, Emitter& emitter, const Procedures& procedures,
                              Clocks& clocks) {
  std::vector<Event> events;
  for (const std::string_view name : kOnEvents)
    if (const uint32_t procedure = program.procedureNamed(name); procedure != kNone)
      events.push_back(makeEvent(emitter, std::string(name), procedures.routine(procedure), clocks));
  for (uint32_t number = 0; number < procedures.events().size(); ++number) {
    const uint32_t procedure = procedures.events()[number];
    events.push_back(makeEvent(emitter,
                               std::string(nc::technol::kPacketTask) + std::to_string(number) + "." +
                                   symbolKey(program.procedures[procedure].name),
                               procedures.routine(procedure), clocks));
  }
  return events;
}

// Presets of the interface.

namespace {

struct Preset {
  std::string_view signal;
  uint16_t value;
};
constexpr Preset kPowerOn[] = {
    {"EN_AUTMAN", 1},               // man. l.6372, l.10879
    {"FEED_OVR_MULTIPLIER", 1000},  // man. l.6555
    {"SPEED_OVR_MULTIPLIER", 1000}, // man. l.6592
    {"NLCSERVOENABLE", 0xFFFF},     // man. l.6667
    {"SHIFT_ENABLE", 0x3F},         // man. l.11122
};

// Bits that are 1 after a start (man. l.6186, l.6316); `#` is the number of an axis.
constexpr std::string_view kStart[] = {"MPXPI", "MPYPI", "MPZPI", "VAZBA_X", "VAZBA_Y", "VAZBA_Z"};
constexpr std::string_view kStartOfAxes[] = {"MP#PI", "VAZBA_#"};
constexpr int kFirstNumbered = 4, kLastAxis = 16;

const nc::Signal* signalOf(std::string_view name) { return nc::findSignal(nc::technolSignals(), name, "I"); }

void setBit(ir::RungBuilder& b, std::string_view name, ir::ValueId one) {
  if (const nc::Signal* signal = signalOf(name))
    b.store({.space = kInterfaceSpace, .byte = signal->byteOffset, .bit = signal->bit}, one);
}

} // namespace

void addPowerOnPresets(ir::Module& module) {
  for (const Preset& preset : kPowerOn) {
    const nc::Signal* signal = signalOf(preset.signal);
    if (signal == nullptr) continue;
    const uint32_t value = static_cast<uint32_t>(preset.value)
                           << (signal->type == nc::SignalType::Bit ? signal->bit : 0);
    std::vector<uint8_t> data{static_cast<uint8_t>(value)};
    if (signal->type == nc::SignalType::Word) data.push_back(static_cast<uint8_t>(value >> 8));
    module.inits.push_back({.space = kInterfaceSpace, .byte = signal->byteOffset, .data = std::move(data)});
  }
}

void storeStartPresets(ir::RungBuilder& b) {
  const ir::ValueId one = b.bit(true);
  for (const std::string_view name : kStart) setBit(b, name, one);
  for (const std::string_view pattern : kStartOfAxes)
    for (int axis = kFirstNumbered; axis <= kLastAxis; ++axis) {
      std::string name(pattern);
      setBit(b, name.replace(name.find('#'), 1, std::to_string(axis)), one);
    }
}

} // namespace rung::frontend::technol
