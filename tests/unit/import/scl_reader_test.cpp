// Reading sources of Siemens SCL: words, frames, data blocks, structures.
#include "compiler/import/scl_constants.hpp"
#include "compiler/import/scl_reader.hpp"
#include "compiler/import/scl_tokens.hpp"

#include <gtest/gtest.h>

#include <array>

namespace {

using namespace stc::import;

Model read(std::string_view text) {
  Model model;
  readScl("src/Blocks.scl", text, model);
  return model;
}

std::string onlyText(std::string_view text) {
  const Model model = read(text);
  EXPECT_EQ(model.objects.size(), 1U);
  return model.objects.empty() ? std::string() : model.objects[0].text;
}

TEST(SclTokens, JoinToTheTextAgain) {
  constexpr std::string_view kText = "#x := \"a b\".c[0..3] + T#1h_5s-16#FF*1.5e-3; // c\n(* d *) "
                                     "{E := 'f}'} DT#2023-11-08-16:59:10"
                                     " 'g$'h' #\"i j\"<>5..6 (/* k */) W#16#1F";
  std::string joined;
  std::vector<std::string> kinds;
  for (const SclToken &token : sclTokens(kText)) {
    joined += token.text;
    if (token.kind != SclKind::Blank && token.kind != SclKind::Sign)
      kinds.emplace_back(token.text);
  }
  EXPECT_EQ(joined, kText);
  EXPECT_EQ(kinds,
            (std::vector<std::string>{"#x", "\"a b\"", "c", "0", "3", "T#1h_5s", "16#FF", "1.5e-3",
                                      "// c", "(* d *)", "{E := 'f}'}", "DT#2023-11-08-16:59:10",
                                      "'g$'h'", "#\"i j\"", "5", "6", "(/* k */)", "W#16#1F"}));
}

TEST(SclReader, RewritesAFunctionBlock) {
  EXPECT_EQ(onlyText("// of the file\n"
                     "FUNCTION_BLOCK \"Level Control\"\n"
                     "TITLE = Level (new)\n"
                     "{ S7_Optimized_Access := 'TRUE' }\n"
                     "AUTHOR : Me\n"
                     "VERSION : 0.1\n"
                     "//what it does\n"
                     "   VAR_INPUT\n"
                     "      Level { S7_SetPoint := 'True'} : Real := 1.5;   // [m]\n"
                     "   END_VAR\n\n"
                     "   VAR RETAIN\n      n : DInt := L#7;\n   END_VAR\n"
                     "   VAR DB_SPECIFIC\n      \"last value\" : Array[0..2] of Word;\n   END_VAR\n"
                     "   VAR_IN_OUT\n      io : Int := 4;\n   END_VAR\n"
                     "   VAR CONSTANT\n      Top : Int := 3;\n   END_VAR\n"
                     "BEGIN\n"
                     "\tREGION Limits (1)\n"
                     "\t  IF #Level > 2.5 THEN // (* old\n"
                     "\t    #\"last value\"[0] := W#16#1F; (* a (* b *)\n"
                     "\t    #n += #io;\n"
                     "\t  END_IF;\n"
                     "\tEND_REGION\n"
                     "\t\"Tags\".run := %I0.3 AND #n.%X2;\n"
                     "\tGOTO ende;\n"
                     "\tende: ;\n"
                     "END_FUNCTION_BLOCK\n"),
            "// of the file\n"
            "// TITLE = Level (new)\n// AUTHOR : Me\n// VERSION : 0.1\n//what it does\n"
            "FUNCTION_BLOCK Level_Control\n"
            "VAR_INPUT\n      Level  : Real := 1.5;   // [m]\n   END_VAR\n\n"
            "   VAR RETAIN\n      n : DInt := DINT#7;\n   END_VAR\n"
            "   VAR\n      last_value : Array[0..2] of Word;\n   END_VAR\n"
            "   VAR_IN_OUT\n      io : Int;\n   END_VAR\n"
            "   VAR CONSTANT\n      Top : Int := 3;\n   END_VAR\n"
            "\n"
            "\t// REGION Limits (1)\n"
            "\t  IF Level > 2.5 THEN // (* old\n"
            "\t    last_value[0] := WORD#16#1F; (* a ( * b *)\n"
            "\t    n := n + ( io);\n"
            "\t  END_IF;\n"
            "\t// END_REGION\n"
            "\tTags.run := %IX0.3 AND n.%X2;\n"
            "\tJMP ende;\n"
            "\tende: ;\n"
            "END_FUNCTION_BLOCK\n");
}

TEST(SclReader, ReportsWhatItRenames) {
  const Model model = read("FUNCTION \"a b\" : Int\nBEGIN\n#\"a b\" := #\"x y\";\n#\"x y\" := 2;\n"
                           "END_FUNCTION\n");
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].text, "FUNCTION a_b : Int\n\na_b := x_y;\nx_y := 2;\nEND_FUNCTION\n");
  ASSERT_EQ(model.changed.size(), 2U);
  EXPECT_EQ(model.changed[0].object, "FUNCTION");
  EXPECT_EQ(model.changed[1].object, "FUNCTION a_b");
  EXPECT_EQ(model.changed[1].text, "`x y` is called x_y here");
  EXPECT_EQ(model.changed[1].origin.line, 3U);
}

