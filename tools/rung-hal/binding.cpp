// Look-up and checks of the names in a mapping file.
#include "tools/rung-hal/binding.h"

#include <charconv>

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
    for (const MapConst& constant : map_.constants)
      if (auto place = find(constant.name, constant.type, Access::Write, constant.line))
        binding.constants.push_back({constant.type, *place, constant.value});
    checkFunctions();
    return binding;
  }

private:
  void checkFunctions() {
    for (const MapSend& send : map_.sends)
      if (const nc::Functions* functions = functionsOf(send)) checkKind(send, *functions);
    nc::Functions* first = control_.functions(0);
    if (map_.highSpeedLine != 0 && (first == nullptr || !first->useHighSpeed()))
      fail(map_.highSpeedLine, "high-speed: this dialect has no such handshake; remove the line");
  }

  const nc::Functions* functionsOf(const MapSend& send) {
    const nc::Functions* functions = control_.functions(send.channel);
    if (functions != nullptr) return functions;
    uint32_t channels = 0;
    while (control_.functions(channels) != nullptr) ++channels;
    const std::string dialect = instance_.program().dialect;
    if (channels == 0)
      fail(send.line, "send: programs of the dialect " + dialect + " take no M, S and T functions; remove the line");
    else
      fail(send.line, "channel " + std::to_string(send.channel + 1) + ": a control of the dialect " + dialect +
                          (channels == 1 ? " has one channel" : " has channels 1 to " + std::to_string(channels)));
    return nullptr;
  }

  void checkKind(const MapSend& send, const nc::Functions& functions) {
    const std::string kind(nc::kFunctionKinds[static_cast<size_t>(send.kind)]);
    if (!functions.carries(send.kind, 0))
      fail(send.line, "send: the dialect " + std::string(instance_.program().dialect) + " has no function " + kind +
                          "; remove the line, and connect its signals by in and out lines");
    else if (!send.codePin && !functions.carries(send.kind, static_cast<uint32_t>(send.code)))
      fail(send.line, "send: " + kind + std::to_string(send.code) + " does not fit the signals of the dialect " +
                          instance_.program().dialect);
  }

  void addLink(std::vector<PinLink>& links, const MapLink& link, Access access) {
    const PinType type = map_.pins[link.pin].type;
    if (auto place = find(link.name, type, access, link.line)) links.push_back({link.pin, type, *place, link.scale});
  }

  std::optional<host::Ref> find(const std::string& name, PinType type, Access access, uint32_t line) {
    if (name.starts_with(kPositions)) return position(name, type, access, line);
    // What the NC and the machine write is also what they see: for NCT both are the time-slice copy.
    std::optional<host::Ref> place = control_.writePlace(instance_, name);
    if (!place) return fail(line, name + ": the program has no such name or address");
    if (place->kind == host::RefKind::Constant) return fail(line, name + " is a constant of the program");
    if (place->kind == host::RefKind::Text) return fail(line, name + " is a text; HAL has no pins for texts");
    if (access == Access::Write && isOutputOnly(*place))
      return fail(line, name + " is an output of the program; it cannot be written");
    if (type == PinType::Float) place = host::asReal(instance_.memory(), *place).value_or(*place);
    const bool isBit = place->kind == host::RefKind::Bit;
    if (type == PinType::Bit && !isBit)
      return fail(line, name + " is not a bit; s32, u32, float or a bit of it is possible");
    if (type != PinType::Bit && isBit) return fail(line, name + " is a bit, not " + std::string(pinTypeName(type)));
    if (type != PinType::Float && place->kind == host::RefKind::Real)
      return fail(line, name + " is a real number; its type is float");
    return place;
  }

  // NC.MPOS.N, the machine position of an axis in 0.001 mm: the program has it where it reads it (PSGNL, PSGN2).
  std::optional<host::Ref> position(const std::string& name, PinType type, Access access, uint32_t line) {
    const rung_program& program = instance_.program();
    const uint32_t space = host::findSpace(program, "@MPOS");
    if (space == RUNG_NONE) return fail(line, name + ": the program reads no machine positions");
    const uint32_t axes = program.spaces[space].byte_count / kPositionBytes;
    uint32_t axis = 0;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + kPositions.size(), end, axis);
    if (error != std::errc() || rest != end || axis == 0 || axis > axes)
      return fail(line, name + ": axes are 1 to " + std::to_string(axes));
    if (access == Access::Read) return fail(line, name + " is written by HAL, not by the program");
    if (type == PinType::Bit) return fail(line, name + " is not a bit; s32, u32 or float is possible");
    return host::intRef(space, kPositionBytes * (axis - 1), 8 * kPositionBytes);
  }

  bool isOutputOnly(const host::Ref& place) const {
    const uint32_t flags = instance_.program().spaces[place.space].flags;
    return (flags & RUNG_SPACE_OUTPUT) != 0 && (flags & RUNG_SPACE_INPUT) == 0;
  }

  std::nullopt_t fail(uint32_t line, const std::string& what) {
    errors_.push_back(map_.path + ":" + std::to_string(line) + ": " + what);
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
