// See fake_hal.h.
#include "tests/realtime/fake_hal.h"

#include <rtapi.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <ctime>
#include <sstream>
#include <type_traits>

#include "machine/rung-hal/hal_api.h"

// The component, and where it keeps its parameters, as RTAPI finds them.
extern "C" {
int rtapi_app_main();
void rtapi_app_exit();
extern void* rtapi_info_address_so;
extern void* rtapi_info_address_map;
extern void* rtapi_info_address_retain;
extern void* rtapi_info_address_names;
extern int rtapi_info_size_names;
}

namespace rung::test {
namespace {

constexpr int kComponent = 7;

} // namespace

FakeHal* FakeHal::hal_ = nullptr;

bool FakeHal::hasReferences() { return RUNG_HAL_REFERENCES != 0; }

FakeHal::FakeHal() { hal_ = this; }

FakeHal::~FakeHal() {
  inList_ = false;
  if (thread_.joinable()) thread_.join();
  hal_ = nullptr;
}

int FakeHal::load(const std::string& program, const std::string& map, const std::string& retain,
                  const std::string& prefix) {
  arguments_.clear();
  setArgument(rtapi_info_address_so, program);
  setArgument(rtapi_info_address_map, map);
  setArgument(rtapi_info_address_retain, retain);
  setArgument(rtapi_info_address_names, prefix);
  return rtapi_app_main();
}

// Words between commas, as RTAPI takes a list apart.
void FakeHal::setArgument(void* place, const std::string& text) {
  char** const list = static_cast<char**>(place);
  std::fill(list, list + rtapi_info_size_names, nullptr);
  std::istringstream words(text);
  std::string word;
  for (int i = 0; i < rtapi_info_size_names && std::getline(words, word, ','); ++i)
    list[i] = arguments_.emplace_back(std::move(word)).data();
}

void FakeHal::unload() {
  rtapi_app_exit();
  if (thread_.joinable()) thread_.join();
}

void FakeHal::startThread(const std::string& name, int64_t periodNs) {
  inList_ = true;
  threadCalls_ = 0;
  thread_ = std::thread([this, periodNs, call = function(name)] {
    const std::chrono::nanoseconds period(periodNs);
    // It has looked at its list long before it calls.
    for (auto due = std::chrono::steady_clock::now(); inList_; due += period) {
      std::this_thread::sleep_until(due + period / 2);
      call.call(periodNs);
      ++threadCalls_;
      std::this_thread::sleep_until(due + period);
    }
  });
}

std::vector<std::string> FakeHal::lines() const {
  std::vector<std::string> list;
  for (size_t i = 0; i < std::min(lineCount_.load(), kLines); ++i) {
    const std::string_view line = lines_[i].data();
    const bool isFrame =
        line.find(" started with the program ") != line.npos || line.ends_with(" the host has ended\n");
    if (!isFrame) list.emplace_back(line);
  }
  return list;
}

int FakeHal::begin() {
  if (fails()) return -ENOMEM;
  if (initialised_ > 0) return -EINVAL; // HAL knows the name
  ++initialised_;
  return kComponent;
}

int FakeHal::end(int component) {
  if (component != kComponent || initialised_ == 0) return -EINVAL;
  inList_ = false;
  bitsAtExit_.clear();
  for (const auto& [name, place] : values_)
    if (isBit_.at(name) && *static_cast<volatile bool*>(place)) bitsAtExit_.push_back(name);
  values_.clear();
  functions_.clear();
  --initialised_;
  return 0;
}

void* FakeHal::allocate(long size) {
  if (fails()) return nullptr;
  memory_.emplace_back((static_cast<size_t>(size) + sizeof(double) - 1) / sizeof(double));
  return memory_.back().data();
}

void* FakeHal::addPin(const std::string& name, bool isBit) {
  memory_.emplace_back(1);
  return addValue(name, memory_.back().data(), isBit) == 0 ? memory_.back().data() : nullptr;
}

int FakeHal::addValue(const std::string& name, void* place, bool isBit) {
  if (fails()) return -ENOMEM;
  if (name.size() > HAL_NAME_LEN || !values_.emplace(name, place).second) return -EINVAL;
  isBit_[name] = isBit;
  return 0;
}

int FakeHal::addFunction(const std::string& name, Function function) {
  if (fails()) return -ENOMEM;
  return functions_.emplace(name, function).second ? 0 : -EINVAL;
}

void FakeHal::print(const char* format, va_list arguments) {
  const size_t line = lineCount_.fetch_add(1);
  if (line < kLines) std::vsnprintf(lines_[line].data(), kLineBytes, format, arguments);
}

} // namespace rung::test

using rung::test::FakeHal;

