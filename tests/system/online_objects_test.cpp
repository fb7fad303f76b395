// Online change of programs with methods, interfaces and inheritance.
#include "live_application.hpp"

#include <gmock/gmock-more-matchers.h>

namespace stride::test {
namespace {

using app::Verdict;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char *kShape = R"(
INTERFACE IShape
METHOD Area : LREAL
END_METHOD
END_INTERFACE
)";

TEST(OnlineObjects, InterfacesLeadToTheSameInstances) {
  Live live(std::string(kShape) + R"(
FUNCTION_BLOCK Square IMPLEMENTS IShape
VAR_INPUT side : LREAL := 2.0; END_VAR
METHOD Area : LREAL
  Area := side * side;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Slab IMPLEMENTS IShape
METHOD Area : LREAL
  Area := 7.0;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR squares : ARRAY[1..2] OF Square; slab : Slab; shape, other, none : IShape; n : INT; area : LREAL; END_VAR
  n := n + 1;
  IF n = 1 THEN
    squares[2].side := 3.0; shape := squares[2]; other := slab;
  END_IF
  area := shape.Area() + other.Area();
END_PROGRAM
)");
  live.run(2);
  EXPECT_EQ(live.values({"PLC_PRG.n", "PLC_PRG.area"}), "2 16.0");
  // Another block takes the first number, Square gets a base that brings methods of its own, slab
  // goes.
  live.change(std::string(kShape) + R"(
FUNCTION_BLOCK Another IMPLEMENTS IShape
METHOD Area : LREAL
  Area := -1.0;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Figure
VAR id : INT := 5; END_VAR
METHOD Twice : LREAL
VAR_INPUT x : LREAL; END_VAR
  Twice := 2.0 * x;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Square EXTENDS Figure IMPLEMENTS IShape
VAR extra : STRING(11); END_VAR
VAR_INPUT side : LREAL := 9.0; END_VAR
METHOD Area : LREAL
  Area := THIS^.Twice(side * side);
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
  another : Another; n : INT; other, none, shape : IShape; squares : ARRAY[0..3] OF Square; area : LREAL;
  otherIsNull, noneIsNull : BOOL;
END_VAR
  n := n + 1;
  area := shape.Area();
  otherIsNull := other = 0;
  noneIsNull := none = 0;
END_PROGRAM
)");
  EXPECT_THAT(live.events,
              ElementsAre("PLC_PRG.other is now 0: it pointed to PLC_PRG.slab, which has "
                          "no methods in the new build, or is not in it"));
  live.run(1);
  EXPECT_EQ(live.values({"PLC_PRG.n", "PLC_PRG.area", "PLC_PRG.otherIsNull", "PLC_PRG.noneIsNull",
                         "PLC_PRG.squares[1].side", "PLC_PRG.squares[2].side",
                         "PLC_PRG.squares[0].side", "PLC_PRG.squares[2].id"}),
            "3 18.0 TRUE TRUE 2.0 3.0 9.0 5");
}

TEST(OnlineObjects, InheritanceAndPointersToBases) {
  Live live(R"(
FUNCTION_BLOCK Base
VAR count : INT; END_VAR
METHOD Step : INT
VAR_INST calls : INT; END_VAR
  calls := calls + 1; count := count + 1; Step := calls;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Derived EXTENDS Base
VAR own : INT := 10; END_VAR
METHOD Step : INT
  own := own + 1; Step := SUPER^.Step() + 100;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR d : Derived; b : Base; p, q : POINTER TO Base; r : REFERENCE TO Base; x, y, z : INT; END_VAR
  p := ADR(d); q := ADR(b); r REF= d;
  x := p^.Step(); y := q^.Step(); z := r.Step();
END_PROGRAM
)");
  live.run(2);
  // d: two steps a cycle
  EXPECT_EQ(live.values({"PLC_PRG.x", "PLC_PRG.y", "PLC_PRG.z", "PLC_PRG.d.count", "PLC_PRG.d.own",
                         "PLC_PRG.b.count"}),
            "103 2 104 4 14 2");
  live.change(R"(
FUNCTION_BLOCK First
METHOD Step : INT
  Step := -1;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Base
VAR added : LREAL := 1.5; count : INT; END_VAR
METHOD Step : INT
VAR_INST other : BOOL; calls : INT; END_VAR
  calls := calls + 1; count := count + 1; Step := calls;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Middle EXTENDS Base
VAR own : INT := 77; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Derived EXTENDS Middle
METHOD Step : INT
  own := own + 1; Step := SUPER^.Step() + 200;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR f : First; r : REFERENCE TO Base; q, p : POINTER TO Base; b : Base; d : Derived; x, y, z : INT; END_VAR
  x := p^.Step(); y := q^.Step(); z := r.Step();
END_PROGRAM
)");
  EXPECT_EQ(live.verdict, Verdict::Silent) << live.report;
  EXPECT_THAT(live.events, IsEmpty());
  live.run(1);
  EXPECT_EQ(live.values({"PLC_PRG.x", "PLC_PRG.y", "PLC_PRG.z", "PLC_PRG.d.count", "PLC_PRG.d.own",
                         "PLC_PRG.b.count", "PLC_PRG.d.added"}),
            "205 3 206 6 16 3 1.5");
}

TEST(OnlineObjects, ExitInitAndReinit) {
  const auto program = [](const char *extra) {
    return std::string(R"(
VAR_GLOBAL
  log : STRING(40);
  {attribute 'init_on_onlchange'} inits : STRING(40);
END_VAR
FUNCTION Note : BOOL
VAR_INPUT text : STRING(10); END_VAR
  log := CONCAT(log, text);
END_FUNCTION
FUNCTION_BLOCK Part
VAR )") + extra +
           R"( value : INT; place : POINTER TO INT; id : STRING(2); END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; name : STRING(2); END_VAR
  id := name;
  IF bInCopyCode THEN inits := CONCAT(inits, id); END_IF
  value := -1;
END_METHOD
METHOD FB_Exit : BOOL
VAR_INPUT bInCopyCode : BOOL; END_VAR
  IF bInCopyCode THEN Note('x'); ELSE Note('?'); END_IF
  Note(id);
  value := value + 1000;
END_METHOD
METHOD FB_Reinit : BOOL
  Note('r'); Note(id);
  place := ADR(value);
END_METHOD
METHOD Work : INT
  value := value + 1; Work := value;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR a : Part(name := 'a'); b : Part(name := 'b'); n : INT; END_VAR
  n := a.Work();
END_PROGRAM
)";
  };
  Live live(program(""));
  live.run(4);
  EXPECT_EQ(live.values({"log", "inits", "PLC_PRG.a.value", "PLC_PRG.b.value"}), "'' '' 3 -1");
  live.change(program("added : ARRAY[0..9] OF LREAL;"));
  EXPECT_EQ(live.values({"PLC_PRG.a.value", "PLC_PRG.b.value", "PLC_PRG.a.place^"}),
            "1003 999 1003");
  EXPECT_EQ(live["inits"], "'ab'");
  EXPECT_EQ(live["log"], "'xaxbrarb'");
  live.run(1);
  EXPECT_EQ(live.values({"PLC_PRG.n", "PLC_PRG.a.place^"}), "1004 1004");
}

} // namespace
} // namespace stride::test
