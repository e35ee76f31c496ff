// Cells by name, their values and texts.
#include "rtlib/api/values.h"

#include <cmath>
#include <cstring>

#include "rtlib/api/error.h"
#include "rtlib/api/replacing.h"
#include "rtlib/api/running.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/loaded_program.h"

namespace rung::api {

int32_t failName(const rung_program& program, const char* name) noexcept {
  return fail(RUNG_NOT_FOUND,
              "%s is not a name of the program %s, an address of its dialect or a signal of the NC's interface", name,
              program.name);
}

namespace {

int32_t failState(CellState state) noexcept {
  switch (state) {
  case CellState::Gone: return fail(RUNG_NOT_FOUND, "the program that runs now does not have this cell");
  case CellState::Overwritten:
    return fail(RUNG_OVERWRITTEN,
                "the program that runs now would never see the value: another place is copied over it");
  case CellState::Controls: return fail(RUNG_OVERWRITTEN, "the control itself writes this cell: it can be read");
  case CellState::Retyped: return fail(RUNG_WRONG_TYPE, "the cell has another type in the program that runs now");
  case CellState::Constant: return fail(RUNG_WRONG_TYPE, "the cell is a constant in the program that runs now");
  case CellState::Released:
  case CellState::Good: break;
  }
  return RUNG_OK;
}

// Reports why a name is not entered.
int32_t failName(const rung_instance& instance, const rung_program& program, const char* name, CellState state) {
  if (state == CellState::Retyped) return fail(RUNG_WRONG_TYPE, "%s has no room for a real", name);
  if (state == CellState::Constant) return fail(RUNG_WRONG_TYPE, "%s is a constant: it cannot be written", name);
  if (state == CellState::Controls) return fail(RUNG_OVERWRITTEN, "the control itself writes %s: it can be read", name);
  if (state != CellState::Overwritten) return api::failName(program, name);
  const std::optional<runtime::Ref> place = instance.environment->writePlace(program, name);
  const std::optional<runtime::Ref> source = place ? runtime::Overwritten(program).source(*place) : std::nullopt;
  return fail(RUNG_OVERWRITTEN, "%s is copied from %s before the program reads it: write there", name,
              source ? nc::describe(program, *source).c_str() : "another place");
}

int32_t checkAccess(int32_t access) noexcept {
  if (access >= 0 && access <= (RUNG_WRITE | RUNG_REAL)) return RUNG_OK;
  return fail(RUNG_BAD_ARGUMENT, "a cell is found for RUNG_READ or RUNG_WRITE, and RUNG_REAL, not %d", access);
}

int32_t failCell(rung_cell cell) noexcept { return fail(RUNG_BAD_ARGUMENT, "%u is not a cell of this instance", cell); }

// The cell, if it can be used now; null, with the error in `status`.
const LocatedCell* usable(const rung_instance& instance, rung_cell cell, bool writes, int32_t& status) noexcept {
  const LocatedCell* found = instance.now().cells.at(cell);
  if (found == nullptr || found->state == CellState::Released)
    status = failCell(cell);
  else if (found->state != CellState::Good)
    status = failState(found->state);
  else if (writes && !found->writes)
    status = fail(RUNG_WRONG_TYPE, "the cell was found for reading: find it with RUNG_WRITE");
  else
    return found;
  return nullptr;
}

const LocatedCell* numberCell(const rung_instance& instance, rung_cell cell, bool writes, int32_t& status) noexcept {
  const LocatedCell* found = usable(instance, cell, writes, status);
  if (found == nullptr || found->type != RUNG_TYPE_TEXT) return found;
  status = fail(RUNG_WRONG_TYPE, "the cell is a text: use rung_instance_read_text and rung_instance_write_text");
  return nullptr;
}

void writeAt(const core::Memory& memory, const core::Place& place, rung_value value) noexcept {
  if (place.real)
    memory.writeReal(place, value.real);
  else
    memory.write(place, static_cast<uint64_t>(value.integer));
}

core::Place elementPlace(const core::Memory& memory, const LocatedCell& cell, uint32_t index) noexcept {
  if (index == 0) return cell.place;
  const std::optional<runtime::Ref> element = runtime::element(cell.ref, index);
  return element ? runtime::locate(memory, *element) : core::Place{};
}

// The cell, if it has `count` elements from index `first` on that can be copied to or from `values`; null, with the
// error in `status`.
const LocatedCell* elementsOf(const rung_instance& instance, rung_cell cell, bool writes, uint32_t first,
                              uint32_t count, const rung_value* values, int32_t& status) noexcept {
  const LocatedCell* found = numberCell(instance, cell, writes, status);
  if (found == nullptr) return nullptr;
  if (first > found->ref.count || count > found->ref.count - first)
    status = fail(RUNG_BAD_ARGUMENT, "%u elements from number %u on were asked for; the cell has %u, from number 0 on",
                  count, first, found->ref.count);
  else if (values == nullptr && count != 0)
    status = fail(RUNG_BAD_ARGUMENT, "the values are null, their number is not 0");
  return status == RUNG_OK ? found : nullptr;
}

} // namespace

int32_t findCell(rung_instance& instance, const rung_program& program, const char* name, int32_t access,
                 rung_cell& cell) {
  CellState state = CellState::Good;
  if (!instance.generations.names.find(*instance.environment, program, {name, access}, state, cell))
    return fail(RUNG_OUT_OF_MEMORY, "an instance has no more than %u cells", CellTable::kMostCells);
  return state == CellState::Good ? int32_t{RUNG_OK} : failName(instance, program, name, state);
}

// Conversions between variables of the host and cells.

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

// Other bits of its bytes stay unchanged.
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

// Stores a real in a variable of the host.
void setReal(const BoundVariable& v, double value) noexcept {
  if (v.type == RUNG_HOST_F32) return store(v.address, static_cast<float>(value / v.scale));
  store(v.address, value / v.scale);
}

} // namespace

