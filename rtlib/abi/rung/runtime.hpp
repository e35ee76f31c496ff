// rung/runtime.h for C++20: handles that free themselves, values by their C++ type, errors as exceptions. Functions
// that are called in a scan do not throw, but return the status. Every function of rung/runtime.h is here, and is
// documented there.
#ifndef RUNG_RUNTIME_HPP
#define RUNG_RUNTIME_HPP

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "rung/runtime.h"

namespace rung {

class Error : public std::runtime_error {
public:
  Error(int32_t status, const char* text) : std::runtime_error(text), status_(status) {}
  int32_t status() const noexcept { return status_; } // enum rung_status, below 0; or RUNG_LATER from Forces

private:
  int32_t status_;
};

// Returns the status, or throws if it is an error.
inline int32_t check(int32_t status) {
  if (status < 0) throw Error(status, rung_error_text());
  return status;
}

// A struct of rung/runtime.h with its size set.
template <class Struct>
Struct sized() {
  Struct out{};
  out.size = sizeof out;
  return out;
}

// The version of the library: major << 16 | minor.
inline uint32_t runtimeVersion() noexcept { return rung_runtime_version(); }

// The results of `get` for the indices from 0 on, until there are no more.
template <class Struct, class Get>
std::vector<Struct> each(Get get) {
  std::vector<Struct> all;
  auto one = sized<Struct>();
  for (uint32_t i = 0; check(get(i, &one)) == RUNG_OK; ++i) all.push_back(one);
  return all;
}

// Describes a name for this access (values of enum rung_access, added). Nothing: it cannot be found, and
// rung_error_text says why.
inline std::optional<rung_cell_info> cellInfo(rung_instance* instance, const std::string& name, int32_t access) {
  auto info = sized<rung_cell_info>();
  int64_t value = 0;
  const bool isThere = rung_instance_describe(instance, nullptr, name.c_str(), access, &info, &value) == RUNG_OK;
  return isThere ? std::optional(info) : std::nullopt;
}

template <class Handle, int32_t (*End)(Handle*)>
struct Ends {
  void operator()(Handle* handle) const noexcept { End(handle); }
};

class Image {
public:
  explicit Image(const std::string& path, const rung_image_options* options = nullptr) {
    rung_image* image = nullptr;
    check(rung_image_open(path.c_str(), options, &image));
    image_.reset(image);
  }
  explicit Image(rung_image* image) : image_(image) {} // which it ends
  static Image ofMemory(int file, const std::string& name) {
    rung_image* image = nullptr;
    check(rung_image_open_memory(file, name.c_str(), &image));
    return Image(image);
  }
  // An image of a program in memory, whose chunks find `engine` in rung_ctx::engine; `release` is called with `owner`
  // when the image is no longer used.
  static Image adopt(const rung_program& program, void* engine = nullptr, void (*release)(void*) = nullptr,
                     void* owner = nullptr) {
    rung_image* image = nullptr;
    check(rung_image_adopt(&program, engine, release, owner, &image));
    return Image(image);
  }
  rung_image* handle() const noexcept { return image_.get(); }
  void serve(const rung_code_maker& maker) { check(rung_image_serve(handle(), &maker)); }
  std::vector<rung_symbol_info> symbols() const {
    return each<rung_symbol_info>([this](uint32_t i, auto* out) { return rung_image_symbol(handle(), i, out); });
  }
  const rung_program& program() const noexcept { return *rung_image_program(image_.get()); }

private:
  std::unique_ptr<rung_image, Ends<rung_image, rung_image_close>> image_;
};

// The whole file from which an image was opened, as rung_image_file reads it; "" if there is none, or it has more than
// `most` bytes.
inline std::string fileOf(const rung_image* image, size_t most = static_cast<size_t>(-1)) {
  constexpr size_t kPiece = size_t{1} << 20;
  std::string bytes;
  size_t got = kPiece;
  while (got == kPiece && bytes.size() <= most) {
    const size_t before = bytes.size();
    bytes.resize(before + kPiece);
    if (rung_image_file(image, before, bytes.data() + before, &got) != RUNG_OK) return {};
    bytes.resize(before + got);
  }
  return bytes.size() <= most ? bytes : std::string();
}

enum class Access : int32_t { Read = RUNG_READ, Write = RUNG_WRITE };
enum class Power : int32_t { Cold = RUNG_COLD, Warm = RUNG_WARM };

class Replacement;
class Shadow;
class Forces;

class Instance {
public:
  explicit Instance(const Image& image, const rung_instance_options* options = nullptr) {
    rung_instance* instance = nullptr;
    check(rung_instance_new(image.handle(), options, &instance));
    instance_.reset(instance);
  }
  explicit Instance(rung_instance* instance) : instance_(instance) {} // which it ends
  rung_instance* handle() const noexcept { return instance_.get(); }

