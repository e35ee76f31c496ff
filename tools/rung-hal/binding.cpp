// Look-up and checks of the names in a mapping file.
#include "tools/rung-hal/binding.h"

#include <charconv>
#include <cmath>
#include <iterator>
#include <span>

#include "ir/support/similar.h"
#include "rtlib/host/program_info.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/text/number.h"

namespace rung::hal {
namespace {

constexpr std::string_view kPositions = "NC.MPOS.";
constexpr uint32_t kPositionBytes = 4;
constexpr uint32_t kMostSuggestions = 10; // each takes a time in proportion to the symbols of the program

enum class Use : uint8_t { Input, Output, Constant }; // HAL writes the first and the last

// What refers to a name of the program.
struct Entry {
  std::string where; // its key, for messages
  std::string name;
  MapPosition at;
  Use use = Use::Input;
  PinType type = PinType::Bit;
  double value = 0; // of a constant
};

// Why an entry cannot refer to a place.
enum class Misfit : uint8_t {
  None,
  Constant,
  Text,
  Output, // and HAL would write it
  Bit,    // and the type has more
  Cell,   // and the type is a bit
  Real,   // and the type is an integer
};

// What is wrong, in the order of a message.
struct Mistake {
  std::string found;
  std::string expected;
  std::string fix;
};

bool isPosition(std::string_view name) { return name.starts_with(kPositions); }

std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

// A constant as the file has it.
std::string shown(const Entry& entry) {
  if (entry.type == PinType::Bit) return entry.value != 0 ? "true" : "false";
  if (entry.type != PinType::Float) return std::to_string(static_cast<int64_t>(entry.value));
  char text[32];
  return {text, std::to_chars(std::begin(text), std::end(text), entry.value).ptr};
}

std::string typesOf(const host::Ref& place, const Entry& entry) {
  if (place.kind == host::RefKind::Real) return "write type = \"float\"";
  return std::string("write type = \"s32\", \"u32\" or \"float\"") +
         (isPosition(entry.name) ? "" : ", or name a bit of the cell");
}

Mistake mistakeOf(Misfit misfit, const host::Ref& place, const Entry& entry) {
  const std::string forType = entry.name + " for type " + std::string(pinTypeName(entry.type));
  const bool isConstant = entry.use == Use::Constant;
  switch (misfit) {
  case Misfit::None: break;
  case Misfit::Constant:
    return {"the constant " + entry.name + " (" + std::to_string(place.constant) + ")", "a place in the memory",
            "remove the entry, the value never changes"};
  case Misfit::Text:
    return {"the text " + entry.name, "a bit or a number", "remove the entry, HAL has no pins for texts"};
  case Misfit::Output:
    return {entry.name + ", an output of the program", "a name that HAL may write",
            isConstant ? "remove the line" : "move the pin to [out]"};
  case Misfit::Bit:
    if (isConstant)
      return {shown(entry) + " for a bit", "true or false", "write for example " + quoted(entry.name) + " = true"};
    return {"the bit " + forType, "a cell", "write type = \"bit\""};
  case Misfit::Cell:
    if (isConstant)
      return {shown(entry) + " for a cell", "a number", "write for example " + quoted(entry.name) + " = 1"};
    return {"the cell " + forType, "a bit", typesOf(place, entry)};
  case Misfit::Real: return {"the real number " + forType, "an integer", "write type = \"float\""};
  }
  return {};
}

class Binder {
public:
  Binder(const MapFile& map, const host::Instance& instance, nc::Control& control, std::vector<std::string>& errors)
      : map_(map), instance_(instance), control_(control), errors_(errors) {}

  Binding run() {
    Binding binding;
    for (const MapLink& link : map_.inputs) addLink(binding.inputs, link, Use::Input);
    for (const MapLink& link : map_.outputs) addLink(binding.outputs, link, Use::Output);
    for (const MapConst& constant : map_.constants) addConstant(binding.constants, constant);
    checkFunctions();
    return binding;
  }

private:
  // ---- functions

  void checkFunctions() {
    for (const MapSend& send : map_.sends)
      if (const nc::Functions* functions = functionsOf(send)) checkKind(send, *functions);
    nc::Functions* first = control_.functions(0);
    for (const MapGroup& row : map_.groups)
      if (first == nullptr || !first->setGroup(row.code, row.group))
        fail(row.at, "m-groups",
             {"M" + std::to_string(row.code) + " in group " + std::to_string(row.group),
              "what a machine can choose with the dialect " + dialect(), "write another group, or remove the line"});
    if (map_.highSpeed && (first == nullptr || !first->useHighSpeed()))
      fail(*map_.highSpeed, "high-speed",
           {"true", "false, because the dialect " + dialect() + " has no such handshake", "remove the line"});
  }

