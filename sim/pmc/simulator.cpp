// The simulated CNC (see simulator.h). Its quantities are in part_program.cpp.
#include "sim/pmc/simulator.h"

#include <cmath>

namespace rung::sim::pmc {

void Simulator::powerOn(bool warm) {
  Machine fresh(*cnc_);
  fresh.axes.names = machine_.axes.names;
  fresh.axes.limitSwitches = machine_.axes.limitSwitches;
  if (warm) {
    fresh.tables = std::move(machine_.tables);
    fresh.tables.clearVolatile();
    for (uint32_t i = 0; i < kAxes; ++i) fresh.axes.place(i, machine_.axes[i].machine);
    operation_.powerOff();
  } else {
    operation_ = Operation(*cnc_);
  }
  const double jog = manual_.jogSpeed;
  manual_ = {};
  manual_.jogSpeed = jog;
  plcAxes_ = PlcAxes(*cnc_->model);
  positioning_ = {};
  external_ = {};
  machine_ = std::move(fresh);
  for (uint32_t i = 0; i < kAxes; ++i) machine_.axes[i].referenced = absoluteEncoders_ && i < machine_.axes.count();
  if (!warm)
    for (const auto& [number, axis, value] : parameters_)
      machine_.tables.set(Table::Parameter, number, axis, std::llround(value * kTableScale));
  resetKey_ = false;
  resetSlots_ = 0;
  slots_ = 0;
}

void Simulator::step(const nc::pmc::SignalsIo& io) {
  ++slots_;
  machine_.axes.beginSlot(io, machine_.tables, machine_.alarms);
  followReset(io);
  if (resetSlots_ == 0) {
    operation_.step(io, machine_);
    manual_.step(io, machine_, operation_.state() == RunState::Start ? Mode::None : operation_.mode());
  } else {
    operation_.idle(io, machine_.tables);
  }
  plcAxes_.step(io, machine_, !io.g(8, 4));
  external_.step(io, machine_, operation_, resetSlots_ != 0);
  if (cnc_->positionsSpindle) positioning_.step(io);
  machine_.spindle.step(*cnc_, io, machine_.tables, positioning_.active());
  machine_.axes.writeSignals(io, machine_.tables, machine_.rapid);
  io.setF(0, 6, io.g(8, 4)); // SA
  io.setF(1, 7, true);       // MA
  io.setF(1, 1, resetSlots_ != 0);
  io.setF(1, 0, machine_.hasAlarm());
  if (cnc_->writeOwn != nullptr) cnc_->writeOwn(io, machine_);
}

// *ESP, ERS, RRW and the RESET key (l.5245-5255).
void Simulator::followReset(const nc::pmc::SignalsIo& io) {
  const bool external = io.g(8, 7) || (cnc_->resetsByRewind && io.g(8, 6));
  if (!io.g(8, 4) || external || resetKey_) {
    machine_.alarms.clear();
    machine_.axes.clearOverTravel();
    operation_.reset(io, machine_);
    manual_.stop(machine_);
    positioning_.reset();
    if (!io.g(8, 4)) machine_.spindle.reset();
    resetSlots_ = kResetSlots;
  } else if (resetSlots_ != 0) {
    --resetSlots_;
  }
  resetKey_ = false;
}

std::string Simulator::loadProgram(std::string_view text, bool mdi) {
  if (operation_.state() != RunState::Reset) return "a program is running; reset the CNC first";
  PartProgram program;
  const bool manyM = machine_.tables.parameterBit(cnc_->parameters.manyM);
  if (std::string wrong = readPartProgram(text, machine_.axes.names, *cnc_, manyM, program); !wrong.empty())
    return wrong;
  if (mdi)
    operation_.loadMdi(std::move(program));
  else
    operation_.load(std::move(program));
  return {};
}

std::string Simulator::setAxes(std::string_view names) {
  if (names.empty() || names.size() > kAxes) return "axes: 1 to 8 letters";
  for (size_t i = 0; i < names.size(); ++i)
    if (std::string_view("XYZABCUVW").find(names[i]) == std::string_view::npos ||
        names.find(names[i], i + 1) != std::string_view::npos)
      return "axes: letters of XYZABCUVW, each once";
  machine_.axes.names = names;
  return {};
}

void Simulator::setParameter(uint32_t number, uint32_t axis, double value) {
  parameters_.push_back({number, axis, value});
}

} // namespace rung::sim::pmc
