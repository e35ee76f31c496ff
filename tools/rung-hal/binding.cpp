// Look-up and checks of the names in a mapping file.
#include "tools/rung-hal/binding.h"

#include <charconv>
#include <cmath>

#include "rtlib/host/program_info.h"

namespace rung::hal {
namespace {

constexpr std::string_view kPositions = "NC.MPOS.";
constexpr uint32_t kPositionBytes = 4;

enum class Access : uint8_t { Read, Write }; // by HAL

class Binder {
public:
  Binder(const MapFile& map, const host::Instance& instance, nc::Control& control, std::vector<std::string>& errors)
      : map_(map), instance_(instance), control_(control), errors_(errors) {}

  Binding run() {
    Binding binding;
    for (const MapLink& link : map_.inputs) addLink(binding.inputs, link, Access::Write);
    for (const MapLink& link : map_.outputs) addLink(binding.outputs, link, Access::Read);
    for (const MapConst& constant : map_.constants) addConstant(binding.constants, constant);
    checkFunctions();
    return binding;
  }

private:
  void checkFunctions() {
    nc::Functions* functions = control_.functions();
    for (const MapSend& send : map_.sends)
      if (functions == nullptr)
        fail(send.at, "send: the handshake of M, S and T functions is not supported yet for this dialect (" +
                          std::string(instance_.program().dialect) +
                          "); remove the table, and connect the signals in [in] and [out]");
    if (map_.highSpeed && (functions == nullptr || !functions->useHighSpeed()))
      fail(*map_.highSpeed, "high-speed: this dialect has no such handshake; remove the line");
  }

  void addLink(std::vector<PinLink>& links, const MapLink& link, Access access) {
    const PinType type = map_.pins[link.pin].type;
    if (auto place = find(link.name, type, access, link.at)) links.push_back({link.pin, type, *place, link.scale});
  }

  // An integer is also a value of a real number.
  void addConstant(std::vector<ConstLink>& links, const MapConst& constant) {
    std::optional<host::Ref> place = lookUp(constant.name, Access::Write, constant.at);
    if (!place) return;
    PinType type = constant.type;
    if (place->kind == host::RefKind::Real && type != PinType::Bit) type = PinType::Float;
    if (type == PinType::Float) place = realOf(constant.name, *place);
    const bool isBit = place->kind == host::RefKind::Bit;
    if (isBit && type != PinType::Bit) return void(fail(constant.at, constant.name + " is a bit; write true or false"));
    if (!isBit && type == PinType::Bit) return void(fail(constant.at, constant.name + " is not a bit; write a number"));
    if (place->kind == host::RefKind::Int && !fits(constant.value, place->width))
      return void(fail(constant.at, constant.name + ": the value does not fit into the cell, which has " +
                                        std::to_string(place->width) + " bits"));
    links.push_back({type, *place, constant.value});
  }

  static bool isPosition(std::string_view name) { return name.starts_with(kPositions); }

  // A real number where the program has one.
  host::Ref realOf(std::string_view name, const host::Ref& place) const {
    return isPosition(name) ? place : host::asReal(instance_.memory(), place).value_or(place);
  }

  // With a sign or without.
  static bool fits(double value, uint32_t width) {
    return value >= -std::ldexp(1, static_cast<int>(width) - 1) && value < std::ldexp(1, static_cast<int>(width));
  }

  std::optional<host::Ref> find(const std::string& name, PinType type, Access access, MapPosition at) {
    std::optional<host::Ref> place = lookUp(name, access, at);
    if (!place) return std::nullopt;
    if (type == PinType::Float) place = realOf(name, *place);
    const bool isBit = place->kind == host::RefKind::Bit;
    if (type == PinType::Bit && !isBit)
      return fail(at, name + " is not a bit; " +
                          (isPosition(name) ? "s32, u32 or float" : "s32, u32, float or a bit of it") + " is possible");
    if (type != PinType::Bit && isBit) return fail(at, name + " is a bit, not " + std::string(pinTypeName(type)));
    if (type != PinType::Float && place->kind == host::RefKind::Real)
      return fail(at, name + " is a real number; its type is float");
    return place;
  }

  std::optional<host::Ref> lookUp(const std::string& name, Access access, MapPosition at) {
    if (isPosition(name)) return position(name, access, at);
    // What the NC and the machine write is also what they see: for NCT both are the time-slice copy.
    std::optional<host::Ref> place = control_.writePlace(instance_, name);
    if (!place) return fail(at, name + ": the program has no such name or address");
    if (place->kind == host::RefKind::Constant) return fail(at, name + " is a constant of the program");
    if (place->kind == host::RefKind::Text) return fail(at, name + " is a text; HAL has no pins for texts");
    if (access == Access::Write && isOutputOnly(*place))
      return fail(at, name + " is an output of the program; it cannot be written");
    return place;
  }

  // NC.MPOS.N, the machine position of an axis in 0.001 mm: the program has it where it reads it (PSGNL, PSGN2).
  std::optional<host::Ref> position(const std::string& name, Access access, MapPosition at) {
    const rung_program& program = instance_.program();
    const uint32_t space = host::findSpace(program, "@MPOS");
    if (space == RUNG_NONE) return fail(at, name + ": the program reads no machine positions");
    const uint32_t axes = program.spaces[space].byte_count / kPositionBytes;
    uint32_t axis = 0;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + kPositions.size(), end, axis);
    if (error != std::errc() || rest != end || axis == 0 || axis > axes)
      return fail(at, name + ": axes are 1 to " + std::to_string(axes));
    if (access == Access::Read) return fail(at, name + " is written by HAL, not by the program");
    return host::intRef(space, kPositionBytes * (axis - 1), 8 * kPositionBytes);
  }

  bool isOutputOnly(const host::Ref& place) const {
    const uint32_t flags = instance_.program().spaces[place.space].flags;
    return (flags & RUNG_SPACE_OUTPUT) != 0 && (flags & RUNG_SPACE_INPUT) == 0;
  }

  std::nullopt_t fail(MapPosition at, const std::string& what) {
    errors_.push_back(map_.message(at, what));
    return std::nullopt;
  }

  const MapFile& map_;
  const host::Instance& instance_;
  nc::Control& control_;
  std::vector<std::string>& errors_;
};

} // namespace

Binding bindMap(const MapFile& map, const host::Instance& instance, nc::Control& control,
                std::vector<std::string>& errors) {
  return Binder(map, instance, control, errors).run();
}

} // namespace rung::hal