  void keep(const std::string& path) { check(rung_instance_keep(handle(), path.c_str())); }
  void flush() { check(rung_instance_flush(handle())); }
  // Why the last attempt to write retained memory failed; nothing if it did not fail.
  std::optional<std::string> unsaved() const {
    char text[512];
    return check(rung_instance_unsaved(handle(), text, sizeof text)) == RUNG_OK ? std::optional<std::string>(text)
                                                                                : std::nullopt;
  }
  // RUNG_FAULTED: a task that runs at power-on has faulted.
  int32_t powerOn(Power power = Power::Warm) {
    return check(rung_instance_power_on(handle(), static_cast<int32_t>(power)));
  }
  void powerOff() { check(rung_instance_power_off(handle())); }
  // True: the program needs a further scan before the power-off.
  bool beginPowerOff() noexcept { return rung_instance_begin_power_off(handle()) == RUNG_LATER; }

  int32_t runDue(int64_t elapsedNs) noexcept { return rung_instance_run_due(handle(), elapsedNs); }
  int32_t runDueFast(int64_t elapsedNs) noexcept { return rung_instance_run_due_fast(handle(), elapsedNs); }
  int32_t slice() noexcept { return rung_instance_slice(handle()); }
  int32_t scan() noexcept { return rung_instance_scan(handle()); }
  int32_t slot() noexcept { return rung_instance_slot(handle()); }
  int32_t fast() noexcept { return rung_instance_fast(handle()); }
  int32_t sample() noexcept { return rung_instance_sample(handle()); }
  int32_t stop() noexcept { return rung_instance_stop(handle()); }
  int32_t start() noexcept { return rung_instance_start(handle()); }
  int32_t limit(int64_t ns) noexcept { return rung_instance_limit(handle(), ns); }
  int32_t prefetch(int64_t untilNs) const noexcept { return rung_instance_prefetch(handle(), untilNs); }

  rung_state state() const {
    auto out = sized<rung_state>();
    check(rung_instance_state(handle(), &out));
    return out;
  }
  rung_program_info program() const {
    auto out = sized<rung_program_info>();
    check(rung_instance_program(handle(), &out));
    return out;
  }
  std::optional<rung_fault_info> fault() const {
    auto out = sized<rung_fault_info>();
    return check(rung_instance_fault(handle(), &out)) == RUNG_OK ? std::optional(out) : std::nullopt;
  }

