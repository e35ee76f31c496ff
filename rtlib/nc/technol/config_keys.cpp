// The configuration keys of TECHNOL (see config_key.h). The last row matches any key, because programs query parameters
// of the machine by their own identifiers.
#include "rtlib/nc/config_key.h"

namespace rung::nc {

namespace {

using enum ConfigForm;
constexpr auto kCompiler = ConfigReader::Compiler;

constexpr ConfigKey kKeys[] = {
    kEncodingKey,
    {.key = "period_us",
     .reader = kCompiler,
     .form = Whole,
     .least = 1,
     .most = UINT32_MAX,
     .otherwise = "20000",
     .doc = "period of a scan in microseconds, in a scenario `period`"},
    {.key = "system_folder",
     .reader = kCompiler,
     .form = File,
     .takes = "a folder",
     .doc = "where a file lies that T_INCLUDE names in apostrophes without a path"},
    {.key = "PlcErrors",
     .form = File,
     .doc = "the control's own file of messages: kind, validity, texts. UTF-8 or Windows-1250, relative to the "
            "scenario or the project"},
    {.key = "PlcConstants", .form = File, .doc = "the control's own file of constants"},
    {.key = "PlcConfig",
     .form = File,
     .doc = "the control's own file of the channel: parameters, connections, and with `nc simulated` its devices, by "
            "the elements NCAxis, CANChannel, ComChannel, Servo; later keys override it"},
    {.key = "nc",
     .form = Choice,
     .takes = "scripted simulated",
     .otherwise = "scripted",
     .doc = "who answers for devices: the scenario, or simulated ones as the keys below say"},
    {.key = "PlcTableDef<n>", .form = File, .doc = "definition of PLC tables, n 0 to 255 (l.18275-18333)"},
    {.key = "PlcTable<n>", .form = File, .doc = "contents of PLC table n, 0 to 255 (l.18362-18418)"},
    {.key = "KbdConfig<k>",
     .form = File,
     .doc = "what the keys of keyboard k do, 0 to 7: panels 0 to 3, handwheels 4 and 5, the virtual one 6 "
            "(l.16723-16905)"},
    {.key = "axes",
     .takes = "letters",
     .otherwise = "XYZC",
     .doc = "axes 1 and on that exist, and their names in axis operands of a program, which without the key are "
            "XYZCABUVW"},
    {.key = "axis.<n>.<ATTRIBUTE>",
     .takes = "a number",
     .doc = "attribute of an axis: RefMethod, RefSpeed, Acceleration, Feed, Rotary, Position, ... (l.11475-11610)"},
    {.key = "switch.<BIT>",
     .takes = "AXIS LOW HIGH",
     .doc = "an input that is 1 while the axis is physically within LOW to HIGH mm, a rotary one in each revolution: "
            "`switch.P1IN.2 1 -1000 -5`"},
    {.key = "follow.<BIT>",
     .takes = "[/]BIT[@TIME]",
     .doc = "an input that repeats a bit, `/` its opposite, after this time: `follow.P1IN.0 P0OUT.3@100ms`"},
    {.key = "CAN[<n>].<ATTRIBUTE>",
     .takes = "a number",
     .doc = "channel n + 1: Active, InOut08Cnt, Kla50Cnt, KnobCnt, Drives (l.3242-3291)"},
    {.key = "drive.<n>.type",
     .form = Choice,
     .takes = "kollmorgen unidrive",
     .otherwise = "kollmorgen",
     .doc = "CAN drive n"},
    {.key = "drive.<n>.sdo.<INDEX>.<SUB>", .takes = "VALUE/BYTES [ro|wo]", .doc = "object of a CAN drive"},
    {.key = "COM[<n>].<ATTRIBUTE>",
     .takes = "a number or a word",
     .doc = "serial port n, 0 to 15: Active, ComSpeed, ComDataBits, ComStopBits, ComParity (l.21011-21039)"},
    {.key = "ethercat.<d>", .takes = "coe, soe or coe+soe", .doc = "slave d exists, with these protocols"},
    {.key = "ethercat.<d>.<ATTRIBUTE>",
     .takes = "a text",
     .doc = "name, coe.INDEX.SUB, soe.IDN.DRIVE, pdo.Inputs.ENTRY, pdo.Outputs.ENTRY, refuse, ds402, motor of a slave"},
    {.key = "servo.<n>.<ATTRIBUTE>",
     .takes = "a number",
     .doc = "servo n, 0 to 15: ServoType, MeasConstNumerator, MeasConstDenominator, by which increments of its drive "
            "count (l.8547-8573, l.10150-10191)"},
    {.key = "EtherCATOPViaPLC",
     .form = Choice,
     .takes = "0 1",
     .otherwise = "0",
     .doc = "1: the program starts the cyclic exchange (l.17741)"},
    {.key = "EtherCATDelayOP",
     .takes = "milliseconds",
     .otherwise = "0",
     .doc = "until the master is in OPERATIONAL (l.17755)"},
    {.key = "const.<ID>",
     .takes = "a number, SA0INT, SA0REAL or PLCCOMMAND",
     .doc = "constant for CONST_GET; SA0INT, SA0REAL, PLCCOMMAND number in order (l.16262-16393)"},
    {.key = "licence.<NAME>", .form = Choice, .takes = "0 1", .otherwise = "0", .doc = "1: LDR_LIC finds it (l.7631)"},
    {.key = "CAN[1].INOUT08[<i>].CONTROL",
     .takes = "0 to 255",
     .doc = "control byte of a unit, 0 to 31, whose IO_DIS_ERPIS ends that outputs in ERRLI are held at 0 "
            "(l.3526-3609)"},
    {.key = "<ID>.Invert",
     .takes = "a number",
     .doc = "attribute of a variable of MAP_* or DEF_*, also `.Scale`, `.Offset`, `.MinVal`, `.MaxVal`, `.Default` "
            "(l.5572-5760)"},
    {.key = "<ID>", .takes = "a text or a number", .doc = "parameter that CNF_GET_* reads, as text (l.16073-16262)"},
};

} // namespace

std::span<const ConfigKey> technolConfigKeys() { return kKeys; }

} // namespace rung::nc
