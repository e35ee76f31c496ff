// Look-up and checks of the names in a mapping file.
#include "machine/host/binding.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <ranges>
#include <span>
#include <utility>

#include "machine/host/mapping_file.h"
#include "rtlib/nc/service.h"
#include "rtlib/text/name_parts.h"
#include "rtlib/text/number.h"
#include "rung/types.hpp"

namespace rung::host {
namespace {

constexpr std::string_view kPositions = "NC.MPOS.";
constexpr uint64_t kRealBits = 64;
constexpr uint32_t kIntegerBits = 32;     // of pins
constexpr uint32_t kMostSuggestions = 10; // the time of each is proportional to the number of symbols

enum class Use : uint8_t { Input, Output, Constant }; // Input and Constant are written by HAL

// An entry that refers to a name of the program.
struct Entry {
  std::string where; // its key, for messages
  std::string name;
  text::Position at;
  Use use = Use::Input;
  PinType type = PinType::Bit;
  double value = 0;     // of a constant, or the initial value of a parameter
  uint32_t bits = 0;    // number of bits with a pin each
  bool anyType = false; // the type of the entry is not known
};

// The reason why an entry cannot refer to a place.
enum class Misfit : uint8_t {
  None,
  Constant,
  Text,
  Output, // an output, which HAL would write
  Bit,    // a bit, for a larger type
  Cell,   // a cell, for a bit
  Real,   // a real, for an integer
  Narrow, // fewer bits than the entry needs
};

// The place of a name in the program, and its type.
struct Place {
  uint32_t type = RUNG_TYPE_BIT; // enum rung_type
  uint32_t space = RUNG_NONE;    // RUNG_NONE: a constant
  int64_t constant = 0;
  uint64_t first = 0; // bit of the space
  uint32_t count = 1; // number of elements

  bool isReal() const { return type == RUNG_TYPE_F64; }
  uint32_t width() const { return elementBits(type); }
};

bool isPosition(std::string_view name) { return name.starts_with(kPositions); }

std::string inQuotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

// A constant as written in the file.
std::string textOf(const Entry& entry) {
  if (entry.type == PinType::Bit) return entry.value != 0 ? "true" : "false";
  if (entry.type != PinType::Float) return std::to_string(static_cast<int64_t>(entry.value));
  char text[32];
  return {text, std::to_chars(std::begin(text), std::end(text), entry.value).ptr};
}

std::string typesOf(const Place& place, const Entry& entry) {
  if (place.isReal()) return "write type = \"float\"";
  return std::string("write type = \"s32\", \"u32\" or \"float\"") +
         (isPosition(entry.name) ? "" : ", or name a bit of the cell");
}

Mistake mistakeOf(Misfit misfit, const Place& place, const Entry& entry) {
  const std::string forType = entry.name + " for type " + std::string(pinTypeName(entry.type));
  const bool isConstant = entry.use == Use::Constant;
  const std::string pins = entry.name + " for " + std::to_string(entry.bits) + " pins";
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
    if (entry.bits != 0) return {"the bit " + pins, "a cell", "remove bits"};
    if (isConstant)
      return {textOf(entry) + " for a bit", "true or false", "write for example " + inQuotes(entry.name) + " = true"};
    return {"the bit " + forType, "a cell", "write type = \"bit\""};
  case Misfit::Cell:
    if (isConstant)
      return {textOf(entry) + " for a cell", "a number", "write for example " + inQuotes(entry.name) + " = 1"};
    return {"the cell " + forType, "a bit", typesOf(place, entry)};
  case Misfit::Narrow:
    return {"the cell of " + std::to_string(place.width()) + " bits " + pins, "a cell with as many bits",
            "write bits = " + std::to_string(place.width()) + " or less"};
  case Misfit::Real:
    if (entry.bits != 0) return {"the real number " + pins, "an integer", "remove bits, and write type = \"float\""};
    return {"the real number " + forType, "an integer", "write type = \"float\""};
  }
  return {};
}

class Binder {
public:
  Binder(const File& map, rung_instance* instance, const rung_replacement* replacement, const rung_program& program,
         std::vector<std::string>& errors)
      : map_(map), instance_(instance), replacement_(replacement), program_(program), errors_(errors) {}