  rung_cell find(const std::string& name, Access access = Access::Read) {
    rung_cell cell = 0;
    check(rung_instance_find(handle(), name.c_str(), static_cast<int32_t>(access), &cell));
    return cell;
  }
  void release(rung_cell cell) { check(rung_instance_release(handle(), cell)); }
  rung_cell_info describe(rung_cell cell) const {
    auto out = sized<rung_cell_info>();
    check(rung_instance_cell(handle(), cell, &out));
    return out;
  }
  // T is an arithmetic type: double or float for a cell of a real, an integer or bool for all others.
  template <class T>
  T read(rung_cell cell, uint32_t element = 0) const {
    rung_value value{};
    check(rung_instance_read(handle(), cell, element, 1, &value));
    if constexpr (std::is_floating_point_v<T>)
      return static_cast<T>(value.real);
    else
      return static_cast<T>(value.integer);
  }
  template <class T>
  void write(rung_cell cell, T value, uint32_t element = 0) {
    rung_value out{};
    if constexpr (std::is_floating_point_v<T>)
      out.real = value;
    else
      out.integer = static_cast<int64_t>(value);
    check(rung_instance_write(handle(), cell, element, 1, &out));
  }
  // The first elements of cells. `values` must have an element for each cell, else RUNG_BAD_ARGUMENT.
  int32_t readAll(std::span<const rung_cell> cells, std::span<rung_value> values) const noexcept {
    rung_value* to = values.size() == cells.size() ? values.data() : nullptr;
    return rung_instance_read_all(handle(), cells.data(), static_cast<uint32_t>(cells.size()), to);
  }
  int32_t writeAll(std::span<const rung_cell> cells, std::span<const rung_value> values) noexcept {
    const rung_value* from = values.size() == cells.size() ? values.data() : nullptr;
    return rung_instance_write_all(handle(), cells.data(), static_cast<uint32_t>(cells.size()), from);
  }
  std::string text(rung_cell cell) const {
    std::string out(4 * size_t{describe(cell).count} + 1, 0); // a byte of memory takes at most four in UTF-8
    check(rung_instance_read_text(handle(), cell, out.data(), out.size()));
    out.resize(out.find('\0'));
    return out;
  }
  void setText(rung_cell cell, const std::string& text) {
    check(rung_instance_write_text(handle(), cell, text.c_str()));
  }

  // Bind a variable of the host, which outlives the instance and is copied before or after every slice.
  template <class T>
  void bindInput(const std::string& name, const T& variable, double scale = 1) {
    bind(name, const_cast<T*>(&variable), hostType<T>(), RUNG_TO_PROGRAM, scale);
  }
  template <class T>
  void bindOutput(const std::string& name, T& variable, double scale = 1) {
    bind(name, &variable, hostType<T>(), RUNG_FROM_PROGRAM, scale);
  }
  // Bind an array or a struct of the host, which outlives the instance, to the bytes from a cell on.
  template <class T>
  void bindInputBlock(const std::string& name, const T& block) {
    bindBlock(name, block, RUNG_TO_PROGRAM);
  }
  template <class T>
  void bindOutputBlock(const std::string& name, T& block) {
    bindBlock(name, block, RUNG_FROM_PROGRAM);
  }

  // Binds a struct of the host, which outlives the instance, with a layout made by rungc bind.
  template <class T>
  void bindStruct(const rung_layout& layout, T& address) {
    check(rung_instance_bind_struct(handle(), &layout, &address));
  }
  // Successive slices without a consistent copy of a bound struct; nothing: no struct with counters is bound there.
  std::optional<uint32_t> inconsistent(const void* address) const noexcept {
    uint32_t slices = 0;
    return rung_instance_inconsistent(handle(), address, &slices) == RUNG_OK ? std::optional(slices) : std::nullopt;
  }

  std::optional<rung_message_info> nextMessage() {
    auto out = sized<rung_message_info>();
    return check(rung_instance_next_message(handle(), &out)) == RUNG_OK ? std::optional(out) : std::nullopt;
  }
  void defineMessage(uint32_t number, uint32_t flags, const std::string& text) {
    check(rung_instance_define_message(handle(), number, flags, text.c_str()));
  }
  std::vector<rung_message_info> shown() const {
    return each<rung_message_info>([this](uint32_t i, auto* out) { return rung_instance_shown(handle(), i, out); });
  }