TEST(SclReader, MakesAProgramOfAnOrganizationBlock) {
  const Model model = read("ORGANIZATION_BLOCK \"Main\"\nVAR_TEMP\n  t : Int;\nEND_VAR\n\nBEGIN\n"
                           "  \"Level\"(x := #t);\nEND_ORGANIZATION_BLOCK\n"
                           "ORGANIZATION_BLOCK OB35\nBEGIN\nEND_ORGANIZATION_BLOCK\n");
  ASSERT_EQ(model.objects.size(), 2U);
  EXPECT_EQ(model.objects[0].text,
            "PROGRAM Main\nVAR_TEMP\n  t : Int;\nEND_VAR\n\n\n  Level(x := t);\nEND_PROGRAM\n");
  ASSERT_EQ(model.tasks.size(), 1U);
  EXPECT_EQ(model.tasks[0].programs, (std::vector<std::string>{"Main"}));
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_EQ(model.leftOut[0].object, "ORGANIZATION_BLOCK OB35");
}

TEST(SclReader, MakesVariablesOfDataBlocks) {
  const Model model =
      read("DATA_BLOCK \"Tags\"\n{ S7_Optimized_Access := 'TRUE' }\nVERSION : 0.1\nNON_RETAIN\n"
           "   VAR\n      run : Bool;\n      top : Int := 5;\n      f : Array[1..2] of Real;\n"
           "   END_VAR\n\nBEGIN\n   run := TRUE;\n   top := 7;\n   f[1] := 2.5;\nEND_DATA_BLOCK\n"
           "DATA_BLOCK \"Level_DB\"\nVERSION : 0.1\n\"Level\"\nBEGIN\n   Kp := 1.5;\n"
           "END_DATA_BLOCK\n"
           "DATA_BLOCK DB7\n  STRUCT\n    a : INT;\n  END_STRUCT ;\nBEGIN\nEND_DATA_BLOCK\n");
  ASSERT_EQ(model.objects.size(), 3U);
  EXPECT_EQ(model.objects[0].kind, ObjectKind::GlobalList);
  EXPECT_EQ(model.objects[0].name, "Tags");
  EXPECT_EQ(model.objects[0].text,
            "// VERSION : 0.1\n// NON_RETAIN\n{attribute 'qualified_only'}\nVAR_GLOBAL\n"
            "      run : Bool := TRUE;\n      top : Int := 7;\n      f : Array[1..2] of Real;\n"
            "   END_VAR\n");
  EXPECT_EQ(model.objects[1].text,
            "// VERSION : 0.1\nVAR_GLOBAL\n  Level_DB : Level := (kp := 1.5);\nEND_VAR\n");
  EXPECT_EQ(model.objects[2].text,
            "{attribute 'qualified_only'}\nVAR_GLOBAL\n    a : INT;\n  END_VAR\n");
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_NE(model.leftOut[0].text.find("f[1] := 2.5"), std::string::npos);
}

TEST(SclReader, GivesStructuresNames) {
  EXPECT_EQ(onlyText("TYPE \"Axis\"\nVERSION : 0.1\n   STRUCT\n      a : Struct\n"
                     "         b : Array[0..1] of Struct\n            c : Int := 3;\n"
                     "         END_STRUCT;\n      END_STRUCT;\n      d : \"Other\";\n"
                     "   END_STRUCT;\n\nEND_TYPE\n"),
            "TYPE Axis_a_b :\nSTRUCT\n            c : Int := 3;\n         END_STRUCT\nEND_TYPE\n\n"
            "TYPE Axis_a :\nSTRUCT\n         b : Array[0..1] of Axis_a_b;\n      END_STRUCT\n"
            "END_TYPE\n\n"
            "// VERSION : 0.1\nTYPE Axis :\nSTRUCT\n      a : Axis_a;\n      d : Other;\n"
            "   END_STRUCT\nEND_TYPE\n");
}

