// Online change of unions, objects of __NEW, byte pointers and the process image.
#include "live_application.hpp"

#include <gmock/gmock-more-matchers.h>

namespace stride::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(OnlineMemory, Unions) {
  Live live(R"(
TYPE Bits : UNION d : DWORD; b : ARRAY[0..3] OF BYTE; r : REAL; END_UNION END_TYPE
TYPE Ref : UNION p : POINTER TO INT; number : LWORD; END_UNION END_TYPE
TYPE Holder : STRUCT n : INT; u : Bits; END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR
  u : Bits; h : ARRAY[1..2] OF Holder; x : INT := 5; r, s : Ref; p : POINTER TO BYTE; same : Bits;
END_VAR
  u.d := 16#01020304; h[2].u.r := 1.5; h[2].n := 7; r.p := ADR(x); s.number := 12345; p := ADR(u.b[2]);
END_PROGRAM
)");
  live.run(1);
  live.change(R"(
TYPE Bits : UNION b : ARRAY[0..3] OF BYTE; wide : LWORD; d : DWORD; r : REAL; END_UNION END_TYPE
TYPE Ref : UNION p : POINTER TO INT; number : LWORD; END_UNION END_TYPE
TYPE Holder : STRUCT first : LREAL; u : Bits; n : INT; END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR
  p : POINTER TO BYTE; r, s : Ref; y, x : INT; h : ARRAY[1..2] OF Holder; u : Bits;
END_VAR
  y := r.p^ + 1;
END_PROGRAM
)");
  EXPECT_THAT(live.events, IsEmpty());
  live.run(1);
  EXPECT_EQ(live.values({"PLC_PRG.u.d", "PLC_PRG.u.b[0]", "PLC_PRG.u.wide", "PLC_PRG.p^",
                         "PLC_PRG.h[2].u.r", "PLC_PRG.h[2].n", "PLC_PRG.s.number", "PLC_PRG.y"}),
            "16909060 4 16909060 2 1.5 7 12345 6");
}

TEST(OnlineMemory, ObjectsOfNew) {
  const auto program = [](const char *node, const char *variables, const char *body) {
    return std::string("TYPE Node : STRUCT ") + node +
           " value : INT; next : POINTER TO Node; END_STRUCT END_TYPE\n"
           "TYPE Other : STRUCT a, b : LREAL; END_STRUCT END_TYPE\nPROGRAM PLC_PRG\nVAR " +
           variables + " head, n : POINTER TO Node; o : POINTER TO Other; i, sum : INT; END_VAR\n" +
           body + "\nEND_PROGRAM\n";
  };
  const char *const make = "IF head = 0 THEN\n"
                           "  FOR i := 1 TO 4 DO\n"
                           "    n := __NEW(Node); n^.value := i * i; n^.next := head; head := n;\n"
                           "  END_FOR\n"
                           "  n := head^.next; o := __NEW(Other); o^.b := 2.5;\n"
                           "END_IF";
  const char *const add = "sum := 0; n := head;\n"
                          "WHILE n <> 0 DO sum := sum + n^.value; n := n^.next; END_WHILE\n"
                          "o^.b := o^.b + 1; o := __NEW(Other); o^.a := 9;";
  Live live(program("", "", make));
  live.run(2);
  EXPECT_EQ(live.values({"PLC_PRG.head^.value", "PLC_PRG.n^.value", "PLC_PRG.o^.b"}), "16 9 2.5");
  live.change(program("", "filler : ARRAY[0..99] OF LREAL;", add));
  EXPECT_THAT(live.events, IsEmpty());
  EXPECT_EQ(live.values({"PLC_PRG.head^.value", "PLC_PRG.n^.value", "PLC_PRG.o^.b"}), "16 9 2.5");
  live.run(1);
  EXPECT_EQ(live.values({"PLC_PRG.sum", "PLC_PRG.head^.next^.next^.next^.value", "PLC_PRG.o^.a"}),
            "30 1 9.0");
  // another type: the objects are given back
  live.change(program("added : BOOL;", "", make));
  EXPECT_THAT(live.events,
              ElementsAre("PLC_PRG.head is now 0: it pointed to an object of __NEW, which "
                          "has another type now"));
  EXPECT_EQ(live.values({"PLC_PRG.head^.value", "PLC_PRG.o^.a"}), "NULL 9.0");
  live.run(1);
  EXPECT_EQ(live["PLC_PRG.head^.value"], "16");
}

/// Two tasks: the second reads what the first writes.
TEST(OnlineMemory, CopiesOfConsistentVariables) {
  const auto program = [](const char *members, const char *initial) {
    return std::string("TYPE Point : STRUCT ") + members +
           " x, y : INT; p : POINTER TO INT; END_STRUCT END_TYPE\n"
           "VAR_GLOBAL\n  {attribute 'consistent'}\n  shared : Point := (x := " +
           initial +
           ");\n  target : INT;\nEND_VAR\n"
           "PROGRAM Write\n  shared.x := shared.x + 1; shared.y := shared.x; target := shared.x;\n"
           "  shared.p := ADR(target);\nEND_PROGRAM\n"
           "PROGRAM Read\nVAR copy : Point; behind : INT; END_VAR\n  copy := shared;\n"
           "  behind := shared.p^;\nEND_PROGRAM\n"
           "CONFIGURATION Plant\nRESOURCE Plc ON PC\n"
           "  TASK First (INTERVAL := T#1ms, PRIORITY := 1);\n"
           "  TASK Second (INTERVAL := T#1ms, PRIORITY := 2);\n"
           "  PROGRAM Write WITH First; PROGRAM Read WITH Second;\n"
           "END_RESOURCE\nEND_CONFIGURATION\n";
  };
  Live live(program("", "40"));
  live.run(2);
  live.run(1, 1);
  EXPECT_EQ(live.values({"Read.copy.x", "Read.copy.y", "Read.behind"}), "42 42 42");
  // The reader comes first, in a state with another layout: it sees what was carried over.
  live.change(program("added : LREAL;", "7"));
  EXPECT_THAT(live.events, IsEmpty());
  EXPECT_EQ(live.values({"shared.x", "Read.copy.x"}), "42 42");
  live.run(1, 1);
  EXPECT_EQ(live.values({"Read.copy.x", "Read.copy.y", "Read.behind"}), "42 42 42");
  live.run(1);
  live.run(1, 1);
  EXPECT_EQ(live.values({"Read.copy.x", "Read.copy.y", "Read.behind"}), "43 43 43");
}

} // namespace
} // namespace stride::test