// Cells that the program no longer has are skipped.
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

// A variable from the program gets the value that the machine sees: that of the place which the machine may write, or,
// if there is none, that of the program's own place.
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

using namespace rung;
using namespace rung::api;

int32_t rung_instance_find(rung_instance* instance, const char* name, int32_t access, rung_cell* cell) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  if (isInCallback(*handle)) return failCallback();
  if (name == nullptr || cell == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "the name or the pointer that receives the cell is null");
  if (const int32_t status = checkAccess(access); status != RUNG_OK) return status;
  return contained([&] {
    const std::shared_ptr<const Generation> running = handle->generations.running();
    return findCell(*handle, running->program(), name, access, *cell);
  });
}

namespace {

rung_cell_info infoOf(const rung_program& program, const LocatedCell& cell) {
  rung_cell_info out{.type = cell.type,
                     .count = cell.ref.count,
                     .access = cell.writes ? uint32_t{RUNG_WRITE} : uint32_t{RUNG_READ},
                     .space = cell.ref.space,
                     .byte = cell.ref.byte,
                     .bit = cell.ref.bit};
  if (cell.ref.kind != runtime::RefKind::Constant) putText(out.address, nc::cellAddress(program, cell.ref));
  return out;
}

} // namespace

int32_t rung_instance_describe(const rung_instance* instance, const rung_replacement* replacement, const char* name,
                               int32_t access, rung_cell_info* info, int64_t* value) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  if (name == nullptr || value == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "the name or the pointer that receives the value is null");
  if (const int32_t status = checkAccess(access); status != RUNG_OK) return status;
  return contained([&] {
    std::shared_ptr<Generation> in;
    if (replacement == nullptr)
      in = handle->generations.running();
    else if (const int32_t status = nextOf(*handle, replacement, in); status != RUNG_OK)
      return status;
    const LocatedCell found = locateCell(*handle->environment, in->program(), {name, access});
    if (found.state != CellState::Good) return failName(*handle, in->program(), name, found.state);
    *value = found.ref.kind == runtime::RefKind::Constant ? static_cast<int64_t>(found.ref.constant) : 0;
    return giveStruct(info, infoOf(in->program(), found));
  });
}

int32_t rung_instance_release(rung_instance* instance, rung_cell cell) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  return contained([&] { return handle->generations.names.release(cell) ? int32_t{RUNG_OK} : failCell(cell); });
}

int32_t rung_instance_cell(const rung_instance* instance, rung_cell cell, rung_cell_info* info) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  return contained([&] {
    const std::shared_ptr<const Generation> running = handle->generations.running();
    const std::optional<LocatedCell> found =
        handle->generations.names.locate(*handle->environment, running->program(), cell);
    if (!found) return failCell(cell);
    if (found->state != CellState::Good) return failState(found->state);
    return giveStruct(info, infoOf(running->program(), *found));
  });
}

