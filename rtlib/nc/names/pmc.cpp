// BASE.b, BASE:bytes, and area letter with address (see pmc.h).
#include "rtlib/nc/names/pmc.h"

#include <string>

#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"

namespace rung::nc {

using runtime::Ref;
using runtime::RefKind;

namespace {

class PmcNames : public NameGrammar {
public:
  // T10 is an address in programs, so it is an address here, too, and not the signal of that name.
  bool addressFirst() const override { return true; }

  std::optional<Ref> takeApart(NameSearch& search, std::string_view name) const override {
    if (const size_t colon = name.rfind(':'); colon != std::string_view::npos)
      return search.widened(search.find(name.substr(0, colon)), text::numberIn<uint32_t>(name.substr(colon + 1)));
    if (const size_t dot = name.rfind('.'); dot != std::string_view::npos)
      return search.bitIn(name.substr(0, dot), name.substr(dot + 1));
    const std::optional<uint32_t> byte = text::numberIn<uint32_t>(name.substr(1));
    if (!byte) return std::nullopt;
    const std::string_view area = name.substr(0, 1);
    const uint32_t space = search.space(ofNames() == Case::Ignored ? text::upper(area) : std::string(area));
    return search.inSpace(runtime::intRef(space, *byte, 8));
  }

  std::string address(const rung_program& program, const Ref& place) const override {
    const std::string area = program.spaces[place.space].name;
    if (area.size() != 1) return NameGrammar::address(program, place); // hidden: no program can name it
    const std::string text = area + std::to_string(place.byte);
    return place.kind == RefKind::Bit ? text + "." + std::to_string(place.bit) : text;
  }

  std::string cellAddress(const rung_program& program, const Ref& place) const override {
    const bool longer = place.kind != RefKind::Bit && place.width > 8;
    return address(program, place) + (longer ? ":" + std::to_string(place.width / 8) : "");
  }
};

class FanucNames final : public PmcNames {
public:
  Case ofNames() const override { return Case::Ignored; }
};

} // namespace

const NameGrammar& gskNames() {
  static const PmcNames names;
  return names;
}

const NameGrammar& fanucNames() {
  static const FanucNames names;
  return names;
}

} // namespace rung::nc