TEST(SclReader, NamesWhatHasNoCounterpart) {
  const Model model = read("FUNCTION_BLOCK F\nVAR\n  t : Variant;\n  w : Word;\n  b AT w : "
                           "Array[0..16] of Bool;\nEND_VAR\nCONST\n  K := 5 * M;\nEND_CONST\n"
                           "LABEL\n  m1;\nEND_LABEL\nBEGIN\n  #s := S5T#2s;\n  #x := "
                           "%DB1.DBX0.0;\nEND_FUNCTION_BLOCK\nrest\n");
  ASSERT_EQ(model.objects.size(), 1U);
  std::vector<std::string> said;
  for (const Remark &each : model.leftOut)
    said.push_back(std::to_string(each.origin.line) + each.text.substr(0, 12));
  EXPECT_EQ(said, (std::vector<std::string>{"3the type Var", "5`b` is a vie", "8the constant",
                                            "14constants li", "15the address ", "17it belongs t"}))
      << model.leftOut.size();
}

/// The value says the type; what is no plain value is left out.
TEST(SclReader, GivesConstantsTypes) {
  const Model model =
      read("FUNCTION_BLOCK F\nCONST\n  a := 5; // five\n  b := -32_768;\n  c := 32768;\n  d := "
           "2.5E-1;\n  e := 'x';\n  f := TRUE;\n  g := T#5s;\n  h := W#16#FF;\n  i := 16#A;\n"
           "  j := 3_000_000_000;\n  k := DTL#2024-02-29-20:34:23.25;\n"
           "END_CONST\nBEGIN\n  #x := #a;\nEND_FUNCTION_BLOCK\n");
  EXPECT_TRUE(model.leftOut.empty());
  EXPECT_EQ(model.objects[0].text,
            "FUNCTION_BLOCK F\nVAR CONSTANT\n  a : INT := 5; // five\n  b : INT := -32_768;\n"
            "  c : DINT := 32768;\n  d : REAL := 2.5E-1;\n  e : STRING := 'x';\n"
            "  f : BOOL := TRUE;\n  g : TIME := T#5s;\n  h : WORD := WORD#16#FF;\n"
            "  i : INT := 16#A;\n  j : UDINT := 3_000_000_000;\n"
            "  k : DTL := (YEAR := 2024, MONTH := 2, DAY := 29, WEEKDAY := 5, HOUR := 20, "
            "MINUTE := 34, SECOND := 23, NANOSECOND := 250000000);\n"
            "END_VAR\n\n  x := a;\nEND_FUNCTION_BLOCK\n");
}

/// At the last value of each type, and after it.
TEST(SclConstants, TakeTheSmallestIntegerType) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kExpected = {
      {{"32767", "INT"},
       {"32768", "DINT"},
       {"-32768", "INT"},
       {"-32769", "DINT"},
       {"2147483647", "DINT"},
       {"2147483648", "UDINT"},
       {"-2147483648", "DINT"},
       {"-2147483649", "LINT"},
       {"4294967295", "UDINT"},
       {"4294967296", "LINT"},
       {"9223372036854775807", "LINT"},
       {"9223372036854775808", "ULINT"},
       {"-9223372036854775808", "LINT"},
       {"-9223372036854775809", ""},
       {"18446744073709551615", "ULINT"},
       {"18446744073709551616", ""},
       {"16#FFFF_FFFF", "UDINT"},
       {"2#1000_0000_0000_0000", "DINT"},
       {"8#777", "INT"},
       {"7#6", ""},
       {"LT#5ns", "LTIME"}}};
  for (const auto &[value, type] : kExpected)
    EXPECT_EQ(sclConstantType(value), type) << value;
}

TEST(SclConstants, ReadDates) {
  EXPECT_EQ(sclDateValue("DTL#1970-01-01-00:00:00").value_or(""),
            "(YEAR := 1970, MONTH := 1, DAY := 1, WEEKDAY := 5, HOUR := 0, MINUTE := 0, "
            "SECOND := 0, NANOSECOND := 0)");
  EXPECT_EQ(sclDateValue("dtl#2262-4-11-23:47:16.854775807").value_or(""),
            "(YEAR := 2262, MONTH := 4, DAY := 11, WEEKDAY := 6, HOUR := 23, MINUTE := 47, "
            "SECOND := 16, NANOSECOND := 854775807)");
  for (const std::string_view bad :
       {"DTL#", "DTL", "DTL#2023-02-29-00:00:00", "DTL#2023-02-28", "DTL#2023-02-28-24:00:00",
        "DTL#2023-02-28-23:60:00", "DTL#2023-02-28-23:59:60", "DTL#1969-12-31-00:00:00",
        "DTL#2023-02-28-23:59:59.", "DTL#2023-02-28-23:59:59.1234567890",
        "DTL#2023-02-28-23:59:59.1x", "DTL#2023-13-01-00:00:00"})
    EXPECT_FALSE(sclDateValue(bad)) << bad;
}

