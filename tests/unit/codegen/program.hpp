#ifndef STRIDE_TESTS_UNIT_CODEGEN_PROGRAM_HPP
#define STRIDE_TESTS_UNIT_CODEGEN_PROGRAM_HPP
// ST text, compiled by the compiler and by g++, loaded and run: what the code generator's tests
// look at.

#include "compiler/codegen/codegen.hpp"
#include "runtime/app/symbol_text.hpp"
#include "tests/support/data_stack.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stc::test {

/// A named ST text.
struct Source {
  std::string name;
  std::string text;
};

struct Options {
  bool checks = true;
  std::vector<Source>
      library; ///< files of a library `Lib`, compiled as such (with its bodies) when they are used
  bool optimized = false; ///< small bodies are in the headers then
};

/// The C++ of a project. Errors of the front end are test failures.
std::vector<GeneratedFile> generate(const std::vector<Source> &sources,
                                    const Options &options = {});
/// The text of one of the files; empty when there is none.
std::string fileText(const std::vector<GeneratedFile> &files, std::string_view path);

/// A running application.
class App {
public:
  /// One file `Main.st`; every PROGRAM of it is called once per cycle, in the order of the text.
  explicit App(std::string_view source, const Options &options = {});
  explicit App(const std::vector<Source> &sources, const Options &options = {});
  ~App();
  App(const App &) = delete;
  App &operator=(const App &) = delete;

  /// Runs cycles of 10 ms; stops at the first exception.
  void run(int cycles = 1);
  /// How many loop iterations each cycle from now on may make. The host adds `more` so many `times`
  /// per cycle.
  void setLoopBudget(int64_t budget, int64_t more = 0, int times = 0);
  /// What is left of the last cycle's loop budget.
  [[nodiscard]] int64_t loopBudgetLeft() const { return ctx_.loopBudget; }
  /// How often the host was asked for more in the last cycle.
  [[nodiscard]] int refills() const { return refills_; }
  /// FB_Exit and FB_Reinit of all instances.
  void exit(bool inCopyCode);
  void reinit();
  /// The value at a path as text (`Main.a[2].x`): `5`, `1.5`, `TRUE`, `'text'`.
  [[nodiscard]] std::string operator[](std::string_view path) const;
  /// `DivisionByZero Main.st:5:8` of the exception that ended the last run; empty without one.
  [[nodiscard]] const std::string &exception() const { return exception_; }
  [[nodiscard]] const stride::StrideAppV1 &description() const { return *app_; }
  /// Address of the place.
  [[nodiscard]] void *at(std::string_view path, const stride::TypeDesc **type = nullptr) const;

private:
  void load(const std::vector<GeneratedFile> &files, const Options &options);
  static int64_t refill(stride::Ctx *ctx);

  void *handle_ = nullptr;
  std::unique_ptr<const stride::app::DescribedApplication> described_;
  const stride::StrideAppV1 *app_ = nullptr;
  std::vector<std::max_align_t> state_;
  stride::Ctx ctx_{};
  stride::HostApi host_{};
  int64_t budget_ = 100'000;
  int64_t more_ = 0;
  int times_ = 0;
  int refills_ = 0;
  stride::test::DataStack dataStack_;
  std::string exception_;
};

} // namespace stc::test

#endif // STRIDE_TESTS_UNIT_CODEGEN_PROGRAM_HPP