  Binding run() {
    Binding binding;
    for (const Link& link : map_.links) addLink(binding.links, link);
    for (const NamedOnly& name : map_.namedOnly) checkName(name);
    for (const Constant& constant : map_.constants) addConstant(binding.constants, constant);
    for (const Protected& cell : map_.protectedCells) checkProtected(cell);
    checkShared(written_, "pin");
    checkShared(constants_, "constant");
    checkConstants();
    if (replacement_ == nullptr) checkFunctions();
    binding.warnings = std::move(warnings_);
    return binding;
  }

private:
  // ---- who writes what

  // Bits that an entry writes.
  struct Written {
    uint32_t space;
    uint64_t first, end;
    text::Position at;
    std::string where, name;
  };

  void addWritten(const Entry& entry, const Place& place) {
    if (entry.use == Use::Output) return;
    const uint64_t bits = entry.bits != 0 ? entry.bits : inWords(entry) ? kRealBits : place.width();
    std::vector<Written>& list = entry.use == Use::Constant ? constants_ : written_;
    list.push_back({place.space, place.first, place.first + bits, entry.at, entry.where, entry.name});
  }

  void warnOfNarrow(const Entry& entry, const Place& place) {
    const bool isInteger = entry.type == PinType::S32 || entry.type == PinType::U32;
    if (entry.use == Use::Output || !isInteger || entry.bits != 0 || place.width() >= kIntegerBits) return;
    warnings_.push_back(map_.message(
        entry.at, "warning: " + entry.where + ": type " + std::string(pinTypeName(entry.type)) + " has " +
                      std::to_string(kIntegerBits) + " bits, " + entry.name + " has " + std::to_string(place.width()) +
                      ": a number that does not fit loses its upper bits"));
  }

  // Reports bits that two pins write: the later one would overwrite the other.
  void checkShared(std::vector<Written>& written, const std::string& kind) {
    std::ranges::stable_sort(written, {}, [](const Written& w) { return std::pair(w.space, w.first); });
    const Written* reaches = nullptr; // the entry that ends last so far
    for (const Written& next : written) {
      if (reaches != nullptr && reaches->space == next.space && next.first < reaches->end) {
        const bool isLater = std::pair(next.at.line, next.at.column) >= std::pair(reaches->at.line, reaches->at.column);
        const Written& later = isLater ? next : *reaches;
        const Written& former = isLater ? *reaches : next;
        fail(later.at, later.where,
             {later.name + ", where " + former.where + " writes, too", "bits that no other " + kind + " writes",
              "remove one of the two"});
      }
      if (reaches == nullptr || reaches->space != next.space || next.end > reaches->end) reaches = &next;
    }
  }

  // Reports pins whose bits a constant overwrites, so that they have no effect.
  void checkConstants() {
    for (const Written& constant : constants_) {
      const auto meets = [&](const Written& pin) {
        return pin.space == constant.space && pin.first < constant.end && constant.first < pin.end;
      };
      if (const auto pin = std::ranges::find_if(written_, meets); pin != written_.end())
        warnings_.push_back(map_.message(constant.at, "warning: " + constant.where + ": the constant counts, and " +
                                                          pin->where + " (" + pin->name + ") has no effect there"));
    }
  }

  // ---- functions

  void checkFunctions() {
    for (const Send& send : map_.sends)
      if (checkChannel(send)) checkKind(send);
    for (const Group& row : map_.groups)
      if (rung_instance_group_function(instance_, 0, row.code, row.group) != RUNG_OK) failGroup(row);
    for (const AxisGroup& row : map_.axisGroups)
      if (rung_instance_axis_group(instance_, row.axis, row.group) != RUNG_OK)
        fail(row.at, "axis-groups",
             {"axis " + std::to_string(row.axis + 1) + " in group " + static_cast<char>('A' + row.group),
              "axes and groups that the dialect " + dialect() + " has", "write others, or remove the line"});
    if (map_.highSpeed && rung_instance_high_speed_functions(instance_, 0) != RUNG_OK)
      fail(*map_.highSpeed, "high-speed",
           {"true", "false, because the dialect " + dialect() + " has no such handshake", "remove the line"});
  }

  // The groups that can be chosen for a function, ascending. The query changes the assignment, which does not matter,
  // because a map with an error is not used.
  std::vector<uint32_t> groupsOf(uint32_t code) const {
    constexpr uint32_t kMostGroups = 32;
    std::vector<uint32_t> groups;
    for (uint32_t group = 0; group < kMostGroups; ++group)
      if (rung_instance_group_function(instance_, 0, code, group) == RUNG_OK) groups.push_back(group);
    return groups;
  }

