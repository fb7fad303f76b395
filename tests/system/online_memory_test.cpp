// Online change of unions, objects of __NEW, byte pointers and the process image.
#include "live_application.hpp"

#include <gmock/gmock.h>

namespace stride::test {
namespace {

using app::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
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

} // namespace
} // namespace stride::test
