// Cells by name, their values and texts (see values.h).
#include "rtlib/api/values.h"

#include "rtlib/api/error.h"
#include "rtlib/api/replacing.h"
#include "rtlib/api/structs.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/run/overwritten.h"

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

// The sentence for a name that is not entered.
int32_t failName(const rung_instance& instance, const rung_program& program, const char* name, CellState state) {
  if (state == CellState::Retyped) return fail(RUNG_WRONG_TYPE, "%s has no room for a real", name);
  if (state == CellState::Constant) return fail(RUNG_WRONG_TYPE, "%s is a constant: it cannot be written", name);
  if (state == CellState::Controls) return fail(RUNG_OVERWRITTEN, "the control itself writes %s: it can be read", name);
  if (state != CellState::Overwritten) return api::failName(program, name);
  const std::optional<runtime::Ref> place = instance.around->writePlace(program, name);
  const std::optional<runtime::Ref> source = place ? runtime::Overwritten(program).source(*place) : std::nullopt;
  return fail(RUNG_OVERWRITTEN, "%s is copied from %s before the program reads it: write there", name,
              source ? nc::describe(program, *source).c_str() : "another place");
}

int32_t checkAccess(int32_t access) noexcept {
  if (access >= 0 && access <= (RUNG_WRITE | RUNG_REAL)) return RUNG_OK;
  return fail(RUNG_BAD_ARGUMENT, "a cell is found for RUNG_READ or RUNG_WRITE, and RUNG_REAL, not %d", access);
}

int32_t failCell(rung_cell cell) noexcept { return fail(RUNG_BAD_ARGUMENT, "%u is not a cell of this instance", cell); }

// The cell as it can be used now; null: `status` says what is wrong.
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

// The cell, where `count` elements of it from the first-th on can be given to or taken from `values`.
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
  if (!instance.generations.names.find(*instance.around, program, {name, access}, state, cell))
    return fail(RUNG_OUT_OF_MEMORY, "an instance has no more than %u cells", CellTable::kMostCells);
  return state == CellState::Good ? int32_t{RUNG_OK} : failName(instance, program, name, state);
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
    const LocatedCell found = locateCell(*handle->around, in->program(), {name, access});
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
        handle->generations.names.locate(*handle->around, running->program(), cell);
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
    return int32_t{RUNG_OK};
  });
}
