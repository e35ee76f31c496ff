// START, STOP and blocks with motion under a host that moves the axes (man. l.1625-1644, 6396-6500, 2682-2711).
#include "rtlib/nc/control/technol/operation.h"

#include <gtest/gtest.h>

#include "tests/unit/technol/with_control.h"

namespace rung::nc {
namespace {

// EVENTS has the codes of the events, the last one in the lowest digit; LATER: a START waits for it.
constexpr const char* kData = "        DFM  GO,LATER,,,,,,\nEVENTS: DS 4\nINITS:  DS 2\nDONES:  DS 2\n";
constexpr const char* kMain = "        PROC_BEGIN _ON_EVENT\n        STO  DWRD.CODE\n        LOD  DWRD.EVENTS\n"
                              "        MULB CNST.10\n        AD   DWRD.CODE\n        STO  DWRD.EVENTS\n"
                              "        LOD  DWRD.CODE\n        EQ   PLCEVENT_START_REQ\n        LA   LATER\n"
                              "        FL1  1,START_SUSPEND\n        PROC_END _ON_EVENT\n";
constexpr const char* kInit =
    "        LOD  INITS\n        INR\n        STO  INITS\n        BEX\n        LDR  GO\n        EX0\n";
constexpr const char* kDone = "        LOD  DONES\n        INR\n        STO  DONES\n";

class TechnolOperation : public technol_test::WithControl {
protected:
  TechnolOperation()
      : WithControl(
            {.data = std::string(kData) + "CODE:   DS 4\n", .main = kMain, .blockInit = kInit, .blockDone = kDone}) {
    set("MPXPI", 1);
    scan();
  }

