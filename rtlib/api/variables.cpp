// Between variables of the host and cells (see variables.h).
#include "rtlib/api/variables.h"

#include <cmath>
#include <cstring>

#include "rtlib/api/error.h"
#include "rtlib/api/running.h"
#include "rtlib/api/values.h"

namespace rung::api {
namespace {

template <class T>
T load(const void* from) noexcept {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
template <class T>
void store(void* to, T value) noexcept {
  std::memcpy(to, &value, sizeof value);
}

bool isUnsigned(rung_host_type type) noexcept {
  return type == RUNG_HOST_U8 || type == RUNG_HOST_U16 || type == RUNG_HOST_U32;
}

uint64_t maskOf(const BoundVariable& v) noexcept { return ~uint64_t{0} >> (64 - v.bits); }

int64_t bitFieldOf(const BoundVariable& v) noexcept {
  uint64_t word = 0;
  std::memcpy(&word, v.address, v.bytes);
  word = word >> v.bit & maskOf(v);
  const bool negative = !isUnsigned(v.type) && v.type != RUNG_HOST_BOOL && (word >> (v.bits - 1) & 1) != 0;
  return static_cast<int64_t>(negative ? word | ~maskOf(v) : word);
}

// The bits beside it stay.
void setBitField(const BoundVariable& v, int64_t value) noexcept {
  uint64_t word = 0;
  std::memcpy(&word, v.address, v.bytes);
  const uint64_t bits = v.type == RUNG_HOST_BOOL ? value != 0 : static_cast<uint64_t>(value) & maskOf(v);
  word = (word & ~(maskOf(v) << v.bit)) | bits << v.bit;
  std::memcpy(v.address, &word, v.bytes);
}

int64_t integerOf(const BoundVariable& v) noexcept {
  if (v.bits != 0) return bitFieldOf(v);
  switch (v.type) {
  case RUNG_HOST_BOOL: return load<uint8_t>(v.address) != 0 ? 1 : 0;
  case RUNG_HOST_I8: return load<int8_t>(v.address);
  case RUNG_HOST_U8: return load<uint8_t>(v.address);
  case RUNG_HOST_I16: return load<int16_t>(v.address);
  case RUNG_HOST_U16: return load<uint16_t>(v.address);
  case RUNG_HOST_I32: return load<int32_t>(v.address);
  case RUNG_HOST_U32: return load<uint32_t>(v.address);
  case RUNG_HOST_I64: return load<int64_t>(v.address);
  case RUNG_HOST_F32:
  case RUNG_HOST_F64: break;
  }
  return 0;
}

void setInteger(const BoundVariable& v, int64_t value) noexcept {
  if (v.bits != 0) return setBitField(v, value);
  switch (v.type) {
  case RUNG_HOST_BOOL: return store<uint8_t>(v.address, value != 0 ? 1 : 0);
  case RUNG_HOST_I8:
  case RUNG_HOST_U8: return store(v.address, static_cast<uint8_t>(value));
  case RUNG_HOST_I16:
  case RUNG_HOST_U16: return store(v.address, static_cast<uint16_t>(value));
  case RUNG_HOST_I32:
  case RUNG_HOST_U32: return store(v.address, static_cast<uint32_t>(value));
  case RUNG_HOST_I64: return store(v.address, value);
  case RUNG_HOST_F32: return store(v.address, static_cast<float>(value));
  case RUNG_HOST_F64: return store(v.address, static_cast<double>(value));
  }
}

int64_t nearest(double value) noexcept {
  constexpr double kLimit = 9.2e18;
  if (std::isnan(value)) return 0;
  return std::llrint(std::fmax(-kLimit, std::fmin(kLimit, value)));
}

bool isReal(rung_host_type type) noexcept { return type == RUNG_HOST_F32 || type == RUNG_HOST_F64; }

double realOf(const BoundVariable& v) noexcept {
  const double value = v.type == RUNG_HOST_F32 ? double{load<float>(v.address)} : load<double>(v.address);
  return value * v.scale;
}

// Real to a variable of the host.
void setReal(const BoundVariable& v, double value) noexcept {
  if (v.type == RUNG_HOST_F32) return store(v.address, static_cast<float>(value / v.scale));
  store(v.address, value / v.scale);
}

} // namespace

// A cell that the program no longer has is neither written nor, as 0, read.
void readInputs(rung_instance& instance) noexcept {
  const core::Memory memory = instance.running.memory();
  for (const BoundVariable& v : instance.inputs) {
    const LocatedCell& cell = *instance.now().cells.at(v.cell);
    if (cell.state != CellState::Good) continue;
    if (isReal(v.type))
      memory.writeReal(cell.place, realOf(v));
    else if (cell.place.real)
      memory.writeReal(cell.place, static_cast<double>(integerOf(v)));
    else if (v.truth)
      memory.write(cell.place, integerOf(v) != 0 ? 1 : 0);
    else
      memory.write(cell.place, static_cast<uint64_t>(integerOf(v)));
  }
}

void writeOutputs(rung_instance& instance) noexcept {
  const core::Memory memory = instance.running.memory();
  for (const BoundVariable& v : instance.outputs) {
    const LocatedCell& cell = *instance.now().cells.at(v.cell);
    if (cell.state == CellState::Gone || cell.state == CellState::Retyped) {
      setInteger(v, 0);
      continue;
    }
    if (isUnsigned(v.type) && cell.ref.kind == runtime::RefKind::Int) {
      setInteger(v, static_cast<int64_t>(memory.read(cell.place)));
      continue;
    }
    const rung_value value = firstValue(memory, cell);
    const bool real = cell.place.real;
    if (isReal(v.type))
      setReal(v, real ? value.real : static_cast<double>(value.integer));
    else
      setInteger(v, real ? nearest(value.real) : value.integer);
  }
}

void clearOutputs(rung_instance& instance) noexcept {
  for (const BoundVariable& v : instance.outputs) setInteger(v, 0);
  instance.now().blockPlan.clear();
}

namespace {

constexpr uint32_t kWidths[] = {0, 1, 1, 1, 2, 2, 4, 4, 8, 4, 8}; // in bytes, by rung_host_type

int32_t checkVariable(const rung_variable& v, uint32_t number) noexcept {
  if (v.name == nullptr || v.address == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "variable %u has no name or no address", number);
  if (v.type < RUNG_HOST_BOOL || v.type > RUNG_HOST_F64)
    return fail(RUNG_BAD_ARGUMENT, "variable %u, %s: %u is not an enum rung_host_type", number, v.name, v.type);
  if (v.direction > (RUNG_FROM_PROGRAM | RUNG_BOUND_REAL))
    return fail(RUNG_BAD_ARGUMENT, "variable %u, %s: %u is not an enum rung_direction", number, v.name, v.direction);
  if (reinterpret_cast<uintptr_t>(v.address) % kWidths[v.type] != 0)
    return fail(RUNG_BAD_ARGUMENT, "variable %u, %s: its address is not aligned for its type", number, v.name);
  if (!std::isfinite(v.scale))
    return fail(RUNG_BAD_ARGUMENT, "variable %u, %s: the scale is not a number", number, v.name);
  return RUNG_OK;
}

// A variable from the program has the value that the machine sees: that of the place which the machine may write, and
// of the program's own where there is no such place.
int32_t findPlace(rung_instance& instance, const rung_variable& v, bool input, rung_cell& cell) {
  const int32_t real = (v.direction & RUNG_BOUND_REAL) != 0 ? RUNG_REAL : 0;
  const int32_t status = findCell(instance, instance.running.program(), v.name, RUNG_WRITE | real, cell);
  if (input || (status != RUNG_OVERWRITTEN && status != RUNG_WRONG_TYPE)) return status;
  return findCell(instance, instance.running.program(), v.name, RUNG_READ | real, cell);
}

} // namespace

uint32_t widthOf(rung_host_type type) noexcept { return kWidths[type]; }

int32_t findVariable(rung_instance& instance, const rung_variable& variable, bool input, rung_cell& cell) {
  if (const int32_t status = findPlace(instance, variable, input, cell); status != RUNG_OK) return status;
  if (instance.now().cells.at(cell)->type != RUNG_TYPE_TEXT) return RUNG_OK;
  return fail(RUNG_WRONG_TYPE, "%s is a text: no variable can be bound to it", variable.name);
}

} // namespace rung::api

using namespace rung::api;

int32_t rung_instance_bind(rung_instance* instance, const rung_variable* variables, uint32_t count) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (variables == nullptr && count != 0)
    return fail(RUNG_BAD_ARGUMENT, "the variables are null, their number is not 0");
  return contained([&] {
    std::vector<BoundVariable> inputs = call->inputs;
    std::vector<BoundVariable> outputs = call->outputs;
    for (uint32_t i = 0; i < count; ++i) {
      const rung_variable& v = variables[i];
      if (const int32_t status = checkVariable(v, i); status != RUNG_OK) return status;
      const bool input = (v.direction & RUNG_FROM_PROGRAM) == 0;
      BoundVariable bound{
          .type = static_cast<rung_host_type>(v.type), .address = v.address, .scale = v.scale != 0 ? v.scale : 1};
      if (const int32_t status = findVariable(*call, v, input, bound.cell); status != RUNG_OK) return status;
      (input ? inputs : outputs).push_back(bound);
    }
    call->inputs = std::move(inputs);
    call->outputs = std::move(outputs);
    return int32_t{RUNG_OK};
  });
}
