// Instructions whose sources are too uncertain to be built from (inventory §10): known by number and name, and refused.
// Included by instructions.cpp only.
#pragma once
#include "frontend/dialects/fanuc/rows/row_parts.h"

namespace rung::frontend::fanuc {

constexpr Row unbuilt(int number, std::string_view mnemonic) {
  Row row;
  row.info = {.mnemonic = mnemonic,
              .title = "known by name only",
              .group = "not built",
              .number = number,
              .placement = Placement::Anywhere,
              .ref = "10, low",
              .doc = "What it does is known from recall only, so programs with it are refused."};
  return row;
}

inline constexpr Row kUnbuiltRows[] = {
    unbuilt(46, "SPCNT"),  unbuilt(49, "DISP"),   unbuilt(50, "PSGNL"),  unbuilt(63, "PSGN2"),  unbuilt(74, "CS"),
    unbuilt(75, "CM"),     unbuilt(76, "CE"),     unbuilt(88, "MMC3R"),  unbuilt(89, "MMC3W"),  unbuilt(90, "FNC90"),
    unbuilt(91, "FNC91"),  unbuilt(92, "FNC92"),  unbuilt(93, "FNC93"),  unbuilt(94, "FNC94"),  unbuilt(95, "FNC95"),
    unbuilt(96, "FNC96"),  unbuilt(97, "FNC97"),  unbuilt(98, "MMCWR"),  unbuilt(99, "MMCWW"),  unbuilt(221, "TMRST"),
    unbuilt(222, "TMRSS"), unbuilt(223, "CTRD"),  unbuilt(224, "MOVBT"), unbuilt(225, "SETNB"), unbuilt(226, "SETNW"),
    unbuilt(227, "SETND"), unbuilt(228, "XCHGB"), unbuilt(229, "XCHGW"), unbuilt(230, "XCHGD"), unbuilt(231, "SWAPW"),
    unbuilt(232, "SWAPD"), unbuilt(233, "TBLRB"), unbuilt(234, "TBLRW"), unbuilt(235, "TBLRD"), unbuilt(236, "TBLRN"),
    unbuilt(237, "TBLWB"), unbuilt(238, "TBLWW"), unbuilt(239, "TBLWD"), unbuilt(240, "TBLWN"), unbuilt(241, "DSEQB"),
    unbuilt(242, "DSEQW"), unbuilt(243, "DSEQD"), unbuilt(244, "DSNEB"), unbuilt(245, "DSNEW"), unbuilt(246, "DSNED"),
    unbuilt(247, "DSGTB"), unbuilt(248, "DSGTW"), unbuilt(249, "DSGTD"), unbuilt(250, "DSLTB"), unbuilt(251, "DSLTW"),
    unbuilt(252, "DSLTD"), unbuilt(253, "DSGEB"), unbuilt(254, "DSGEW"), unbuilt(255, "DSGED"), unbuilt(256, "DSLEB"),
    unbuilt(257, "DSLEW"), unbuilt(258, "DSLED"), unbuilt(259, "DMAXB"), unbuilt(260, "DMAXW"), unbuilt(261, "DMAXD"),
    unbuilt(262, "DMINB"), unbuilt(263, "DMINW"), unbuilt(264, "DMIND"), unbuilt(265, "EORB"),  unbuilt(266, "EORW"),
    unbuilt(267, "EORD"),  unbuilt(268, "ANDB"),  unbuilt(269, "ANDW"),  unbuilt(270, "ANDD"),  unbuilt(271, "ORB"),
    unbuilt(272, "ORW"),   unbuilt(273, "ORD"),   unbuilt(274, "NOTB"),  unbuilt(275, "NOTW"),  unbuilt(276, "NOTD"),
    unbuilt(277, "SHLB"),  unbuilt(278, "SHLW"),  unbuilt(279, "SHLD"),  unbuilt(280, "SHLN"),  unbuilt(281, "SHRB"),
    unbuilt(282, "SHRW"),  unbuilt(283, "SHRD"),  unbuilt(284, "SHRN"),  unbuilt(285, "ROLB"),  unbuilt(286, "ROLW"),
    unbuilt(287, "ROLD"),  unbuilt(288, "ROLN"),  unbuilt(289, "RORB"),  unbuilt(290, "RORW"),  unbuilt(291, "RORD"),
    unbuilt(292, "RORN"),  unbuilt(293, "BSETB"), unbuilt(294, "BSETW"), unbuilt(295, "BSETD"), unbuilt(296, "BSETN"),
    unbuilt(297, "BRSTB"), unbuilt(298, "BRSTW"), unbuilt(299, "BRSTD"), unbuilt(300, "BRSTN"), unbuilt(301, "BTSTB"),
    unbuilt(302, "BTSTW"), unbuilt(303, "BTSTD"), unbuilt(304, "BTSTN"), unbuilt(305, "BPOSB"), unbuilt(306, "BPOSW"),
    unbuilt(307, "BPOSD"), unbuilt(308, "BPOSN"), unbuilt(309, "BCNTB"), unbuilt(310, "BCNTW"), unbuilt(311, "BCNTD"),
    unbuilt(312, "BCNTN"), unbuilt(313, "TBCDB"), unbuilt(314, "TBCDW"), unbuilt(315, "TBCDD"), unbuilt(316, "FBCDB"),
    unbuilt(317, "FBCDW"), unbuilt(318, "FBCDD"), unbuilt(319, "ADDSB"), unbuilt(320, "ADDSW"), unbuilt(321, "ADDSD"),
    unbuilt(322, "SUBSB"), unbuilt(323, "SUBSW"), unbuilt(324, "SUBSD"), unbuilt(325, "MULSB"), unbuilt(326, "MULSW"),
    unbuilt(327, "MULSD"), unbuilt(328, "DIVSB"), unbuilt(329, "DIVSW"), unbuilt(330, "DIVSD"), unbuilt(331, "MODSB"),
    unbuilt(332, "MODSW"), unbuilt(333, "MODSD"), unbuilt(334, "INCSB"), unbuilt(335, "INCSW"), unbuilt(336, "INCSD"),
    unbuilt(337, "DECSB"), unbuilt(338, "DECSW"), unbuilt(339, "DECSD"), unbuilt(340, "ABSSB"), unbuilt(341, "ABSSW"),
    unbuilt(342, "ABSSD"), unbuilt(343, "NEGSB"), unbuilt(344, "NEGSW"), unbuilt(345, "NEGSD"), unbuilt(460, "PID")};

} // namespace rung::frontend::fanuc