  void scan(int count = 1) {
    for (int i = 0; i < count; ++i) {
      control_.beforeSlice(*instance_);
      instance_->scan();
      control_.afterSlice(*instance_);
    }
  }
  // The events since the last call.
  uint64_t events() {
    const uint64_t now = get("EVENTS");
    set("EVENTS", 0);
    return now;
  }
};

TEST_F(TechnolOperation, AMotionIsABlockAndWaitsForItsInit) {
  set("G00PI", 1), set("SF_NOTINPOS", 1), set("MPYPI", 0);
  scan(3);
  EXPECT_EQ(get("STATUS_RESTART"), 1u);
  EXPECT_EQ(get("MPX"), 0u) << "before MODULE_BLOCK_INIT is through";
  EXPECT_EQ(get("AUTPI"), 1u);
  EXPECT_EQ(get("G00PI"), 1u);
  EXPECT_EQ(get("PO_F"), 1u);
  EXPECT_EQ(get("INITS"), 1u);
  set("GO", 1);
  scan();
  EXPECT_EQ(get("STATUS_RESTART"), 2u);
  EXPECT_EQ(get("MPX"), 1u);
  EXPECT_EQ(get("MPY"), 0u) << "MPYPI";
  set("MPXPI", 0);
  scan();
  EXPECT_EQ(get("MPX"), 0u);
  set("SF_NOTINPOS", 0);
  scan();
  EXPECT_EQ(get("DONES"), 1u);
  EXPECT_EQ(get("PO_POL"), 1u);
  EXPECT_EQ(get("PO_F"), 0u);
}

TEST_F(TechnolOperation, ByHandThereAreNoBlocks) {
  set("SF_MANUALMODE", 1), set("SF_NOTINPOS", 1), set("EN_AUTMAN", 1);
  scan(2);
  EXPECT_EQ(get("PO_F"), 0u);
  EXPECT_EQ(get("MPX"), 1u);
  set("EN_AUTMAN", 0);
  scan();
  EXPECT_EQ(get("MPX"), 0u);
  EXPECT_EQ(events(), 0u);
}

// l.6463-6467
TEST_F(TechnolOperation, AStartWaitsForTheProgram) {
  set("GO", 1), set("LATER", 1), set("SF_RUN", 1), set("START_SUSPEND", 1);
  scan();
  EXPECT_EQ(events(), 5u); // START_REQ
  set("SF_NOTINPOS", 1);
  scan(3);
  EXPECT_EQ(events(), 0u);
  EXPECT_EQ(get("PO_F"), 0u);
  EXPECT_EQ(get("MPX"), 0u);
  set("START_SUSPEND", 0);
  scan();
  EXPECT_EQ(events(), 4u); // START
  EXPECT_EQ(get("MPX"), 1u);
  set("SF_NOTINPOS", 0);
  scan(2);
  set("SF_NOTINPOS", 1); // the next block of the same program
  scan();
  EXPECT_EQ(events(), 0u);
}

TEST_F(TechnolOperation, AStartThatIsGivenUp) {
  set("START_DISABLE", 1), set("SF_RUN", 1);
  scan(3);
  EXPECT_EQ(events(), 5u);
  set("SF_RUN", 0);
  scan();
  set("START_DISABLE", 0);
  scan(2);
  EXPECT_EQ(events(), 0u);
}

// l.6402-6414, 6490-6500
TEST_F(TechnolOperation, AStopOfTheProgramLastsToTheNextStart) {
  set("GO", 1), set("SF_RUN", 1), set("SF_NOTINPOS", 1);
  scan(2);
  EXPECT_EQ(events(), 54u);
  set("STOP_REQ", 1);
  scan();
  EXPECT_EQ(get("STOP_REQ"), 0u);
  EXPECT_EQ(get("PO_STOP"), 1u);
  EXPECT_EQ(get("MPX"), 0u);
  EXPECT_EQ(get("PO_F"), 1u) << "the block is not over";
  EXPECT_EQ(events(), 13u); // STOP_REQ, STOP
  set("SF_STOP", 1);        // the host has stopped
  scan();
  EXPECT_EQ(events(), 0u);
  set("SF_STOP", 0), set("LATER", 1); // START
  scan();
  EXPECT_EQ(events(), 5u);
  EXPECT_EQ(get("PO_STOP"), 1u);
  EXPECT_EQ(get("MPX"), 0u);
  set("START_SUSPEND", 0);
  scan();
  EXPECT_EQ(events(), 4u);
  EXPECT_EQ(get("PO_STOP"), 0u);
  EXPECT_EQ(get("MPX"), 1u);
  EXPECT_EQ(get("INITS"), 1u) << "the block goes on where it was";
}

TEST_F(TechnolOperation, OtherStops) {
  set("GO", 1), set("STOPPI", 1), set("STOP_EMERGENCY_REQ", 1);
  scan(2);
  EXPECT_EQ(get("STOP_EMERGENCY_REQ"), 0u);
  EXPECT_EQ(get("PO_STOP"), 0u) << "nothing runs that could be stopped";
  set("SF_RUN", 1);
  scan(2);
  EXPECT_EQ(events(), 54u) << "STOPPI has been 1 before";
  set("STOPPI", 0);
  scan();
  set("STOPPI", 1);
  scan(2);
  EXPECT_EQ(get("STOPPI"), 1u);
  EXPECT_EQ(events(), 13u);
  set("SF_STOP", 1);
  scan();
  set("SF_STOP", 0);
  scan();
  EXPECT_EQ(events(), 54u);
  set("STOP_EMERGENCY_REQ", 1);
  scan();
  EXPECT_EQ(events(), 23u);
  set("SF_STOP", 1);
  scan();
  set("SF_STOP", 0);
  scan();
  EXPECT_EQ(events(), 54u);
  set("SF_STOP", 1); // the operator's
  scan();
  EXPECT_EQ(events(), 13u);
  EXPECT_EQ(get("PO_STOP"), 1u);
}

TEST_F(TechnolOperation, AnAnnulmentEndsAStop) {
  set("SF_NOTINPOS", 1);
  scan(2);
  set("STOP_REQ", 1);
  scan();
  EXPECT_EQ(get("PO_STOP"), 1u);
  set("SF_NOTINPOS", 0), set("GO", 1);
  control_.functions(0)->abort();
  scan(2);
  EXPECT_EQ(get("PO_STOP"), 0u);
  EXPECT_EQ(get("PO_F"), 0u);
  EXPECT_EQ(get("CAPI"), 1u);
  set("SF_NOTINPOS", 1);
  scan(2);
  EXPECT_EQ(get("MPX"), 1u);
}

// l.6649
TEST_F(TechnolOperation, ARequestedReferenceEnds) {
  set("HOMING", 1), set("HOMING_START_REQ", 3);
  scan();
  EXPECT_EQ(get("HOMING_START_REQ"), 2u);
  scan();
  set("HOMING_START_REQ", 3);
  scan();
  EXPECT_EQ(get("HOMING_START_REQ"), 3u);
  set("HOMING", 0);
  scan();
  set("HOMING", 3);
  scan();
  EXPECT_EQ(get("HOMING_START_REQ"), 0u);
  set("HOMING_REQ", 5); // the zero point alone
  scan();
  EXPECT_EQ(get("HOMING_REQ"), 5u) << "both had their reference before";
  set("HOMING", 2);
  scan();
  set("HOMING", 3);
  scan();
  EXPECT_EQ(get("HOMING_REQ"), 4u);
}

// l.11022-11030: whatever becomes of them; AUTMAN_REQ is the program's to hold.
TEST_F(TechnolOperation, RequestsForManualModeEnd) {
  set("AUTMAN_SELECT", 1), set("AUTMAN_CANCEL", 1), set("AUTMAN_REQ", 1);
  scan();
  EXPECT_EQ(get("AUTMAN_SELECT"), 0u);
  EXPECT_EQ(get("AUTMAN_CANCEL"), 0u);
  EXPECT_EQ(get("AUTMAN_REQ"), 1u);
}

} // namespace
} // namespace rung::nc