TEST(SclConstants, KeepViewsOfOneSize) {
  EXPECT_TRUE(isSclViewKept("DWORD", " Real "));
  EXPECT_TRUE(isSclViewKept("Int", "Word"));
  EXPECT_TRUE(isSclViewKept("Array[0..2] of Byte", "array [ -1 .. 1 ] of Char"));
  EXPECT_TRUE(isSclViewKept("Word", "Array[1..4] of Int"));
  EXPECT_FALSE(isSclViewKept("Array[0..3] of Byte", "Array[1..3] of Byte"));
  EXPECT_FALSE(isSclViewKept("Array[0..1] of Byte", "Word"));
  EXPECT_FALSE(isSclViewKept("Array[0..15] of Bool", "Word"));
  EXPECT_FALSE(isSclViewKept("Word", "Date"));
  EXPECT_FALSE(isSclViewKept("Array[0..1, 0..1] of Byte", "Array[0..3] of Byte"));
  EXPECT_FALSE(isSclViewKept("Array[0..N] of Byte", "Array[0..3] of Byte"));
  EXPECT_FALSE(isSclViewKept("", "Word"));
}

/// A view of one size is a pointer, which each call lets refer to the variable anew.
TEST(SclReader, KeepsViewsAndDatesInStatements) {
  const Model model =
      read("FUNCTION_BLOCK F\nVAR_INPUT\n  r : Real;\nEND_VAR\nVAR\n  d AT r : DWord; // bits\n"
           "  w : Word;\n  b AT w : Array[0..1] of Char;\n  t : DTL := DTL#2020-02-29-01:02:03;\n"
           "END_VAR\nBEGIN\n  #d := #d AND DW#16#7FFF_FFFF;\n  G(d := #x.d);\n  d += d.%B0;\n"
           "  #t := DTL#2021-01-02-03:04:05.006;\nEND_FUNCTION_BLOCK\n");
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_EQ(model.leftOut[0].origin.line, 8U);
  ASSERT_FALSE(model.objects.empty());
  EXPECT_EQ(model.objects[0].text,
            "FUNCTION_BLOCK F\nVAR_INPUT\n  r : Real;\nEND_VAR\nVAR\n   // bits\n  w : Word;\n"
            "  b AT w : Array[0..1] of Char;\n  t : DTL := (YEAR := 2020, MONTH := 2, DAY := 29, "
            "WEEKDAY := 7, HOUR := 1, MINUTE := 2, SECOND := 3, NANOSECOND := 0);\n"
            "END_VAR\nVAR_TEMP\n  d : POINTER TO DWord;\nEND_VAR\nVAR CONSTANT\n"
            "  DTL_2021_01_02_03_04_05_006 : DTL := (YEAR := 2021, MONTH := 1, DAY := 2, "
            "WEEKDAY := 7, HOUR := 3, MINUTE := 4, SECOND := 5, NANOSECOND := 6000000);\n"
            "END_VAR\nd := ADR(r);\n\n  d^ := d^ AND DWORD#16#7FFF_FFFF;\n  G(d := x.d);\n"
            "  d^ := d^ + ( d^.%B0);\n  t := DTL_2021_01_02_03_04_05_006;\nEND_FUNCTION_BLOCK\n");
}