int32_t rung_instance_read(const rung_instance* instance, rung_cell cell, uint32_t first, uint32_t count,
                           rung_value* values) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  int32_t status = RUNG_OK;
  const LocatedCell* found = elementsOf(*call, cell, false, first, count, values, status);
  if (found == nullptr) return status;
  const core::Memory memory = call->running.memory();
  for (uint32_t i = 0; i < count; ++i)
    values[i] = first + i == 0 ? firstValue(memory, *found) : valueAt(memory, elementPlace(memory, *found, first + i));
  return RUNG_OK;
}

int32_t rung_instance_write(rung_instance* instance, rung_cell cell, uint32_t first, uint32_t count,
                            const rung_value* values) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  int32_t status = RUNG_OK;
  const LocatedCell* found = elementsOf(*call, cell, true, first, count, values, status);
  if (found == nullptr) return status;
  const core::Memory memory = call->running.memory();
  for (uint32_t i = 0; i < count; ++i) writeAt(memory, elementPlace(memory, *found, first + i), values[i]);
  call->running.hold();
  for (uint32_t i = 0; call->recorder && i < count; ++i)
    call->recorder->written(elementPlace(memory, *found, first + i));
  return RUNG_OK;
}

int32_t rung_instance_read_all(const rung_instance* instance, const rung_cell* cells, uint32_t count,
                               rung_value* values) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  if ((cells == nullptr || values == nullptr) && count != 0)
    return fail(RUNG_BAD_ARGUMENT, "the cells or the values are null, their number is not 0");
  const core::Memory memory = call->running.memory();
  int32_t status = RUNG_OK;
  for (uint32_t i = 0; i < count; ++i) {
    const LocatedCell* found = numberCell(*call, cells[i], false, status);
    if (found == nullptr) return status;
    values[i] = firstValue(memory, *found);
  }
  return RUNG_OK;
}

int32_t rung_instance_write_all(rung_instance* instance, const rung_cell* cells, uint32_t count,
                                const rung_value* values) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if ((cells == nullptr || values == nullptr) && count != 0)
    return fail(RUNG_BAD_ARGUMENT, "the cells or the values are null, their number is not 0");
  int32_t status = RUNG_OK;
  for (uint32_t i = 0; i < count; ++i)
    if (numberCell(*call, cells[i], true, status) == nullptr) return status;
  const core::Memory memory = call->running.memory();
  for (uint32_t i = 0; i < count; ++i) writeAt(memory, call->now().cells.at(cells[i])->place, values[i]);
  call->running.hold();
  for (uint32_t i = 0; call->recorder && i < count; ++i) call->recorder->written(call->now().cells.at(cells[i])->place);
  return RUNG_OK;
}

namespace {

const LocatedCell* textCell(const rung_instance& instance, rung_cell cell, bool writes, int32_t& status) noexcept {
  const LocatedCell* found = usable(instance, cell, writes, status);
  if (found == nullptr || found->type == RUNG_TYPE_TEXT) return found;
  status = fail(RUNG_WRONG_TYPE, "the cell is not a text: use rung_instance_read and rung_instance_write");
  return nullptr;
}

} // namespace

int32_t rung_instance_read_text(const rung_instance* instance, rung_cell cell, char* text, size_t bytes) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  if (text == nullptr || bytes == 0) return fail(RUNG_BAD_ARGUMENT, "the buffer for the text is null or has no bytes");
  int32_t status = RUNG_OK;
  const LocatedCell* found = textCell(*call, cell, false, status);
  if (found == nullptr) return status;
  return contained([&] {
    putText({text, bytes}, call->control->shownText(call->running.readText(found->ref)));
    return int32_t{RUNG_OK};
  });
}

int32_t rung_instance_write_text(rung_instance* instance, rung_cell cell, const char* text) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (text == nullptr) return fail(RUNG_BAD_ARGUMENT, "the text is null");
  int32_t status = RUNG_OK;
  const LocatedCell* found = textCell(*call, cell, true, status);
  if (found == nullptr) return status;
  return contained([&] {
    runtime::writeText(call->running.memory(), found->ref, call->control->memoryText(text, found->ref.count));
    call->running.hold();
    if (call->recorder) call->recorder->writtenText(found->ref);
    return int32_t{RUNG_OK};
  });
}

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
    if (call->recorder) call->recorder->inputsChanged();
    return int32_t{RUNG_OK};
  });
}
