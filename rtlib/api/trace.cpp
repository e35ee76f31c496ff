// The passes of a watch as a file for wave viewers.
#include <bit>
#include <fstream>

#include "rtlib/api/error.h"
#include "rtlib/api/instance.h"
#include "rtlib/api/structs.h"
#include "rtlib/api/watch.h"
#include "rtlib/record/vcd.h"

using namespace rung;
using namespace rung::api;

namespace {

runtime::VcdName describe(rung_instance& instance, const Generation& program, rung_cell cell) {
  const LocatedCell& located = *program.cells.at(cell);
  const bool inMemory = located.state == CellState::Good && located.ref.kind != runtime::RefKind::Constant;
  runtime::VcdName name{.name = instance.generations.names.nameOf(cell)};
  name.scope = inMemory ? program.program().spaces[located.ref.space].name : "constants";
  if (located.type == RUNG_TYPE_F64) name.kind = runtime::VcdKind::Real;
  name.width = inMemory ? located.ref.width : 64;
  return name;
}

} // namespace

struct rung_trace {
  rung_trace(rung_watch& of, const char* path) : watch(of), out(path, std::ios::binary), vcd(out) {
    const std::shared_ptr<const Generation> program = watch.instance.generations.running();
    for (const rung_cell cell : watch.cells) names.push_back(describe(watch.instance, *program, cell));
    values.resize(names.size());
    shown.resize(names.size());
    vcd.begin(program->program().name, names);
  }

  bool writeNext() {
    rung_sample sample{};
    if (watch.next(values.data(), sample) != RUNG_OK) return false;
    if (sample.lost != lost) vcd.comment(std::to_string(sample.lost - lost) + " scans are missing here");
    lost = sample.lost;
    for (size_t i = 0; i < values.size(); ++i) {
      shown[i].known = true;
      shown[i].integer = static_cast<uint64_t>(values[i].integer);
      shown[i].real = values[i].real;
    }
    vcd.sample(sample.now_us, shown);
    return true;
  }

  uint32_t mark = kTraceMark;
  rung_watch& watch;
  std::ofstream out;
  runtime::VcdWriter vcd;
  std::vector<runtime::VcdName> names;
  std::vector<rung_value> values;
  std::vector<runtime::VcdValue> shown;
  uint64_t lost = 0;
};

namespace {

int32_t failFile() { return fail(RUNG_FAILED, "the file of the trace cannot be written"); }

} // namespace

int32_t rung_trace_new(rung_watch* watch, const char* path, rung_trace** trace) {
  rung_watch* handle = checked(watch, kWatchMark);
  if (handle == nullptr) return failHandle("a watch");
  if (path == nullptr || trace == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "a trace needs the name of a file, and a place for itself");
  if (!handle->keepsPasses()) return fail(RUNG_BAD_ARGUMENT, "the watch keeps no scans: make it with a depth above 0");
  return contained([&] {
    auto made = std::make_unique<rung_trace>(*handle, path);
    if (!made->out) return fail(RUNG_FAILED, "%s cannot be written", path);
    *trace = made.release();
    return int32_t{RUNG_OK};
  });
}

int32_t rung_trace_write(rung_trace* trace) {
  rung_trace* handle = checked(trace, kTraceMark);
  if (handle == nullptr) return failHandle("a trace");
  return contained([&] {
    if (!handle->writeNext()) return int32_t{RUNG_EMPTY};
    while (handle->writeNext()) {
    }
    handle->out.flush();
    return handle->out ? int32_t{RUNG_OK} : failFile();
  });
}

int32_t rung_trace_free(rung_trace* trace) {
  if (trace == nullptr) return RUNG_OK;
  rung_trace* handle = checked(trace, kTraceMark);
  if (handle == nullptr) return failHandle("a trace");
  return contained([&] {
    while (handle->writeNext()) {
    }
    handle->vcd.end();
    handle->out.close();
    const bool good = static_cast<bool>(handle->out);
    release(handle);
    return good ? int32_t{RUNG_OK} : failFile();
  });
}
