// A small program of each dialect with every kind of place that a mapping file can name, or must not.
#pragma once

namespace rung::fuzz {

struct MappedProgram {
  const char* file; // its ending says the dialect; the seed of the same stem binds to it without errors
  const char* text;
};

constexpr MappedProgram kMappedPrograms[] = {
    {"gsk.pmc", R"(dialect gsk
symbol START X0.0
symbol LAMP  Y0.0
symbol COUNT D10
symbol KEEP  K0.1
const  LIMIT 0x10

LD   START
OUT  LAMP
LD   R0.4
FUNC PSGNL
PRM  D150
PRM  R20
PRM  R21
FUNC 0
FUNC 1
)"},
    {"nct.lad", R"(dialect nct
module MAIN
symbol START INP000.00
symbol LAMP  OUT000.00
symbol COUNT 7000
symbol SW2   N_SW,#1
const  LIMIT #10

rung
|--[START]--(LAMP)

rung
|--[N_ON]--{ADD COUNT COUNT LIMIT}
)"},
    {"technol.plc", R"(DATA
FLAGS:  DFM  START,LAMP,,,,,,
COUNT:  DS   2
WIDE:   DS   4
SPEED:  DS   8
ROW:    DS   5
NAME:   STR  10,'tool'
        EQUI LIMIT,16
DATA_LOCAL
LOC:    DS   2
DATA_LOCAL_END
DATA_END
MODULE_INPUT
MODULE_INPUT_END
MODULE_MAIN
        LDR  START
        WR   LAMP
        LOD  REAL.SPEED
        STO  REAL.SPEED
MODULE_MAIN_END
MODULE_BLOCK_INIT
MODULE_BLOCK_INIT_END
MODULE_BLOCK_DONE
MODULE_BLOCK_DONE_END
MODULE_INIT
MODULE_INIT_END
MODULE_CLEAR
MODULE_CLEAR_END
MODULE_HALT
MODULE_HALT_END
STOP
)"},
};

} // namespace rung::fuzz