  void failGroup(const Group& row) {
    constexpr uint32_t kMostCodes = 100;
    uint32_t code = 0;
    while (code < kMostCodes && groupsOf(code).empty()) ++code;
    const std::string found = "M" + std::to_string(row.code) + " in group " + std::to_string(row.group);
    const std::vector<uint32_t> groups = groupsOf(row.code);
    if (code == kMostCodes)
      fail(row.at, "m-groups",
           {found, "none, because a control of the dialect " + dialect() + " has no groups of M functions",
            "remove the table [m-groups]"});
    else if (groups.empty())
      fail(row.at, "m-groups",
           {found, "an M function whose group a machine may choose with the dialect " + dialect(), "remove the line"});
    else
      fail(row.at, "m-groups",
           {found, "a group from " + std::to_string(groups.front()) + " to " + std::to_string(groups.back()),
            "write for example " + std::to_string(row.code) + " = " + std::to_string(groups.front())});
  }

  std::string dialect() const { return program_.dialect; }

  bool supports(uint32_t channel, uint32_t kind, uint32_t code = 0) const {
    return rung_instance_supports_function(instance_, channel, static_cast<int32_t>(kind), code) == RUNG_OK;
  }
  // Whether the channel supports at least one kind.
  bool hasChannel(uint32_t channel) const {
    for (uint32_t kind = 0; kind < std::size(kFunctionKinds); ++kind)
      if (supports(channel, kind)) return true;
    return false;
  }

  bool checkChannel(const Send& send) {
    if (hasChannel(send.channel)) return true;
    uint32_t channels = 0;
    while (hasChannel(channels)) ++channels;
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
    return false;
  }

  void checkKind(const Send& send) {
    const std::string kind(kFunctionKinds[send.kind]);
    if (!supports(send.channel, send.kind))
      fail(send.at, "send.function",
           {inQuotes(kind), kindsOf(send.channel) + ", the functions of the dialect " + dialect(),
            "remove the table, and connect its signals in [in] and [out]"});
    else if (!send.codePin && !supports(send.channel, send.kind, static_cast<uint32_t>(send.code)))
      fail(send.at, "send.code",
           {kind + std::to_string(send.code),
            "at most " + kind + std::to_string(mostOf(send)) + ", what the signals of the dialect " + dialect() +
                " hold",
            "write such a code, or the name of a pin that has it"});
  }

  // The largest code that the control supports; it supports all from 0 on.
  uint32_t mostOf(const Send& send) const {
    uint32_t most = 0;
    for (uint32_t step = uint32_t{1} << 31; step != 0; step /= 2)
      if (supports(send.channel, send.kind, most + step)) most += step;
    return most;
  }

  std::string kindsOf(uint32_t channel) const {
    std::string kinds;
    for (uint32_t kind = 0; kind < std::size(kFunctionKinds); ++kind)
      if (supports(channel, kind)) kinds += (kinds.empty() ? "" : ", ") + inQuotes(kFunctionKinds[kind]);
    return kinds;
  }

  // ---- names

  void addLink(std::vector<PinLink>& links, const Link& link) {
    const Pin& pin = map_.pins[link.pin];
    const Use use = toProgram(pin.direction) ? Use::Input : Use::Output;
    Entry entry{std::string(tableName(pin.direction)) + "." + nameInFile(link) + ".name", link.name, link.at, use};
    entry.type = link.bits.empty() ? pin.type : PinType::U32;
    entry.bits = static_cast<uint32_t>(link.bits.size());
    entry.value = link.value.value_or(0);
    const std::optional<Place> place = find(entry);
    if (!place || (link.value && link.scale == 1 && !fits(entry, *place))) return;
    addWritten(entry, *place);
    warnOfNarrow(entry, *place);
    links.push_back(
        {link.pin, entry.type, pin.direction, link.name, link.scale, inWords(entry), link.bits, link.value});
  }

  // The common part of the names of pins for bits.
  std::string nameInFile(const Link& link) const {
    const std::string& name = map_.pins[link.pin].name;
    return link.bits.empty() ? name : name.substr(0, name.rfind('-'));
  }

  void checkName(const NamedOnly& name) {
    Entry entry{name.where, name.name, name.at, toProgram(name.direction) ? Use::Input : Use::Output};
    entry.anyType = true;
    (void)find(entry);
  }

  void addConstant(std::vector<ConstLink>& links, const Constant& constant) {
    Entry entry{"const." + constant.name, constant.name, constant.at, Use::Constant, constant.type, constant.value};
    const std::optional<Place> place = find(entry);
    if (!place || !isWhole(entry, *place) || !fits(entry, *place)) return;
    addWritten(entry, *place);
    links.push_back({entry.type, constant.name, constant.value, inWords(entry)});
  }