  std::string dialect() const { return instance_.program().dialect; }

  const nc::Functions* functionsOf(const MapSend& send) {
    const nc::Functions* functions = control_.functions(send.channel);
    if (functions != nullptr) return functions;
    uint32_t channels = 0;
    while (control_.functions(channels) != nullptr) ++channels;
    if (channels == 0)
      fail(send.at, "send",
           {"a function", "none, because the dialect " + dialect() + " has no M, S and T functions",
            "remove the table"});
    else
      fail(send.at, "send.channel",
           {std::to_string(send.channel + 1),
            (channels == 1 ? "1, the only channel" : "1 to " + std::to_string(channels) + ", the channels") +
                " of a control of the dialect " + dialect(),
            "write for example channel = 1"});
    return nullptr;
  }

  void checkKind(const MapSend& send, const nc::Functions& functions) {
    const std::string kind(nc::kFunctionKinds[static_cast<size_t>(send.kind)]);
    if (!functions.carries(send.kind, 0))
      fail(send.at, "send.function",
           {quoted(kind), kindsOf(functions) + ", the functions of the dialect " + dialect(),
            "remove the table, and connect its signals in [in] and [out]"});
    else if (!send.codePin && !functions.carries(send.kind, static_cast<uint32_t>(send.code)))
      fail(send.at, "send.code",
           {kind + std::to_string(send.code), "a code that the signals of the dialect " + dialect() + " hold",
            "write another code"});
  }

  static std::string kindsOf(const nc::Functions& functions) {
    std::string kinds;
    for (size_t i = 0; i < std::size(nc::kFunctionKinds); ++i)
      if (functions.carries(static_cast<nc::FunctionKind>(i), 0))
        kinds += (kinds.empty() ? "" : ", ") + quoted(nc::kFunctionKinds[i]);
    return kinds;
  }

  // ---- names

  void addLink(std::vector<PinLink>& links, const MapLink& link, Use use) {
    const MapPin& pin = map_.pins[link.pin];
    Entry entry{(use == Use::Input ? "in." : "out.") + pin.name + ".name", link.name, link.at, use, pin.type};
    if (const auto place = find(entry)) links.push_back({link.pin, pin.type, *place, link.scale});
  }

  void addConstant(std::vector<ConstLink>& links, const MapConst& constant) {
    Entry entry{"const." + constant.name, constant.name, constant.at, Use::Constant, constant.type, constant.value};
    const std::optional<host::Ref> place = find(entry);
    if (place && fits(entry, *place)) links.push_back({entry.type, *place, constant.value});
  }

  // Integers with a sign or without; what is converted from a real number has one.
  bool fits(const Entry& constant, const host::Ref& place) {
    if (place.kind != host::RefKind::Int) return true;
    const bool isReal = constant.type == PinType::Float;
    const double half = std::ldexp(1, place.width - 1);
    const double end = isReal ? half : 2 * half;
    const double value = std::round(constant.value);
    if (value >= -half && value < end) return true;
    const auto text = [](double bound) { return std::to_string(static_cast<int64_t>(bound)); };
    fail(constant.at, constant.where,
         {shown(constant),
          text(-half) + " to " + text(end - 1) + ", what the cell of " + std::to_string(place.width) + " bits holds" +
              (isReal ? " of a real number, which becomes an integer with a sign" : ""),
          "write such a value, or name a longer cell"});
    return false;
  }

  // The place of the entry; a real number where the program has one. An integer is also a value of a real number, and
  // becomes one of type float.
  std::optional<host::Ref> find(Entry& entry) {
    const std::optional<host::Ref> place = lookUp(entry);
    if (!place) return std::nullopt;
    if (const Misfit misfit = misfitOf(*place, entry); misfit != Misfit::None)
      return fail(entry.at, entry.where, mistakeOf(misfit, *place, entry));
    if (place->kind == host::RefKind::Real) entry.type = PinType::Float;
    if (entry.type != PinType::Float || isPosition(entry.name)) return place;
    return host::asReal(instance_.memory(), *place).value_or(*place);
  }

