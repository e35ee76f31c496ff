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
    for (const MapSend& send : map_.sends)
      if (const nc::Functions* functions = functionsOf(send)) checkKind(send, *functions);
    nc::Functions* first = control_.functions(0);
    for (const MapGroup& row : map_.groups)
      if (first == nullptr || !first->setGroup(row.code, row.group))
        fail(row.at, "m-groups: found M" + std::to_string(row.code) + " in group " + std::to_string(row.group) +
                         ", which a control of the dialect " + dialect() + " cannot have; remove the line");
    if (map_.highSpeed && (first == nullptr || !first->useHighSpeed()))
      fail(*map_.highSpeed, "high-speed: this dialect has no such handshake; remove the line");
  }

  std::string dialect() const { return instance_.program().dialect; }

  const nc::Functions* functionsOf(const MapSend& send) {
    const nc::Functions* functions = control_.functions(send.channel);
    if (functions != nullptr) return functions;
    uint32_t channels = 0;
    while (control_.functions(channels) != nullptr) ++channels;
    if (channels == 0)
      fail(send.at, "send: the dialect " + dialect() + " has no M, S and T functions; remove the table");
    else
      fail(send.at, "send: found channel " + std::to_string(send.channel + 1) + ", expected 1" +
                        (channels == 1 ? ": a control of the dialect " + dialect() + " has one channel"
                                       : " to " + std::to_string(channels) +
                                             ", the channels of a control of the dialect " + dialect()));
    return nullptr;
  }

  void checkKind(const MapSend& send, const nc::Functions& functions) {
    const std::string kind(nc::kFunctionKinds[static_cast<size_t>(send.kind)]);
    if (!functions.carries(send.kind, 0))
      fail(send.at, "send: found function " + kind + ", which the dialect " + dialect() +
                        " does not have; remove the table, and connect its signals in [in] and [out]");
    else if (!send.codePin && !functions.carries(send.kind, static_cast<uint32_t>(send.code)))
      fail(send.at, "send: found " + kind + std::to_string(send.code) + ", a code that the signals of the dialect " +
                        dialect() + " do not hold; write another code");
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
    if (place->kind == host::RefKind::Int && !fits(constant, place->width))
      return void(
          fail(constant.at, constant.name + ": the value does not fit into the cell, which has " +
                                std::to_string(place->width) + " bits" +
                                (type == PinType::Float ? "; a real number becomes an integer with a sign" : "")));
    links.push_back({type, *place, constant.value});
  }

  static bool isPosition(std::string_view name) { return name.starts_with(kPositions); }

  // A real number where the program has one.
  host::Ref realOf(std::string_view name, const host::Ref& place) const {
    return isPosition(name) ? place : host::asReal(instance_.memory(), place).value_or(place);
  }

  // Integers with a sign or without; what is converted from a real number has one.
  static bool fits(const MapConst& constant, uint32_t width) {
    const double half = std::ldexp(1, static_cast<int>(width) - 1);
    const double value = std::round(constant.value);
    return value >= -half && value < (constant.type == PinType::Float ? half : 2 * half);
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
