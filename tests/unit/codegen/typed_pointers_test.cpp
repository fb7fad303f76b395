// What a loop keeps in C++ locals while it follows pointers: nothing where an address of the
// program may lead to a variable of another type.

#include "program.hpp"

#include <gtest/gtest.h>

namespace stc::test {

namespace {

constexpr const char *kDeclarations = R"(
TYPE Node : STRUCT next : POINTER TO Node; key : DINT; END_STRUCT END_TYPE
TYPE Number : UNION one : DINT; two : UDINT; END_UNION END_TYPE
INTERFACE Named
END_INTERFACE
FUNCTION_BLOCK Base IMPLEMENTS Named VAR_INPUT n : DINT; q : POINTER TO Node; END_VAR END_FUNCTION_BLOCK
FUNCTION_BLOCK Derived EXTENDS Base VAR_OUTPUT m : INT; END_VAR END_FUNCTION_BLOCK
FUNCTION_BLOCK Led VAR_IN_OUT node : Node; END_VAR node.key := node.key + 1; END_FUNCTION_BLOCK
FUNCTION Swap : BOOL VAR_IN_OUT a, b : POINTER TO Node; END_VAR END_FUNCTION
FUNCTION First : POINTER TO Node VAR_INPUT from : POINTER TO Node; END_VAR First := from; END_FUNCTION
FUNCTION Bytes : BOOL VAR_INPUT from : POINTER TO BYTE; END_VAR END_FUNCTION

FUNCTION Address : BOOL VAR_INPUT from : ULINT; END_VAR END_FUNCTION
)";

/// The locals of the loop of a program with these declarations before it, variables, statements and
/// statements of the loop: `sum p `.
std::string keptBy(const std::string &more, const std::string &variables, const std::string &before,
                   const std::string &loop) {
  const std::string text =
      fileText(generate({{"Main.st", kDeclarations + more +
                                         "PROGRAM Main\nVAR nodes : ARRAY[0..3] OF Node; p, q, r : "
                                         "POINTER TO Node; i, n : DINT; sum : LINT; " +
                                         variables + " END_VAR\n" + before +
                                         "\np := ADR(nodes[0]);\nWHILE p <> 0 DO " + loop +
                                         " END_WHILE\nEND_PROGRAM\n"}}),
               "user/Main.cpp");
  std::string kept;
  for (const char *name : {"sum", "n", "p", "d"})
    if (text.find(std::string(" this->") + name + " = " + name + ";") != std::string::npos)
      kept += std::string(name) + ' ';
  return kept;
}

std::string keptAfter(const std::string &variables, const std::string &before) {
  return keptBy("", variables, before, "sum := sum + p^.key; p := p^.next;");
}

std::string keptIn(const std::string &variables, const std::string &loop) {
  return keptBy("", variables, "", loop);
}

/// That of a loop over nodes.
constexpr const char *kBoth = "sum p ";

} // namespace

TEST(TypedPointers, LoopsKeepWhatNoPointerOfItsTypeLeadsTo) {
  EXPECT_EQ(keptAfter("", ""), kBoth);
  EXPECT_EQ(keptIn("d : POINTER TO LINT;", "sum := sum + 1; d^ := 2; p := p^.next;"), "p ");
  EXPECT_EQ(keptIn("d : POINTER TO DINT;", "sum := sum + 1; d^ := 2; n := n + 1; p := p^.next;"),
            kBoth);
  EXPECT_EQ(keptIn("d : POINTER TO DINT;", "n := n + d^; p := p^.next;"), "p ");
  // A pointer to pointers may lead to p.
  EXPECT_EQ(keptIn("d : POINTER TO POINTER TO Node;", "sum := sum + 1; p := d^^.next;"), "sum ");
  // What is put back for each call is a number only.
  EXPECT_EQ(keptIn("led : Led;", "sum := sum + 1; led(node := p^); p := p^.next;"), "sum ");
  EXPECT_EQ(keptIn("", "sum := sum + 1; q := ADR(nodes[1]); p := p^.next;"), "");
  EXPECT_EQ(keptIn("a : POINTER TO Base;", "sum := sum + a^.n; p := p^.next;"), kBoth);
}

TEST(TypedPointers, AddressesOfTheTypeAreTyped) {
  EXPECT_EQ(keptAfter("", "q := p; IF q = r OR r <> 0 THEN r := First(q); Swap(p, r); END_IF"),
            kBoth);
  EXPECT_EQ(keptAfter("a : ARRAY[0..2] OF DINT; d : POINTER TO DINT;",
                      "d := ADR(a); d := ADR(a[i]); d := 0;"),
            kBoth);
  EXPECT_EQ(keptAfter("b : POINTER TO Base; x : Derived;", "b := ADR(x);"), kBoth);
  EXPECT_EQ(keptAfter("", "r := __NEW(Node); r := SEL(i > 1, p, q);"), kBoth);
  EXPECT_EQ(keptAfter("u : Number; d : POINTER TO UDINT;", "d := ADR(u.two);"), kBoth);
  EXPECT_EQ(keptAfter("x : Base := (q := ADR(nodes[2]));", ""), kBoth);
}

