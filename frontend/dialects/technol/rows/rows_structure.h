// Rows: modules, declarations, procedures, macros, the ends of start and shutdown (man. ch. 3.4, 3.17, 5, 7, 22).
// Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/technol/check/rules.h"
#include "frontend/dialects/technol/lower/host_cells.h"
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/rows/row_parts.h"

namespace rung::frontend::technol {

// By ModuleKind; the rows for the two words of a module share an example.
inline constexpr std::string_view kModuleExamples[kModuleKinds] = {
    "DATA\nINPUTS: DFM START,STOPPED\nSPEED: DS 2\nDATA_END",
    "MODULE_INPUT\nMOVR GO,DOOR\nMODULE_INPUT_END",
    "MODULE_BLOCK_INIT\nLDR  READY\nEX0\nMODULE_BLOCK_INIT_END",
    "MODULE_BLOCK_DONE\nTIM  -,50\nMODULE_BLOCK_DONE_END",
    "MODULE_MAIN\nLDR  GO\nLA   DOOR\nWR   PUMP\nMODULE_MAIN_END",
    "MODULE_INIT\nFL   0,PUMP,LAMP\nMODULE_INIT_END",
    "MODULE_CLEAR\nMECH_INIT CLAMP\nMODULE_CLEAR_END",
    "MODULE_HALT\nFL   0,PUMP\nMODULE_HALT_END",
    "MODULE_DONE\nFL   0,LAMP\nMODULE_DONE_END",
    "MODULE_FAST\nLOD  COUNT\nINR\nSTO  COUNT\nMODULE_FAST_END",
    "MODULE_CONT\nMOVR LAMP,PUMP\nMODULE_CONT_END",
    "MODULE_FASTEST\nMOVR LAMP,PUMP\nMODULE_FASTEST_END",
    "MODULE_CYCLICOPERATION\nMOVR LAMP,PUMP\nMODULE_CYCLICOPERATION_END",
};

constexpr Row moduleRow(std::string_view name, ModuleKind kind, std::string_view ref, std::string_view doc) {
  return {.info = {.mnemonic = name,
                   .title = "module",
                   .group = "module",
                   .ref = ref,
                   .doc = doc,
                   .example = kModuleExamples[static_cast<int>(kind)]},
          .role = Role::Module,
          .variant = static_cast<int>(kind)};
}
constexpr Row moduleEndRow(std::string_view name, ModuleKind kind, std::string_view ref) {
  return {.info = {.mnemonic = name,
                   .title = "end of a module",
                   .group = "module",
                   .ref = ref,
                   .doc = "Ends the module.",
                   .example = kModuleExamples[static_cast<int>(kind)]},
          .role = Role::ModuleEnd,
          .variant = static_cast<int>(kind)};
}

inline constexpr std::string_view kMemberDoc = "Member of a structure; its name becomes the offset in bytes.";
inline constexpr std::string_view kStructureExample =
    "TOOL   struc\nNUMBER DW ?\nLIFE   DD 0\nOFFSET DQ ?\nNAME   DB 8 DUP(0)\nTOOL   ends";
inline constexpr Row kMemberShape = {
    .info = {.group = "declaration",
             .operands = {in("value", kinds::kDeclaration, "a value, ?, or n DUP(value)")},
             .tasks = "struc"},
    .role = Role::MemberSize};
inline constexpr Row kStructureWordShape = {.info = {.group = "declaration", .tasks = "DATA, DATA_LOCAL"},
                                            .role = Role::MemberSize};
inline constexpr Row kInterruptShape = {.info = {.group = "assembler"}, .role = Role::NoCode};

constexpr Row macroShape(OperandList operands) {
  return {.info = {.group = "macro", .operands = operands}, .role = Role::Macro};
}
constexpr Row declarationShape(Role role, OperandList operands, std::string_view tasks = {}) {
  return {.info = {.group = "declaration", .operands = operands, .tasks = tasks}, .role = role};
}
constexpr Row procedureShape(Role role, std::string_view name) {
  return {.info = {.group = "procedure", .operands = {in("name", kinds::kDeclaration, name)}}, .role = role};
}
constexpr Row moduleShape(Role role) { return {.info = {.group = "module"}, .role = role}; }
constexpr Row finishedShape(uint16_t effects) {
  return {.info = {.group = "module service"}, .effects = effects, .lower = lowerFinished};
}

inline constexpr Row kStructureRows[] = {
    // ---- modules (man. ch. 5.1) -------------------------------------------------------------------------------------
    moduleRow("DATA", ModuleKind::Data, "5.1, l.2470", "Declarations, known in all files."),
    moduleEndRow("DATA_END", ModuleKind::Data, "5.1, l.2472"),
    moduleRow("MODULE_INPUT", ModuleKind::Input, "5.1, l.2501", "Runs first in every cycle."),
    moduleEndRow("MODULE_INPUT_END", ModuleKind::Input, "5.1, l.2503"),
    moduleRow("MODULE_BLOCK_INIT", ModuleKind::BlockInit, "5.1, l.2510",
              "Runs after the start of an NC block; may wait."),
    moduleEndRow("MODULE_BLOCK_INIT_END", ModuleKind::BlockInit, "5.1, l.2512"),
    moduleRow("MODULE_BLOCK_DONE", ModuleKind::BlockDone, "5.1, l.2530", "Runs at the end of an NC block; may wait."),
    moduleEndRow("MODULE_BLOCK_DONE_END", ModuleKind::BlockDone, "5.1, l.2532"),
    moduleRow("MODULE_MAIN", ModuleKind::Main, "5.1, l.2544",
              "Runs in every cycle; the parts of further files follow in their order."),
    moduleEndRow("MODULE_MAIN_END", ModuleKind::Main, "5.1, l.2546"),
    moduleRow("MODULE_INIT", ModuleKind::Init, "5.1, l.2556", "Runs once at every start of the PLC."),
    moduleEndRow("MODULE_INIT_END", ModuleKind::Init, "5.1, l.2558"),
    moduleRow("MODULE_CLEAR", ModuleKind::Clear, "5.1, l.2641", "Runs once at the command to clear the PLC."),
    moduleEndRow("MODULE_CLEAR_END", ModuleKind::Clear, "5.1, l.2643"),
    moduleRow("MODULE_HALT", ModuleKind::Halt, "5.1, l.2651", "Runs once after a serious fault."),
    moduleEndRow("MODULE_HALT_END", ModuleKind::Halt, "5.1, l.2653"),
    moduleRow("MODULE_DONE", ModuleKind::Done, "5.1, l.2602", "Runs once at the stop of the PLC."),
    moduleEndRow("MODULE_DONE_END", ModuleKind::Done, "5.1, l.2604"),
    moduleRow("MODULE_FAST", ModuleKind::Fast, "5.1, l.2660", "Runs every millisecond."),
    moduleEndRow("MODULE_FAST_END", ModuleKind::Fast, "5.1, l.2662"),
    moduleRow("MODULE_CONT", ModuleKind::Cont, "5.1, l.2671", "Runs last in every cycle."),
    moduleEndRow("MODULE_CONT_END", ModuleKind::Cont, "5.1, l.2673"),
    moduleRow("MODULE_FASTEST", ModuleKind::Fastest, "27.8.3, l.13481",
              "Runs at the fastest period, at most every millisecond."),
    moduleEndRow("MODULE_FASTEST_END", ModuleKind::Fastest, "27.8.3, l.13483"),
    moduleRow("MODULE_CYCLICOPERATION", ModuleKind::Cyclic, "27.8.2, l.13466",
              "Runs every millisecond before MODULE_FAST."),
    moduleEndRow("MODULE_CYCLICOPERATION_END", ModuleKind::Cyclic, "27.8.2, l.13468"),
    rowOf(moduleShape(Role::Local), "DATA_LOCAL", "local data", "5.1, l.2485",
          "Declarations known in this file only; may lie inside other modules.",
          "DATA_LOCAL\nSTEP: DS 2\nDATA_LOCAL_END"),
    rowOf(moduleShape(Role::LocalEnd), "DATA_LOCAL_END", "end of local data", "5.1, l.2487", "Ends DATA_LOCAL.",
          "DATA_LOCAL\nSTEP: DS 2\nDATA_LOCAL_END"),
    rowOf(moduleShape(Role::Stop), "STOP", "end of the program", "5.1, l.2337",
          "Follows the last module of the main file; what comes after it is not read.",
          "MODULE_HALT\nMODULE_HALT_END\nSTOP"),
    // ---- procedures (man. ch. 3.17) -------------------------------------------------------------------------------
    rowOf(procedureShape(Role::ProcBegin, "a new name"), "PROC_BEGIN", "procedure", "3.17, l.1588",
          "Begins a procedure; the normal flow skips it.",
          "PROC_BEGIN TOGGLE\nLDR  LAMP\nCA\nWR   LAMP\nPROC_END TOGGLE"),
    rowOf(procedureShape(Role::ProcEnd, "the name of its PROC_BEGIN"), "PROC_END", "end of a procedure", "3.17, l.1589",
          "Ends a procedure.", "PROC_BEGIN TOGGLE\nLDR  LAMP\nCA\nWR   LAMP\nPROC_END TOGGLE"),
    {.info = {.mnemonic = "PROC_CALL",
              .title = "call",
              .group = "procedure",
              .operands = {in("name", kinds::kProcedure, "is run")},
              .ref = "3.17, l.1590",
              .doc = "Runs a procedure and continues after the call; RLO and DR go in and come out.",
              .example = "PROC_CALL TOGGLE"},
     .effects = kSetsRlo | kSetsDr,
     .check = checkCall,
     .lower = lowerCall},
    rowOf(finishedShape(kEndsInit), "MODULE_INIT_FINISHED", "start is complete", "5.1, l.2572",
          "The start is complete when each file that has this instruction has carried one out.", "MODULE_INIT_FINISHED",
          static_cast<int>(HostCell::InitPending)),
    rowOf(finishedShape(kEndsDone), "MODULE_DONE_FINISHED", "shutdown is complete", "5.1, l.2618",
          "The shutdown is complete when each file that has this instruction has carried one out.",
          "MODULE_DONE_FINISHED", static_cast<int>(HostCell::DonePending)),
    // ---- declarations (man. ch. 3.4, 3.18) ------------------------------------------------------------------------
    rowOf(declarationShape(Role::Dfm, {optional(repeated(in("bit", kinds::kDeclaration, "name of a bit, from bit 0")))},
                           "DATA, DATA_LOCAL"),
          "DFM", "bits of a byte", "3.4, l.95",
          "Declares one byte and the names of its bits. A name may be left out, but not its comma.",
          "GAMA: DFM  B0,B1,,B3,,,,B7"),
    rowOf(declarationShape(Role::Ds,
                           {in("size", kinds::kDeclaration, "1 BYTE, 2 WORD, 4 DWORD, 8 for a prefix, n an array")},
                           "DATA, DATA_LOCAL"),
          "DS", "bytes", "3.4, l.118",
          "Declares a variable of 1, 2 or 4 bytes, or an array that is used with a prefix.",
          "COUNT: DS 2\nTABLE: DS 100"),
    rowOf(declarationShape(Role::Str,
                           {in("size", kinds::kDeclaration, "characters"),
                            optional(in("text", kinds::kDeclaration, "its contents, or the memory it lies on"))}),
          "STR", "text", "3.18, l.1651", "Declares a text of at most n characters.", "TITLE: STR 20,'Ready'"),
    rowOf(declarationShape(Role::Equi, {in("name", kinds::kDeclaration, "a new name"),
                                        in("value", kinds::kDeclaration, "an integer")}),
          "EQUI", "constant", "3.4, l.137", "Declares an integer constant.", "EQUI MAX_POS, 24"),
    rowOf(kMemberShape, "DB", "member of 1 byte", "18.1.1, l.13526", kMemberDoc, kStructureExample, 1),
    rowOf(kMemberShape, "DW", "member of 2 bytes", "18.1.1, l.13527", kMemberDoc, kStructureExample, 2),
    rowOf(kMemberShape, "DD", "member of 4 bytes", "8.4.2, l.7443", kMemberDoc, kStructureExample, 4),
    rowOf(kMemberShape, "DQ", "member of 8 bytes", "18.1.1, l.13526", kMemberDoc, kStructureExample, 8),
    rowOf(kStructureWordShape, "STRUC", "structure", "18.1.1, l.13525",
          "NAME struc begins a structure: its members become constants, their offsets in bytes, without gaps. After it "
          "NAME declares data: the values between < and > are those of the members at the start; one that is left out "
          "has the value of the structure.",
          "TOOL   struc\nNUMBER DW ?\nLIFE   DD 0\nOFFSET DQ ?\nNAME   DB 8 DUP(0)\nTOOL   ends\nT1     TOOL "
          "<5,1000>\nSPARE  TOOL 4 DUP(<>)",
          0),
    rowOf(kStructureWordShape, "ENDS", "structure", "18.1.1, l.13529", "NAME ends ends a structure.", kStructureExample,
          0),
    rowOf(kStructureWordShape, "DUP", "structure", "9.5, l.4211", "n DUP(value): n values of a member.",
          kStructureExample, 0),
    // ---- accepted without effect ----------------------------------------------------------------------------------
    {.info = {.mnemonic = "DEBUG",
              .title = "debugging",
              .group = "debugging",
              .operands = {optional(in("state", kinds::kDeclaration, "ON or OFF"))},
              .ref = "7.1, l.2794",
              .doc = "Marks a region for break-points; no effect on results.",
              .example = "DEBUG ON"},
     .role = Role::NoCode},
    rowOf(kInterruptShape, "CLI", "no interrupts", "3.9, l.564",
          "Protects reading two related cells from the fast task, which does not interrupt here anyway.",
          "CLI\nLOD  POS\nSTI"),
    rowOf(kInterruptShape, "STI", "interrupts", "3.9, l.567", "Ends what CLI began.", "CLI\nLOD  POS\nSTI"),
    {.info = {.mnemonic = "MOV",
              .title = "index register",
              .group = "assembler",
              .operands = {in("BX", kinds::kRegister, "the index register"), in("CX", kinds::kRegister, "DR")},
              .ref = "18.1.1, l.13532",
              .doc = "MOV BX, CX: the index register becomes the low 16 bits of DR.",
              .example = "LOD  COUNT\nMOV  BX,CX\nLOD  WORD.TABLE[BX]"},
     .effects = kReadsDr,
     .lower = lowerMovBx},
    // ---- macros and includes (man. ch. 22) ------------------------------------------------------------------------
    rowOf(macroShape({in("file", kinds::kDeclaration, "path, or a name in apostrophes for the SYSTEM folder")}),
          "T_INCLUDE", "include a file", "22.1, l.20313", "Reads another file here; it holds constants and macros.",
          "T_INCLUDE CONSTANTS.TXT"),
    rowOf(macroShape({in("name", kinds::kDeclaration, "a new name"),
                      optional(repeated(in("par", kinds::kDeclaration, "formal parameters")))}),
          "DEF_T_MACRO", "user instruction", "22.2, l.20349",
          "Defines an instruction of the user. In its lines a parameter is written TMAC.PAR.",
          "DEF_T_MACRO BLINK OUT\n    LDR  -TMAC.OUT\n    WR   TMAC.OUT\nEND_T_MACRO T_END"),
    rowOf(
        macroShape({optional(repeated(in("flags", kinds::kDeclaration,
                                         "T_NORMAL, T_BEGIN, T_END, T_PUSH or T_POP: what a use does to the stack")))}),
        "END_T_MACRO", "end of a user instruction", "22.2, l.20373", "Ends the definition.",
        "DEF_T_MACRO BLINK OUT\n    LDR  -TMAC.OUT\n    WR   TMAC.OUT\nEND_T_MACRO T_END"),
    rowOf(macroShape({repeated(in("symbol", kinds::kDeclaration, "labels and data that each use has for itself"))}),
          "T_LOCAL", "local symbols", "22.3, l.20441", "Comes after DEF_T_MACRO.",
          "DEF_T_MACRO RAISE OUT\nT_LOCAL DONE\n      LDR  TMAC.OUT\n      JL1  DONE\n      FL   "
          "1,TMAC.OUT\nDONE: LOD  0\nEND_T_MACRO"),
    rowOf(macroShape({in("name", kinds::kDeclaration, "a macro"), in("alias", kinds::kDeclaration, "a new name"),
                      optional(repeated(in("flags", kinds::kDeclaration, "as in END_T_MACRO")))}),
          "APPEND_T_MACRO", "another name", "22.4, l.20526", "Gives a macro another name.",
          "DEF_T_MACRO BLINK OUT\n    LDR  -TMAC.OUT\n    WR   TMAC.OUT\nEND_T_MACRO "
          "T_END\nAPPEND_T_MACRO BLINK,FLASH"),
    rowOf(macroShape({in("order", kinds::kDeclaration, "POS or PRE")}), "CONTROL_T_MACRO", "order of look-up",
          "22.4, l.20576", "PRE lets macros replace instructions of the language, POS does not.",
          "CONTROL_T_MACRO PRE"),
};

} // namespace rung::frontend::technol
