// The signals and parameters that the axes work with (man. 7.10, 7.13, 7.15), found once.
#pragma once
#include "rtlib/nc/control/nct/signal_memory.h"
#include "sim/nct/parameters.h"

namespace rung::sim::nct {

struct AxisSignals {
  BitSignal detachRequest{"AP_DETCHR"}, detached{"AN_DETCHA"};
  BitSignal openRequest{"AP_OPNR"}, slaveOpenRequest{"AP_SSLOP"}, open{"AN_OPNA"};
  BitSignal encoderDisabled{"AP_EFD"};
  BitSignal plcRequest{"AP_PLCR"}, plcOwns{"AN_PLCA"};
  BitSignal go{"AP_GOR"}, going{"AN_GOA"}, reset{"AP_RES"};
  BitSignal bufferEmpty{"AN_BEPTY"}, motionDone{"AN_IEPTY"};
  BitSignal wantsPositive{"AN_MTNRP"}, wantsNegative{"AN_MTNRN"}, wantsRapid{"AN_RAPR"};
  BitSignal noPositive{"AP_MTNDP"}, noNegative{"AP_MTNDN"}, noRapid{"AP_RAPD"}, noFeed{"AP_FEEDD"};
  BitSignal switchPositive{"AP_LIMP"}, switchNegative{"AP_LIMN"};
  BitSignal range1BPositive{"AP_LIMSELP"}, range1BNegative{"AP_LIMSELN"};
  BitSignal overPositive{"AN_OTP"}, overNegative{"AN_OTN"};
  BitSignal jogPositive{"AP_JOGP"}, jogNegative{"AP_JOGN"};
  BitSignal lock{"AP_LCK"};
  BitSignal parkRequest{"AP_PARKR"}, parked{"AN_PARKA"};
  BitSignal syncRequest{"AP_SYNCR"}, syncSlave{"AN_SYNCA"}, syncMaster{"AN_SYNCM"};
  BitSignal exchangeRequest{"AP_MIXR"}, exchangeSlave{"AN_MIXA"}, exchangeMaster{"AN_MIXM"};
  BitSignal superRequest{"AP_SPRPNR"}, superSlave{"AN_SPRPNA"}, superMaster{"AN_SPRPNM"};
  BitSignal mirrorRequest{"AP_MIRR"}, mirrored{"AN_MIRA"};
  BitSignal driveReference{"AP_RPE"}, referenced{"AN_RPE"}, referenceEnd{"AN_REFEND"};
  BitSignal atReference[4] = {BitSignal("AN_REFP1"), BitSignal("AN_REFP2"), BitSignal("AN_REFP3"),
                              BitSignal("AN_REFP4")};
  BitSignal inPosition{"AN_INPOS"}, atIndex{"AN_INDP"}, lubrication{"AN_LUBR"}, alarm{"AN_AXALM"};
  BitSignal onSwitch{"N_SW"}, belowSwitch{"N_SWN"}, aboveSwitch{"N_SWP"};

  BitSignal holdAll{"P_HOLD0"}, hold{"CP_HOLD"};
  BitSignal jogMode{"CN_JOG"}, incrementMode{"CN_INCR"}, handwheelMode{"CN_HNDL"}, referenceMode{"CN_REFP"};
  BitSignal jogRapid{"CP_JOGRAP"}, noRange1{"CP_LIM1DIS"};
  WordSignal jogFeed{"CP_JOGFD"}, machiningSpindle{"CP_SINP"};
  RealSignal increment{"CP_INC"}, feedOverride{"CP_FOVER"}, rapidOverride{"CP_ROVER"};
  WordSignal handwheelAxis[4] = {WordSignal("P_H1AS"), WordSignal("P_H2AS"), WordSignal("P_H3AS"),
                                 WordSignal("P_H4AS")};
  WordSignal handwheelMove{"HWMOVE"};

  // Bits of one word that are written together.
  uint32_t acknowledges = BitSignal::masks({open, mirrored, plcOwns});
  uint32_t position =
      BitSignal::masks({inPosition, alarm, referenced, referenceEnd, atReference[0], atReference[1], atReference[2],
                        atReference[3], atIndex, overPositive, overNegative, lubrication});
  uint32_t motion = BitSignal::masks({wantsPositive, wantsNegative, wantsRapid});
  uint32_t switches = BitSignal::masks({onSwitch, belowSwitch, aboveSwitch});
};

struct AxisParameters {
  ParameterPlace assign{2}, name{100}, properties{106}, indexDistance{110};
  ParameterPlace reference[4] = {ParameterPlace(200), ParameterPlace(201), ParameterPlace(202), ParameterPlace(203)};
  ParameterPlace jogControl{316}, servoControl{514}, inPosition{516}, referenceType{900};
  ParameterPlace rangeEnable{1000};
  ParameterPlace range1APositive{1002}, range1ANegative{1003}, range1BPositive{1004}, range1BNegative{1005};
  ParameterPlace lubricationDistance{1273};
  ParameterPlace syncMaster{2101}, syncConfig{2102}, exchangeMaster{2104}, superMaster{2107}, superConfig{2108};
};

} // namespace rung::sim::nct
