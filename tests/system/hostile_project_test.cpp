// Projects that somebody gave away to do harm, and folders that others may write: docs/security.md.
#include "tests/system/hostile_project.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// -------------------------------------------------------------------------------------------------
// links

TEST_F(HostileProject, ABuildFolderThatIsALinkIsNotWritten) {
  link("../home", "p/build");
  refuse({"build", "p"}, "SE0838");
  refuse({"build", "p", "--emit", "cpp"}, "SE0838");
  if (kStatic)
    refuse({"build", "p", "--static"}, "SE0838");
  expectHomeUntouched();
  // What only runs writes nothing there.
  EXPECT_EQ(stride({"sim", "p", "--for", "T#30ms", "--print", "PLC_PRG.n"}).out, "PLC_PRG.n = 3\n");
  expectHomeUntouched();
}

TEST_F(HostileProject, LinksInTheBuildFolderAreReplacedNotFollowed) {
  link("../../home/photo.cpp", "p/build/app.so");
  link("../../home/photo.cpp", "p/build/app");
  link("../../home/photo.cpp", "p/build/.gitignore");
  link("../../home", "p/build/cache"); // what earlier versions of Stride pruned
  succeed({"build", "p"});
  if (kStatic)
    succeed({"build", "p", "--static"});
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(at("p/build/app.so"))));
  EXPECT_EQ(read("p/build/.gitignore"), "*\n");
  expectHomeUntouched();
}

TEST_F(HostileProject, EmittedSourcesFollowNoLinks) {
  link("../../home", "p/build/cpp");
  refuse({"build", "p", "--emit", "cpp"}, "SE0838");
  fs::remove(at("p/build/cpp"));
  link("../../../home", "p/build/cpp/user");
  refuse({"build", "p", "--emit", "cpp"}, "SE0838");
  fs::remove(at("p/build/cpp/user"));
  link("../../../home/photo.cpp", "p/build/cpp/app.cpp");
  succeed({"build", "p", "--emit", "cpp"});
  EXPECT_THAT(read("p/build/cpp/app.cpp"), HasSubstr("PLC_PRG"));
  expectHomeUntouched();
}

TEST_F(HostileProject, OnlyEmittedSourcesAreRemovedFromTheirFolder) {
  write("p/b.st", "FUNCTION Gone : INT\nGone := 1;\nEND_FUNCTION\n");
  succeed({"build", "p", "--emit", "cpp"});
  ASSERT_TRUE(fs::exists(at("p/build/cpp/user/Gone.cpp")));
  fs::remove(at("p/b.st"));
  write("p/build/cpp/mine.cpp", "// the user's\n");
  // A list that names what Stride has never written there.
  const std::string list = read("p/build/cpp/.stride-sources");
  writeFile(at("p/build/cpp/.stride-sources"), list + "../../../home/photo.cpp\n" +
                                                   at("home/photo.cpp").string() +
                                                   "\nlinked/photo.cpp\n../../a.st\n\n/\n..\n");
  link("../../../home", "p/build/cpp/linked");
  succeed({"build", "p", "--emit", "cpp"});
  EXPECT_FALSE(fs::exists(at("p/build/cpp/user/Gone.cpp")));
  EXPECT_TRUE(fs::exists(at("p/build/cpp/mine.cpp")));
  EXPECT_EQ(read("p/a.st"), kCounter);
  expectHomeUntouched();
}

TEST_F(HostileProject, TheFormatterWritesThroughNoLinkThatLeadsOut) {
  const std::string ugly = "program   F\nvar x:int; end_var\nx:=1;\nend_program\n";
  write("other/b.st", ugly);
  write("p/real/c.st", "function   G:int\nG:=1;\nend_function\n");
  link("../other/b.st", "p/b.st");
  link("real/c.st", "p/c_link.st");
  refuse({"fmt", "p"}, "SE0838");
  EXPECT_EQ(read("other/b.st"), ugly);
  fs::remove(at("p/b.st")); // the same of a folder, whose files are sources of the project
  link("../other", "p/linked");
  refuse({"fmt", "p"}, "SE0838");
  EXPECT_EQ(read("other/b.st"), ugly);
  EXPECT_THAT(stride({"check", "p"}).err, HasSubstr("its 3 source files"));
  fs::remove(at("p/linked"));
  link("../other/b.st", "p/b.st");
  EXPECT_THAT(read("p/real/c.st"), HasSubstr("FUNCTION G : INT"));
  EXPECT_TRUE(fs::is_symlink(at("p/c_link.st")));
  succeed({"fmt", "p/b.st"}); // the user's own word
  EXPECT_THAT(read("other/b.st"), HasSubstr("PROGRAM F"));
}