  // Queued requests (RUNG_QUEUE), and their answers.
  std::optional<rung_request> nextRequest() {
    auto out = sized<rung_request>();
    return check(rung_instance_next_request(handle(), &out)) == RUNG_OK ? std::optional(out) : std::nullopt;
  }
  int32_t answer(const rung_reply& reply) noexcept { return rung_instance_answer(handle(), &reply); }

  // Functions of a part program; channels count from 0.
  int32_t beginFunction(uint32_t channel, rung_function_kind kind, uint32_t code, uint32_t& function) noexcept {
    return rung_instance_begin_function(handle(), channel, kind, code, &function);
  }
  int32_t functionDone(uint32_t channel, uint32_t function) noexcept {
    return rung_instance_function_done(handle(), channel, function);
  }
  int32_t abortFunctions(uint32_t channel) noexcept { return rung_instance_abort_functions(handle(), channel); }
  bool supportsFunction(uint32_t channel, rung_function_kind kind, uint32_t code) const noexcept {
    return rung_instance_supports_function(handle(), channel, kind, code) == RUNG_OK;
  }
  void groupFunction(uint32_t channel, uint32_t code, uint32_t group) {
    check(rung_instance_group_function(handle(), channel, code, group));
  }
  void highSpeedFunctions(uint32_t channel) { check(rung_instance_high_speed_functions(handle(), channel)); }
  int32_t serving(bool isServed) noexcept { return rung_instance_serving(handle(), isServed ? 1 : 0); }
  void axisGroup(uint32_t axis, uint32_t group) { check(rung_instance_axis_group(handle(), axis, group)); }

  // Another program takes over; a shadow runs beside this program; a set of forces is active. Shadow and forces last
  // until they end or are ended here.
  int32_t replace(const Replacement& replacement) noexcept;
  int32_t beginShadow(const Shadow& shadow) noexcept;
  int32_t endShadow() noexcept { return rung_instance_shadow(handle(), nullptr); }
  int32_t force(const Forces& forces) noexcept;
  int32_t endForces() noexcept { return rung_instance_force(handle(), nullptr); }
  // The active forces.
  std::vector<rung_force_info> forced() const {
    return each<rung_force_info>([this](uint32_t i, auto* out) { return rung_instance_forced(handle(), i, out); });
  }

  // The state between two scans; nothing: a scan has not ended.
  std::optional<std::vector<uint8_t>> save() const {
    size_t size = 0;
    if (check(rung_instance_save(handle(), nullptr, 0, &size)) == RUNG_LATER) return std::nullopt;
    std::vector<uint8_t> state(size);
    check(rung_instance_save(handle(), state.data(), state.size(), &size));
    return state;
  }
  void load(std::span<const uint8_t> state) { check(rung_instance_load(handle(), state.data(), state.size())); }
  void record(const rung_recording_options& options) { check(rung_instance_record(handle(), &options)); }
  void endRecording() { check(rung_instance_record(handle(), nullptr)); }
  void mark(const std::string& text) { check(rung_instance_mark(handle(), text.c_str())); }
  void keepRecording() { check(rung_instance_keep_recording(handle())); }
  void followRecording() { check(rung_instance_follow_recording(handle())); }
  // Nothing: the instance is not recorded.
  std::optional<rung_recording_info> recording() const {
    auto out = sized<rung_recording_info>();
    const int32_t status = rung_instance_recording(handle(), &out);
    if (status == RUNG_WRONG_STATE) return std::nullopt;
    check(status);
    return out;
  }
  void setClock(int64_t nowUs) { check(rung_instance_set_clock(handle(), nowUs)); }

  // The timer with this index in the program's tables; nothing: there are not that many.
  std::optional<rung_timer_info> timer(uint32_t index) const {
    auto out = sized<rung_timer_info>();
    return check(rung_instance_timer(handle(), index, &out)) == RUNG_OK ? std::optional(out) : std::nullopt;
  }