TEST(TypedPointers, OneAddressOfUnknownTypeSpoilsAll) {
  EXPECT_EQ(keptAfter("d : POINTER TO DINT;", "d := d + 4;"), "");
  EXPECT_EQ(keptAfter("d : POINTER TO DINT;", "d[1] := 4;"), "");
  EXPECT_EQ(keptAfter("d : POINTER TO UDINT;", "d := ADR(n);"), "");
  EXPECT_EQ(keptAfter("d : POINTER TO BYTE;", "d := ADR(sum);"), "");
  EXPECT_EQ(keptAfter("d : POINTER TO DINT; u : ULINT;", "d := u;"), "");
  EXPECT_EQ(keptAfter("d : POINTER TO DINT;", "d := 16#1000;"), "");
  EXPECT_EQ(keptAfter("d : POINTER TO DINT; u : ULINT;", "u := d;"), "");
  EXPECT_EQ(keptAfter("u : ULINT;", "u := q - p;"), "");
  EXPECT_EQ(
      keptBy("TYPE Both : UNION one : POINTER TO DINT; two : POINTER TO Node; END_UNION END_TYPE\n",
             "", "", "sum := sum + p^.key; p := p^.next;"),
      "");
  EXPECT_EQ(keptAfter("", "Bytes(ADR(sum));"), "");
  EXPECT_EQ(keptAfter("", "Address(ADR(sum));"), "");
  EXPECT_EQ(keptAfter("", "r := __NEW(Node); __DELETE(r);"), "");
  EXPECT_EQ(keptAfter("d : POINTER TO DINT := 4096;", ""), "");
  EXPECT_EQ(keptAfter("x : Derived; b : POINTER TO Base; d : POINTER TO Derived;",
                      "b := ADR(x); d := b;"),
            "");
}

TEST(TypedPointers, InitialValuesOfTheConfigurationAreAddressesToo) {
  const auto kept = [](const std::string &type) {
    return keptBy("VAR_GLOBAL x : " + type +
                      "; END_VAR\nCONFIGURATION Machine VAR_CONFIG Main.d : " +
                      "POINTER TO DINT := ADR(x); END_VAR END_CONFIGURATION\n",
                  "d : POINTER TO DINT;", "", "sum := sum + d^; p := p^.next;");
  };
  EXPECT_EQ(kept("DINT"), kBoth);
  EXPECT_EQ(kept("UDINT"), "");
}

TEST(TypedPointers, WhatEndsWithItsCallSpoilsAll) {
  const auto kept = [](const std::string &more) {
    return keptBy(more, "", "", "sum := sum + p^.key; p := p^.next;");
  };
  EXPECT_EQ(
      kept("FUNCTION F : BOOL VAR d : POINTER TO DINT; v : DINT; END_VAR d := 0; END_FUNCTION\n"),
      kBoth);
  EXPECT_EQ(kept("FUNCTION F : BOOL VAR d : POINTER TO DINT; v : DINT; END_VAR d := ADR(v); "
                 "END_FUNCTION\n"),
            "");
  EXPECT_EQ(kept("FUNCTION F : BOOL VAR d : POINTER TO DINT; END_VAR VAR_STAT v : DINT; END_VAR d "
                 ":= ADR(v); END_FUNCTION\n"),
            kBoth);
  EXPECT_EQ(kept("FUNCTION F : BOOL VAR_IN_OUT v : DINT; END_VAR VAR d : POINTER TO DINT; END_VAR "
                 "d := ADR(v); END_FUNCTION\n"),
            "");
  EXPECT_EQ(kept("FUNCTION F : BOOL VAR x : Base; END_VAR x.n := 1; END_FUNCTION\n"), "");
  EXPECT_EQ(kept("FUNCTION_BLOCK F VAR d : POINTER TO DINT; END_VAR VAR_TEMP v : DINT; END_VAR d "
                 ":= ADR(v); END_FUNCTION_BLOCK\n"),
            "");
  EXPECT_EQ(kept("FUNCTION_BLOCK F VAR d : REFERENCE TO DINT; e : POINTER TO DINT; END_VAR e := "
                 "ADR(d); END_FUNCTION_BLOCK\n"),
            "");
}

} // namespace stc::test