TEST_F(HostileProject, DocumentationFollowsNoLinksUnlessTheUserNamesThem) {
  link("home", "doc");
  EXPECT_THAT(stride({"doc", "p"}).err, HasSubstr("error[SE0838]: `doc/"));
  expectHomeUntouched();
  fs::create_directory(at("pages"));
  link("pages", "named");
  succeed({"doc", "p", "-o", "named"});
  EXPECT_TRUE(fs::exists(at("pages/index.html")));
}

TEST_F(HostileProject, RetainedDataAndFilesStayInTheProject) {
  write("q/a.st", "PROGRAM PLC_PRG\nVAR RETAIN\n  n : INT;\nEND_VAR\nVAR\n  h : DWORD;\nEND_VAR\n"
                  "n := n + 1;\nh := SysFileOpen('x.txt', 'w');\nEND_PROGRAM\n");
  const std::vector<std::string> run = {"run", "q", "--for", "100ms", "--quiet"};
  link("../home", "q/retain");
  refuse(run, "SE0838");
  fs::remove(at("q/retain"));
  link("../home", "q/files");
  refuse(run, "SE0838");
  refuse({"sim", "q", "--for", "T#100ms"}, "SE0838");
  fs::remove(at("q/files"));
  link("../home/new", "q/files"); // to what is not there yet
  refuse(run, "SE0838");
  fs::remove(at("q/files"));
  link("../../home/made", "q/files/x.txt");
  succeed(run);
  EXPECT_TRUE(fs::is_symlink(at("q/files/x.txt"))); // OUTSIDE: it was not made
  expectHomeUntouched();
  fs::remove_all(at("q/files"));
  fs::remove_all(at("q/retain"));
  // The image that is being written, and a file of the program's.
  for (const char *name : {"q/retain/q.new", "q/files/x.txt"})
    link("../../home/photo.cpp", name);
  succeed(run);
  EXPECT_TRUE(fs::exists(at("q/retain/q.a")));
  EXPECT_TRUE(fs::is_symlink(at("q/files/x.txt"))); // OUTSIDE: it was not opened
  expectHomeUntouched();
}

TEST_F(HostileProject, AResetFollowsNoLinkAndRemovesNothingButImages) {
  write("home/p.a", kPhoto);
  write("home/p.new", kPhoto);
  link("../home", "p/retain");
  for (const char *kind : {"warm", "cold", "origin"})
    refuse({"reset", kind, "p"}, "SE0838");
  // stride.toml may name any place, but what lies there is not Stride's.
  fs::remove(at("p/retain"));
  write("p/stride.toml", "[retain]\nfile = \"../home/p\"\n");
  EXPECT_THAT(stride({"reset", "origin", "p"}).err,
              HasSubstr("home/p.a' does not begin as retained data do, so nothing is removed"));
  EXPECT_EQ(read("home/p.a"), kPhoto);
  EXPECT_EQ(read("home/p.new"), kPhoto);
  // A part of an image, and what a loss of power has left of one, do not hinder.
  write("home/p.a", "STRDR");
  write("home/p.b", std::string(4096, '\0'));
  write("home/p.new", "");
  succeed({"reset", "origin", "p"});
  EXPECT_FALSE(fs::exists(at("home/p.a")) || fs::exists(at("home/p.b")) ||
               fs::exists(at("home/p.new")));
}

TEST_F(HostileProject, AManifestThatLeadsNowhereIsMissed) {
  for (const char *target : {"stride.toml", "nowhere"}) {
    link(target, "p/stride.toml");
    refuse({"check", "p"}, "SE0101");
    fs::remove(at("p/stride.toml"));
  }
}

