// Files of 10 MB in all formats: time and memory grow with the file, not with its square.
#include "compiler/import/finish.hpp"
#include "compiler/import/reader.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <fstream>
#include <functional>
#include <string>

#include <fmt/format.h>

namespace stc::import {
namespace {

/// Forty lines, the same each time: the test is about reading, not about writing.
const std::string &statements() {
  static const std::string kText = [] {
    std::string text;
    for (int line = 0; line < 40; ++line)
      text += fmt::format("x := x + {0}; (* line {0} *)\n", line);
    return text;
  }();
  return kText;
}

/// Pieces until the text is so long, between a head and a tail.
std::string repeated(size_t size, const std::string &head,
                     const std::function<std::string(size_t)> &piece, const std::string &tail) {
  std::string text = head;
  for (size_t number = 1; text.size() < size; ++number)
    text += piece(number);
  return text + tail;
}

const std::string kPlcOpenHead =
    "<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><dataTypes/><pous>";
const std::string kPlcOpenTail = "</pous></types></project>";

struct LargeFormat {
  const char *file;
  std::function<std::string(size_t size)> text;
};

std::string expBlock(size_t number) {
  return fmt::format("(* @NESTEDCOMMENTS := 'Yes' *)\n(* @PATH := '\\/F{0}' *)\n"
                     "FUNCTION_BLOCK B{0}\nVAR\n  x : INT;\nEND_VAR\n"
                     "(* @END_DECLARATION := '0' *)\n{1}END_FUNCTION_BLOCK\n\n",
                     number, statements());
}

std::string xmlBlock(size_t number, const std::string &body) {
  return fmt::format("<pou name=\"B{0}\" pouType=\"functionBlock\"><interface><localVars><variable "
                     "name=\"x\"><type><INT/></type></variable></localVars></interface><body>"
                     "{1}</body></pou>\n",
                     number, body);
}

/// An AND of two variables.
std::string drawing(size_t number) {
  const auto variable = [&](const char *kind, size_t id, const std::string &more,
                            const char *text) {
    return fmt::format("<{0} localId=\"{1}\"><position x=\"0\" y=\"{2}\"/>{3}<expression>{4}"
                       "</expression></{0}>",
                       kind, id, number * 40, more, text);
  };
  const auto line = [](size_t id) {
    return fmt::format("<connectionPointIn><connection refLocalId=\"{}\"/></connectionPointIn>",
                       id);
  };
  const size_t id = number * 4;
  return variable("inVariable", id, "", "a") + variable("inVariable", id + 1, "", "b") +
         fmt::format("<block localId=\"{}\" typeName=\"AND\"><position x=\"9\" y=\"{}\"/>"
                     "<inputVariables><variable formalParameter=\"IN1\">{}</variable><variable "
                     "formalParameter=\"IN2\">{}</variable></inputVariables><outputVariables>"
                     "<variable formalParameter=\"OUT\"/></outputVariables></block>\n",
                     id + 2, number * 40, line(id), line(id + 1)) +
         variable("outVariable", id + 3, line(id + 2), "c");
}

/// The body is a chart of 300 steps in a row, with an action each.
const std::string &chartBody() {
  static const std::string kText = [] {
    std::string text;
    for (size_t i = 1; i <= 300; ++i)
      text += fmt::format(
          "<step localId=\"{0}\" name=\"S{1}\" initialStep=\"{2}\"><connectionPointIn><connection "
          "refLocalId=\"{3}\"/></connectionPointIn></step><actionBlock localId=\"{4}\">"
          "<connectionPointIn><connection refLocalId=\"{0}\"/></connectionPointIn><action "
          "localId=\"0\"><reference name=\"x\"/></action></actionBlock><transition "
          "localId=\"{5}\"><connectionPointIn><connection refLocalId=\"{0}\"/>"
          "</connectionPointIn><condition><inline name=\"\"><ST><p>a</p></ST></inline></condition>"
          "</transition>\n",
          3 * i, i, i == 1, i == 1 ? 902 : 3 * i - 1, 3 * i + 1, 3 * i + 2);
    return "<SFC>" + text + "</SFC>";
  }();
  return kText;
}

std::string exportObject(size_t number) {
  return fmt::format(
      "<Single Type=\"x\"><Single Name=\"MetaObject\"><Single Name=\"Name\" Type=\"string\">B{0}"
      "</Single><Single Name=\"TypeGuid\">6f9dac99-8de1-4efc-8465-68ac443b7d08</Single></Single>"
      "<Array Name=\"Path\"><Single Type=\"string\">App</Single></Array><Single Name=\"Object\">"
      "<Single Name=\"Interface\"><Single Name=\"TextDocument\"><Single "
      "Name=\"TextBlobForSerialisation\">FUNCTION_BLOCK B{0}\nVAR\n x : INT;\nEND_VAR</Single>"
      "</Single></Single><Single Name=\"Implementation\"><Single Name=\"TextDocument\"><Single "
      "Name=\"TextBlobForSerialisation\">{1}</Single></Single></Single></Single></Single>\n",
      number, statements());
}

std::string sclBlock(size_t number) {
  return fmt::format("FUNCTION_BLOCK \"B{0}\"\nVERSION : 0.1\nVAR\n  x : Int;\nEND_VAR\nBEGIN\n"
                     "{1}END_FUNCTION_BLOCK\n\n",
                     number, statements());
}

const LargeFormat kFormats[] = {
    {"many.EXP", [](size_t size) { return repeated(size, "", expBlock, ""); }},
    {"one.EXP",
     [](size_t size) {
       return repeated(
           size,
           "(* @NESTEDCOMMENTS := 'No' *)\nPROGRAM P\nVAR\n  x : INT;\nEND_VAR\n"
           "(* @END_DECLARATION := '0' *)\n",
           [](size_t) { return statements(); }, "END_PROGRAM\n");
     }},
    {"many.xml",
     [](size_t size) {
       return repeated(
           size, kPlcOpenHead,
           [](size_t n) { return xmlBlock(n, "<ST><p>" + statements() + "</p></ST>"); },
           kPlcOpenTail);
     }},
    {"drawn.xml",
     [](size_t size) {
       return repeated(size,
                       kPlcOpenHead + "<pou name=\"P\" pouType=\"program\"><interface/><body><FBD>",
                       drawing, "</FBD></body></pou>" + kPlcOpenTail);
     }},
    {"charts.xml",
     [](size_t size) {
       return repeated(
           size, kPlcOpenHead, [](size_t n) { return xmlBlock(n, chartBody()); }, kPlcOpenTail);
     }},
    {"all.export",
     [](size_t size) {
       return repeated(size, "<ExportFile><StructuredView><Single><List2 Name=\"EntryList\">",
                       exportObject, "</List2></Single></StructuredView></ExportFile>");
     }},
    {"B.TcPOU",
     [](size_t size) {
       return repeated(
           size,
           "<TcPlcObject><POU Name=\"B\"><Declaration><![CDATA[FUNCTION_BLOCK B\n]]>"
           "</Declaration><Implementation><ST><![CDATA[",
           [](size_t) { return statements(); }, "]]></ST></Implementation></POU></TcPlcObject>");
     }},
    {"all.scl", [](size_t size) { return repeated(size, "", sclBlock, ""); }},
};

/// Seconds of the processor that reading and finishing takes.
double secondsFor(const LargeFormat &format, size_t size) {
  const std::string text = format.text(size);
  const FormatChoice choice = formatOf(format.file, text);
  EXPECT_NE(choice.format, nullptr) << format.file;
  const std::clock_t begin = std::clock();
  Model model;
  choice.format->read(format.file, text, model);
  FinishSettings settings;
  settings.own = {[](std::string_view) { return false; }, [](std::string_view) { return false; }};
  EXPECT_EQ(finish(model, settings), "");
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_FALSE(model.objects.empty()) << format.file;
  EXPECT_TRUE(model.leftOut.empty())
      << format.file << ": " << model.leftOut.front().object << ": " << model.leftOut.front().text;
  EXPECT_TRUE(model.unreadable.empty()) << format.file << ": " << model.unreadable.front().text;
  return seconds;
}

/// kB: a line of this process's state; 0: not known.
size_t memory(const std::string &key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key + ":"))
      return std::stoul(line.substr(key.size() + 1));
  return 0;
}

constexpr size_t kLarge = 10'000'000;

/// Four times the file takes four times as long; its square would be sixteen times. The text, its
/// tree and the model with its changes are less than 30 times the file.
TEST(LargeFiles, TakeTimeAndMemoryAsTheyAreLong) {
  for (const LargeFormat &format : kFormats) {
    const double quarter = secondsFor(format, kLarge / 4);
    std::ofstream("/proc/self/clear_refs") << "5"; // the peak begins anew
    const size_t before = memory("VmRSS");
    const double whole = secondsFor(format, kLarge);
    EXPECT_LT(whole, 9 * quarter + 0.05) << format.file << ": " << quarter << " s for a quarter";
    EXPECT_LT(memory("VmHWM"), before + 30 * kLarge / 1024) << format.file;
  }
}

} // namespace
} // namespace stc::import
