// The parts of the language beyond V2.3: members, classes, namespaces, configurations.
#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

namespace stc::test {
namespace {

std::string tree(const std::string &text) {
  const Parsed parsed(text);
  return parsed.diagnostics.hasErrors() ? parsed.rendered() : print(*parsed.file);
}

std::string errors(const std::string &text) { return Parsed(text).errors(); }

TEST(Language, Methods) {
  EXPECT_EQ(tree("FUNCTION_BLOCK PUBLIC ABSTRACT A EXTENDS L.B IMPLEMENTS C, D.E\n"
                 "VAR PRIVATE a : INT; END_VAR\n"
                 "METHOD PUBLIC FINAL f : REFERENCE TO INT\nVAR_INPUT x : INT; END_VAR\n"
                 "VAR_INST n : INT; END_VAR\nf REF= x;\nEND_METHOD\n"
                 "a := 1;\nMETHOD g END_METHOD\nb := 2;\nEND_FUNCTION_BLOCK\n"
                 "METHOD PROTECTED OVERRIDE h : BOOL END_METHOD"),
            "(FUNCTION_BLOCK PUBLIC ABSTRACT A EXTENDS L.B IMPLEMENTS C IMPLEMENTS D.E\n"
            "  (VAR PRIVATE a INT)\n  (:= a 1)\n  (:= b 2)\n"
            "  (METHOD PUBLIC FINAL f : (reference INT)\n  (VAR_INPUT x INT)\n  (VAR_INST n INT)\n"
            "  (REF= f x))\n  (METHOD g)\n  (METHOD PROTECTED OVERRIDE h : BOOL))\n");
  EXPECT_EQ(tree("FUNCTION_BLOCK A END_FUNCTION_BLOCK PROGRAM P END_PROGRAM\n"
                 "METHOD A.m : INT END_METHOD ACTION P.x: y := 1; END_ACTION ACTION z a(); "
                 "END_ACTION"),
            "(FUNCTION_BLOCK A\n  (METHOD m : INT))\n(PROGRAM P\n  (ACTION x\n  (:= y 1))\n  "
            "(ACTION z\n  (call a)))\n");
  EXPECT_EQ(tree("PROGRAM P a := 1; END_PROGRAM ACTIONS P ACTION x: y := 1; END_ACTION ACTION z: "
                 "END_ACTION END_ACTIONS"),
            "(PROGRAM P\n  (:= a 1)\n  (ACTION x\n  (:= y 1))\n  (ACTION z))\n");
}

TEST(Language, Properties) {
  EXPECT_EQ(tree("FUNCTION_BLOCK A\nPROPERTY PUBLIC p : INT\nGET VAR t : INT; END_VAR p := t; "
                 "END_GET\nSET t := p; END_SET\nEND_PROPERTY\nEND_FUNCTION_BLOCK"),
            "(FUNCTION_BLOCK A\n  (PROPERTY PUBLIC p : INT GET : INT\n  (VAR t INT)\n  (:= p t) "
            "SET\n  (VAR_INPUT p INT)\n  (:= t p)))\n");
  EXPECT_EQ(tree("INTERFACE I EXTENDS J, K.L\nPROPERTY p : INT GET SET END_PROPERTY\nPROPERTY q : "
                 "BOOL GET END_GET END_PROPERTY\nMETHOD m : INT VAR_INPUT x : INT; END_VAR "
                 "END_METHOD\nEND_INTERFACE"),
            "(INTERFACE I IMPLEMENTS J IMPLEMENTS K.L\n  (METHOD m : INT\n  (VAR_INPUT x INT))\n  "
            "(PROPERTY p : INT GET : INT SET\n  (VAR_INPUT p INT))\n  (PROPERTY q : BOOL GET : "
            "BOOL))\n");
  EXPECT_EQ(
      tree("FUNCTION_BLOCK A\nPROPERTY set : INT\nGET set := get; get := 1; END_GET\n"
           "END_PROPERTY\nVAR get, set : INT; END_VAR\nset := 1; get(1);\nEND_FUNCTION_BLOCK"),
      "(FUNCTION_BLOCK A\n  (VAR get INT)\n  (VAR set INT)\n  (:= set 1)\n  (call get 1)\n  "
      "(PROPERTY set : INT GET : INT\n  (:= set get)\n  (:= get 1)))\n");
}

TEST(Language, Classes) {
  EXPECT_EQ(
      tree("CLASS FINAL A EXTENDS B IMPLEMENTS C VAR PUBLIC x : INT; END_VAR VAR PROTECTED "
           "CONSTANT y : INT := 1; END_VAR METHOD PUBLIC m END_METHOD END_CLASS"),
      "(CLASS FINAL A EXTENDS B IMPLEMENTS C\n  (VAR PUBLIC x INT)\n  (VAR CONSTANT PROTECTED "
      "y INT := 1)\n  (METHOD PUBLIC m))\n");
}

TEST(Language, ObjectText) {
  EXPECT_EQ(tree("FUNCTION_BLOCK A\nVAR a : INT; END_VAR\na := 1;\nMETHOD m : INT\nm := 2;\n"
                 "METHOD n\na := 3;\n"),
            "(FUNCTION_BLOCK A\n  (VAR a INT)\n  (:= a 1)\n  (METHOD m : INT\n  (:= m 2))\n  "
            "(METHOD n\n  (:= a 3)))\n");
  EXPECT_EQ(tree("INTERFACE I\nMETHOD m : INT\n"), "(INTERFACE I\n  (METHOD m : INT))\n");
  EXPECT_EQ(errors("FUNCTION_BLOCK A\nMETHOD m : INT\nMETHOD n\nEND_METHOD\nEND_FUNCTION_BLOCK"),
            "SE0203 2:1 missing `END_METHOD`\n");
  EXPECT_EQ(errors("FUNCTION_BLOCK A\nMETHOD m : INT\nEND_FUNCTION_BLOCK"),
            "SE0203 2:1 missing `END_METHOD`\n");
}

TEST(Language, InstanceArguments) {
  EXPECT_EQ(tree("PROGRAM P VAR x : FB(a := 1, b := 2); y : L.FB(3, c) := (out := 3); z : FB(); "
                 "w : ARRAY[1..2] OF FB[(a := 1), (2, b := 3)]; e : INT (a, b := 5); f : INT(1..5);"
                 " END_VAR END_PROGRAM"),
            "(PROGRAM P\n  (VAR x FB( a:=1 b:=2))\n  (VAR y L.FB( 3 c) := (struct out:=3))\n  (VAR "
            "z FB())\n  (VAR w (array 1..2 FB[ a:=1][ 2 b:=3]))\n  (VAR e (enum of INT a b:=5))\n  "
            "(VAR f (range INT 1 5)))\n");
  EXPECT_EQ(errors("VAR_GLOBAL a : FB(1, 2..3); b : ARRAY[1..2] OF FB[1]; END_VAR"),
            "SE0201 1:22 a range cannot be an argument\n"
            "SE0201 1:51 expected the arguments of one element, in parentheses\n");
}

TEST(Language, TypesAsArguments) {
  EXPECT_EQ(printBody("p := __NEW(BYTE, 100); n := SIZEOF(STRING(20)) + XSIZEOF(ARRAY[1..2] OF "
                      "INT); q := __NEW(POINTER TO INT); THIS^.m(SUPER^.n); SUPER^();"),
            "(:= p (call __NEW BYTE 100))\n(:= n (+ (call SIZEOF (type STRING(20))) (call XSIZEOF "
            "(type (array 1..2 INT)))))\n(:= q (call __NEW (type (pointer INT))))\n(call (. (^ "
            "THIS) m) (. (^ SUPER) n))\n(call (^ SUPER))");
}

TEST(Language, TypeBlocks) {
  EXPECT_EQ(tree("TYPE U : UNION a : INT; b : WORD; END_UNION; S : STRUCT EXTENDS L.B x : REF_TO "
                 "INT; END_STRUCT T EXTENDS B : STRUCT END_STRUCT END_TYPE"),
            "(STRUCT U UNION\n  (VAR a INT)\n  (VAR b WORD))\n(STRUCT S EXTENDS L.B\n  (VAR x "
            "(ref-to INT)))\n(STRUCT T EXTENDS B)\n");
  EXPECT_EQ(tree("TYPE T : INT (a := 1, b) := a; E : MyInt (x, y); END_TYPE"),
            "(ENUM T (enum of INT a:=1 b) := a)\n(ENUM E (enum of MyInt x y))\n");
}

TEST(Language, Addresses) {
  EXPECT_EQ(printBody("%QX0.1 := %IX0.0 AND %i2; %MD4 := %IL3.5.7; a.%X3 := b.%B1; "
                      "c.d.%w0 := e[1].%D1; f.%L0 := 1; %QB1 := %M*;"),
            "(:= %QX0.1 (AND %IX0.0 %IX2))\n(:= %MD4 %IL3.5.7)\n(:= (. a bit 3) (. b part8 1))\n"
            "(:= (. (. c d) part16 0) (. ([] e 1) part32 1))\n(:= (. f part64 0) 1)\n(:= %QB1 "
            "%MX*)");
  EXPECT_EQ(bodyErrors("\na := %IX; b := %Z3; c := d.%X1.2; e := %IX99999999999;"),
            "SE0115 2:6 malformed direct address\nSE0115 2:16 malformed direct address\n"
            "SE0115 2:28 malformed partial access\n"
            "SE0115 2:40 the number in this address is too large\n");
}

TEST(Language, Configurations) {
  EXPECT_EQ(
      tree("CONFIGURATION C\nVAR_GLOBAL g : INT; END_VAR\nRESOURCE R ON PLC\nVAR_GLOBAL h : INT; "
           "END_VAR\nTASK t (INTERVAL := T#10ms, PRIORITY := 1);\nTASK u(SINGLE := x);\nPROGRAM i "
           "WITH t : L.Main (a := g, b => h);\nPROGRAM RETAIN j : Main;\nPROGRAM with : "
           "Main;\nEND_RESOURCE\nVAR_ACCESS v : R.i.x : INT READ_ONLY; w : R.%IX0.0 : BOOL "
           "READ_WRITE; z : g : INT; END_VAR\nVAR_CONFIG R.i.a[1].x AT %IX0.0 : BOOL := TRUE; "
           "i.y : INT := 5; END_VAR\nEND_CONFIGURATION"),
      "(CONFIGURATION C\n  (RESOURCE R ON PLC\n    (TASK t INTERVAL:=10ms PRIORITY:=1)\n    (TASK "
      "u SINGLE:=x)\n    (PROGRAM i WITH t : L.Main a:=g b=>h)\n    (PROGRAM j RETAIN : Main)\n    "
      "(PROGRAM with : Main)))\n"
      "(VAR_GLOBAL\n  (VAR_GLOBAL g INT))\n(VAR_GLOBAL\n  (VAR_GLOBAL h INT))\n"
      "(VAR_ACCESS\n  (VAR_ACCESS READ_ONLY v@(. (. R i) x) INT)\n  (VAR_ACCESS READ_WRITE "
      "w@%IX0.0 BOOL)\n  (VAR_ACCESS z@g INT))\n"
      "(VAR_CONFIG\n  (VAR_CONFIG @(. ([] (. (. R i) a) 1) x) AT %IX0.0 BOOL := TRUE)\n  "
      "(VAR_CONFIG @(. i y) INT := 5))\n");
  EXPECT_EQ(tree("CONFIGURATION C\nTASK t(PRIORITY := 0);\nPROGRAM i WITH t : P;\n"
                 "END_CONFIGURATION\nPROGRAM task resource := with; END_PROGRAM"),
            "(CONFIGURATION C\n  (RESOURCE \n    (TASK t PRIORITY:=0)\n    (PROGRAM i WITH t : "
            "P)))\n(PROGRAM task\n  (:= resource with))\n");
  EXPECT_EQ(errors("CONFIGURATION C\nRESOURCE r ON PLC\nTASK t(;\nfoo;\nEND_CONFIGURATION"),
            "SE0203 2:1 missing `END_RESOURCE`\nSE0202 3:8 expected `)`\nSE0201 4:1 expected "
            "RESOURCE, TASK, PROGRAM, VAR_… or "
            "`END_RESOURCE`, found `foo`\n");
}

TEST(Language, Namespaces) {
  EXPECT_EQ(
      tree("USING A;\nNAMESPACE B\nUSING C.D, E;\nNAMESPACE INTERNAL F.G\nFUNCTION h : INT "
           "USING I; END_FUNCTION\nEND_NAMESPACE\nTYPE t : INT; END_TYPE\nEND_NAMESPACE\n"
           "FUNCTION_BLOCK k USING X; USING Y; EXTENDS Z END_FUNCTION_BLOCK"),
      "(FUNCTION B.F.G/h USING A USING C.D USING E USING I : INT)\n(ALIAS B/t USING A USING C.D "
      "USING E INT)\n(FUNCTION_BLOCK k USING A USING X USING Y EXTENDS Z)\n");
  EXPECT_EQ(errors("NAMESPACE A\nPROGRAM P\nEND_NAMESPACE\nEND_NAMESPACE\nNAMESPACE B"),
            "SE0203 2:1 missing `END_PROGRAM`\nSE0211 4:1 `END_NAMESPACE` closes nothing\n"
            "SE0203 5:1 missing `END_NAMESPACE`\n");
}

TEST(Language, Jumps) {
  EXPECT_EQ(printBody("lab: a := 1; IF b THEN JMP lab; END_IF CASE c OF 1: JMP d; e: f := 1; "
                      "END_CASE d: ; JMP step; step: method: g();"),
            "(label lab)\n(:= a 1)\n(if b { (jmp lab) })\n(case c 1 { (jmp d) } e { (:= f 1) })\n"
            "(label d)\n(;)\n(jmp step)\n(label step)\n(label method)\n(call g)");
  EXPECT_EQ(printBody("CASE c OF 1: IF a THEN again: b := 1; JMP again; END_IF END_CASE"),
            "(case c 1 { (if a { (label again) (:= b 1) (jmp again) }) })");
}

TEST(Language, Exceptions) {
  EXPECT_EQ(
      printBody("__TRY a := 1; __CATCH(exc) b := 2; __FINALLY c := 3; __ENDTRY __try d(); "
                "__CATCH e(); __ENDTRY __TRY __FINALLY __ENDTRY;"),
      "(try { (:= a 1) } catch exc{ (:= b 2) } finally { (:= c 3) })\n(try { (call d) } catch "
      "{ (call e) })\n(try { } finally { })");
  EXPECT_EQ(bodyErrors("\n__TRY a := 1;\n__CATCH(x) b := 2; c := 3;"),
            "SE0203 2:1 missing `__ENDTRY`\n");
  EXPECT_EQ(bodyErrors("\na := 1; __CATCH(x) b := 2; __ENDTRY c := 3"),
            "SE0201 2:9 `__CATCH` without a block that it belongs to\n"
            "SE0211 2:28 `__ENDTRY` closes nothing\n"
            "SE0202 2:43 expected `;` after the assignment\n");
  EXPECT_EQ(bodyErrors("\n__TRY IF a THEN b := 1; __CATCH(e) __ENDTRY"),
            "SE0203 2:7 missing `END_IF`\n");
}

TEST(Language, SoftKeywordsAreNames) {
  const std::string names =
      "method, property, interface, class, namespace, using, action, actions, get, set, step, "
      "union, transition, initial_step, jmp, override, abstract, final, public, private, "
      "protected, internal, extends, implements, this, super, task, resource, with, on, read_only, "
      "read_write, ref_to, configuration, constant, retain";
  EXPECT_EQ(errors("PROGRAM P VAR " + names +
                   " : INT; END_VAR\nVAR PUBLIC public : INT; END_VAR\n" +
                   "method := property + interface; class(namespace, using := action);\n"
                   "IF get AND set OR step THEN union := jmp; END_IF\nCASE override OF 1: final := "
                   "1; internal: ; END_CASE\nFOR task := resource TO with BY on DO extends := "
                   "implements; END_FOR\nconfiguration := -ref_to; abstract S= private;\n"
                   "method(a := final); action.x := step.y; retain[class] := constant^;\n"
                   "END_PROGRAM"),
            "");
  EXPECT_EQ(
      errors("FUNCTION_BLOCK Step EXTENDS Action IMPLEMENTS Method, Class\nEND_FUNCTION_BLOCK"
             "\nFUNCTION Get : Set END_FUNCTION\nTYPE Union : STRUCT method : INT; get : INT; "
             "END_STRUCT END_TYPE\nPROGRAM Method END_PROGRAM"),
      "");
}

TEST(Language, MisplacedMembers) {
  EXPECT_EQ(errors("METHOD m : INT END_METHOD\nFUNCTION f : INT\nMETHOD n END_METHOD\nf := "
                   "1;\nEND_FUNCTION\nMETHOD X.o END_METHOD\nINTERFACE i\nACTION a END_ACTION\n"
                   "METHOD p q := 1; END_METHOD\nr := 1;\nEND_INTERFACE\nCLASS c\ns := 1;\n"
                   "END_CLASS"),
            "SE0221 1:1 this METHOD belongs to no block\n"
            "SE0221 3:1 a FUNCTION cannot have a METHOD\n"
            "SE0221 8:1 an INTERFACE cannot have an ACTION\n"
            "SE0220 9:10 a method of an INTERFACE has no statements\n"
            "SE0220 10:1 an INTERFACE has no statements\n"
            "SE0220 13:1 a CLASS has no statements\n");
  EXPECT_EQ(
      errors("FUNCTION_BLOCK b\nPROPERTY p\nGET END_GET\nGET END_GET\nEND_PROPERTY\nPROPERTY q "
             ": INT\nEND_PROPERTY\nPROPERTY r : INT\nr := 1;\nEND_PROPERTY\nEND_FUNCTION_BLOCK"),
      "SE0202 2:11 expected `:` and the type of the property\n"
      "SE0222 4:1 the property has a second GET\n"
      "SE0222 6:10 the property `q` has neither GET nor SET\n"
      "SE0222 9:1 statements and variables of a property stand in GET or SET\n");
  EXPECT_EQ(errors("PROGRAM p EXTENDS q END_PROGRAM FUNCTION_BLOCK a EXTENDS b, c "
                   "END_FUNCTION_BLOCK INTERFACE i IMPLEMENTS j END_INTERFACE PROGRAM a.b "
                   "END_PROGRAM METHOD PUBLIC PRIVATE m END_METHOD"),
            "SE0201 1:11 only blocks, classes, interfaces and structures can extend another one\n"
            "SE0201 1:61 a FUNCTION_BLOCK extends one other only\n"
            "SE0201 1:94 only blocks and classes can implement an interface\n"
            "SE0201 1:129 the name of a PROGRAM has no point\n"
            "SE0201 1:159 there is a second access specifier here\n");
}

} // namespace
} // namespace stc::test