TEST_F(HostileProject, WhatLiesWhereResultsAreWrittenIsNotRead) {
  fs::create_directories(at("p/build/cpp"));
  for (const char *name : {"p/build/.gitignore", "p/build/cpp/.stride-sources"}) {
    write(name, "x\n");
    fs::resize_file(at(name), uintmax_t{64} << 30); // no such memory
  }
  succeed({"build", "p"});
  succeed({"build", "p", "--emit", "cpp"});
}

// -------------------------------------------------------------------------------------------------
// the terminal

TEST_F(HostileProject, NothingOfAProjectCommandsTheTerminal) {
  // The window's title, the screen, a line of its own, an eight-bit sequence.
  const std::string evil = "\x1b]0;owned\x07\x1b[2J\r\x7f\xc2\x9b";
  write("q/" + evil + ".st", "PROGRAM P\nVAR x : INT; END_VAR\n{warning 'w" + evil +
                                 "'}\n{text 't" + evil + "'}\nx := y;\nEND_PROGRAM\n");
  write("q/stride.toml", "[project]\nname = \"a\\u001b]0;owned\\u0007\"\n");
  write("q/c.cam.toml", "[cam]\nname = \"\\u001b[2J\"\n");
  write("r/a.st",
        "PROGRAM PLC_PRG\nVAR s : STRING; END_VAR\ns := '$1B]0;owned$07$9B';\nEND_PROGRAM\n");
  const Environment cache = {{"XDG_CACHE_HOME", at("cache").string()}, {"TERM", "xterm"}};
  for (const std::vector<std::string> &arguments : std::vector<std::vector<std::string>>{
           {"check", "q"},
           {"check", "q/" + evil + ".st"},
           {"fmt", "--diff", "q"},
           {"fmt", "--check", "q"},
           {"sim", "r", "--for", "T#30ms", "--quiet", "--trace", "PLC_PRG.s", "--print",
            "PLC_PRG.s"},
           {"sim", "r", "--for", "T#30ms", "--quiet", "--trace", evil}}) {
    std::vector<std::string> command = {STRIDE_BINARY_DIR "/stride"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    std::string shown = runOnTerminal(command, scratch_.path(), cache).out;
    // Stride's own: a line that changes.
    for (const char *own : {"\r\x1b[K", "\r\n"})
      for (size_t i = 0; (i = shown.find(own, i)) != std::string::npos;)
        shown.erase(i, std::string_view(own).size());
    EXPECT_FALSE(shown.empty()) << arguments[0];
    EXPECT_EQ(shown.find_first_of("\x1b\x07\r\x7f"), std::string::npos)
        << arguments[0] << ' ' << ::testing::PrintToString(shown);
    EXPECT_EQ(shown.find("\xc2\x9b"), std::string::npos) << arguments[0];
  }
  // A file gets the values as they are.
  succeed({"sim", "r", "--for", "T#30ms", "--trace", "PLC_PRG.s", "--out", "t.csv"});
  EXPECT_THAT(read("t.csv"), HasSubstr("\x1b]0;owned\x07"));
}

// -------------------------------------------------------------------------------------------------
// names

TEST_F(HostileProject, TheProjectsNameIsNoPath) {
  for (const char *name : {"../../x", "/x", "x/y", ".", "..", ".x", "a\\nb"}) {
    write("p/stride.toml", "[project]\nname = \"" + std::string(name) + "\"\n");
    refuse({"check", "p"}, "SE0817");
  }
  for (const size_t length : {199U, 200U, 201U}) {
    write("p/stride.toml", "[project]\nname = \"" + std::string(length, 'n') + "\"\n");
    EXPECT_EQ(stride({"check", "p"}).exitCode, length <= 200 ? 0 : 1) << length;
  }
}

TEST_F(HostileProject, FoldersMayHaveTheNamesOfOptions) {
  for (const char *name : {"@p", "-p", "-o", "--help", "a b;c", "$(touch x)"}) {
    write(std::string(name) + "/a.st", kCounter);
    const ProcessResult result =
        stride({"sim", "./" + std::string(name), "--for", "T#30ms", "--print", "PLC_PRG.n"});
    EXPECT_EQ(result.out, "PLC_PRG.n = 3\n") << name << result.err;
    succeed({"build", "./" + std::string(name)});
    succeed({"build", "./" + std::string(name), "--emit", "cpp"});
  }
  // As the folder itself is named on the command line, and as the current one.
  EXPECT_EQ(stride({"sim", "@p", "--for", "T#30ms", "--print", "PLC_PRG.n"}).out,
            "PLC_PRG.n = 3\n");
  const ProcessResult inside = runProcess({STRIDE_BINARY_DIR "/stride", "build"}, at("-p"),
                                          {{"XDG_CACHE_HOME", at("cache").string()}});
  EXPECT_EQ(inside.exitCode, 0) << inside.err;
  EXPECT_FALSE(fs::exists(at("x")));
}

// -------------------------------------------------------------------------------------------------
// native code

/// A compiler's way to say that the wrong file was read.
constexpr const char *kPoison = "#error this came with the project\n";

TEST_F(HostileProject, NothingThatCameWithTheProjectIsCompiled) {
  succeed({"build", "p", "--emit", "cpp"});
  std::vector<fs::path> generated;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(at("p/build/cpp")))
    if (entry.is_regular_file())
      generated.push_back(entry.path());
  ASSERT_GT(generated.size(), 3U);
  for (const fs::path &path : generated) {
    writeFile(path, kPoison);
    writeFile(path.string() + ".gch", "gpch.013 and what runs when it is read");
  }
  // Folders of Stride's headers and of the system's, as the project might have its own.
  for (const char *name : {"runtime/iec/ops.h", "runtime/iec/types.h", "st/Standard/TON.h",
                           "cstdint", "cstring", "st/user/PLC_PRG.h"})
    for (const char *folder : {"p/", "p/build/", "p/build/cpp/", ""})
      write(folder + std::string(name), kPoison);
  for (const std::string &folder : {std::string("p"), std::string(".")}) {
    const ProcessResult result =
        runProcess({STRIDE_BINARY_DIR "/stride", "sim", folder == "p" ? "p" : "p/a.st", "--for",
                    "T#30ms", "--print", "PLC_PRG.n"},
                   scratch_.path(), {{"XDG_CACHE_HOME", at("cache").string()}});
    EXPECT_EQ(result.out, "PLC_PRG.n = 3\n") << result.err;
  }
  succeed({"build", "p"});
}