  // The profile of the rung with this index in the program's tables; nothing: there are not that many.
  std::optional<rung_profile> profile(uint32_t index) const {
    auto out = sized<rung_profile>();
    return check(rung_instance_profile(handle(), index, &out)) == RUNG_OK ? std::optional(out) : std::nullopt;
  }
  std::optional<rung_profile> worstRung() const {
    auto out = sized<rung_profile>();
    return check(rung_instance_worst_rung(handle(), &out)) == RUNG_OK ? std::optional(out) : std::nullopt;
  }
  void clearProfile() { check(rung_instance_clear_profile(handle())); }

private:
  template <class T>
  static constexpr rung_host_type hostType() {
    if constexpr (std::is_same_v<T, bool>)
      return RUNG_HOST_BOOL;
    else if constexpr (std::is_same_v<T, float>)
      return RUNG_HOST_F32;
    else if constexpr (std::is_same_v<T, double>)
      return RUNG_HOST_F64;
    else {
      static_assert(std::is_integral_v<T>, "a bound variable is a bool, an integer, a float or a double");
      constexpr rung_host_type kSigned[] = {RUNG_HOST_I8, RUNG_HOST_I16, RUNG_HOST_I32, RUNG_HOST_I64};
      constexpr rung_host_type kUnsigned[] = {RUNG_HOST_U8, RUNG_HOST_U16, RUNG_HOST_U32, RUNG_HOST_I64};
      constexpr int kWidth = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
      return std::is_signed_v<T> ? kSigned[kWidth] : kUnsigned[kWidth];
    }
  }
  template <class T>
  void bindBlock(const std::string& name, T& block, rung_direction direction) {
    static_assert(std::is_trivially_copyable_v<T>, "a block is plain memory: an array or a struct of numbers");
    const rung_block bound{name.c_str(), const_cast<void*>(static_cast<const void*>(&block)), sizeof block,
                           static_cast<uint32_t>(direction)};
    check(rung_instance_bind_blocks(handle(), &bound, 1));
  }
  void bind(const std::string& name, void* address, rung_host_type type, rung_direction direction, double scale) {
    const rung_variable variable{name.c_str(), address, static_cast<uint32_t>(type), static_cast<uint32_t>(direction),
                                 scale};
    check(rung_instance_bind(handle(), &variable, 1));
  }

  std::unique_ptr<rung_instance, Ends<rung_instance, rung_instance_free>> instance_;
};

// Another program for an instance (rung_replacement_new). It must be destroyed before the instance.
class Replacement {
public:
  // `memory`: the memory block of the new program, for the life of the instance; empty: the library allocates it.
  Replacement(Instance& instance, const Image& image, std::span<uint8_t> memory = {}) {
    rung_replacement* replacement = nullptr;
    check(rung_replacement_new(instance.handle(), image.handle(), memory.data(), memory.size(), &replacement));
    replacement_.reset(replacement);
  }
  rung_replacement* handle() const noexcept { return replacement_.get(); }

  rung_replacement_info report() const {
    auto out = sized<rung_replacement_info>();
    check(rung_replacement_report(handle(), &out));
    return out;
  }
  void allowLate() { check(rung_replacement_allow_late(handle())); }
  std::vector<rung_change> changes() const {
    return each<rung_change>([this](uint32_t i, auto* out) { return rung_replacement_change(handle(), i, out); });
  }
  std::vector<rung_rung_change> rungs() const {
    return each<rung_rung_change>([this](uint32_t i, auto* out) { return rung_replacement_rung(handle(), i, out); });
  }

private:
  std::unique_ptr<rung_replacement, Ends<rung_replacement, rung_replacement_free>> replacement_;
};

// A shadow of the running program (rung_shadow_new). It must be destroyed before the instance, in the instance's
// thread.
class Shadow {
public:
  Shadow(Instance& instance, const Image& image, uint32_t scans, uint32_t room = 64) {
    rung_shadow* shadow = nullptr;
    check(rung_shadow_new(instance.handle(), image.handle(), scans, room, &shadow));
    shadow_.reset(shadow);
  }
  rung_shadow* handle() const noexcept { return shadow_.get(); }

