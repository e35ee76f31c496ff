// Rungs that come from no text: elements and nets as another source of drawings would give them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <initializer_list>

#include "frontend/ladder/rung.h"

namespace rung::frontend::ladder {
namespace {

using testing::ElementsAre;

struct Drawn {
  ElementKind kind;
  std::string_view name;
  uint32_t input;
  uint32_t output; // kNoNet.index: none
};

Rung rungOf(std::initializer_list<Drawn> elements, size_t nets) {
  Rung rung;
  rung.nets.resize(nets);
  for (const Drawn& drawn : elements) {
    Element element{.kind = drawn.kind};
    element.operands = {static_cast<uint32_t>(rung.operandPool.size()), 1};
    element.pins = {static_cast<uint32_t>(rung.pinPool.size()), 1};
    element.output = NetId{drawn.output};
    rung.operandPool.push_back({.text = drawn.name});
    rung.pinPool.push_back({.input = NetId{drawn.input}});
    rung.elements.push_back(element);
  }
  linkNets(rung);
  return rung;
}

std::vector<std::string_view> names(const Rung& rung) {
  std::vector<std::string_view> result;
  for (const Element& element : rung.elements) result.push_back(rung.operandOf(element).text);
  return result;
}

constexpr uint32_t kEnd = kNoNet.index;

TEST(Graph, ElementsComeAfterThoseThatDriveThem) {
  Rung rung = rungOf(
      {{ElementKind::Coil, "C", 2, kEnd}, {ElementKind::Contact, "B", 1, 2}, {ElementKind::Contact, "A", 0, 1}}, 3);
  Diagnostics diagnostics;
  EXPECT_TRUE(checkPower(rung, diagnostics));
  EXPECT_TRUE(checkClosed(rung, diagnostics));
  orderElements(rung, diagnostics);
  EXPECT_FALSE(rung.bad);
  EXPECT_THAT(names(rung), ElementsAre("A", "B", "C"));
  EXPECT_THAT(rung.driversOf(NetId{2}), ElementsAre(ElementId{1}));
}

TEST(Graph, ALoopIsReported) {
  Rung rung = rungOf({{ElementKind::Contact, "A", 1, 2}, {ElementKind::Contact, "B", 2, 1}}, 3);
  Diagnostics diagnostics;
  orderElements(rung, diagnostics);
  EXPECT_TRUE(rung.bad);
  EXPECT_EQ(diagnostics.errorCount(), 1U);
}

TEST(Graph, PowerComesFromTheRailAndLeadsToAnElement) {
  Diagnostics undriven;
  EXPECT_FALSE(checkPower(rungOf({{ElementKind::Coil, "A", 1, kEnd}}, 2), undriven));
  EXPECT_EQ(undriven.errorCount(), 1U);
  Diagnostics itself;
  EXPECT_FALSE(checkPower(rungOf({{ElementKind::Contact, "A", 1, 1}}, 2), itself));
  Diagnostics rail;
  EXPECT_FALSE(checkPower(rungOf({{ElementKind::Contact, "A", 0, 0}}, 1), rail));
  Diagnostics open;
  EXPECT_FALSE(checkClosed(rungOf({{ElementKind::Contact, "A", 0, 1}}, 2), open));
  EXPECT_EQ(open.errorCount(), 1U);
}

} // namespace
} // namespace rung::frontend::ladder