namespace {

#if RUNG_HAL_REFERENCES
void fill(void* place, rtapi_bool value) { hal_set_bool(static_cast<hal_bool_t>(place), value); }
void fill(void* place, rtapi_s32 value) { hal_set_si32(static_cast<hal_sint_t>(place), value); }
void fill(void* place, rtapi_u32 value) { hal_set_ui32(static_cast<hal_uint_t>(place), value); }
void fill(void* place, rtapi_real value) { hal_set_real(static_cast<hal_real_t>(place), value); }

template <class Reference, class Value>
int newReference(Reference* cell, Value start, const char* format, va_list arguments) {
  std::array<char, HAL_NAME_LEN + 2> name{}; // one too long is noticed
  std::vsnprintf(name.data(), name.size(), format, arguments);
  void* const place = FakeHal::the().addPin(name.data(), std::is_same_v<Value, rtapi_bool>);
  if (place == nullptr) return -EINVAL;
  fill(place, start);
  *cell = static_cast<Reference>(place);
  return 0;
}
#endif

} // namespace

extern "C" {

int hal_init(const char*) { return FakeHal::the().begin(); }
int hal_exit(int component) { return FakeHal::the().end(component); }
int hal_ready(int) { return FakeHal::the().fails() ? -EINVAL : 0; }
void* hal_malloc(long size) { return FakeHal::the().allocate(size); }

#if RUNG_HAL_REFERENCES

int hal_pin_new_bool(int, hal_pdir_t, hal_bool_t* cell, rtapi_bool start, const char* format, ...) {
  va_list name;
  va_start(name, format);
  const int result = newReference(cell, start, format, name);
  va_end(name);
  return result;
}
int hal_pin_new_si32(int, hal_pdir_t, hal_sint_t* cell, rtapi_s32 start, const char* format, ...) {
  va_list name;
  va_start(name, format);
  const int result = newReference(cell, start, format, name);
  va_end(name);
  return result;
}
int hal_pin_new_ui32(int, hal_pdir_t, hal_uint_t* cell, rtapi_u32 start, const char* format, ...) {
  va_list name;
  va_start(name, format);
  const int result = newReference(cell, start, format, name);
  va_end(name);
  return result;
}
int hal_pin_new_real(int, hal_pdir_t, hal_real_t* cell, rtapi_real start, const char* format, ...) {
  va_list name;
  va_start(name, format);
  const int result = newReference(cell, start, format, name);
  va_end(name);
  return result;
}
int hal_param_new_bool(int, hal_pdir_t, hal_bool_t* cell, rtapi_bool start, const char* format, ...) {
  va_list name;
  va_start(name, format);
  const int result = newReference(cell, start, format, name);
  va_end(name);
  return result;
}
int hal_param_new_si32(int, hal_pdir_t, hal_sint_t* cell, rtapi_s32 start, const char* format, ...) {
  va_list name;
  va_start(name, format);
  const int result = newReference(cell, start, format, name);
  va_end(name);
  return result;
}
int hal_param_new_ui32(int, hal_pdir_t, hal_uint_t* cell, rtapi_u32 start, const char* format, ...) {
  va_list name;
  va_start(name, format);
  const int result = newReference(cell, start, format, name);
  va_end(name);
  return result;
}
int hal_param_new_real(int, hal_pdir_t, hal_real_t* cell, rtapi_real start, const char* format, ...) {
  va_list name;
  va_start(name, format);
  const int result = newReference(cell, start, format, name);
  va_end(name);
  return result;
}

#else

int hal_pin_new(const char* name, hal_type_t type, hal_pin_dir_t, void** cell, int) {
  void* const value = FakeHal::the().addPin(name, type == HAL_BIT);
  if (value == nullptr) return -EINVAL;
  *cell = value;
  return 0;
}

int hal_param_bit_new(const char* name, hal_param_dir_t, hal_bit_t* value, int) {
  return FakeHal::the().addValue(name, const_cast<bool*>(value), true);
}
int hal_param_s32_new(const char* name, hal_param_dir_t, hal_s32_t* value, int) {
  return FakeHal::the().addValue(name, const_cast<int32_t*>(value), false);
}
int hal_param_u32_new(const char* name, hal_param_dir_t, hal_u32_t* value, int) {
  return FakeHal::the().addValue(name, const_cast<uint32_t*>(value), false);
}
int hal_param_float_new(const char* name, hal_param_dir_t, hal_float_t* value, int) {
  return FakeHal::the().addValue(name, const_cast<double*>(value), false);
}

#endif

int hal_export_funct(const char* name, void (*code)(void*, long), void* argument, int, int, int) {
  return FakeHal::the().addFunction(name, {code, argument});
}

void rtapi_print(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  FakeHal::the().print(format, arguments);
  va_end(arguments);
}

void rtapi_print_msg(msg_level_t level, const char* format, ...) {
  if (level == RTAPI_MSG_ERR) FakeHal::the().countError();
  va_list arguments;
  va_start(arguments, format);
  FakeHal::the().print(format, arguments);
  va_end(arguments);
}

long long rtapi_get_time() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  constexpr long long kNsPerSecond = 1'000'000'000;
  return now.tv_sec * kNsPerSecond + now.tv_nsec;
}
}