TEST_F(HostileProject, NothingThatCameWithTheProjectIsRun) {
  // A shared object that shows itself as soon as it is loaded.
  write("evil.cpp", "#include <cstdio>\nstruct E { E() { std::puts(\"EVIL\"); } } e;\n"
                    "extern \"C\" const void *stride_app_v1() { return nullptr; }\n");
  const ProcessResult compiled =
      runProcess({"g++", "-shared", "-fPIC", "-o", "evil.so", "evil.cpp"}, scratch_.path());
  ASSERT_EQ(compiled.exitCode, 0) << compiled.err;
  write("p/t.st",
        "{test}\nFUNCTION_BLOCK T\nVAR b : BOOL; END_VAR\nb := TRUE;\nEND_FUNCTION_BLOCK\n");
  // Objects and applications under all names that Stride has ever used.
  fs::create_directories(at("p/build/cache"));
  for (const char *name : {"app.so", "tests.so", "cache/app.so", "libc.so.6", "libm.so.6"})
    fs::copy_file(at("evil.so"), at("p/build") / name);
  for (const std::vector<std::string> &arguments : std::vector<std::vector<std::string>>{
           {"sim", "p", "--for", "T#30ms", "--print", "PLC_PRG.n"},
           {"run", "p", "--for", "50ms", "--quiet"},
           {"test", "p"}}) {
    const ProcessResult result = stride(arguments);
    EXPECT_THAT(result.out + result.err, Not(HasSubstr("EVIL"))) << arguments[0];
  }
  succeed({"build", "p"});
  EXPECT_NE(readFile(at("p/build/app.so")), readFile(at("evil.so")));
}

} // namespace
} // namespace stride::test