  void checkProtected(const Protected& cell) {
    Entry entry{"rungctl.protected", cell.name, cell.at, Use::Output};
    const std::optional<Place> place = lookUp(entry);
    if (place && place->space == RUNG_NONE) fail(cell.at, entry.where, mistakeOf(Misfit::Constant, *place, entry));
  }

  // A constant must be exact, whereas the values of pins are rounded.
  bool isWhole(const Entry& constant, const Place& place) {
    const bool isReal = place.isReal() || place.type == RUNG_TYPE_BIT || inWords(constant);
    if (isReal || constant.value == std::floor(constant.value)) return true;
    const auto whole = [](double value) { return std::to_string(static_cast<int64_t>(value)); };
    const double below = std::clamp(std::floor(constant.value), -0x1p31, 0x1p32);
    fail(constant.at, constant.where,
         {textOf(constant), "an integer, which is what the cell of " + std::to_string(place.width()) + " bits holds",
          "write " + whole(below) + " or " + whole(below + 1)});
    return false;
  }

  // Integers may be signed or unsigned; converted reals are signed.
  bool fits(const Entry& constant, const Place& place) {
    if (place.isReal() || place.type == RUNG_TYPE_BIT || inWords(constant)) return true;
    const bool isReal = constant.type == PinType::Float;
    const double half = std::ldexp(1, static_cast<int>(place.width()) - 1);
    const double end = isReal ? half : 2 * half;
    const double value = std::round(constant.value);
    if (value >= -half && value < end) return true;
    const auto text = [](double bound) { return std::to_string(static_cast<int64_t>(bound)); };
    fail(constant.at, constant.where,
         {textOf(constant),
          text(-half) + " to " + text(end - 1) + ", what the cell of " + std::to_string(place.width()) + " bits holds" +
              (isReal ? " of a real number, which becomes an integer with a sign" : ""),
          "write such a value, or name a longer cell"});
    return false;
  }

  // The place of the entry. An integer entry for a real place becomes one of type float.
  std::optional<Place> find(Entry& entry) {
    const std::optional<Place> place = lookUp(entry);
    if (!place) return std::nullopt;
    if (const Misfit misfit = misfitOf(*place, entry); misfit != Misfit::None)
      return fail(entry.at, entry.where, mistakeOf(misfit, *place, entry));
    if (place->isReal()) entry.type = PinType::Float;
    return place;
  }

  // Whether the name has words in which the program stores a real number.
  bool inWords(const Entry& entry) const {
    if (entry.type != PinType::Float || isPosition(entry.name)) return false;
    Place place;
    const auto isThere = [&](int32_t access) { return describe(entry.name, access | RUNG_REAL, place) == RUNG_OK; };
    return isThere(RUNG_WRITE) || (entry.use == Use::Output && isThere(RUNG_READ));
  }

  Misfit misfitOf(const Place& place, const Entry& entry) const {
    if (place.space == RUNG_NONE) return Misfit::Constant;
    if (place.type == RUNG_TYPE_TEXT) return Misfit::Text;
    if (entry.use != Use::Output && isOutputOnly(place)) return Misfit::Output;
    if (entry.anyType) return Misfit::None;
    const bool isBit = place.type == RUNG_TYPE_BIT;
    if (isBit != (entry.type == PinType::Bit)) return isBit ? Misfit::Bit : Misfit::Cell;
    const bool isInteger = entry.type == PinType::S32 || entry.type == PinType::U32;
    const bool needsReal = place.isReal() && isInteger && entry.use != Use::Constant;
    if (needsReal) return Misfit::Real;
    return entry.bits > place.width() ? Misfit::Narrow : Misfit::None;
  }

  bool isOutputOnly(const Place& place) const {
    const uint32_t flags = program_.spaces[place.space].flags;
    return (flags & RUNG_SPACE_OUTPUT) != 0 && (flags & RUNG_SPACE_INPUT) == 0;
  }

  std::optional<Place> lookUp(const Entry& entry) {
    if (isPosition(entry.name) && !checkPosition(entry)) return std::nullopt;
    int32_t status = RUNG_OK;
    if (const std::optional<Place> place = placeOf(entry.name, entry.use, status)) return place;
    if (status == RUNG_OVERWRITTEN)
      return fail(entry.at, entry.where, {entry.name, "a place where a value lasts", rung_error_text()});
    const std::string meant = meantBy(entry);
    return fail(entry.at, entry.where,
                {"an unknown name " + entry.name,
                 "a symbol or an address of the program, or a signal of the NC interface",
                 meant.empty() ? "write the name as the program has it" : "did you mean " + meant + "?"});
  }

