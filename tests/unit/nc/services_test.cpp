// Tables of services: what the words of a row are, and how the service of a program is found again.
#include <gtest/gtest.h>

#include "rtlib/nc/gsk/services.h"
#include "rtlib/nc/nct/services.h"
#include "rtlib/nc/technol/services.h"

namespace rung::nc {
namespace {

TEST(Services, WordsOfARowAreArgumentsAndResults) {
  constexpr ServiceRow kRow(7, "ASK count value:f name:s data:b -> DR text:s");
  EXPECT_EQ(kRow.name, "ASK");
  ASSERT_EQ(kRow.arguments.count(), 4u);
  EXPECT_EQ(kRow.arguments[0].form, ServiceForm::Integer);
  EXPECT_EQ(kRow.arguments[1].name, "value");
  EXPECT_EQ(kRow.arguments[1].form, ServiceForm::Real);
  EXPECT_EQ(kRow.arguments[2].form, ServiceForm::Text);
  EXPECT_EQ(kRow.arguments[3].form, ServiceForm::Bytes);
  ASSERT_EQ(kRow.results.count(), 2u);
  EXPECT_EQ(kRow.results.find("text"), 1u);
  EXPECT_EQ(kRow.results.find("count"), std::nullopt);
}

TEST(Services, WithoutAnArrowNoAnswerIsTaken) {
  constexpr ServiceRow kWithout(1, "PUT value"), kNothing(2, "PUT value ->"), kBare(3, "STOP");
  EXPECT_FALSE(kWithout.takesAnswer);
  EXPECT_TRUE(kNothing.takesAnswer);
  EXPECT_EQ(kNothing.arguments.count(), 1u);
  EXPECT_EQ(kNothing.results.count(), 0u);
  EXPECT_EQ(kBare.name, "STOP");
  EXPECT_EQ(kBare.arguments.count(), 0u);
}

TEST(Services, AreFoundByTheirTexts) {
  for (const char* dialect : {"fanuc", "gsk", "nct", "technol"}) {
    uint32_t kind = 1;
    for (; const ServiceRow* row = serviceOf(dialect, kind); ++kind) {
      EXPECT_EQ(row->kind, kind) << row->text;
      EXPECT_EQ(serviceKind(dialect, row->text), kind) << row->text;
      EXPECT_EQ(row->text.data()[row->text.size()], '\0') << row->text;
    }
    EXPECT_GT(kind, 1u) << dialect;
  }
}

// A program of a later compiler, or of another one.
TEST(Services, OthersAreUnknown) {
  EXPECT_EQ(serviceKind("gsk", "windr function length -> end data"), kUnknownService);
  EXPECT_EQ(serviceKind("gsk", nct::service(nct::ServiceKind::ReadArray).text), kUnknownService);
  EXPECT_EQ(serviceKind("other", gsk::service(pmc::ServiceKind::ReadWindow).text), kUnknownService);
  EXPECT_EQ(serviceOf("gsk", kUnknownService), nullptr);
  EXPECT_EQ(serviceOf("gsk", UINT32_MAX), nullptr);
}

TEST(Services, OfDevices) {
  using namespace technol;
  EXPECT_TRUE(hasDevices("technol"));
  EXPECT_FALSE(hasDevices("gsk"));
  EXPECT_EQ(deviceOf(ServiceKind::Unknown), Device::None);
  EXPECT_EQ(deviceOf(ServiceKind::Configuration), Device::None);
  EXPECT_EQ(deviceOf(ServiceKind::ComControl), Device::Com);
  EXPECT_EQ(deviceServiceOf("gsk", 1), nullptr);
  EXPECT_EQ(deviceServiceOf("technol", static_cast<uint32_t>(ServiceKind::Define)), nullptr);
  EXPECT_EQ(deviceServiceOf("technol", static_cast<uint32_t>(ServiceKind::CanSend)),
            &deviceService(ServiceKind::CanSend));
  EXPECT_EQ(findDeviceService("ANALOG")->kind(), ServiceKind::Analog);
  EXPECT_EQ(findDeviceService("RAMP"), nullptr);
}

} // namespace
} // namespace rung::nc
