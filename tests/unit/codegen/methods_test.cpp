// Methods across libraries, and what the description says about instances and interfaces.

#include "program.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace stc::test {
namespace {

const std::vector<Source> kJobs = {
    {"IJob.st", "INTERFACE IJob METHOD Work : INT END_METHOD\n"
                "PROPERTY Factor : INT GET END_GET END_PROPERTY END_INTERFACE"},
    {"JobBase.st", "FUNCTION_BLOCK JobBase\n"
                   "VAR_OUTPUT runs : INT; END_VAR\n"
                   "METHOD Step : INT\nStep := 1;\nEND_METHOD\n"
                   "METHOD Twice : INT\nTwice := Step() * 2;\nEND_METHOD\n"
                   "runs := runs + 1;\nEND_FUNCTION_BLOCK"},
    {"LibJob.st", "FUNCTION_BLOCK LibJob EXTENDS JobBase IMPLEMENTS IJob\n"
                  "METHOD Step : INT\nStep := 5;\nEND_METHOD\n"
                  "METHOD Work : INT\nWork := 50;\nEND_METHOD\n"
                  "PROPERTY Factor : INT GET\nFactor := 2;\nEND_GET END_PROPERTY\n"
                  "END_FUNCTION_BLOCK"},
    {"RunJob.st", "FUNCTION RunJob : INT VAR_IN_OUT job : JobBase; END_VAR\n"
                  "job();\nRunJob := job.Step() * 100 + job.Twice();\nEND_FUNCTION"},
    {"RunOwn.st", "FUNCTION RunOwn : INT\nVAR own : LibJob; END_VAR\nRunOwn := RunJob(own);\n"
                  "END_FUNCTION"},
    {"RunInterface.st", "FUNCTION RunInterface : INT VAR_INPUT job : IJob; END_VAR\n"
                        "RunInterface := job.Work() * job.Factor;\nEND_FUNCTION"},
};

TEST(Methods, LibraryCallsMethodsOfTheProject) {
  const Options options{.checks = true, .library = kJobs};
  App app("FUNCTION_BLOCK Mine EXTENDS JobBase IMPLEMENTS IJob\n"
          "VAR_OUTPUT own : INT; END_VAR\n"
          "METHOD Step : INT\nStep := SUPER^.Step() + 6;\nEND_METHOD\n"
          "METHOD Work : INT\nWork := own;\nEND_METHOD\n"
          "PROPERTY Factor : INT GET\nFactor := 3;\nEND_GET END_PROPERTY\n"
          "own := own + 10;\n"
          "END_FUNCTION_BLOCK\n"
          "FUNCTION_BLOCK Plain EXTENDS LibJob\nEND_FUNCTION_BLOCK\n"
          "PROGRAM Main\n"
          "VAR m : Mine; p : Plain; b : JobBase; a, c, d, e, f, g, h : INT; END_VAR\n"
          "a := RunJob(m);\nc := RunJob(b);\nd := RunJob(p);\n"
          "e := RunInterface(m);\nf := RunInterface(p);\ng := m.own;\nh := RunOwn();\n"
          "END_PROGRAM\n",
          options);
  app.run();
  EXPECT_EQ(app.exception(), "");
  EXPECT_EQ(app["Main.a"], "714");
  EXPECT_EQ(app["Main.c"], "102");
  EXPECT_EQ(app["Main.d"], "510");
  EXPECT_EQ(app["Main.e"], "30");
  EXPECT_EQ(app["Main.f"], "100");
  EXPECT_EQ(app["Main.g"], "10");
  EXPECT_EQ(app["Main.h"], "510");
}

TEST(Methods, LibraryWithoutOverridesLinks) {
  const Options options{.checks = true, .library = kJobs};
  App app("PROGRAM Main\nVAR h : INT; END_VAR\nh := RunOwn();\nEND_PROGRAM\n", options);
  app.run();
  EXPECT_EQ(app["Main.h"], "510");
}

TEST(Methods, ExitAndReinitWalkEverything) {
  App app("FUNCTION_BLOCK Base\n"
          "METHOD FB_Exit : BOOL VAR_INPUT bInCopyCode : BOOL; END_VAR\n"
          "n := n * 10 + 1;\nIF bInCopyCode THEN copies := copies + 1; END_IF\nEND_METHOD\n"
          "METHOD FB_Reinit : BOOL\nr := r + 1;\nEND_METHOD\n"
          "END_FUNCTION_BLOCK\n"
          "FUNCTION_BLOCK Derived EXTENDS Base\n"
          "METHOD FB_Exit : BOOL VAR_INPUT bInCopyCode : BOOL; END_VAR\n"
          "n := n * 10 + 2;\nEND_METHOD\n"
          "METHOD FB_Reinit : BOOL\nr := r + 100;\nSUPER^.FB_Reinit();\nEND_METHOD\n"
          "END_FUNCTION_BLOCK\n"
          "TYPE Box : STRUCT d : Derived; END_STRUCT END_TYPE\n"
          "VAR_GLOBAL n, copies, r : DINT; END_VAR\n"
          "PROGRAM Main\nVAR list : ARRAY [1..2] OF Base; box : Box; END_VAR\n"
          "list[1]();\nEND_PROGRAM\n");
  app.run();
  app.exit(true);
  EXPECT_EQ(app["n"], "1121");
  EXPECT_EQ(app["copies"], "3");
  app.reinit();
  EXPECT_EQ(app["r"], "103");
}

TEST(Methods, InterfaceSlotPointsToTheTypeId) {
  App app("INTERFACE IThing METHOD Run : INT END_METHOD END_INTERFACE\n"
          "FUNCTION_BLOCK Plain\nVAR x : LINT; END_VAR\nEND_FUNCTION_BLOCK\n"
          "FUNCTION_BLOCK Thing EXTENDS Plain IMPLEMENTS IThing\nVAR y : INT; END_VAR\n"
          "METHOD Run : INT\nRun := 3;\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
          "PROGRAM Main\nVAR t : Thing; i : IThing; n : INT; END_VAR\n"
          "i := t;\nn := i.Run();\nEND_PROGRAM\n");
  app.run();
  EXPECT_EQ(app["Main.n"], "3");
  const stride::TypeDesc *type = nullptr;
  const void *slot = app.at("Main.i", &type);
  ASSERT_NE(slot, nullptr);
  EXPECT_EQ(type->kind, stride::Kind::Interface);
  EXPECT_EQ(type->size, 8U);
  EXPECT_NE(type->flags & stride::kTypeHasAddress, 0U);
  void *target = nullptr;
  std::memcpy(&target, slot, sizeof target);
  EXPECT_EQ(target, app.at("Main.t.type__"));
}

TEST(Methods, OnlyHierarchiesHaveTypeIds) {
  const std::vector<GeneratedFile> files = generate(
      {{"Main.st", "FUNCTION_BLOCK Alone\nMETHOD Run\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
                   "FUNCTION_BLOCK Base\nMETHOD Run\nEND_METHOD\nMETHOD Stop\nEND_METHOD\n"
                   "END_FUNCTION_BLOCK\n"
                   "FUNCTION_BLOCK Derived EXTENDS Base\nMETHOD Run\nEND_METHOD\n"
                   "END_FUNCTION_BLOCK\n"
                   "PROGRAM Main\nVAR a : Alone; d : Derived; p : POINTER TO Base; END_VAR\n"
                   "a.Run();\nd.Run();\np := ADR(d);\np^.Run();\np^.Stop();\n"
                   "END_PROGRAM\n"}});
  EXPECT_EQ(fileText(files, "st/user/Alone.h").find("type__"), std::string::npos);
  EXPECT_NE(fileText(files, "st/user/Base.h").find("type__"), std::string::npos);
  const std::string body = fileText(files, "user/Main.cpp");
  EXPECT_NE(body.find("a.Run(ctx__)"), std::string::npos) << body;
  EXPECT_NE(body.find("d.Run(ctx__)"), std::string::npos) << body;
  EXPECT_NE(body.find(".Run__call(ctx__)"), std::string::npos) << body;
  EXPECT_NE(body.find(".Stop(ctx__)"), std::string::npos) << body; // replaced nowhere
}

} // namespace
} // namespace stc::test