  Misfit misfitOf(const host::Ref& place, const Entry& entry) const {
    if (place.kind == host::RefKind::Constant) return Misfit::Constant;
    if (place.kind == host::RefKind::Text) return Misfit::Text;
    if (entry.use != Use::Output && isOutputOnly(place)) return Misfit::Output;
    const bool isBit = place.kind == host::RefKind::Bit;
    if (isBit != (entry.type == PinType::Bit)) return isBit ? Misfit::Bit : Misfit::Cell;
    const bool isInteger = entry.type == PinType::S32 || entry.type == PinType::U32;
    const bool needsReal = place.kind == host::RefKind::Real && isInteger && entry.use != Use::Constant;
    return needsReal ? Misfit::Real : Misfit::None;
  }

  bool isOutputOnly(const host::Ref& place) const {
    const uint32_t flags = instance_.program().spaces[place.space].flags;
    return (flags & RUNG_SPACE_OUTPUT) != 0 && (flags & RUNG_SPACE_INPUT) == 0;
  }

  std::optional<host::Ref> lookUp(const Entry& entry) {
    if (isPosition(entry.name)) return position(entry);
    // What the NC and the machine write is also what they see: for NCT both are the time-slice copy.
    std::optional<host::Ref> place = control_.writePlace(instance_.program(), entry.name);
    if (place) return place;
    const std::string meant = meantBy(entry);
    return fail(entry.at, entry.where,
                {"an unknown name " + entry.name,
                 "a symbol or an address of the program, or a signal of the NC interface",
                 meant.empty() ? "write the name as the program has it" : "did you mean " + meant + "?"});
  }

  // NC.MPOS.N, the machine position of an axis in 0.001 mm: the program has it where it reads it (PSGNL, PSGN2).
  std::optional<host::Ref> position(const Entry& entry) {
    const rung_program& program = instance_.program();
    const uint32_t space = host::findSpace(program, "@MPOS");
    if (space == RUNG_NONE)
      return fail(entry.at, entry.where,
                  {entry.name, "a name of this program, which reads no machine positions", "remove the entry"});
    const uint32_t axes = program.spaces[space].byte_count / kPositionBytes;
    const uint32_t axis = text::numberIn<uint32_t>(std::string_view(entry.name).substr(kPositions.size())).value_or(0);
    const std::string first = std::string(kPositions) + "1";
    if (axis == 0 || axis > axes)
      return fail(
          entry.at, entry.where,
          {entry.name, first + " to " + std::string(kPositions) + std::to_string(axes), "write for example " + first});
    if (entry.use == Use::Output)
      return fail(entry.at, entry.where,
                  {entry.name + ", which HAL writes", "a name that the program writes", "move the pin to [in]"});
    return host::intRef(space, kPositionBytes * (axis - 1), 8 * kPositionBytes);
  }

  // The name with the symbol that it may have meant; "" when none is close.
  std::string meantBy(const Entry& entry) {
    if (suggestions_++ >= kMostSuggestions) return {};
    const rung_program& program = instance_.program();
    const std::string_view head = nc::headOf(entry.name);
    const bool isWhole = head.size() == entry.name.size();
    Similar similar(head);
    for (const rung_symbol& symbol : std::span(program.symbols, program.symbol_count)) {
      if ((symbol.flags & (RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_CONST)) != 0) continue;
      if (!isWhole || misfitOf(host::refOf(symbol), entry) == Misfit::None) similar.offer(symbol.name);
    }
    if (similar.best().empty()) return {};
    std::string meant = entry.name;
    meant.replace(static_cast<size_t>(head.data() - entry.name.data()), head.size(), similar.best());
    // A bit, an index or a length may take the place out of the cell.
    const std::optional<host::Ref> place = control_.writePlace(instance_.program(), meant);
    return place && misfitOf(*place, entry) == Misfit::None ? meant : std::string();
  }

  std::nullopt_t fail(MapPosition at, const std::string& where, const Mistake& mistake) {
    errors_.push_back(
        map_.message(at, where + ": found " + mistake.found + ", expected " + mistake.expected + "; " + mistake.fix));
    return std::nullopt;
  }

  const MapFile& map_;
  const host::Instance& instance_;
  nc::Control& control_;
  std::vector<std::string>& errors_;
  uint32_t suggestions_ = 0;
};

} // namespace

Binding bindMap(const MapFile& map, const host::Instance& instance, nc::Control& control,
                std::vector<std::string>& errors) {
  return Binder(map, instance, control, errors).run();
}

} // namespace rung::hal