  // The place as the NC and the machine see it. Nothing: there is no such name, or `status` is RUNG_OVERWRITTEN because
  // HAL would write it.
  std::optional<Place> placeOf(const std::string& name, Use use, int32_t& status) const {
    Place place;
    status = describe(name, RUNG_WRITE, place);
    if (status == RUNG_WRONG_TYPE || (status == RUNG_OVERWRITTEN && use == Use::Output))
      status = describe(name, RUNG_READ, place);
    return status == RUNG_OK ? std::optional(place) : std::nullopt;
  }

  int32_t describe(const std::string& name, int32_t access, Place& place) const {
    rung_cell_info info{};
    info.size = sizeof info;
    int64_t constant = 0;
    const int32_t status = rung_instance_describe(instance_, replacement_, name.c_str(), access, &info, &constant);
    if (status == RUNG_OK)
      place = {info.type, info.space, constant, uint64_t{8} * info.byte + info.bit, std::max(info.count, 1u)};
    return status;
  }

  // Checks the position of an axis; the program has as many axes as it has positions to read.
  bool checkPosition(const Entry& entry) {
    const auto mistake = [&](const Mistake& what) { return fail(entry.at, entry.where, what), false; };
    const std::string first = std::string(kPositions) + "1";
    uint32_t axes = 0;
    int32_t status = RUNG_OK;
    while (placeOf(std::string(kPositions) + std::to_string(axes + 1), Use::Input, status)) ++axes;
    if (axes == 0)
      return mistake({entry.name, "a name of this program, which reads no machine positions", "remove the entry"});
    const uint32_t axis = text::numberIn<uint32_t>(std::string_view(entry.name).substr(kPositions.size())).value_or(0);
    if (axis == 0 || axis > axes)
      return mistake(
          {entry.name, first + " to " + std::string(kPositions) + std::to_string(axes), "write for example " + first});
    if (entry.use == Use::Output)
      return mistake({entry.name + ", which HAL writes", "a name that the program writes", "move the pin to [in]"});
    return true;
  }

  // The name with the symbol that was probably meant; "" if none is close.
  std::string meantBy(const Entry& entry) {
    if (suggestions_++ >= kMostSuggestions) return {};
    const bool isWhole = text::headOf(entry.name).size() == entry.name.size();
    const auto fits = [&](const rung_symbol& symbol) {
      return (symbol.flags & (RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_CONST)) == 0 &&
             (!isWhole || misfitOf({symbol.type, symbol.space, symbol.value}, entry) == Misfit::None);
    };
    const std::span symbols(program_.symbols, program_.symbol_count);
    std::string meant = meantName(entry.name, symbols | std::views::filter(fits), &rung_symbol::name);
    if (meant.empty()) return {};
    // A bit, an index or a length may exceed the cell.
    int32_t status = RUNG_OK;
    const std::optional<Place> place = placeOf(meant, entry.use, status);
    return place && misfitOf(*place, entry) == Misfit::None ? meant : std::string();
  }

  std::nullopt_t fail(text::Position at, const std::string& where, const Mistake& mistake) {
    errors_.push_back(map_.message(at, where + ": " + mistake.text()));
    return std::nullopt;
  }

  const File& map_;
  rung_instance* instance_;
  const rung_replacement* replacement_; // null: the running program
  const rung_program& program_;
  std::vector<std::string>& errors_;
  uint32_t suggestions_ = 0;
  std::vector<Written> written_;   // by pins and parameters
  std::vector<Written> constants_; // by constants
  std::vector<std::string> warnings_;
};

} // namespace

Binding bindMap(const File& map, rung_instance* instance, const rung_program& program,
                std::vector<std::string>& errors) {
  if (!map.devices.empty() && !nc::hasDevices(program.dialect))
    errors.push_back(
        map.message(map.devices.front().at, "devices: found a device of this machine, expected none for a program of " +
                                                std::string(program.dialect) +
                                                ", which has no services of devices; remove the table [devices]"));
  return Binder(map, instance, nullptr, program, errors).run();
}

Binding bindMap(const File& map, rung_instance* instance, const rung_replacement* replacement,
                const rung_program& program, std::vector<std::string>& errors) {
  return Binder(map, instance, replacement, program, errors).run();
}

} // namespace rung::host
