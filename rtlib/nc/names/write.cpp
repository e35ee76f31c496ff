// Writing with an explanation for values that would be lost (see write.h).
#include "rtlib/nc/names/write.h"

#include "rtlib/nc/names/names.h"

namespace rung::nc {

namespace {

std::string lost(const rung_program& program, const runtime::Ref& ref, const std::optional<runtime::Ref>& copied) {
  if (!copied) return {};
  const std::string lasting = placeName(program, *copied);
  return "a value written to " + placeName(program, ref) + " is lost: " + lasting +
         " is copied over it before the program reads it; write " + lasting;
}

} // namespace

std::string write(runtime::Instance& instance, const runtime::Ref& ref, uint64_t value) {
  return lost(instance.program(), ref, instance.write(ref, value));
}

std::string writeReal(runtime::Instance& instance, const runtime::Ref& ref, double value) {
  return lost(instance.program(), ref, instance.writeReal(ref, value));
}

std::string writeText(runtime::Instance& instance, const runtime::Ref& ref, std::string_view text) {
  return lost(instance.program(), ref, instance.writeText(ref, text));
}

} // namespace rung::nc