  bool work() { return check(rung_shadow_work(handle())) == RUNG_OK; }
  rung_shadow_info report() {
    auto out = sized<rung_shadow_info>();
    check(rung_shadow_report(handle(), &out));
    return out;
  }
  // The differences of the last report.
  std::vector<rung_difference> differences() const {
    return each<rung_difference>([this](uint32_t i, auto* out) { return rung_shadow_difference(handle(), i, out); });
  }

private:
  std::unique_ptr<rung_shadow, Ends<rung_shadow, rung_shadow_free>> shadow_;
};

// A set of forced cells (rung_forces_new), for the running program or for that of a replacement. It must be destroyed
// before the instance; while it is active, in the instance's thread.
class Forces {
public:
  Forces(Instance& instance, std::span<const rung_forced_cell> cells, Replacement* replacement = nullptr) {
    rung_forces* forces = nullptr;
    const int32_t status =
        check(rung_forces_new(instance.handle(), replacement != nullptr ? replacement->handle() : nullptr, cells.data(),
                              static_cast<uint32_t>(cells.size()), &forces));
    if (status == RUNG_LATER) throw Error(status, rung_error_text());
    forces_.reset(forces);
  }
  rung_forces* handle() const noexcept { return forces_.get(); }

private:
  std::unique_ptr<rung_forces, Ends<rung_forces, rung_forces_free>> forces_;
};

inline int32_t Instance::replace(const Replacement& replacement) noexcept {
  return rung_instance_replace(handle(), replacement.handle());
}
inline int32_t Instance::beginShadow(const Shadow& shadow) noexcept {
  return rung_instance_shadow(handle(), shadow.handle());
}
inline int32_t Instance::force(const Forces& forces) noexcept { return rung_instance_force(handle(), forces.handle()); }

// Cells that other threads watch (rung_watch_new). It must be destroyed before the instance.
class Watch {
public:
  struct Sample {
    rung_sample head;
    std::vector<rung_value> values; // in the order of the cells
  };

  Watch(Instance& instance, std::span<const rung_cell> cells, uint32_t depth = 0) : count_(cells.size()) {
    rung_watch* watch = nullptr;
    check(rung_watch_new(instance.handle(), cells.data(), static_cast<uint32_t>(cells.size()), depth, &watch));
    watch_.reset(watch);
  }
  rung_watch* handle() const noexcept { return watch_.get(); }

  std::optional<Sample> newest() const { return taken(&rung_watch_newest); }
  std::optional<Sample> next() { return taken(&rung_watch_next); }

private:
  template <class Take>
  std::optional<Sample> taken(Take take) const {
    Sample sample{sized<rung_sample>(), std::vector<rung_value>(count_)};
    if (check(take(handle(), sample.values.data(), &sample.head)) != RUNG_OK) return std::nullopt;
    return sample;
  }

  size_t count_;
  std::unique_ptr<rung_watch, Ends<rung_watch, rung_watch_free>> watch_;
};

// The scans of a watch as a file for wave viewers (rung_trace_new). It must be destroyed before the watch.
class Trace {
public:
  Trace(Watch& watch, const std::string& path) {
    rung_trace* trace = nullptr;
    check(rung_trace_new(watch.handle(), path.c_str(), &trace));
    trace_.reset(trace);
  }
  rung_trace* handle() const noexcept { return trace_.get(); }

  // False: there were no scans to write.
  bool write() { return check(rung_trace_write(handle())) == RUNG_OK; }
  // Ends the file; throws if it is incomplete, which the destructor does not report.
  void end() { check(rung_trace_free(trace_.release())); }

private:
  std::unique_ptr<rung_trace, Ends<rung_trace, rung_trace_free>> trace_;
};

} // namespace rung

#endif
