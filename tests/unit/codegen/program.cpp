#include "program.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/parser.hpp"
#include "runtime/iec/text.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <unistd.h>

namespace stc::test {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// A library `Lib` of the given files; each is named after what it declares.
class TestLibrary : public LibraryIndex {
public:
  explicit TestLibrary(const std::vector<Source> &files) : files_(files) {}

  std::vector<Entry> find(std::string_view lowerName) const override {
    std::vector<Entry> found;
    for (const Source &f : files_) {
      if (lower(fs::path(f.name).stem().string()) == lowerName)
        found.push_back(entry(f));
    }
    return found;
  }
  bool isLibrary(std::string_view lowerName) const override { return lowerName == "lib"; }
  bool answersTo(std::string_view, std::string_view lowerName) const override {
    return isLibrary(lowerName);
  }
  std::vector<Name> names() const override { return {}; }
  std::vector<Entry> files(std::string_view) const override {
    std::vector<Entry> all;
    for (const Source &f : files_)
      all.push_back(entry(f));
    return all;
  }

private:
  static Entry entry(const Source &f) { return {"Lib", f.name, f.text}; }
  const std::vector<Source> &files_;
};

std::string messages(const Program &program) {
  std::string out;
  for (const Diagnostic &d : program.diagnostics.all()) {
    if (d.severity != Severity::Error)
      continue;
    out += codeName(d.code) + ": " + d.message;
    if (!d.labels.empty() && d.labels[0].span.valid()) {
      const LineColumn at = program.sources.position(d.labels[0].span);
      out += " (" + std::to_string(at.line) + ":" + std::to_string(at.column) + ")";
    }
    out += "\n";
  }
  return out;
}

struct Thrown {
  std::string text;
};

void raise(stride::Ctx *, stride::ExceptionCode code, const char *file, uint32_t line, uint32_t col,
           const char *) {
  static constexpr std::array kNames = {"None",        "DivisionByZero", "IndexOutOfRange",
                                        "NullPointer", "UnboundInOut",   "RangeViolation",
                                        "EndlessLoop"};
  const auto index = static_cast<size_t>(code);
  throw Thrown{std::string(index < kNames.size() ? kNames[index] : "?") + " " + file + ":" +
               std::to_string(line) + ":" + std::to_string(col)};
}

void write(const fs::path &path, const std::string &text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

} // namespace

std::vector<GeneratedFile> generate(const std::vector<Source> &sources, const Options &options) {
  Program program;
  program.settings.checks = options.checks;
  std::vector<ast::File *> files;
  for (const Source &s : sources) {
    const FileId id = program.sources.add(s.name, s.text);
    files.push_back(
        parse(program.sources.file(id), program.interner, program.arena, program.diagnostics));
  }
  const TestLibrary index(options.library);
  check(program, files, index);
  if (program.diagnostics.hasErrors()) {
    ADD_FAILURE() << messages(program);
    return {};
  }
  AppConfig config;
  config.name = "test";
  AppConfig::Task task;
  task.name = "Task";
  task.intervalNs = 10'000'000;
  for (PouSymbol *p : program.user->pous) {
    if (p->decl->kind == ast::DeclKind::Program)
      task.programs.push_back(p);
  }
  config.tasks.push_back(task);
  std::vector<GeneratedFile> out = generateApplication(program, config);
  if (!options.library.empty()) {
    Program library;
    checkLibrary(library, "Lib", index);
    if (library.diagnostics.hasErrors()) {
      ADD_FAILURE() << messages(library);
      return {};
    }
    for (const auto &l : library.libraries) {
      if (l->name != "Lib")
        continue;
      for (GeneratedFile &f : generateLibrary(library, *l))
        out.push_back(std::move(f));
    }
  }
  return out;
}

std::string fileText(const std::vector<GeneratedFile> &files, std::string_view path) {
  for (const GeneratedFile &f : files) {
    if (f.path == path)
      return f.text;
  }
  return {};
}

App::App(std::string_view source, const Options &options)
    : App(std::vector<Source>{{"Main.st", std::string(source)}}, options) {}

App::App(const std::vector<Source> &sources, const Options &options) {
  load(generate(sources, options), options);
}

App::~App() {
  if (handle_ != nullptr)
    dlclose(handle_);
}

void App::load(const std::vector<GeneratedFile> &files, const Options &options) {
  if (files.empty())
    return;
  const fs::path folder =
      fs::temp_directory_path() / ("stride-codegen-" + std::to_string(getpid()) + "-" +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(folder);
  std::string all;
  std::string library; // a source of its own: it has weak functions that the application replaces
  for (const GeneratedFile &f : files) {
    write(folder / f.path, f.text);
    if (f.path.ends_with(".cpp"))
      (f.path.starts_with("Lib/") ? library : all) += "#include \"" + f.path + "\"\n";
  }
  write(folder / "all.cpp", all);
  write(folder / "library.cpp", library);
  const std::string object = (folder / "app.so").string();
  const std::string log = (folder / "log.txt").string();
#ifdef __SANITIZE_ADDRESS__ // the runtime's archive is instrumented then
  const std::string sanitizer = " -fsanitize=address,undefined -fno-sanitize-recover=all";
#else
  const std::string sanitizer;
#endif
  const std::string command =
      std::string(STRIDE_CXX) + sanitizer + (options.optimized ? " -O1" : " -O0") +
      " -std=c++20 -fPIC -shared -Wall -Wextra -Wpedantic -Werror "
      "-fwrapv -fno-strict-aliasing -fno-finite-loops"
      " -fno-delete-null-pointer-checks -ffp-contract=off -fno-rtti -I" +
      folder.string() + " -I" STRIDE_SOURCE_DIR " " + (folder / "all.cpp").string() + " " +
      (folder / "library.cpp").string() + " -o " + object +
      " " STRIDE_RUNTIME_ARCHIVE " -Wl,-z,defs > " + log + " 2>&1";
  if (std::system(command.c_str()) != 0) {
    std::ifstream in(log);
    std::stringstream text;
    text << in.rdbuf();
    ADD_FAILURE() << "g++ rejects the generated code in " << folder << "\n" << text.str();
    return;
  }
  handle_ = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) {
    ADD_FAILURE() << dlerror();
    return;
  }
  using Entry = const stride::StrideAppV1 *(*)();
  described_ = std::make_unique<stride::app::DescribedApplication>(
      *reinterpret_cast<Entry>(dlsym(handle_, "stride_app_v1"))());
  app_ = &described_->description();
  state_.resize(app_->stateSize / sizeof(std::max_align_t) + 1);
  std::memset(state_.data(), 0, state_.size() * sizeof(std::max_align_t));
  ctx_.state = state_.data();
  host_ = {sizeof(stride::HostApi), 0, this, raise, refill, nullptr};
  ctx_.host = &host_;
  ctx_.taskIntervalNs = 10'000'000;
  ctx_.loopBudget = budget_;
  dataStack_.giveTo(ctx_);
  try {
    app_->init(&ctx_);
  } catch (const Thrown &thrown) {
    exception_ = thrown.text;
  }
  if (!::testing::Test::HasFailure())
    fs::remove_all(folder);
}

void App::run(int cycles) {
  if (app_ == nullptr)
    return;
  exception_.clear();
  try {
    for (int i = 0; i < cycles; ++i) {
      ctx_.loopBudget = budget_;
      refills_ = 0;
      app_->tasks[0].run(&ctx_);
      ++ctx_.cycle;
      ctx_.cycleStartNs += ctx_.taskIntervalNs;
    }
  } catch (const Thrown &thrown) {
    exception_ = thrown.text;
  }
}

void App::setLoopBudget(int64_t budget, int64_t more, int times) {
  budget_ = budget;
  more_ = more;
  times_ = times;
}

int64_t App::refill(stride::Ctx *ctx) {
  auto &app = *static_cast<App *>(ctx->host->self);
  return app.refills_++ < app.times_ ? app.more_ : 0;
}

void App::exit(bool inCopyCode) {
  ctx_.inCopyCode = inCopyCode ? 1 : 0;
  if (app_ != nullptr && app_->exit != nullptr)
    app_->exit(&ctx_);
}

void App::reinit() {
  if (app_ != nullptr && app_->reinit != nullptr)
    app_->reinit(&ctx_);
}

void *App::at(std::string_view path, const stride::TypeDesc **typeOut) const {
  if (app_ == nullptr)
    return nullptr;
  std::string_view rest = path;
  const auto word = [&] {
    size_t end = 0;
    while (end < rest.size() && rest[end] != '.' && rest[end] != '[' && rest[end] != ']' &&
           rest[end] != ',' && rest[end] != '^')
      ++end;
    const std::string_view w = rest.substr(0, end);
    rest.remove_prefix(end);
    return std::string(w);
  };
  std::string first = word();
  char *place = nullptr;
  const stride::TypeDesc *type = nullptr;
  const auto findRoot = [&](const std::string &list, const std::string &name) {
    for (uint32_t i = 0; i < app_->rootCount; ++i) {
      const stride::RootDesc &r = app_->roots[i];
      const bool inList = list.empty() ? (r.flags & stride::kSymQualifiedOnly) == 0
                                       : r.list != nullptr && lower(r.list) == lower(list);
      if (!inList || lower(r.name) != lower(name))
        continue;
      place = static_cast<char *>(ctx_.state) + r.offset;
      type = &app_->types[r.type];
      return true;
    }
    return false;
  };
  if (!findRoot("", first)) {
    if (rest.empty())
      return nullptr;
    rest.remove_prefix(1);
    if (!findRoot(first, word()))
      return nullptr;
  }
  while (!rest.empty()) {
    const char c = rest.front();
    rest.remove_prefix(1);
    if (type->kind == stride::Kind::InOut || type->kind == stride::Kind::Reference || c == '^') {
      std::memcpy(&place, place, sizeof(void *));
      type = &app_->types[type->element];
      if (place == nullptr)
        return nullptr;
      if (c == '^')
        continue;
    }
    if (c == '.') {
      const std::string name = lower(word());
      const stride::TypeDesc *owner = type;
      bool found = false;
      while (!found) {
        const stride::TypeDesc *base = nullptr;
        for (uint32_t i = 0; i < owner->memberCount && !found; ++i) {
          const stride::MemberDesc &m = app_->members[owner->firstMember + i];
          if ((m.flags & stride::kSymBase) != 0) {
            base = &app_->types[m.type];
          } else if (lower(m.name) == name) {
            place += m.offset;
            type = &app_->types[m.type];
            found = true;
          }
        }
        if (!found && base == nullptr)
          return nullptr;
        owner = base;
      }
    } else if (c == '[' || c == ',') {
      const int64_t index = std::stoll(word());
      place += static_cast<uint64_t>(index - type->lowerBound) * app_->types[type->element].size;
      type = &app_->types[type->element];
      if (rest.front() == ']')
        rest.remove_prefix(1);
    }
  }
  if (typeOut != nullptr)
    *typeOut = type;
  return place;
}

std::string App::operator[](std::string_view path) const {
  const stride::TypeDesc *type = nullptr;
  const void *place = at(path, &type);
  if (place == nullptr)
    return "?";
  if (type->kind == stride::Kind::STRING)
    return "'" + std::string(static_cast<const char *>(place)) + "'";
  if (type->kind == stride::Kind::WSTRING) {
    std::string out = "\"";
    for (const auto *c = static_cast<const char16_t *>(place); *c != 0; ++c)
      out += *c < 0x80 ? std::string(1, static_cast<char>(*c))
                       : "<" + std::to_string(static_cast<unsigned>(*c)) + ">";
    return out + "\"";
  }
  stride::Kind kind = type->kind;
  if (kind == stride::Kind::Enum)
    kind = app_->types[type->element].kind;
  if (kind == stride::Kind::Pointer || kind == stride::Kind::Reference ||
      kind == stride::Kind::InOut) {
    void *target = nullptr;
    std::memcpy(&target, place, sizeof target);
    return target == nullptr ? "null" : "set";
  }
  char buffer[stride::text::kBufferSize];
  const uint32_t length = stride::text::formatValue(buffer, kind, place);
  return std::string(buffer, length);
}

} // namespace stc::test
