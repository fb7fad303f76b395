// Any bytes as an ST file: what the checker accepts must become C++ without a crash, and twice the
// same. With STRIDE_FUZZ_CXX=<command> in the environment (for a corpus, not for fuzzing) the
// command is called for the folder that holds the C++, and must succeed.
#include "compiler/codegen/codegen.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/syntax/parser.hpp"
#include "tests/support/no_library.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

std::vector<stc::GeneratedFile> generate(const std::string &bytes) {
  stc::Program program;
  const stc::FileId id = program.sources.addBytes("fuzz.st", bytes);
  stc::ast::File *file =
      stc::parse(program.sources.file(id), program.interner, program.arena, program.diagnostics);
  if (program.diagnostics.hasErrors())
    return {};
  stc::check(program, {file}, stc::test::NoLibrary());
  if (program.diagnostics.hasErrors())
    return {};
  stc::AppConfig config;
  config.name = "fuzz";
  stc::AppConfig::Task task;
  task.name = "Task";
  task.intervalNs = 10'000'000;
  for (stc::PouSymbol *p : program.user->pous) {
    if (p->decl->kind == stc::ast::DeclKind::Program)
      task.programs.push_back(p);
  }
  config.tasks.push_back(task);
  return stc::generateApplication(program, config);
}

void compile(const std::vector<stc::GeneratedFile> &files, const std::string &command) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "stride-codegen-fuzz";
  fs::remove_all(folder);
  for (const stc::GeneratedFile &file : files) {
    fs::create_directories((folder / file.path).parent_path());
    std::ofstream(folder / file.path, std::ios::binary) << file.text;
  }
  if (std::system((command + " " + folder.string()).c_str()) != 0)
    std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string bytes(reinterpret_cast<const char *>(data), size);
  const std::vector<stc::GeneratedFile> files = generate(bytes);
  if (files.empty())
    return 0;
  const std::vector<stc::GeneratedFile> again = generate(bytes);
  if (files.size() != again.size())
    std::abort();
  for (size_t i = 0; i < files.size(); ++i) {
    if (files[i].path != again[i].path || files[i].text != again[i].text)
      std::abort();
  }
  if (const char *command = std::getenv("STRIDE_FUZZ_CXX"))
    compile(files, command);
  return 0;
}
