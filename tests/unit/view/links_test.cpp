// What leads where: from uses, calls and labels to rungs, from names to their rows, from the contents to the blocks.
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/view/drawn.h"
#include "tools/view/html.h"
#include "tools/view/names.h"
#include "tools/view/program.h"
#include "tools/view/svg.h"

namespace rung::view::test {
namespace {

constexpr std::string_view kList =
    "dialect gsk\nsymbol GO X0.0\nFUNC END1\n; call it\nLD GO\nFUNC CALL\nPRM P7\n"
    "LD X0.1\nFUNC JMPB\nPRM L3\nLD GO\nOUT R0.0\nFUNC LBL\nPRM L003\nLD R0.0\nOUT Y0.0\n"
    "FUNC END2\n\n; ===== P7: overrides\nFUNC SP\nPRM P7\n; its rung\nLD R0.0\nOUT R0.1\n"
    "FUNC SPE\n";
constexpr std::string_view kCalls =
    "dialect nct\nmodule MAIN\nsection \"calls\"\n"
    "rung\n|--[N_ON]--+--{SBS #5}\n           +--{SBS #5}\n"
    "rung\n|--[N_ON]--{SBS #5}\nrung\n|--{END}\n"
    "section \"five\"\nrung\n|--{SBN #5}\nrung\n|--[7000.00]--(7000.01)\nrung\n|--[N_ON]--{RET}\n";

const Cell* boxIn(const Figure& figure, std::string_view title) {
  for (const Cell& cell : figure.sheet.cells)
    if (cell.title == title) return &cell;
  return nullptr;
}

std::string textOf(const CrossReference& reference) {
  std::string text(reference.lead);
  for (uint32_t rung : reference.rungs) text += fmt::format(" {}", rung);
  return reference.further == 0 ? text : text + fmt::format(" +{}", reference.further);
}

std::string usesIn(const Figure& figure) {
  std::string text;
  for (const Row& row : figure.sheet.rows)
    for (const CrossReference& reference : row.uses) text += textOf(reference) + ";";
  return text;
}

std::string writersIn(const Figure& figure) {
  std::string text;
  for (const Cell& cell : figure.sheet.cells)
    if (!cell.writers.rungs.empty()) text += cell.operand.name + textOf(cell.writers) + ";";
  return text;
}

// What is between each `begin` and the next quotation mark.
std::vector<std::string> quotedAfter(const std::string& page, std::string_view begin) {
  std::vector<std::string> found;
  for (size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    found.push_back(page.substr(at, page.find('"', at) - at));
  }
  return found;
}

// Links to places that the page does not have.
std::string lost(const std::string& page) {
  const std::vector<std::string> ids = quotedAfter(page, " id=\"");
  const std::set<std::string> known(ids.begin(), ids.end());
  const std::vector<std::string> links = quotedAfter(page, "href=\"#");
  std::string missing;
  for (const std::string& link : links)
    if (!known.contains(link)) missing += link + " ";
  return links.empty() ? "no links" : missing;
}

std::string textOf(const std::vector<ContentsEntry>& contents) {
  std::string text;
  for (const ContentsEntry& entry : contents)
    text += fmt::format("{}{}|{}|{}-{}\n", std::string(entry.level, ' '), entry.text, entry.title, entry.firstRung,
                        entry.lastRung);
  return text;
}

TEST(ViewLinks, CallsLeadToTheFirstRungOfASubprogram) {
  const auto drawn = draw("t.pmc", std::string(kList));
  const Program& program = drawn->program;
  ASSERT_EQ(program.figures.size(), 6u);
  const Cell* call = boxIn(program.figures[0], "CALL");
  ASSERT_NE(call, nullptr);
  EXPECT_EQ(call->link.to, Link::To::Rung);
  EXPECT_EQ(call->link.id, 6u);
  EXPECT_EQ(call->operands[0].link.id, 6u);
  EXPECT_EQ(boxIn(program.figures[1], "JMPB")->link.id, 4u);
  EXPECT_EQ(boxIn(program.figures[3], "LBL")->link.to, Link::To::Nothing);
  EXPECT_EQ(usesIn(program.figures[3]), "called in 2;");
  const std::string page = renderHtml(program);
  EXPECT_EQ(lost(page), "");
  EXPECT_NE(page.find("Subprogram P7: overrides"), std::string::npos);
  EXPECT_NE(page.find("called in <a href=\"#r1\">1</a>"), std::string::npos);
}

TEST(ViewLinks, SubroutinesOfNctLeadToTheirBeginning) {
  const auto drawn = draw("t.lad", std::string(kCalls));
  const Program& program = drawn->program;
  EXPECT_EQ(boxIn(program.figures[0], "SBS")->link.id, 4u);
  EXPECT_EQ(boxIn(program.figures[1], "SBS")->link.id, 4u);
  EXPECT_EQ(usesIn(program.figures[3]), "called in 1 2;");
  EXPECT_EQ(lost(renderHtml(program)), "");
}

TEST(ViewLinks, ContactsSayWhoWritesThemAndCoilsWhoReads) {
  const auto drawn = draw("t.lad", "dialect nct\nmodule MAIN\nrung\n|--[7000.00]--(S 7001.00)\n"
                                   "rung\n|--[7001.00]--(R 7001.00)\nrung\n|--[7001.00]--[7000.00]--(7002.00)\n");
  const std::vector<Figure>& figures = drawn->program.figures;
  EXPECT_EQ(writersIn(figures[0]), "");
  EXPECT_EQ(writersIn(figures[1]), "7001.00\u2190 1;"); // its own rung is in sight
  EXPECT_EQ(writersIn(figures[2]), "7001.00\u2190 1 +1;");
  EXPECT_EQ(usesIn(figures[0]), "read in 2 3;also written in 2;");
  EXPECT_EQ(usesIn(figures[2]), "");
}

TEST(ViewLinks, NamesLeadToTheirRowsOnAPageOnly) {
  const auto drawn = draw("t.pmc", std::string(kList));
  const Cell& go = drawn->program.figures[0].sheet.cells[1];
  EXPECT_EQ(go.operand.link.to, Link::To::Name);
  const std::string page = renderHtml(drawn->program);
  EXPECT_NE(page.find(fmt::format("<tr id=\"n{}\"><th scope=\"row\">GO</th>", go.operand.link.id)), std::string::npos);
  EXPECT_NE(page.find(fmt::format("<a href=\"#n{}\">GO</a>", go.operand.link.id)), std::string::npos);
  const std::string picture = renderSvg(drawn->program);
  EXPECT_EQ(picture.find("href=\"#n"), std::string::npos);
  EXPECT_NE(picture.find("href=\"#r6\""), std::string::npos);
}

TEST(ViewLinks, NamesThatNothingReadsOrWritesAreMarked) {
  const auto drawn =
      draw("t.pmc", "dialect gsk\nsymbol KEY X0.0\nsymbol LAMP Y0.0\nsymbol LONELY R5.0\nsymbol HALF R5.1\n"
                    "FUNC END1\nLD KEY\nAND HALF\nOUT LAMP\nFUNC END2\n");
  const std::string page = renderHtml(drawn->program);
  const auto row = [&](std::string_view name) {
    const size_t at = page.find(fmt::format("<th scope=\"row\">{}</th>", name));
    return page.substr(at, page.find("</tr>", at) - at);
  };
  const std::string never = "<td><i class=\"g\">never</i></td>";
  EXPECT_NE(row("LONELY").find(never + never), std::string::npos) << row("LONELY");
  EXPECT_NE(row("HALF").find(never + "<td><a"), std::string::npos) << row("HALF");
  EXPECT_NE(row("KEY").find("<td><i>machine</i></td><td><a"), std::string::npos) << row("KEY");
  EXPECT_NE(row("LAMP").find("</a></td><td><i>machine</i></td>"), std::string::npos) << row("LAMP");
}

TEST(ViewLinks, OwnMemoryOfNctBeginsAfterItsSignals) {
  const auto drawn = draw("t.lad", "dialect nct\nmodule MAIN\nrung\n|--[N_ON]--[7000.00]--{MOV 7100,7001 #5}\n");
  const std::string page = renderHtml(drawn->program);
  const auto row = [&](std::string_view name) {
    const size_t at = page.find(fmt::format("<th scope=\"row\">{}</th>", name));
    return page.substr(at, page.find("</tr>", at) - at);
  };
  EXPECT_NE(row("N_ON").find("<i>machine</i>"), std::string::npos) << row("N_ON");
  EXPECT_NE(row("7000.00").find("<i class=\"g\">never</i></td><td><a"), std::string::npos) << row("7000.00");
  EXPECT_EQ(row("7100,7001").find("<i"), std::string::npos) << row("7100,7001");
}

TEST(ViewContents, SubprogramsHaveTheTitlesOfTheirSections) {
  EXPECT_EQ(textOf(contentsOf(draw("t.pmc", std::string(kList))->program)),
            "Level 2||1-5\nSubprogram P7|overrides|6-6\n");
  const auto commented = draw("t.pmc", "dialect gsk\nFUNC END1\nLD X0.0\nFUNC CALL\nPRM P1\nFUNC END2\n"
                                       "; turns the table\nFUNC SP\nPRM P1\nLD X0.0\nOUT Y0.0\nFUNC SPE\n");
  EXPECT_EQ(textOf(contentsOf(commented->program)), "Level 2||1-1\nSubprogram P1|turns the table|2-2\n");
}

TEST(ViewContents, ACommentOfAnEndIsNotTheTitleOfWhatFollows) {
  const auto drawn = draw("t.mne", "%@3\nSUB 1\nRD X0.0\nCALL P1\nRD X0.1\nCALL P2\n"
                                   "RD X0.2\nCALL P3\n(* END OF LEVEL 2 *)\nSUB 2\n"
                                   "SP P1\nRD X0.0\nWRT Y0.0\n(* END OF P1 *)\nSPE\n"
                                   "SP P2\nRD X0.1\nWRT Y0.1\n(* END OF P2 *)\nSPE\n"
                                   "(* ---- coolant ---- *)\nSP P3\nRD X0.2\nWRT Y0.2\nSPE\nSUB 64\n%\n");
  EXPECT_EQ(textOf(contentsOf(drawn->program)), "Level 2||1-3\nSubprogram P1||4-4\nSubprogram P2||5-5\n"
                                                "Subprogram P3|coolant|6-6\n");
}

TEST(ViewContents, LevelsHaveTheTitlesOfTheirSectionsOnly) {
  const std::string rung = "rung\n|--[X0.0]--(Y0.0)\n";
  const auto commented =
      draw("t.lad", "dialect gsk\n; the panel of the mill\nmodule LEVEL1\n" + rung +
                        "; what follows can take its time\nmodule LEVEL2\nrung\n|--[X0.0]--(Y0.1)\n");
  EXPECT_EQ(textOf(contentsOf(commented->program)), "Level 1||1-1\nLevel 2||2-2\n");
  const auto sections = draw("t.lad", "dialect gsk\nsection \"fast\"\nmodule LEVEL1\n" + rung);
  EXPECT_EQ(textOf(contentsOf(sections->program)), "Level 1|fast|1-1\n");
}

TEST(ViewContents, SectionsAreInTheirModules) {
  EXPECT_EQ(textOf(contentsOf(draw("t.lad", std::string(kCalls))->program)),
            "Module MAIN||1-6\n calls||1-3\n five||4-6\n");
}

TEST(ViewContents, AFileThatIsOneModuleIsOneEntry) {
  const auto drawn = drawFiles({"examples/nct-lathe/io.lad", "examples/nct-lathe/main.lad"});
  const std::string contents = textOf(contentsOf(drawn->program));
  EXPECT_TRUE(contents.starts_with("io.lad||0-0\nmain.lad|Module MAIN|1-116\n Start-up||1-2\n")) << contents;
  EXPECT_EQ(drawn->program.title, "nct-lathe");
  EXPECT_EQ(lost(renderHtml(drawn->program)), "");
}

TEST(ViewPage, SourcesAreLinked) {
  const SourceFile file{"/work/a b/main.lad", "main.lad"};
  EXPECT_EQ(sourceLinks("/work/out/page.html", kSourceLink)(file, 12), "../a%20b/main.lad#L12");
  EXPECT_EQ(sourceLinks("/work/a b/page.html", kSourceLink)(file, 1), "main.lad#L1");
  EXPECT_EQ(sourceLinks("x.html", "editor://open?file={path}&line={line}")(file, 7),
            "editor://open?file=/work/a%20b/main.lad&line=7");
  const auto drawn = draw("t.lad", std::string(kCalls));
  PageOptions options;
  options.linkTo = [](const SourceFile& source, uint32_t line) { return fmt::format("{}?a&{}", source.path, line); };
  EXPECT_NE(renderHtml(drawn->program, options).find("<a class=\"f\" href=\"t.lad?a&amp;4\">t.lad:4</a>"),
            std::string::npos);
  EXPECT_NE(renderHtml(drawn->program).find("<i class=\"f\">t.lad:4</i>"), std::string::npos);
}

TEST(ViewPage, PaperHasTitleDateRevisionAndPages) {
  const auto drawn = draw("t.lad", std::string(kCalls));
  drawn->program.title = "Lathe \"7\" </style>\\";
  const std::string page = renderHtml(drawn->program, {"22 Nov", "C2", {}});
  EXPECT_NE(page.find(R"(@top-left { content: "Lathe \22 7\22  \3c /style>\5c ";)"), std::string::npos);
  EXPECT_NE(page.find(R"(@bottom-left { content: "Revision C2, 22 Nov";)"), std::string::npos);
  EXPECT_NE(page.find(R"(@bottom-center { content: "t.lad"; })"), std::string::npos);
  EXPECT_NE(page.find(R"("Page " counter(page) " of " counter(pages))"), std::string::npos);
  EXPECT_EQ(page.find("Lathe \"7\" </style>"), std::string::npos);
}

} // namespace
} // namespace rung::view::test