/// Byte 0 is the high one; a part that only the running program chooses has no counterpart.
TEST(SclReader, MakesBitsAndBytesOfViewsWithParts) {
  const Model model = read(
      "FUNCTION_BLOCK F\nVAR\n  w : Word;\n  r : Real;\n  bits AT w : Array[0..15] of Bool;\n"
      "  bytes AT r : Array[1..4] of Byte;\n  s AT w : Struct\n    a, b : Bool;\n    c : Byte;\n"
      "  END_STRUCT ;\n  words AT r : Array[0..1] of Word;\n  any AT w : Array[0..15] of Bool;\n"
      "  all AT w : Array[0..15] of Bool;\n  beyond AT w : Array[0..15] of Bool;\n  i : Int;\n"
      "END_VAR\nBEGIN\n  #bits[0] := bits [ 15 ];\n  #bytes[1] += #bytes[4];\n  #s.\"B\" := "
      "s.a;\n  G(bits := #x.bits, i := #s.c);\n  #words[0] := #words[01];\n  #any[#i] := TRUE;\n"
      "  H(#all);\n  #beyond[16] := TRUE;\nEND_FUNCTION_BLOCK\n");
  ASSERT_EQ(model.leftOut.size(), 3U);
  EXPECT_EQ(model.leftOut[0].origin.line, 12U);
  EXPECT_EQ(model.leftOut[1].origin.line, 13U);
  EXPECT_EQ(model.leftOut[2].origin.line, 14U);
  ASSERT_EQ(model.objects.size(), 1U);
  const std::string &text = model.objects[0].text;
  EXPECT_EQ(
      text.substr(text.find("VAR_TEMP")),
      "VAR_TEMP\n  bits : POINTER TO WORD;\n  bytes : POINTER TO DWORD;\n  s : POINTER TO "
      "WORD;\n  words : POINTER TO DWORD;\nEND_VAR\nbits := ADR(w);\nbytes := ADR(r);\ns := "
      "ADR(w);\nwords := ADR(r);\n\n  bits^.8 := bits^.7;\n  bytes^.%B3 := bytes^.%B3 + ( "
      "bytes^.%B0);\n  s^.9 := s^.8;\n  G(bits := x.bits, i := s^.%B0);\n  words^.%W1 := "
      "words^.%W0;\n  any[i] := TRUE;\n  H(all);\n  beyond[16] := TRUE;\nEND_FUNCTION_BLOCK\n");
}

/// The CPU brings it along; here it becomes a structure, once.
TEST(SclReader, MakesAStructureOfDtl) {
  const Model model = read("FUNCTION_BLOCK F\nVAR\n  t : DTL;\n  u : dtl;\nEND_VAR\nBEGIN\n"
                           "  #t.YEAR := 2026;\nEND_FUNCTION_BLOCK\n");
  EXPECT_TRUE(model.leftOut.empty());
  ASSERT_EQ(model.objects.size(), 2U);
  EXPECT_EQ(model.objects[1].name, "DTL");
  EXPECT_NE(model.objects[1].text.find("  NANOSECOND : UDINT;\n"), std::string::npos);
  EXPECT_EQ(model.objects[1].origin.line, 3U);
}

TEST(SclReader, LeavesOutWhatDoesNotEnd) {
  const Model model = read("FUNCTION_BLOCK A\nBEGIN\nEND_FUNCTION_BLOCK\nTYPE B\nSTRUCT\n");
  EXPECT_EQ(model.objects.size(), 1U);
  ASSERT_EQ(model.leftOut.size(), 1U);
  EXPECT_EQ(model.leftOut[0].origin.line, 4U);
  EXPECT_EQ(read("TYPE").leftOut.size(), 1U);
  EXPECT_EQ(read("").objects.size(), 0U);
}

TEST(SclReader, KnowsItsFiles) {
  EXPECT_TRUE(isScl("DATA_BLOCK \"x\""));
  EXPECT_FALSE(isScl("<?xml version='1.0'?><a>DATA_BLOCK</a>"));
  EXPECT_FALSE(isScl("FUNCTION_BLOCK x"));
}

TEST(SclReader, CommentsDoNotBeginAtTheirEnd) {
  EXPECT_EQ(onlyText("FUNCTION_BLOCK F\nBEGIN\n(* a (*) #n := 1; (*(*) #m := 2;\n"
                     "END_FUNCTION_BLOCK\n"),
            "FUNCTION_BLOCK F\n\n(* a ( *) n := 1; (*( *) m := 2;\nEND_FUNCTION_BLOCK\n");
}

TEST(SclReader, DeclarationsThatDoNotEndTakeOnlyTheirBlock) {
  const Model model = read("FUNCTION_BLOCK A\nVAR\n  n : Int;\nBEGIN\n  #n := 1;\n"
                           "END_FUNCTION_BLOCK\n"
                           "DATA_BLOCK D\nSTRUCT\n  m : Int;\nBEGIN\n  m := 3\nEND_DATA_BLOCK\n"
                           "FUNCTION_BLOCK B\nVAR\n  k : Int;\nEND_VAR\nBEGIN\n  #k := 2;\n"
                           "END_FUNCTION_BLOCK\n");
  ASSERT_EQ(model.objects.size(), 1U);
  EXPECT_EQ(model.objects[0].name, "B");
  EXPECT_EQ(model.objects[0].origin.line, 13U);
  std::vector<std::string> lost;
  for (const Remark &each : model.leftOut)
    if (each.text.find("do not end") != std::string::npos)
      lost.push_back(each.object);
  EXPECT_EQ(lost, (std::vector<std::string>{"FUNCTION_BLOCK A", "DATA_BLOCK D"}));
}

} // namespace
