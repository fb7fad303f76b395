// The sizes and offsets that the checker computes are those of the C++ compiler.

#include "program.hpp"

#include "compiler/semantics/storage.hpp"
#include "compiler/syntax/parser.hpp"
#include "tests/support/no_library.hpp"

#include <gtest/gtest.h>
#include <random>

namespace stc::test {

namespace {

/// Random structures and blocks that hold each other, and a program with one of each.
class RandomTypes {
public:
  explicit RandomTypes(unsigned seed) : random_(seed) {}

  std::string source() {
    std::string text = "TYPE E1 : (a1, b1) BYTE; END_TYPE\nTYPE E4 : (a4, b4) DINT; END_TYPE\n";
    for (unsigned i = 0; i < kTypes; ++i) {
      const std::string name = "T" + std::to_string(i);
      const bool block = i % 3 == 2;
      const bool extends = !block && i > 3 && pick(4) == 0;
      // Structures have numbers that leave a rest of 0 or 1.
      const unsigned base = i < 3 ? 0 : pick(i / 3) * 3;
      text += block     ? "FUNCTION_BLOCK " + name + "\nVAR\n"
              : extends ? "TYPE " + name + " EXTENDS T" + std::to_string(base) + " : STRUCT\n"
                        : "TYPE " + name + " : STRUCT\n";
      for (unsigned f = 0, n = 1 + pick(6); f < n; ++f)
        text += "  " + name + "f" + std::to_string(f) + " : " + type(i, 0) + ";\n";
      text += block ? "END_VAR\nVAR_IN_OUT io : INT; END_VAR\nVAR_TEMP t : LREAL; END_VAR\n"
                      "VAR_OUTPUT o : BOOL; END_VAR\nEND_FUNCTION_BLOCK\n"
                    : "END_STRUCT END_TYPE\n";
    }
    text += "PROGRAM Main\nVAR CONSTANT\n";
    for (unsigned i = 0; i < kTypes; ++i)
      text += "  s" + std::to_string(i) + " : DINT := SIZEOF(T" + std::to_string(i) + ");\n";
    text += "END_VAR\nVAR\n";
    for (unsigned i = 0; i < kTypes; ++i)
      text += "  v" + std::to_string(i) + " : T" + std::to_string(i) + ";\n";
    return text + "END_VAR\nEND_PROGRAM\n";
  }

  static constexpr unsigned kTypes = 18;

private:
  unsigned pick(unsigned n) { return static_cast<unsigned>(random_() % n); }

  std::string type(unsigned below, unsigned depth) {
    static constexpr const char *kElementary[] = {"BOOL",
                                                  "SINT",
                                                  "INT",
                                                  "DINT",
                                                  "LINT",
                                                  "BYTE",
                                                  "WORD",
                                                  "LWORD",
                                                  "REAL",
                                                  "LREAL",
                                                  "TIME",
                                                  "LTIME",
                                                  "DATE",
                                                  "TOD",
                                                  "LDT",
                                                  "STRING(5)",
                                                  "WSTRING(3)",
                                                  "STRING",
                                                  "E1",
                                                  "E4",
                                                  "INT (1..5)",
                                                  "POINTER TO LREAL",
                                                  "REFERENCE TO BYTE"};
    const unsigned what = pick(10);
    if (what < 2 && depth < 2)
      return "ARRAY [" + std::to_string(pick(3)) + ".." + std::to_string(3 + pick(3)) + "] OF " +
             type(below, depth + 1);
    if (what < 5 && below > 0)
      return "T" + std::to_string(pick(below));
    return kElementary[pick(std::size(kElementary))];
  }

  std::mt19937 random_;
};

} // namespace

TEST(CodegenLayout, AgreesWithTheCppCompiler) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const std::string source = RandomTypes(seed).source();
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + source);
    Program program;
    const FileId id = program.sources.add("Main.st", source);
    const std::vector<ast::File *> files = {
        parse(program.sources.file(id), program.interner, program.arena, program.diagnostics)};
    check(program, files, NoLibrary());
    ASSERT_FALSE(program.diagnostics.hasErrors());
    const App app(source); // its static_asserts compare the sizes
    Storage storage;
    for (const VarSymbol *v : program.user->pous.back()->variables) {
      if (v->isConstant)
        continue;
      const std::string place = "Main." + std::string(v->name.text);
      const stride::TypeDesc *type = nullptr;
      ASSERT_NE(app.at(place, &type), nullptr);
      EXPECT_EQ(storage.of(v->type).size, type->size) << place;
      EXPECT_EQ(storage.of(v->type).align, type->align) << place;
      EXPECT_EQ(app["Main.s" + place.substr(6)], std::to_string(type->size));
      const auto fields = [&]() -> std::vector<const VarSymbol *> {
        if (v->type->kind == TypeKind::Structure) {
          const auto list = typeAs<StructType>(v->type)->fields;
          return {list.begin(), list.end()};
        }
        const auto list = typeAs<PouType>(v->type)->symbol->variables;
        return {list.begin(), list.end()};
      }();
      for (const VarSymbol *f : fields) {
        for (uint32_t m = 0; m < type->memberCount; ++m) {
          const stride::MemberDesc &member = app.description().members[type->firstMember + m];
          if (member.name == f->name.text) {
            EXPECT_EQ(storage.offset(v->type, f), member.offset) << place << '.' << member.name;
          }
        }
      }
    }
  }
}

} // namespace stc::test
